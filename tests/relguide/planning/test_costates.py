"""Costates of words that leave them a choice, and of those where the choice is known."""

from dataclasses import replace
from math import cos, pi, sin

import pytest
from hypothesis import given

from relguide import LEFT, RIGHT, Arc, Leader, Situation, candidates
from relguide.planning.optimality import check
from tests.plans import EXACT, assert_exact, find_plan, fly_planned, straight_behind
from tests.situations import golden, situations


@given(situation=situations(with_intent=False, reach=25_000.0))
def test_three_turns_satisfy_eq_16_when_the_geometry_says_so(situation: Situation) -> None:
    """λ_p lies along the chord of the middle arc m, at an angle χ from the leader's velocity.

    H = 0 gives it the sign of α cos χ − cos(m/2), which must be positive; and the outer turns must
    not reach past m, where they would cross the chord's line again. So a middle arc above π may
    fail, and one below it, the delay type, may hold.
    """
    for candidate in candidates(situation):
        if candidate.word not in ("LRL", "RLR"):
            continue
        first, middle, last = (s for s in candidate.trajectory.segments if isinstance(s, Arc))
        report = check(candidate.trajectory, situation, samples=1)
        chord = candidate.trajectory.breakpoints()[1].heading + (
            -0.5 * middle.turn * middle.turn_angle
        )
        alpha = situation.leader.tas / situation.pursuer.tas
        lead = alpha * cos(chord - situation.leader.heading) - cos(0.5 * middle.turn_angle)
        past = max(first.turn_angle, last.turn_angle) - middle.turn_angle
        # on a short middle arc the switching function hardly leaves 0, whatever its sign
        deep = 1.0 - cos(0.5 * middle.turn_angle)
        if min(abs(lead), abs(past), deep) < 1e-2:
            continue  # too close to call in either form
        assert report.switching_ok == (lead > 0.0 and past < 0.0)
        assert report.hamiltonian_residual <= EXACT / min(1.0, abs(lead))


def test_a_delay_with_a_short_middle_arc_may_hold() -> None:
    seen = {True: 0, False: 0}
    for situation, _ in golden("reference"):
        for candidate in candidates(situation):
            arcs = candidate.trajectory.segments
            if candidate.word in ("LRL", "RLR") and len(arcs) == 3:
                middle = arcs[1]
                assert isinstance(middle, Arc)
                if middle.turn_angle < 0.9 * pi:
                    seen[check(candidate.trajectory, situation, samples=1).holds] += 1
    assert seen[True] > 0
    assert seen[False] > 0


def test_a_straight_alone_fixes_its_costates() -> None:
    situation = straight_behind()
    report = check(find_plan(situation), situation)
    assert_exact(report, situation)
    assert report.history.separation[0] == pytest.approx(1.0 / 40.0)  # ∂T/∂d dead astern
    assert max(map(abs, report.history.switching)) < 1e-9


@pytest.mark.parametrize("angles", [(0.3,), (5.0,), (1.0, 2.0), (0.3, 5.0), (6.0, 0.3), (6.0, 6.0)])
@pytest.mark.parametrize("leader_tas", [100.0, 215.0])
def test_one_turn_or_two_leave_a_choice_that_meets_eq_16(
    angles: tuple[float, ...], leader_tas: float
) -> None:
    """A straight of no length may lie after the first, and then λ_p is along it: V_L < V_P."""
    situation = straight_behind(leader_tas=leader_tas)
    radius = situation.pursuer.turn_radius
    arcs = [
        Arc(turn=turn, turn_angle=angle, radius=radius)
        for turn, angle in zip((LEFT, RIGHT), angles, strict=False)
    ]
    turned = fly_planned(situation, *arcs)
    end = turned.pose_at(turned.duration)
    back = 9_000.0 - leader_tas * turned.duration
    joins = Leader(
        x=end.x + back * sin(end.heading),
        y=end.y + back * cos(end.heading),
        heading=end.heading,
        tas=leader_tas,
    )
    there = replace(situation, leader=joins, min_separation=0.0)
    assert_exact(check(turned, there), there)
