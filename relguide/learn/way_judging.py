"""judge_way_chunk(ways, network, request, number) → WayJudged: networks against exact answers.

Two sorts of fresh situations, both with another seed than the training's. Where the limit binds,
drawn as its labels are, the network of ways is asked, and the search answers. And everywhere: drawn
as the source `far` is, but whether the limit binds or not, as mostly it does not. There the network
of strategies names what is fastest without the limit, that of ways what is where it binds, and the
planner by networks is asked as in flight, with the certificate.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, fields, replace
from functools import partial
from math import atan, inf
from time import thread_time_ns

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.fastest import fastest
from relguide.kernels.limited import exact_ways, limit_binds_rows
from relguide.kernels.network import judge_rows
from relguide.kernels.sooner import MOST_ROOTS, work_room
from relguide.kernels.strategies import SIZE
from relguide.kernels.way_judging import VERDICTS, judge_ways
from relguide.kernels.way_network import LEGS, choose_way
from relguide.kernels.ways import NONE, SEVERAL
from relguide.learn.chunks import gathered
from relguide.learn.labels import times_of
from relguide.learn.limit_labels import (
    DRAWN,
    LONGEST,
    Floats,
    LimitRequest,
    Ways,
    answers_of,
    anywhere,
    limit_chunk,
)
from relguide.learn.network import StrategyNetwork
from relguide.learn.planner import propose
from relguide.learn.train import NEAR
from relguide.learn.train_ways import WITHIN, taught
from relguide.learn.way_network import WayNetwork
from relguide.planning.detour import BEARINGS
from relguide.planning.situation import Leader, Pursuer, Situation
from relguide.planning.words import HORIZON
from relguide.units import G0, MetrePerSecond, Second

UNIT: Second = 40.0
"""R/V_P of the airliner in whose seconds delays are told, and that the planner is asked for."""
TAS: MetrePerSecond = 200.0
"""Its V_P; it turns at 27° of bank then."""
FAR = 2
"""The source that situations everywhere are drawn as: its number."""
QUERIES, SEARCHES = 2000, 200
"""That the latency is measured on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """What is found of situations in which the limit binds, as columns."""

    situations: Floats
    """x, y ≥ 0 [R], h in [0, 2π) [rad], α, D/R, d_min/R. shape (n, 6)"""
    sources: NDArray[np.int8]
    """Numbers of `limit_labels.SOURCES`."""
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Everywhere:
    """What is found of situations whether the limit binds or not, as columns."""

    binds: NDArray[np.bool_]
    """Whether it does."""
    named: NDArray[np.bool_]
    """Whether the first choice of the network that is for it, solved, is the fastest way."""
    exact: Floats
    """When the fastest way arrives [R/V_P]; infinite if none does within `HORIZON`."""
    given: Floats
    """When the planner by networks does [R/V_P]; infinite if it asks the exact planner."""

    def __len__(self) -> int:
        return len(self.binds)


@dataclass(frozen=True, slots=True, kw_only=True)
class WayJudged:
    """Both."""

    bound: Bound
    everywhere: Everywhere


def way_request(ways: WayNetwork, network: StrategyNetwork, count: int, seed: int) -> LimitRequest:
    """What situations to audit with, of each sort.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == ways.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    request = LimitRequest(count=count, seed=seed, box=ways.box)
    both(request, network)  # there must be speeds that both know
    return request


def both(request: LimitRequest, network: StrategyNetwork) -> LimitRequest:
    """A request of situations whose speeds both networks know."""
    box = request.box
    return replace(
        request,
        box=replace(
            box,
            min_ratio=max(box.min_ratio, network.box.min_ratio),
            max_ratio=min(box.max_ratio, network.box.max_ratio),
        ),
    )


def judged_ways(
    ways: WayNetwork, network: StrategyNetwork, request: LimitRequest, executor: Executor
) -> Iterator[tuple[int, WayJudged]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gathered`."""
    task = partial(judge_way_chunk, ways, network, request)
    return gathered(task, request.chunks, executor)


def judge_way_chunk(
    ways: WayNetwork, network: StrategyNetwork, request: LimitRequest, number: int
) -> WayJudged:
    """Answer a chunk exactly and hold the networks against it; a function of its arguments."""
    labels = limit_chunk(request, number)
    rng = np.random.default_rng(np.random.SeedSequence(request.seed, spawn_key=(number, 1)))
    return WayJudged(
        bound=_bound(ways, labels.ways, labels.sources),
        everywhere=_everywhere(ways, network, both(request, network), rng, len(labels)),
    )


