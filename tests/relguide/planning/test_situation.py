"""Situations judge themselves: every refusal is a sentence that says what would be right."""

import json
import re
from dataclasses import replace
from math import cos, inf, nan, pi, remainder, sin

import numpy as np
import pytest
from hypothesis import given

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    FlyStraight,
    Leader,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
    wind_from,
)
from relguide.contract.bodies import situation_from_json
from relguide.flying.orders import LeaderHeading
from relguide.flying.world import Link
from relguide.planning.intent import ROUNDED
from relguide.planning.trajectory import Turn
from relguide.units import DEG, KT, NM
from tests.bodies import BODY
from tests.situations import headings, numbers, situations

PURSUER = Pursuer(x=0.0, y=0.0, heading=0.0, tas=200.0, max_bank=25 * DEG)
LEADER = Leader(x=20_000.0, y=0.0, heading=0.0, tas=180.0)
SITUATION = Situation(
    pursuer=PURSUER, leader=LEADER, slot_distance=12_000.0, min_separation=9_000.0
)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"tas": 29.0}, r"pursuer\.tas must lie in 30 … 400 m/s, not 29 m/s\."),
        ({"tas": 401.0}, r"pursuer\.tas must lie in"),
        ({"max_bank": 0.5 * DEG}, r"pursuer\.max_bank must lie in 1 … 60 °, not 0\.5 °\."),
        ({"max_bank": 61.0 * DEG}, r"pursuer\.max_bank must lie in"),
        ({"x": 1.1e6}, r"pursuer\.x must lie in -1e\+06 … 1e\+06 m"),
        ({"y": nan}, r"pursuer\.y must be a finite number, not nan\."),
        ({"heading": inf}, r"pursuer\.heading must be a finite number, not inf\."),
    ],
)
def test_a_pursuer_that_cannot_be(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(PURSUER, **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"min_separation": -1.0}, r"min_separation must lie in 0 … 200000 m, not -1 m\."),
        ({"slot_distance": 8_000.0}, "must be at least min_separation"),
        ({"slot_distance": 200_001.0}, r"slot_distance must lie in 0 … 200000 m, not 200001 m\."),
        ({"slot_distance": nan}, "slot_distance must be a finite number"),
    ],
)
def test_distances_that_contradict_each_other(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(SITUATION, **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize("degrees", [90, 90.0, -45.0, 359.0])
def test_degrees_given_as_radians_are_asked_about(degrees: float) -> None:
    meant = "Did you mean degrees? Then use from_display, or math.radians."
    for make in (
        lambda: replace(PURSUER, heading=degrees),
        lambda: replace(LEADER, heading=degrees),
        lambda: TurnTo(heading=degrees, turn=LEFT, bank=0.4),
        lambda: wind_from(degrees, 10.0),
        lambda: LeaderHeading(heading=degrees),
    ):
        with pytest.raises(ValueError, match=re.escape(meant)):
            make()


def test_degrees_of_bank_and_knots_are_asked_about() -> None:
    with pytest.raises(
        ValueError, match=r"not 1432\.39449 °\. Did you mean degrees\? Then use from"
    ):
        replace(PURSUER, max_bank=25)
    with pytest.raises(
        ValueError, match=r"not 465 m/s\. Did you mean knots\? 465 kt are 239\.2 m/s\."
    ):
        replace(PURSUER, tas=465)
    for unclear in ({"tas": 29.0}, {"tas": 1e4}, {"max_bank": 1.2}, {"max_bank": 61.0}):
        with pytest.raises(ValueError, match=r"[^?]+$") as refused:
            replace(PURSUER, **unclear)  # type: ignore[arg-type]
        assert "?" not in str(refused.value)


def test_the_sum_of_two_headings_is_a_heading() -> None:
    assert replace(PURSUER, heading=3.9 * pi).heading == 3.9 * pi
    display = {"x_nm": 0.0, "y_nm": 0.0, "tas_kt": 400.0}
    for degrees, once in ((90.0, 90.0), (-90.0, -90.0), (360.0, 0.0), (630.0, 270.0)):
        made = Pursuer.from_display(heading_deg=degrees, max_bank_deg=25.0, **display)
        assert made.heading == once * DEG
        assert Leader.from_display(heading_deg=degrees, **display).heading == once * DEG


def test_miles_given_as_metres_are_asked_about() -> None:
    with pytest.raises(ValueError, match=r"slot_distance is in metres, .* Did you mean 6 NM\?"):
        replace(SITUATION, slot_distance=6, min_separation=5)
    with pytest.raises(ValueError, match=r"min_separation is in metres, .* else give it as 5\.0\."):
        replace(SITUATION, min_separation=5)
    with pytest.raises(ValueError, match=r"slot_distance is in metres, .* Did you mean 6 NM\?"):
        Link(pursuer="P", leader="L", slot_distance=6, min_separation=5)


def test_what_the_contract_allows_is_allowed() -> None:
    """D and d_min of 0, and of a few metres as numbers that a program has read."""
    assert replace(SITUATION, slot_distance=0, min_separation=0).slot_distance == 0.0
    assert replace(SITUATION, slot_distance=6.0, min_separation=5.0).min_separation == 5.0
    body = BODY | {"slot_distance_m": 6, "min_separation_m": 5}
    body |= {"pursuer": BODY["pursuer"] | {"heading_deg": 720}}
    read, _ = situation_from_json(json.dumps(body))
    assert (read.slot_distance, read.min_separation) == (6.0, 5.0)
    assert read.pursuer.heading == 0.0


def test_bounds_in_degrees_survive_radians() -> None:
    for bank in (1.0, 60.0):
        replace(PURSUER, max_bank=bank / 180.0 * pi)


def test_an_intent_that_cannot_be() -> None:
    with pytest.raises(ValueError, match="at most 20 pieces, not 21"):
        replace(LEADER, intent=(FlyStraight(duration=1.0),) * 21)
    with pytest.raises(ValueError, match=r"straight\.duration must lie in"):
        FlyStraight(duration=-1.0)
    with pytest.raises(ValueError, match="LEFT"):
        TurnTo(heading=0.0, turn=0, bank=0.3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"turn\.bank must lie in"):
        TurnTo(heading=0.0, turn=LEFT, bank=1.2)


def test_a_wind_that_holds_the_leader_over_one_spot() -> None:
    with pytest.raises(ValueError, match="no headway"):
        replace(SITUATION, leader=replace(LEADER, tas=100.0), wind=Wind(east=0.0, north=-100.0))
    with pytest.raises(ValueError, match=r"wind\.speed must lie in"):
        Wind(east=200.0)


@given(direction=headings, speed=numbers(0.0, 100.0))
def test_wind_blows_from_where_it_comes(direction: float, speed: float) -> None:
    wind = wind_from(direction, speed)
    assert wind.east == pytest.approx(-speed * sin(direction))
    assert wind.north == pytest.approx(-speed * cos(direction))
    assert wind.speed == pytest.approx(speed)


@given(start=headings, end=headings)
def test_a_turn_ends_on_its_heading_and_both_ways_make_a_full_one(start: float, end: float) -> None:
    angles = []
    for turn in (LEFT, RIGHT):
        leader = replace(LEADER, heading=start, intent=(TurnTo(heading=end, turn=turn, bank=0.4),))
        arc = leader.trajectory.segments[0]
        assert isinstance(arc, Arc)
        assert arc.turn == turn or arc.turn_angle < ROUNDED
        off = (leader.trajectory.breakpoints()[-1].heading - end) % (2.0 * pi)
        assert min(off, 2.0 * pi - off) < 1e-9
        angles.append(arc.turn_angle)
    apart = (start - end) % (2.0 * pi)
    if ROUNDED < apart < 2.0 * pi - ROUNDED:  # to the present heading is no turn, either way
        assert sum(angles) == pytest.approx(2.0 * pi, abs=1e-9)
    else:
        assert max(angles) <= ROUNDED * (1.0 + 1e-9)


def test_in_the_units_of_aviation_it_is_the_same_situation() -> None:
    shown = Situation.from_display(
        pursuer=Pursuer.from_display(
            x_nm=-20.0, y_nm=10.0, heading_deg=90.0, tas_kt=460.0, max_bank_deg=25.0
        ),
        leader=Leader.from_display(
            x_nm=1.0,
            y_nm=2.0,
            heading_deg=80.0,
            tas_kt=400.0,
            intent=(
                FlyStraight(duration=60.0),
                TurnTo.from_display(heading_deg=135.0, direction="right", bank_deg=20.0),
            ),
        ),
        slot_distance_nm=6.0,
        min_separation_nm=5.0,
        wind_from_deg=270.0,
        wind_kt=30.0,
    )
    assert shown == Situation(
        pursuer=Pursuer(
            x=-20.0 * NM, y=10.0 * NM, heading=90.0 * DEG, tas=460.0 * KT, max_bank=25.0 * DEG
        ),
        leader=Leader(
            x=1.0 * NM,
            y=2.0 * NM,
            heading=80.0 * DEG,
            tas=400.0 * KT,
            intent=(
                FlyStraight(duration=60.0),
                TurnTo(heading=135.0 * DEG, turn=RIGHT, bank=20.0 * DEG),
            ),
        ),
        slot_distance=6.0 * NM,
        min_separation=5.0 * NM,
        wind=wind_from(270.0 * DEG, 30.0 * KT),
    )
    left = TurnTo.from_display(heading_deg=0.0, direction="left", bank_deg=20.0)
    assert left.turn == LEFT
    with pytest.raises(ValueError, match="direction must be 'left' or 'right', not 'up'"):
        TurnTo.from_display(heading_deg=0.0, direction="up", bank_deg=20.0)  # type: ignore[arg-type]


@given(situation=situations())
def test_it_prints_as_code_to_paste(situation: Situation) -> None:
    assert eval(repr(situation)) == situation


def test_what_is_as_always_is_not_printed() -> None:
    assert repr(Wind()) == "Wind()"
    assert repr(FlyStraight(duration=1.0)) == "FlyStraight(duration=1.0)"
    leader = Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)
    assert repr(leader) == "Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)"


@pytest.mark.parametrize(("turn", "sign"), [(LEFT, -1.0), (RIGHT, 1.0)])
@pytest.mark.parametrize("degrees", [0.1, 90.1, 199.7, 359.9])
def test_a_turn_that_misses_a_full_one_by_32_bit_rounding_is_none(
    turn: Turn, sign: float, degrees: float
) -> None:
    """Headings that were kept as 32-bit numbers, in degrees or in radians."""
    near = (float(np.float32(degrees)) * DEG, float(np.float32(degrees * DEG)))
    for kept in near:
        for held, to in ((kept, degrees * DEG), (degrees * DEG, kept)):
            piece = TurnTo(heading=to, turn=turn, bank=20.0 * DEG)
            leader = Leader(x=0.0, y=0.0, heading=held, tas=200.0, intent=(piece,))
            (arc,) = leader.trajectory.segments
            assert isinstance(arc, Arc)
            assert arc.turn_angle < 1e-6
            # and still it ends on the heading that was declared
            end = leader.trajectory.pose_at(leader.trajectory.duration).heading
            assert remainder(end - to, 2.0 * pi) == pytest.approx(0.0, abs=1e-9)
            # a degree more is a turn that was meant
            meant = replace(piece, heading=to - sign * 1.0 * DEG)
            (arc,) = replace(leader, intent=(meant,)).trajectory.segments
            assert isinstance(arc, Arc)
            assert arc.turn_angle == pytest.approx(359.0 * DEG, abs=1e-6)
