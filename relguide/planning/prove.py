"""prove(plan, seconds=…): a better lower bound of the time, for a plan that d_min made longer.

A path that keeps d_min either never touches it, and is then an extremal without the limit that keeps
it, or there is a first contact. So no path arrives before the fastest such extremal and the least,
over all contacts, of the soonest arrival at the contact and the soonest way on from it. Contacts are
put into cells, of bearing and time, for which that is bounded at once (`kernels/contact_bound.py`);
the cell with the least bound is halved again and again. The least of all is proved, at any moment.

If the slot could be reached before it opens, arriving the moment it opens is a case of its own, in
which no path need be an extremal: it is ruled out, if it can be, by the shortest way to the slot's
place then, which is a search of the same kind.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from heapq import heapify, heappop, heappush
from math import inf, isfinite, pi
from time import perf_counter

import numpy as np

from relguide.kernels.contact_bound import cell_bound, untouched_bound
from relguide.planning.detour import leader_table
from relguide.planning.plan import Optimality, Plan
from relguide.planning.slot import slot_frame
from relguide.planning.words import candidates
from relguide.units import Second

MAX_SECONDS: Second = 3_600.0
"""Longest accepted time to prove in [s]."""
TOLERANCE: Second = 1e-3
"""A gap this small ends the proof [s]: it is less than rolling into one turn takes by far."""
MAX_CELLS = 400_000
"""Most cells kept, some 100 MB; the proof ends there."""
_SMALLEST = 1e-10  # a cell no wider than this is not halved: rounding counts for more [rad]
_REPORT: Second = 0.05  # from one report to the next
_QUADRANT_CELLS = 2
"""Cells a quadrant is cut into at first; none may reach into two."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """What is proved of a plan's time so far."""

    elapsed: Second
    """Since the proof began [s]."""
    lower_bound: Second
    """No plan that keeps d_min is faster than this [s]."""
    gap: Second
    """How much slower the plan is [s]."""


