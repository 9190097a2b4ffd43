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

from math import atan2, ceil, cos, inf, isnan, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.false_position import Bracket as Crossing
from relguide.kernels.base.false_position import secant, tightened
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Bracket, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.contact import contact_distance, to_frame_of
from relguide.kernels.separation.clearance import leader_at, piece_end
from relguide.kernels.words.extremals import fly_piece

MAX_TANGENTS = 32
"""Room for contacts found."""
NEAR = 8.0
"""Farther from the disc than this [R] the windows of bearings are wide."""
_TURNS = 60  # sizes of the first turn: every 6°
_STEP = 0.2  # step along the second turn: 11°
_HALVINGS = 30  # down to where a closest approach ceases to exist
_MOST_STEPS = 64  # through one turn of the leader's
_SIN_STEP, _COS_STEP = sin(_STEP), cos(_STEP)


class Leg(NamedTuple):
    """One leg of the leader's, seen from where it would be on it at t = 0, and heads."""

    alpha: float
    """V_L/V_P."""
    turning: float
    """The leader's turn rate ω [V_P/R]."""
    begin: float
    """When it begins [R/V_P]."""
    end: float
    """When it ends; infinite on the final leg [R/V_P]."""


class _Approach(NamedTuple):
    """A turn and what follows it, to be flown past the leader."""

    pose: Pose
    """Where the turn begins, at t = 0, as `Leg` sees it."""
    leg: Leg
    """The leader's."""
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
    s0, c0 = sine_and_cosine(h)
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
                sm, cm = sine_and_cosine(at)
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
def _seen_turning(pose: Pose, leg: Leg, t: float) -> tuple[float, float, float]:
    """Where the leader sees a pursuer of that pose as it turns, and the rate of d²/2."""
    half = 0.5 * leg.turning * t
    s, c = sine_and_cosine(half)
    chord = leg.alpha * s / (0.5 * leg.turning)
    dx, dy = pose.x - chord * c, pose.y - chord * s
    c, s = 1.0 - 2.0 * s * s, 2.0 * s * c
    sin_h, cos_h = sine_and_cosine(pose.h)
    rate = dx * (cos_h - leg.alpha * c) + dy * (sin_h - leg.alpha * s)
    return dx * c + dy * s, dy * c - dx * s, rate


@njit(cache=True, nogil=True)
def _first_approach_while_turning(pose: Pose, leg: Leg, sign: float, t: float) -> float:
    """When a piece begun at time t first stops closing in on a leader that turns; −1 if never."""
    low, end = max(t, leg.begin), leg.end
    if sign != 0.0:
        end = min(end, t + TWO_PI)
    if end <= low:
        return -1.0
    steps = min(ceil((end - low) / _STEP), _MOST_STEPS)
    _, _, at_low = _seen_turning(fly_piece(pose, sign, low - t), leg, low)
    for k in range(1, steps + 1):
        high = end - (steps - k) * (end - low) / (steps - k + 1)
        _, _, at_high = _seen_turning(fly_piece(pose, sign, high - t), leg, high)
        if at_high == 0.0 > at_low:
            return high
        if at_low < 0.0 < at_high:
            return _root_of_rate(pose, leg, sign, t, Crossing(low, high, at_low, at_high, 0))
        low, at_low = high, at_high
    return -1.0


@njit(cache=True, nogil=True)
def _root_of_rate(pose: Pose, leg: Leg, sign: float, t: float, times: Crossing) -> float:
    """When d stops falling between two times."""
    at = times.high
    for _ in range(60):
        at = secant(times)
        _, _, rate = _seen_turning(fly_piece(pose, sign, at - t), leg, at)
        if abs(rate) < 1e-15 or times.high - times.low < 1e-14:
            break
        times = tightened(times, at, rate)
    return at


@njit(cache=True, nogil=True)
def _miss(approach: _Approach, turned: float, contact: FloatArray) -> float:
    """Closest approach of what follows a first turn, less δ; NaN if it only moves away.

    `contact` takes the relative position, the time of the closest approach, and the side.
    """
    leg, second = approach.leg, approach.second
    begun = fly_piece(approach.pose, approach.first, turned)
    if leg.turning != 0.0:
        t = _first_approach_while_turning(begun, leg, second, turned)
        if t < 0.0:
            return np.nan
        at = fly_piece(begun, second, t - turned)
        contact[0], contact[1], _ = _seen_turning(at, leg, t)
        contact[2], contact[3] = t, at.h - leg.turning * t
        return norm(contact[0], contact[1]) - approach.distance
    alpha = leg.alpha
    px, py, ph = begun.x - alpha * turned, begun.y, begun.h
    if second == 0.0:
        vy, cos_h = sine_and_cosine(ph)
        vx = cos_h - alpha
        speed_squared = vx * vx + vy * vy
        after = -(px * vx + py * vy) / speed_squared if speed_squared > 1e-12 else -1.0
    else:
        after = _first_approach(Pose(px, py, ph), alpha, second)
    if after <= 0.0:
        return np.nan
    qx, qy, qh = fly_piece(Pose(px, py, ph), second, after)
    contact[0], contact[1], contact[2], contact[3] = qx - alpha * after, qy, turned + after, qh
    return norm(contact[0], contact[1]) - approach.distance


