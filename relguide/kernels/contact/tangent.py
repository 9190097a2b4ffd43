"""Contacts that end a turn and a straight, or two opposite turns: the best ends of boundary arcs.

From the start, turn by θ and go straight: the closest approach to the leader is a function of θ
alone, and where it equals δ the straight is tangent to the disc. So is a turn the other way at its
own closest approach. These contacts are often the only ones in reach of an aircraft that is close
to the leader, in a window of bearings too narrow for a scan.

The same backward in time from the slot gives the contacts from which a straight and one turn lead
there: reversing time and turning the world by π leaves both velocities as they are, mirrors every
position in the leader and exchanges the sides.

Lengths in R, times in R/V_P, angles counter-clockwise; positions are relative to the leader, which
keeps heading 0.
"""

from math import atan2, cos, hypot, inf, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Bracket, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_distance, to_frame_of
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import fly_piece

MAX_TANGENTS = 32
"""Room for contacts found."""
NEAR = 8.0
"""Farther from the disc than this [R] the windows of bearings are wide."""
_TURNS = 60  # sizes of the first turn: every 6°
_STEP = 0.2  # step along the second turn: 11°
_SIN_STEP, _COS_STEP = sin(_STEP), cos(_STEP)


class _Approach(NamedTuple):
    """A turn and what follows it, to be flown past the leader."""

    pose: Pose
    """Where the turn begins, seen from the leader."""
    alpha: float
    """V_L/V_P."""
    distance: float
    """Of the contact, δ [R]."""
    first: float
    """ε of the turn."""
    second: float
    """ε of what follows it: 0 for a straight."""


@njit(cache=True, nogil=True)
def _first_approach(pose: Pose, alpha: float, sign: float) -> float:
    """When a full turn first stops closing in on the leader; −1 if it never does."""
    x, y, h = pose
    s0, c0 = sin(h), cos(h)
    s, c = s0, c0
    last = x * (c - alpha) + y * s
    t = 0.0
    while t < TWO_PI:
        t += _STEP
        s, c = s * _COS_STEP + sign * c * _SIN_STEP, c * _COS_STEP - sign * s * _SIN_STEP
        rate = (x + sign * (s - s0) - alpha * t) * (c - alpha) + (y - sign * (c - c0)) * s
        if last < 0.0 <= rate:
            low, high = t - _STEP, t
            middle = high - rate * _STEP / (rate - last)
            for _ in range(30):
                at = h + sign * middle
                sm, cm = sin(at), cos(at)
                rx, ry = x + sign * (sm - s0) - alpha * middle, y - sign * (cm - c0)
                value = rx * (cm - alpha) + ry * sm
                if value < 0.0:
                    low = middle
                else:
                    high = middle
                slope = 1.0 - 2.0 * alpha * cm + alpha * alpha + sign * (ry * cm - rx * sm)
                step_to = middle - value / slope if slope > 0.0 else low
                if not low < step_to < high:
                    step_to = 0.5 * (low + high)
                if abs(step_to - middle) < 1e-14:
                    break
                middle = step_to
            return middle
        last = rate
    return -1.0


@njit(cache=True, nogil=True)
def _miss(approach: _Approach, turned: float, contact: FloatArray) -> float:
    """Closest approach of what follows a first turn, less δ; NaN if it only moves away.

    `contact` takes the relative position and the time of the closest approach.
    """
    alpha, second = approach.alpha, approach.second
    px, py, ph = fly_piece(approach.pose, approach.first, turned)
    px -= alpha * turned
    if second == 0.0:
        vx, vy = cos(ph) - alpha, sin(ph)
        speed_squared = vx * vx + vy * vy
        after = -(px * vx + py * vy) / speed_squared if speed_squared > 1e-12 else -1.0
    else:
        after = _first_approach(Pose(px, py, ph), alpha, second)
    if after <= 0.0:
        return np.nan
    qx, qy, _ = fly_piece(Pose(px, py, ph), second, after)
    contact[0], contact[1], contact[2] = qx - alpha * after, qy, turned + after
    return hypot(contact[0], contact[1]) - approach.distance


