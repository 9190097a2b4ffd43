"""side_by_side(…): the paper's network, its tree, direct regression and ours, on one ground.

All answer the same fresh situations: one encounter, that of the tree, places and headings drawn
evenly over the area from where the slot can be joined within the tree's horizon. Those in which the
limit binds are left out, and counted: none of them has learnt to go round it, and elsewhere the
fastest path is known with proof.

Two things are asked of each. What it gives, flown as it is: how far from the slot does that end?
And the words it names, solved exactly: how much longer than the fastest path is the best of them?
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf, pi
from time import thread_time_ns
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.angles import wrap_each
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.networks.branch_scores import choose, judge_branches
from relguide.kernels.words.branches import BRANCHES, SIZE, WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS, WORDS, solve_word
from relguide.learn.audits.branch_judging import ROUNDING
from relguide.learn.training.shares import Share, share_as_json
from relguide.learn.tree.nearest import Lookup, neighbours
from relguide.learn.tree.regular_network import RegularNetwork, regress_pairs
from relguide.learn.tree.regular_words import RegularPiece, pieces_of, words_like
from relguide.learn.tree.tree import TreeParameters, pairs_of
from relguide.learn.words.branch_labels import Floats, times_of
from relguide.learn.words.branch_network import BranchNetwork
from relguide.learn.words.train_branches import NEAR
from relguide.maps.area import exact_times, reach
from relguide.units import DEG, Metre, Radian

Flags = NDArray[np.bool_]
REACHED: tuple[Metre, Radian] = (200.0, 1.0 * DEG)
"""A path flown as it is reaches the slot if it ends so near: place and heading."""
PERCENTILES = (50.0, 99.0, 99.9, 100.0)
"""Of the gaps."""
SAMPLES = 1000
"""Queries that the latency is measured on."""
WORDS_OF: list[int] = WORD_OF.tolist()
"""`WORD_OF` as a list."""
DRAWN = 20_000
"""Places drawn at a time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground:
    """Fresh situations of one encounter, the limit not binding in any of them."""

    parameters: TreeParameters
    """Encounter, horizon and resolution of the tree."""
    situations: Floats
    """x, y, h, α in the slot frame, left of the route: all of them mirror. shape (n, 4)"""
    times: Floats
    """τ of every branch [R/V_P], as `times_of` gives them. shape (n, SIZE)"""
    binding: int
    """How many more were drawn, in which the limit binds."""

    def __len__(self) -> int:
        return len(self.situations)


@dataclass(frozen=True, slots=True, kw_only=True)
class Given:
    """What a method gives for each situation."""

    named: Flags
    """The branches it names as the fastest. shape (n, SIZE)"""
    solved: Flags
    """The branches that then come out of their words' solution. shape (n, SIZE)"""
    sizes: NDArray[np.int64]
    """How many it holds possible; 0 where it hands over. shape (n,)"""
    ends: Floats | None
    """Where what it gives, flown as it is, ends relative to the slot, and on what heading relative
    to the leader's [m, rad]: both ≥ 0. shape (n, 2). `None` if it gives no path."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodResult:
    """How good one of them is."""

    name: str
    right: Share
    """How often the fastest branch is the one it names, or one of two where it cannot say."""
    classes: tuple[Share, ...]
    """The same by the fastest branch, in the order of `BRANCHES`."""
    mean_set: float
    """Branches whose words are solved, on average."""
    reached: Share | None
    """How often its path, flown as it is, ends within `REACHED` of the slot."""
    places: Floats | None
    """How far it ends from the slot, sorted [m]."""
    headings: Floats | None
    """And from the leader's heading, sorted [rad]."""
    fastest: Share
    """How often the path decoded is the fastest, among those answered."""
    passed_on: Share
    """How often none is found, and the exact planner has to answer."""
    gap: Floats
    """How much longer than the fastest the path decoded is, relative, sorted."""
    latency: tuple[float, float]
    """Median and 99th percentile of one query, decoded [µs of CPU time]."""

    @property
    def gaps(self) -> tuple[float, ...]:
        """The `PERCENTILES` of the gap."""
        found: list[float] = np.percentile(self.gap, PERCENTILES).tolist()
        return tuple(found)


