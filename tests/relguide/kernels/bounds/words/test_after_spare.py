"""What follows a contact that is come to with time to spare: against paths flown step by step."""

from math import acos, cos, hypot, inf, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.after_spare import after_spare, before_touching, falling_for
from relguide.kernels.bounds.words.cells import Cell, poses_of
from relguide.kernels.bounds.words.contact_bound import spare_bound
from relguide.kernels.bounds.words.found_word import all_open
from relguide.kernels.bounds.words.junction import can_touch
from relguide.kernels.bounds.words.sets import Goal
from relguide.kernels.contact.contact import contact_heading, contact_on
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece, solve
from tests.relguide.kernels.bounds.words.test_junction import turning_scene

NOWHERE = Goal(1e6, 0.5, False)
SLOT = Goal(2.0, 0.5, False)
LEFT, STEP = 5.0, 2e-3


def drawn_scene(rng: np.random.Generator) -> Scene:
    """A leader that turns from t = 1 to 6."""
    alpha, d_min, rate = rng.uniform(0.3, 0.95), rng.uniform(0.3, 3.0), rng.uniform(-2.0, 2.0)
    return turning_scene(rate, alpha, d_min)


def poses_after(scene: Scene, contact: Contact, t: float, times: FloatArray) -> list[Pose]:
    """Where a path is whose turns change as it meets the line from the leader to the contact."""
    turn = 2.0 * acos(scene.alpha * cos(contact.bearing))
    pose, begun, sense, poses = contact_on(scene, contact, t), 0.0, -contact.side, []
    for took in times:
        while took >= begun + turn:
            pose, begun, sense = fly_piece(pose, sense, turn), begun + turn, -sense
        poses.append(fly_piece(pose, sense, float(took) - begun))
    return poses


def gaps_after(scene: Scene, contact: Contact, t: float, times: FloatArray) -> FloatArray:
    """Separation less d_min along it."""
    gaps = []
    for took, at in zip(times, poses_after(scene, contact, t, times), strict=True):
        there = leader_at(scene, piece_at(scene.leader, t + took), t + took)
        gaps.append(hypot(at.x - there.x, at.y - there.y) - scene.d_min)
    return np.array(gaps)


def in_cells(
    rng: np.random.Generator, contact: Contact, t: float, begun: float = 1.0, ends: float = 6.0
) -> list[Cell]:
    """Cells of many sizes that hold a contact somewhere, none in two quadrants."""
    cells = []
    for parts in (8, 32, 512, 8192, 2**18):
        width = 0.5 * pi / parts
        middle = (np.floor(contact.bearing / width) + 0.5) * width
        span = rng.uniform(0.05, 3.0) * width
        start = max(t - rng.uniform(0.0, 1.0) * span, begun)
        end = min(start + span, ends)
        cells.append(Cell(contact.piece, contact.side, middle, 0.5 * width, start, end))
    return cells


def test_the_line_from_the_leader_to_the_contact_is_where_it_turns_the_other_way() -> None:
    """λ_ψ is zero there, and λ_p points along the line: see the costate of a path without it."""
    rng = np.random.default_rng(4)
    for _ in range(20):
        scene = drawn_scene(rng)
        contact, t = Contact(1, rng.uniform(-pi, pi), rng.choice((-1.0, 1.0))), 2.0
        turn = 2.0 * acos(scene.alpha * cos(contact.bearing))
        at, there = contact_on(scene, contact, t), leader_at(scene, 1, t)
        on = poses_after(scene, contact, t, np.array([turn, 2.0 * turn]))
        for pose in on:
            across = (pose.x - at.x) * (at.y - there.y) - (pose.y - at.y) * (at.x - there.x)
            assert across == pytest.approx(0.0, abs=1e-9)


def breaks_at(scene: Scene, contact: Contact, t: float, step: float) -> float:
    """When it breaks the limit first; infinite if it does not."""
    times = np.arange(step, LEFT, step)
    below = np.flatnonzero(gaps_after(scene, contact, t, times) < 0.0)
    return float(times[below[0]]) if len(below) > 0 else inf


