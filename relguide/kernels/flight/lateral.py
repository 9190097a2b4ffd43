"""One step of an aircraft: roll mode, coordinated turn, speed, drift with the wind."""

from math import exp, tan

from numba import njit

from relguide.kernels.base.motion import advance
from relguide.kernels.flight.autopilot import aileron, commanded_bank
from relguide.kernels.flight.energy import full_deceleration, least_tas, most_acceleration
from relguide.kernels.flight.flight_records import Body, Control, Drift, Limits
from relguide.units import G0


@njit(cache=True, nogil=True)
def lateral_step(body: Body, control: Control, limits: Limits, wind: Drift, dt: float) -> Body:
    """Fly for dt, as the autopilot flies what is asked of it.

    Args:
        body: the aircraft.
        control: what is asked of it, unchanged for dt.
        limits: what it can do.
        wind: moves it.
        dt: the step [s].
    """
    bank, integral = commanded_bank(body, control, limits, dt)
    return roll_step(body, aileron(bank, body, limits), integral, control.tas, limits, wind, dt)


@njit(cache=True, nogil=True)
def roll_step(
    body: Body, wanted: float, integral: float, asked: float, limits: Limits, wind: Drift,
    dt: float,
) -> Body:  # fmt: skip
    """Fly for dt with the ailerons as they are set.

        τ ṗ = aileron − p,   φ̇ = p,   ψ̇ = (g/V) tan φ,   V̇ = (V_c − V)/τ_V within its limits

    Roll is exact, the turn of second order in dt. Slower than its least speed with wings level, an
    aircraft loses no more speed: it would go down.

    Args:
        body: the aircraft.
        wanted: the rate of roll that the ailerons ask for [rad/s], positive to the right.
        integral: of the heading loop, after this step [rad s].
        asked: the true airspeed to go for [m/s].
        limits: what it can do.
        wind: moves it.
        dt: the step [s].
    """
    decay = exp(-dt / limits.roll_time)
    p, phi, v = body.roll_rate, body.bank, body.tas
    p_end = wanted + (p - wanted) * decay
    phi_end = phi + wanted * dt + (p - wanted) * limits.roll_time * (1.0 - decay)
    side = tan(0.5 * (phi + phi_end))
    square = 1.0 + side * side
    if asked < limits.min_tas * square:  # n² ≥ √n: the roots are seldom needed
        asked = max(asked, least_tas(limits, square))
    gain = (min(asked, limits.max_tas) - v) / limits.speed_time
    if gain < 0.0:
        gain = max(gain, -full_deceleration(limits, v, square))
    gain = min(gain, most_acceleration(limits, v, square))
    v_end = max(v + dt * gain, min(v, limits.min_tas))
    v_mean, inverse = 0.5 * (v + v_end), 1.0 / v
    rate = G0 * side * inverse * (2.0 - v_mean * inverse)  # 1/V̄ from 1/V, which drag needs as well
    x, y, heading = advance(body.x, body.y, body.heading, v_mean, rate, dt)
    return Body(x + wind.east * dt, y + wind.north * dt, heading, phi_end, p_end, v_end, integral)
