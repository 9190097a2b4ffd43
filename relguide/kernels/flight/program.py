"""An aircraft that flies what it declared: straights of a duration, turns to a heading.

What it flies differs from what it declared only by its roll: a turn begins when declared, with half
of the roll before that and half after. Headings are continuous, so any turn is flown as it is.
"""

from math import inf, pi

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import (
    HOLD_HEADING,
    TURN_RATE,
    Body,
    Control,
    Drift,
    Limits,
)
from relguide.kernels.flight.lateral import lateral_step

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
def bank_after(program: FloatArray, cursor: int) -> float:
    """The bank that a piece is left with: of the turn that comes next, 0 if it is not one [rad]."""
    if cursor + 1 < len(program) and program[cursor + 1, 0] == TURN:
        return float(program[cursor + 1, 2])
    return 0.0


@njit(cache=True, nogil=True)
def until_roll(program: FloatArray, cursor: int, body: Body, limits: Limits, t: float) -> float:
    """How long until the roll at the end of the present piece begins [s]; infinite without one."""
    if cursor == len(program):
        return inf
    end, following = program[cursor, 1], bank_after(program, cursor)
    if program[cursor, 0] == STRAIGHT:
        return float(end - t - roll_lead(limits, 0.0, following)) if following != 0.0 else inf
    bank = program[cursor, 2]
    left = (end - body.heading) / turn_rate(body.tas, bank)
    return float(left - roll_lead(limits, bank, following))


@njit(cache=True, nogil=True)
def next_piece(program: FloatArray, cursor: int, body: Body, limits: Limits, t: float) -> int:
    """The piece being flown at flight time t [s]: the same, or the next if it is over.

    A turn is over once its heading is reached, or before that, where the roll into the next turn
    is due.
    """
    if cursor == len(program):
        return cursor
    if program[cursor, 0] == STRAIGHT:
        return cursor + 1 if t >= program[cursor, 1] else cursor
    if abs(body.heading - program[cursor, 1]) < ROLLED_OUT:
        return cursor + 1
    if cursor + 1 == len(program) or until_roll(program, cursor, body, limits, t) > 0.0:
        return cursor
    if program[cursor + 1, 0] == TURN or until_roll(program, cursor + 1, body, limits, t) <= 0.0:
        return cursor + 1
    return cursor


@njit(cache=True, nogil=True)
def program_control(
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
        end, bank = program[k, 1], program[k, 2]
        if program[k, 0] == STRAIGHT:
            if until_roll(program, k, body, limits, t) > 0.0:
                break
        else:
            if until_roll(program, k, body, limits, t) > 0.0:
                return Control(TURN_RATE, turn_rate(body.tas, bank), tas)
            held = end
            if bank_after(program, k) == 0.0:
                break
    return Control(HOLD_HEADING, held, tas)


@njit(cache=True, nogil=True)
def fly_program(
    program: FloatArray, cursor: int, held: float, body: Body, limits: Limits, wind: Drift,
    t: float, dt: float, tas: float,
) -> tuple[Body, int]:  # fmt: skip
    """Fly a program for dt; a roll that begins within begins when it should, whatever the step.

    Args:
        program: pieces, a row each. shape (n, 3)
        cursor: the piece being flown; n after the last.
        held: the heading before the first piece [rad].
        body: the aircraft.
        limits: how it rolls.
        wind: moves it.
        t: flight time [s].
        dt: the step [s].
        tas: its speed [m/s].

    Returns:
        the aircraft dt later, and the piece that it then flies.
    """
    end = t + dt
    before = until_roll(program, cursor, body, limits, t)
    if 0.0 < before < dt:
        asked = program_control(program, cursor, held, body, limits, t, tas)
        body = lateral_step(body, asked, limits, wind, before)
        t += before
        dt -= before
    # a nanosecond later: a time that is only just reached may be rounded down
    asked = program_control(program, cursor, held, body, limits, t + 1e-9, tas)
    body = lateral_step(body, asked, limits, wind, dt)
    return body, next_piece(program, cursor, body, limits, end)
