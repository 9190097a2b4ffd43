"""The laws that track a path and a spacing: feed-forward of what lies ahead, feedback of errors.

Once a second. What is asked for a second is felt about `lag` later, so the turn that the path makes
then is fed forward. Errors are those of a moment later, where the aircraft will be with its present
bank and roll rate: so the roll costs no phase margin. In the air mass ë = g φ, and with

    φ = −k (η − η_ref),   k = 2ζω V/g,   η_ref = −asin(v(e)/V)

the loop is the same at every speed: ω and ζ. v(e) is the parabola that speed follows too, e/τ near
the path with τ = 2ζ/ω, so that a limited bank does not overshoot. `docs/flight.md` has the margins.
"""

from math import asin, atan2, cos, hypot, sin, sqrt, tan
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.motion import advance
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Body, Drift
from relguide.units import G0

SECOND = 1.0
"""Between two acts of guidance [s]."""
WINGS_LEVEL = 1e-4
"""A heading that changes less in the seconds ahead is a straight [rad]."""
NEAR = 10.0
"""So near a straight path, and within `ALIGNED`, the autopilot holds headings [m]."""
ALIGNED = 0.05
"""See `NEAR` [rad]."""
LEAST_IN_HAND = 0.035
"""Bank that may always be counted on against an offset: 2° [rad]."""
MOST_IN_HAND = 0.21
"""… and no more than this: 12°, so that nobody is thrown about for an offset [rad]."""


class Gains(NamedTuple):
    """What the laws are set to; `guidance/settings.py` has the reasons."""

    path_bandwidth: float
    """ω with which the committed path is tracked [rad/s]."""
    follow_bandwidth: float
    """ω with which the leader's flown path is tracked [rad/s]."""
    damping: float
    """ζ of both."""
    intercept: float
    """Steepest angle at which a path is closed on [rad]."""
    lag: float
    """How late a turn that is asked for begins to be felt [s]."""
    look_ahead: float
    """How far ahead the errors are looked at [s]."""
    speed_time: float
    """Lag of the spacing loop τ: slower than the autothrust's [s]."""
    braking: float
    """Deceleration that is counted on [m/s²]."""
    falling_back: float
    """At most so much slower than the leader, to increase the spacing [m/s]."""
    catching_up: float
    """At least so much faster, or a leader with speed V_P is never reached [m/s]."""


class Way(NamedTuple):
    """The path near the aircraft: headings of an aircraft that flies it, at its own speed."""

    here: float
    """Now [rad, continuous]."""
    later: float
    """A look-ahead later [rad]."""
    felt: float
    """A lag later [rad]."""
    felt_after: float
    """A lag and a second later [rad]."""
    offset: float
    """How far to the right of the path the aircraft is [m]."""
    offset_later: float
    """The same a look-ahead later [m]."""


class Lateral(NamedTuple):
    """What a law asks of the autopilot."""

    kind: float
    """As `Control`."""
    value: float
    """As `Control`."""


@njit(cache=True, nogil=True)
def look_ahead(body: Body, wind: Drift, seconds: float) -> tuple[float, float, float]:
    """Where an aircraft will be, and its heading, if its roll rate ends halfway there."""
    bank = body.bank + 0.5 * body.roll_rate * seconds
    x, y, heading = advance(
        body.x, body.y, body.heading, body.tas, turn_rate(body.tas, bank), seconds
    )
    return x + wind.east * seconds, y + wind.north * seconds, heading


@njit(cache=True, nogil=True)
def parabola(error: float, deceleration: float, tau: float) -> float:
    """The rate that closes an error and is gone when it is closed.

        v = √((aτ)² + 2 a |e|) − aτ        stops within e at deceleration a; ≈ e/τ when e is small

    Args:
        error: e; its sign does not matter.
        deceleration: a > 0.
        tau: τ [s].
    """
    at = deceleration * tau
    return sqrt(at * at + 2.0 * deceleration * abs(error)) - at


