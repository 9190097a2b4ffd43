"""A heading that keeps clear, wherever the leader's turn ends: and it does when flown."""

from dataclasses import replace
from math import inf

import pytest

from relguide.flying.guidance.escape import escape, kept_on_heading
from relguide.flying.scenarios import own_scenario
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT
from relguide.units import DEG, NM
from tests.relguide.flying.guidance.beliefs import Watched, behind

LIMIT = 5.0 * NM


def ahead_of_us(*, along: float, heading: float, intent_known: bool = True) -> Watched:
    """The leader ahead to the north, on some heading [rad]."""
    near = behind(along=along)
    leader = replace(near.situation.leader, heading=heading)
    return Watched(
        replace(near, situation=replace(near.situation, leader=leader), intent_known=intent_known)
    )


def flown_least(watched: Watched, heading: float, seconds: int) -> float:
    """The least separation on a held heading."""
    least, own = inf, watched.belief.own
    for _ in range(seconds):
        watched.fly(Control(HOLD_HEADING, heading, own.tas))
        least = min(least, watched.fleet.least_apart(0, 1))
    return least


def test_clear_as_it_is_it_flies_straight_on() -> None:
    watched = ahead_of_us(along=30_000.0, heading=0.0)
    out = escape(watched.belief, watched.assignment, LIMIT)
    assert out.heading == pytest.approx(0.0, abs=1e-9)
    assert out.least_separation >= LIMIT


@pytest.mark.parametrize(
    ("along", "heading"),
    [
        (32_000.0, 180.0),
        (40_000.0, 180.0),
        (60_000.0, 180.0),
        (32_000.0, 150.0),
        (32_000.0, 215.0),
    ],
)
def test_what_comes_towards_it_is_turned_away_from(along: float, heading: float) -> None:
    watched = ahead_of_us(along=along, heading=heading * DEG)
    before = kept_on_heading(watched.belief, watched.assignment, 0.0).least_separation
    out = escape(watched.belief, watched.assignment, LIMIT)
    assert before < LIMIT <= out.least_separation
    assert abs(wrap_signed(out.heading)) > 5.0 * DEG
    # planned at 22.5° of bank with its roll; the loop's soft end costs some metres
    assert flown_least(watched, out.heading, 180) >= LIMIT - 60.0


def test_where_no_heading_keeps_clear_it_goes_where_most_is_kept() -> None:
    watched = ahead_of_us(along=11_000.0, heading=180.0 * DEG)
    out = escape(watched.belief, watched.assignment, LIMIT)
    assert out.least_separation < LIMIT
    for degrees in range(-120, 121, 10):
        kept = kept_on_heading(watched.belief, watched.assignment, degrees * DEG).least_separation
        assert kept <= out.least_separation + 250.0  # its turns are 10° apart


def test_no_turn_is_so_far_that_the_shorter_way_is_the_other_one() -> None:
    """All great turns keep the same here; at 180° the autopilot hesitated, and lost the limit."""
    turn = TurnTo(heading=1.5 * DEG, turn=LEFT, bank=22.4 * DEG)
    situation = Situation(
        pursuer=Pursuer(x=19_414.0, y=-11_558.0, heading=5.026, tas=202.4, max_bank=25.0 * DEG),
        leader=Leader(
            x=0.0, y=0.0, heading=2.662, tas=196.5, intent=(FlyStraight(duration=152.7), turn)
        ),
        slot_distance=11_368.0,
        min_separation=8_934.0,
    )
    watched = Watched(own_scenario(situation))
    out = escape(watched.belief, watched.assignment, watched.assignment.buffered_separation)
    assert 20.0 * DEG < wrap_signed(out.heading - situation.pursuer.heading) < 179.0 * DEG
    assert flown_least(watched, out.heading, 70) >= 8_934.0


def test_the_heading_nearest_to_the_present_one_is_taken() -> None:
    """Half of that turn does not keep clear."""
    watched = ahead_of_us(along=30_000.0, heading=180.0 * DEG)
    out = escape(watched.belief, watched.assignment, LIMIT)
    half = 0.5 * wrap_signed(out.heading)
    assert kept_on_heading(watched.belief, watched.assignment, half).least_separation < LIMIT


BESIDE = behind(along=20_000.0, abeam=-12_000.0)
"""Where a leader that turns back to the left comes by."""


def test_a_turn_that_may_go_on_needs_more_room() -> None:
    watched = Watched(replace(BESIDE, intent_known=False))
    watched.fleet.turn(1, -3.0, "left", 25.0 * DEG)
    for _ in range(12):
        watched.fly(Control(HOLD_HEADING, 0.0, 230.0))
    belief, assignment = watched.belief, watched.assignment
    assert kept_on_heading(belief, assignment, 0.0).least_separation >= LIMIT
    assert kept_on_heading(belief, assignment, 0.0, turns_on=True).least_separation < LIMIT
    assert escape(belief, assignment, LIMIT).heading == pytest.approx(0.0, abs=1e-9)
    out = escape(belief, assignment, LIMIT, turns_on=True)
    assert out.least_separation >= LIMIT
    assert abs(wrap_signed(out.heading)) > 5.0 * DEG


def test_a_leader_that_may_slow_down_is_nearer() -> None:
    watched = ahead_of_us(along=16_000.0, heading=0.0)
    steady = kept_on_heading(watched.belief, watched.assignment, 0.0).least_separation
    slower = kept_on_heading(
        watched.belief, watched.assignment, 0.0, other_tas=150.0
    ).least_separation
    assert slower < steady - 5_000.0
    out = escape(watched.belief, watched.assignment, 9_000.0, other_tas=150.0)
    assert out.least_separation >= 9_000.0 > slower


def test_turning_later_keeps_less() -> None:
    watched = ahead_of_us(along=20_000.0, heading=180.0 * DEG)
    now = escape(watched.belief, watched.assignment, 3.0 * LIMIT)
    later = escape(watched.belief, watched.assignment, 3.0 * LIMIT, delay=10.0)
    assert later.least_separation < now.least_separation - 100.0


def test_a_declared_turn_is_reckoned_with() -> None:
    intent = (TurnTo(heading=180.0 * DEG, turn=LEFT, bank=25.0 * DEG),)
    leader = replace(BESIDE.situation.leader, intent=intent)
    told = replace(BESIDE, situation=replace(BESIDE.situation, leader=leader))
    known, unknown = Watched(told), Watched(replace(told, intent_known=False))
    assert kept_on_heading(known.belief, known.assignment, 0.0).least_separation < LIMIT
    assert kept_on_heading(unknown.belief, unknown.assignment, 0.0).least_separation >= LIMIT
    out = escape(known.belief, known.assignment, LIMIT)
    assert out.least_separation >= LIMIT
    assert flown_least(known, out.heading, 180) >= LIMIT - 60.0
