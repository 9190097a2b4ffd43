"""An aircraft that flies what it declared: straights of a duration, turns to a heading.

What it flies differs from what it declared only by its roll: a turn begins when declared, with half
of the roll before that and half after. Headings are continuous, so any turn is flown as it is.
"""

from math import pi

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.records import HOLD_HEADING, TURN_RATE, Body, Control, Limits

STRAIGHT = 0.0
"""First column of a piece: fly straight until the flight time in the second [s]."""
TURN = 1.0
"""… turn to the heading in the second [rad, continuous], at the bank in the third [rad, signed]."""
ROLLED_OUT = pi / 180.0
"""Half of what joining accepts; the last degree takes 10 s [rad]."""
ROLL_LAG = 0.7
"""What roll mode and roll loop's soft end add [s]: 0.74 for 0 → 25°, 0.56 for −25 → 25°."""


@njit(cache=True, nogil=True)
def roll_lead(limits: Limits, from_bank: float, to_bank: float) -> float:
    """How long before a jump of bank the roll must begin, to fly the same turn [s].

    A roll at constant rate turns as much as a jump of bank in the middle of it; the loops that
    command it add their lag.
    """
    return 0.5 * abs(to_bank - from_bank) / limits.max_roll_rate + ROLL_LAG


@njit(cache=True, nogil=True)
def next_piece(program: FloatArray, cursor: int, body: Body, t: float) -> int:
    """The piece being flown at flight time t [s]: the same, or the next if it is over."""
    if cursor < len(program):
        piece = program[cursor]
        if piece[0] == STRAIGHT:
            if t >= piece[1]:
                return cursor + 1
        elif abs(body.heading - piece[1]) < ROLLED_OUT:
            return cursor + 1
    return cursor


@njit(cache=True, nogil=True)
def programmed(
    program: FloatArray, cursor: int, held: float, body: Body, limits: Limits, t: float, tas: float
) -> Control:
    """What the program asks for now.

    Args:
        program: pieces, a row each. shape (n, 3)
        cursor: the piece being flown; n after the last.
        held: the heading before the first piece [rad].
        body: the aircraft.
        limits: how it rolls.
        t: flight time [s].
        tas: its speed [m/s].
    """
    for k in range(cursor):
        if program[k, 0] == TURN:
            held = program[k, 1]
    for k in range(cursor, len(program)):
        kind, end, bank = program[k, 0], program[k, 1], program[k, 2]
        if kind == STRAIGHT:
            if k + 1 == len(program):
                break
            following = program[k + 1, 2] if program[k + 1, 0] == TURN else 0.0
            if end - t > roll_lead(limits, 0.0, following):
                break
        else:
            left = (end - body.heading) * (1.0 if bank > 0.0 else -1.0)
            rate = turn_rate(body.tas, bank)
            if left > abs(rate) * roll_lead(limits, bank, 0.0):
                return Control(TURN_RATE, rate, tas)
            held = end
            break
    return Control(HOLD_HEADING, held, tas)
