"""Clear of all or not, and when the slot is: against samples of what moves in the air mass."""

from math import inf

import numpy as np
import pytest

from relguide import Arc, Cell, Situation, Straight, Trajectory
from relguide.kernels.base.records import Pose
from relguide.kernels.contact.others import (
    Others,
    broken_by,
    counts_at,
    is_disc,
    may_arrive_at,
    place_at,
    scene_with,
)
from relguide.planning.certificate import FOLLOWED
from relguide.planning.others_table import others_of
from relguide.planning.slot import SlotFrame, slot_frame, slot_offset
from tests.skies import any_sky, blocked, crossing, margins, nearest


def sky(seed: int) -> tuple[Situation, SlotFrame, Others]:
    situation = any_sky(np.random.default_rng(seed), 8)
    frame = slot_frame(situation, situation.leader.trajectory)
    return situation, frame, others_of(situation, frame)


@pytest.mark.parametrize("seed", range(30))
def test_a_piece_is_broken_by_what_it_comes_too_close_to(seed: int) -> None:
    situation, frame, others = sky(seed)
    pursuer = situation.pursuer
    rng = np.random.default_rng(1000 + seed)
    names = ["", *(other.ident for other in situation.others)]
    for _ in range(20):
        sign, amount = float(rng.integers(-1, 2)), rng.uniform(0.1, 5.0)
        segment = (
            Straight(length=amount * frame.radius)
            if sign == 0.0
            else Arc(turn=1 if sign > 0.0 else -1, turn_angle=amount, radius=frame.radius)
        )
        path = Trajectory(
            x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas,
            segments=(segment,),
        )  # fmt: skip
        t = np.append(np.arange(0.0, path.duration, 0.05), path.duration)
        way = path.over_ground(situation.wind, t)
        seen = {
            other.ident: nearest(other, t, way.x, way.y, situation.wind)
            for other in situation.others
        }
        seen[""] = margins(path, situation)[""]
        broken = broken_by(frame.pose, sign, 0.0, amount, others)
        if broken >= 0:
            assert seen[names[broken]] < 10.0  # samples are 20 m apart, cells kept 11 cm off
        else:
            assert min(seen.values()) > -0.02


@pytest.mark.parametrize("seed", range(12))
def test_arrivals_are_forbidden_after_which_the_slot_is_not_clear(seed: int) -> None:
    situation, frame, others = sky(seed)
    scale = frame.radius / situation.pursuer.tas
    east, north, _ = slot_offset(situation.leader.final_heading, situation.leader.tas, situation)
    opens = frame.t_release * scale
    t = np.arange(0.0, 3_000.0, 0.5)
    led = situation.leader.trajectory.over_ground(situation.wind, t)
    leader = situation.leader.trajectory
    ends = leader.duration  # before its last turn the leader is elsewhere than the slot's line
    clear = np.array([
        min(
            nearest(other, t[k : k + 1], led.x[k : k + 1] + east, led.y[k : k + 1] + north,
                    situation.wind)
            for other in situation.others
        )
        for k in range(len(t))
    ])  # fmt: skip
    checked = 0
    for k in range(0, len(t) - int(2.0 * FOLLOWED) - 1, 20):
        if t[k] < max(opens, ends):
            continue
        least = clear[k : k + int(2.0 * FOLLOWED) + 1].min()
        if abs(least) > 200.0:  # between two samples, and while others turn, it is not told
            assert may_arrive_at(t[k] / scale, others) == (least > 0.0)
            checked += 1
    assert checked > 20


def test_each_of_them_is_where_it_is() -> None:
    situation, frame, others = sky(3)
    scale = frame.radius / situation.pursuer.tas
    for i, other in enumerate((situation.leader, *situation.others)):
        if isinstance(other, Cell):
            assert is_disc(others, i) == (other.shape.kind == "disc" and other.growth == 0.0)
            continue
        assert is_disc(others, i)
        for t in (0.0, 40.0, 90.0, 400.0):
            at = other.trajectory.pose_at(t)
            assert place_at(others, i, t / scale) == pytest.approx(frame.to_slot(at.x, at.y))
        assert scene_with(others, i).alpha == pytest.approx(other.tas / situation.pursuer.tas)


def test_the_minimum_counts_where_height_does_not_keep_apart() -> None:
    situation = blocked(crossing(altitude=9_000.0), crossing("HIGH", altitude=10_000.0))
    level = Situation(
        pursuer=type(situation.pursuer)(
            x=0.0, y=-60e3, heading=0.0, tas=240.0, max_bank=0.4, altitude=9_000.0
        ),
        leader=situation.leader,
        slot_distance=12e3,
        min_separation=9_260.0,
        others=situation.others,
    )
    others = others_of(level, slot_frame(level, level.leader.trajectory))
    assert others.counted.tolist() == [[0.0, inf], [0.0, inf]]
    assert [counts_at(others, i, 1.0) for i in range(3)] == [True, True, False]
    frame = slot_frame(level, level.leader.trajectory)
    assert broken_by(Pose(frame.x, frame.y, 0.0), 0.0, 0.0, 4.0, others) == 1
