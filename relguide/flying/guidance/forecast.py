"""The closed loop flown ahead from now, without planning: what will really be flown.

It is the promise (when it joins, braking included), the separation that is kept, the tube round the
ideal path, and the path to be drawn.
"""

from math import hypot, inf
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.ahead import AT, LEAST, NEVER, RIGHT, fly_ahead
from relguide.kernels.flight.flight_records import Body, Drift
from relguide.kernels.flight.guide import Course, Progress
from relguide.kernels.flight.path import lay_path
from relguide.planning.heights import ALWAYS, time_to_level
from relguide.units import DEG, Metre, Radian, Second

STEPS = 4
"""Of a second, in a forecast: within 10 m of 20 a second."""
BENT: Radian = 3.0 * DEG
"""Rows that draw a path are no farther apart in heading: their chord strays by 4 m [rad]."""
STRAIGHT_FOR = 30
"""… nor than this in time [s]."""
FOLLOWED: Second = 150.0
"""How long a forecast goes on once it has joined [s]."""
SOUGHT: Second = 3_600.0
"""By then it is at its leader's level, if what is declared does not lead there sooner [s]."""
NO_COURSE = Course(
    lay_path(0.0, 0.0, 0.0, np.zeros((0, 2)), 1.0, 0.0, 1.0), 0.0, 0.0, 0.0, Drift(0.0, 0.0), NEVER
)
"""Where no path is committed."""


class Forecast(NamedTuple):
    """A flight ahead."""

    t: Second
    """Flight time at which it begins [s]."""
    own: FloatArray
    """The pursuer each second, the present first. shape (n + 1, 7), as `Body`"""
    leader: FloatArray
    """The leader at the same times."""
    account: FloatArray
    """What happens in each second. shape (n, 6), as in `kernels/flight/ahead.py`"""
    suffix: FloatArray
    """Least separation from each second to the end [m]. shape (n,)"""
    join_time: Second
    """When it joins, flight time [s]; `NEVER` if it does not."""

    @property
    def joins(self) -> bool:
        """Whether it joins."""
        return self.join_time != NEVER

    @property
    def until(self) -> Second:
        """Flight time of its end [s]."""
        return self.t + len(self.account)

    @property
    def tube(self) -> Metre:
        """Its largest distance from the ideal path [m]."""
        return float(np.max(np.abs(self.account[:, RIGHT]), initial=0.0))

    def least(self, t: Second, within: Second = inf) -> tuple[Metre, Second]:
        """Least separation from flight time t on, and when; infinite if it has ended.

        Args:
            t: flight time [s].
            within: how far to look [s].
        """
        first = max(int(t - self.t), 0)
        rows = self.account[first : first + int(min(within, 1e6))]
        if not len(rows):
            return inf, t
        k = int(np.argmin(rows[:, LEAST]))
        return float(rows[k, LEAST]), float(rows[k, AT])

    def breaks(self, t: Second, limit: Metre) -> Second:
        """From when on after flight time t it is below a separation, flight time; else infinite."""
        first = max(int(t - self.t), 0)
        below = np.flatnonzero(self.account[first:, LEAST] < limit)
        return self.t + first + float(below[0]) if len(below) else inf

    def nearest(self, t: Second) -> Metre:
        """The same, and where height keeps them apart all the while, the distance all the same."""
        least, _ = self.least(t)
        if least < inf:
            return least
        first = max(int(t - self.t), 0)
        apart = np.hypot(*(self.own[first:, :2] - self.leader[first:, :2]).T)
        return float(np.min(apart, initial=inf))

    def rest(self, t: Second) -> Metre:
        """Least separation from flight time t [s] to its end [m]; infinite if it has ended."""
        k = int(t - self.t)
        return float(self.suffix[k]) if 0 <= k < len(self.suffix) else inf

    def row(self, t: Second) -> int:
        """The row of flight time t [s]; −1 if it is not covered."""
        k = round(t - self.t)
        return k if 0 <= k < len(self.own) else -1

    def own_off(self, t: Second, own: Body) -> Metre:
        """How far the pursuer is from where it was to be [m]; infinite if nothing is known."""
        k = self.row(t)
        if k < 0:
            return inf
        x, y = self.own[k, :2].tolist()
        return hypot(x - own.x, y - own.y)

    def leader_off(self, t: Second, leader: Body) -> tuple[Metre, float, float]:
        """Distance [m], heading [rad] and speed [m/s] by which the leader is not as expected."""
        k = self.row(t)
        if k < 0:
            return inf, inf, inf
        x, y, heading, _, _, tas, _ = self.leader[k].tolist()
        return (
            hypot(x - leader.x, y - leader.y),
            abs(wrap_signed(heading - leader.heading)),
            abs(tas - leader.tas),
        )


