"""What networks see of a situation: its slot frame, and whether the limit binds."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from benchmarks import draws
from relguide import Situation
from relguide.kernels.contact.constrained_rows import limit_binds
from relguide.kernels.networks.network_view import Where, view
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.branches import needs_mirror
from relguide.planning.slot import slot_frame
from tests.situations import situations


def view_of(situation: Situation, free: np.ndarray) -> tuple[bool, Where]:
    pursuer, leader, wind = situation.pursuer, situation.leader, situation.wind
    return view(
        pursuer.x, pursuer.y, pursuer.heading, pursuer.tas, pursuer.turn_radius,
        leader.x, leader.y, leader.heading, leader.tas,
        situation.slot_distance, situation.min_separation, wind.east, wind.north, free,
    )  # fmt: skip


@given(situations(with_intent=False, reach=60_000.0))
def test_it_is_the_slot_frame_and_the_limit_binds_where_it_does(situation: Situation) -> None:
    frame = slot_frame(situation, situation.leader.trajectory)
    free = np.empty(5)
    binds, (x, y, h, slot, alpha, limit) = view_of(situation, free)
    assert (x, y) == pytest.approx((frame.x, frame.y), rel=1e-9, abs=1e-9)
    assert (np.cos(h), np.sin(h)) == pytest.approx((np.cos(frame.h), np.sin(frame.h)), abs=1e-9)
    along, aside = frame.to_slot(situation.leader.x, situation.leader.y)
    assert (slot, alpha) == pytest.approx((along, frame.alpha), rel=1e-9, abs=1e-9)
    assert limit == situation.min_separation / situation.pursuer.turn_radius
    if abs(aside) > 1e-8:
        assert not binds
        return
    if needs_mirror(y, h):
        y, h = -y, 2.0 * np.pi - h if h > 0.0 else 0.0
    # a limit a little off decides otherwise only where the way grazes it
    near = [limit_binds(x, y, h, alpha, slot, limit - SLACK + off) for off in (-1e-7, 1e-7)]
    # in so light a cross wind the slot may count as aside already
    assert binds in near or (abs(aside) > 5e-10 and not binds)


def test_mirror_images_are_looked_at_from_one_side() -> None:
    rng = np.random.default_rng(2)
    bound = 0
    for k in range(60):
        situation = draws.near(rng, tight=bool(k % 2))
        pursuer, leader = situation.pursuer, situation.leader
        image = replace(
            situation,
            pursuer=replace(pursuer, x=-pursuer.x, heading=-pursuer.heading),
            leader=replace(leader, x=-leader.x, heading=-leader.heading),
        )
        free, other = np.empty(5), np.empty(5)
        binds, (x, y, *_) = view_of(situation, free)
        there, (along, left, *_) = view_of(image, other)
        assert there == binds
        assert (along, left) == pytest.approx((x, -y), abs=1e-9)
        assert other == pytest.approx(free, rel=1e-6, abs=1e-6)
        bound += binds
    assert 5 < bound < 60
