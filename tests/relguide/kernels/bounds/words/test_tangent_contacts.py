"""Where λ_ψ vanishes at a first contact: against paths put beside a leader so that they touch."""

from math import cos, inf, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.tangent_contacts import (
    anything_tangent,
    may_be_tangent,
    tangent_contacts,
)
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import fly_piece

STRAIGHT, TURN, AS_LONG = 0, 1, 2


def path_that_ends_so(rng: np.random.Generator, start: Pose, end: int) -> tuple[Pose, float]:
    """Where a path ends that is at a switch there, and when."""
    sense, first, then = float(rng.choice((-1, 1))), *rng.uniform(0.0, 3.0, 2)
    pose = fly_piece(start, sense, float(first))
    if end == STRAIGHT:
        return fly_piece(pose, 0.0, float(then)), float(first + then)
    pose = fly_piece(pose, -sense, float(then))
    if end == TURN:
        return pose, float(first + then)
    return fly_piece(pose, sense, float(then)), float(first + 2.0 * then)


def scene_touched(
    rng: np.random.Generator, pose: Pose, t: float, bearing: float, side: float
) -> Scene:
    """A leader that this pose touches at a time, in a turn that begins before and ends after it."""
    alpha, d_min, rate = rng.uniform(0.3, 0.95), rng.uniform(0.3, 3.0), rng.uniform(-2.0, 2.0)
    h = pose.h - contact_heading(bearing, side, alpha)
    x, y = pose.x - d_min * cos(h + bearing), pose.y - d_min * sin(h + bearing)
    begun, ends = t * rng.uniform(0.0, 1.0), t + rng.uniform(0.1, 2.0)
    turning = Scene(np.array([[t, x, y, h, rate]]), alpha, d_min, 0.0)
    at, then = leader_at(turning, 0, begun), leader_at(turning, 0, ends)
    straight = Scene(np.array([[begun, *at, 0.0]]), alpha, d_min, 0.0)
    leader = [(0.0, *leader_at(straight, 0, 0.0), 0.0), (begun, *at, rate), (ends, *then, 0.0)]
    return Scene(np.array(leader), alpha, d_min, 0.0)


def tiny(scene: Scene, t: float, bearing: float, side: float) -> Cell:
    piece = int(np.searchsorted(scene.leader[:, 0], t, side="right")) - 1
    return Cell(piece, side, bearing, 1e-12, t, t)


@pytest.mark.parametrize("end", [STRAIGHT, TURN, AS_LONG])
def test_a_contact_at_a_switch_is_never_missed(end: int) -> None:
    rng, rows_of = np.random.default_rng(end), []
    for _ in range(60):
        start = Pose(*rng.uniform(-3.0, 3.0, 3))
        pose, t = path_that_ends_so(rng, start, end)
        bearing, side = rng.uniform(-pi, pi), float(rng.choice((-1, 1)))
        scene = scene_touched(rng, pose, t, bearing, side)
        rows = tangent_contacts(start, scene, t + rng.uniform(1e-3, 1.0))
        for turns in (-1.0, 0.0, 1.0):
            cell = tiny(scene, t, bearing + 2.0 * pi * turns, side)
            assert may_be_tangent(rows, cell)
        rows_of.append(rows)
    known = [rows for rows in rows_of if not is_unknown(rows)]
    assert len(known) > 0.9 * len(rows_of)
    # a few points, far apart
    assert np.mean([len(rows) for rows in known]) < 20.0
    widths = np.concatenate([rows[:, 2] for rows in known])
    assert np.median(widths) < 1e-5


def is_unknown(rows: FloatArray) -> bool:
    return bool(len(rows) == 1 and rows[0, 2] == inf)


def test_most_contacts_are_none_of_them() -> None:
    rng, found, count = np.random.default_rng(7), 0, 0
    for _ in range(30):
        start = Pose(*rng.uniform(-3.0, 3.0, 3))
        pose, t = path_that_ends_so(rng, start, STRAIGHT)
        scene = scene_touched(rng, pose, t, rng.uniform(-pi, pi), 1.0)
        rows = tangent_contacts(start, scene, t + 1.0)
        if is_unknown(rows):
            continue
        for _ in range(50):
            side, bearing, at = float(rng.choice((-1, 1))), rng.uniform(-pi, pi), rng.uniform(0, t)
            found += may_be_tangent(rows, tiny(scene, at, bearing, side))
            count += 1
    assert count > 1_000
    assert found < 0.001 * count


def test_nothing_is_known_of_leaders_as_fast_as_the_pursuer_or_without_an_end() -> None:
    leader = np.array([[0.0, 3.0, 0.0, 0.0, 0.5], [2.0, 4.0, 1.0, 1.0, 0.0]])
    start = Pose(0.0, 0.0, 0.0)
    assert is_unknown(tangent_contacts(start, Scene(leader, 1.0, 1.0, 0.0), 5.0))
    assert is_unknown(tangent_contacts(start, Scene(leader, 0.8, 1.0, 0.0), inf))
    assert is_unknown(tangent_contacts(start, Scene(leader[:1], 0.8, 1.0, 0.0), 5.0))
    anywhere = Cell(0, 1.0, 2.0, 0.0, 1.0, 1.0)
    assert may_be_tangent(anything_tangent(), anywhere)
