"""What else there was: complete, in order, and each with the true reason why it is not flown."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from math import pi

import numpy as np
import pytest
from hypothesis import assume, given, settings

from relguide import (
    LEFT,
    RIGHT,
    Alternative,
    Arc,
    Leader,
    Plan,
    Pursuer,
    Situation,
    alternatives,
    candidates,
    certify,
    plan,
)
from relguide.kernels.words.extremals import WORDS
from relguide.planning.alternatives import (
    AsFast,
    Faster,
    LosesSeparation,
    NoRoot,
    Slower,
    TooEarly,
)
from relguide.planning.outcome import AS_FAST
from relguide.planning.passing import passing, surroundings
from relguide.planning.slot import slot_frame
from relguide.units import DEG
from tests.flights import random_start
from tests.plans import find_plan, golden_plan, plan_unlimited, straight_behind
from tests.relguide.planning.test_plan import mirror
from tests.situations import situations

Listed = Sequence[Alternative | TooEarly | NoRoot]
MIRROR = str.maketrans("LR", "RL")
ROUNDING = 1e-6
"""Seconds by which the same path differs as two solvers find it."""


def words_and_reasons(listed: Listed) -> list[tuple[str, str]]:
    return [(type(other).__name__, f"{other.word}: {other.why}") for other in listed]


@given(situation=situations(reach=60_000.0))
@settings(max_examples=40)
def test_each_is_rejected_for_a_true_reason(situation: Situation) -> None:
    """Slower than the plan, or too close: what certifies never beats it."""
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    for other in alternatives(answer):
        match other:
            case Alternative(rejected=rejected):
                certificate = certify(other.candidate.trajectory, situation)
                by = other.time_to_converge - answer.time_to_converge
                match rejected:
                    case Slower():
                        assert rejected.by == by > AS_FAST
                    case LosesSeparation():
                        assert by <= AS_FAST
                        assert rejected.least_separation < situation.min_separation
                        assert not certificate.holds
                    case AsFast():
                        assert abs(by) <= AS_FAST
                        assert certificate.holds
                    case Faster():
                        raise AssertionError(f"{other.word} certifies and beats the plan")
            case TooEarly():
                assert (
                    other.time_to_converge < other.release_time <= answer.time_to_converge + AS_FAST
                )
            case NoRoot():
                assert other.word not in [c.word for c in candidates(situation).later]


@given(situation=situations(reach=60_000.0))
@settings(max_examples=40)
def test_each_word_is_there_and_the_order_is_that_of_time(situation: Situation) -> None:
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    listed = alternatives(answer)
    assert {other.word for other in listed} | {answer.word} >= set(WORDS)
    timed = [other for other in listed if not isinstance(other, NoRoot)]
    assert all(isinstance(other, NoRoot) for other in listed[len(timed) :])
    assert all(a.time_to_converge <= b.time_to_converge for a, b in pairwise(timed))
    # nothing faster is left out
    faster = {
        c.word
        for c in candidates(situation).later
        if c.time_to_converge < answer.time_to_converge - AS_FAST
    }
    assert faster <= {o.word for o in timed if o.time_to_converge < answer.time_to_converge}


@given(situation=situations(reach=60_000.0))
@settings(max_examples=40)
def test_the_mirrored_situation_has_mirrored_alternatives(situation: Situation) -> None:
    answer = plan_unlimited(situation)
    other = plan(mirror(situation))
    assert isinstance(other, Plan)
    # of the many ways to an opening slot some are found, and their images need not be
    assume(not candidates(situation).reachable_at_release)
    # ties are decided by rounding
    assume(other.word == answer.word.translate(MIRROR))
    assume(all(not isinstance(getattr(o, "rejected", 0), AsFast) for o in alternatives(answer)))
    ours, theirs = alternatives(answer), alternatives(other)
    assert len(ours) == len(theirs)
    for one, image in zip(*(sorted(o, key=mirror_order) for o in (ours, theirs)), strict=True):
        assert type(one) is type(image)
        if not isinstance(one, NoRoot) and not isinstance(image, NoRoot):
            # far away a microsecond of τ is 0.1 mm of arc: nearly parallel ways part slowly
            assert one.time_to_converge == pytest.approx(image.time_to_converge, rel=1e-6)
    words = sorted(o.word.translate(MIRROR) for o in ours)
    assert words == sorted(o.word for o in theirs)


def mirror_order(other: Alternative | TooEarly | NoRoot) -> tuple[float, str]:
    time = float("inf") if isinstance(other, NoRoot) else round(other.time_to_converge, 2)
    return time, min(other.word, other.word.translate(MIRROR))


@given(situation=situations(reach=40_000.0))
@settings(max_examples=40)
def test_how_the_leader_is_passed_is_what_small_steps_show(situation: Situation) -> None:
    """Small turns of the line of sight summed, and crossings of the line ahead counted."""
    candidate = next(iter(candidates(situation)), None)
    assume(candidate is not None)
    assert candidate is not None
    assume(certify(candidate.trajectory, situation).least_separation > 500.0)
    assume(candidate.time_to_converge < 1_500.0)
    ours, theirs = candidate.trajectory, situation.leader.trajectory
    times = np.linspace(0.0, ours.duration, 1_500).tolist()
    places = np.array([(o.x, o.y) for o in map(ours.pose_at, times)])
    places -= np.array([(o.x, o.y) for o in map(theirs.pose_at, times)])
    bearing = np.arctan2(places[:, 0], places[:, 1])  # of the pursuer from the leader: turns alike
    turned = float((np.remainder(np.diff(bearing) + pi, 2.0 * pi) - pi).sum())
    found = passing(ours, surroundings(candidates(situation)))
    if abs(turned) > 1e-3:
        assert found.side == (RIGHT if turned > 0.0 else LEFT)
    off_ahead = np.remainder(bearing - slot_frame(situation, theirs).heading + pi, 2.0 * pi) - pi
    assume(1e-3 < abs(off_ahead[0]) < pi - 1e-3)
    near = np.abs(off_ahead) < 0.5 * pi
    right = off_ahead > 0.0
    over = near[:-1] & near[1:] & (right[:-1] != right[1:])
    assert found.laps == int(np.where(right[1:][over], 1, -1).sum())


def test_a_golden_case_whose_limit_binds() -> None:
    listed = alternatives(golden_plan("R061"))
    assert words_and_reasons(listed) == [
        ("Alternative", "RLR: comes within 0.21 NM at 160 s"),
        ("Alternative", "LRL: 60 s slower"),
        ("Alternative", "RSL: 569 s slower, and comes within 2.06 NM at 155 s"),
        ("Alternative", "LSR: 574 s slower"),
        ("Alternative", "RSR: 2,456 s slower, and comes within 2.06 NM at 155 s"),
        ("NoRoot", "LSL: no such path to the slot"),
    ]


def test_a_golden_case_with_intent_whose_slot_opens_later() -> None:
    answer = golden_plan("R104")
    listed = alternatives(answer)
    assert words_and_reasons(listed) == [
        ("TooEarly", "RSR: reaches the slot 254 s before it opens"),
        ("TooEarly", "RLR: reaches the slot 232 s before it opens"),
        ("Alternative", "LSR: 348 s slower"),
        ("Alternative", "RSL: 469 s slower, and comes within 2.55 NM at 249 s"),
        ("Alternative", "LSL: 1,409 s slower"),
        ("NoRoot", "LRL: no such path to the slot"),
    ]
    for other in listed[:2]:
        assert isinstance(other, TooEarly)
        assert other.release_time == pytest.approx(answer.time_to_converge, abs=1e-6)


def test_a_word_that_takes_more_than_twelve_hours_is_said_to() -> None:
    """With equal headings and nearly equal speeds two turns in the same sense take half a day."""
    situation = Situation(
        pursuer=Pursuer(x=6456.0, y=-29_995.0, heading=0.0, tas=150.0, max_bank=15.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=147.0),
        slot_distance=8_000.0,
        min_separation=5_500.0,
    )
    assert words_and_reasons(alternatives(find_plan(situation)))[2:] == [
        ("NoRoot", "RSL: no such path to the slot within 12 hours"),
        ("NoRoot", "LRL: no such path to the slot"),
        ("NoRoot", "RLR: no such path to the slot"),
    ]


def test_of_a_word_with_two_paths_both_are_listed_if_both_are_faster() -> None:
    """Both LRL pass on the same side with as small a middle arc; what keeps either from being
    flown is its own separation."""
    situation = Situation(
        pursuer=Pursuer(
            x=-20_000.0, y=21_000.0, heading=159.0 * DEG, tas=226.0, max_bank=20.0 * DEG
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=203.0),
        slot_distance=9_000.0,
        min_separation=8_500.0,
    )
    answer = find_plan(situation)
    assert answer.word == "RSLSR"
    listed = alternatives(answer)
    assert words_and_reasons(listed) == [
        ("Alternative", "LSR: comes within 3.80 NM at 87 s"),
        ("Alternative", "LRL: comes within 3.80 NM at 87 s"),
        ("Alternative", "LRL: comes within 3.80 NM at 87 s"),
        ("Alternative", "RSL: 965 s slower"),
        ("Alternative", "LSL: 3,769 s slower, and comes within 3.64 NM at 618 s"),
        ("Alternative", "RSR: 4,718 s slower"),
        ("NoRoot", "RLR: no such path to the slot"),
    ]
    first, second = (o for o in listed if isinstance(o, Alternative) and o.word == "LRL")
    assert first.passing == second.passing
    assert second.time_to_converge == pytest.approx(328.32, abs=0.01)


def test_of_slower_paths_only_the_fastest_of_each_branch_is_listed() -> None:
    """A way is a word, which middle arc it has, and how it passes the leader."""
    left_out = 0
    for situation in map(random_start, range(60)):
        answer, found = plan(situation), candidates(situation)
        if not isinstance(answer, Plan) or found.reachable_at_release:
            continue
        around = surroundings(candidates(situation))
        times: dict[tuple[str, bool, int], list[float]] = {}
        for path in found.later:
            middle = path.trajectory.segments[1:2]
            long = any(isinstance(arc, Arc) and arc.turn_angle > pi for arc in middle)
            way = (path.word, long, passing(path.trajectory, around).laps)
            times.setdefault(way, []).append(path.time_to_converge)
        expected = [
            (time, way[0])
            for way, (fastest, *more) in times.items()
            for time in (fastest, *(time for time in more if time < answer.time_to_converge))
            if way[0] != answer.word or abs(time - answer.time_to_converge) > ROUNDING
        ]
        others = [other for other in alternatives(answer) if isinstance(other, Alternative)]
        assert [(other.time_to_converge, other.word) for other in others] == sorted(expected)
        left_out += any(more for _, *more in times.values())
    assert left_out >= 5


def test_straight_behind_four_words_are_one_path() -> None:
    listed = alternatives(find_plan(straight_behind()))
    same = [other.word for other in listed if other.why == "as fast: the same path"]
    assert sorted(same) == ["LSR", "RSL", "RSR"]


def test_paths_round_the_leader_are_distinguished() -> None:
    """From the left of a leader flying north: behind it goes counter-clockwise, ahead clockwise."""
    situation = Situation(
        pursuer=Pursuer(x=-15_000.0, y=0.0, heading=0.0, tas=220.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=180.0),
        slot_distance=9_000.0,
        min_separation=2_000.0,
    )
    answer = find_plan(situation)
    behind = passing(answer.trajectory, surroundings(candidates(situation)))
    assert (behind.where, behind.side, behind.laps) == ("behind", LEFT, 0)
    ahead = [
        other.passing
        for other in alternatives(answer)
        if isinstance(other, Alternative) and other.passing.where == "ahead"
    ]
    assert ahead
    assert {(way.side, way.laps) for way in ahead} == {(RIGHT, 1)}
    image = mirror(situation)
    other_side = passing(find_plan(image).trajectory, surroundings(candidates(image)))
    assert (other_side.where, other_side.side) == ("behind", RIGHT)


def test_of_a_plan_that_is_not_the_fastest_it_is_said() -> None:
    """As a planner that is not exact may give: never hidden."""
    situation = straight_behind()
    answer = find_plan(replace(situation, pursuer=replace(situation.pursuer, heading=1.0)))
    slow = list(candidates(answer.situation))[1]
    worse = replace(answer, trajectory=slow.trajectory, word=slow.word, planner="network")
    first = alternatives(worse)[0]
    assert isinstance(first, Alternative)
    assert isinstance(first.rejected, Faster)
    assert first.word == answer.word
    assert first.why.endswith("s faster, and not found by the planner network")


def test_in_the_slot_already() -> None:
    situation = straight_behind()
    there = replace(situation, pursuer=replace(situation.pursuer, y=-9_000.0))
    assert alternatives(find_plan(there))


def test_a_slot_at_the_leaders_own_place() -> None:
    situation = replace(straight_behind(d_min=0.0), slot_distance=0.0)
    assert {o.word for o in alternatives(find_plan(situation))} >= {"LRL", "RLR"}
