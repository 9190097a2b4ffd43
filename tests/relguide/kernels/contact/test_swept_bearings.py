"""What can be reached round the leader by a time: wherever somebody flies who keeps d_min."""

from math import atan2, pi

import numpy as np
from hypothesis import assume, example, given
from hypothesis import strategies as st

from relguide.kernels.base.records import Scene
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.swept_bearings import MOST_SWEPT, may_be_swept, sweep_bearings
from relguide.kernels.separation.clearance import fly_rate, leader_at, piece_at, piece_clears
from tests.relguide.kernels.contact.test_paths_to_contact import turning_leader
from tests.situations import headings, numbers

rates = st.sampled_from([-1.0, -0.4, 0.0, 0.3, 1.0])


def bearing_from_leader(scene: Scene, x: float, y: float, t: float) -> float:
    """Of a place at a time, from the leader's heading."""
    lx, ly, lh = leader_at(scene, piece_at(scene.leader, t), t)
    return atan2(y - ly, x - lx) - lh


@given(
    bearing=headings, side=st.sampled_from([1.0, -1.0]), turning=numbers(-1.5, 1.5),
    begin=numbers(0.0, 3.0), alpha=numbers(0.3, 1.6), d_min=numbers(0.3, 3.0),
    turns=st.lists(st.tuples(rates, numbers(0.05, 1.5)), min_size=1, max_size=6),
)  # fmt: skip
@example(
    # behind a leader that is faster bearings may pass fastest far away
    bearing=2.077, side=1.0, turning=-1.3415, begin=0.397, alpha=1.5616, d_min=0.549,
    turns=[(-1.0, 2.309)],
)  # fmt: skip
def test_nobody_is_where_nobody_can_be(
    bearing: float, side: float, turning: float, begin: float, alpha: float, d_min: float,
    turns: list[tuple[float, float]],
) -> None:  # fmt: skip
    assume(contact_exists(bearing, alpha))
    scene = turning_leader(turning, 2, alpha=alpha, d_min=d_min)
    swept = np.empty((MOST_SWEPT, 2))
    swept = swept[: sweep_bearings(scene, begin, bearing, begin + 9.0, swept)]
    pose, t = contact_at(scene, begin, bearing, side), begin
    flown = False
    for rate, duration in turns:
        if not piece_clears(pose, rate, t, duration, scene):
            break
        for part in np.linspace(0.0, duration, 9):
            there = fly_rate(pose, rate, part)
            seen = bearing_from_leader(scene, there.x, there.y, t + part)
            assert may_be_swept(scene, swept, t + part - begin, seen)
        pose, t, flown = fly_rate(pose, rate, duration), t + duration, True
    assume(flown)


def test_what_lies_behind_the_leader_takes_as_long_as_half_a_round() -> None:
    # a leader that hardly moves, and d_min = R: half a round takes π R/V_P
    scene = turning_leader(0.0, 1, alpha=1e-3, d_min=1.0)
    swept = np.empty((MOST_SWEPT, 2))
    swept = swept[: sweep_bearings(scene, 0.0, 0.0, 9.0, swept)]
    assert not may_be_swept(scene, swept, pi - 0.1, pi)
    assert may_be_swept(scene, swept, pi + 0.1, pi)
    assert swept[-1, 1] - swept[-1, 0] >= 2.0 * pi
