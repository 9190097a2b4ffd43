"""A turn and a straight that touches d = d_min: how one best comes to a boundary arc.

Such a word leads to one bearing only: that at which its last turn ceases to exist. As a bearing is
moved it would have to be found at a cliff each time; here it is solved for. Unknown are bearing b
and time T of the contact. The straight begins where the turn ends on the contact's heading H:

    u(H) × (contact − turn's end) = 0,    u(H) · (contact − turn's end) = T − t − turn,

which Newton's method solves from a bearing nearby.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import ceil, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Contact, Pose, Scene, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.contact import contact_exists, contact_heading, contact_on
from relguide.kernels.contact.paths_to_contact import intercept
from relguide.kernels.separation.clearance import piece_end
from relguide.kernels.words.extremals import fly_piece

_STEP = 0.3  # from one look to the next, while the leader turns [R/V_P]
_MOST_STEPS = 20
_MET = 1e-12  # [R]
_CLOSE = 1e-7  # differences for the derivatives [rad, R/V_P]
_FARTHEST = 0.5  # step of the bearing [rad], and of the time [R/V_P]


@njit(cache=True, nogil=True)
def touch_straight(
    pose: Pose, t: float, scene: Scene, near: Contact, turn: float, row: FloatArray
) -> tuple[float, float]:
    """Turn and fly straight so that it touches the disc, on the leader's piece of a contact.

    Args:
        pose: where the turn begins.
        t: when [R/V_P].
        scene: the leader and d_min.
        near: a contact close to the one that is looked for.
        turn: +1 if it is to the left, −1 to the right.
        row: takes the word as `paths_to_contact` does. shape (5,)

    Returns:
        bearing [rad] and time [R/V_P] of the contact; an infinite time if none is found.
    """
    leader, i = scene.leader, near.piece
    begin, end = max(t, leader[i, 0]), piece_end(leader, i)
    if end <= begin:
        return near.bearing, inf
    if leader[i, 4] == 0.0:
        turned, _, _ = _turn_and_gap(pose, scene, near, turn, t)
        begun = t + turned
        _, ahead, left = _turn_and_gap(pose, scene, near, turn, begun)
        off = contact_heading(near.bearing, near.side, scene.alpha)
        s, c = sine_and_cosine(off)
        there = Velocity(scene.alpha * c, -scene.alpha * s)
        time = begun + intercept(ahead, left, there)
        return _solve_near(pose, t, scene, near, turn, time, row)
    # while the leader turns there may be several times at which it is as far as can be flown
    steps, last = ceil((end - begin) / _STEP), np.nan
    bearing, arrival = near.bearing, inf
    for k in range(steps + 1):
        time = begin + (end - begin) * k / steps
        turned, ahead, left = _turn_and_gap(pose, scene, near, turn, time)
        late = turned + norm(ahead, left) - (time - t)
        if late * last <= 0.0 and late != last:
            guess = time - (end - begin) / steps * late / (late - last)
            at, then = _solve_near(pose, t, scene, near, turn, guess, row)
            if then < inf and (
                arrival == inf or abs(at - near.bearing) < abs(bearing - near.bearing)
            ):
                bearing, arrival = at, then
        last = late
    if arrival < inf:
        _solve_near(pose, t, scene, _moved(near, bearing), turn, arrival, row)
    return bearing, arrival


@njit(cache=True, nogil=True)
def _solve_near(
    pose: Pose, t: float, scene: Scene, near: Contact, turn: float, time: float, row: FloatArray
) -> tuple[float, float]:
    """As `touch_straight`, from a guess of the time too."""
    bearing, solved = near.bearing, False
    for _ in range(_MOST_STEPS):
        if not contact_exists(bearing, scene.alpha):
            return bearing, inf
        beside, over = _misses(pose, t, scene, _moved(near, bearing), turn, time)
        if abs(beside) < _MET and abs(over) < _MET:
            solved = True
            break
        b1, o1 = _misses(pose, t, scene, _moved(near, bearing + _CLOSE), turn, time)
        b2, o2 = _misses(pose, t, scene, _moved(near, bearing), turn, time + _CLOSE)
        b1, o1, b2, o2 = b1 - beside, o1 - over, b2 - beside, o2 - over
        area = b1 * o2 - b2 * o1
        if area == 0.0:
            return bearing, inf
        by = -(beside * o2 - b2 * over) / area * _CLOSE
        later = -(b1 * over - beside * o1) / area * _CLOSE
        share = _FARTHEST / max(abs(by), abs(later), _FARTHEST)
        bearing += share * by
        time += share * later
    if not solved:
        return bearing, inf
    contact = _moved(near, bearing)
    begin, end = scene.leader[contact.piece, 0], piece_end(scene.leader, contact.piece)
    turned, _, _ = _turn_and_gap(pose, scene, contact, turn, time)
    straight = time - t - turned
    if straight < 0.0 or not begin <= time <= end:
        return bearing, inf
    row[0], row[1] = time, 0.0 if turn > 0.0 else 1.0
    row[2], row[3], row[4] = turned, straight, 0.0
    return bearing, time


@njit(cache=True, nogil=True)
def _moved(contact: Contact, bearing: float) -> Contact:
    """A contact at another bearing."""
    return Contact(contact.piece, bearing, contact.side)


@njit(cache=True, nogil=True)
def _turn_and_gap(
    pose: Pose, scene: Scene, contact: Contact, turn: float, time: float
) -> tuple[float, float, float]:
    """The turn to a contact's heading [rad]; how far that is ahead then, and to the left [R]."""
    there = contact_on(scene, contact, time)
    turned = wrap(turn * (there.h - pose.h))
    begun = fly_piece(pose, turn, turned)
    s, c = sine_and_cosine(there.h)
    dx, dy = there.x - begun.x, there.y - begun.y
    return turned, dx * c + dy * s, dy * c - dx * s


@njit(cache=True, nogil=True)
def _misses(
    pose: Pose, t: float, scene: Scene, contact: Contact, turn: float, time: float
) -> tuple[float, float]:
    """How far a contact lies beside the straight [R], and how much farther than the time for it."""
    turned, ahead, left = _turn_and_gap(pose, scene, contact, turn, time)
    return left, ahead - (time - t - turned)
