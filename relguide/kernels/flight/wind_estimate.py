"""The wind that an aircraft measures: ground velocity minus air velocity, smoothed in time.

    w_measured = V_G − V (sin ψ, cos ψ)
    P ← P + q dt,   K = P/(P + r),   w ← w + K (w_measured − w),   P ← (1 − K) P

A Kalman filter of a wind that wanders; both components have one gain. Plain functions from Python,
compiled within kernels.
"""

from numba.extending import register_jitable

from relguide.kernels.flight.flight_records import Drift

MEASURED_VARIANCE = 2.0**2
"""r, of one measured component: 1 m/s of airspeed, ½° of heading at 230 m/s, gusts [m²/s²]."""
WANDERING = 0.05
"""q: a wind that changes by 5 m/s within 100 km, 8 minutes of flight [m²/s³]; an estimate."""
UNKNOWN_VARIANCE = 10.0**2
"""P at first: forecasts are wrong by 3–8 m/s [m²/s²]."""


@register_jitable
def estimate(
    w: Drift, P: float, measured_w: Drift, r: float, q: float, dt: float
) -> tuple[Drift, float]:
    """The wind with one more measurement taken in.

    Args:
        w: as it was estimated dt ago.
        P: variance of each of its components then [m²/s²].
        measured_w: measured now.
        r: variance of each measured component [m²/s²], > 0.
        q: how fast the wind wanders: variance that a component gains in a second [m²/s³].
        dt: since the last measurement [s].

    Returns:
        the wind, and the variance of each component [m²/s²].
    """
    before = P + q * dt
    gain = before / (before + r)
    east = w.east + gain * (measured_w.east - w.east)
    north = w.north + gain * (measured_w.north - w.north)
    return Drift(east, north), (1.0 - gain) * before
