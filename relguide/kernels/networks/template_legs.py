"""Constrained paths of a template as legs, and whether they keep the limit.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, sin

from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, WORD
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.contact.touch_points import slide_between
from relguide.kernels.networks.near_guess import (
    ON_B,
    ON_B_TOUCH,
    ON_TOUCH_B,
    Room,
    Task,
    slot_of,
)
from relguide.kernels.words.extremals import SIGNS, fly_piece


@njit(cache=True, nogil=True)
def write_legs(task: Task, bearing: float, room: Room, legs: FloatArray) -> int:
    """Write a path down as legs.

    Args:
        task: its template.
        bearing: of the contact, where a boundary arc begins there [rad].
        room: holds the path.
        legs: takes them, as `chain.Chain`. shape (≥ 3, 6)

    Returns:
        how many.
    """
    side, link = task.disc.side, room.link
    legs[0, 0] = WORD
    legs[0, 1:6] = room.path[0]
    count = 1
    if task.on == ON_TOUCH_B:
        legs[1, 0] = WORD
        turn_straight(side, link[1], link[2], legs[1, 1:6])
        legs[2, 0], legs[2, 1], legs[2, 2], legs[2, 3] = BOUNDARY_ARC, side, link[0], link[3]
        count = 3
    elif task.on == ON_B or task.on == ON_B_TOUCH:
        legs[1, 0], legs[1, 1], legs[1, 2], legs[1, 3] = BOUNDARY_ARC, side, bearing, link[3]
        count = 2
        if task.on == ON_B_TOUCH:
            legs[2, 0] = WORD
            straight_turn(side, link[2], link[1], legs[2, 1:6])
            count = 3
    legs[count, 0] = WORD
    legs[count, 1:6] = room.path[1]
    return count + 1


@njit(cache=True, nogil=True)
def clears(task: Task, legs: FloatArray) -> bool:
    """Whether the words of a path keep the limit; boundary arcs do. legs: shape (n, 6)."""
    disc, pose, t = task.disc, task.start, 0.0
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            bearing = legs[k, 3]
            _, took = slide_between(legs[k, 2], bearing, disc)
            t += took
            pose = Pose(
                slot_of(task.scene) + disc.alpha * t + disc.distance * cos(bearing),
                disc.distance * sin(bearing),
                contact_heading(bearing, disc.side, disc.alpha),
            )
            continue
        row = legs[k, 1:6]
        if not word_clears(pose, t, row, task.scene):
            return False
        for piece in range(3):
            pose = fly_piece(pose, SIGNS[int(row[1]), piece], row[2 + piece])
            t += row[2 + piece]
    return True


@njit(cache=True, nogil=True)
def turn_straight(side: float, turn: float, straight: float, row: FloatArray) -> None:
    """A turn and a straight as a row; the turn is to this side."""
    row[0], row[1] = turn + straight, 0.0 if side > 0.0 else 1.0
    row[2], row[3], row[4] = turn, straight, 0.0


@njit(cache=True, nogil=True)
def straight_turn(side: float, straight: float, turn: float, row: FloatArray) -> None:
    """A straight and a turn as a row; the turn is to this side."""
    row[0], row[1] = straight + turn, 0.0 if side > 0.0 else 1.0
    row[2], row[3], row[4] = 0.0, straight, turn


@njit(cache=True, nogil=True)
def two_turns(sign: float, first: float, middle: float, last: float, row: FloatArray) -> None:
    """Two of the three turns of a word as a row; the first one of the three has this sign."""
    row[0] = first + middle + last
    row[1] = 4.0 if sign > 0.0 else 5.0
    row[2], row[3], row[4] = first, middle, last
