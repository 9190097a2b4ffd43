"""Cells of contacts, and where the poses of all contacts of a cell lie.

A contact is fixed by its time t, its bearing b and a side (see `contact`). A cell holds those with
a bearing in b ± w, in a window of time on one piece of the leader's intent.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import acos, inf, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.sets import EDGE, Change, Sensitivity
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at


class Cell(NamedTuple):
    """Contacts: a window of bearings, and of time, on one piece of the leader's intent and a side.

    The bearings lie in no more than one quadrant.
    """

    piece: int
    """As in `Contact`."""
    side: float
    """As in `Contact`."""
    bearing: float
    """Middle of the window [rad]."""
    half: float
    """Half of its width [rad]."""
    start: float
    """Of the window of time, within the piece [R/V_P]."""
    end: float
    """Of that window; infinite only on the final leg [R/V_P]."""


class Poses(NamedTuple):
    """The poses of a cell's contacts."""

    t: float
    """Middle of the window of time; its start if it has no end [R/V_P]."""
    span: float
    """Half of its width; 0 if it has no end [R/V_P]."""
    middle: Pose
    """Of the middle bearing, at the middle."""
    vx: float
    """How that moves [V_P]."""
    vy: float
    """[V_P]."""
    differs: float
    """How much the heading may differ from it [rad]; infinite if there is no contact."""
    left: float
    """How far the centre of their left circles may lie from the middle's, where that would be had
    it kept its velocity [R]."""
    right: float
    """And that of their right circles [R]."""
    sensitivity: Sensitivity
    """How they differ from it, to first order."""


class Spread(NamedTuple):
    """The poses of a cell's contacts, relative to the leader."""

    heading: float
    """Of the middle [rad]."""
    differs: float
    """How much others may differ [rad]; infinite if there is no contact."""
    left: float
    """How far the centre of their left circles may lie from the middle's [R]."""
    right: float
    """And that of their right circles [R]."""
    turns: float
    """How fast the heading changes with the bearing in the middle."""
    bends: float
    """How far besides the centres of the circles may lie, to second order in the bearing; infinite
    if that is not known [R]."""
    twists: float
    """And how much besides the heading may differ [rad]."""


@njit(cache=True, nogil=True)
def contacts_within(cell: Cell, alpha: float, d_min: float) -> Spread:
    """The contacts of a cell."""
    bearing, half, side = cell.bearing, cell.half, cell.side
    low_s, low_c = sine_and_cosine(bearing - half)
    high_s, high_c = sine_and_cosine(bearing + half)
    low, high = alpha * low_c, alpha * high_c
    if alpha > 1.0 - EDGE:
        # not every bearing can be touched, and the heading may change without bound
        if min(low, high) > 1.0 or max(low, high) < -1.0:
            return Spread(0.0, inf, inf, inf, 0.0, inf, 0.0)
        first, second = acos(min(max(low, -1.0), 1.0)), acos(min(max(high, -1.0), 1.0))
        differs = half + 0.5 * abs(first - second)
        blur = d_min * half + differs
        return Spread(bearing + side * 0.5 * (first + second), differs, blur, blur, 0.0, inf, 0.0)
    heading = contact_heading(bearing, side, alpha)
    # the heading grows with the bearing, at a rate between 0 and 2 that is monotone in a quadrant
    differs = max(
        contact_heading(bearing + half, side, alpha) - heading,
        heading - contact_heading(bearing - half, side, alpha),
    )
    left, right, fastest = 0.0, 0.0, 0.0
    for end in range(2):
        along, ahead = (low, alpha * low_s) if end == 0 else (high, alpha * high_s)
        rate = 1.0 + side * ahead / sqrt(1.0 - along * along)
        fastest = max(fastest, rate)
        for other in range(2):
            across = low if other == 0 else high
            mixed = 2.0 * d_min * rate * side * sqrt(1.0 - across * across)
            left = max(left, d_min * d_min - mixed + rate * rate)
            right = max(right, d_min * d_min + mixed + rate * rate)
    s, c = sine_and_cosine(bearing)
    turns = 1.0 + side * alpha * s / sqrt(1.0 - alpha * c * alpha * c)
    # its second derivative is α cos b (1 − α²)/q³
    most = max(abs(low), abs(high))
    twists = most * (1.0 - alpha * alpha) / (1.0 - most * most) ** 1.5
    square = 0.5 * half * half
    return Spread(
        heading, differs, half * sqrt(max(left, 0.0)), half * sqrt(max(right, 0.0)), turns,
        square * (d_min + fastest * fastest + twists), square * twists,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def poses_of(scene: Scene, cell: Cell) -> Poses:
    """The poses of a cell; `differs` is infinite if there is no contact."""
    low, high = cell.start, cell.end
    t = low if high == inf else 0.5 * (low + high)
    span = 0.0 if high == inf else 0.5 * (high - low)
    spread = contacts_within(cell, scene.alpha, scene.d_min)
    there = leader_at(scene, cell.piece, t)
    at = there.h + cell.bearing
    s, c = sine_and_cosine(at)
    across, ahead = scene.d_min * s, scene.d_min * c
    lead_s, lead_c = sine_and_cosine(there.h)
    # the contact of the middle bearing moves like this, and turns with the leader
    rate = scene.leader[cell.piece, 4]
    swing, strays = turning_blur(scene, rate, span)
    # to second order: by the bearing, by both, and by the time
    bends = spread.bends + swing * max(spread.left, spread.right) + strays - swing
    half = cell.half
    sensitivity = Sensitivity(
        Change(-half * across, half * ahead, half * spread.turns), Change(0.0, 0.0, rate * span),
        bends, spread.twists,
    )  # fmt: skip
    return Poses(
        t, span, Pose(there.x + ahead, there.y + across, there.h + spread.heading),
        scene.alpha * lead_c - rate * across, scene.alpha * lead_s + rate * ahead,
        spread.differs + swing, spread.left + strays, spread.right + strays, sensitivity,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def turning_blur(scene: Scene, rate: float, span: float) -> tuple[float, float]:
    """How much a contact turns with the leader within a time, and how far it strays.

    Args:
        scene: the leader and d_min.
        rate: the leader's turn rate [V_P/R].
        span: the time, either way [R/V_P].

    Returns:
        the turn [rad], and how far the centres of the circles beside it, which turn with it, may
        lie from where they would be had it kept its velocity and heading [R].
    """
    swing = abs(rate) * span
    return swing, swing + 0.5 * (scene.alpha + abs(rate) * (scene.d_min + 1.0)) * swing * span


@njit(cache=True, nogil=True)
def fastest_turn(scene: Scene, first: int, last: int) -> float:
    """The leader's greatest turn rate on its pieces from one to another, either way [V_P/R]."""
    rate = 0.0
    for i in range(first, last + 1):
        rate = max(rate, abs(scene.leader[i, 4]))
    return float(rate)
