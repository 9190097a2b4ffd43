"""Hand flying: the flight director's roll bar, a stick, and a pilot that follows the bar.

    stick → rate of roll → roll mode;   bar = (φ_c − φ) through 1/(0.5 s + 1)

The pilot is the crossover model: with the aircraft it makes ω_c e^(−τ s)/s of the error that the
bar shows. Its lead takes back the bar's own lag; to the answer that it would give it adds remnant,
noise in proportion to the errors that it has seen, through 1/(1 s + 1) (McRuer and Krendel, 1974).
"""

from math import exp, pi, sqrt

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.autopilot import ROLL_KD, ROLL_KP
from relguide.kernels.flight.flight_records import Body, Limits

STICK, BAR, BANDWIDTH, LAG, REMNANT, THRESHOLD, REACTS_AT, NOISE, SQUARE, NEXT = range(10)
"""Columns of `hands`: the stick, −1 … 1, right positive; the roll bar [rad]. Of the pilot: ω_c
[rad/s]; τ in steps; variance of the remnant over that of the errors; the error that it lets stand
[rad]; the flight time from which on it answers [s]. What it remembers: the remnant [rad], the mean
square of the errors [rad²], and which of the errors that follow is the oldest."""
ERRORS = 10
"""From this column on the last errors of the bank [rad]: as many as fit."""
COLUMNS = ERRORS + 40
"""Of `hands`: errors of 2 s at 20 steps a second."""
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
    hand: FloatArray, error: float, white: float, limits: Limits, t: float, dt: float
) -> float:
    """The stick of a pilot that sees an error of the bank; kept in the row with what it remembers.

    Args:
        hand: its row.
        error: commanded bank less bank now [rad].
        white: a draw of the standard normal distribution.
        limits: what the aircraft can do.
        t: flight time [s].
        dt: since the last call [s].
    """
    fit = COLUMNS - ERRORS
    newest = int(hand[NEXT])
    hand[ERRORS + newest] = error
    hand[NEXT] = (newest + 1) % fit
    seen = hand[ERRORS + (newest - int(hand[LAG])) % fit]
    share = dt / SEEN_FOR
    hand[SQUARE] += share * (seen * seen - hand[SQUARE])
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
