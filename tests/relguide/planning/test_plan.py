"""Properties of plans: mirror, scale, rotate, shift, Bellman; and honest answers without one."""

from dataclasses import replace
from math import cos, pi, sin

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide import (
    LEFT,
    RIGHT,
    FlyStraight,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
    candidates,
    certify,
    plan,
)
from relguide.planning.intent import IntentPiece
from relguide.planning.outcome import Optimality
from relguide.units import DEG
from tests.flights import random_start
from tests.oracle import arrival_error
from tests.plans import find_plan, straight_behind
from tests.situations import headings, numbers, situations

TIME = 1e-5
"""Seconds by which equal plans may differ: rounding of 150 km over the least closure."""


def turn(x: float, y: float, angle: float) -> tuple[float, float]:
    """A point turned clockwise about the origin."""
    return x * cos(angle) + y * sin(angle), y * cos(angle) - x * sin(angle)


def map_intent(intent: tuple[IntentPiece, ...], sign: int, angle: float) -> tuple[IntentPiece, ...]:
    return tuple(
        p
        if isinstance(p, FlyStraight)
        else TurnTo(
            heading=sign * p.heading + angle,
            turn=(LEFT if p.turn * sign > 0 else RIGHT),
            bank=p.bank,
        )
        for p in intent
    )


def mirror(situation: Situation) -> Situation:
    """West for east."""
    p, l = situation.pursuer, situation.leader
    return replace(
        situation,
        pursuer=replace(p, x=-p.x, heading=-p.heading),
        leader=replace(l, x=-l.x, heading=-l.heading, intent=map_intent(l.intent, -1, 0.0)),
        wind=Wind(east=-situation.wind.east, north=situation.wind.north),
    )


def move(situation: Situation, angle: float, dx: float, dy: float) -> Situation:
    """Turned clockwise about the origin, then shifted."""
    p, l, w = situation.pursuer, situation.leader, situation.wind
    px, py = turn(p.x, p.y, angle)
    lx, ly = turn(l.x, l.y, angle)
    east, north = turn(w.east, w.north, angle)
    return replace(
        situation,
        pursuer=replace(p, x=px + dx, y=py + dy, heading=p.heading + angle),
        leader=replace(
            l,
            x=lx + dx,
            y=ly + dy,
            heading=l.heading + angle,
            intent=map_intent(l.intent, 1, angle),
        ),
        wind=Wind(east=east, north=north),
    )


def scale(situation: Situation, k: float) -> Situation:
    """Lengths times k², speeds times k: the same picture, since R = V²/(g tan φ)."""
    p, l, w = situation.pursuer, situation.leader, situation.wind
    return Situation(
        pursuer=replace(p, x=p.x * k * k, y=p.y * k * k, tas=p.tas * k),
        leader=replace(
            l,
            x=l.x * k * k,
            y=l.y * k * k,
            tas=l.tas * k,
            intent=tuple(
                FlyStraight(duration=i.duration * k) if isinstance(i, FlyStraight) else i
                for i in l.intent
            ),
        ),
        slot_distance=situation.slot_distance * k * k,
        min_separation=situation.min_separation * k * k,
        wind=Wind(east=w.east * k, north=w.north * k),
    )


def same(first: Plan | NoPlan, second: Plan | NoPlan, factor: float = 1.0) -> None:
    # a separation within rounding of d_min may certify one and not the other
    assume(isinstance(first, Plan) and first.optimality.proof == "relaxation")
    assert isinstance(first, Plan)
    assume(first.certificate.least_separation > first.situation.min_separation + 0.1)
    assert isinstance(second, Plan), second
    assert second.time_to_converge == pytest.approx(first.time_to_converge * factor, abs=TIME)


@given(situation=situations())
def test_the_mirrored_situation_takes_as_long(situation: Situation) -> None:
    same(plan(situation), plan(mirror(situation)))


@given(situation=situations(), angle=headings, dx=numbers(-1e5, 1e5), dy=numbers(-1e5, 1e5))
def test_turning_and_shifting_the_world_changes_nothing(
    situation: Situation, angle: float, dx: float, dy: float
) -> None:
    same(plan(situation), plan(move(situation, angle, dx, dy)))


