"""The pursuer's own level: faster where height keeps them apart, and never near in both at once."""

from dataclasses import replace

import numpy as np
import pytest

from relguide import (
    ChangeLevel,
    FlyStraight,
    Leader,
    LevelChange,
    NoPlan,
    Plan,
    Pursuer,
    Situation,
    Traffic,
    certify,
    plan,
)
from relguide.planning.heights import VERTICAL_MINIMUM, WHOLE_METRE, counted, heights_of
from relguide.planning.levels import is_at_level
from relguide.planning.plan import plan_at_once
from relguide.units import DEG, FT, NM
from tests.relguide.planning.test_heights import flown

FL = 100.0 * FT


def situations(rng: np.random.Generator) -> Situation:
    """Two aircraft on levels of their own; the leader descends in every other one."""
    descends = (FlyStraight(duration=60.0), ChangeLevel(to_altitude=310 * FL, rate=7.0))
    x, y = rng.uniform(-60e3, 60e3, 2)
    return Situation(
        pursuer=Pursuer(
            x=x, y=y, heading=rng.uniform(0.0, 6.0), tas=230.0, max_bank=25.0 * DEG,
            altitude=FL * (350.0 - rng.choice([0.0, 20.0, 40.0])),
        ),
        leader=Leader(
            x=0.0, y=0.0, heading=0.0, tas=210.0, altitude=350 * FL,
            intent=descends if rng.random() < 0.5 else (),
        ),
        slot_distance=7.5 * NM,
        min_separation=5.0 * NM,
    )  # fmt: skip


def unaware(situation: Situation) -> Situation:
    return replace(situation, pursuer=replace(situation.pursuer, altitude=None))


def test_no_plan_is_below_both_minima_at_once_however_the_levels_are_flown():
    rng = np.random.default_rng(3)
    near = 0
    for _ in range(200):
        situation = situations(rng)
        answer = plan(situation)
        if isinstance(answer, NoPlan):
            continue
        assert answer.certificate.holds
        assert is_at_level(answer.situation, answer.time_to_converge)
        times = np.arange(0.0, answer.time_to_converge, 1.0)
        own, leader = answer.sample(times), situation.leader.trajectory.sample(times)
        apart = np.hypot(own.x - leader.x, own.y - leader.y)
        near += int((apart < 5.0 * NM).sum())
        for _ in range(8):
            heights = [
                flown(heights_of(one), rng, times)
                for one in (answer.situation.pursuer, situation.leader)
            ]
            above = abs(heights[0] - heights[1])
            kept = (apart >= 5.0 * NM - 1.0) | (above >= VERTICAL_MINIMUM - WHOLE_METRE - 1e-6)
            assert kept.all()
    assert near > 500


def test_height_makes_plans_faster_and_never_faster_than_the_bound_without_the_limit():
    rng = np.random.default_rng(4)
    sooner = 0
    for _ in range(150):
        situation = situations(rng)
        answer, alone = plan(situation), plan(unaware(situation))
        if isinstance(answer, NoPlan) or isinstance(alone, NoPlan):
            continue
        free = plan(replace(unaware(situation), min_separation=0.0))
        assert isinstance(free, Plan)
        assert answer.time_to_converge >= free.time_to_converge - 1e-6
        assert answer.optimality.lower_bound <= answer.time_to_converge + 1e-6
        sooner += answer.time_to_converge < alone.time_to_converge - 1.0
    assert sooner >= 5


def test_equal_or_unknown_levels_change_nothing():
    rng = np.random.default_rng(5)
    for _ in range(30):
        situation = situations(rng)
        situation = replace(situation, leader=replace(situation.leader, intent=()))
        before = unaware(situation)
        same = replace(
            situation, pursuer=replace(situation.pursuer, altitude=situation.leader.altitude)
        )
        one, other = plan(before), plan(same)
        if isinstance(one, NoPlan) or isinstance(other, NoPlan):
            assert one == other
            continue
        assert other.levels == ()
        assert replace(other, situation=before) == one


def test_a_leader_far_above_is_passed_beneath_and_the_certificate_says_when():
    below = Situation(
        pursuer=Pursuer(
            x=0.0, y=60e3, heading=180.0 * DEG, tas=230.0, max_bank=25.0 * DEG, altitude=290 * FL
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=210.0, altitude=350 * FL),
        slot_distance=7.5 * NM,
        min_separation=5.0 * NM,
    )
    assert counted(heights_of(below.pursuer), heights_of(below.leader)) == ()
    ahead = below.pursuer.flying(plan(unaware(below)).trajectory.segments)
    found = certify(ahead, below)
    assert found.holds
    (kept,) = found.vertical
    assert kept == (0.0, ahead.duration, pytest.approx(6_000.0 * FT))


