"""The leader flies what it declared, and does what it is turning."""

from dataclasses import replace
from math import hypot, pi

import pytest

from relguide.flying.aircraft import A300, AircraftState
from relguide.flying.autopilot import Autopilot
from relguide.flying.leader import (
    FlyingLeader,
    LeaderFlight,
    TurnChoice,
    advance_leader,
    set_leader_speed,
    turn_leader,
)
from relguide.planning.situation import CALM, FlyStraight, IntentPiece, Leader, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG

STATE = AircraftState(0.0, 0.0, 90.0 * DEG, 0.0, 0.0, 200.0, 9449.0)


def leader(*pieces: IntentPiece) -> FlyingLeader:
    return FlyingLeader(state=STATE, pieces=pieces, since=0.0, heading=STATE.heading, tas=200.0)


def turn_to(degrees: float, turn: Turn, bank: float = 25.0) -> TurnTo:
    return TurnTo(heading=degrees * DEG, turn=turn, bank=bank * DEG)


def after(flying: LeaderFlight, duration: float, start: float = 0.0) -> LeaderFlight:
    autopilot = Autopilot(model=A300)
    for n in range(round(duration / 0.05)):
        flying = advance_leader(flying, autopilot, start + n * 0.05, wind=CALM, duration=0.05)
    return flying


@pytest.mark.parametrize(
    "pieces",
    [
        (),
        (FlyStraight(duration=60.0),),
        (FlyStraight(duration=60.0), turn_to(135.0, RIGHT)),
        (turn_to(30.0, LEFT, bank=15.0),),
        (FlyStraight(duration=20.0), turn_to(80.0, RIGHT), FlyStraight(duration=30.0)),
        (turn_to(180.0, RIGHT), FlyStraight(duration=40.0), turn_to(90.0, LEFT)),
    ],
)
def test_what_is_flown_is_what_was_declared(pieces: tuple[IntentPiece, ...]) -> None:
    """To 3 s of flight: the roll into a first turn comes late, as nobody could announce it."""
    declared = Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=200.0, intent=pieces).trajectory
    for t in (50.0, 150.0, 450.0):
        flown, meant = after(leader(*pieces), t).state, declared.pose_at(t)
        assert hypot(flown.x - meant.x, flown.y - meant.y) < 3.0 * 200.0 + 100.0 * len(pieces)
    off = (flown.heading - declared.pose_at(450.0).heading + pi) % (2.0 * pi) - pi
    assert abs(off) < 0.2 * DEG


def test_announced_turn_is_flown_within_a_hundred_metres() -> None:
    pieces = (FlyStraight(duration=60.0), turn_to(135.0, RIGHT))
    declared = Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=200.0, intent=pieces).trajectory
    flown, meant = after(leader(*pieces), 200.0).state, declared.pose_at(200.0)
    assert hypot(flown.x - meant.x, flown.y - meant.y) < 100.0


def test_what_remains_of_the_intent_shrinks_to_nothing() -> None:
    pieces = (FlyStraight(duration=60.0), turn_to(135.0, RIGHT))
    start = leader(*pieces)
    assert start.remaining_intent(0.0) == pieces
    assert start.remaining_intent(45.0)[0] == FlyStraight(duration=15.0)
    assert after(start, 75.0).remaining_intent(75.0) == pieces[1:]
    assert after(start, 150.0).remaining_intent(150.0) == ()


@pytest.mark.parametrize(("direction", "side"), [("left", -1.0), ("right", 1.0), ("shorter", -1.0)])
def test_a_heading_is_turned_to_in_the_direction_given(direction: TurnChoice, side: float) -> None:
    turning = turn_leader(leader(), 0.0, 30.0 * DEG, direction, 25.0 * DEG)
    assert after(turning, 20.0).state.bank * side > 20.0 * DEG
    assert after(turning, 400.0).state.heading == pytest.approx(30.0 * DEG, abs=0.2 * DEG)


def test_command_drops_the_rest_of_the_intent() -> None:
    before = leader(FlyStraight(duration=60.0), turn_to(135.0, RIGHT))
    turning = turn_leader(before, 10.0, 60.0 * DEG, "shorter", 25.0 * DEG)
    assert turning.remaining_intent(10.0) == (turn_to(60.0, LEFT),)
    assert after(turning, 200.0, start=10.0).state.heading == pytest.approx(60.0 * DEG, abs=0.01)


def test_a_speed_is_taken_up_and_the_intent_kept() -> None:
    turning = set_leader_speed(leader(turn_to(135.0, RIGHT)), 0.0, 180.0)
    assert turning.pieces
    assert after(turning, 120.0).state.tas == pytest.approx(180.0, abs=0.1)


def test_a_hair_past_the_heading_is_no_full_turn() -> None:
    past = leader(turn_to(89.5, RIGHT))._replace(state=STATE)
    flown = after(past, 60.0).state
    assert abs(flown.bank) < 5.0 * DEG
    assert replace(turn_to(89.5, RIGHT)).heading == pytest.approx(flown.heading, abs=0.2 * DEG)
