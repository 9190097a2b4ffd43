"""Ways of a kind as legs, and whether they keep the limit.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, sin

from numba import njit

from relguide.kernels.base.records import Disc, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, WORD
from relguide.kernels.contact.contact import GRAZE, contact_heading
from relguide.kernels.contact.passage import word_clears
from relguide.kernels.contact.touch_points import slide_between
from relguide.kernels.networks.near_guess import AGAIN_ARCS, ARCS_AGAIN, ARCS_ON
from relguide.kernels.words.extremals import SIGNS, fly_piece


@njit(cache=True, nogil=True)
def as_legs(
    side: float, on: int, bearing: float, way: FloatArray, link: FloatArray, legs: FloatArray
) -> int:
    """A way as legs.

    Args:
        side: +1 counter-clockwise round the leader, −1 clockwise.
        on: how it goes on from its contact, a number of `templates.ONWARD`.
        bearing: of the contact, where a boundary arc begins there [rad].
        way: rows of the words before and after the contact. shape (2, 5)
        link: of `near_guess.through`. shape (5,)
        legs: takes them, as `chain.fly_links`. shape (≥ 3, 6)

    Returns:
        how many.
    """
    legs[0, 0] = WORD
    legs[0, 1:6] = way[0]
    count = 1
    if on == AGAIN_ARCS:
        legs[1, 0] = WORD
        turn_straight(side, link[1], link[2], legs[1, 1:6])
        legs[2, 0], legs[2, 1], legs[2, 2], legs[2, 3] = BOUNDARY_ARC, side, link[0], link[3]
        count = 3
    elif on == ARCS_ON or on == ARCS_AGAIN:
        legs[1, 0], legs[1, 1], legs[1, 2], legs[1, 3] = BOUNDARY_ARC, side, bearing, link[3]
        count = 2
        if on == ARCS_AGAIN:
            legs[2, 0] = WORD
            straight_turn(side, link[2], link[1], legs[2, 1:6])
            count = 3
    legs[count, 0] = WORD
    legs[count, 1:6] = way[1]
    return count + 1


@njit(cache=True, nogil=True)
def clears(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, side: float,
    legs: FloatArray,
) -> bool:  # fmt: skip
    """Whether the words of a way keep the limit; boundary arcs do.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: its leg as `passage.word_clears` takes it. shape (1, 5)
        alpha: V_L/V_P.
        delta: distance at contacts [R].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        legs: the way. shape (n, 6)
    """
    slot, t = leader[0, 1], 0.0
    disc = Disc(alpha, delta, side, 0.0)
    eased = Scene(leader, alpha, delta - 2.0 * GRAZE, 0.0)
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            bearing = legs[k, 3]
            _, took = slide_between(legs[k, 2], bearing, disc)
            t += took
            x, y = slot + alpha * t + delta * cos(bearing), delta * sin(bearing)
            h = contact_heading(bearing, side, alpha)
            continue
        row = legs[k, 1:6]
        if not word_clears(Pose(x, y, h), t, row, eased):
            return False
        for piece in range(3):
            x, y, h = fly_piece(Pose(x, y, h), SIGNS[int(row[1]), piece], row[2 + piece])
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
