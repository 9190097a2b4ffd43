"""What was declared is flown: turns begin half a roll early and go as far round as was said."""

from math import hypot, inf

import numpy as np
import pytest

from relguide.flying.leaders.declared import Program, program_of
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Control
from relguide.kernels.flight.program import (
    fly_program,
    next_piece,
    program_control,
    roll_lead,
    until_roll,
)
from relguide.kernels.flight.second import PROGRAMMED
from relguide.planning.aircraft import Leader
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG
from tests.aloft import LIMITS, STEP, STILL, fly_second, level, steady

TAS = 200.0
STARTS = 90.0
"""Heading of each flight's start, in degrees."""


def turn_to(degrees: float, turn: Turn, bank: float = 25.0) -> TurnTo:
    return TurnTo(heading=degrees % 360.0 * DEG, turn=turn, bank=bank * DEG)


def straight(duration: float) -> FlyStraight:
    return FlyStraight(duration=duration)


def fly(
    pieces: tuple[IntentPiece, ...], duration: float, *, step: float = STEP
) -> tuple[FloatArray, int]:
    """A program from its start on: rows at each step, and the piece that is then flown."""
    program: Program = program_of(pieces, STARTS * DEG, 0.0, TAS)
    steps = round(1.0 / step)
    states, cursors = np.array([level(heading=STARTS, tas=TAS)]), np.zeros(1, dtype=np.int64)
    rows = [states.copy()]
    for second in range(round(duration)):
        trace = np.zeros((1, steps + 1, 7))
        fly_second(
            states, np.array([LIMITS]), np.full(1, PROGRAMMED), np.array([[0.0, 0.0, TAS]]),
            program.rows[np.newaxis], np.full(1, len(pieces)), cursors,
            np.array([program.held]), steady(STILL, 1, steps), float(second), step, trace,
            np.zeros((1, 4)),
        )  # fmt: skip
        rows.append(trace[0, 1:])
    return np.vstack(rows), int(cursors[0])


def leader_with(pieces: tuple[IntentPiece, ...]) -> Leader:
    return Leader(x=0.0, y=0.0, heading=STARTS * DEG, tas=TAS, intent=pieces)


@pytest.mark.parametrize(
    ("pieces", "off"),
    [
        ((), 1e-3),
        ((straight(60.0),), 1e-3),
        ((straight(60.0), turn_to(135.0, RIGHT)), 30.0),
        ((straight(20.0), turn_to(80.0, LEFT), straight(30.0)), 30.0),
        ((straight(30.0), turn_to(180.0, RIGHT), straight(40.0), turn_to(90.0, LEFT)), 60.0),
        # a turn that begins at once cannot be led: it comes 3 or 4 s late
        ((turn_to(30.0, LEFT, bank=15.0),), 600.0),
        ((turn_to(180.0, RIGHT), straight(40.0), turn_to(90.0, LEFT)), 1200.0),
    ],
)
def test_what_is_flown_is_what_was_declared(pieces: tuple[IntentPiece, ...], off: float) -> None:
    meant, (rows, cursor) = leader_with(pieces).trajectory, fly(pieces, 450.0)
    for t in (50, 150, 450):
        pose = meant.pose_at(float(t))
        at = rows[round(t / STEP)]
        assert hypot(at[0] - pose.x, at[1] - pose.y) < off
    change = sum(
        -piece.turn * segment.turn_angle
        for piece, segment in zip(pieces, meant.segments, strict=False)
        if isinstance(piece, TurnTo)
    )
    assert rows[-1, 2] == pytest.approx(STARTS * DEG + change, abs=0.2 * DEG)
    assert cursor == len(pieces)


@pytest.mark.parametrize("angle", [5.0, 90.0, 355.0, 359.0])
@pytest.mark.parametrize("turn", [LEFT, RIGHT])
def test_any_turn_is_flown_as_declared(angle: float, turn: Turn) -> None:
    side = -turn
    pieces = (straight(20.0), turn_to(STARTS + side * angle, turn))
    rows, _ = fly(pieces, 320.0)
    headings = rows[:, 2]
    assert headings[-1] == pytest.approx((STARTS + side * angle) * DEG, abs=0.1 * DEG)
    # continuous: no faster than at full bank, and no way back
    fastest = turn_rate(TAS, LIMITS.max_bank) * STEP
    assert np.max(np.abs(np.diff(headings))) <= fastest * (1.0 + 1e-9)
    assert np.min(side * (headings - STARTS * DEG)) > -0.01 * DEG
    assert np.max(side * (headings - STARTS * DEG)) < (angle + 0.3) * DEG


@pytest.mark.parametrize("bank", [10.0, -25.0])
def test_a_turn_begins_half_a_roll_early(bank: float) -> None:
    program = np.array([[0.0, 60.0, 0.0], [1.0, 3.0, bank * DEG]])
    lead = roll_lead(LIMITS, 0.0, bank * DEG)
    body = level(heading=STARTS, tas=TAS)

    def asked(t: float) -> Control:
        return program_control(program, 0, STARTS * DEG, body, LIMITS, t, TAS)

    assert asked(60.0 - lead - 0.1) == Control(HOLD_HEADING, STARTS * DEG, TAS)
    early = asked(60.0 - lead + 0.1)
    if bank > 0.0:
        assert early == Control(TURN_RATE, turn_rate(TAS, bank * DEG), TAS)
    else:  # its heading lies to the right: it is there at once, and held
        assert early == Control(HOLD_HEADING, 3.0, TAS)


