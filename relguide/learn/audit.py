"""audit(network, …) → Audit: how good a network is, per strategy and region, against exact answers.

Fresh situations are drawn as for training, with another seed: evenly in the box, starts of rare
strategies, places next to a switching surface. Every share comes with its 95 % interval (Wilson).
The gap is what a plan loses once the set of the network is solved exactly, before the certificate:
the limit plays no part in it.
"""

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from math import inf, sqrt
from time import perf_counter_ns
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.extremals import MAX_ROWS, solve
from relguide.kernels.network import choose, judge_rows
from relguide.kernels.strategies import SIZE, STRATEGIES
from relguide.learn.chunks import gathered
from relguide.learn.labels import SOURCES, Floats, LabelRequest, held_out, label_chunk
from relguide.learn.network import StrategyNetwork
from relguide.learn.train import NEAR

SHARES = (0.8, 0.1, 0.1)
"""Of the sources of an audit's situations."""
GROUPS = {
    "box": "random",
    "reverse": "rare strategies",
    "edge": "at switching surfaces",
}
"""What each source is called in an audit."""
PERCENTILES = (50.0, 99.0, 99.9, 100.0)
TOPS = (1, 2, 3)
ROUNDING = 1e-9
"""A gap below this is none."""
SAMPLES = 2000
"""Queries that the latency is measured on."""
Z = 1.959964
"""Of a 95 % interval."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """What is found of each situation of an audit, as columns."""

    groups: NDArray[np.int8]
    """Its source."""
    best: NDArray[np.int8]
    """Its fastest strategy."""
    ranks: NDArray[np.int8]
    """The place, from 0 on, that the network gives to the fastest strategy."""
    held: NDArray[np.int8]
    """How many strategies are in its set; 0 where the network hands over."""
    gap: NDArray[np.float64]
    """How much longer than the optimum the decoded path is, relative; infinite if handed over."""
    regions: NDArray[np.bool_]
    """Whether it lies in each region that was held out. shape (n, regions)"""

    def __len__(self) -> int:
        return len(self.best)


@dataclass(frozen=True, slots=True, kw_only=True)
class Share:
    """How often something holds."""

    hits: int
    of: int

    @property
    def interval(self) -> tuple[float, float]:
        """Its 95 % interval (Wilson)."""
        if self.of == 0:
            return 0.0, 1.0
        p, n = self.hits / self.of, self.of
        middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n)
        half = Z / (1.0 + Z * Z / n) * sqrt(p * (1.0 - p) / n + Z * Z / (4.0 * n * n))
        return max(middle - half, 0.0), min(middle + half, 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """How good a network is on some situations."""

    name: str
    size: int
    tops: tuple[Share, ...]
    """How often the fastest strategy is among the first `TOPS`."""
    covered: Share
    """How often the path decoded is the fastest, among those answered."""
    fallbacks: Share
    """How often the network hands over."""
    mean_set: float
    """Strategies in a set on average."""
    gaps: tuple[float, ...]
    """The `PERCENTILES` of the gap, relative."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Audit:
    """All that is found."""

    groups: tuple[Group, ...]
    """By source, without the regions held out; those regions, evenly drawn; what the other sources
    have in them. Together they are all situations."""
    classes: tuple[Group, ...]
    """The random situations by their fastest strategy."""


def audit_request(network: StrategyNetwork, count: int, seed: int) -> LabelRequest:
    """What situations to audit with.

    Raises:
        ValueError: if they would be those of the training.
    """
    if seed == network.about.get("dataset", {}).get("seed"):
        raise ValueError(f"The network has seen the situations of seed {seed}: use another.")
    return LabelRequest(count=count, seed=seed, box=network.box, shares=SHARES)


def judged(
    network: StrategyNetwork, request: LabelRequest, executor: Executor
) -> Iterator[tuple[int, Judged]]:
    """Judge chunk by chunk, as they are ready; see `chunks.gathered`."""
    return gathered(partial(judge_chunk, network, request), request.chunks, executor)


