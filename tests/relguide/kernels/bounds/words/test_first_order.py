"""How words change with the poses of a set, against exact ones from poses and to poses in it."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.bounds.words.breach import no_sieve
from relguide.kernels.bounds.words.cell_words import (
    blur_backward,
    blur_between,
    moved_with,
    seen_from_start,
    turned_away,
)
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.found_word import ByTurn, Junction, all_open
from relguide.kernels.bounds.words.sets import Blur, Change, unknown_sensitivity
from relguide.kernels.bounds.words.word_bound import soonest_by_turn
from relguide.kernels.contact.contact import contact_heading, to_frame_of
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece, solve_toward
from tests.costates import with_costate

ANYHOW = Junction(True, 0, 0.0, True, True, True)
"""No word is left out for how it begins."""
TURNING_UNTIL = 9.0
"""[R/V_P]."""
SLACK = 1e-7
"""[R/V_P]."""


def a_turning_leader(rng: np.random.Generator) -> Scene:
    leader = np.zeros((2, 5))
    leader[0, 1:] = *rng.uniform(-3.0, 3.0, 2), rng.uniform(-pi, pi), rng.uniform(-1.5, 1.5)
    scene = Scene(leader, rng.uniform(0.3, 0.99), rng.uniform(0.3, 4.0), 0.0)
    leader[1] = TURNING_UNTIL, *leader_at(scene, 0, TURNING_UNTIL), 0.0
    return scene


def a_cell(rng: np.random.Generator, size: float) -> Cell:
    """Contacts while it turns, in one quadrant."""
    half, start = size * rng.uniform(0.2, 1.0), rng.uniform(0.0, 6.0)
    bearing = 0.5 * pi * rng.integers(-2, 2) + rng.uniform(half, 0.5 * pi - half)
    end = start + size * rng.uniform(0.2, 4.0)
    return Cell(0, rng.choice((1.0, -1.0)), bearing, half, start, end)


def contact_of(scene: Scene, cell: Cell, bearing: float, time: float) -> tuple[Pose, float]:
    """The one this far from the middle of its bearings and times, ±1 at their ends; and when."""
    b = cell.bearing + bearing * cell.half
    t = 0.5 * (cell.start + cell.end) + 0.5 * time * (cell.end - cell.start)
    there = leader_at(scene, cell.piece, t)
    x = there.x + scene.d_min * cos(there.h + b)
    y = there.y + scene.d_min * sin(there.h + b)
    return Pose(x, y, there.h + contact_heading(b, cell.side, scene.alpha)), t


def any_of(scene: Scene, cell: Cell, rng: np.random.Generator) -> tuple[Pose, float]:
    return contact_of(scene, cell, *rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)), 2))


def words(begin: Pose, end: Pose) -> np.ndarray:
    """From one pose to another, that waits."""
    seen, rows = to_frame_of(begin, end), np.empty((MAX_ROWS, 5))
    n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), Velocity(0.0, 0.0), 0.0, rows)
    return with_costate(rows[:n])


def found(seen: Pose, blur: Blur, target: Velocity, window: Window) -> ByTurn:
    nobody = Scene(np.zeros((1, 5)), 0.5, 0.0, 0.0)
    return soonest_by_turn(seen, blur, target, window, no_sieve(nobody), ANYHOW, all_open(), True)


def without_sensitivity(blur: Blur) -> Blur:
    return blur._replace(sensitivity=unknown_sensitivity(), met=unknown_sensitivity())


@pytest.mark.parametrize("turn", [0.0, 0.8, -1.7])
def test_contacts_are_where_the_ways_lead_but_for_terms_of_second_order(turn: float) -> None:
    rng = np.random.default_rng(3)
    used = []
    for _ in range(4_000):
        scene, size = a_turning_leader(rng), 10.0 ** rng.uniform(-3.0, -0.7)
        cell = a_cell(rng, size)
        before = poses_of(scene, cell)
        poses = turned_away(before, cell.side, turn) if turn else before
        bearing, time = rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)), 2)
        at = fly_piece(contact_of(scene, cell, bearing, time)[0], -cell.side, turn)
        sensitivity, (x, y, h) = poses.sensitivity, poses.middle
        moved = Change(
            *(bearing * np.array(sensitivity.bearing) + time * np.array(sensitivity.time))
        )
        assert abs(wrap_signed(at.h - h - moved.h)) <= sensitivity.twists + 1e-12
        drift = time * poses.span
        for hand in (1.0, -1.0):
            centre = at.x - hand * sin(at.h), at.y + hand * cos(at.h)
            led_x = x + drift * poses.vx + moved.x - hand * (sin(h) + moved.h * cos(h))
            led_y = y + drift * poses.vy + moved.y + hand * (cos(h) - moved.h * sin(h))
            off = hypot(centre[0] - led_x, centre[1] - led_y)
            assert off <= sensitivity.bends + 1e-12
            used.append(off / sensitivity.bends)
    assert max(used) > 0.3


@pytest.mark.parametrize("seed", range(3))
def test_no_word_is_at_a_contact_sooner_or_later_than_is_said_of_its_cell(seed: int) -> None:
    rng = np.random.default_rng(seed)
    met, narrower = 0, []
    for _ in range(6_000):
        scene, size = a_turning_leader(rng), 10.0 ** rng.uniform(-4.0, -1.2)
        cell = a_cell(rng, size)
        at, t = any_of(scene, cell, rng)
        # a start from where some word takes as long as there is time
        back, amounts = Pose(at.x, at.y, at.h + pi), rng.uniform(0.0, 3.0, 3)
        amounts *= t / amounts.sum()
        signs = ((1, 0, 1), (1, 0, -1), (-1, 0, 1), (-1, 0, -1), (1, -1, 1), (-1, 1, -1))
        for sign, amount in zip(signs[rng.integers(6)], amounts, strict=True):
            back = fly_piece(back, sign, amount)
        start = Pose(back.x, back.y, (back.h - pi) % (2.0 * pi))
        if not any(abs(row[0] - t) < 1e-9 for row in words(start, at)):
            continue
        poses, window = poses_of(scene, cell), Window(cell.start - 1e-9, cell.end + 1e-9)
        seen, target = seen_from_start(start, poses)
        blur = blur_backward(start, poses)
        close = found(seen, blur, target, window)
        assert min(close.left, close.right) <= t + SLACK
        assert close.latest >= t - SLACK
        wide = found(seen, without_sensitivity(blur), target, window)
        narrower.append((close.latest - t) / max(wide.latest - t, SLACK))
        met += 1
    assert met > 1_000
    assert np.median(narrower) < 0.5


@pytest.mark.parametrize("seed", range(3))
def test_no_word_leads_from_cell_to_cell_sooner_or_later_than_is_said(seed: int) -> None:
    """Each beside a leader of its own."""
    rng = np.random.default_rng(seed)
    met, narrower = 0, []
    for _ in range(4_000):
        size = 10.0 ** rng.uniform(-4.0, -1.2)
        scene, other = a_turning_leader(rng), a_turning_leader(rng)
        cell, to = a_cell(rng, size), a_cell(rng, size)
        (begin, begun), (end, ended) = any_of(scene, cell, rng), any_of(other, to, rng)
        row = rng.choice(words(begin, end))
        # it begins when there is just so much time
        poses = poses_of(scene, cell)
        poses = poses._replace(t=poses.t + ended - row[0] - begun)
        there = moved_with(poses_of(other, to), poses, True)
        s, c = sin(there.middle.h), cos(there.middle.h)
        seen = to_frame_of(poses.middle, there.middle)
        target = Velocity(there.vx * c + there.vy * s, there.vy * c - there.vx * s)
        blur, window = blur_between(poses, there), Window(0.0, row[0] + 20.0 * size)
        close = found(seen, blur, target, window)
        assert min(close.left, close.right) <= row[0] + SLACK
        assert close.latest >= row[0] - SLACK
        wide = found(seen, without_sensitivity(blur), target, window)
        narrower.append(min(close.left, close.right) - min(wide.left, wide.right))
        met += 1
    assert met > 1_000
    assert np.mean(np.array(narrower) > 0.0) > 0.5


def test_a_turn_takes_ways_with_it() -> None:
    """Against turns of poses that differ by a little."""
    rng = np.random.default_rng(0)
    for _ in range(200):
        x, y, h = rng.uniform(-3.0, 3.0, 3)
        bearing, little = Change(*rng.normal(size=3)), 1e-6
        sensitivity = unknown_sensitivity()._replace(bearing=bearing, bends=0.0)
        poses = Poses(0.0, 0.0, Pose(x, y, h), 0.0, 0.0, 0.0, 0.0, 0.0, sensitivity)
        side, turn = rng.choice((1.0, -1.0)), rng.uniform(-3.0, 3.0)
        after = turned_away(poses, side, turn)
        moved = Pose(x + little * bearing.x, y + little * bearing.y, h + little * bearing.h)
        at = fly_piece(moved, -side, turn)
        led = (np.array(at) - np.array(after.middle)) / little
        np.testing.assert_allclose(after.sensitivity.bearing, led, atol=1e-4)
