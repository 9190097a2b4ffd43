"""Through one contact with d = d_min: the paths to it, and the best one on from it.

Up to a contact and from it on, the path is an extremal without the limit: so it is fixed by the
contact, and that by one bearing and a side (see `contact`). Both halves come from the same
enumeration of words.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_exists, contact_on
from relguide.kernels.contact.paths_to_contact import not_before_slot, paths_to_contact
from relguide.kernels.separation.clearance import piece_clears
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_EARLY = 1e-9  # this much before it opens the slot counts as open [R/V_P], as in `solve`


class Workspace(NamedTuple):
    """Room for `through_contact`, and what it finds."""

    rows: FloatArray
    """Words to the contact. shape (MAX_ROWS, 5)"""
    onward: FloatArray
    """Words from there to the slot. shape (MAX_ROWS, 5)"""
    path: FloatArray
    """Takes the two rows of the path found. shape (2, 5)"""
    reached: FloatArray
    """Takes the earliest time at which the contact is reached with the limit kept, and a lower
    bound of the arrival from there; infinite if that is too late. shape (2,)"""


@njit(cache=True, nogil=True)
def workspace() -> Workspace:
    """Room, empty."""
    return Workspace(
        np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5)), np.empty((2, 5)), np.empty(2)
    )


@njit(cache=True, nogil=True)
def pieces_clear(
    pose: Pose, t: float, signs: FloatArray, amounts: FloatArray, scene: Scene
) -> bool:
    """Whether pieces at full bank or straight, flown from time t, keep d_min."""
    for k in range(len(signs)):
        sign, amount = signs[k], amounts[k]
        if amount > 0.0 and not piece_clears(pose, sign, t, amount, scene):
            return False
        pose = fly_piece(pose, sign, amount)
        t += amount
    return True


@njit(cache=True, nogil=True)
def word_clears(pose: Pose, t: float, row: FloatArray, scene: Scene) -> bool:
    """Whether a row of `solve`, flown from time t, keeps d_min."""
    return pieces_clear(pose, t, SIGNS[int(row[1])], row[2:5], scene)


@njit(cache=True, nogil=True)
def seen_from_slot(pose: Pose, t: float, alpha: float) -> Pose:
    """A pose at time t in the slot's own frame of that time, its heading in [0, 2π)."""
    return Pose(pose.x - alpha * t, pose.y, wrap(pose.h))


@njit(cache=True, nogil=True)
def first_clear(
    pose: Pose, t: float, rows: FloatArray, scene: Scene, beat: float
) -> tuple[float, int]:
    """The first of the rows of `solve`, flown from time t, that is not early and keeps d_min.

    Returns:
        arrival time and its number; infinite and −1 if none arrives before `beat`.
    """
    for k in range(len(rows)):
        arrival = t + rows[k, 0]
        if arrival >= beat:
            break
        if arrival >= scene.t_release - _EARLY and word_clears(pose, t, rows[k], scene):
            return arrival, k
    return inf, -1


@njit(cache=True, nogil=True)
def best_word(
    pose: Pose, t: float, scene: Scene, beat: float, rows: FloatArray
) -> tuple[float, int]:
    """The fastest extremal to the slot, from time t on, that keeps d_min: arrival and row number.

    Infinite and −1 if none arrives before `beat`.
    """
    left = max(scene.t_release - t, 0.0)
    n = solve(seen_from_slot(pose, t, scene.alpha), scene.alpha, left, rows)
    return first_clear(pose, t, rows[:n], scene, beat)


@njit(cache=True, nogil=True)
def through_contact(
    start: Pose, scene: Scene, contact: Contact, beat: float, room: Workspace
) -> float:
    """Arrival by the fastest path through one contact that keeps d_min, if it is before `beat`.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        contact: that it goes through.
        beat: arrivals from here on do not matter [R/V_P].
        room: to work in; takes the path, and when it is at the contact.

    Returns:
        arrival time; infinite if there is no contact, `beat` if no path arrives before.
    """
    reached, onward = room.reached, room.onward
    reached[:] = inf
    if not contact_exists(contact.bearing, scene.alpha):
        return inf
    n = paths_to_contact(start, 0.0, scene, contact, room.rows)
    m = -1
    for k in range(n):
        t = room.rows[k, 0]
        if t >= beat:
            continue
        there = contact_on(scene, contact, t)
        if not_before_slot(there, t, scene) >= beat:
            continue
        if m < 0 or contact.piece + 1 < len(scene.leader):
            # on the final leg the paths on are the same at any time
            m = solve(seen_from_slot(there, t, scene.alpha), scene.alpha, 0.0, onward)
        if m == 0:
            continue
        # the cheap test first: could it be in time at all? What is too early may be delayed
        lower = max(t + onward[0, 0], scene.t_release)
        if lower >= beat or not word_clears(start, 0.0, room.rows[k], scene):
            continue
        if t < reached[0]:
            reached[0], reached[1] = t, lower
        arrival, j = first_clear(there, t, onward[:m], scene, beat)
        if j >= 0:
            beat = arrival
            room.path[0] = room.rows[k]
            room.path[1] = onward[j]
    return beat
