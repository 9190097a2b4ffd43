"""Where there is no plan, the nearest heading that keeps clear."""

from dataclasses import replace
from math import pi

import pytest

from relguide.flying.capture import Offsets
from relguide.flying.escape import keeps_clear, safe_heading
from relguide.flying.scenarios import scenario
from relguide.planning.certificate import certify
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.units import DEG, NM

BASE = scenario("fig_6a").situation


def pursuer_at(x: float, y: float, heading: float) -> Situation:
    leader = replace(BASE.leader, intent=())
    pursuer = replace(BASE.pursuer, x=x, y=y, heading=heading * DEG)
    return replace(BASE, pursuer=pursuer, leader=leader)


def test_present_heading_is_kept_when_it_is_safe() -> None:
    assert safe_heading(pursuer_at(-40e3, 40e3, 90.0)) == pytest.approx(90.0 * DEG)


@pytest.mark.parametrize(("x", "y", "heading"), [(70e3, 0.0, 270.0), (30e3, -30e3, 350.0)])
def test_collision_course_is_left_by_the_smallest_safe_turn(
    x: float, y: float, heading: float
) -> None:
    situation = pursuer_at(x, y, heading)
    change = (safe_heading(situation) - heading * DEG + pi) % (2.0 * pi) - pi
    assert 5.0 * DEG < abs(change) < 90.0 * DEG
    arc = Arc(
        turn=RIGHT if change > 0.0 else LEFT,
        turn_angle=abs(change),
        radius=situation.pursuer.turn_radius,
    )
    flown = Trajectory(
        x=x, y=y, heading=heading * DEG, tas=240.0, segments=(arc, Straight(length=20e3))
    )
    assert certify(flown, situation).holds


def test_too_close_already_turns_away() -> None:
    situation = pursuer_at(4.0 * NM, 0.0, 270.0)
    assert safe_heading(situation) != pytest.approx(270.0 * DEG)


def test_a_gentle_bank_may_not_have_turned_round_in_three_minutes() -> None:
    situation = pursuer_at(4.0 * NM, 0.0, 270.0)
    gentle = replace(situation, pursuer=replace(situation.pursuer, max_bank=12.0 * DEG))
    assert 0.0 <= safe_heading(gentle) < 2.0 * pi


def test_on_the_route_speed_is_the_answer() -> None:
    assert keeps_clear(Offsets(500.0, 0.0, 0.0), -500.0, pursuer_at(-9.4e3, 0.0, 90.0))


def test_turn_onto_the_route_is_judged_by_the_certificate() -> None:
    clear = pursuer_at(-40e3, 12e3, 135.0)
    assert keeps_clear(Offsets(-30e3, -12e3, 45.0 * DEG), 30e3, clear)
    across = pursuer_at(8e3, 10e3, 180.0)
    assert not keeps_clear(Offsets(18e3, -10e3, 90.0 * DEG), 18e3, across)
