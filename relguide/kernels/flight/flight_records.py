"""What the flight kernels pass on: an aircraft, what it can do, what is asked of it.

World frame: x east, y north [m], headings clockwise from north. Inside the kernels a heading is
continuous, not wrapped: so a turn of 355° is a turn of 355°.
"""

from typing import NamedTuple

from numba import njit

from relguide.kernels.base.roots import FloatArray

HOLD_HEADING = 0.0
"""`Control.kind`: turn the shorter way to a heading and keep it."""
TURN_RATE = 1.0
"""`Control.kind`: keep a turn rate."""


class Body(NamedTuple):
    """One aircraft at one instant; its fields are the columns of `states`."""

    x: float
    """East over the ground [m]."""
    y: float
    """North over the ground [m]."""
    heading: float
    """ψ, continuous [rad]."""
    bank: float
    """φ, positive right wing down [rad]."""
    roll_rate: float
    """[rad/s]."""
    tas: float
    """V [m/s]."""
    integral: float
    """Of the heading loop, ∫e dt [rad s]."""


class Limits(NamedTuple):
    """What an aircraft and its autopilot can do; the columns of `limits`."""

    max_bank: float
    """Of the autopilot [rad]."""
    max_roll_rate: float
    """At full authority [rad/s]."""
    roll_time: float
    """τ of the roll mode [s]."""
    speed_time: float
    """τ_V of the autothrust [s]."""
    climb_0: float
    """Acceleration at climb thrust without the drag of lift, c₀ + c₁ V + c₂ V²: c₀ [m/s²]."""
    climb_1: float
    """c₁ [1/s]."""
    climb_2: float
    """c₂ [1/m]."""
    idle_0: float
    """The same at idle: c₀ [m/s²]."""
    idle_1: float
    """c₁ [1/s]."""
    idle_2: float
    """c₂ [1/m]."""
    brakes: float
    """Deceleration by speed brakes over V² [1/m]."""
    induced: float
    """Deceleration by the drag of lift at 1 g, times V² [m³/s⁴]."""
    braking: float
    """Share of the deceleration that these give: 1, unless it was seen to be less."""
    min_tas: float
    """Slowest that the autothrust accepts with wings level [m/s]."""
    max_tas: float
    """Fastest [m/s]."""


class Control(NamedTuple):
    """What is asked of an autopilot; the columns of `controls`."""

    kind: float
    """`HOLD_HEADING` or `TURN_RATE`."""
    value: float
    """The heading [rad], or the turn rate [rad/s, positive to the right]."""
    tas: float
    """What the autothrust goes for [m/s]."""


class Drift(NamedTuple):
    """A uniform wind: how the air mass moves over the ground."""

    east: float
    """Toward the east [m/s]."""
    north: float
    """Toward the north [m/s]."""


@njit(cache=True, nogil=True)
def move_to(body: Body, x: float, y: float) -> Body:
    """The same aircraft at another place [m]."""
    return Body(x, y, body.heading, body.bank, body.roll_rate, body.tas, body.integral)


@njit(cache=True, nogil=True)
def at_speed(body: Body, tas: float) -> Body:
    """The same aircraft at another true airspeed [m/s]."""
    return Body(body.x, body.y, body.heading, body.bank, body.roll_rate, tas, body.integral)


@njit(cache=True, nogil=True)
def body_at(states: FloatArray, i: int) -> Body:
    """Row i of the states."""
    row = states[i]
    return Body(row[0], row[1], row[2], row[3], row[4], row[5], row[6])


@njit(cache=True, nogil=True)
def limits_at(limits: FloatArray, i: int) -> Limits:
    """Row i of the limits."""
    row = limits[i]
    return Limits(
        row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], row[10],
        row[11], row[12], row[13], row[14],
    )  # fmt: skip


@njit(cache=True, nogil=True)
def store(states: FloatArray, i: int, body: Body) -> None:
    """Write row i of the states."""
    states[i, 0] = body.x
    states[i, 1] = body.y
    states[i, 2] = body.heading
    states[i, 3] = body.bank
    states[i, 4] = body.roll_rate
    states[i, 5] = body.tas
    states[i, 6] = body.integral
