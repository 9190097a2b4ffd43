"""Where there is no plan, the nearest heading that keeps clear."""

from dataclasses import replace
from math import atan, pi

import numpy as np
import pytest

from relguide.flying.aircraft import A300
from relguide.flying.capture import Offsets
from relguide.flying.documents import FlightEnded
from relguide.flying.escape import EscapePath, escape_path, keeps_clear
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.learn.words.visited import draw_flight
from relguide.planning.certificate import certify
from relguide.planning.plan import plan
from relguide.planning.situation import Situation, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.units import DEG, G0, NM

BASE = scenario("fig_6a").situation


def pursuer_at(x: float, y: float, heading: float) -> Situation:
    leader = replace(BASE.leader, intent=())
    pursuer = replace(BASE.pursuer, x=x, y=y, heading=heading * DEG)
    return replace(BASE, pursuer=pursuer, leader=leader)


def out(
    situation: Situation, *, bank: float = 0.0, rate: float = 0.0, keep: float = 0.0
) -> EscapePath:
    keep = keep or situation.min_separation
    return escape_path(
        situation, bank=bank * DEG, model=A300, min_separation=keep, leader_turn_rate=rate
    )


def change(situation: Situation, found: EscapePath) -> float:
    return (found.heading - situation.pursuer.heading + pi) % (2.0 * pi) - pi


def test_present_heading_is_kept_when_it_is_safe() -> None:
    assert out(pursuer_at(-40e3, 40e3, 90.0)).heading == pytest.approx(90.0 * DEG)


@pytest.mark.parametrize(("x", "y", "heading"), [(70e3, 0.0, 270.0), (30e3, -30e3, 350.0)])
def test_collision_course_is_left_by_the_smallest_safe_turn(
    x: float, y: float, heading: float
) -> None:
    situation = pursuer_at(x, y, heading)
    turned = change(situation, out(situation))
    assert 5.0 * DEG < abs(turned) < 90.0 * DEG
    arc = Arc(
        turn=RIGHT if turned > 0.0 else LEFT,
        turn_angle=abs(turned),
        radius=situation.pursuer.turn_radius,
    )
    flown = Trajectory(
        x=x, y=y, heading=heading * DEG, tas=240.0, segments=(arc, Straight(length=20e3))
    )
    assert certify(flown, situation).holds


def test_too_close_already_turns_away() -> None:
    situation = pursuer_at(4.0 * NM, 0.0, 270.0)
    assert out(situation).heading != pytest.approx(270.0 * DEG)


def test_a_gentle_bank_may_not_have_turned_round_in_three_minutes() -> None:
    situation = pursuer_at(4.0 * NM, 0.0, 270.0)
    gentle = replace(situation, pursuer=replace(situation.pursuer, max_bank=12.0 * DEG))
    assert 0.0 <= out(gentle).heading < 2.0 * pi


def test_rolling_first_costs_separation() -> None:
    """Banked to the left it goes on to the left; from level both sides are as good."""
    head_on = pursuer_at(22e3, 0.0, 270.0)
    left, level, right = (out(head_on, bank=bank, keep=50e3) for bank in (-25.0, 0.0, 25.0))
    assert change(head_on, left) < 0.0 < change(head_on, right)
    assert left.least_separation == pytest.approx(right.least_separation, abs=2.0)
    assert left.least_separation > level.least_separation + 100.0


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_leader_who_turns_may_go_on(side: float) -> None:
    """Abeam of him, flying the same way, all is well unless he turns further."""
    abeam = pursuer_at(0.0, -side * 12e3, 90.0)
    rate = side * 1.1 * DEG
    assert out(abeam).heading == pytest.approx(90.0 * DEG)
    found = out(abeam, rate=rate)
    assert side * change(abeam, found) > 20.0 * DEG
    # wherever he ends his turn
    for angle in np.arange(0.0, 181.0, 5.0) * DEG:
        turn = TurnTo(
            heading=abeam.leader.heading + side * angle,
            turn=RIGHT if side > 0.0 else LEFT,
            bank=atan(abeam.leader.tas * abs(rate) / G0),
        )
        real = replace(abeam, leader=replace(abeam.leader, intent=(turn,)))
        kept = out(replace(real, pursuer=replace(real.pursuer, heading=found.heading)))
        assert kept.least_separation > 0.99 * min(found.least_separation, real.min_separation)


@pytest.mark.slow
@pytest.mark.parametrize("number", [2, 331])
def test_where_d_min_cannot_be_kept_as_much_is_kept_as_any_turn_could(number: int) -> None:
    """Head-on when engaged, and a plan that would need the bank at once."""
    flight = draw_flight(np.random.default_rng([1903, number]))
    best = out(flight.situation)
    *_, end = fly(replace(flight, duration_limit=90.0), plan, step=0.25, sample_period=1.0)
    assert isinstance(end, FlightEnded)
    assert best.least_separation < 0.98 * flight.situation.min_separation
    assert end.results[0].least_separation > 0.995 * best.least_separation


@pytest.mark.slow
@pytest.mark.parametrize("number", [92, 128, 156])
def test_a_leader_who_turns_towards_it_unannounced_is_given_way(number: int) -> None:
    """He turns for a minute or more; as if he stopped any moment, 0.96 … 0.99 of d_min was left."""
    flight = draw_flight(np.random.default_rng([1903, number]))
    assert not flight.intent_known
    *_, end = fly(flight, plan, step=0.25, sample_period=1.0)
    assert isinstance(end, FlightEnded)
    assert end.results[0].joined or end.t == flight.duration_limit
    assert end.results[0].least_separation > flight.situation.min_separation


def test_on_the_route_speed_is_the_answer() -> None:
    assert keeps_clear(Offsets(500.0, 0.0, 0.0), -500.0, pursuer_at(-9.4e3, 0.0, 90.0))


def test_turn_onto_the_route_is_judged_by_the_certificate() -> None:
    clear = pursuer_at(-40e3, 12e3, 135.0)
    assert keeps_clear(Offsets(-30e3, -12e3, 45.0 * DEG), 30e3, clear)
    across = pursuer_at(8e3, 10e3, 180.0)
    assert not keeps_clear(Offsets(18e3, -10e3, 90.0 * DEG), 18e3, across)