@dataclass(frozen=True, slots=True, order=True)
class _Cell:
    """Contacts: a window of bearings, and of time, on one piece of the leader's intent and a side.

    Lengths in R, times in R/V_P. Cells are ordered by their bounds.
    """

    bound: float
    piece: int
    side: float
    bearing: float
    half: float
    start: float
    end: float

    def halves(self, delta: float) -> "tuple[_Cell, _Cell] | None":
        """Its two halves, across the longer side; None if it is too small for that."""
        span = 0.5 * (self.end - self.start)
        if inf > span > (delta + 1.0) * self.half:
            middle = self.start + span
            return replace(self, end=middle), replace(self, start=middle)
        if self.half < _SMALLEST:
            return None
        half = 0.5 * self.half
        return (
            replace(self, bearing=self.bearing - half, half=half),
            replace(self, bearing=self.bearing + half, half=half),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Question:
    """How soon can a path that keeps d_min be at a goal? In the slot frame."""

    start: tuple[float, float, float]
    leader: np.ndarray
    alpha: float
    delta: float
    goal_x: float
    goal_speed: float
    t_open: float
    horizon: float
    """Contacts after this time do not matter [R/V_P]."""

    def cells(self) -> Iterator[_Cell]:
        """All contacts there are, in cells."""
        for i, start in enumerate(self.leader[:, 0].tolist()):
            end = self.leader[i + 1, 0].item() if i + 1 < len(self.leader) else inf
            # until the slot opens a contact leaves so much time, and after that any
            windows = ((start, self.t_open), (self.t_open, inf))
            for low, high in windows if start < self.t_open < end == inf else ((start, end),):
                high = min(high, self.horizon)
                if high <= low and low > 0.0:
                    continue
                width = 0.5 * pi / _QUADRANT_CELLS
                for k in range(4 * _QUADRANT_CELLS):
                    for side in (1.0, -1.0):
                        yield _Cell(0.0, i, side, (k + 0.5) * width - pi, 0.5 * width, low, high)

    def untouched(self) -> float:
        """No path that nowhere touches d_min arrives sooner."""
        return untouched_bound(
            *self.start, self.leader, self.alpha, self.delta, self.goal_x, self.goal_speed,
            self.t_open,
        )  # fmt: skip

    def bound(self, cell: _Cell, beat: float) -> float:
        """No path whose first contact is in the cell arrives sooner; infinite if not before `beat`."""
        return cell_bound(
            *self.start, self.leader, cell.piece, self.alpha, self.delta, self.goal_x,
            self.goal_speed, self.t_open, cell.side, cell.bearing, cell.half, cell.start, cell.end,
            beat,
        )  # fmt: skip

    def bounds(self, beat: float) -> Iterator[float]:
        """Ever better bounds of the time of all paths, up to `beat`, where they end."""
        beat = min(beat, self.untouched())
        cells: list[_Cell] = []
        for cell in self.cells():
            bound = self.bound(cell, beat)
            if bound < beat:
                cells.append(replace(cell, bound=bound))
        heapify(cells)
        while cells and len(cells) < MAX_CELLS:
            least = heappop(cells)
            yield least.bound
            halves = least.halves(self.delta)
            if halves is None:
                return
            for half in halves:
                bound = max(self.bound(half, beat), least.bound)
                if bound < beat:
                    heappush(cells, replace(half, bound=bound))
        if not cells:
            yield beat


def prove(
    plan: Plan,
    *,
    seconds: Second,
    progress: Callable[[Iterator[Bound]], Iterable[Bound]] = iter,
) -> Plan:
    """The plan with a better lower bound of the time: the more time, the better.

    A plan that is proved optimal already comes back as it is. One whose bound comes within
    `TOLERANCE` of its time does so as soon as that is known.

    Args:
        plan: made by any planner.
        seconds: how long to go on at most, 0 to `MAX_SECONDS` [s]; loading the kernels not counted.
        progress: passes the reports through, to show them.

    Raises:
        ValueError: if `seconds` is not such a time.
    """
    check_seconds(seconds)
    if plan.optimality.proof == "relaxation" or plan.situation.min_separation == 0.0:
        return plan
    lower_bound = plan.optimality.lower_bound
    for bound in progress(bounds(plan, seconds=seconds)):
        lower_bound = bound.lower_bound
    return replace(plan, optimality=Optimality(proof="bound", lower_bound=lower_bound))


def check_seconds(seconds: Second) -> None:
    """Refuse a time that no proof may take.

    Raises:
        ValueError: saying which ones may be.
    """
    if not (isfinite(seconds) and 0.0 <= seconds <= MAX_SECONDS):
        raise ValueError(
            f"The time for a proof must be between 0 and {MAX_SECONDS:.0f} s, not {seconds} s."
        )


def bounds(plan: Plan, *, seconds: Second) -> Iterator[Bound]:
    """Reports on the way to a better bound, some twenty a second, none worse than the last."""
    frame = slot_frame(plan.situation, plan.situation.leader.trajectory)
    scale = frame.radius / plan.situation.pursuer.tas
    time = plan.time_to_converge
    best = min(plan.optimality.lower_bound, time)
    yield Bound(elapsed=0.0, lower_bound=best, gap=time - best)
    steps = _steps(plan, time / scale)
    next(steps)  # loads the kernels
    started = reported = perf_counter()
    for proved in steps:
        now = perf_counter()
        if now - started > seconds:
            break
        best = min(max(best, proved * scale), time)
        if time - best <= TOLERANCE:
            break
        if now - reported > _REPORT:
            reported = now
            yield Bound(elapsed=now - started, lower_bound=best, gap=time - best)
    yield Bound(elapsed=perf_counter() - started, lower_bound=best, gap=time - best)


def _steps(plan: Plan, time: float) -> Iterator[float]:
    """Bounds of the plan's time [R/V_P], in ever new rounds until there are no better ones."""
    situation = plan.situation
    found = candidates(situation)
    frame = found.frame
    slot = _Question(
        start=(frame.x, frame.y, frame.h),
        leader=leader_table(situation, frame),
        alpha=frame.alpha,
        delta=situation.min_separation / frame.radius,
        goal_x=0.0,
        goal_speed=frame.alpha,
        t_open=frame.t_open,
        horizon=inf,
    )
    slot.bound(next(slot.cells()), slot.untouched())
    yield 0.0
    if found.reachable_at_opening:
        place = replace(
            slot, goal_x=frame.alpha * frame.t_open, goal_speed=0.0, t_open=0.0,
            horizon=frame.t_open,
        )  # fmt: skip
        after = frame.t_open * (1.0 + _SMALLEST)
        shortest = 0.0
        for shortest in place.bounds(after):
            yield min(shortest, frame.t_open)
        if shortest < after:
            return
    yield from slot.bounds(time)
