"""Contacts of d = d_min behind a leader that keeps straight, and words between them."""

from collections.abc import Iterator
from math import atan2, cos, hypot, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.hops.hop import standing
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.contact.contact import contact_heading, to_frame_of
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve_toward
from tests.costates import with_costate


def straight(alpha: float, d_min: float) -> Scene:
    """A leader that begins at the origin and keeps straight along the x axis."""
    return Scene(np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]), alpha, d_min, 0.0)


def pose_at(scene: Scene, bearing: float, side: float) -> Pose:
    """A contact at t = 0."""
    heading = contact_heading(bearing, side, scene.alpha)
    return Pose(scene.d_min * cos(bearing), scene.d_min * sin(bearing), heading)


def words_between(scene: Scene, begin: Pose, end: Pose) -> FloatArray:
    """Words that some costate fits, from a contact to another one, which moves with the leader."""
    rows, seen = np.empty((MAX_ROWS, 5)), to_frame_of(begin, end)
    toward = Velocity(scene.alpha * cos(end.h), -scene.alpha * sin(end.h))
    n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), toward, 0.0, rows)
    return with_costate(rows[:n])


@njit(nogil=True)
def unrolled(pose: Pose, row: FloatArray, alpha: float, d_min: float) -> float:
    """How far a word goes round the leader, counter-clockwise; NaN if it does not keep d_min."""
    t, went, before = 0.0, 0.0, atan2(pose.y, pose.x)
    for k in range(3):
        sign, amount = SIGNS[int(row[1]), k], row[2 + k]
        for i in range(1, 201):
            along = amount * i / 200
            at = fly_piece(pose, sign, along)
            x = at.x - alpha * (t + along)
            if hypot(x, at.y) < d_min - 1e-9:
                return np.nan
            bearing = atan2(at.y, x)
            went += wrap(bearing - before + pi) - pi
            before = bearing
        pose = fly_piece(pose, sign, amount)
        t += amount
    return went


def scenes(seed: int, tight: bool) -> Iterator[tuple[Scene, np.random.Generator]]:
    """Leaders whom a pursuer can slide round, nearly everywhere or everywhere."""
    rng = np.random.default_rng(seed)
    while True:
        alpha = rng.uniform(0.3, 0.97)
        steepest = (1.0 + alpha) ** 2
        d_min = rng.uniform(1.02, 0.98 * steepest) if tight else steepest * rng.uniform(1.0, 1.4)
        yield straight(alpha, d_min), rng


def some_cell(bearing: float, side: float, rng: np.random.Generator) -> Cell:
    """A cell that holds a contact, within its quadrant."""
    half = 10.0 ** rng.uniform(-6.0, -2.0)
    low = np.floor(bearing / (0.5 * pi)) * 0.5 * pi
    middle = min(max(bearing + half * rng.uniform(-1.0, 1.0), low + half), low + 0.5 * pi - half)
    return standing(0, side, middle, half)
