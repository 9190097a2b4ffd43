"""The search with the limit: what it finds certifies, flies, and stands up to a harder look."""

from math import cos, inf, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide import BoundaryArc, Leader, NoPlan, Plan, Pursuer, Situation, plan
from relguide.kernels.contact import contact_heading, ride_rate, ride_time, ride_turn
from relguide.kernels.detour import best_detour
from relguide.kernels.passage import GRAZE
from relguide.kernels.ride import best_ride
from relguide.kernels.tangent import tangent_contacts, tangents
from relguide.kernels.turn import turn_radius
from relguide.planning.detour import BEARINGS, leader_table
from relguide.planning.words import candidates
from tests.oracle import arrival_error
from tests.situations import headings, numbers


@st.composite
def tight_corners(draw: st.DrawFn) -> Situation:
    """Slow and steep, R < d_min, the pursuer close beside, ahead of or behind the leader."""
    tas, bank = draw(numbers(90.0, 140.0)), radians(draw(numbers(25.0, 35.0)))
    limit = turn_radius(tas, bank) * draw(numbers(1.0, 4.0))
    bearing, distance = draw(headings), limit * draw(numbers(1.001, 1.6))
    return Situation(
        pursuer=Pursuer(
            x=distance * sin(bearing),
            y=distance * cos(bearing),
            heading=draw(headings),
            tas=tas,
            max_bank=bank,
        ),
        leader=Leader(x=0.0, y=0.0, heading=draw(headings), tas=tas * draw(numbers(0.6, 0.95))),
        slot_distance=limit * draw(numbers(1.0, 1.6)),
        min_separation=limit,
    )


@given(situation=tight_corners())
def test_in_the_tight_corner_every_plan_arrives_and_keeps_its_distance(
    situation: Situation,
) -> None:
    answer = plan(situation)
    if isinstance(answer, NoPlan):
        assert answer.reason == "separation_unavoidable"
        return
    assert answer.certificate.holds
    distance, heading_error, least = arrival_error(situation, answer.trajectory)
    assert distance < 0.02
    assert heading_error < 1e-6
    assert least > situation.min_separation - 0.5  # interpolated between samples


RIDING = Situation(
    pursuer=Pursuer(x=-5_690.0, y=2_050.0, heading=0.113, tas=93.0, max_bank=0.54),
    leader=Leader(x=0.0, y=0.0, heading=0.584, tas=65.4),
    slot_distance=5_515.0,
    min_separation=5_425.0,
)


def test_a_ride_along_the_limit_beats_every_way_that_touches_it_once() -> None:
    answer = plan(RIDING)
    assert isinstance(answer, Plan)
    (ride,) = [s for s in answer.trajectory.segments if isinstance(s, BoundaryArc)]
    assert "B" in answer.word
    radius = RIDING.pursuer.turn_radius
    assert all(abs(curvature) <= 1.0 / radius + 1e-9 for _, curvature in ride.bends)
    once, _ = searched(RIDING, BEARINGS)
    assert answer.time_to_converge < once - 1.0
    # on the ride the separation is d_min
    t = (
        sum(s.length for s in answer.trajectory.segments[: answer.trajectory.segments.index(ride)])
        / answer.trajectory.tas
    )
    for part in (0.0, 0.3, 0.7, 1.0):
        at = t + part * ride.length / answer.trajectory.tas
        ours, theirs = answer.trajectory.pose_at(at), RIDING.leader.trajectory.pose_at(at)
        separation = np.hypot(ours.x - theirs.x, ours.y - theirs.y)
        assert separation == pytest.approx(RIDING.min_separation, abs=0.01)


@pytest.mark.parametrize("off", [0.0, 1e-7, -1e-7, 1e-5])
def test_a_ride_is_closed_by_the_word_it_was_searched_with(off: float) -> None:
    """Rounding of the ride's last node once cost the right word, and 1,553 s."""
    situation = Situation(
        pursuer=Pursuer(
            x=5_126.637 + off, y=7_507.113, heading=0.729506, tas=130.92535, max_bank=0.4715
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=117.906548),
        slot_distance=8_609.996,
        min_separation=8_500.767,
    )
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.time_to_converge == pytest.approx(227.69, abs=0.01)


