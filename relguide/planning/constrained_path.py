"""detour(candidates): the fastest way to the slot that touches d_min, or slides along it."""

from math import inf

import numpy as np

from relguide.kernels.contact.constrained_search import MAX_LEGS, any_path, best_constrained_path
from relguide.kernels.contact.passage import GRAZE
from relguide.kernels.contact.path_pieces import NO_TURN, pieces_of
from relguide.kernels.contact.tangent import tangents
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.words import (
    HORIZON,
    SIGN_ROWS,
    Candidate,
    Candidates,
    assemble,
    candidate_of,
    segments_flown,
)
from relguide.units import Second

BEARINGS = 60
"""How finely the disc is scanned round a leader that keeps straight: every 6°."""
TURNING_BEARINGS = 72
"""Round one that turns: every 5°, since contacts must fall into the time of one piece."""


def detour(found: Candidates, *, beat: Second) -> Candidate | None:
    """The fastest way through contacts with d = d_min, if it arrives before `beat` [s].

    Up to the first contact, between contacts and from the last one on, the way is an extremal
    without the limit, from the same complete enumeration of words, or it slides along d_min. The
    contacts' bearings are searched round the leader, for each piece of its intent and both sides.
    If there is none, and nothing to beat, any way that begins with a turn and a straight will do.
    """
    situation, frame = found.situation, found.frame
    scale = frame.radius / situation.pursuer.tas
    limit = situation.min_separation / frame.radius
    if limit <= 0.0:
        return None
    leader = leader_table(situation, frame)
    start = frame.x, frame.y, frame.h
    disc = leader, frame.alpha, limit + GRAZE
    legs, row = np.zeros((MAX_LEGS, 6)), np.zeros(5)
    time, count = best_constrained_path(
        *start,
        *disc,
        frame.t_release,
        BEARINGS if len(leader) == 1 else TURNING_BEARINGS,
        tangents(*start, *disc),
        beat / scale,
        legs,
    )
    if count > 0:
        pieces = pieces_of(
            *start,
            leader,
            frame.alpha,
            limit,
            frame.t_release,
            frame.radius,
            1.0,
            time,
            legs[:count],
        )
        if pieces.shape[1] > 0:
            return candidate_of(situation.pursuer, segments_flown(frame.radius, pieces))
    if beat < HORIZON:
        return None
    time, sign, turned, straight = any_path(
        *start, leader, frame.alpha, limit, frame.t_release, beat / scale, row
    )
    if time >= beat / scale:
        return None
    signs = [sign, 0.0, *SIGN_ROWS[int(row[1])]]
    return assemble(situation, frame, signs, [turned, straight, *row[2:].tolist()], "")


def leader_table(situation: Situation, frame: SlotFrame) -> np.ndarray:
    """The leader's pieces in the slot frame, a row each: start time, x, y, heading, turn rate.

    Lengths in R, times in R/V_P, angles counter-clockwise; the last row is the endless final leg.
    """
    leader, tas = situation.leader.trajectory, situation.pursuer.tas
    table: list[tuple[float, ...]] = []
    t = 0.0
    pieces = zip((*leader.durations(), inf), (*leader.turn_rates(), 0.0), strict=True)
    for pose, (duration, rate) in zip(leader.breakpoints(), pieces, strict=True):
        if duration * tas / frame.radius > NO_TURN:  # shorter pieces are rounding
            x, y = frame.to_slot(pose.x, pose.y)
            turning = -rate * frame.radius / tas
            table.append((t * tas / frame.radius, x, y, frame.heading - pose.heading, turning))
        t += duration
    return np.array(table)
