"""Bank, turn rate and turn radius of a level coordinated turn, eq. (8).

Signs, written once: bank φ > 0 is right wing down, turns right, ψ grows. The paper's ε = +1 is a
left turn, so sign φ = −ε.
"""

from math import tan

from numba import njit

from relguide.units import G0


@njit(cache=True, nogil=True)
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


@njit(cache=True, nogil=True)
def turn_rate(speed: float, bank: float) -> float:
    """Rate of change of heading in a level coordinated turn, eq. (8).

    Args:
        speed: true airspeed V [m/s], > 0.
        bank: bank angle φ [rad], |φ| < π/2, positive right wing down.

    Returns:
        r [rad/s], positive to the right.
    """
    return G0 / speed * tan(bank)
