"""Bank, turn rate and turn radius of a level coordinated turn, eq. (8), and its one home.

Plain functions from Python, compiled within kernels.

Signs, written once: bank φ > 0 is right wing down, turns right, ψ grows. The paper's ε = +1 is a
left turn, so sign φ = −ε.
"""

from math import atan, tan

import numpy as np
from numba.extending import register_jitable

from relguide.kernels.base.roots import FloatArray
from relguide.units import G0


@register_jitable
def turn_radius(speed: float, bank: float) -> float:
    """Radius of a level coordinated turn.

        R = V² / (g tan|φ|)            from eq. (8), r = (g/V) tan φ, and R = V/|r|

    Args:
        speed: true airspeed V [m/s], > 0.
        bank: bank angle φ [rad], 0 < |φ| < π/2; its sign does not matter here.

    Returns:
        R [m].
    """
    return speed * speed / (G0 * tan(abs(bank)))


@register_jitable
def turn_rate(speed: float, bank: float) -> float:
    """Rate of change of heading in a level coordinated turn, eq. (8).

    Args:
        speed: true airspeed V [m/s], > 0.
        bank: bank angle φ [rad], |φ| < π/2, positive right wing down.

    Returns:
        r [rad/s], positive to the right.
    """
    return G0 / speed * tan(bank)


@register_jitable
def bank_for_turn_rate(speed: float, rate: float) -> float:
    """The bank that turns at a rate: `turn_rate` the other way round.

    Args:
        speed: true airspeed V [m/s], > 0.
        rate: r [rad/s], positive to the right.

    Returns:
        φ [rad], positive right wing down.
    """
    return atan(speed * rate / G0)


@register_jitable
def bank_for_turn_radius(speed: float, radius: float) -> float:
    """The bank that turns on a radius: `turn_radius` the other way round.

    Args:
        speed: true airspeed V [m/s], > 0.
        radius: R [m], > 0.

    Returns:
        |φ| [rad].
    """
    return atan(speed * speed / (G0 * radius))


def turn_radii(speeds: FloatArray, banks: FloatArray) -> FloatArray:
    """As `turn_radius`, for arrays of speeds [m/s] and of banks, all above 0 [rad]."""
    return speeds * speeds / (G0 * np.tan(banks))
