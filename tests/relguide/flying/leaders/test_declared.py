"""Intents become programs, and what is left of a program is an intent again."""

from math import hypot, pi

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from relguide.flying.leaders.declared import Program, program_of, remaining, turn_program
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import Body
from relguide.kernels.flight.program import STRAIGHT, TURN, fly_program, roll_lead
from relguide.planning.aircraft import Leader
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.limits import MAX_PIECES
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG
from tests.aloft import LIMITS, STEP, STILL, level

TAS = 200.0


def turn_to(degrees: float, turn: Turn, bank: float = 25.0) -> TurnTo:
    return TurnTo(heading=degrees % 360.0 * DEG, turn=turn, bank=bank * DEG)


def straight(duration: float) -> FlyStraight:
    return FlyStraight(duration=duration)


intents = st.lists(
    st.one_of(
        st.builds(straight, st.floats(0.0, 200.0)),
        st.builds(
            turn_to, st.floats(0.0, 359.9), st.sampled_from((LEFT, RIGHT)), st.floats(10, 25)
        ),
    ),
    max_size=5,
).map(tuple)


@example((TurnTo(heading=1.7e-8, turn=LEFT, bank=0.2),), 0.0, 0.0)
@given(intents, st.floats(-20.0, 20.0), st.floats(0.0, 900.0))
def test_a_program_turns_as_far_and_lasts_as_long_as_its_intent(
    pieces: tuple[IntentPiece, ...], heading: float, t: float
) -> None:
    """Headings are counted on from whatever the leader's own is."""
    program = program_of(pieces, heading, t, TAS)
    declared = Leader(x=0.0, y=0.0, heading=heading % (2.0 * pi), tas=TAS, intent=pieces)
    now, end = heading, t
    segments = zip(declared.trajectory.segments, declared.trajectory.durations(), strict=True)
    for piece, (kind, value, bank), (segment, duration) in zip(
        pieces, program.rows, segments, strict=True
    ):
        end += duration
        match piece:
            case FlyStraight():
                assert (kind, bank) == (STRAIGHT, 0.0)
                assert value == pytest.approx(end)
            case TurnTo(heading=to, turn=turn):
                assert kind == TURN
                assert bank == -turn * piece.bank
                angle = -turn * (value - now)
                assert abs(angle - segment.turn_angle) < 1e-6
                assert abs((value - to + pi) % (2.0 * pi) - pi) < 1e-9
                now = value
    assert program.held == heading


def test_a_hair_past_the_heading_is_no_full_turn() -> None:
    past = program_of((turn_to(90.0, RIGHT),), 90.0 * DEG + 1e-12, 0.0, TAS)
    assert past.rows[0, 1] == pytest.approx(90.0 * DEG)
    before = program_of((turn_to(89.0, RIGHT),), 90.0 * DEG, 0.0, TAS)
    assert before.rows[0, 1] == pytest.approx(449.0 * DEG)


@pytest.mark.parametrize(
    ("to", "direction", "turned"),
    [
        (30.0, "shorter", -60.0),
        (30.0, "left", -60.0),
        (30.0, "right", 300.0),
        (100.0, "shorter", 10.0),
        (271.0, "shorter", -179.0),
        (91.0, "left", -359.0),
    ],
)
@pytest.mark.parametrize("turns", [-2, 0, 1])
def test_an_order_turns_the_way_round_that_it_says(
    to: float, direction: str, turned: float, turns: int
) -> None:
    now = (90.0 + 360.0 * turns) * DEG
    program = turn_program(now, to * DEG, direction, 25.0 * DEG)  # type: ignore[arg-type]
    assert program.rows[0, 1] - now == pytest.approx(turned * DEG)
    assert np.sign(program.rows[0, 2]) == np.sign(turned)


def fly_seconds(program: Program, seconds: int) -> list[tuple[float, Body, int]]:
    """Flight time, the aircraft and its piece, each second."""
    body, cursor = level(heading=program.held / DEG, tas=TAS), 0
    rows = [(0.0, body, cursor)]
    for k in range(round(seconds / STEP)):
        body, cursor = fly_program(
            program.rows, cursor, program.held, body, LIMITS, STILL, k * STEP, STEP, TAS
        )
        if (k + 1) % 20 == 0:
            rows.append(((k + 1) * STEP, body, cursor))
    return rows


def test_what_is_left_of_an_intent_shrinks_to_nothing() -> None:
    first, turn_right = straight(60.0), turn_to(135.0, RIGHT)
    pieces = (first, turn_right)
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    rows = fly_seconds(program, 160)

    def left(t: int) -> tuple[IntentPiece, ...]:
        when, body, cursor = rows[t]
        return remaining(program, cursor, body, LIMITS, when)

    assert left(0) == pieces
    rest, turn = left(45)
    assert isinstance(rest, FlyStraight)
    assert (rest.duration, turn) == (pytest.approx(first.duration - 45.0), turn_right)
    assert left(75) == pieces[1:]
    assert left(150) == ()