def joined_ways(chunks: dict[int, WayJudged]) -> WayJudged:
    """Chunks in order of their numbers."""
    parts = [chunks[number] for number in sorted(chunks)]
    bound, everywhere = [part.bound for part in parts], [part.everywhere for part in parts]
    return WayJudged(
        bound=Bound(
            **{
                field.name: np.concatenate([getattr(part, field.name) for part in bound])
                for field in fields(Bound)
            }
        ),
        everywhere=Everywhere(
            **{
                field.name: np.concatenate([getattr(part, field.name) for part in everywhere])
                for field in fields(Everywhere)
            }
        ),
    )


def _bound(ways: WayNetwork, exact: Ways, sources: NDArray[np.int8]) -> Bound:
    """Where the limit binds."""
    kinds, _ = taught(exact)
    verdicts = np.empty((len(kinds), VERDICTS))
    judge_ways(
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


def _everywhere(
    ways: WayNetwork,
    network: StrategyNetwork,
    request: LimitRequest,
    rng: np.random.Generator,
    size: int,
) -> Everywhere:
    """Wherever both networks are asked."""
    situations = np.empty((0, 6))
    while len(situations) < size:
        drawn = anywhere(rng, request.box, FAR, DRAWN)
        near = np.hypot(drawn[:, 0], drawn[:, 1]) <= network.box.max_range
        situations = np.concatenate((situations, drawn[near]))
    situations = situations[:size]
    answer = np.empty(size)
    limit_binds_rows(situations, answer)
    binds = answer == 1.0
    named, exact = np.empty(size, dtype=bool), np.empty(size)
    named[~binds], exact[~binds] = _without_limit(network, situations[~binds, :4])
    times, counts, legs = answers_of(situations[binds])
    there = np.ascontiguousarray(times[:, 2])
    found = _bound(
        ways, Ways(situations[binds], there, counts, legs), np.full(len(there), FAR, dtype=np.int8)
    )
    named[binds], exact[binds] = found.named, found.exact
    exact[exact * UNIT > HORIZON] = inf
    given = np.array([_planned(ways, network, row) for row in situations])
    return Everywhere(binds=binds, named=named, exact=exact, given=given)


def _without_limit(
    network: StrategyNetwork, situations: Floats
) -> tuple[NDArray[np.bool_], Floats]:
    """Whether the first choice is the fastest strategy, and when that arrives [R/V_P]."""
    n = len(situations)
    rows = np.ascontiguousarray(situations)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    judge_rows(rows, network.layers, network.least_share, network.most, 0, n, scores, decoded)
    times = times_of(rows)
    first = np.take_along_axis(times, scores[:, 0].argmax(axis=1)[:, None], axis=1)[:, 0]
    return first <= times.min(axis=1) * (1.0 + NEAR), times.min(axis=1)


def _planned(ways: WayNetwork, network: StrategyNetwork, row: Floats) -> float:
    """When the path arrives that the networks lead to, if it is certified [R/V_P]."""
    proposal = propose(network, situation_of(row), ways)
    if proposal is None or not proposal.certificate.holds:
        return inf
    return proposal.candidate.trajectory.duration / UNIT


def situation_of(row: Floats) -> Situation:
    """An airliner there: the leader at the origin, on heading north."""
    x, y, h, alpha, slot, limit = row.tolist()
    bank = atan(TAS / (G0 * UNIT))
    radius = TAS * UNIT
    return Situation(
        pursuer=Pursuer(
            x=-y * radius, y=(x - slot) * radius, heading=-h, tas=TAS, max_bank=bank
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=alpha * TAS),
        slot_distance=slot * radius,
        min_separation=limit * radius,
    )  # fmt: skip


def way_latencies(ways: WayNetwork, situations: Floats) -> dict[str, tuple[float, float]]:
    """One query, median and 99th percentile [µs of CPU time]: the network's, and the search's.

    Args:
        ways: the network.
        situations: in which the limit binds. shape (n, 6)
    """
    legs, free = np.zeros((LEGS, 6)), np.empty(5)
    layers, least, most, doubt = ways.layers, ways.least_share, ways.most, ways.doubt

    def by_network(row: Floats) -> int:
        x, y, h, alpha, slot, limit = row.tolist()
        fastest(x, y, h, alpha, 0.0, 0, work_room(), np.empty((MOST_ROOTS, 4)), free)
        begun = thread_time_ns()
        choose_way(x, y, h, slot, alpha, limit, free, layers, least, most, doubt, legs)
        return thread_time_ns() - begun

    def by_search(row: Floats) -> int:
        times, counts, found = np.empty((1, 3)), np.empty(1), np.zeros((1, LEGS, 6))
        begun = thread_time_ns()
        exact_ways(row[None], BEARINGS, LONGEST, times, counts, found)
        return thread_time_ns() - begun

    found: dict[str, tuple[float, float]] = {}
    for name, ask, count in (("network", by_network, QUERIES), ("search", by_search, SEARCHES)):
        spent = [ask(row) * 1e-3 for row in situations[:count]]
        middle, late = np.percentile(spent, (50.0, 99.0))
        found[name] = float(middle), float(late)
    return found
