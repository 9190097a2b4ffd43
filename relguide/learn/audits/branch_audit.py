"""audit_of(judged parts) → Audit: how good a network is, per branch and region.

Every share comes with its 95 % interval (Wilson); every gap above 0.01 % with what explains it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.words.branches import BRANCHES
from relguide.learn.audits.branch_judging import LEAST_SHARES, WORTH, BranchVerdicts
from relguide.learn.audits.gaps import surfaces
from relguide.learn.training.shares import Share, share_as_json
from relguide.learn.words.branch_labels import SOURCES, Floats, held_out_regions
from relguide.learn.words.train_branches import NEAR

GROUPS = {
    "box": "random",
    "reverse": "rare branches",
    "edge": "at switching surfaces",
    "loop": "in closed loops",
}
"""What each source is called in an audit."""
PERCENTILES = (50.0, 99.0, 99.9, 100.0)
TOPS = (1, 2, 3)
DOUBTS = (0.0, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2, 0.1, 0.2, 0.3, 0.5, 1.0)
"""Edges of the bins of doubt: 1 less the highest share."""
EXPLAINED = 200
"""Most gaps that are explained, the largest ones: a poor network has no end of them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """How good a network is on some situations."""

    name: str
    size: int
    tops: tuple[Share, ...]
    """How often the fastest branch is among the first `TOPS`."""
    covered: Share
    """How often the path decoded is the fastest, among those answered."""
    fallbacks: Share
    """How often the network hands over."""
    mean_set: float
    """Branches in a set on average."""
    gaps: tuple[float, ...]
    """The `PERCENTILES` of the gap, relative."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Miss:
    """A gap above `WORTH`, and what explains it."""

    gap: float
    """How much longer than the optimum what was answered is, relative."""
    situation: tuple[float, float, float, float]
    """x, y [R], h [rad], α."""
    fastest: str
    """The branch missed."""
    answered: str
    """The one given."""
    birth: float
    """How far it is to where the fastest branch does not exist [R, rad]; see `gaps`."""
    switch: float
    """And to where it is not the fastest."""
    explained: bool
    """Whether one of them is near."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """Situations of which the network is about equally sure, and whether it is right to be."""

    said: float
    """1 less the highest share, on average: how often it says it is wrong."""
    wrong: Share
    """How often it is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SetSize:
    """What a larger or smaller set would give, in random situations."""

    least_share: float
    mean_set: float
    """Branches in a set on average; none is too large here."""
    lost: Share
    """How often the path decoded is not the fastest."""
    worth: Share
    """How often by more than `WORTH`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Audit:
    """All that is found."""

    groups: tuple[Group, ...]
    """By source, without the regions held out; those regions, evenly drawn; what the other sources
    have in them. Together they are all situations."""
    classes: tuple[Group, ...]
    """The random situations by their fastest branch."""
    doubts: tuple[Doubt, ...]
    """The random situations by how sure the network is of them, those it is surest of first."""
    sets: tuple[SetSize, ...]
    misses: tuple[Miss, ...]
    """Gaps above `WORTH`, the largest first; of more than `EXPLAINED`, only those."""
    worth: Share
    """How many answers have such a gap."""

    @property
    def unexplained(self) -> int:
        """How many of the misses have no explanation."""
        return sum(not miss.explained for miss in self.misses)


def audit_of(
    chunks: Mapping[int, BranchVerdicts], progress: Callable[[float], object] = lambda _: None
) -> Audit:
    """Sum up an audit's chunks.

    Args:
        chunks: by their number.
        progress: called with 1 for each gap that is explained.
    """
    parts = [chunks[number] for number in sorted(chunks)]
    whole = BranchVerdicts(
        **{
            name: np.concatenate([getattr(part, name) for part in parts])
            for name in BranchVerdicts.__slots__
        }
    )
    seen = ~whole.regions.any(axis=1)
    drawn = whole.groups == SOURCES.index("box")
    groups = [
        _group(GROUPS[source], whole, seen & (whole.groups == number))
        for number, source in enumerate(SOURCES)
    ]
    names = list(held_out_regions(np.zeros((1, 4))))
    groups += [
        _group(f"unseen {name}", whole, drawn & whole.regions[:, region])
        for region, name in enumerate(names)
    ]
    groups.append(_group("unseen, harder sources", whole, ~seen & ~drawn))
    classes = [
        _group(name, whole, drawn & seen & (whole.best == number))
        for number, name in enumerate(BRANCHES)
    ]
    return Audit(
        groups=tuple(groups),
        classes=tuple(classes),
        doubts=doubts_of(whole.doubt[drawn], whole.ranks[drawn] == 0),
        sets=_set_sizes(whole.sets.sum(axis=0)),
        misses=_misses(whole, progress),
        worth=Share(hits=len(whole.missed), of=int((whole.gap < inf).sum())),
    )


def doubts_of(doubt: NDArray[np.floating], right: NDArray[np.bool_]) -> tuple[Doubt, ...]:
    """Situations in bins of how sure a network is of them, those it is surest of first.

    Args:
        doubt: 1 less the highest share. shape (n,)
        right: whether that was right. shape (n,)
    """
    bins = np.searchsorted(DOUBTS[1:-1], doubt)
    return tuple(
        Doubt(
            said=float(doubt[bins == k].mean()),
            wrong=Share(hits=int((~right[bins == k]).sum()), of=int((bins == k).sum())),
        )
        for k in np.unique(bins)
    )


def _set_sizes(sums: Floats) -> tuple[SetSize, ...]:
    return tuple(
        SetSize(
            least_share=float(least_share),
            mean_set=float(held / max(of, 1.0)),
            lost=Share(hits=int(of - fastest), of=int(of)),
            worth=Share(hits=int(worth), of=int(of)),
        )
        for least_share, (held, fastest, worth, of) in zip(LEAST_SHARES, sums.T, strict=True)
    )


def _misses(whole: BranchVerdicts, progress: Callable[[float], object]) -> tuple[Miss, ...]:
    rows = np.flatnonzero((whole.gap > WORTH) & (whole.gap < inf))
    largest = np.argsort(-whole.gap[rows], kind="stable")[:EXPLAINED]
    near = surfaces(whole.missed[largest], progress)
    return tuple(
        Miss(
            gap=float(whole.gap[rows[at]]),
            situation=tuple(whole.missed[at].tolist()),
            fastest=BRANCHES[whole.best[rows[at]]],
            answered=BRANCHES[whole.answered[at]],
            birth=float(near.birth[i]),
            switch=float(near.switch[i]),
            explained=bool(near.near[i]),
        )
        for i, at in enumerate(largest.tolist())
    )


def _group(name: str, whole: BranchVerdicts, chosen: NDArray[np.bool_]) -> Group:
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


def audit_as_json(audit: Audit) -> dict[str, Any]:
    """An audit as it is printed."""
    return {
        "groups": {group.name: _group_as_json(group) for group in audit.groups},
        "branches": {group.name: _group_as_json(group) for group in audit.classes},
        "doubts": [
            {"said": doubt.said, "wrong": share_as_json(doubt.wrong)} for doubt in audit.doubts
        ],
        "sets": [
            {
                "least_share": size.least_share,
                "mean_set": size.mean_set,
                "not_fastest": share_as_json(size.lost),
                "gap_above_0.01_percent": share_as_json(size.worth),
            }
            for size in audit.sets
        ],
        "gaps_above_0.01_percent": share_as_json(audit.worth),
        "unexplained": audit.unexplained,
        "largest_gaps": [_miss_as_json(miss) for miss in audit.misses],
    }


def _miss_as_json(miss: Miss) -> dict[str, Any]:
    x, y, h, alpha = miss.situation
    return {
        "gap_percent": 100.0 * miss.gap,
        "situation": {"x_r": x, "y_r": y, "h_rad": h, "speed_ratio": alpha},
        "fastest": miss.fastest,
        "answered": miss.answered,
        "to_birth": miss.birth if miss.birth < inf else None,
        "to_switch": miss.switch if miss.switch < inf else None,
        "explained": miss.explained,
    }


def _group_as_json(group: Group) -> dict[str, Any]:
    tops = zip(TOPS, group.tops, strict=True)
    return {
        "situations": group.size,
        **{f"top_{top}": share_as_json(share) for top, share in tops},
        "optimal_of_answered": share_as_json(group.covered),
        "fallbacks": share_as_json(group.fallbacks),
        "mean_set": group.mean_set,
        "gap_percent": {
            "max" if percentile == 100.0 else f"p{percentile:g}": 100.0 * gap
            for percentile, gap in zip(PERCENTILES, group.gaps, strict=True)
        },
    }
