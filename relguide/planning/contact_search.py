"""The least time of all paths that touch d = d_min or keep clear, by halving cells of contacts.

A path that keeps d_min either never touches it, and is then an extremal without the limit that
keeps it, or it has a first contact, and a last one. So none arrives before the fastest such
extremal and the least, over all contacts, of the soonest arrival at the contact and the soonest way
on from there. If that way on breaks the limit, there is another contact, and the last of them
counts too. Contacts are put into cells, of bearing and time, for which all this is bounded at once
(`kernels/bounds/contact_bound.py`). The branch with the least bound is halved again and again: that
bound is proved, at any moment.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from heapq import heappop, heappush
from itertools import count
from math import inf, pi

import numpy as np

from relguide.kernels.bounds.contact_bound import (
    between_bound,
    cell_bound,
    leaving_bound,
    round_bound,
    round_time,
    times_round,
    untouched_bound,
)

MAX_BRANCHES = 400_000
"""Most branches kept, some 100 MB; the search ends there."""
_SMALLEST = 1e-10  # a cell no wider than this is not halved: rounding counts for more [rad]
_REMEMBERED = 65_536  # cells whose bounds are kept at hand, for the branches that share them
_EASED = 0.03  # cells narrower than this are looked at closely [rad]
_CLOSELY = 50  # times a cell is halved to find what is least in it
_NARROW = 1e-6  # and how narrow its parts may become: what is left counts for some 1e-5 R/V_P [rad]
_SLACK = 1e-6  # of `round_time`, as part of a whole round
_QUADRANT_CELLS = 2
"""Cells a quadrant is cut into at first; none may reach into two."""


@dataclass(frozen=True, slots=True)
class Cell:
    """Contacts: a window of bearings, and of time, on one piece of the leader's intent and a side.

    Lengths in R, times in R/V_P.
    """

    piece: int
    side: float
    bearing: float
    half: float
    start: float = 0.0
    end: float = inf

    def halves(self, delta: float) -> "tuple[Cell, Cell]":
        """Its two halves, across the longer side."""
        span = 0.5 * (self.end - self.start)
        if inf > span > (delta + 1.0) * self.half:
            middle = self.start + span
            return replace(self, end=middle), replace(self, start=middle)
        half = 0.5 * self.half
        return (
            replace(self, bearing=self.bearing - half, half=half),
            replace(self, bearing=self.bearing + half, half=half),
        )


_Branch = tuple[float, int, Cell, Cell | None, bool]
"""Paths, by how soon they can arrive: a number that tells them apart, the cell of their first
contact, that of their last one if it is of the final leg and matters, and whether the way round
between them was looked at closely."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """How soon can a path that keeps d_min be at a goal? In the slot frame."""

    start: tuple[float, float, float]
    leader: np.ndarray
    alpha: float
    delta: float
    goal_x: float
    goal_speed: float
    t_release: float
    never_at_release: bool
    """Whether no path at all can be at the goal the moment t_release: who is not too early is late.
    """
    horizon: float
    """Contacts after this time do not matter [R/V_P]."""

    def first_contacts(self) -> Iterator[Cell]:
        """All contacts there are, in cells."""
        for i, start in enumerate(self.leader[:, 0].tolist()):
            end = self.leader[i + 1, 0].item() if i + 1 < len(self.leader) else inf
            # until the slot opens a contact leaves so much time, and after that any
            windows = ((start, self.t_release), (self.t_release, inf))
            for low, high in windows if start < self.t_release < end == inf else ((start, end),):
                high = min(high, self.horizon)
                if low < high or low == 0.0:
                    yield from _all_round(i, low, high)

    def untouched(self) -> float:
        """No path that nowhere touches d_min arrives sooner."""
        return untouched_bound(
            *self.start, self.leader, self.alpha, self.delta, self.goal_x, self.goal_speed,
            self.t_release,
        )  # fmt: skip

    def reached(self, cell: Cell, beat: float) -> tuple[float, float]:
        """How soon a first contact can be in the cell, and the goal from there."""
        late = self.t_release if self.never_at_release else 0.0
        return cell_bound(
            *self.start, self.leader, cell.piece, self.alpha, self.delta, self.goal_x,
            self.goal_speed, late, cell.side, cell.bearing, cell.half, cell.start, cell.end,
            beat,
        )  # fmt: skip

    def left(self, cell: Cell, beat: float) -> float:
        """How soon the slot can be reached from a last contact in the cell, on the final leg."""
        return leaving_bound(
            self.leader, self.alpha, self.delta, cell.side, cell.bearing, cell.half, beat
        )

    def between(self, first: Cell, last: Cell, table: np.ndarray, beat: float) -> float:
        """How soon one contact can follow the other, on the final leg."""
        here, there = (first.bearing, first.half), (last.bearing, last.half)
        way_round = min(round_bound(table, way, *here, *there) for way in (0, 1))
        if way_round >= beat:
            return inf
        word = between_bound(
            self.alpha, self.delta, first.side, *here, last.side, *there, beat
        )  # fmt: skip
        return max(way_round, word)

    def warm_up(self) -> None:
        """Load the kernels."""
        cell = next(self.first_contacts())
        self.untouched()
        self.reached(cell, 0.0)
        self.left(cell, 0.0)
        table = times_round(self.alpha, self.delta)
        round_time(table, 0, 0.0)
        self.between(cell, cell, table, 0.0)
        between_bound(self.alpha, self.delta, 1.0, 0.1, 0.1, 1.0, 0.1, 0.1, 0.0)

    def least(self, cell: Cell, bound: Callable[[Cell], float]) -> float:
        """The least that a bound comes to in a cell, looked at closely."""
        numbers = count()
        parts = [(bound(cell), next(numbers), cell)]
        for _ in range(_CLOSELY):
            if parts[0][0] == inf or parts[0][2].half < _NARROW:
                break
            for half in heappop(parts)[2].halves(self.delta):
                heappush(parts, (bound(half), next(numbers), half))
        return parts[0][0]

    def bounds(self, beat: float) -> Iterator[float]:
        """Ever better bounds of the time of all paths, up to `beat`, where they end."""
        beat = min(beat, self.untouched())
        final = len(self.leader) - 1
        reached = lru_cache(_REMEMBERED)(lambda cell: self.reached(cell, beat))
        left = lru_cache(_REMEMBERED)(lambda cell: self.left(cell, beat))
        table = times_round(self.alpha, self.delta)
        last_contacts = tuple(_all_round(final, 0.0, inf)) if self.goal_speed == self.alpha else ()
        # the way round is the difference of two times, one for each contact: so each may be
        # looked at with its own, and much more closely than both together

        @lru_cache(_REMEMBERED)
        def round_from(cell: Cell, way: int) -> float:
            def bound(part: Cell) -> float:
                edge = part.bearing + (1.0 - 2.0 * way) * part.half
                return reached(part)[0] - (1.0 - 2.0 * way) * round_time(table, way, edge)

            return self.least(cell, bound)

        @lru_cache(_REMEMBERED)
        def round_to(cell: Cell, way: int) -> float:
            def bound(part: Cell) -> float:
                edge = part.bearing - (1.0 - 2.0 * way) * part.half
                return left(part) + (1.0 - 2.0 * way) * round_time(table, way, edge)

            return self.least(cell, bound)

        def round_trip(first: Cell, last: Cell, way: int) -> float:
            behind = (1.0 - 2.0 * way) * (first.bearing - last.bearing) >= first.half + last.half
            whole = float(table[way, -1]) * (behind - 2.0 * _SLACK)
            return float(round_from(first, way) + round_to(last, way) + whole)

        branches: list[_Branch] = []
        numbers = count()

        def add(first: Cell, last: Cell | None, least: float) -> None:
            soon, onward = reached(first)
            if soon == inf:
                return
            if last is None:
                bound = soon + onward
            else:
                leaving = left(last)
                bound = soon + leaving + self.between(first, last, table, beat - soon - leaving)
            bound = max(bound, least, self.t_release)
            if bound < beat:
                heappush(branches, (bound, next(numbers), first, last, False))

        for cell in self.first_contacts():
            add(cell, None, 0.0)
        while branches and len(branches) < MAX_BRANCHES:
            bound, _, first, last, eased = heappop(branches)
            yield bound
            if max(first.half, last.half if last else 0.0) < _SMALLEST:
                return
            if last is None and first.piece == final and last_contacts:
                # a way on that breaks the limit is none: then there is a last contact too
                if left(first) > reached(first)[1] + _SMALLEST:
                    for cell in last_contacts:
                        add(first, cell, bound)
                    continue
            if last is not None and max(first.half, last.half) < _EASED and not eased:
                closer = min(round_trip(first, last, way) for way in (0, 1))
                if bound < closer:
                    if closer < beat:
                        heappush(branches, (closer, next(numbers), first, last, True))
                    continue
            if last is not None and last.half >= first.half:
                for half in last.halves(self.delta):
                    add(first, half, bound)
            else:
                for half in first.halves(self.delta):
                    add(half, last, bound)
        if not branches:
            yield beat


def _all_round(piece: int, start: float, end: float) -> Iterator[Cell]:
    """Cells for all bearings and both sides; none may reach into two quadrants."""
    width = 0.5 * pi / _QUADRANT_CELLS
    for k in range(4 * _QUADRANT_CELLS):
        for side in (1.0, -1.0):
            yield Cell(piece, side, (k + 0.5) * width - pi, 0.5 * width, start, end)