def draw_ground(
    parameters: TreeParameters, count: int, seed: int, progress: Callable[[float], object]
) -> Ground:
    """Draw situations.

    Args:
        parameters: of the tree: its encounter and its horizon.
        count: how many.
        seed: of the random numbers.
        progress: called with the number of situations found since the last call.
    """
    encounter, rng = parameters.encounter, np.random.default_rng(seed)
    radius = encounter.turn_radius
    low, high, side = reach(encounter, parameters.horizon)
    found: list[Floats] = []
    size, binding = 0, 0
    while size < count:
        x, y = rng.uniform(low, high, DRAWN), rng.uniform(0.0, side, DRAWN)
        h = rng.uniform(0.0, 2.0 * pi, DRAWN)
        rows = np.column_stack((x / radius, y / radius, h, np.full(DRAWN, encounter.speed_ratio)))
        soonest = times_of(rows).min(axis=1) * (radius / encounter.pursuer_tas)
        apart = np.hypot(x - encounter.slot_distance, y) >= encounter.min_separation
        there = np.flatnonzero((soonest <= parameters.horizon) & apart)[: count - size]
        exact = exact_times(encounter, x[there], y[there], h[there]).time_to_converge
        free = exact <= soonest[there] * (1.0 + NEAR)
        binding += int((~free).sum())
        found.append(rows[there[free]])
        size += int(free.sum())
        progress(float(free.sum()))
    situations = np.concatenate(found)
    return Ground(
        parameters=parameters,
        situations=situations,
        times=times_of(situations),
        binding=binding,
    )


def side_by_side(
    ground: Ground,
    network: BranchNetwork,
    lookup: Lookup,
    regressions: Sequence[RegularNetwork],
) -> Iterator[MethodResult]:
    """Judge our network, the nearest path of the tree, and networks that regress.

    Args:
        ground: the situations.
        network: ours.
        lookup: the tree.
        regressions: the networks of `regular_network`, of the same encounter.
    """
    alpha = ground.parameters.encounter.speed_ratio
    rows = np.empty((MAX_ROWS, 5))

    def ours(x: float, y: float, h: float) -> object:
        return choose(x, y, h, alpha, network.layers, network.least_share, network.most, rows)

    yield _method("ours", ground, _judge_network(ground, network), ours)
    asked: list[tuple[str, Callable[[Floats, Floats, Floats], Floats]]] = [
        ("nearest in tree", lambda x, y, h: look_up_pairs(lookup, x, y, h))
    ]
    for regression in regressions:
        name = "paper's network" if regression.method == "paper" else "direct regression"
        asked.append((name, lambda x, y, h, r=regression: regress_pairs(r, x, y, h)))  # type: ignore[misc]
    for name, give in asked:

        def one(x: float, y: float, h: float) -> object:
            pairs = give(*(np.array([value]) for value in (x, y, h)))  # noqa: B023
            room, n = np.empty((MAX_ROWS, 4)), 0
            for word in words_like(clear_pieces(pairs, ground.parameters)[0]):
                n = solve_word(
                    Pose(x, y, h), Velocity(alpha, 0.0), Window(0.0, inf), word, room, rows, n
                )
            return n

        x, y, h, _ = ground.situations.T
        yield _method(name, ground, _judge_pairs(ground, give(x, y, h)), one)


def look_up_pairs(lookup: Lookup, x: Floats, y: Floats, h: Floats) -> Floats:
    """What the nearest states of a tree give, in the form of `regress_pairs`."""
    radius = lookup.tree.parameters.encounter.turn_radius
    near = neighbours(lookup, x * radius, y * radius, h)
    pairs = pairs_of(lookup.tree, near.nodes)
    pairs[:, :, 2] /= radius
    pairs[near.mirrored, :, 0] *= -1.0
    return pairs


def clear_pieces(pairs: Floats, parameters: TreeParameters) -> list[list[RegularPiece]]:
    """The pieces of each row of pairs; those shorter than half a step of the tree are left out."""
    steps = parameters.delta_theta, parameters.delta_l / parameters.encounter.turn_radius
    clear = np.where(pairs[:, :, 1:] >= 0.5 * np.array(steps), pairs[:, :, 1:], 0.0)
    return [pieces_of(row) for row in np.concatenate((pairs[:, :, :1], clear), axis=2).tolist()]


def branches_like(pieces: Sequence[RegularPiece]) -> list[bool]:
    """Which branches pieces name: of a word of three turns both branches unless they say."""
    words = words_like(pieces)
    named = [word in words for word in WORDS_OF]
    if words[0] >= 4 and "".join(piece.letter for piece in pieces) == WORDS[words[0]]:
        named[2 * words[0] - 4 + (pieces[1].amount <= pi)] = False
    return named


def ends_of(pairs: Floats, situations: Floats) -> Floats:
    """Where paths flown as they are end: from the slot [R], and off its heading [rad]."""
    x, y, h, alpha = situations.T.copy()
    spent = np.zeros(len(x))
    for turn, angle, length in pairs.transpose(1, 2, 0):
        after = h + turn * angle
        x = x + turn * (np.sin(after) - np.sin(h)) + length * np.cos(after)
        y = y - turn * (np.cos(after) - np.cos(h)) + length * np.sin(after)
        h, spent = after, spent + angle + length
    off = np.abs(wrap_each(h + pi) - pi)
    return np.column_stack((np.hypot(x - alpha * spent, y), off))


