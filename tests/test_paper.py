"""The paper, equation by equation: what is followed, and what is followed in its corrected form."""

from dataclasses import replace
from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    FlyStraight,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Reason,
    Situation,
    Straight,
    Trajectory,
    TurnTo,
    certify,
    plan,
)
from relguide.kernels.base.costate import hamiltonian
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.separation.approach import closest_of_straights
from relguide.units import DEG, G0, NM
from tests.situations import numbers, situations


@given(situation=situations(with_intent=False, with_wind=False, reach=60_000.0))
def test_eqs_1_to_3(situation: Situation) -> None:
    """d', θ' and ψ' in relative polar co-ordinates; θ the bearing from P to L, from north."""
    pursuer, leader = situation.pursuer, situation.leader
    flown = Trajectory(
        x=pursuer.x,
        y=pursuer.y,
        heading=pursuer.heading,
        tas=pursuer.tas,
        segments=(Arc(turn=RIGHT, turn_angle=1.0, radius=pursuer.turn_radius),),
    )

    def polar(t: float) -> tuple[float, float, float]:
        p, l = flown.pose_at(t), leader.trajectory.pose_at(t)
        return hypot(l.x - p.x, l.y - p.y), atan2(l.x - p.x, l.y - p.y), p.heading

    t, dt = 5.0, 1e-3
    d, theta, psi = polar(t)
    (d0, theta0, psi0), (d1, theta1, psi1) = polar(t - dt), polar(t + dt)
    if d < 100.0:
        return  # θ is undefined where they meet
    off_l, off_p = theta - leader.heading, theta - psi
    assert (d1 - d0) / (2 * dt) == pytest.approx(
        leader.tas * cos(off_l) - pursuer.tas * cos(off_p), abs=1e-3
    )
    swing = (theta1 - theta0 + pi) % (2 * pi) - pi
    assert swing / (2 * dt) == pytest.approx(
        (-leader.tas * sin(off_l) + pursuer.tas * sin(off_p)) / d, abs=1e-5
    )
    swing = (psi1 - psi0 + pi) % (2 * pi) - pi
    assert swing / (2 * dt) == pytest.approx(turn_rate(pursuer.tas, pursuer.max_bank), abs=1e-6)


@given(situation=situations(reach=60_000.0))
def test_eq_7(situation: Situation) -> None:
    """At t_f: equal headings, on the leader's route, D behind it."""
    answer = plan(situation)
    if not isinstance(answer, Plan):
        return
    t = answer.time_to_converge
    p, l = answer.trajectory.pose_at(t), situation.leader.trajectory.pose_at(t)
    assert cos(p.heading - l.heading) == pytest.approx(1.0, abs=1e-9)
    assert hypot(p.x - l.x, p.y - l.y) == pytest.approx(situation.slot_distance, abs=0.02)
    east = situation.leader.tas * sin(l.heading) + situation.wind.east
    north = situation.leader.tas * cos(l.heading) + situation.wind.north
    bearing = atan2(l.x - p.x, l.y - p.y)  # θ(t_f) = ψ_L: along the leader's ground track in wind
    assert cos(bearing - atan2(east, north)) == pytest.approx(1.0, abs=1e-9)


@given(situation=situations(reach=60_000.0))
def test_eq_4(situation: Situation) -> None:
    """No turn of a plan is tighter than φ_max allows, and an arc without the limit is as tight."""
    answer = plan(situation)
    if not isinstance(answer, Plan):
        return
    most = turn_rate(situation.pursuer.tas, situation.pursuer.max_bank)
    assert all(abs(rate) <= most * (1 + 1e-9) for rate in answer.trajectory.turn_rates())
    for _, rate in answer.trajectory.bends():
        assert abs(rate) <= most * (1 + 1e-9)


@given(situation=situations(reach=60_000.0), nearer=numbers(0.0, 0.999))
def test_eq_6(situation: Situation, nearer: float) -> None:
    """A plan begins where the pursuer is; closer than d_min there is none."""
    pursuer, leader = situation.pursuer, situation.leader
    answer = plan(situation)
    if isinstance(answer, Plan):
        begin = answer.trajectory.pose_at(0.0)
        assert (begin.x, begin.y) == (pursuer.x, pursuer.y)
        assert cos(begin.heading - pursuer.heading) == pytest.approx(1.0, abs=1e-12)
    inside = replace(pursuer, x=leader.x + nearer * situation.min_separation, y=leader.y)
    refused = plan(replace(situation, pursuer=inside))
    if situation.min_separation > 1.0:
        assert isinstance(refused, NoPlan)
        assert refused.reason is Reason.SEPARATION_ALREADY_LOST


def test_eq_8() -> None:
    assert turn_rate(230.0, 25 * DEG) == pytest.approx(G0 / 230.0 * np.tan(25 * DEG))
    assert turn_rate(230.0, -25 * DEG) < 0.0  # positive bank turns right: sign φ = −ε