def searched(situation: Situation, bearings: int) -> tuple[float, float]:
    """Arrival [s] by touching once, and by the better of that and riding."""
    frame = candidates(situation).frame
    limit = situation.min_separation / frame.radius + GRAZE
    table = leader_table(situation, frame)
    start = frame.x, frame.y, frame.h, table, frame.alpha, limit
    scan = frame.t_open, bearings, tangents(*start)
    once = best_detour(*start, *scan, inf, np.zeros((2, 5)))
    ride, *_ = best_ride(*start, *scan, once, np.zeros(5))
    scale = frame.radius / situation.pursuer.tas
    return once * scale, ride * scale


def drawn(rng: np.random.Generator, *, tight: bool) -> Situation:
    """A situation near the leader, where the limit tends to be active."""
    tas, bank = rng.uniform(90.0, 260.0), radians(rng.uniform(15.0, 35.0))
    limit = turn_radius(tas, bank) * (rng.uniform(1.0, 4.0) if tight else rng.uniform(0.3, 1.0))
    bearing = rng.uniform(0.0, 2.0 * np.pi)
    distance = limit * (rng.uniform(1.0, 1.6) if tight else rng.uniform(1.0, 8.0))
    return Situation(
        pursuer=Pursuer(
            x=distance * sin(bearing),
            y=distance * cos(bearing),
            heading=rng.uniform(0.0, 2.0 * np.pi),
            tas=tas,
            max_bank=bank,
        ),
        leader=Leader(
            x=0.0, y=0.0, heading=rng.uniform(0.0, 2.0 * np.pi), tas=tas * rng.uniform(0.6, 0.98)
        ),
        slot_distance=limit * rng.uniform(1.0, 2.0),
        min_separation=limit,
    )


@pytest.mark.slow
@pytest.mark.parametrize("tight", [True, False])
def test_eight_times_the_effort_finds_nothing_much_better(tight: bool) -> None:
    rng = np.random.default_rng(7)
    worse = []
    for _ in range(60):
        situation = drawn(rng, tight=tight)
        _, ours = searched(situation, BEARINGS)
        _, harder = searched(situation, 8 * BEARINGS)
        if not ours <= harder + 0.1:
            worse.append((situation, ours, harder))
    assert not worse, worse


@given(bearing=headings, side=st.sampled_from([1.0, -1.0]), alpha=numbers(0.3, 0.98))
def test_a_contact_is_tangent(bearing: float, side: float, alpha: float) -> None:
    heading = contact_heading(bearing, side, alpha)
    vx, vy = cos(heading) - alpha, sin(heading)
    assert vx * cos(bearing) + vy * sin(bearing) == pytest.approx(0.0, abs=1e-12)
    around = vy * cos(bearing) - vx * sin(bearing)
    assert around * side > 0.0
    assert ride_rate(bearing, side, alpha, 2.0) == pytest.approx(around / 2.0)


@given(bearing=headings, side=st.sampled_from([1.0, -1.0]), alpha=numbers(0.3, 0.95))
def test_a_ride_turns_as_fast_as_the_contact_heading_does(
    bearing: float, side: float, alpha: float
) -> None:
    step = 1e-6 * side
    turned = contact_heading(bearing + step, side, alpha) - contact_heading(bearing, side, alpha)
    duration = ride_time(bearing, bearing + step, side, alpha, 2.0)
    assert turned / duration == pytest.approx(
        side * ride_turn(bearing, side, alpha, 2.0), rel=1e-3, abs=1e-5
    )


def test_tangent_contacts_touch() -> None:
    found = np.empty((32, 3))
    n = tangent_contacts(6.0, 1.0, 2.5, 0.8, 2.0, found)
    assert n >= 2
    for bearing, side, time in found[:n]:
        assert 0.0 <= bearing < 2.0 * np.pi
        assert side in (1.0, -1.0)
        assert time > 0.0
