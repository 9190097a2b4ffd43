"""Closing in: the laws that put an aircraft onto a route and at D, where the plan is ill-posed.

One metre too close, and the minimum-time answer is a full circle. So near the slot three plain laws
fly instead, all bank-limited:

- the final turn is made tangent to the route: radius = offset / (1 − cos Δψ); a little more or less
  bank than planned corrects what the roll-in cost;
- near the route, bank answers to cross-track and track error, a damped second-order law;
- speed follows a parabola of the spacing error, so that D is reached with no closing speed left.
"""

from math import cos, sin, sqrt
from typing import NamedTuple

from relguide.flying.aircraft import AircraftModel, AircraftState
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.motion import advance
from relguide.kernels.base.turn import turn_rate
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond, Second


class Slot(NamedTuple):
    """Where the pursuer has to be, and how that place moves."""

    x: Metre
    """East over the ground, now [m]."""
    y: Metre
    """North over the ground, now [m]."""
    heading: Radian
    """The heading to have there, clockwise from north [rad]."""
    tas: MetrePerSecond
    """Its speed through the air, along that heading [m/s]."""
    turn_rate: RadianPerSecond = 0.0
    """How fast that heading turns there [rad/s]: not 0 where the leader's own path bends."""


class Offsets(NamedTuple):
    """The pursuer as seen from the slot's line, in the air mass."""

    ahead: Metre
    """Along the line, positive when ahead of the slot [m]."""
    right: Metre
    """Across it, positive to its right [m]."""
    heading: Radian
    """Relative heading in [−π, π), positive to the right [rad]."""


INTERCEPT = 30.0 * DEG
"""Steepest angle at which the route is closed on [rad]: what flight decks use for a localizer."""
CROSS_TRACK_GAIN = 5.0e-4  # [rad/m], with the next: ω = √(g·gain) = 0.07 rad/s, settled in 40 s
TRACK_GAIN = 3.0  # damping 3·√g/(2·V·√gain) = 0.88 at 240 m/s: no overshoot to speak of
TANGENT_ABOVE = 6.0 * DEG  # below it 1 − cos Δψ is 0.5 %: metres of offset would ask for any radius
CLOSE_ENOUGH: Second = 45.0  # this long before the route, the intercept angle is kept
SPEED_LOOP: Second = 12.0  # twice the autothrust's lag: the spacing loop must be slower than it
BRAKING = 0.4  # [m/s²] what idle thrust gives without speed brakes: those stay in reserve
FALL_BACK: MetrePerSecond = 20.0  # at most 40 kt slower than the leader, to increase the spacing
CATCH_UP: MetrePerSecond = 5.0  # at least 10 kt faster, or a leader with speed V_P is never reached


def offsets(state: AircraftState, slot: Slot) -> Offsets:
    """The pursuer relative to the slot's line, now."""
    east, north = state.x - slot.x, state.y - slot.y
    along_east, along_north = sin(slot.heading), cos(slot.heading)
    return Offsets(
        ahead=east * along_east + north * along_north,
        right=east * along_north - north * along_east,
        heading=wrap_signed(state.heading - slot.heading),
    )


def distance_to_slot(seen: Offsets) -> Metre:
    """How far it is to the present place of the slot, along the tangent arc and the route [m].

    Positive when the slot is still ahead. On the route it is simply −ahead.
    """
    turn = abs(seen.heading)
    if turn < TANGENT_ABOVE or seen.right * seen.heading >= 0.0:
        return -seen.ahead
    radius = abs(seen.right) / (1.0 - cos(turn))
    return -seen.ahead + radius * (turn - sin(turn))


def closing_turn_rate(
    seen: Offsets, state: AircraftState, *, model: AircraftModel, lead: Second
) -> RadianPerSecond:
    """The turn rate that puts the aircraft onto the slot's line.

    Args:
        seen: where it is relative to that line.
        state: gives its speed and bank.
        model: gives the bank limit.
        lead: how far ahead to look: the roll answers late by as much [s].

    Returns:
        r [rad/s], positive to the right, within the bank limit.
    """
    limit = turn_rate(state.tas, model.max_bank)
    rate = turn_rate(state.tas, state.bank)
    # x along the line, y to its left, as `advance` wants them: a heading of 0 is along y there
    right, _, heading = advance(seen.right, 0.0, seen.heading, state.tas, rate, lead)
    if abs(heading) > TANGENT_ABOVE and right * heading < 0.0:
        radius = abs(right) / (1.0 - cos(heading))
        wanted = -state.tas / radius if heading > 0.0 else state.tas / radius
        if abs(heading) > INTERCEPT or abs(wanted) > 0.5 * limit:
            return min(max(wanted, -limit), limit)
        if abs(right) < CLOSE_ENOUGH * state.tas * sin(abs(heading)):
            return 0.0  # the tangent arc will begin shortly: no need to close more steeply
    reach = INTERCEPT * TRACK_GAIN / CROSS_TRACK_GAIN  # beyond it the intercept angle is full
    bank = -CROSS_TRACK_GAIN * min(max(seen.right, -reach), reach) - TRACK_GAIN * seen.heading
    bank = min(max(bank, -model.max_bank), model.max_bank)
    return turn_rate(state.tas, bank)


def spacing_tas(
    to_slot: Metre, slot_tas: MetrePerSecond, *, model: AircraftModel, fastest: MetrePerSecond
) -> MetrePerSecond:
    """The speed that closes a spacing error and has no closing speed left when it is closed.

        v = √((aτ)² + 2 a e) − aτ        stops within e at deceleration a; ≈ e/τ when e is small

    Args:
        to_slot: distance still to close, e [m]; negative when too close.
        slot_tas: the leader's true airspeed [m/s].
        model: gives the speed range and the acceleration that ends falling back.
        fastest: the pursuer's V_P [m/s].
    """
    a = BRAKING if to_slot > 0.0 else min(BRAKING, model.max_acceleration)
    v = sqrt((a * SPEED_LOOP) ** 2 + 2.0 * a * abs(to_slot)) - a * SPEED_LOOP
    if to_slot < 0.0:
        return max(slot_tas - min(v, FALL_BACK), model.min_tas)
    return min(slot_tas + v, max(fastest, slot_tas + CATCH_UP), model.max_tas)


def braking_distance(tas: MetrePerSecond, slot_tas: MetrePerSecond) -> Metre:
    """How far behind the slot `spacing_tas` begins to slow down [m]."""
    v = max(tas - slot_tas, 0.0)
    return v * SPEED_LOOP + v * v / (2.0 * BRAKING)
