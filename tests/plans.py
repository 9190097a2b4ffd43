"""Plans and trajectories whose optimality is in question, and what exact conditions mean."""

import pytest
from hypothesis import assume

from relguide import Arc, Leader, Plan, Pursuer, Situation, Straight, Trajectory, plan
from relguide.planning.optimality import OptimalityReport
from relguide.units import DEG
from tests.situations import golden

EXACT = 1e-8
"""Residuals of what is solved in closed form, [1] and in R/V_P: rounding at 150 km."""


def find_plan(situation: Situation) -> Plan:
    answer = plan(situation)
    assert isinstance(answer, Plan)
    return answer


def plan_unlimited(situation: Situation) -> Plan:
    """The plan of a drawn situation, if the limit plays no part in it."""
    answer = plan(situation)
    assume(isinstance(answer, Plan) and answer.optimality.proof == "relaxation")
    assert isinstance(answer, Plan)
    return answer


def golden_plan(ident: str) -> Plan:
    return find_plan(next(s for s, a in golden("reference") if a["id"] == ident))


def assert_exact(report: OptimalityReport, situation: Situation) -> None:
    scale = situation.pursuer.turn_radius / situation.pursuer.tas
    assert report.holds
    assert report.switching_ok
    assert report.neglected == pytest.approx(0.0, abs=1e-6)
    assert report.hamiltonian_residual <= EXACT
    assert report.switching_residual <= EXACT * scale


def straight_behind(*, d_min: float = 5_000.0, leader_tas: float = 180.0) -> Situation:
    return Situation(
        pursuer=Pursuer(x=0.0, y=-40_000.0, heading=0.0, tas=220.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=leader_tas),
        slot_distance=9_000.0,
        min_separation=d_min,
    )


def fly_planned(situation: Situation, *segments: Arc | Straight) -> Trajectory:
    pursuer = situation.pursuer
    return Trajectory(
        x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas, segments=segments
    )