def test_a_path_that_touches_again_is_never_ruled_out() -> None:
    """Between one that breaks the limit and one that does not lies one that touches."""
    rng, found, closely = np.random.default_rng(5), 0, 0
    for k in range(200):
        scene, side = drawn_scene(rng), rng.choice((-1.0, 1.0))
        # also from just before the leader begins to turn
        piece, t = (
            (1, rng.uniform(1.2, 5.0)) if k % 2 == 0 else (0, 1.0 - 10.0 ** rng.uniform(-3, -0.5))
        )
        begun, ends = (1.0, 6.0) if piece == 1 else (0.0, 1.0)
        last, before = 0.0, -4.0
        for bearing in np.arange(-pi, pi, 0.1):
            contact = Contact(piece, float(bearing), side)
            when = 0.0
            if can_touch(scene, Cell(piece, side, contact.bearing, 1e-9, t, t)):
                when = breaks_at(scene, contact, t, 0.02)
            if min(last, when) > 0.2 and (last == inf) != (when == inf):
                clear, broken = (before, bearing) if last == inf else (bearing, before)
                for _ in range(20):
                    middle = 0.5 * (clear + broken)
                    if breaks_at(scene, Contact(piece, middle, side), t, 0.01) == inf:
                        clear = middle
                    else:
                        broken = middle
                again = breaks_at(scene, Contact(piece, broken, side), t, 0.01)
                if 0.2 < again < LEFT - 0.1:
                    found += 1
                    for cell in in_cells(rng, Contact(piece, broken, side), t, begun, ends):
                        onward = after_spare(scene, NOWHERE, cell, LEFT)
                        assert onward.contact <= again + 0.02
                        on = soonest_on(scene, Contact(piece, broken, side), t, again)
                        late = after_spare(scene, SLOT._replace(speed=scene.alpha), cell, 50.0)
                        assert late.again <= again + on + 0.05 or again + on > 49.0
                        closely += again + on - 0.1 < late.again < inf
            last, before = when, float(bearing)
    assert found > 20
    assert closely > found


def soonest_on(scene: Scene, contact: Contact, t: float, took: float) -> float:
    """How soon a word leads on to the slot from where such a path is then."""
    (at,) = poses_after(scene, contact, t, np.array([took]))
    seen = Pose(at.x - SLOT.x - scene.alpha * (t + took), at.y, at.h % (2.0 * pi))
    rows = np.empty((MAX_ROWS, 5))
    assert solve(seen, scene.alpha, 0.0, rows) > 0
    return float(rows[0, 0])


def test_most_contacts_are_ruled_out() -> None:
    """Since the path from there does not touch again."""
    rng, out = np.random.default_rng(9), 0
    for _ in range(300):
        scene, contact = drawn_scene(rng), Contact(1, rng.uniform(-pi, pi), 1.0)
        cell = in_cells(rng, contact, rng.uniform(1.2, 5.0))[2]
        out += after_spare(scene, NOWHERE, cell, 3.0) == (inf, inf, inf)
    assert out > 250


def test_a_path_that_arrives_is_never_ruled_out() -> None:
    rng, found, late = np.random.default_rng(6), 0, 0
    for _ in range(150):
        scene, side = drawn_scene(rng), rng.choice((-1.0, 1.0))
        contact, t = Contact(1, rng.uniform(-pi, pi), side), rng.uniform(1.2, 5.0)
        times = np.arange(STEP, LEFT, STEP)
        if np.min(gaps_after(scene, contact, t, times)) < 0.0:
            continue
        headings = [wrap_signed(pose.h) for pose in poses_after(scene, contact, t, times)]
        level = [
            k for k in range(len(times) - 1)
            if headings[k] * headings[k + 1] <= 0.0 and abs(headings[k]) < 0.1
        ]  # fmt: skip
        for k in level:
            took = float(times[k]) + STEP * abs(headings[k]) / abs(headings[k] - headings[k + 1])
            (at,) = poses_after(scene, contact, t, np.array([took]))
            moved = scene.leader.copy()
            moved[:, 2] -= at.y
            speed = rng.choice((scene.alpha, 1.0))
            goal = Goal(at.x - speed * (t + took), speed, False)
            there = Scene(moved, scene.alpha, scene.d_min, 0.0)
            for cell in in_cells(rng, contact, t):
                assert after_spare(there, goal, cell, LEFT).goal <= took + 1e-6
            elsewhere = Goal(goal.x + 0.1, speed, False)
            late += after_spare(there, elsewhere, in_cells(rng, contact, t)[3], LEFT).goal == inf
            found += 1
    assert found > 100
    assert late > 0.9 * found


def test_a_contact_that_some_path_is_at_is_never_ruled_out() -> None:
    """Not even where that is hardly so."""
    rng, out = np.random.default_rng(7), 0
    for _ in range(2_000):
        alpha, d_min, rate = rng.uniform(0.3, 0.95), rng.uniform(0.3, 3.0), rng.uniform(-2.0, 2.0)
        start, t = Pose(*rng.uniform(-1.0, 1.0, 3)), rng.uniform(0.3, 6.0)
        # two turns of less than half a round with a straight between them: no pose is sooner there
        pose, first, last = start, *rng.uniform(0.0, min(pi, 0.5 * t), 2)
        for sense, took in ((1, first), (0, t - first - last), (1, last)):
            pose = fly_piece(pose, float(sense * rng.choice((-1, 1))), float(took))
        side, bearing = rng.choice((-1.0, 1.0)), rng.uniform(-pi, pi)
        # a leader that is where this pose touches
        h = pose.h - contact_heading(bearing, side, alpha)
        x, y = pose.x - d_min * cos(h + bearing), pose.y - d_min * sin(h + bearing)
        leader = np.array([[t, x, y, h, rate], [50.0, 0.0, 0.0, 0.0, 0.0]])
        begun = leader_at(Scene(leader, alpha, d_min, 0.0), 0, 0.0)
        leader[0] = 0.0, begun.x, begun.y, begun.h, rate
        scene, goal = Scene(leader, alpha, d_min, 0.0), Goal(0.0, alpha, False)
        for cell in in_cells(rng, Contact(0, bearing, side), t, 0.0, 50.0):
            if not can_touch(scene, cell):
                continue
            soon, onward = spare_bound(start, scene, goal, cell, 1e3, all_open())
            assert onward < inf
            assert soon <= t + 1e-6
            # nobody is there so much sooner
            nobody = Cell(0, side, cell.bearing, cell.half, 0.0, 0.01)
            out += spare_bound(start, scene, goal, nobody, 1e3, all_open())[0] == inf
    assert out > 2_000


