"""H and the costates over time: against (11)–(13) integrated, and against the planner's times."""

from dataclasses import replace
from math import atan2, cos, hypot, sin

import numpy as np
import pytest
from hypothesis import assume, given
from scipy.integrate import solve_ivp

from relguide import Leader, Pursuer, Situation, Trajectory
from relguide.planning.optimality import OptimalityReport, check
from tests.plans import find_plan, golden_plan, plan_unlimited
from tests.situations import situations

RIDING = Situation(
    pursuer=Pursuer(x=-5_690.0, y=2_050.0, heading=0.113, tas=93.0, max_bank=0.54),
    leader=Leader(x=0.0, y=0.0, heading=0.584, tas=65.4),
    slot_distance=5_515.0,
    min_separation=5_425.0,
)
"""Its plan slides along d_min."""


def integrated_backward(
    report: OptimalityReport, flown: Trajectory, leader: Trajectory
) -> list[tuple[float, float, float]]:
    """λ_d, λ_θ, λ_ψ by (11)–(13) with μ = 0, from t_f to each reported time, jumps put in."""
    v_p, v_l, history = flown.tas, leader.tas, report.history

    def rates(t: float, lam: np.ndarray) -> tuple[float, float, float]:
        p, l = flown.pose_at(t), leader.pose_at(t)
        d, theta = hypot(l.x - p.x, l.y - p.y), atan2(l.x - p.x, l.y - p.y)
        across = -v_l * sin(theta - l.heading) + v_p * sin(theta - p.heading)
        along = -v_l * cos(theta - l.heading) + v_p * cos(theta - p.heading)
        return (
            lam[1] / d**2 * across,
            -lam[1] / d * along - lam[0] * across,
            lam[1] / d * v_p * cos(theta - p.heading) + lam[0] * v_p * sin(theta - p.heading),
        )

    lam = np.array((history.separation[-1], history.bearing[-1], history.switching[-1]))
    jumps = {contact.time: contact.jump for contact in report.contacts}
    last, out = history.times[-1], []
    for t in reversed(history.times):
        if last - t > 1e-9:
            lam = solve_ivp(rates, (last, t), lam, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        elif out and any(abs(t - at) < 1e-6 for at in jumps):
            at = min(jumps, key=lambda at: abs(t - at))
            lam = lam - np.array((jumps.pop(at), 0.0, 0.0))
        out.append((float(lam[0]), float(lam[1]), float(lam[2])))
        last = t
    assert not jumps
    return out[::-1]


@pytest.mark.parametrize(
    "ident", ["R001", "R033", "R066", "R090", "R179", "R045", "R054", "R061", "R096", "R183"]
)
def test_costates_solve_eqs_11_to_13(ident: str) -> None:
    """Straight and turning leaders, CSC and CCC, and detours with a jump of λ_d."""
    answer = golden_plan(ident)
    report = check(answer, answer.situation, samples=12)
    history = report.history
    # scipy must not step over the ends of the leader's turns
    expected = integrated_backward(report, answer.trajectory, answer.situation.leader.trajectory)
    scale = max(abs(value) for value in history.bearing) + 1.0
    for got, due in zip(
        zip(history.separation, history.bearing, history.switching, strict=True),
        expected,
        strict=True,
    ):
        assert got[0] == pytest.approx(due[0], abs=1e-9)
        assert got[1] == pytest.approx(due[1], abs=1e-7 * scale)
        assert got[2] == pytest.approx(due[2], abs=1e-7 * scale)


@pytest.mark.parametrize("ident", ["R001", "R033", "R066", "R179", "R050", "R054", "R061", "R183"])
def test_costates_are_the_slope_of_the_time_to_converge(ident: str) -> None:
    """λ(0) = ∂T/∂(d, θ, ψ): the planner itself, asked from next to where it starts."""
    situation = golden_plan(ident).situation
    history = check(golden_plan(ident), situation, samples=1).history
    pursuer, leader = situation.pursuer, situation.leader
    d = hypot(leader.x - pursuer.x, leader.y - pursuer.y)
    theta = atan2(leader.x - pursuer.x, leader.y - pursuer.y)

    def time(more_d: float, more_theta: float, more_psi: float) -> float:
        there, far = theta + more_theta, d + more_d
        moved = replace(
            pursuer,
            x=leader.x - far * sin(there),
            y=leader.y - far * cos(there),
            heading=pursuer.heading + more_psi,
        )
        answer = find_plan(replace(situation, pursuer=moved))
        return answer.time_to_converge

    for lam, step in (
        (history.separation[0], (5.0, 0.0, 0.0)),
        (history.bearing[0], (0.0, 1e-4, 0.0)),
        (history.switching[0], (0.0, 0.0, 1e-4)),
    ):
        there, back = time(*step), time(*(-s for s in step))
        # 1e-3 of the largest: the second derivative over steps of 5 m and 1e-4 rad
        slope = (there - back) / (2.0 * max(step))
        assert lam == pytest.approx(slope, rel=1e-3, abs=1e-5 if step[0] else 0.5)


@given(situation=situations(reach=80_000.0))
def test_h_changes_only_while_the_leader_turns_and_is_0_after(situation: Situation) -> None:
    answer = plan_unlimited(situation)
    report = check(answer, situation, samples=60)
    assume(report.arrival == "free" and report.holds)
    leader = situation.leader.trajectory
    ends = np.cumsum((0.0, *leader.durations()))
    rates = (*leader.turn_rates(), 0.0)

    def piece(t: float) -> int:
        return int(np.searchsorted(ends[1:], t, side="right"))

    history = report.history
    for i in range(len(history.times) - 1):
        low, high = history.times[i], history.times[i + 1]
        h = history.hamiltonian[i : i + 2]
        if low >= ends[-1]:
            assert max(map(abs, h)) <= 1e-7
        elif piece(low) == piece(high) and rates[piece(low)] == 0.0:
            assert h[1] - h[0] == pytest.approx(0.0, abs=1e-7)


def test_a_boundary_arc_has_a_multiplier_above_0() -> None:
    """λ_ψ ≡ 0 and H = 0 on it, and what (11) is short of without μ is that μ, above 0."""
    answer = find_plan(RIDING)
    assert "B" in answer.word
    report = check(answer, RIDING, samples=2_000)
    assert report.holds
    (boundary_arc,) = report.boundary_arcs
    assert boundary_arc.least_multiplier > 0.0
    history, multipliers = report.history, []
    for i in range(len(history.times) - 1):
        low, high = history.times[i], history.times[i + 1]
        if low < boundary_arc.start or high > boundary_arc.end or high - low < 0.01:
            continue
        assert history.switching[i] == 0.0
        assert history.hamiltonian[i] == pytest.approx(0.0, abs=1e-6)
        t = 0.5 * (low + high)
        p, l = answer.trajectory.pose_at(t), RIDING.leader.trajectory.pose_at(t)
        d, theta = hypot(l.x - p.x, l.y - p.y), atan2(l.x - p.x, l.y - p.y)
        across = -RIDING.leader.tas * sin(theta - l.heading) + RIDING.pursuer.tas * sin(
            theta - p.heading
        )
        rise = (history.separation[i + 1] - history.separation[i]) / (high - low)
        lam_brg = 0.5 * (history.bearing[i] + history.bearing[i + 1])
        multipliers.append(rise - lam_brg / d**2 * across)
    assert len(multipliers) > 20
    # a boundary arc's arcs swing about the mean turn rate, so differences over one are rough
    assert np.median(multipliers) > 0.0
    assert min(multipliers) == pytest.approx(boundary_arc.least_multiplier, rel=0.1)


def test_a_history_is_shown_by_its_columns() -> None:
    """Not by hundreds of numbers, which would hide what a report finds."""
    shown = repr(check(find_plan(RIDING), RIDING, samples=500))
    assert "history=AdjointHistory(6" in shown
    assert "times: times, hamiltonian, separation, bearing, switching)" in shown
    assert len(shown) < 2_000