@given(r=numbers(-0.1, 0.1), lam_psi=numbers(-1e3, 1e3), brg=numbers(-pi, pi), psi=numbers(-pi, pi))
def test_eq_15(r: float, lam_psi: float, brg: float, psi: float) -> None:
    """H is what it is without a turn, and λ_ψ r."""
    args = (12_000.0, brg, psi, 2e-3, -30.0, lam_psi)
    turning, straight = (hamiltonian(*args, rate, 230.0, 200.0, 1.0) for rate in (r, 0.0))
    assert turning - straight == pytest.approx(lam_psi * r, rel=1e-9, abs=1e-9)


def test_eq_17_sums_lengths_and_turns() -> None:
    flown = Trajectory(
        x=0.0,
        y=0.0,
        heading=0.0,
        tas=200.0,
        segments=(Arc(turn=LEFT, turn_angle=0.5, radius=9_000.0), Straight(length=7_000.0)),
    )
    assert flown.length == pytest.approx(7_000.0 + 9_000.0 * 0.5)


@given(
    dx=numbers(-5e4, 5e4),
    dy=numbers(-5e4, 5e4),
    vx=numbers(-300.0, 300.0),
    vy=numbers(-300.0, 300.0),
)
def test_eq_21(dx: float, dy: float, vx: float, vy: float) -> None:
    """T* = −(r·v)/(v·v). As printed its second term lacks V_P cos ψ and adds m²/s to m."""
    if hypot(vx, vy) < 1e-3:
        return
    t, _ = closest_of_straights(dx, dy, vx, vy, -1e9, 1e9)
    assert t == pytest.approx(-(dx * vx + dy * vy) / (vx * vx + vy * vy), rel=1e-12, abs=1e-12)
    # it is where the distance is stationary; the scale is that of the terms that cancel
    slope = (dx + t * vx) * vx + (dy + t * vy) * vy
    assert abs(slope) <= 1e-9 * hypot(dx, dy) * hypot(vx, vy) + 1e-9


@given(
    dx=numbers(-5e4, 5e4), dy=numbers(-5e4, 5e4), vx=numbers(-300.0, 300.0), vy=numbers(10.0, 300.0)
)
def test_eq_24(dx: float, dy: float, vx: float, vy: float) -> None:
    """Least d² = |r|² − (r·v)²/|v|². As printed the projection lacks its square."""
    _, least = closest_of_straights(dx, dy, vx, vy, -1e9, 1e9)
    projected = (dx * vx + dy * vy) ** 2 / (vx * vx + vy * vy)
    assert least**2 == pytest.approx(dx * dx + dy * dy - projected, abs=1e-2)


def test_eqs_22_and_23_hold_the_ends() -> None:
    """Outside the segment's own time the nearer end counts, with V_P where the paper writes V_S."""
    assert closest_of_straights(10.0, 0.0, 1.0, 0.0, 0.0, 5.0) == (0.0, 10.0)
    assert closest_of_straights(10.0, 0.0, -1.0, 0.0, 0.0, 5.0) == (5.0, 5.0)


def test_an_arc_laid_out_as_a_straight_bounds_nothing() -> None:
    """(21)-(24) put l + Rθ along one heading, and miss what a turn does: arcs count as arcs."""
    situation = Situation(
        pursuer=Pursuer(x=0.0, y=0.0, heading=0.0, tas=200.0, max_bank=25 * DEG),
        leader=Leader(x=14_000.0, y=9_000.0, heading=pi, tas=40.0),
        slot_distance=9_000.0,
        min_separation=5_000.0,
    )
    radius = situation.pursuer.turn_radius
    turn = Trajectory(
        x=0.0,
        y=0.0,
        heading=0.0,
        tas=200.0,
        segments=(Arc(turn=RIGHT, turn_angle=pi, radius=radius),),
    )
    laid_out = Trajectory(
        x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(Straight(length=radius * pi),)
    )
    assert certify(laid_out, situation).holds
    assert not certify(turn, situation).holds


def test_section_5_with_intent_is_solved_and_proved() -> None:
    """Fig. 6b: pursuer 40 km behind and 40 km north; the leader will turn right to 135°."""
    leader = Leader(
        x=0.0,
        y=0.0,
        heading=90 * DEG,
        tas=200.0,
        intent=(FlyStraight(duration=300.0), TurnTo(heading=135 * DEG, turn=RIGHT, bank=25 * DEG)),
    )
    situation = Situation(
        pursuer=Pursuer(x=-40_000.0, y=40_000.0, heading=90 * DEG, tas=240.0, max_bank=25 * DEG),
        leader=leader,
        slot_distance=10_000.0,
        min_separation=5 * NM,
    )
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.optimality.proof == "relaxation"
    first = answer.trajectory.segments[0]
    assert isinstance(first, Arc)
    assert first.turn == RIGHT