def _judge_network(ground: Ground, network: BranchNetwork) -> Given:
    n = len(ground)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    judge_branches(
        ground.situations, network.layers, network.least_share, network.most, scores, decoded
    )
    share = np.exp(scores[:, 0] - scores[:, 0].max(axis=1, keepdims=True))
    share /= share.sum(axis=1, keepdims=True)
    held = share >= network.least_share
    sizes = np.where(decoded[:, 0] <= network.most, held.sum(axis=1), 0)
    return Given(
        named=share == share.max(axis=1, keepdims=True),
        solved=_both_branches(held) & (sizes > 0)[:, None],
        sizes=sizes,
        ends=None,
    )


def _judge_pairs(ground: Ground, pairs: Floats) -> Given:
    named = np.array([branches_like(pieces) for pieces in clear_pieces(pairs, ground.parameters)])
    radius = ground.parameters.encounter.turn_radius
    return Given(
        named=named,
        solved=_both_branches(named),
        sizes=named.sum(axis=1),
        ends=ends_of(pairs, ground.situations) * (radius, 1.0),
    )


def _both_branches(held: Flags) -> Flags:
    """Both branches of a word come from one solution of it."""
    return np.stack([held[:, WORD_OF == word].any(axis=1) for word in WORD_OF], axis=1)


def _method(
    name: str, ground: Ground, given: Given, ask: Callable[[float, float, float], object]
) -> MethodResult:
    least = ground.times.min(axis=1)
    fastest = ground.times <= least[:, None] * (1.0 + NEAR)
    right = (given.named & fastest).any(axis=1)
    best = ground.times.argmin(axis=1)
    time = np.where(given.solved, ground.times, inf).min(axis=1)
    gap = time[time < inf] / least[time < inf] - 1.0
    gap[gap < ROUNDING] = 0.0
    places = headings = reached = None
    if given.ends is not None:
        places, headings = np.sort(given.ends, axis=0).T
        reached = Share(hits=int((given.ends <= REACHED).all(axis=1).sum()), of=len(ground))
    return MethodResult(
        name=name,
        right=Share(hits=int(right.sum()), of=len(ground)),
        classes=tuple(
            Share(hits=int(right[best == s].sum()), of=int((best == s).sum())) for s in range(SIZE)
        ),
        mean_set=float(given.sizes[given.sizes > 0].mean()),
        reached=reached,
        places=places,
        headings=headings,
        fastest=Share(hits=int((gap <= NEAR).sum()), of=len(gap)),
        passed_on=Share(hits=len(ground) - len(gap), of=len(ground)),
        gap=np.sort(gap),
        latency=_latency(ground, ask),
    )


def _latency(ground: Ground, ask: Callable[[float, float, float], object]) -> tuple[float, float]:
    spent: list[float] = []
    for x, y, h, _ in ground.situations[:SAMPLES].tolist():
        begun = thread_time_ns()
        ask(x, y, h)
        spent.append((thread_time_ns() - begun) * 1e-3)
    return two(np.array(spent))


def two(values: Floats) -> tuple[float, float]:
    """Median and 99th percentile."""
    middle, late = np.percentile(values, (50.0, 99.0)).tolist()
    return middle, late


def method_as_json(method: MethodResult) -> dict[str, Any]:
    """What is found of a method, as it is printed."""
    found: dict[str, Any] = {
        "branch_right": share_as_json(method.right),
        "branches": {
            name: share_as_json(share) for name, share in zip(BRANCHES, method.classes, strict=True)
        },
        "mean_set": method.mean_set,
        "optimal_of_answered": share_as_json(method.fastest),
        "fallbacks": share_as_json(method.passed_on),
        "gap_percent": {
            "max" if percentile == 100.0 else f"p{percentile:g}": 100.0 * gap
            for percentile, gap in zip(PERCENTILES, method.gaps, strict=True)
        },
        "latency": {"p50_us": method.latency[0], "p99_us": method.latency[1]},
    }
    if method.reached is not None and method.places is not None and method.headings is not None:
        place, heading = two(method.places), two(method.headings)
        found["flown_as_given"] = {
            "reaches_the_slot": share_as_json(method.reached),
            "from_the_slot_m": {"p50": place[0], "p99": place[1]},
            "off_heading_deg": {"p50": heading[0] / DEG, "p99": heading[1] / DEG},
        }
    return found
