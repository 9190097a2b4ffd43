"""Where d_min cannot be kept: the least bad turn, checked by flying it and by looking harder."""

from dataclasses import replace
from math import cos, hypot, inf, pi

import numpy as np
import pytest
from hypothesis import assume, given

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    Leader,
    NoPlan,
    Pursuer,
    Situation,
    Straight,
    Trajectory,
    plan,
)
from relguide.planning.least_bad import least_bad, least_bad_sentence, restore
from relguide.units import DEG
from tests.situations import golden, numbers, situations


def fly_turn(
    situation: Situation, turn_angle: float, duration: float
) -> tuple[float, float, float]:
    """Separation at the end, least on the way and when, sampled ten times a second."""
    pursuer = situation.pursuer
    arc = Arc(
        turn=RIGHT if turn_angle > 0.0 else LEFT,
        turn_angle=abs(turn_angle),
        radius=pursuer.turn_radius,
    )
    path = Trajectory(
        x=pursuer.x,
        y=pursuer.y,
        heading=pursuer.heading,
        tas=pursuer.tas,
        segments=(arc, Straight(length=0.0)),
    )
    leader = situation.leader.trajectory
    times = np.linspace(0.0, duration, max(int(duration * 10), 2))
    gaps = []
    for t in times:
        ours, theirs = path.pose_at(t), leader.pose_at(t)
        gaps.append(hypot(ours.x - theirs.x, ours.y - theirs.y))
    i = int(np.argmin(gaps))
    return gaps[-1], gaps[i], float(times[i])


@given(situation=situations(reach=8_000.0, with_wind=False), angle=numbers(-6.2, 6.2))
def test_no_other_turn_restores_separation_sooner(situation: Situation, angle: float) -> None:
    gap = hypot(situation.pursuer.x - situation.leader.x, situation.pursuer.y - situation.leader.y)
    assume(gap < 0.9 * situation.min_separation)
    found = restore(situation)
    assume(found.at_time < inf)
    assert 0.0 <= found.heading < 2.0 * pi
    turned = situation.pursuer.heading + found.turn_angle
    assert cos(found.heading - turned) == pytest.approx(1.0, abs=1e-12)
    at_end, _, _ = fly_turn(situation, found.turn_angle, found.at_time)
    assert at_end >= situation.min_separation - 1.0
    # half a second of both aircraft: how late the time may be
    reach = 0.5 * (situation.pursuer.tas + situation.leader.tas) + 0.02 * gap
    other, _, _ = fly_turn(situation, angle, max(found.at_time - 1.0, 0.0))
    assert other < situation.min_separation + reach


@pytest.mark.parametrize("case", ["R046", "R162", "R228"])
def test_the_least_bad_turn_keeps_what_it_says(case: str) -> None:
    situation, _ = next(pair for pair in golden("reference") if pair[1]["id"] == case)
    found = least_bad(situation)
    _, least, at = fly_turn(situation, found.turn_angle, 300.0)
    assert least == pytest.approx(found.least_separation, abs=20.0)
    assert at == pytest.approx(found.at_time, abs=1.0)
    assert least < situation.min_separation
    for angle in np.linspace(-2.0 * pi, 2.0 * pi, 41):
        assert fly_turn(situation, float(angle), 300.0)[1] <= found.least_separation + 100.0


def test_a_leader_that_never_stops_closing_is_no_matter_of_infinite_seconds() -> None:
    """Twice as fast, and 400 km behind: after a quarter of an hour it still comes nearer."""
    situation = Situation(
        pursuer=Pursuer(x=0.0, y=400e3, heading=0.0, tas=150.0, max_bank=25 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=300.0),
        slot_distance=12e3,
        min_separation=9e3,
    )
    found = least_bad(situation)
    assert found.at_time == inf
    said = least_bad_sentence(found)
    assert "inf" not in said
    assert "after 15 minutes" in said


def test_the_answer_says_what_to_do() -> None:
    situation, _ = next(pair for pair in golden("reference") if pair[1]["id"] == "R228")
    answer = plan(situation)
    assert isinstance(answer, NoPlan)
    found = least_bad(situation)
    assert f"{round(found.heading / DEG) % 360:03d}°" in answer.message
    assert "0.85 NM" in answer.message
    closer = replace(
        situation, min_separation=situation.slot_distance, slot_distance=situation.slot_distance
    )
    answer = plan(closer)
    assert isinstance(answer, NoPlan)
    assert answer.reason == "separation_already_lost"
    assert "separation is restored in" in answer.message
