"""Lines and regions of a field on a grid, as a display draws them: exact where they are drawn.

Between nodes a field of times-to-converge is smooth, has a kink (another word becomes as fast) or
jumps (a word ceases to exist). Contour lines and outlines come from contourpy, which sees only
the nodes; then the field itself is evaluated again:

- each vertex of a line lies on an edge of the grid, and is moved along it until the time there is
  that of the level; where the field jumps over the level there is no such point, and the line is
  cut;
- the middle of each piece of a line is tried, and the piece is left out where the time there is
  off: a jump, or a bend too sharp for the grid;
- each vertex of a region's outline is moved along its edge to where the word changes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.planning.extras import need
from relguide.units import Second

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

TOLERANCE: Second = 0.1
"""A vertex of a line is on its level to within this [s]; the eye sees 1 s at best."""
JUMP: Second = 5.0
"""Between two vertices a line may be off its level by this [s]."""
SMOOTH: Second = 0.5
"""A piece whose middle is off by less is not tried at its quarters."""
HALVINGS, SECANTS = 3, 6
"""Steps toward a level after that of the grid: halvings to an eighth of an edge, then secants."""
SAME_RISE = 0.9
"""If the time rises by this part of the whole within an eighth of an edge, and by more than `JUMP`,
it jumps."""
OUTLINE_ROUNDS = 2
"""Halvings toward a change of word: to an eighth of an edge."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """What is known of places, one by one."""

    time: Floats
    """Time-to-converge of a plan that keeps d_min [s]; infinite where none was found. (n,)"""
    lower_bound: Floats
    """No plan is faster [s]; infinite where there is none. (n,)"""
    words: NDArray[np.int8]
    """Which word the plan is: the number of its name in a list. (n,)"""
    limited: Bools
    """Whether the limit binds: the fastest path without it comes too close. (n,)"""

    @property
    def proved(self) -> Bools:
        """Where the time is the optimum, proved."""
        return (self.time < inf) & (self.time <= self.lower_bound)


Evaluate = Callable[[Floats, Floats], Field]
"""Places east and north [m], each of shape (n,), over the ground at t = 0 → what is known there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Contour:
    """Where the time-to-converge is that of a level."""

    level: Second
    lines: tuple[Floats, ...]
    """East and north of each line's vertices [m]; closed where the first is also the last.
    shape (n, 2)"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Region:
    """Where one word is the answer, with the limit or without."""

    word: str
    limited: bool
    """Whether the limit binds there."""
    polygons: tuple[tuple[Floats, ...], ...]
    """Each an outline and its holes, closed: east and north of their vertices [m]. shape (n, 2)"""


@dataclass(frozen=True, slots=True)
class _Axes:
    """The grid, and places on it counted in columns and rows."""

    x: Floats
    y: Floats

    def world(self, at: Floats) -> Floats:
        """East and north [m] of places in columns and rows, of shape (n, 2)."""
        steps = np.array((self.x[1] - self.x[0], self.y[1] - self.y[0]))
        places: Floats = np.array((self.x[0], self.y[0])) + at * steps
        return places

    def on_grid(self, flat: NDArray[np.generic]) -> NDArray[np.generic]:
        """A column of the field, by row and column."""
        return flat.reshape(len(self.y), len(self.x))


def contours(
    field: Field, x: Floats, y: Floats, levels: Sequence[Second], evaluate: Evaluate
) -> tuple[Contour, ...]:
    """Lines of equal time.

    Args:
        field: at the nodes, row after row. (rows · columns,)
        x: of the columns [m], ascending evenly.
        y: of the rows [m], ascending evenly.
        levels: [s].
        evaluate: what the field is made by.
    """
    need("contourpy")
    from contourpy import LineType, contour_generator

    axes = _Axes(x, y)
    time = np.asarray(axes.on_grid(field.time), np.float64)
    generator = contour_generator(
        z=np.ma.masked_invalid(time), corner_mask=False, line_type=LineType.Separate
    )
    drawn = [(level, line) for level in levels for line in generator.lines(level)]
    if not drawn:
        return tuple(Contour(level=level, lines=()) for level in levels)
    sizes = [len(line) for _, line in drawn]
    wanted = np.repeat([level for level, _ in drawn], sizes)
    vertices, settled = _settle(np.concatenate([line for _, line in drawn]), wanted, time, axes,
                                evaluate)  # fmt: skip
    joined = settled[:-1] & settled[1:]
    joined[np.cumsum(sizes)[:-1] - 1] = False  # from one line to the next
    _cut(joined, vertices, wanted, axes, evaluate)
    world = axes.world(vertices)
    ends = np.flatnonzero(np.diff(np.concatenate(([False], joined, [False])).astype(np.int8)))
    found: dict[Second, list[Floats]] = {level: [] for level in levels}
    for first, last in ends.reshape(-1, 2).tolist():
        found[float(wanted[first])].append(world[first : last + 1])
    return tuple(Contour(level=level, lines=tuple(found[level])) for level in levels)


def _settle(
    vertices: Floats, wanted: Floats, time: Floats, axes: _Axes, evaluate: Evaluate
) -> tuple[Floats, Bools]:
    """Move each vertex along its edge to its level; and whether there is such a point."""
    low, high = np.floor(vertices + 1e-9), np.ceil(vertices - 1e-9)  # to contourpy's rounding
    along = high - low  # (n, 2): one of the two is 1
    part = ((vertices - low) * along).sum(axis=1)
    start, end = np.zeros(len(part)), np.ones(len(part))
    at_start, at_end = (
        time[corner[:, 1].astype(int), corner[:, 0].astype(int)] - wanted for corner in (low, high)
    )
    rise = np.abs(at_end - at_start)
    settled = np.zeros(len(part), np.bool_)
    active = np.arange(len(part))
    for step in range(1 + HALVINGS + SECANTS):
        # where several levels jump together they halve together: each place is evaluated once
        at = low[active] + part[active, None] * along[active]
        off = _each_once(axes.world(at), evaluate) - wanted[active]
        good = np.abs(off) <= TOLERANCE
        settled[active[good]] = True
        active, off = active[~good], off[~good]
        if step == 0:  # the bracket stays the whole edge, for all levels alike
            part[active] = 0.5
            continue
        before = np.signbit(off) == np.signbit(at_start[active])
        start[active[before]], at_start[active[before]] = part[active[before]], off[before]
        end[active[~before]], at_end[active[~before]] = part[active[~before]], off[~before]
        left = np.abs(at_end[active] - at_start[active])
        if step >= HALVINGS:
            active = active[~((left > JUMP) & (left > SAME_RISE * rise[active]))]
        if len(active) == 0:
            break
        share = np.full(len(active), 0.5)
        if step >= HALVINGS and step % 2 == 0:
            share = at_start[active] / (at_start[active] - at_end[active])
            share = np.where(np.isfinite(share), np.clip(share, 0.02, 0.98), 0.5)
        part[active] = start[active] + share * (end[active] - start[active])
    return low + part[:, None] * along, settled


def _each_once(places: Floats, evaluate: Evaluate) -> Floats:
    """Times of places, of which some are equal: each is evaluated once."""
    first, which = _distinct(places.view(np.complex128).ravel())
    return evaluate(places[first, 0], places[first, 1]).time[which]


def _distinct(values: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Where each value occurs first, in that order; and which of these each value equals.

    Neighbours along a line remain neighbours: the answer to one is a hint for the next.
    """
    _, first, which = np.unique(values, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return first[order], rank[which.reshape(-1)]


def _cut(joined: Bools, vertices: Floats, wanted: Floats, axes: _Axes, evaluate: Evaluate) -> None:
    """Separate neighbours between which the time is off."""
    pieces = np.flatnonzero(joined)
    for share in (0.5, 0.25, 0.75):
        places = axes.world(vertices[pieces] * (1.0 - share) + vertices[pieces + 1] * share)
        off = np.abs(evaluate(places[:, 0], places[:, 1]).time - wanted[pieces])
        joined[pieces[off > JUMP]] = False
        pieces = pieces[(off > SMOOTH) & (off <= JUMP)]


def regions(
    field: Field, x: Floats, y: Floats, names: Sequence[str], evaluate: Evaluate
) -> tuple[Region, ...]:
    """Where each word is the answer.

    Args:
        field: at the nodes, row after row. (rows · columns,)
        x: of the columns [m], ascending evenly.
        y: of the rows [m], ascending evenly.
        names: of the words by their number.
        evaluate: what the field is made by.
    """
    axes = _Axes(x, y)
    labels = np.asarray(axes.on_grid(_labels(field)), np.int64)
    present = np.flatnonzero(np.bincount(labels.ravel()))
    places = np.meshgrid(*(np.arange(n, dtype=np.float64) for n in reversed(labels.shape)))
    found = [(int(label), _outlines(labels == label, *places)) for label in present]
    rings = [ring for _, polygons in found for polygon in polygons for ring in polygon]
    moved = axes.world(_to_change(np.concatenate(rings), labels, axes, evaluate))
    pieces = iter(np.split(moved, np.cumsum([len(ring) for ring in rings])[:-1]))
    return tuple(
        Region(
            word=names[label // 2],
            limited=bool(label % 2),
            polygons=tuple(tuple(next(pieces) for _ in polygon) for polygon in polygons),
        )
        for label, polygons in found
    )


def _labels(field: Field) -> NDArray[np.int64]:
    return 2 * field.words.astype(np.int64) + field.limited


def _outlines(inside: Bools, column: Floats, row: Floats) -> list[list[Floats]]:
    """Outlines with their holes, in columns and rows; each vertex half way between two nodes."""
    need("contourpy")
    from contourpy import FillType, contour_generator

    # contourpy looks at the whole of its input, and most labels fill a small part of the grid
    across, along = (_extent_of(np.any(inside, axis=axis)) for axis in (0, 1))
    part = along, across
    generator = contour_generator(
        column[part], row[part], inside[part].astype(np.float64), fill_type=FillType.OuterOffset
    )
    points, offsets = generator.filled(0.5, inf)[:2]
    return [
        [rings[i:j] for i, j in pairwise(np.asarray(offset).tolist())]
        for rings, offset in zip(map(np.asarray, points), offsets, strict=True)
    ]


def _extent_of(inside: NDArray[np.bool_]) -> slice:
    """From one before the first that is inside to one past the last; at least two."""
    where = np.flatnonzero(inside)
    return slice(max(int(where[0]) - 1, 0), int(where[-1]) + 2)


def _to_change(
    vertices: Floats, labels: NDArray[np.int64], axes: _Axes, evaluate: Evaluate
) -> Floats:
    """Move vertices along their edges to where the label changes; those on one edge together."""
    doubled = np.rint(2.0 * vertices).astype(np.int64)
    wide = 2 * labels.shape[1]
    first, which = _distinct(doubled[:, 1] * wide + doubled[:, 0])
    edges = doubled[first]
    low, high = edges // 2, (edges + 1) // 2
    along = (high - low).astype(np.float64)
    before = labels[low[:, 1], low[:, 0]]
    start, end = np.zeros(len(edges)), np.ones(len(edges))
    on_edge = np.flatnonzero(along.any(axis=1))  # the others are nodes on the rim of the grid
    for _ in range(OUTLINE_ROUNDS):
        part = 0.5 * (start + end)
        places = axes.world(low[on_edge] + part[on_edge, None] * along[on_edge])
        same = _labels(evaluate(places[:, 0], places[:, 1])) == before[on_edge]
        start[on_edge[same]] = part[on_edge[same]]
        end[on_edge[~same]] = part[on_edge[~same]]
    moved = low + (0.5 * (start + end))[:, None] * along
    return np.asarray(moved[which], np.float64)