@njit(cache=True, nogil=True)
def _to_edge(approach: _Approach, turns: Bracket, contact: FloatArray) -> Bracket:
    """The part of a bracket with a closest approach, which one of its ends has not."""
    low, high, at_low, at_high = turns
    has_low = isnan(at_high)
    seen, blind, at_seen = (low, high, at_low) if has_low else (high, low, at_high)
    edge, at_edge = seen, at_seen
    for _ in range(_HALVINGS):
        middle = 0.5 * (edge + blind)
        value = _miss(approach, middle, contact)
        if isnan(value):
            blind = middle
        else:
            edge, at_edge = middle, value
    return (
        Bracket(seen, edge, at_seen, at_edge) if has_low else Bracket(edge, seen, at_edge, at_seen)
    )


@njit(cache=True, nogil=True)
def _touch(approach: _Approach, turns: Bracket, contact: FloatArray) -> float:
    """Where the closest approach is δ, between two turns of which one comes nearer (Illinois)."""
    rising = 1.0 if turns.at_low < turns.at_high else -1.0
    between = Crossing(turns.low, turns.high, rising * turns.at_low, rising * turns.at_high, 0)
    middle = turns.high
    for k in range(60):
        # every third step halves: a jump is then found out soon, too
        middle = 0.5 * (between.low + between.high) if k % 3 == 2 else secant(between)
        value = _miss(approach, middle, contact)
        if abs(value) < 1e-14 or between.high - between.low < 1e-15:
            break
        between = tightened(between, middle, rising * value)
    return middle


@njit(cache=True, nogil=True)
def tangent_contacts(pose: Pose, leg: Leg, distance: float, found: FloatArray) -> int:
    """Contacts reached by a turn and a straight, or by a turn and one the other way.

    Args:
        pose: where the turn begins, at t = 0, as the leg sees it.
        leg: of the leader; contacts at other times do not count.
        distance: of the contact, δ [R].
        found: takes bearing [rad, in [0, 2π)], side and time of each. shape (MAX_TANGENTS, 3)

    Returns:
        how many.
    """
    n = 0
    for k in range(4):
        first = 1.0 - 2.0 * (k % 2)
        second = 0.0 if k < 2 else -first
        n = _append_contacts(_Approach(pose, leg, distance, first, second), found, n)
    return n


@njit(cache=True, nogil=True)
def straight_touches(
    pose: Pose, t: float, scene: Scene, piece: int, turn: float, found: FloatArray
) -> int:
    """Contacts on a leader's piece that a turn to one side and a straight lead to.

    Args:
        pose: where the turn begins.
        t: when [R/V_P].
        scene: the leader and d_min.
        piece: of the leader's.
        turn: +1 if it is to the left, −1 to the right.
        found: as in `tangent_contacts`, its times since t. shape (MAX_TANGENTS, 3)

    Returns:
        how many.
    """
    leader, at = scene.leader, leader_at(scene, piece, t)
    end = piece_end(leader, piece) - t
    leg = Leg(scene.alpha, leader[piece, 4], leader[piece, 0] - t, end)
    seen, distance = to_frame_of(pose, at), contact_distance(scene.d_min)
    return _append_contacts(_Approach(seen, leg, distance, turn, 0.0), found, 0)


@njit(cache=True, nogil=True)
def _append_contacts(approach: _Approach, found: FloatArray, n: int) -> int:
    """Append the contacts that one kind of approach leads to; how many there are then."""
    leg, contact, last = approach.leg, np.empty(4), np.nan
    for j in range(_TURNS + 1):
        low, high = TWO_PI * (j - 1) / _TURNS, TWO_PI * j / _TURNS
        gap = _miss(approach, high, contact)
        between = Bracket(low, high, last, gap)
        if leg.turning != 0.0 and j > 0 and isnan(last) != isnan(gap):
            between = _to_edge(approach, between, contact)
        if between.at_low * between.at_high < 0.0 and n < MAX_TANGENTS:
            turned = _touch(approach, between, contact)
            value = _miss(approach, turned, contact)
            if abs(value) < 1e-9 and leg.begin <= contact[2] <= leg.end:
                vy, cos_h = sine_and_cosine(contact[3])
                vx = cos_h - leg.alpha
                found[n, 0] = wrap(atan2(contact[1], contact[0]))
                found[n, 1] = 1.0 if contact[0] * vy > contact[1] * vx else -1.0
                found[n, 2] = contact[2]
                n += 1
        last = gap
    return n


@njit(cache=True, nogil=True)
def tangents(start: Pose, scene: Scene) -> FloatArray:
    """Tangent contacts of the start and of the slot, in the slot frame.

    Of the start on any leg of the leader's; not where it keeps straight for ever and is so far away
    that the scan sees all there is. Of the slot on the final leg.

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
        if pieces == 1 and norm(start.x - at.x, start.y - at.y) > distance + NEAR:
            continue
        leg = Leg(scene.alpha, leader[i, 4], leader[i, 0], piece_end(leader, i))
        m = tangent_contacts(to_frame_of(start, at), leg, distance, found)
        kept[n : n + m, :3], kept[n : n + m, 3] = found[:m], i
        n += m
    at = leader_at(scene, pieces - 1, 0.0)
    m = tangent_contacts(Pose(at.x, at.y, 0.0), Leg(scene.alpha, 0.0, 0.0, inf), distance, found)
    for j in range(m):
        kept[n, 0], kept[n, 1] = wrap(found[j, 0] + pi), -found[j, 1]
        kept[n, 2], kept[n, 3] = found[j, 2], pieces - 1
        n += 1
    return kept[:n]