def judge_chunk(network: StrategyNetwork, request: LabelRequest, number: int) -> Judged:
    """Label a chunk exactly and hold the network against it."""
    labels = label_chunk(request, number)
    n = len(labels)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    judge_rows(
        labels.situations, network.layers, network.least_share, network.most, 0, n, scores, decoded
    )
    least = labels.times.min(axis=1, keepdims=True)
    # strategies as fast as the fastest are as right: their best place counts
    right = labels.times <= least * (1.0 + NEAR)
    places = (-scores[:, 0]).argsort(axis=1).argsort(axis=1)
    given = decoded[:, 1] < inf
    gap = np.full(n, inf)
    gap[given] = decoded[given, 1] / least[given, 0] - 1.0
    gap[gap < ROUNDING] = 0.0
    return Judged(
        groups=labels.sources,
        best=labels.best.astype(np.int8),
        ranks=np.where(right, places, SIZE).min(axis=1).astype(np.int8),
        held=np.where(given, decoded[:, 0], 0).astype(np.int8),
        gap=gap,
        regions=np.column_stack(list(held_out(labels.situations).values())),
    )


def audit_of(chunks: Mapping[int, Judged]) -> Audit:
    """Sum up an audit's chunks."""
    parts = [chunks[number] for number in sorted(chunks)]
    whole = Judged(
        **{
            name: np.concatenate([getattr(part, name) for part in parts])
            for name in Judged.__slots__
        }
    )
    seen = ~whole.regions.any(axis=1)
    drawn = whole.groups == SOURCES.index("box")
    groups = [
        _group(GROUPS[source], whole, seen & (whole.groups == number))
        for number, source in enumerate(SOURCES)
    ]
    names = list(held_out(np.zeros((1, 4))))
    groups += [
        _group(f"unseen {name}", whole, drawn & whole.regions[:, region])
        for region, name in enumerate(names)
    ]
    groups.append(_group("unseen, harder sources", whole, ~seen & ~drawn))
    classes = [
        _group(name, whole, drawn & seen & (whole.best == number))
        for number, name in enumerate(STRATEGIES)
    ]
    return Audit(groups=tuple(groups), classes=tuple(classes))


def _group(name: str, whole: Judged, chosen: NDArray[np.bool_]) -> Group:
    size = int(chosen.sum())
    ranks, held, gap = whole.ranks[chosen], whole.held[chosen], whole.gap[chosen]
    given = gap[gap < inf]
    percentiles = np.percentile(given, PERCENTILES) if len(given) else np.zeros(len(PERCENTILES))
    return Group(
        name=name,
        size=size,
        tops=tuple(Share(hits=int((ranks < top).sum()), of=size) for top in TOPS),
        covered=Share(hits=int((given <= NEAR).sum()), of=len(given)),
        fallbacks=Share(hits=size - len(given), of=size),
        mean_set=float(held[held > 0].mean()) if len(given) else 0.0,
        gaps=tuple(percentiles.tolist()),
    )


def latencies(network: StrategyNetwork, request: LabelRequest) -> dict[str, tuple[float, float]]:
    """Median and 99th percentile of one query [µs]: by the network, and by all words solved."""
    situations: Floats = label_chunk(request, 0).situations[:SAMPLES]
    rows = np.empty((MAX_ROWS, 5))
    layers, least, most = network.layers, network.least_share, network.most

    def by_network(x: float, y: float, h: float, alpha: float) -> object:
        return choose(x, y, h, alpha, layers, least, most, rows)

    def by_all_words(x: float, y: float, h: float, alpha: float) -> object:
        return solve(x, y, h, alpha, 0.0, rows)

    found: dict[str, tuple[float, float]] = {}
    for name, ask in (("network", by_network), ("all words", by_all_words)):
        spent: list[float] = []
        for situation in situations.tolist():
            begun = perf_counter_ns()
            ask(*situation)
            spent.append((perf_counter_ns() - begun) * 1e-3)
        middle, late = np.percentile(spent, (50.0, 99.0))
        found[name] = float(middle), float(late)
    return found


def audit_as_json(audit: Audit) -> dict[str, Any]:
    """An audit as it is printed."""
    return {
        "groups": {group.name: _group_as_json(group) for group in audit.groups},
        "strategies": {group.name: _group_as_json(group) for group in audit.classes},
    }


def _group_as_json(group: Group) -> dict[str, Any]:
    tops = zip(TOPS, group.tops, strict=True)
    return {
        "situations": group.size,
        **{f"top_{top}": _share_as_json(share) for top, share in tops},
        "optimal_of_answered": _share_as_json(group.covered),
        "fallbacks": _share_as_json(group.fallbacks),
        "mean_set": group.mean_set,
        "gap_percent": {
            "max" if percentile == 100.0 else f"p{percentile:g}": 100.0 * gap
            for percentile, gap in zip(PERCENTILES, group.gaps, strict=True)
        },
    }


def _share_as_json(share: Share) -> dict[str, Any]:
    return {"hits": share.hits, "of": share.of, "interval_95": list(share.interval)}