def test_a_straight_that_was_led_into_a_turn_ends_when_declared() -> None:
    program = np.array([[0.0, 60.0, 0.0], [1.0, 3.0, 0.4]])
    assert next_piece(program, 0, level(), LIMITS, 59.99) == 0
    assert next_piece(program, 0, level(), LIMITS, 60.0) == 1
    assert next_piece(program, 1, level(heading=3.0 / DEG - 1.1), LIMITS, 99.0) == 1
    assert next_piece(program, 1, level(heading=3.0 / DEG - 0.9), LIMITS, 99.0) == 2
    assert next_piece(program, 2, level(), LIMITS, 99.0) == 2


@pytest.mark.parametrize(
    ("pieces", "off"),
    [
        # the reversal displaces it by 110 m
        ((straight(30.0), turn_to(180.0, RIGHT), turn_to(90.0, LEFT)), 160.0),
        ((straight(30.0), turn_to(130.0, RIGHT, bank=15.0), turn_to(200.0, RIGHT)), 40.0),
        ((straight(30.0), turn_to(180.0, RIGHT), straight(8.0), turn_to(90.0, LEFT)), 160.0),
    ],
)
def test_turns_in_a_row_are_rolled_from_bank_to_bank(
    pieces: tuple[IntentPiece, ...], off: float
) -> None:
    """Rolled out of the first and settled before the second, it would come 2 km off."""
    meant, (rows, cursor) = leader_with(pieces).trajectory, fly(pieces, 240.0)
    apart = [
        hypot(rows[20 * t, 0] - pose.x, rows[20 * t, 1] - pose.y)
        for t in range(241)
        for pose in (meant.pose_at(float(t)),)
    ]
    assert max(apart) < off
    assert cursor == len(pieces)
    assert rows[-1, 2] == pytest.approx(meant.pose_at(240.0).heading, abs=0.1 * DEG)


def test_a_turn_is_rolled_out_of_half_a_roll_early() -> None:
    end, bank = 2.0, 20.0 * DEG
    program = np.array([[1.0, end, bank]])
    rate, lead = turn_rate(TAS, bank), roll_lead(LIMITS, bank, 0.0)
    for left, kind in ((1.05, TURN_RATE), (0.95, HOLD_HEADING)):
        body = level(heading=(end - left * rate * lead) / DEG, bank=20.0, tas=TAS)
        asked = program_control(program, 0, 0.0, body, LIMITS, 30.0, TAS)
        assert asked.kind == kind
        assert asked.value == pytest.approx(rate if kind == TURN_RATE else end)


def test_after_the_last_piece_its_heading_is_held() -> None:
    program = np.array([[1.0, 2.0, 0.4], [0.0, 90.0, 0.0]])
    body = level(heading=2.0 / DEG)
    assert program_control(program, 2, 0.0, body, LIMITS, 99.0, TAS).value == 2.0
    assert program_control(program, 1, 0.0, body, LIMITS, 99.0, TAS).value == 2.0
    assert program_control(np.zeros((0, 3)), 0, 0.7, body, LIMITS, 99.0, TAS).value == 0.7


def test_lead_is_half_the_roll_and_the_lag() -> None:
    roll_in = roll_lead(LIMITS, 0.0, 25.0 * DEG)
    assert 3.5 < roll_in < 5.0
    assert roll_lead(LIMITS, -25.0 * DEG, 25.0 * DEG) > 1.7 * roll_in


@pytest.mark.parametrize("first", [30.0, 30.02, 30.04, 30.2])
def test_what_is_flown_hardly_depends_on_the_step(first: float) -> None:
    """Rolls begin when they are due, within a step: else 0.25 s would be worth 60 m in a turn."""
    pieces = (straight(first), turn_to(180.0, RIGHT), straight(40.0), turn_to(90.0, LEFT))
    fine, _ = fly(pieces, 240.0, step=0.01)
    for step, off in ((0.05, 1.5), (0.25, 8.0)):
        rows, _ = fly(pieces, 240.0, step=step)
        apart = rows[:: round(1.0 / step), :2] - fine[::100, :2]
        assert np.max(np.hypot(*apart.T)) < off


def test_a_roll_begins_within_a_step() -> None:
    lead = roll_lead(LIMITS, 0.0, 0.4)
    program = np.array([[0.0, 60.0, 0.0], [1.0, 3.0, 0.4]])
    body = level(tas=TAS)
    assert until_roll(program, 0, body, LIMITS, 60.0 - lead - 0.3) == pytest.approx(0.3)
    assert until_roll(program[:1], 0, body, LIMITS, 0.0) == inf
    assert until_roll(program, 2, body, LIMITS, 99.0) == inf

    def bank_after(step: float) -> float:
        return fly_program(
            program, 0, 0.0, body, LIMITS, STILL, 60.0 - lead - 0.3, step, TAS
        )[0].bank  # fmt: skip

    assert bank_after(0.29) == 0.0
    late = fly_program(program, 0, 0.0, body, LIMITS, STILL, 60.0 - lead, 0.2, TAS)[0].bank
    assert bank_after(0.5) == pytest.approx(late)
