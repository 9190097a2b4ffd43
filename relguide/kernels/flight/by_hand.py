"""Hand flying: the flight director's roll bar, a stick, and a pilot that follows the bar.

    stick → rate of roll → roll mode;   bar = (φ_c − φ) through 1/(0.5 s + 1)

The pilot is the crossover model. It sees the bar, and its lead takes back the bar's lag; its stick
is ω_c e^(−τ s) of the error, and the aircraft makes bank of it:

    Y_p Y_c = ω_c e^(−τ s)/s · 1/(0.5 s + 1)

`flying/pilot_model.py` says where the constants come from.
"""

from math import exp, pi, sqrt

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.autopilot import ROLL_KD, ROLL_KP
from relguide.kernels.flight.flight_records import Body, Limits

STICK, BAR, BANDWIDTH, LEAD, LAG, REMNANT, THRESHOLD, REACTS_AT, NOISE, SQUARE, NEXT = range(11)
"""Columns of `hands`: the stick, −1 … 1, right positive; the roll bar [rad]. Of the pilot: ω_c
[rad/s]; its lead on the rate of roll [s]; τ in steps; variance of the remnant over that of the
errors; the error that it lets stand [rad]; the flight time from which on it answers [s]. What it
remembers: the remnant [rad], the mean square of the errors [rad²], and where the next of them is
kept."""
ERRORS = 11
"""From this column on the last errors of the bank [rad]: as many as fit."""
REMEMBERED = 2.0
"""So long errors are kept [s]."""
BAR_TIME = 0.5
"""Of the bar's smoothing [s]."""
HAND_BANK = 45.0 * pi / 180.0
"""A stick rolls no farther [rad]."""
REMNANT_TIME = 1.0
"""Of the remnant [s]."""
SEEN_FOR = 5.0
"""Over so long the errors are averaged [s]."""


@njit(cache=True, nogil=True)
def roll_by_stick(stick: float, body: Body, limits: Limits) -> float:
    """The rate of roll that a stick asks for, short of 45° of bank [rad/s]."""
    right = ROLL_KP * (HAND_BANK - body.bank) - ROLL_KD * body.roll_rate
    left = ROLL_KP * (-HAND_BANK - body.bank) - ROLL_KD * body.roll_rate
    wanted = min(max(stick * limits.max_roll_rate, left), right)
    return min(max(wanted, -limits.max_roll_rate), limits.max_roll_rate)


@njit(cache=True, nogil=True)
def smooth_bar(hand: FloatArray, error: float, dt: float) -> float:
    """The roll bar after dt in which the error was `error`; kept in the row [rad]."""
    hand[BAR] = error + (hand[BAR] - error) * exp(-dt / BAR_TIME)
    return float(hand[BAR])


@njit(cache=True, nogil=True)
def follow_bar(
    hand: FloatArray, before: float, body: Body, white: float, limits: Limits, t: float, dt: float
) -> float:
    """The stick of a pilot that sees the roll bar; kept in the row with what it remembers.

    Args:
        hand: its row, with the bar as it is now.
        before: the bar dt ago [rad].
        body: the aircraft.
        white: a draw of the standard normal distribution.
        limits: what the aircraft can do.
        t: flight time [s].
        dt: since the last call [s].
    """
    kept = exp(-dt / BAR_TIME)
    error = (hand[BAR] - kept * before) / (1.0 - kept)
    fit = len(hand) - ERRORS
    newest, late = int(hand[NEXT]), int(hand[LAG])
    hand[ERRORS + newest] = error - hand[LEAD] * body.roll_rate
    hand[NEXT] = (newest + 1) % fit
    seen = hand[ERRORS + (newest - late) % fit]
    earlier = hand[ERRORS + (newest - late - 1) % fit]
    seen += (hand[LAG] - late) * (earlier - seen)
    hand[SQUARE] += dt / SEEN_FOR * (seen * seen - hand[SQUARE])
    keeps = exp(-dt / REMNANT_TIME)
    spread = sqrt(hand[REMNANT] * hand[SQUARE] * (1.0 - keeps * keeps))
    hand[NOISE] = keeps * hand[NOISE] + spread * white
    if t < hand[REACTS_AT]:
        hand[STICK] = 0.0
        return 0.0
    if abs(seen) < hand[THRESHOLD]:
        seen = 0.0
    wanted = hand[BANDWIDTH] * (seen + hand[NOISE]) / limits.max_roll_rate
    hand[STICK] = min(max(wanted, -1.0), 1.0)
    return float(hand[STICK])


def columns(step: float) -> int:
    """How many columns `hands` has for a step of the integration [s]."""
    return ERRORS + round(REMEMBERED / step)
