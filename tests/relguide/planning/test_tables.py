"""All forms of one trajectory are of the same flight."""

import numpy as np
import pytest

from relguide import RIGHT, FlyStraight, Leader, Pursuer, Situation, TurnTo
from relguide.kernels.base.motion import advance, motion_along
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_path, motion_of, path_of, scene_of

SITUATION = Situation(
    pursuer=Pursuer(x=-30e3, y=12e3, heading=1.0, tas=240.0, max_bank=0.4),
    leader=Leader(
        x=2e3,
        y=-5e3,
        heading=0.5,
        tas=200.0,
        intent=(FlyStraight(duration=60.0), TurnTo(heading=2.0, turn=RIGHT, bank=0.3)),
    ),
    slot_distance=10e3,
    min_separation=9e3,
)
LEADER = SITUATION.leader.trajectory


def test_lengths_and_curvatures_are_durations_and_rates() -> None:
    along, motion = motion_along(path_of(LEADER)), motion_of(LEADER)
    assert along[:4] == motion[:4]
    assert along.pieces == pytest.approx(motion.pieces)
    assert np.count_nonzero(along.pieces[:, 1] > 0.0) == 1  # it turns right
    assert np.array_equal(leader_path(SITUATION), path_of(LEADER))


@pytest.mark.parametrize("t", [0.0, 30.0, 70.0, 500.0])
def test_each_leads_to_the_same_place(t: float) -> None:
    expected = LEADER.pose_at(t)
    motion, left = motion_of(LEADER), t
    x, y, heading = motion.x, motion.y, motion.heading
    for duration, rate in (*motion.pieces.tolist(), (t, 0.0)):
        x, y, heading = advance(x, y, heading, motion.tas, rate, min(left, duration))
        left -= min(left, duration)
    assert (x, y, heading) == pytest.approx((expected.x, expected.y, expected.heading))

    frame = slot_frame(SITUATION, LEADER)
    scene, tau = scene_of(SITUATION, frame), t * 240.0 / frame.radius
    seen = leader_at(scene, piece_at(scene.leader, tau), tau)
    assert seen[:2] == pytest.approx(frame.to_slot(expected.x, expected.y))
    assert seen.h == pytest.approx(frame.heading - expected.heading)


def test_a_leader_that_keeps_straight_has_no_pieces() -> None:
    straight = Situation(
        pursuer=SITUATION.pursuer,
        leader=Leader(x=0.0, y=0.0, heading=0.5, tas=200.0),
        slot_distance=10e3,
        min_separation=9e3,
    )
    scene = scene_of(straight, slot_frame(straight, straight.leader.trajectory))
    assert np.array_equal(leader_path(straight), path_of(straight.leader.trajectory))
    assert motion_of(straight.leader.trajectory).pieces.shape == (0, 2)
    assert scene.leader.shape == (1, 5)
    assert scene.t_release == 0.0
