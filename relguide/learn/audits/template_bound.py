"""judge_bound(ways, exact answers, sources) → Bound: the network of ways where the limit binds.

What it names, what it holds possible, and what it leads to, beside what the search found.
"""

from dataclasses import dataclass
from math import inf
from time import thread_time_ns

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.records import Pose
from relguide.kernels.contact.constrained_rows import exact_constrained
from relguide.kernels.networks.template_rows import VERDICTS, judge_templates
from relguide.kernels.networks.template_scores import LEGS, choose_template
from relguide.kernels.networks.templates import NONE, SEVERAL
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch
from relguide.learn.boundary.template_labels import LONGEST, Floats, Ways
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.train_templates import WITHIN, taught
from relguide.planning.constrained_path import BEARINGS

QUERIES, SEARCHES = 2000, 200
"""That the latency is measured on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """What is found of situations in which the limit binds, as columns."""

    situations: Floats
    """x, y ≥ 0 [R], h in [0, 2π) [rad], α, D/R, d_min/R. shape (n, 6)"""
    sources: NDArray[np.int8]
    """Numbers of `template_labels.SOURCES`."""
    kinds: NDArray[np.int8]
    """Of the fastest ways."""
    named: NDArray[np.bool_]
    """Whether the kind that the network finds likeliest, solved next to its guess, is the fastest
    way; where that is of no kind, or there is none, whether the likeliest says either."""
    doubt: Floats
    """1 less the highest share."""
    own: Floats
    """Share of the fastest way's kind."""
    inside: NDArray[np.bool_]
    """Whether that is in the network's set."""
    held: NDArray[np.int8]
    """How many kinds are in the set."""
    exact: Floats
    """When the fastest way arrives [R/V_P]; infinite where there is none."""
    answered: NDArray[np.int8]
    """The kind of the way that the network leads to."""
    given: Floats
    """When that arrives [R/V_P]; infinite if it is passed on."""

    def __len__(self) -> int:
        return len(self.kinds)


def judge_bound(ways: TemplateNetwork, exact: Ways, sources: NDArray[np.int8]) -> Bound:
    """Hold a network against exact answers.

    Args:
        ways: the network.
        exact: situations in which the limit binds, and their answers.
        sources: of the situations.
    """
    kinds, _ = taught(exact)
    verdicts = np.empty((len(kinds), VERDICTS))
    judge_templates(
        exact.situations, kinds.astype(float), ways.layers, ways.least_share, ways.most, ways.doubt,
        verdicts,
    )  # fmt: skip
    first, highest, time, own, held, answered, given = verdicts.T
    there = np.isfinite(exact.times)
    # of no kind, or none: then it is right to say so, in either word
    silent = np.isin(kinds, (NONE, SEVERAL)) & np.isin(first, (NONE, SEVERAL))
    # the planner gives no way either that takes longer than any it would look for
    given = np.where(given > LONGEST, inf, given)
    return Bound(
        situations=exact.situations,
        sources=sources,
        kinds=kinds.astype(np.int8),
        named=silent | (there & (time <= exact.times + WITHIN)),
        doubt=1.0 - highest,
        own=own.copy(),
        inside=own >= ways.least_share,
        held=held.astype(np.int8),
        exact=exact.times,
        answered=answered.astype(np.int8),
        given=given,
    )


def template_latencies(ways: TemplateNetwork, situations: Floats) -> dict[str, tuple[float, float]]:
    """One query, median and 99th percentile [µs of CPU time]: the network's, and the search's.

    Args:
        ways: the network.
        situations: in which the limit binds. shape (n, 6)
    """
    legs, free = np.zeros((LEGS, 6)), np.empty(5)
    layers, least, most, doubt = ways.layers, ways.least_share, ways.most, ways.doubt

    def by_network(row: Floats) -> int:
        x, y, h, alpha, slot, limit = row.tolist()
        fastest(Pose(x, y, h), alpha, 0.0, 0, make_scratch(), free)
        begun = thread_time_ns()
        choose_template(x, y, h, slot, alpha, limit, free, layers, least, most, doubt, legs)
        return thread_time_ns() - begun

    def by_search(row: Floats) -> int:
        times, counts, found = np.empty((1, 3)), np.empty(1), np.zeros((1, LEGS, 6))
        begun = thread_time_ns()
        exact_constrained(row[None], BEARINGS, LONGEST, times, counts, found)
        return thread_time_ns() - begun

    found: dict[str, tuple[float, float]] = {}
    for name, ask, count in (("network", by_network, QUERIES), ("search", by_search, SEARCHES)):
        ask(situations[0])  # not counted: it may load what is compiled
        spent = [ask(row) * 1e-3 for row in situations[:count]]
        middle, late = np.percentile(spent, (50.0, 99.0))
        found[name] = float(middle), float(late)
    return found
