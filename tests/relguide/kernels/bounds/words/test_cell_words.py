"""Whether a path may be at a contact just when it is there: against paths flown at random."""

from math import cos, pi, sin

import numpy as np

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.cell_words import can_be_there, can_go_on_to
from relguide.kernels.bounds.words.cells import Cell, poses_of
from relguide.kernels.bounds.words.sets import EDGE
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import fly_piece
from tests.relguide.kernels.bounds.words.test_after_spare import in_cells

HANDOVER = 50.0
"""When the leader changes from the way that touches first to the other one [R/V_P]."""


def flown_at_random(rng: np.random.Generator, pose: Pose, lasts: float) -> Pose:
    """Where a path is after turns of any rate, no tighter than R, for so long.

    Those of one or two parts are often as tight as can be: then no path is a little longer.
    """
    parts = rng.uniform(0.0, 1.0, int(rng.integers(1, 5)))
    for part in parts / parts.sum() * lasts:
        turned = float(rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)))) * float(part)
        for _ in range(50):
            # chords of a turn that is hardly one
            pose = fly_piece(pose, 1.0 if turned > 0.0 else -1.0, abs(turned) / 50.0)
            pose = fly_piece(pose, 0.0, (float(part) - abs(turned)) / 50.0)
    return pose


def touched_by(
    pose: Pose, t: float, contact: Contact, alpha: float, d_min: float, rate: float
) -> FloatArray:
    """A leader's piece from t = 0 on a pose touches which at that time."""
    h = pose.h - contact_heading(contact.bearing, contact.side, alpha)
    at = h + contact.bearing
    piece = np.array([[t, pose.x - d_min * cos(at), pose.y - d_min * sin(at), h, rate]])
    begun = leader_at(Scene(piece, alpha, d_min, 0.0), 0, 0.0)
    return np.array([0.0, begun.x, begun.y, begun.h, rate])


def test_a_contact_that_a_path_goes_on_to_is_never_ruled_out() -> None:
    """From the start and from another contact, in cells of many sizes."""
    rng, out = np.random.default_rng(31), 0
    for _ in range(1_000):
        alpha, d_min = rng.uniform(0.3, 0.95), rng.uniform(0.3, 3.0)
        start, t = Pose(*rng.uniform(-1.0, 1.0, 3)), rng.uniform(0.3, 3.0)
        took = rng.uniform(0.1, 5.0)
        first = flown_at_random(rng, start, t)
        other = flown_at_random(rng, first, took)
        contacts = [Contact(i, rng.uniform(-pi, pi), rng.choice((-1.0, 1.0))) for i in range(2)]
        rates = rng.uniform(-2.0, 2.0, 2)
        leader = np.array(
            [
                touched_by(first, t, contacts[0], alpha, d_min, rates[0]),
                touched_by(other, t + took, contacts[1], alpha, d_min, rates[1]),
                [HANDOVER, 0.0, 0.0, 0.0, 0.0],
            ]
        )
        scene = Scene(leader, alpha, d_min, 0.0)
        cells = zip(
            in_cells(rng, contacts[0], t, 0.0, HANDOVER),
            in_cells(rng, contacts[1], t + took, 0.0, HANDOVER),
            strict=True,
        )
        for cell, there in cells:
            begin = poses_of(scene, cell)
            assert can_be_there(start, scene, begin, cell.end + EDGE)
            assert can_go_on_to(scene, begin, there)
            later = 0.5 + there.half
            early = Cell(
                1, there.side, there.bearing, there.half, there.start - later, there.end - later
            )
            out += not can_go_on_to(scene, begin, early)
    assert out > 1_000


def test_who_turns_all_the_time_cannot_come_a_little_later() -> None:
    """A turn of 2 rad is the shortest way to its end, and no path is a little longer."""
    start, longest = Pose(0.0, 0.0, 0.0), 2.0
    for late in (0.01, 0.1, 0.5):
        end, t = fly_piece(start, 1.0, longest), longest + late
        contact = Contact(0, 0.5, 1.0)
        leader = np.array([touched_by(end, t, contact, 0.5, 1.0, 0.0), [HANDOVER, 0, 0, 0, 0]])
        scene = Scene(leader, 0.5, 1.0, 0.0)
        cell = Cell(0, 1.0, 0.5, 1e-6, t - 1e-6, t + 1e-6)
        assert not can_be_there(start, scene, poses_of(scene, cell), cell.end + EDGE)
    # but one with a whole round in it is
    t = longest + 2.0 * pi
    leader = np.array([touched_by(end, t, contact, 0.5, 1.0, 0.0), [HANDOVER, 0, 0, 0, 0]])
    scene = Scene(leader, 0.5, 1.0, 0.0)
    cell = Cell(0, 1.0, 0.5, 1e-6, t - 1e-6, t + 1e-6)
    assert can_be_there(start, scene, poses_of(scene, cell), cell.end + EDGE)
