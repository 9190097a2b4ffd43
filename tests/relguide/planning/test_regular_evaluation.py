"""What the paper asks of a regular trajectory: against the certificate, and by hand."""

from dataclasses import replace
from math import cos, hypot, pi, sin

import pytest
from hypothesis import assume, given

from relguide import LEFT, RIGHT, Leader, Plan, Situation, TurnTo, certify, plan
from relguide.kernels.separation.approach import ROUNDING
from relguide.planning.regular import (
    RegularTrajectory,
    Triplet,
    regular_from_trajectory,
    trajectory_from_regular,
)
from relguide.planning.regular_evaluation import evaluate
from tests.plans import straight_behind
from tests.relguide.planning.test_regular import pair, pairs
from tests.situations import situations


@given(situation=situations(with_intent=False))
def test_a_plan_meets_every_condition_in_the_papers_form(situation: Situation) -> None:
    """(18)–(20), in wind too."""
    answer = plan(situation)
    assume(isinstance(answer, Plan) and "B" not in answer.word)
    assert isinstance(answer, Plan)
    regular = regular_from_trajectory(answer.trajectory, turn_radius=situation.pursuer.turn_radius)
    found = evaluate(regular, situation)
    assert found.length == pytest.approx(answer.trajectory.length, rel=1e-12)
    assert found.duration == pytest.approx(answer.time_to_converge, rel=1e-12)
    for error in (found.initial, found.final):
        assert hypot(error.along, error.left) < 0.02
        assert abs(error.heading) < 1e-6
    assert found.keeps_separation
    assert len(found.nodes) == found.order
    assert (found.nodes[-1].x, found.nodes[-1].y) == (situation.pursuer.x, situation.pursuer.y)


@given(triplets=pairs, situation=situations(with_intent=False, reach=40_000.0))
def test_the_separation_is_the_certificates(
    triplets: tuple[Triplet, ...], situation: Situation
) -> None:
    regular = RegularTrajectory(triplets=triplets)
    assume(triplets)
    found = evaluate(regular, situation)
    certificate = certify(trajectory_from_regular(regular, situation), situation)
    least = min(min(s.turn_least, s.straight_least) for s in found.separations)
    radius = situation.pursuer.turn_radius
    assert least == pytest.approx(certificate.least_separation, abs=1e-6 * radius)
    slack = 2e-6 * radius
    if abs(certificate.lower_bound - situation.min_separation) > slack:
        assert found.keeps_separation == certificate.holds
    for test in found.separations:
        assert test.turn_least - test.turn_bound <= 1e-6 * radius + ROUNDING
        limit = situation.min_separation
        if abs(min(test.turn_bound, test.straight_least) - limit) > slack:
            assert test.holds == (min(test.turn_bound, test.straight_least) > limit)


@given(triplets=pairs, situation=situations(with_intent=False, with_wind=False, reach=40_000.0))
def test_eqs_21_to_24_in_the_corrected_form(
    triplets: tuple[Triplet, ...], situation: Situation
) -> None:
    """Nodes by hand; T* counts back from node i, and picks among three distances."""
    found = evaluate(RegularTrajectory(triplets=triplets), situation)
    pursuer, leader = situation.pursuer, situation.leader
    t = found.duration
    for i, (triplet, test) in enumerate(zip(triplets, found.separations, strict=True)):
        node = found.nodes[i]
        length, psi = triplet.length, node.heading
        start = node.x - length * sin(psi), node.y - length * cos(psi)

        def gap(x: float, y: float, at: float) -> tuple[float, float]:
            flown = leader.tas * at
            return (
                x - leader.x - flown * sin(leader.heading),
                y - leader.y - flown * cos(leader.heading),
            )

        r, before = gap(node.x, node.y, t), gap(*start, t - length / pursuer.tas)
        v = (
            pursuer.tas * sin(psi) - leader.tas * sin(leader.heading),
            pursuer.tas * cos(psi) - leader.tas * cos(leader.heading),
        )
        r_v, v_v = r[0] * v[0] + r[1] * v[1], v[0] ** 2 + v[1] ** 2
        assume(v_v > 1.0)
        assert test.t_star == pytest.approx(r_v / v_v, rel=1e-9, abs=1e-6)  # (21)
        if r_v / v_v <= 0.0:
            due = hypot(*r)  # (22)
        elif r_v / v_v >= length / pursuer.tas:
            due = hypot(*before)  # (23)
        else:
            due = max(r[0] ** 2 + r[1] ** 2 - r_v**2 / v_v, 0.0) ** 0.5  # (24)
        assert test.straight_least == pytest.approx(due, abs=0.05)
        t -= (length + pursuer.turn_radius * triplet.turn_angle) / pursuer.tas


def test_a_turn_counts_as_the_arc_it_is() -> None:
    """Laid out along one heading, as (21)–(24) have it, this half turn would clear the leader."""
    situation = replace(
        straight_behind(),
        leader=Leader(x=14_000.0, y=-31_000.0, heading=pi, tas=40.0),
        min_separation=5_000.0,
    )
    turn = evaluate(RegularTrajectory(triplets=(pair(-1, pi, 0.0),)), situation)
    radius = situation.pursuer.turn_radius
    straight = evaluate(RegularTrajectory(triplets=(pair(1, 0.0, pi * radius),)), situation)
    assert straight.keeps_separation
    assert not turn.keeps_separation


def test_end_errors_are_in_the_leaders_directions() -> None:
    """4 km short and on a heading 0.1 rad to the left, by (19); the leader flies north."""
    situation = straight_behind()
    short = RegularTrajectory(triplets=(Triplet(turn=LEFT, turn_angle=0.0, length=100_000.0),))
    found = evaluate(short, situation)
    # the slot is at −9 000 + 180/220 × 100 000, the pursuer at −40 000 + 100 000
    assert found.final.along == pytest.approx(60_000.0 + 9_000.0 - 180.0 / 220.0 * 100_000.0)
    assert found.final.left == pytest.approx(0.0, abs=1e-6)
    assert found.initial.along == pytest.approx(-found.final.along)
    turned = replace(situation, pursuer=replace(situation.pursuer, heading=-0.1))
    found = evaluate(short, turned)
    assert found.final.heading == pytest.approx(-0.1)
    assert found.final.left == pytest.approx(100_000.0 * sin(0.1))
    assert found.initial.heading == pytest.approx(0.1)


def test_a_leader_that_turns_is_refused() -> None:
    situation = straight_behind()
    turning = replace(situation.leader, intent=(TurnTo(heading=1.0, turn=RIGHT, bank=0.4),))
    with pytest.raises(ValueError, match="keeps straight"):
        evaluate(RegularTrajectory(triplets=()), replace(situation, leader=turning))


def test_order_1_is_being_there() -> None:
    situation = straight_behind()
    there = replace(situation, pursuer=replace(situation.pursuer, y=-9_000.0))
    found = evaluate(RegularTrajectory(triplets=()), there)
    assert (found.order, found.length, found.keeps_separation) == (1, 0.0, True)
    assert found.final.along == pytest.approx(0.0, abs=1e-9)
