"""Staying clear of the leader without a plan: a heading, and how much separation it keeps.

Plans assume that a leader that turns unannounced stops turning now, as nothing else is known. But
it may go on, or slow down, and what keeps d_min if it does not may leave no way out if it does. So
while it does such things an escape is kept in sight: a turn and a straight, begun a second later,
that keep d_min wherever the leader's turn ends.
"""

from math import inf
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import NO_COURSE, forecast
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.motion import Motion
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.kernels.flight.program import roll_lead
from relguide.kernels.separation import least_bad_turn as kernel
from relguide.kernels.separation.approach import least_separation
from relguide.planning.tables import motion_of
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

ENDS_EVERY: Radian = 30.0 * DEG
"""A leader's turn that ends between two of these is little worse [rad]."""
TURNS_ON: Radian = 180.0 * DEG
"""A leader that turned farther would fly back to where it came from [rad]."""
TRIED_EVERY: Radian = 10.0 * DEG
"""Headings that are flown ahead are so far apart [rad]."""
HEADINGS = 36
"""So many are tried, to both sides by turns."""
FAINT: Radian = 2.0 * DEG
"""An escape's heading is found to 10°; smaller differences do not count [rad]."""


class Escape(NamedTuple):
    """A heading to fly, and the separation it keeps."""

    heading: Radian
    """Clockwise from north [rad]."""
    least_separation: Metre
    """Least separation over all that the leader may do [m]."""
    tas: MetrePerSecond
    """The speed to go for [m/s]."""


def escape(
    belief: Belief,
    assignment: Assignment,
    min_separation: Metre,
    *,
    turns_on: bool = False,
    other_tas: MetrePerSecond | None = None,
    delay: Second = 0.0,
) -> Escape:
    """The heading nearest to the present one that keeps clear for `look_out` seconds.

    If no heading does, the one that stays farthest away.

    Args:
        belief: both aircraft, and the intent as far as it is known.
        assignment: the bank and how far to look.
        min_separation: to be kept [m].
        turns_on: whether the leader's present turn may go on for as much as 180° more.
        other_tas: a speed that the leader may come to [m/s]; as it flies now, if left out.
        delay: how long the pursuer goes on as it does before it turns [s].
    """
    own, bank = belief.own, assignment.planned_bank
    rate, full = turn_rate(own.tas, own.bank), turn_rate(own.tas, bank)
    before = np.array(
        [
            (delay + roll_lead(belief.limits, own.bank, side * bank), rate)
            for side in (-1.0, 0.0, 1.0)
        ]
    )
    best = Escape(own.heading, inf, own.tas)
    for leader in _leaders(belief, other_tas):
        side, angle, least = kernel.escape_path(
            _motion(belief), full, before, leader, _pieces(belief, leader, turns_on=turns_on),
            min_separation, assignment.settings.look_out,
        )  # fmt: skip
        turned = before[side + 1, 0] * rate + side * angle
        if least < best.least_separation:
            best = Escape(wrap(own.heading + turned), least, own.tas)
    return best


def flown_escape(
    belief: Belief, assignment: Assignment, min_separation: Metre, at_least: Metre
) -> Escape | None:
    """A heading and a speed that keep clear if flown as the aircraft flies, with all its bank.

    Rolling and braking are flown ahead, so it finds what a turn at constant speed does not keep. Of
    those that keep clear, the one nearest to the present heading that keeps its speed.

    Args:
        belief: both aircraft; the leader flies as is expected of it.
        assignment: what was asked.
        min_separation: to be kept [m].
        at_least: what another must keep to be better than nothing [m].

    Returns:
        `None` if none keeps `at_least`.
    """
    own, best = belief.own, None
    for tas in (own.tas, belief.limits.min_tas):
        for k in range(HEADINGS):
            turned = TRIED_EVERY * ((k + 1) // 2) * (1.0 if k % 2 else -1.0)
            heading = own.heading + turned
            least = separation_flown(belief, assignment, heading, tas)
            if least >= min_separation:
                return Escape(wrap(heading), least, tas)
            if least > (at_least if best is None else best.least_separation):
                best = Escape(wrap(heading), least, tas)
    return best


def separation_flown(
    belief: Belief, assignment: Assignment, heading: Radian, tas: MetrePerSecond
) -> Metre:
    """The least separation on a heading at a speed, flown ahead with its roll and braking [m]."""
    holding = Progress(HOLD, 0.0, heading, tas)
    until = belief.t + assignment.settings.look_out
    ahead = forecast(belief, assignment, holding, NO_COURSE, until=until)
    return ahead.least(belief.t)[0]


def separation_on_heading(
    belief: Belief,
    assignment: Assignment,
    heading: Radian,
    *,
    turns_on: bool = False,
    other_tas: MetrePerSecond | None = None,
) -> Metre:
    """The least separation if the pursuer turns the shorter way to a heading and keeps it [m]."""
    own, bank = belief.own, assignment.planned_bank
    turn = wrap_signed(heading - own.heading)
    side = 1.0 if turn > 0.0 else -1.0
    full = turn_rate(own.tas, bank)
    roll = roll_lead(belief.limits, own.bank, side * bank) if abs(turn) > FAINT else 0.0
    pieces = np.array([(roll, turn_rate(own.tas, own.bank)), (abs(turn) / full, side * full)])
    ours = _motion(belief)._replace(pieces=pieces)
    look_out = assignment.settings.look_out
    return float(
        min(
            least_separation(ours, leader._replace(pieces=rows), 0.0, look_out, 1.0)[0]
            for leader in _leaders(belief, other_tas)
            for rows in _pieces(belief, leader, turns_on=turns_on)
        )
    )


def _motion(belief: Belief) -> Motion:
    own = belief.own
    return Motion(own.x, own.y, own.heading, own.tas, np.zeros((1, 2)))


def _leaders(belief: Belief, other_tas: MetrePerSecond | None) -> tuple[Motion, ...]:
    """The leader at its speed, and at the one that it may come to."""
    leader = motion_of(belief.leader_after(0.0).trajectory)
    if other_tas is not None:
        return leader, leader._replace(tas=max(other_tas, 1.0))
    return (leader,)


def _pieces(belief: Belief, leader: Motion, *, turns_on: bool) -> FloatArray:
    """Pieces of all that the leader may do: its declared intent, or a turn that goes on."""
    known, rate = leader.pieces, belief.leader_turn_rate
    ends = np.arange(ENDS_EVERY, TURNS_ON + 0.5 * ENDS_EVERY, ENDS_EVERY) if turns_on else ()
    pieces = np.zeros((1 + len(ends), max(len(known), 1), 2))
    pieces[0, : len(known)] = known
    for i, end in enumerate(ends, start=1):
        pieces[i, 0] = end / max(abs(rate), 1e-6), rate
    return pieces
