"""judge_constrained(…) → ConstrainedVerdicts: the template network where the limit binds.

What it names, what it holds possible, and what it leads to, beside what the search found.
"""

from dataclasses import dataclass
from math import inf
from time import thread_time_ns

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.contact.constrained_rows import solve_constrained_rows
from relguide.kernels.networks.template_rows import VERDICTS, judge_templates
from relguide.kernels.networks.template_scores import LEGS, choose_template
from relguide.kernels.networks.templates import NONE, SEVERAL
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch
from relguide.learn.audits.latency import Latency, latency_of
from relguide.learn.boundary.template_labels import LONGEST, ConstrainedPaths, Floats
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.train_templates import WITHIN, targets_of
from relguide.planning.constrained_path import BEARINGS

QUERIES, SEARCHES = 2000, 200
"""That the latency is measured on, about."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstrainedVerdicts:
    """What is found of situations in which the limit binds, as columns."""

    situations: Floats
    """x, y ≥ 0 [R], h in [0, 2π) [rad], α, D/R, d_min/R. shape (n, 6)"""
    sources: NDArray[np.int8]
    """Numbers of `template_labels.SOURCES`."""
    templates: NDArray[np.int8]
    """Of the fastest paths."""
    named: NDArray[np.bool_]
    """Whether the template that the network finds likeliest, solved next to its guess, is the
    fastest path; where that is of no template, or there is none, whether the likeliest says so."""
    doubt: Floats
    """1 less the highest share."""
    own: Floats
    """Share of the fastest path's template."""
    inside: NDArray[np.bool_]
    """Whether that is in the network's set."""
    held: NDArray[np.int8]
    """How many templates are in the set."""
    exact: Floats
    """When the fastest path arrives [R/V_P]; infinite where there is none."""
    answered: NDArray[np.int8]
    """The template of the path that the network leads to."""
    given: Floats
    """When that arrives [R/V_P]; infinite if it is passed on."""

    def __len__(self) -> int:
        return len(self.templates)


def judge_constrained(
    network: TemplateNetwork, exact: ConstrainedPaths, sources: NDArray[np.int8]
) -> ConstrainedVerdicts:
    """Hold a network against exact answers.

    Args:
        network: the network.
        exact: situations in which the limit binds, and their answers.
        sources: of the situations.
    """
    templates, _ = targets_of(exact)
    verdicts = np.empty((len(templates), VERDICTS))
    judge_templates(
        exact.situations, templates.astype(float), network.layers, network.decision, verdicts
    )
    first, highest, time, own, held, answered, given = verdicts.T
    there = np.isfinite(exact.times)
    # of no template, or none: then it is right to say so, in either word
    silent = np.isin(templates, (NONE, SEVERAL)) & np.isin(first, (NONE, SEVERAL))
    # the planner gives no path either that takes longer than any it would look for
    given = np.where(given > LONGEST, inf, given)
    return ConstrainedVerdicts(
        situations=exact.situations,
        sources=sources,
        templates=templates.astype(np.int8),
        named=silent | (there & (time <= exact.times + WITHIN)),
        doubt=1.0 - highest,
        own=own.copy(),
        inside=own >= network.least_share,
        held=held.astype(np.int8),
        exact=exact.times,
        answered=answered.astype(np.int8),
        given=given,
    )


def template_latencies(network: TemplateNetwork, situations: Floats) -> dict[str, Latency]:
    """How long one query takes: the network's, whether it answers or not, and the search's.

    Args:
        network: the network.
        situations: in which the limit binds. shape (n, 6)
    """
    legs, free = np.zeros((LEGS, 6)), np.empty(5)
    layers, decision = network.layers, network.decision

    def by_network(row: Floats) -> int:
        x, y, h, alpha, slot, limit = row.tolist()
        pose, scene = Pose(x, y, h), straight_scene(alpha, slot, limit)
        fastest(pose, alpha, 0.0, 0, make_scratch(), free)
        begun = thread_time_ns()
        choose_template(pose, scene, free, layers, decision, legs)
        return thread_time_ns() - begun

    def by_search(row: Floats) -> int:
        times, counts, found = np.empty((1, 3)), np.empty(1), np.zeros((1, LEGS, 6))
        begun = thread_time_ns()
        solve_constrained_rows(row[None], BEARINGS, LONGEST, times, counts, found)
        return thread_time_ns() - begun

    found: dict[str, Latency] = {}
    for name, ask, count in (("network", by_network, QUERIES), ("search", by_search, SEARCHES)):
        ask(situations[0])  # not counted: it may load what is compiled
        # evenly out of all sources: so the means of both are of the same sort of situations
        spent = [ask(row) * 1e-3 for row in situations[:: max(len(situations) // count, 1)]]
        found[name] = latency_of(spent)
    return found