def test_the_separation_surely_falls_ever_faster_where_it_is_said_to() -> None:
    """Of all paths of a cell, as long as they turn away: against second differences."""
    rng, found, step = np.random.default_rng(12), 0, 1e-4
    for k in range(3_000):
        scene, side = drawn_scene(rng), rng.choice((-1.0, 1.0))
        bearing, t = rng.uniform(-pi, pi), rng.uniform(1.2, 5.0)
        begun, ends = 1.0, 6.0
        if k % 3 == 0:
            # the leader begins to turn just after it
            t, begun, ends = 1.0 - 10.0 ** rng.uniform(-4, -1), 0.0, 1.0
        elif k % 3 == 1:
            t = rng.uniform(5.0, 5.9)
        piece = int(begun)
        for cell in in_cells(rng, Contact(piece, bearing, side), t, begun, ends):
            poses, took = poses_of(scene, cell), 10.0 ** rng.uniform(-3, 0)
            if k % 3 == 1:
                # or ends its turn just after that
                took = (6.0 - poses.t) * (1.0 - 10.0 ** rng.uniform(-5, -2))
            turn = 2.0 * acos(scene.alpha * cos(bearing))
            bends = second_difference(
                scene, Contact(piece, cell.bearing, side), poses.t, took, step
            )
            falls = falling_for(scene, cell, poses.span, took, bends)
            if falls <= 2.0 * step or took + falls > 0.9 * turn:
                continue
            found += 1
            for _ in range(3):
                member = cell.bearing + rng.choice((-1.0, 1.0)) * cell.half
                when = rng.choice((cell.start, cell.end))
                later = took + rng.uniform(0.0, 1.0) ** 8 * (falls - 2.0 * step)
                contact = Contact(piece, member, side)
                assert second_difference(scene, contact, when, later + step, step) <= 1e-4
    assert found > 100


def second_difference(scene: Scene, contact: Contact, t: float, took: float, step: float) -> float:
    """d″ of such a path so long after its contact."""
    times = np.array([took - step, took, took + step])
    before, here, after = gaps_after(scene, contact, t, times)
    return float((before - 2.0 * here + after) / step**2)


def test_where_paths_of_a_cell_are_before_they_touch_again() -> None:
    """Each path's circles lie beside those of the middle's, as far as they may."""
    rng, turned, closely = np.random.default_rng(11), 0, 0
    for _ in range(400):
        scene, side = drawn_scene(rng), rng.choice((-1.0, 1.0))
        contact, t = Contact(1, rng.uniform(-pi, pi), side), rng.uniform(1.2, 5.0)
        if abs(scene.alpha * cos(contact.bearing)) > 0.9:
            continue
        for cell in in_cells(rng, contact, t):
            begin, touching = poses_of(scene, cell), rng.uniform(0.0, 6.0)
            there, until = before_touching(scene, cell, touching)
            assert 0.0 <= until <= touching
            bearing = cell.bearing + rng.uniform(-1.0, 1.0) * cell.half
            when = rng.uniform(cell.start, cell.end)
            (at,) = poses_after(scene, Contact(1, bearing, side), when, np.array([until]))
            later = when - begin.t
            moved = Pose(at.x - later * begin.vx, at.y - later * begin.vy, at.h)
            assert abs(wrap_signed(moved.h - there.middle.h)) <= there.differs + 1e-9
            for sense, blur in ((1.0, there.left), (-1.0, there.right)):
                assert centres_apart(moved, there.middle, sense) <= blur + 1e-9
            turned += until > 2.0 * acos(scene.alpha * cos(contact.bearing))
            closely += touching - until < 0.1
    assert turned > 100
    assert closely > 600


def centres_apart(pose: Pose, other: Pose, sense: float) -> float:
    """How far the centres of two turns lie from each other."""
    x, y = pose.x - other.x, pose.y - other.y
    return hypot(x - sense * (sin(pose.h) - sin(other.h)), y + sense * (cos(pose.h) - cos(other.h)))


def test_nothing_is_said_of_leaders_as_fast_as_the_pursuer() -> None:
    """There γ may change without bound, and not every bearing can be touched."""
    rng = np.random.default_rng(10)
    for alpha in (1.0, 1.2):
        scene = drawn_scene(rng)._replace(alpha=alpha)
        for bearing in (2.0, 3.1):
            cell = in_cells(rng, Contact(1, bearing, 1.0), 2.0)[2]
            assert after_spare(scene, NOWHERE, cell, 3.0) == (0.0, 0.0, 0.0)
