"""A leader that flies its intent: the pieces as the kernels fly them, and what is left of them."""

from math import pi
from typing import NamedTuple

import numpy as np

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.program import ROLLED_OUT, STRAIGHT, TURN
from relguide.planning.situation import FlyStraight, IntentPiece, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import Radian, Second

NO_TURN: Radian = 1e-9
"""A turn that misses a full one by less is rounding of none at all [rad]."""


class Program(NamedTuple):
    """What an aircraft is to fly."""

    pieces: tuple[IntentPiece, ...]
    rows: FloatArray
    """The same as the kernels take it. shape (n, 3)"""
    held: Radian
    """Heading before the first piece, continuous [rad]."""


def program_of(pieces: tuple[IntentPiece, ...], heading: Radian, t: Second, tas: float) -> Program:
    """An intent from a time on.

    Args:
        pieces: in the order they are flown.
        heading: before the first, continuous [rad].
        t: flight time at which the first begins [s].
        tas: true airspeed, which with the bank makes the turns take their time [m/s].
    """
    rows: list[tuple[float, float, float]] = []
    now = heading
    for piece in pieces:
        match piece:
            case FlyStraight(duration=duration):
                t += duration
                rows.append((STRAIGHT, t, 0.0))
            case TurnTo(heading=to, turn=turn, bank=bank):
                angle = wrap(-turn * (to - now))
                angle = 0.0 if angle > 2.0 * pi - NO_TURN else angle
                now -= turn * angle
                t += angle / turn_rate(tas, bank)
                rows.append((TURN, now, -turn * bank))
    return Program(pieces, np.array(rows).reshape(-1, 3), heading)


def turn_program(
    heading: Radian, to: Radian, direction: str, bank: Radian
) -> Program:
    """An order to turn to a heading, by the way round that `direction` says."""
    change = wrap_signed(to - heading)
    left = direction == "left" or (direction == "shorter" and change < 0.0)
    turn: Turn = LEFT if left else RIGHT
    piece = TurnTo(heading=wrap(to), turn=turn, bank=bank)
    return program_of((piece,), heading, 0.0, 1.0)


def remaining(program: Program, cursor: int, heading: Radian, t: Second) -> tuple[IntentPiece, ...]:
    """The part of a program still to be flown.

    Args:
        program: the whole.
        cursor: the piece being flown.
        heading: of the aircraft, continuous [rad].
        t: flight time [s].
    """
    left = program.pieces[cursor:]
    if not left:
        return ()
    end = float(program.rows[cursor, 1])
    match left[0]:
        case FlyStraight():
            return (FlyStraight(duration=max(end - t, 0.0)), *left[1:])
        case TurnTo(turn=turn):
            to_go = -turn * (end - heading)
            return left[1:] if to_go < ROLLED_OUT else left
