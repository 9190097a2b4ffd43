"""judge_chunk(network, request, number) → BranchVerdicts: a network held against exact answers.

Fresh situations are drawn as for training, with another seed: evenly in the box, starts of rare
branches, places next to a switching surface. The gap is what a plan loses once the set of the
network is solved exactly, before the certificate: the limit plays no part in it.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from math import inf
from time import thread_time_ns

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.records import Pose
from relguide.kernels.networks.branch_scores import choose, judge_branches
from relguide.kernels.words.branches import SIZE, WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.learn.audits.latency import Latency, latency_of
from relguide.learn.training.chunks import gather
from relguide.learn.words.branch_labels import (
    SOURCES,
    Floats,
    LabelRequest,
    held_out_regions,
    label_chunk,
)
from relguide.learn.words.branch_network import BranchNetwork
from relguide.learn.words.train_branches import NEAR

SHARES = (0.8, 0.1, 0.1)
"""Of the sources of an audit's situations."""
LOOPS = 0.005
"""For each of them so many more of closed loops: a flight for each chunk."""
ROUNDING = 1e-9
"""Smaller gaps do not count."""
WORTH = 1e-4
"""A gap above this is reported and explained: 0.01 %."""
LEAST_SHARES = np.geomspace(1e-7, 0.1, 13)
"""Least shares that the size of the set is drawn for."""
SAMPLES = 2000
"""Queries that the latency is measured on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BranchVerdicts:
    """What is found of each situation of an audit, as columns; and of some of them, more."""

    groups: NDArray[np.int8]
    """Its source."""
    best: NDArray[np.int8]
    """Its fastest branch."""
    ranks: NDArray[np.int8]
    """The place, from 0 on, that the network gives to the fastest branch."""
    held: NDArray[np.int8]
    """How many branches are in its set; 0 where the network hands over."""
    gap: NDArray[np.float64]
    """How much longer than the optimum the decoded path is, relative; infinite if handed over."""
    regions: NDArray[np.bool_]
    """Whether it lies in each region that was held out. shape (n, regions)"""
    doubt: NDArray[np.float32]
    """1 less the highest share."""
    missed: Floats
    """x, y, h, α of those whose gap is above `WORTH`, in order. shape (m, 4)"""
    answered: NDArray[np.int8]
    """The branch of the path decoded there. shape (m,)"""
    sets: Floats
    """Of the random situations, for each of `LEAST_SHARES`: how many branches are in their sets,
    how many paths decoded are the fastest, how many have a gap above `WORTH`; and how many
    situations there are. shape (parts, 4, least shares)"""

    def __len__(self) -> int:
        return len(self.best)


def branch_audit_request(network: BranchNetwork, count: int, seed: int) -> LabelRequest:
    """What situations to audit with.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == network.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    return LabelRequest(count=count, seed=seed, box=network.box, shares=SHARES, loops=LOOPS)


def judge_chunks(
    network: BranchNetwork, request: LabelRequest, executor: Executor
) -> Iterator[tuple[int, BranchVerdicts]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gather`."""
    return gather(partial(judge_chunk, network, request), request.chunks, executor)


def judge_chunk(network: BranchNetwork, request: LabelRequest, number: int) -> BranchVerdicts:
    """Label a chunk exactly and hold the network against it."""
    labels = label_chunk(request, number)
    n = len(labels)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    judge_branches(
        labels.situations, network.layers, network.least_share, network.most, scores, decoded
    )
    least = labels.times.min(axis=1, keepdims=True)
    # branches as fast as the fastest are as right: their best place counts
    right = labels.times <= least * (1.0 + NEAR)
    places = (-scores[:, 0]).argsort(axis=1).argsort(axis=1)
    given = decoded[:, 1] < inf
    gap = np.full(n, inf)
    gap[given] = decoded[given, 1] / least[given, 0] - 1.0
    gap[gap < ROUNDING] = 0.0
    missed = (gap > WORTH) & given
    share = np.exp(scores[:, 0] - scores[:, 0].max(axis=1, keepdims=True))
    share /= share.sum(axis=1, keepdims=True)
    drawn = labels.sources == SOURCES.index("box")
    return BranchVerdicts(
        groups=labels.sources,
        best=labels.best.astype(np.int8),
        ranks=np.where(right, places, SIZE).min(axis=1).astype(np.int8),
        held=np.where(given, decoded[:, 0], 0).astype(np.int8),
        gap=gap,
        regions=np.column_stack(list(held_out_regions(labels.situations).values())),
        doubt=(1.0 - share.max(axis=1)).astype(np.float32),
        missed=labels.situations[missed],
        answered=decoded[missed, 2].astype(np.int8),
        sets=_sets(share[drawn], labels.times[drawn])[None],
    )


def _sets(share: Floats, times: Floats) -> Floats:
    """Sums over situations for each of `LEAST_SHARES`, as in `BranchVerdicts.sets`."""
    least = times.min(axis=1)
    sums = np.empty((4, len(LEAST_SHARES)))
    for k, least_share in enumerate(LEAST_SHARES):
        held = share >= least_share
        # both branches of a word come from one solution of it
        solved = np.stack([held[:, WORD_OF == word].any(axis=1) for word in WORD_OF], axis=1)
        gap = np.where(solved, times, inf).min(axis=1) / least - 1.0
        sums[:, k] = held.sum(), (gap <= NEAR).sum(), (gap > WORTH).sum(), len(times)
    return sums


def latencies(network: BranchNetwork, request: LabelRequest) -> dict[str, Latency]:
    """How long one query takes: the network's, and all words'."""
    situations: Floats = label_chunk(request, 0).situations[:SAMPLES]
    rows = np.empty((MAX_ROWS, 5))
    layers, least, most = network.layers, network.least_share, network.most

    def by_network(x: float, y: float, h: float, alpha: float) -> object:
        return choose(x, y, h, alpha, layers, least, most, rows)

    def by_all_words(x: float, y: float, h: float, alpha: float) -> object:
        return solve(Pose(x, y, h), alpha, 0.0, rows)

    found: dict[str, Latency] = {}
    for name, ask in (("network", by_network), ("all words", by_all_words)):
        spent: list[float] = []
        for situation in situations.tolist():
            begun = thread_time_ns()
            ask(*situation)
            spent.append((thread_time_ns() - begun) * 1e-3)
        found[name] = latency_of(spent)
    return found