@given(situation=situations(), k=st.sampled_from([0.5, 0.8, 1.25, 1.5]))
def test_scaled_lengths_and_speeds_scale_the_plan(situation: Situation, k: float) -> None:
    same(plan(situation), plan(scale(situation, k)), k)


@given(situation=situations())
def test_flying_a_plan_ends_in_the_slot(situation: Situation) -> None:
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    distance, heading_error, least = arrival_error(situation, answer.trajectory)
    assert distance < 1e-6 * situation.pursuer.turn_radius + 1e-3  # R-relative, and scipy's own
    assert heading_error < 1e-6
    assert least > answer.certificate.lower_bound - 1.0  # 1 m: interpolated a second apart


@given(situation=situations(with_intent=False), part=numbers(0.01, 0.95))
def test_replanning_on_the_way_is_the_rest_of_the_plan(situation: Situation, part: float) -> None:
    """Bellman: where the limit plays no part the rest of an optimal plan is optimal."""
    answer = plan(situation)
    assume(isinstance(answer, Plan) and answer.optimality.proof == "relaxation")
    assert isinstance(answer, Plan)
    t = part * answer.time_to_converge
    ours, theirs = answer.trajectory.pose_at(t), situation.leader.trajectory.pose_at(t)
    rest = plan(
        replace(
            situation,
            pursuer=replace(
                situation.pursuer, x=ours.x - theirs.x, y=ours.y - theirs.y, heading=ours.heading
            ),
            leader=replace(situation.leader, x=0.0, y=0.0, heading=theirs.heading),
        )
    )
    assert isinstance(rest, Plan)
    assert rest.time_to_converge == pytest.approx(answer.time_to_converge - t, abs=1e-4)


@given(situation=situations(reach=60_000.0))
def test_no_candidate_that_certifies_beats_the_plan(situation: Situation) -> None:
    answer = plan(situation)
    for candidate in candidates(situation):
        if certify(candidate.trajectory, situation).holds:
            assert isinstance(answer, Plan)
            assert candidate.time_to_converge >= answer.time_to_converge - 1e-9


def two(**changes: object) -> Situation:
    base = Situation(
        pursuer=Pursuer(x=-40_000.0, y=0.0, heading=0.5 * pi, tas=200.0, max_bank=25 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.5 * pi, tas=180.0),
        slot_distance=12_000.0,
        min_separation=9_000.0,
    )
    return replace(base, **changes)  # type: ignore[arg-type]


def test_straight_behind_is_a_straight() -> None:
    answer = plan(two())
    assert isinstance(answer, Plan)
    assert answer.time_to_converge == pytest.approx(28_000.0 / 20.0)
    assert answer.trajectory.letters == "S"


@pytest.mark.parametrize("tas", [180.0, 170.0])
def test_a_leader_that_is_not_slower_may_be_out_of_reach(tas: float) -> None:
    slow = Pursuer(x=-40_000.0, y=0.0, heading=0.5 * pi, tas=tas, max_bank=25 * DEG)
    answer = plan(two(pursuer=slow))
    assert isinstance(answer, NoPlan)
    assert answer.reason == "slot_unreachable"
    assert "350 kt" in answer.message


def test_too_close_already() -> None:
    answer = plan(two(leader=Leader(x=-38_000.0, y=0.0, heading=0.0, tas=150.0)))
    assert isinstance(answer, NoPlan)
    assert answer.reason == "separation_already_lost"
    assert "1.08 NM" in answer.message


def test_a_chase_of_days_is_beyond_the_horizon() -> None:
    answer = plan(two(leader=Leader(x=0.0, y=0.0, heading=0.5 * pi, tas=199.9)))
    assert isinstance(answer, NoPlan)
    assert answer.reason == "beyond_horizon"


