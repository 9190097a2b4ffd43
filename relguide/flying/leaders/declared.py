"""A leader that flies its intent: the pieces as the kernels fly them, and what is left of them."""

from dataclasses import replace
from math import inf, pi
from typing import Literal, NamedTuple

import numpy as np

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import Body, Limits
from relguide.kernels.flight.program import ROLLED_OUT, STRAIGHT, TURN, roll_lead
from relguide.planning.aircraft import Leader, Traffic
from relguide.planning.intent import ROUNDED, ChangeLevel, FlyStraight, IntentPiece, TurnTo
from relguide.planning.limits import MAX_PIECES
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG, Radian, RadianPerSecond, Second

TurnChoice = Literal["left", "right", "shorter"]
"""Which way round to turn to a heading."""
ROLLED_IN: Radian = 2.0 * DEG
"""A turn that lacks less bank than this is being flown [rad]."""


class Program(NamedTuple):
    """What an aircraft is to fly."""

    pieces: tuple[FlyStraight | TurnTo, ...]
    rows: FloatArray
    """The same as the kernels take it. shape (n, 3)"""
    held: Radian
    """Heading before the first piece, continuous [rad]."""
    levels: tuple[tuple[Second, ChangeLevel], ...] = ()
    """Its changes of level, and when each begins, flight time [s]."""


def program_of(
    pieces: tuple[IntentPiece, ...],
    heading: Radian,
    t: Second,
    tas: float,
    max_roll_rate: RadianPerSecond = inf,
) -> Program:
    """An intent from a time on, as it is flown.

    Between opposite turns a straight may be too short to roll out of the one and into the other.
    Then the aircraft rolls from bank to bank, at the time at which it turns as much as declared.

    Args:
        pieces: in the order they are flown.
        heading: before the first, continuous [rad].
        t: flight time at which the first begins [s].
        tas: true airspeed, which with the bank makes the turns take their time [m/s].
        max_roll_rate: of the aircraft [rad/s]; infinite if it need not roll.
    """
    flown: list[FlyStraight | TurnTo] = []
    levels: list[tuple[Second, ChangeLevel]] = []
    rows: list[tuple[float, float, float]] = []
    now = heading
    for piece in pieces:
        match piece:
            case ChangeLevel():
                levels.append((t, piece))
                continue
            case FlyStraight(duration=duration):
                t += duration
                rows.append((STRAIGHT, t, 0.0))
            case TurnTo(heading=to, turn=turn, bank=bank):
                angle = wrap(-turn * (to - now))
                if angle > 2.0 * pi - ROUNDED:
                    angle -= 2.0 * pi  # by rounding: it is there already
                rate = turn_rate(tas, bank)
                match flown[-2:]:
                    case [TurnTo() as before, FlyStraight(duration=pause)] if (
                        before.turn != turn and pause < 0.5 * (before.bank + bank) / max_roll_rate
                    ):
                        del flown[-2:], rows[-1]
                        _, end, before_bank = rows.pop()
                        other = turn_rate(tas, before.bank)
                        end -= before.turn * other * pause * rate / (other + rate)
                        flown.append(replace(before, heading=wrap(end)))
                        rows.append((TURN, end, before_bank))
                    case _:
                        pass
                now -= turn * angle
                t += max(angle, 0.0) / rate
                rows.append((TURN, now, -turn * bank))
        flown.append(piece)
    return Program(tuple(flown), np.array(rows).reshape(-1, 3), heading, tuple(levels))


def turn_program(heading: Radian, to: Radian, direction: TurnChoice, bank: Radian) -> Program:
    """An order to turn to a heading, by the way round that `direction` says."""
    change = wrap_signed(to - heading)
    left = direction == "left" or (direction == "shorter" and change < 0.0)
    turn: Turn = LEFT if left else RIGHT
    piece = TurnTo(heading=wrap(to), turn=turn, bank=bank)
    return program_of((piece,), heading, 0.0, 1.0)


def straight_heading(program: Program, cursor: int) -> Radian:
    """The heading that is held on straights once the pieces before `cursor` are flown [rad]."""
    held = program.held
    for kind, end, _ in program.rows[:cursor].tolist():
        held = end if kind == TURN else held
    return held


def remaining(
    program: Program, cursor: int, body: Body, limits: Limits, t: Second
) -> tuple[IntentPiece, ...]:
    """The part of a program still to be flown, as it will be flown.

    A straight ends when it was declared to, however long the turn before it takes. A turn that is
    still being rolled into comes after what is flown until then, on the present bank: what is
    declared changes its bank at once, half of the roll after its own beginning.

    Args:
        program: the whole.
        cursor: the piece being flown.
        body: the aircraft now.
        limits: how it rolls.
        t: flight time [s].
    """
    left: list[IntentPiece] = []
    heading = body.heading
    for k, piece in enumerate(program.pieces[cursor:], cursor):
        end = float(program.rows[k, 1])
        match piece:
            case FlyStraight():
                left.append(FlyStraight(duration=max(end - t, 0.0)))
                t = max(t, end)
            case TurnTo(turn=turn, bank=bank):
                if k == cursor:
                    if -turn * (end - heading) < ROLLED_OUT:
                        continue
                    into = _rolling_in(piece, end, body, limits)
                    if into is not None and len(program.pieces) - cursor < MAX_PIECES:
                        before, lead, turned = into
                        left.append(before)
                        heading += turned
                        t += lead
                left.append(piece)
                t += -turn * (end - heading) / turn_rate(body.tas, bank)
                heading = end
    return tuple(left)


def _rolling_in(
    piece: TurnTo, end: Radian, body: Body, limits: Limits
) -> tuple[IntentPiece, Second, Radian] | None:
    """What is flown on the present bank before a turn begins, how long, and how far it turns.

    `None` if it is banked as it should be, or rolls out already.
    """
    turn, bank = piece.turn, piece.bank
    if bank + turn * body.bank < ROLLED_IN:
        return None
    if -turn * (end - body.heading) < turn_rate(body.tas, bank) * roll_lead(limits, bank, 0.0):
        return None
    lead = roll_lead(limits, -turn * body.bank, bank)
    if abs(body.bank) < ROLLED_IN:
        return FlyStraight(duration=lead), lead, 0.0
    turned = turn_rate(body.tas, body.bank) * lead
    side: Turn = RIGHT if turned > 0.0 else LEFT
    to = wrap(body.heading + turned)
    return TurnTo(heading=to, turn=side, bank=abs(body.bank)), lead, turned


def intent_after(aircraft: Leader | Traffic, seconds: Second) -> tuple[IntentPiece, ...]:
    """The part of an intent still to be flown after a time [s]."""
    if not aircraft.intent:
        return ()
    left, pieces = seconds, list[IntentPiece]()
    durations = aircraft.trajectory.durations()
    for piece, duration in zip(aircraft.intent, durations, strict=True):
        if left >= duration:
            left -= duration
            continue
        match piece:
            case FlyStraight():
                pieces.append(FlyStraight(duration=duration - left))
            case TurnTo():
                pieces.append(piece)
        left = 0.0
    return tuple(pieces)