@njit(cache=True, nogil=True)
def track(
    way: Way, heading_later: float, body: Body, max_bank: float, bandwidth: float, gains: Gains
) -> Lateral:
    """The turn rate, or on a straight the heading, that flies a path.

    Args:
        way: the path.
        heading_later: of the aircraft, a look-ahead later [rad].
        body: the aircraft.
        max_bank: limit of the autopilot [rad].
        bandwidth: ω [rad/s].
        gains: the rest.
    """
    ahead = bank_for_turn_rate(body.tas, (way.felt_after - way.felt) / SECOND)
    in_hand = min(max(max_bank - abs(ahead), LEAST_IN_HAND), MOST_IN_HAND)
    a, tau = 0.5 * G0 * tan(in_hand), 2.0 * gains.damping / bandwidth
    straight = max(abs(way.felt_after - way.here), abs(way.later - way.here)) < WINGS_LEVEL
    if straight and abs(way.offset) < NEAR and abs(wrap_signed(body.heading - way.here)) < ALIGNED:
        rate = parabola(way.offset, a, tau) / body.tas
        return Lateral(HOLD_HEADING, way.here - (rate if way.offset > 0.0 else -rate))
    closing = asin(min(parabola(way.offset_later, a, tau) / body.tas, sin(gains.intercept)))
    wanted = -closing if way.offset_later > 0.0 else closing
    error = wrap_signed(heading_later - way.later - wanted)
    bank = ahead - 2.0 * gains.damping * bandwidth * body.tas / G0 * error
    return Lateral(TURN_RATE, turn_rate(body.tas, min(max(bank, -max_bank), max_bank)))


@njit(cache=True, nogil=True)
def closing_tas(
    to_slot: float, slot_tas: float, fastest: float, acceleration: float, gains: Gains
) -> float:
    """The speed that closes a spacing error and has no closing speed left when it is closed.

    Args:
        to_slot: distance still to close, e [m]; negative when too close.
        slot_tas: speed that keeps the spacing [m/s].
        fastest: the pursuer's V_P [m/s].
        acceleration: that ends falling back [m/s²].
        gains: of the law.
    """
    a = gains.braking if to_slot > 0.0 else min(gains.braking, acceleration)
    v = parabola(to_slot, a, gains.speed_time)
    if to_slot < 0.0:
        return slot_tas - min(v, gains.falling_back)
    return min(slot_tas + v, max(fastest, slot_tas + gains.catching_up))


@njit(cache=True, nogil=True)
def heading_for_track(track_angle: float, tas: float, wind: Drift) -> float:
    """The heading on which an aircraft moves along a ground track [rad, near the track].

    Args:
        track_angle: χ, clockwise from north [rad].
        tas: V [m/s].
        wind: how the air moves; across the track no faster than V, else the nearest.
    """
    across = wind.east * cos(track_angle) - wind.north * sin(track_angle)
    return track_angle - asin(min(max(across / tas, -1.0), 1.0))


@njit(cache=True, nogil=True)
def ground_track(body: Body, wind: Drift) -> tuple[float, float]:
    """Direction over the ground [rad, within π of the heading] and ground speed [m/s]."""
    east = body.tas * sin(body.heading) + wind.east
    north = body.tas * cos(body.heading) + wind.north
    return body.heading + wrap_signed(atan2(east, north) - body.heading), hypot(east, north)


@njit(cache=True, nogil=True)
def tas_for_ground_speed(heading: float, speed: float, wind: Drift) -> float:
    """The true airspeed for a ground speed along a heading's track [m/s]; 0 if there is none.

    Args:
        heading: ψ [rad].
        speed: wanted over the ground [m/s].
        wind: how the air moves.
    """
    along = wind.east * sin(heading) + wind.north * cos(heading)
    across = wind.east * cos(heading) - wind.north * sin(heading)
    square = speed * speed - across * across
    return sqrt(square) - along if square > 0.0 else 0.0
