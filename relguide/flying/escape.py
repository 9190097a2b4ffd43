"""Staying clear of the leader without a plan: an escape path, and how much separation it keeps.

Plans assume that a leader that turns unannounced stops turning now, as nothing else is known. But
it may go on, and a plan that keeps d_min if it stops may leave no way out if it does not. So while
it turns an escape path is kept: a turn and a straight, begun a second later, that keep d_min
wherever the leader's turn ends.
"""

from typing import NamedTuple

import numpy as np

from relguide.flying.aircraft import AircraftModel, roll_lead
from relguide.flying.capture import Offsets
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.separation import least_bad_turn as kernel
from relguide.planning.certificate import certify
from relguide.planning.situation import Situation
from relguide.planning.tables import motion_of
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.units import DEG, Metre, Radian, RadianPerSecond, Second

LOOK_AHEAD: Second = 180.0  # DAIDALUS looks as far; a half turn at 240 m/s and 25° takes 165 s
ON_ROUTE: Radian = 15.0 * DEG  # so aligned, speed alone keeps the spacing
ENDS_EVERY: Radian = 30.0 * DEG  # a turn that ends between two of these is little worse
TURNS_ON: Radian = 180.0 * DEG  # a leader that turned farther would fly back to where it came from


class EscapePath(NamedTuple):
    """A heading to fly, and the separation it keeps."""

    heading: Radian
    """Clockwise from north [rad]."""
    least_separation: Metre
    """Least separation over all that the leader may do [m]."""


def escape_path(
    situation: Situation,
    *,
    bank: Radian,
    model: AircraftModel,
    min_separation: Metre,
    leader_turn_rate: RadianPerSecond = 0.0,
    delay: Second = 0.0,
) -> EscapePath:
    """The heading nearest to the present one that keeps clear for three minutes.

    If no heading does, the one that stays farthest away.

    Args:
        situation: gives both aircraft, and the intent as far as it is known.
        bank: of the pursuer [rad]: its turn begins when it has rolled.
        model: how it rolls.
        min_separation: to be kept [m]; more than the situation's own where there is a buffer.
        leader_turn_rate: of a turn that may go on for as much as 180° more [rad/s]; 0 if there is
            none.
        delay: how long the pursuer goes on as it does before it turns [s].
    """
    pursuer = situation.pursuer
    rate, full = turn_rate(pursuer.tas, bank), pursuer.tas / pursuer.turn_radius
    before = np.array(
        [
            (delay + roll_lead(model, bank, side * pursuer.max_bank), rate)
            for side in (-1.0, 0.0, 1.0)
        ]
    )
    side, angle, least = kernel.escape_path(
        motion_of(pursuer.flying(())),
        full,
        before,
        motion_of(situation.leader.trajectory),
        _leader_pieces(situation, leader_turn_rate),
        min_separation,
        LOOK_AHEAD,
    )
    turned = before[side + 1, 0] * rate + side * angle
    return EscapePath(heading=wrap(pursuer.heading + turned), least_separation=least)


def keeps_clear(seen: Offsets, to_slot: Metre, situation: Situation) -> bool:
    """Whether the turn onto the route, and the flight on to the slot, keep d_min.

    On the route itself too little spacing is corrected by speed, not by another path.
    """
    if abs(seen.heading) < ON_ROUTE:
        return True
    turn = RIGHT if seen.heading < 0.0 else LEFT
    arc = Arc(turn=turn, turn_angle=abs(seen.heading), radius=situation.pursuer.turn_radius)
    closing = situation.pursuer.tas - situation.leader.tas
    until = to_slot / closing if closing > 0.0 and to_slot > 0.0 else 0.0
    return certify(_turn_and_straight(situation, arc, min(until, LOOK_AHEAD)), situation).holds


def _leader_pieces(situation: Situation, rate: RadianPerSecond) -> np.ndarray:
    """Pieces of all that the leader may do: its declared intent, or a turn that goes on."""
    known = motion_of(situation.leader.trajectory).pieces
    ends = np.arange(ENDS_EVERY, TURNS_ON + 0.5 * ENDS_EVERY, ENDS_EVERY) if rate != 0.0 else ()
    pieces = np.zeros((1 + len(ends), max(len(known), 1), 2))
    pieces[0, : len(known)] = known
    for i, end in enumerate(ends, start=1):
        pieces[i, 0] = end / abs(rate), rate
    return pieces


def _turn_and_straight(situation: Situation, arc: Arc, until: Second) -> Trajectory:
    """A turn, and straight on until a time; at a gentle bank the turn itself may take longer."""
    straight = max(situation.pursuer.tas * until - arc.length, 0.0)
    return situation.pursuer.flying((arc, Straight(length=straight)))
