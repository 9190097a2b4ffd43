"""How fast an aircraft can speed up and slow down: thrust less drag, in a bank or with wings level.

    V̇ = c₀ + c₁ V + c₂ V² − K n²/V²,     n² = 1 + tan² φ

at one level and weight: c of climb thrust or of idle, less zero-lift drag; K of the drag of the
lift. The least speed grows with √n, since it carries n times the weight.
"""

from math import sqrt, tan

from numba import njit

from relguide.kernels.flight.flight_records import Body, Limits

LEAST_REGAINED = 0.02
"""What is counted on at the least to speed up again, where thrust only just holds a turn [m/s²]."""


@njit(cache=True, nogil=True)
def load_square(bank: float) -> float:
    """n² of a level coordinated turn."""
    side = tan(bank)
    return 1.0 + side * side


@njit(cache=True, nogil=True)
def most_acceleration(limits: Limits, tas: float, square: float) -> float:
    """At climb thrust [m/s²]; negative where it is less than the drag.

    Args:
        limits: what the aircraft can do.
        tas: V [m/s].
        square: n².
    """
    thrust = limits.climb_0 + tas * (limits.climb_1 + tas * limits.climb_2)
    inverse = 1.0 / tas
    return thrust - limits.induced * square * inverse * inverse


@njit(cache=True, nogil=True)
def idle_deceleration(limits: Limits, tas: float, square: float) -> float:
    """At idle, without speed brakes [m/s²], > 0; arguments as above."""
    thrust = limits.idle_0 + tas * (limits.idle_1 + tas * limits.idle_2)
    inverse = 1.0 / tas
    return limits.braking * (limits.induced * square * inverse * inverse - thrust)


@njit(cache=True, nogil=True)
def full_deceleration(limits: Limits, tas: float, square: float) -> float:
    """At idle, with speed brakes [m/s²], > 0; arguments as above."""
    brakes = limits.braking * limits.brakes * tas * tas
    return idle_deceleration(limits, tas, square) + brakes


@njit(cache=True, nogil=True)
def regained(limits: Limits, body: Body) -> float:
    """What an aircraft can speed up by, in the bank that it has, > 0 [m/s²]."""
    return max(most_acceleration(limits, body.tas, load_square(body.bank)), LEAST_REGAINED)


@njit(cache=True, nogil=True)
def least_tas(limits: Limits, square: float) -> float:
    """The slowest that the autothrust accepts, at a square of the load factor n² [m/s]."""
    return limits.min_tas * sqrt(sqrt(square))
