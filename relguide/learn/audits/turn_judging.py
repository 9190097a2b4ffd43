"""judge_turn_chunk(…) → TurnVerdicts: the network of turning leaders held against exact answers.

Fresh situations in which the limit binds, drawn as the labels are with another seed.
"""

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from functools import partial
from time import thread_time_ns

import numpy as np

from relguide.kernels.networks.template_scores import LEGS, choose_turn_template
from relguide.kernels.networks.turn_templates import DELAYED
from relguide.kernels.networks.turning_leader import bound_without_limit, turning_scene
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.learn.audits.constrained_judging import ConstrainedVerdicts, judge_constrained
from relguide.learn.audits.latency import Latency, latency_of
from relguide.learn.audits.template_audit import TemplateAudit, audit_of_bound
from relguide.learn.audits.template_judging import columns_of
from relguide.learn.boundary.template_labels import Floats
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.learn.boundary.turn_labels import (
    SOURCES,
    TurnBox,
    TurnLabelRequest,
    turning_answers_of,
)
from relguide.learn.training.chunks import gather

QUERIES = 1000
"""That the latency is measured on, about."""


def turn_audit_request(
    network: TemplateNetwork[TurnBox], count: int, seed: int
) -> TurnLabelRequest:
    """What situations to audit with.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == network.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    return TurnLabelRequest(count=count, seed=seed, box=network.box)


def judge_turn_chunks(
    network: TemplateNetwork[TurnBox], request: TurnLabelRequest, executor: Executor
) -> Iterator[tuple[int, ConstrainedVerdicts]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gather`."""
    return gather(partial(judge_turn_chunk, network, request), request.chunks, executor)


def judge_turn_chunk(
    network: TemplateNetwork[TurnBox], request: TurnLabelRequest, number: int
) -> ConstrainedVerdicts:
    """Answer a chunk exactly and hold the network against it; a function of its arguments."""
    labels = request.make(number)
    return judge_constrained(network, labels.paths, labels.sources)


def turn_audit_of(
    chunks: Mapping[int, ConstrainedVerdicts], names: tuple[str, ...]
) -> tuple[TemplateAudit, ConstrainedVerdicts]:
    """Sum up an audit's chunks, by their number, and all that was judged.

    Situations in which a third turn makes a path just long enough are left out: the exact planner
    finds that without a search.
    """
    whole = ConstrainedVerdicts(**columns_of([chunks[number] for number in sorted(chunks)]))
    searched = whole.templates != DELAYED
    asked = {name: getattr(whole, name)[searched] for name in whole.__slots__}
    judged = ConstrainedVerdicts(**asked)
    return audit_of_bound(judged, names, SOURCES, ()), judged


def turn_latencies(
    network: TemplateNetwork[TurnBox], judged: ConstrainedVerdicts
) -> dict[str, Latency]:
    """How long a query with a path takes: the network's, with and without what it passes on.

    *Together* is with the search for what it passes on; and the search's.

    Args:
        network: the network.
        judged: situations in which the limit binds.
    """
    there = np.flatnonzero(np.isfinite(judged.exact))
    rows, legs = np.empty((MAX_ROWS, 5)), np.zeros((LEGS, 6))
    layers, decision = network.layers, network.decision

    def by_network(numbers: Floats) -> float:
        begun = thread_time_ns()
        pose, scene = turning_scene(numbers)
        bound = bound_without_limit(pose, scene, rows)
        choose_turn_template(pose, scene, numbers, bound, layers, decision, legs)
        return (thread_time_ns() - begun) * 1e-3

    def by_search(numbers: Floats) -> float:
        begun = thread_time_ns()
        turning_answers_of(numbers[None])
        return (thread_time_ns() - begun) * 1e-3

    spent: list[tuple[float, float, float]] = []
    for at in (there[0], *there[:: max(len(there) // QUERIES, 1)]):
        network_took, search_took = (ask(judged.situations[at]) for ask in (by_network, by_search))
        passed_on = not np.isfinite(judged.given[at])
        spent.append((network_took, network_took + passed_on * search_took, search_took))
    # the first is not counted: it may load what is compiled
    columns = zip(*spent[1:], strict=True)
    names = ("network", "together", "search")
    return {name: latency_of(column) for name, column in zip(names, columns, strict=True)}