def test_traffic_at_another_level_does_not_count_and_is_told_with_its_height():
    other = Traffic(
        ident="BAW12", x=20e3, y=0.0, heading=270.0 * DEG, tas=200.0, min_separation=5.0 * NM,
        altitude=370 * FL,
    )  # fmt: skip
    situation = Situation(
        pursuer=Pursuer(
            x=0.0, y=-40e3, heading=0.0, tas=230.0, max_bank=25.0 * DEG, altitude=350 * FL
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=210.0, altitude=350 * FL),
        slot_distance=7.5 * NM,
        min_separation=5.0 * NM,
    )
    alone = plan(situation)
    assert isinstance(alone, Plan)
    for altitude, holds in ((370 * FL, True), (None, False)):
        crossing = replace(other, x=8e3, y=-20e3, altitude=altitude)
        amid = replace(situation, others=(crossing,))
        found = certify(alone.trajectory, amid)
        assert found.holds is holds
        assert found.others[0].least_separation < 5.0 * NM
        assert bool(found.others[0].vertical) is holds


def test_a_pursuer_keeps_the_levels_it_declares():
    situation = situations(np.random.default_rng(1))
    final = heights_of(situation.leader).final_altitude
    levels = (
        LevelChange(at=30.0, to_altitude=330 * FL, rate=5.0),
        LevelChange(at=90.0, to_altitude=final, rate=15.0),
    )
    declared = replace(situation, pursuer=replace(situation.pursuer, levels=levels))
    answer = plan(declared)
    assert isinstance(answer, Plan)
    assert answer.levels == levels


def test_no_plan_amid_traffic_is_below_both_minima_at_once():
    rng = np.random.default_rng(6)
    near, tight = 0, 0
    for _ in range(60):
        situation = situations(rng)
        others = []
        for k in range(4):
            x, y = rng.uniform(-60e3, 60e3, 2)
            change = ChangeLevel(to_altitude=FL * rng.choice([290.0, 330.0, 370.0]), rate=8.0)
            others.append(
                Traffic(
                    ident=f"T{k}", x=x, y=y, heading=rng.uniform(0.0, 6.0), tas=220.0,
                    min_separation=5.0 * NM, altitude=FL * rng.choice([310.0, 330.0, 350.0, 390.0]),
                    intent=(FlyStraight(duration=100.0), change) if k % 2 else (),
                )
            )  # fmt: skip
        answer = plan(replace(situation, others=tuple(others)))
        if isinstance(answer, NoPlan):
            continue
        times = np.arange(0.0, answer.time_to_converge, 1.0)
        own = answer.sample(times)
        tight += answer.optimality.proof == "bound"
        for other in (situation.leader, *others):
            there = other.trajectory.sample(times)
            apart = np.hypot(own.x - there.x, own.y - there.y)
            near += int((apart < 5.0 * NM).sum())
            for _ in range(4):
                heights = [
                    flown(heights_of(one), rng, times) for one in (answer.situation.pursuer, other)
                ]
                above = abs(heights[0] - heights[1])
                kept = (apart >= 5.0 * NM - 1.0) | (above >= VERTICAL_MINIMUM - WHOLE_METRE - 1e-6)
                assert kept.all()
    assert near > 500
    assert tight > 3


@pytest.mark.parametrize("feet", [8_000.0, -4_000.0])
def test_beside_the_slot_at_another_level_the_plan_is_later_and_joins_at_the_level(feet: float):
    situation = Situation(
        pursuer=Pursuer(
            x=4e3, y=-16e3, heading=0.2, tas=230.0, max_bank=25.0 * DEG,
            altitude=350 * FL + feet * FT,
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=210.0, altitude=350 * FL),
        slot_distance=7.5 * NM,
        min_separation=5.0 * NM,
    )  # fmt: skip
    alone, answer = plan(unaware(situation)), plan(situation)
    assert isinstance(answer, Plan)
    assert answer.certificate.holds
    assert answer.arrival.holds
    assert answer.time_to_converge > alone.time_to_converge
    assert is_at_level(answer.situation, answer.time_to_converge)
    assert not is_at_level(answer.situation, answer.time_to_converge - 3.0)


@pytest.mark.parametrize("at", [10.0, 800.0, 9_000.0])
@pytest.mark.parametrize("to", [320 * FL, 300 * FL])
def test_a_pursuer_with_changes_of_its_own_joins_at_the_level_of_its_leader_or_not_at_all(
    at: float, to: float
):
    situation = Situation(
        pursuer=Pursuer(
            x=-40e3, y=40e3, heading=1.5, tas=240.0, max_bank=25.0 * DEG, altitude=350 * FL,
            levels=(LevelChange(at=at, to_altitude=to, rate=10.0),),
        ),
        leader=Leader(x=0.0, y=0.0, heading=1.5, tas=200.0, altitude=300 * FL),
        slot_distance=7.5 * NM,
        min_separation=5.0 * NM,
    )  # fmt: skip
    answer, at_once = plan(situation), plan_at_once(situation)
    if to == 300 * FL:
        assert isinstance(answer, Plan)
        assert answer.certificate.holds
        assert answer.arrival.holds
        assert is_at_level(answer.situation, answer.time_to_converge)
    else:
        assert isinstance(answer, NoPlan)
        assert answer.reason == "level"
        assert "never" in answer.message
    assert at_once is None or at_once == answer
