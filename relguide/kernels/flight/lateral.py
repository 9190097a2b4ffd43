"""One step of an aircraft: roll mode, coordinated turn, speed, drift with the wind."""

from math import exp

from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import advance
from relguide.kernels.base.turn import turn_rate


@njit(cache=True, nogil=True)
def lateral_step(
    x: float,
    y: float,
    psi: float,
    phi: float,
    p: float,
    v: float,
    aileron: float,
    v_asked: float,
    wind_east: float,
    wind_north: float,
    dt: float,
    p_max: float,
    roll_time: float,
    v_time: float,
    acceleration: float,
    deceleration: float,
) -> tuple[float, float, float, float, float, float]:
    """Fly for dt with the controls held.

        τ ṗ = aileron − p,   φ̇ = p,   ψ̇ = (g/V) tan φ,   V̇ = (V_c − V)/τ_V within its limits

    Args:
        x: east over the ground [m].
        y: north over the ground [m].
        psi: heading, clockwise from north [rad].
        phi: bank, positive right wing down [rad].
        p: roll rate [rad/s].
        v: true airspeed [m/s].
        aileron: roll rate that the ailerons ask for [rad/s], cut to ±p_max.
        v_asked: what the autothrust goes for [m/s].
        wind_east: toward the east [m/s].
        wind_north: toward the north [m/s].
        dt: the step [s].
        p_max: highest roll rate [rad/s].
        roll_time: τ of the roll mode [s].
        v_time: τ_V of the autothrust [s].
        acceleration: highest [m/s²].
        deceleration: highest [m/s²], > 0.

    Returns:
        x, y, psi in [0, 2π), phi, p, v at the end. Roll is exact, the turn of second order in dt.
    """
    wanted = min(max(aileron, -p_max), p_max)
    decay = exp(-dt / roll_time)
    p_end = wanted + (p - wanted) * decay
    phi_end = phi + wanted * dt + (p - wanted) * roll_time * (1.0 - decay)
    v_end = v + dt * min(max((v_asked - v) / v_time, -deceleration), acceleration)
    v_mean = 0.5 * (v + v_end)
    rate = turn_rate(v_mean, 0.5 * (phi + phi_end))
    x_end, y_end, psi_end = advance(x, y, psi, v_mean, rate, dt)
    return (
        x_end + wind_east * dt,
        y_end + wind_north * dt,
        wrap(psi_end),
        phi_end,
        p_end,
        v_end,
    )
