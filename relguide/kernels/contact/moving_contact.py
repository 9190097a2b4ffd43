"""A contact with d = d_min on a turn of the leader's: it moves on a circle.

So does the centre of the circle on which a word comes in to it, round the same point and as fast.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, inf, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Contact, Pose, Scene, Start
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.contact import contact_distance
from relguide.kernels.words.to_point import word_from

_CLOSER = 8  # steps toward the first time at which a contact is in reach


class Passage(NamedTuple):
    """From a start to one contact on a turn of the leader's, and the circle that this moves on.

    Numbers only: who counts references to arrays here takes a third of the time.
    """

    pose: Pose
    """The start."""
    t_start: float
    """When [R/V_P]."""
    until: float
    """When the search must have ended, as in `Scene` [s]."""
    begin: float
    """When it can be there first, as far as the leader goes [R/V_P] …"""
    end: float
    """… and last."""
    turning: float
    """The leader's turn rate ω [V_P/R]."""
    leader_h: float
    """Its heading at the start, as if it turned already [rad]."""
    x: float
    """The centre of the leader's turn, seen from the start's place, but not turned [R]."""
    y: float
    ahead: float
    """From there to the contact while the leader heads 0 [R] …"""
    left: float
    """… and to the left."""
    heading: float
    """On which it is met, relative to the leader's [rad] …"""
    sin_heading: float
    """… its sine …"""
    cos_heading: float
    """… and cosine."""
    sin_h: float
    """Sine of the start's heading …"""
    cos_h: float
    """… and cosine."""


@njit(cache=True, nogil=True)
def passage_to(pose: Pose, t: float, scene: Scene, contact: Contact) -> Passage:
    """From a pose at time t to a contact on a piece on which the leader turns."""
    begin, x, y, h, turning = scene.leader[contact.piece]
    distance, radius = contact_distance(scene.d_min), scene.alpha / turning
    s, c = sine_and_cosine(contact.bearing)
    # the heading is b + s arccos(α cos b)
    along = scene.alpha * c
    across = contact.side * sqrt(max(1.0 - along * along, 0.0))
    sin_h, cos_h = sine_and_cosine(pose.h)
    sin_lh, cos_lh = sine_and_cosine(h)
    return Passage(
        pose, t, scene.until, max(begin, t), scene.leader[contact.piece + 1, 0], turning,
        h + turning * (t - begin),
        x - radius * sin_lh - pose.x, y + radius * cos_lh - pose.y,
        distance * c, distance * s - radius,
        contact.bearing + contact.side * acos(along),
        s * along + c * across, c * along - s * across, sin_h, cos_h,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def leader_heading(passage: Passage, t: float) -> float:
    """On which heading the leader is at t [rad]."""
    return float(passage.leader_h + passage.turning * (t - passage.t_start))


@njit(cache=True, nogil=True)
def _seen_from(passage: Passage, t: float) -> Start:
    """The start as seen from where the contact is at t."""
    lh = leader_heading(passage, t)
    s, c = sine_and_cosine(lh)
    dx = -passage.x - passage.ahead * c + passage.left * s
    dy = -passage.y - passage.ahead * s - passage.left * c
    # the course on which the contact is met, and the start's heading from there
    sin_course = s * passage.cos_heading + c * passage.sin_heading
    cos_course = c * passage.cos_heading - s * passage.sin_heading
    return Start(
        dx * cos_course + dy * sin_course,
        dy * cos_course - dx * sin_course,
        passage.pose.h - lh - passage.heading,
        passage.sin_h * cos_course - passage.cos_h * sin_course,
        passage.cos_h * cos_course + passage.sin_h * sin_course,
    )


@njit(cache=True, nogil=True)
def distance_at(passage: Passage, t: float) -> float:
    """How far the contact is from the start at t [R]."""
    lh = leader_heading(passage, t)
    s, c = sine_and_cosine(lh)
    return norm(
        passage.x + passage.ahead * c - passage.left * s,
        passage.y + passage.ahead * s + passage.left * c,
    )


@njit(cache=True, nogil=True)
def speed_of(passage: Passage) -> float:
    """How fast the contact moves [V_P]."""
    return abs(passage.turning) * norm(passage.ahead, passage.left)


@njit(cache=True, nogil=True)
def earliest_while_turning(passage: Passage, beat: float) -> float:
    """No path reaches the contact before this time [R/V_P]; infinite if none does on this turn.

    Times from `beat` on do not matter, and any of them may come back [R/V_P].

    The pursuer and the contact close in no faster than at the sum of their speeds, and their
    headings no faster than at the sum of their turn rates.
    """
    at, closing = passage.begin, 1.0 + speed_of(passage)
    coming_round = 1.0 + abs(passage.turning)
    for _ in range(_CLOSER):
        elapsed = at - passage.t_start
        change = leader_heading(passage, at) + passage.heading - passage.pose.h
        lack = max(
            (distance_at(passage, at) - elapsed) / closing,
            (abs(wrap_signed(change)) - elapsed) / coming_round,
        )
        if lack <= 0.0:
            break
        at += lack
        if at > passage.end:
            return inf
        if at >= beat:
            break
    return float(at)


@njit(cache=True, nogil=True)
def excess(passage: Passage, branch: int, t: float, piece: FloatArray) -> float:
    """Length of a word to where the contact is at t, less the time for it; NaN if out of reach."""
    length = word_from(_seen_from(passage, t), 0.0, branch, piece)
    return length - (t - passage.t_start) if length >= 0.0 else np.nan