@njit(cache=True, nogil=True)
def _touch(approach: _Approach, turns: Bracket, contact: FloatArray) -> float:
    """Where the closest approach is δ: the secant, kept inside the bracket (Illinois)."""
    low, high, at_low, at_high = turns
    middle = high
    for k in range(60):
        # every third step halves: a jump is then found out soon, too
        share = 0.5 if k % 3 == 2 else at_high / (at_high - at_low)
        middle = high - share * (high - low)
        value = _miss(approach, middle, contact)
        if abs(value) < 1e-14 or high - low < 1e-15:
            break
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = middle, value
            at_high *= 0.5
        else:
            high, at_high = middle, value
            at_low *= 0.5
    return middle


@njit(cache=True, nogil=True)
def tangent_contacts(pose: Pose, alpha: float, distance: float, found: FloatArray) -> int:
    """Contacts reached by a turn and a straight, or by a turn and one the other way.

    Args:
        pose: where the turn begins, seen from the leader.
        alpha: V_L/V_P.
        distance: of the contact, δ [R].
        found: takes bearing [rad, in [0, 2π)], side and time of each. shape (MAX_TANGENTS, 3)

    Returns:
        how many.
    """
    contact = np.empty(3)
    n = 0
    for k in range(4):
        first = 1.0 - 2.0 * (k % 2)
        second = 0.0 if k < 2 else -first
        approach = _Approach(pose, alpha, distance, first, second)
        last = np.nan
        for j in range(_TURNS + 1):
            turned = TWO_PI * j / _TURNS
            gap = _miss(approach, turned, contact)
            if last * gap < 0.0 and n < MAX_TANGENTS:
                high = _touch(
                    approach, Bracket(turned - TWO_PI / _TURNS, turned, last, gap), contact
                )
                value = _miss(approach, high, contact)
                if abs(value) < 1e-9:
                    heading = fly_piece(pose, first, high).h
                    if second != 0.0:
                        heading += second * (contact[2] - high)
                    across = contact[0] * sin(heading) - contact[1] * (cos(heading) - alpha)
                    found[n, 0] = wrap(atan2(contact[1], contact[0]))
                    found[n, 1] = 1.0 if across > 0.0 else -1.0
                    found[n, 2] = contact[2]
                    n += 1
            last = gap
    return n


@njit(cache=True, nogil=True)
def tangents(start: Pose, scene: Scene) -> FloatArray:
    """Tangent contacts of the start and of the slot, in the slot frame.

    Of the start while the leader keeps straight, on any of its pieces; not where it keeps straight
    for ever and is so far away that the scan sees all there is. Of the slot on the final leg.

    Returns:
        rows of bearing [rad], side, time [R/V_P], number of the leader's piece.
    """
    leader, distance = scene.leader, contact_distance(scene.d_min)
    pieces = len(leader)
    kept = np.empty(((pieces + 1) * MAX_TANGENTS, 4))
    found = np.empty((MAX_TANGENTS, 3))
    n = 0
    for i in range(pieces):
        if time_is_up(scene.until):
            return kept[:n]
        at = leader_at(scene, i, 0.0)
        if leader[i, 4] != 0.0 or (
            pieces == 1 and hypot(start.x - at.x, start.y - at.y) > distance + NEAR
        ):
            continue
        end = leader[i + 1, 0] if i + 1 < pieces else inf
        m = tangent_contacts(to_frame_of(start, at), scene.alpha, distance, found)
        for j in range(m):
            if leader[i, 0] <= found[j, 2] <= end:
                kept[n, :3] = found[j]
                kept[n, 3] = i
                n += 1
    at = leader_at(scene, pieces - 1, 0.0)
    m = tangent_contacts(Pose(at.x, at.y, 0.0), scene.alpha, distance, found)
    for j in range(m):
        kept[n, 0], kept[n, 1] = wrap(found[j, 0] + pi), -found[j, 1]
        kept[n, 2], kept[n, 3] = found[j, 2], pieces - 1
        n += 1
    return kept[:n]
