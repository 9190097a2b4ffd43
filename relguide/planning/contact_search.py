"""The least time of all paths that touch d = d_min or keep clear, by halving cells of contacts.

A path that keeps d_min either never touches it, and is then an extremal without the limit that
keeps it, or it has a first contact, and a last one. So none arrives before the fastest such
extremal and the least, over all contacts, of the soonest arrival at the contact and the soonest way
on from there. If that way on breaks the limit, there is another contact, and the last of them
counts too. Contacts are put into cells, of bearing and time, for which all this is bounded at once
(`kernels/bounds/contact_bound.py`). The paths with the least bound are halved again and again: that
bound is proved, at any moment.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from heapq import heappop, heappush
from itertools import count
from math import inf, pi
from typing import NamedTuple

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.contact_bound import (
    Cell,
    Goal,
    round_time,
    times_round,
    untouched_bound,
)
from relguide.kernels.bounds.proof_bounds import join_cells, leave_cell, question_row, reach_cell

MAX_BUNDLES = 400_000
"""Most bundles of paths kept, some 100 MB; the search ends there."""
_SMALLEST = 1e-10  # a cell no wider than this is not halved: rounding counts for more [rad]
_REMEMBERED = 65_536  # cells whose bounds are kept at hand, for the bundles that share them
_EASED = 0.03  # cells narrower than this are looked at closely [rad]
_CLOSELY = 50  # times a cell is halved to find what is least in it
_NARROW = 1e-6  # and how narrow its parts may become: what is left counts for some 1e-5 R/V_P [rad]
_SLACK = 1e-6  # of `round_time`, as part of a whole round
_QUADRANT_CELLS = 2
"""Cells a quadrant is cut into at first; none may reach into two."""


class _Bundle(NamedTuple):
    """Paths, by how soon they can arrive."""

    bound: float
    """None arrives before [R/V_P]."""
    number: int
    """Tells bundles apart."""
    first: Cell
    """Of their first contact."""
    last: Cell | None
    """Of their last one, if it is of the final leg and matters."""
    eased: bool
    """Whether the time round the disc between the two was looked at closely."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """How soon can a path that keeps d_min be at a goal? In the slot frame."""

    start: Pose
    scene: Scene
    """With t_release the time before which arrivals do not count."""
    goal: Goal
    never_at_release: bool
    """Whether no path at all can be at the goal the moment t_release: who is not too early is late.
    """
    horizon: float
    """Contacts after this time do not matter [R/V_P]."""

    def first_contacts(self) -> Iterator[Cell]:
        """All contacts there are, in cells."""
        leader, t_release = self.scene.leader, self.scene.t_release
        for i, start in enumerate(leader[:, 0].tolist()):
            end = leader[i + 1, 0].item() if i + 1 < len(leader) else inf
            # until the slot opens a contact leaves so much time, and after that any
            windows = ((start, t_release), (t_release, inf))
            for low, high in windows if start < t_release < end == inf else ((start, end),):
                high = min(high, self.horizon)
                if low < high or low == 0.0:
                    yield from _all_cells(i, low, high)

    def last_contacts(self) -> tuple[Cell, ...]:
        """All contacts of the final leg from which the slot is reached, in cells."""
        if self.goal.speed != self.scene.alpha:
            return ()
        return tuple(_all_cells(len(self.scene.leader) - 1, 0.0, inf))

    def warm_up(self) -> None:
        """Load the kernels."""
        cell = next(self.first_contacts())[:]
        untouched_bound(self.start, self.scene, self.goal, 0.0)
        asked, leader = question_row(self.start, self.scene, self.goal), self.scene.leader
        reach_cell(asked, leader, cell, 0.0)
        leave_cell(asked, leader, cell, 0.0)
        table = times_round(self.scene.alpha, self.scene.d_min)
        round_time(table, 0, 0.0)
        join_cells(asked, leader, table, cell, cell, 0.0)

    def bounds(self, beat: float) -> Iterator[float]:
        """Ever better bounds of the time of all paths, up to `beat`, where they end."""
        # no path that nowhere touches d_min arrives sooner than the first of these
        beat = untouched_bound(self.start, self.scene, self.goal, beat)
        yield from _Search(self, beat).bounds()


class _Search:
    """The bundles of paths that may arrive before `beat`, the soonest first."""

    def __init__(self, question: Question, beat: float) -> None:
        scene = question.scene
        self.beat = beat
        self.question = question
        self.scene = scene
        self.final = len(scene.leader) - 1
        self.table = times_round(scene.alpha, scene.d_min)
        self.last_contacts = question.last_contacts()
        self.bundles: list[_Bundle] = []
        self.numbers = count()
        late = scene if question.never_at_release else scene._replace(t_release=0.0)
        self.asked = asked = question_row(question.start, late, question.goal)
        leader = scene.leader

        @lru_cache(_REMEMBERED)
        def reach(cell: Cell) -> tuple[float, float]:
            return reach_cell(asked, leader, cell[:], beat)

        @lru_cache(_REMEMBERED)
        def leave(cell: Cell) -> float:
            return leave_cell(asked, leader, cell[:], beat)

        self.reach = reach
        """How soon a first contact can be in the cell, and the goal from there."""
        self.leave = leave
        """How soon the slot can be reached from a last contact in the cell, on the final leg."""
        self.round_from = lru_cache(_REMEMBERED)(self._round_from)
        self.round_to = lru_cache(_REMEMBERED)(self._round_to)

    def bounds(self) -> Iterator[float]:
        """Ever better bounds, up to `beat`."""
        for cell in self.question.first_contacts():
            self.add(cell, None, 0.0)
        while self.bundles and len(self.bundles) < MAX_BUNDLES:
            bundle = heappop(self.bundles)
            yield bundle.bound
            if max(bundle.first.half, bundle.last.half if bundle.last else 0.0) < _SMALLEST:
                return
            if self.needs_last_contact(bundle):
                for cell in self.last_contacts:
                    self.add(bundle.first, cell, bundle.bound)
            elif not self.ease(bundle):
                self.halve(bundle)
        if not self.bundles:
            yield self.beat

    def add(self, first: Cell, last: Cell | None, least: float) -> None:
        """Keep the paths through these cells, known to arrive no sooner than `least`."""
        soon, onward = self.reach(first)
        if soon == inf:
            return
        if last is None:
            bound = soon + onward
        else:
            leaving = self.leave(last)
            asked, leader, left = self.asked, self.scene.leader, self.beat - soon - leaving
            between = join_cells(asked, leader, self.table, first[:], last[:], left)
            bound = soon + leaving + between
        bound = max(bound, least, self.scene.t_release)
        if bound < self.beat:
            heappush(self.bundles, _Bundle(bound, next(self.numbers), first, last, eased=False))

    def needs_last_contact(self, bundle: _Bundle) -> bool:
        """Whether what follows the first contact breaks the limit, so that there is a last one."""
        first, last = bundle.first, bundle.last
        if last is not None or first.piece != self.final or not self.last_contacts:
            return False
        return self.leave(first) > self.reach(first)[1] + _SMALLEST

    def ease(self, bundle: _Bundle) -> bool:
        """Look closely at the time round the disc; whether that was better than the bound."""
        first, last = bundle.first, bundle.last
        if last is None or bundle.eased or max(first.half, last.half) >= _EASED:
            return False
        closer = min(self.round_trip(first, last, way) for way in (0, 1))
        if bundle.bound >= closer:
            return False
        if closer < self.beat:
            heappush(self.bundles, _Bundle(closer, next(self.numbers), first, last, eased=True))
        return True

    def halve(self, bundle: _Bundle) -> None:
        """Keep both halves of the wider cell."""
        first, last, d_min = bundle.first, bundle.last, self.scene.d_min
        if last is not None and last.half >= first.half:
            for half in halves(last, d_min):
                self.add(first, half, bundle.bound)
        else:
            for half in halves(first, d_min):
                self.add(half, last, bundle.bound)

    # the time round is the difference of two times, one for each contact: so each may be looked at
    # with its own, and much more closely than both together

    def round_trip(self, first: Cell, last: Cell, way: int) -> float:
        """How soon paths that go round this way, 0 counter-clockwise or 1 clockwise, can arrive."""
        behind = (1.0 - 2.0 * way) * (first.bearing - last.bearing) >= first.half + last.half
        whole = float(self.table[way, -1]) * (behind - 2.0 * _SLACK)
        return self.round_from(first, way) + self.round_to(last, way) + whole

    def _round_from(self, cell: Cell, way: int) -> float:
        sense = 1.0 - 2.0 * way

        def bound(part: Cell) -> float:
            edge = part.bearing + sense * part.half
            return float(self.reach(part)[0] - sense * round_time(self.table, way, edge))

        return self.least(cell, bound)

    def _round_to(self, cell: Cell, way: int) -> float:
        sense = 1.0 - 2.0 * way

        def bound(part: Cell) -> float:
            edge = part.bearing - sense * part.half
            return float(self.leave(part) + sense * round_time(self.table, way, edge))

        return self.least(cell, bound)

    def least(self, cell: Cell, bound: Callable[[Cell], float]) -> float:
        """The least that a bound comes to in a cell, looked at closely."""
        numbers = count()
        parts = [(bound(cell), next(numbers), cell)]
        for _ in range(_CLOSELY):
            if parts[0][0] == inf or parts[0][2].half < _NARROW:
                break
            for half in halves(heappop(parts)[2], self.scene.d_min):
                heappush(parts, (bound(half), next(numbers), half))
        return parts[0][0]


def halves(cell: Cell, d_min: float) -> tuple[Cell, Cell]:
    """The two halves of a cell, across the longer side."""
    piece, side, bearing, half, start, end = cell
    span = 0.5 * (end - start)
    if inf > span > (d_min + 1.0) * half:
        middle = start + span
        return (
            Cell(piece, side, bearing, half, start, middle),
            Cell(piece, side, bearing, half, middle, end),
        )
    half *= 0.5
    return (
        Cell(piece, side, bearing - half, half, start, end),
        Cell(piece, side, bearing + half, half, start, end),
    )


def _all_cells(piece: int, start: float, end: float) -> Iterator[Cell]:
    """Cells for all bearings and both sides; none may reach into two quadrants."""
    width = 0.5 * pi / _QUADRANT_CELLS
    for k in range(4 * _QUADRANT_CELLS):
        for side in (1.0, -1.0):
            yield Cell(piece, side, (k + 0.5) * width - pi, 0.5 * width, start, end)