def forecast(
    belief: Belief,
    assignment: Assignment,
    progress: Progress,
    course: Course,
    *,
    until: Second,
    turns_on: bool = False,
    leader_tas: float | None = None,
) -> Forecast:
    """Fly on as guidance would, without planning.

    Args:
        belief: where all begin, and what the leader is expected to do.
        assignment: what the pursuer was asked to do.
        progress: how far guidance has come: its mode above all.
        course: the committed path; `NO_COURSE` if there is none.
        until: flight time of its end at the latest [s].
        turns_on: whether a leader that turns unannounced goes on turning for half a turn.
        leader_tas: the speed that the leader goes for [m/s]; what is expected, if left out.
    """
    program, cursor, held = belief.program, belief.cursor, belief.held
    if not belief.intent_known:
        program, cursor, held = _expected_program(belief, turns_on)
    own, leader, account, join_time = fly_ahead(
        progress, belief.own, belief.limits, course, belief.track.marks, belief.leader,
        belief.leader_limits, program, cursor, held,
        belief.leader_tas if leader_tas is None else leader_tas,
        belief.last_turn, assignment.task, assignment.gate, assignment.gains, belief.drift,
        belief.t, max(int(until - belief.t), 1), int(FOLLOWED), STEPS,
    )  # fmt: skip
    if belief.counts != ALWAYS:
        _leave_out(account, belief)
    if join_time != NEVER and not belief.at_level:
        since = max(join_time - belief.t, 0.0)
        level = time_to_level(belief.own_heights, belief.leader_heights, since)
        join_time = belief.t + min(level, max(since, SOUGHT))
    suffix = np.minimum.accumulate(account[::-1, LEAST])[::-1]
    return Forecast(belief.t, own, leader, account, suffix, join_time)


def _leave_out(account: FloatArray, belief: Belief) -> None:
    """Separations in seconds in which height keeps both aircraft apart do not count."""
    since = np.arange(len(account))
    counts = np.zeros(len(account), dtype=bool)
    for begin, end in belief.counts:
        counts |= (since + 1.0 >= begin) & (since <= end)
    account[~counts, LEAST] = inf


def rows_to_draw(rows: FloatArray) -> list[int]:
    """Which rows draw a path flown ahead: of its turns point by point, of its straights the ends.

    Args:
        rows: a second apart. shape (n, 7), as `Body`
    """
    headings: list[float] = rows[:, 2].tolist()
    kept, last = [0], 0
    for k in range(1, len(headings) - 1):
        if abs(headings[k] - headings[last]) > BENT or k - last >= STRAIGHT_FOR:
            kept.append(k)
            last = k
    kept.append(len(headings) - 1)
    return kept


def _expected_program(belief: Belief, turns_on: bool) -> tuple[FloatArray, int, float]:
    """Straight on as soon as it has rolled out; or half a turn more, as it turns now."""
    if not turns_on:
        return np.zeros((0, 3)), 0, belief.leader_rolled_out
    side = 1.0 if belief.leader.bank > 0.0 else -1.0
    target = belief.leader.heading + side * np.pi
    return np.array([[1.0, target, belief.leader.bank]]), 0, belief.leader.heading