@pytest.mark.parametrize(
    ("pieces", "off"),
    [
        ((straight(40.0), turn_to(200.0, RIGHT)), 250.0),
        ((turn_to(60.0, LEFT, bank=20.0), straight(50.0), turn_to(120.0, RIGHT)), 250.0),
        ((straight(30.0), turn_to(85.0, LEFT)), 60.0),
        ((straight(10.0), turn_to(95.0, LEFT, bank=20.0)), 60.0),
        ((straight(30.0), turn_to(130.0, RIGHT, bank=15.0), turn_to(200.0, RIGHT)), 250.0),
        # rolled from one side to the other, it is beside what bank that jumps would fly
        ((straight(30.0), turn_to(180.0, RIGHT), turn_to(90.0, LEFT)), 350.0),
        # rolled into the second before it has settled after the first
        ((straight(30.0), turn_to(180.0, RIGHT), straight(8.0), turn_to(90.0, LEFT)), 350.0),
    ],
)
def test_what_is_left_leads_to_where_the_leader_will_be(
    pieces: tuple[IntentPiece, ...], off: float
) -> None:
    """400 s after the start, seen from any time; 0.2 km off while it rolls in ahead of a turn."""
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    rows = fly_seconds(program, 400)
    _, end, _ = rows[-1]
    for t, body, cursor in rows[:400]:
        intent = remaining(program, cursor, body, LIMITS, t)
        if not intent:
            break  # a degree is still to go, 10 s long
        now = Leader(x=body.x, y=body.y, heading=body.heading % (2.0 * pi), tas=TAS, intent=intent)
        then = now.trajectory.pose_at(400.0 - t)
        assert hypot(then.x - end.x, then.y - end.y) < off


def test_a_straight_ends_when_it_was_declared_to_however_late_the_turn_before_it() -> None:
    pieces = (turn_to(180.0, RIGHT), straight(40.0), turn_to(90.0, LEFT))
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    left = remaining(program, 0, level(heading=90.0, tas=TAS), LIMITS, 0.0)
    lead = roll_lead(LIMITS, 0.0, 25.0 * DEG)
    assert [type(piece) for piece in left] == [FlyStraight, TurnTo, FlyStraight, TurnTo]
    straights = [piece.duration for piece in left if isinstance(piece, FlyStraight)]
    assert straights == pytest.approx([lead, 40.0 - lead])


def test_a_turn_half_rolled_into_is_flown_at_the_present_bank_until_then() -> None:
    pieces = (turn_to(180.0, RIGHT),)
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    body = level(heading=92.0, bank=10.0, tas=TAS)
    before, after = remaining(program, 0, body, LIMITS, 3.0)
    lead = roll_lead(LIMITS, 10.0 * DEG, 25.0 * DEG)
    assert isinstance(before, TurnTo)
    assert (before.turn, before.bank) == (RIGHT, pytest.approx(10.0 * DEG))
    assert before.heading == pytest.approx(body.heading + lead * turn_rate(TAS, body.bank))
    assert after == pieces[0]


def test_a_turn_still_rolled_into_comes_after_a_short_straight() -> None:
    pieces = (turn_to(180.0, RIGHT),)
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    lead = roll_lead(LIMITS, 0.0, 25.0 * DEG)
    level_now = level(heading=90.0, tas=TAS)
    assert remaining(program, 0, level_now, LIMITS, 0.0) == (straight(lead), *pieces)
    turning = level(heading=120.0, bank=24.0, tas=TAS)
    assert remaining(program, 0, turning, LIMITS, 20.0) == pieces
    # nearly done, it rolls out: no straight before what is left
    rate = turn_rate(TAS, 25.0 * DEG)
    out = level(heading=180.0 - 0.8 * lead * rate / DEG, bank=12.0, tas=TAS)
    assert remaining(program, 0, out, LIMITS, 60.0) == pieces
    assert remaining(program, 0, level(heading=179.5, tas=TAS), LIMITS, 70.0) == ()


def test_the_short_straight_never_makes_an_intent_too_long() -> None:
    pieces = tuple(turn_to(60.0 * k, RIGHT) for k in range(2, 2 + MAX_PIECES))
    program = program_of(pieces, 90.0 * DEG, 0.0, TAS)
    assert remaining(program, 0, level(heading=90.0, tas=TAS), LIMITS, 0.0) == pieces


@pytest.mark.parametrize("pause", [0.01, 2.0, 3.0])
@pytest.mark.parametrize("banks", [(25.0, 25.0), (25.0, 15.0), (15.0, 25.0)])
def test_across_a_straight_too_short_to_roll_out_it_rolls_from_bank_to_bank(
    pause: float, banks: tuple[float, float]
) -> None:
    one, other = banks
    turns = turn_to(180.0, RIGHT, one), straight(pause), turn_to(80.0, LEFT, other)
    intent = (straight(30.0), *turns)
    declared = Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=TAS, intent=intent)
    there = declared.trajectory.pose_at(400.0)
    program = program_of(intent, 90.0 * DEG, 0.0, TAS, LIMITS.max_roll_rate)
    assert [type(piece) for piece in program.pieces] == [FlyStraight, TurnTo, TurnTo]
    _, end, cursor = fly_seconds(program, 400)[-1]
    assert cursor == 3
    assert hypot(end.x - there.x, end.y - there.y) < 220.0  # a roll across costs so much
    _, late, _ = fly_seconds(program_of(intent, 90.0 * DEG, 0.0, TAS), 400)[-1]
    assert hypot(late.x - there.x, late.y - there.y) > 500.0  # late by up to 10 s