def test_a_slot_that_opens_later_is_taken_the_moment_it_opens() -> None:
    """The slot opens once the leader has flown D on its final leg."""
    turning = Leader(
        x=0.0,
        y=0.0,
        heading=0.5 * pi,
        tas=180.0,
        intent=(FlyStraight(duration=200.0), TurnTo(heading=pi, turn=RIGHT, bank=25 * DEG)),
    )
    situation = two(
        leader=turning,
        pursuer=Pursuer(x=38_000.0, y=2_000.0, heading=pi, tas=200.0, max_bank=25 * DEG),
    )
    answer = plan(situation)
    assert isinstance(answer, Plan)
    opens = turning.trajectory.duration + 12_000.0 / 180.0
    assert answer.time_to_converge == pytest.approx(opens, abs=1e-6)
    assert answer.optimality.proof == "relaxation"
    distance, _, _ = arrival_error(situation, answer.trajectory)
    assert distance < 0.02


def test_the_same_plan_twice_is_one() -> None:
    first, second = find_plan(straight_behind()), find_plan(straight_behind())
    assert first.compute_time != second.compute_time
    assert first == second


def test_a_plan_prints_in_three_lines() -> None:
    answer = find_plan(straight_behind())
    lines = repr(answer).splitlines()
    assert lines[0] == "Plan(LSL by exact: joins in 775.0 s, S 170.50 km,"
    assert lines[1] == "     least separation 9000.0 m at 775.0 s, proved above 9000.0 m,"
    assert lines[2] == "     proof: relaxation, no plan is faster than 775.0 s)"
    assert len(lines) == 3
    assert repr(answer.trajectory) == "Trajectory(S 170.50 km; 775.0 s)"


@pytest.mark.parametrize("name", ["", " ", "a" * 41, "two\nlines", None, 7])
def test_a_planner_must_have_a_name_to_show(name: object) -> None:
    with pytest.raises(ValueError, match="planner must be a name of 1 to 40 printable characters"):
        replace(find_plan(straight_behind()), planner=name)  # type: ignore[arg-type]


def test_from_a_trajectory_of_ones_own_comes_a_plan_with_its_certificate() -> None:
    exact = find_plan(straight_behind())
    own = Plan.from_trajectory(exact.trajectory, exact.situation, planner="own", lower_bound=700.0)
    assert (own.planner, own.word) == ("own", "S")
    assert own.certificate == exact.certificate
    assert own.optimality == Optimality(proof="bound", lower_bound=700.0)
    nothing_known = Plan.from_trajectory(exact.trajectory, exact.situation, planner="own")
    assert nothing_known.optimality == Optimality(proof="none", lower_bound=0.0)


def test_of_paths_that_arrive_together_the_one_of_fewest_turns_keeps_most_clear() -> None:
    """To a metre: separations that near count as equal, and the one that turns less is flown."""
    ties = more_turns_keep_farther = 0
    for situation in map(random_start, [*range(60), 231, 396, 608]):
        answer = plan(situation)
        paths = [candidate.trajectory for candidate in candidates(situation).at_release]
        if not isinstance(answer, Plan) or answer.trajectory not in paths:
            continue
        certified = [(path, certify(path, situation)) for path in paths]
        keeping = [(path, found) for path, found in certified if found.holds]
        fewest = min(path.turns for path, _ in keeping)
        alike = [found.least_separation for path, found in keeping if path.turns == fewest]
        assert answer.trajectory.turns == fewest
        assert answer.certificate.least_separation >= max(alike) - 1.0
        first = next(i for i, (path, _) in enumerate(keeping) if path == answer.trajectory)
        earlier = [found.least_separation for _, found in keeping[:first]]
        assert all(answer.certificate.least_separation > least + 1.0 for least in earlier)
        ties += len(alike) > 1
        farthest = max(found.least_separation for _, found in keeping)
        more_turns_keep_farther += farthest > max(alike) + 1.0
    assert ties >= 5
    assert more_turns_keep_farther >= 3


def test_a_plan_most_of_a_second_slower_than_the_bound_is_not_proved_the_fastest() -> None:
    """A bend round d_min costs it 0.86 s: times are the same to rounding only."""
    situation = Situation(
        pursuer=Pursuer(x=-356.0, y=20_965.0, heading=pi, tas=153.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=119.0),
        slot_distance=9_000.0,
        min_separation=6_000.0,
    )
    answer = find_plan(situation)
    assert answer.time_to_converge - answer.optimality.lower_bound == pytest.approx(0.86, abs=0.01)
    assert answer.optimality.lower_bound == candidates(situation).bound
    assert answer.optimality.proof == "bound"
