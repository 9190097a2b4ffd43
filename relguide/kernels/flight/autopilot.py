"""The autopilot: a slow heading loop over a fast roll loop, superposed PIDs as in section 5.

    heading error → heading PID → turn rate → bank, eq. (8) → roll PID → ailerons

A turn rate asked for enters after the heading PID. Gyros measure rates, so no error is differenced.
"""

from math import pi

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.kernels.flight.flight_records import HOLD_HEADING, Body, Control, Limits

ROLL_KP = 0.8
"""Closes bank in 1/kp = 1.3 s: slow enough not to excite a roll mode of 0.5 s [1/s]."""
ROLL_KD = 0.4
"""Damping (1 + kd)/(2√(kp·0.5 s)) = 1.1: the bank limit is approached from below."""
HEADING_KP = 0.125
"""From 25° of bank at 240 m/s it asks for 3.4°/s of roll, within 3.75°/s [1/s]."""
HEADING_KI = 0.0005
"""Removes a bank bias of 1° in a minute; faster would overshoot the capture [1/s²]."""
HEADING_KD = 0.1
"""A lead of 0.8 s (kd/kp) on the rate: makes good half the roll loop's lag."""
INTEGRATE_WITHIN = 2.0 * pi / 180.0
"""The heading PID integrates only this close: a capture from afar is not a steady error [rad]."""


@njit(cache=True, nogil=True)
def commanded_bank(body: Body, control: Control, limits: Limits, dt: float) -> tuple[float, float]:
    """The bank to fly now: what the autopilot goes for, and what the flight director shows.

    Args:
        body: the aircraft.
        control: what guidance wants of it.
        limits: the bank is kept within them.
        dt: since the last call [s].

    Returns:
        φ_c [rad], positive right wing down, and the heading loop's integral [rad s].
    """
    wanted, integral = control.value, 0.0
    if control.kind == HOLD_HEADING:
        error = wrap_signed(control.value - body.heading)
        rate = turn_rate(body.tas, body.bank)
        rate_limit = turn_rate(body.tas, limits.max_bank)
        integral = body.integral if abs(error) <= INTEGRATE_WITHIN else 0.0
        wanted = HEADING_KP * error + HEADING_KI * integral - HEADING_KD * rate
        # conditional integration: nothing is wound up at the limit
        if abs(wanted) < rate_limit or wanted * error < 0.0:
            integral += error * dt
        wanted = min(max(wanted, -rate_limit), rate_limit)
    bank = bank_for_turn_rate(body.tas, wanted)
    return min(max(bank, -limits.max_bank), limits.max_bank), integral


@njit(cache=True, nogil=True)
def aileron(bank: float, body: Body, limits: Limits) -> float:
    """What to ask of the ailerons, to fly a bank [rad]: a rate of roll [rad/s], right positive."""
    roll = ROLL_KP * (bank - body.bank) - ROLL_KD * body.roll_rate
    return min(max(roll, -limits.max_roll_rate), limits.max_roll_rate)
