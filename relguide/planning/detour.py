"""detour(candidates): the fastest way to the slot that touches d_min, or rides along it."""

from math import inf

import numpy as np

from relguide.kernels.chain import RIDE, WAIT
from relguide.kernels.detour import MAX_LEGS, any_way, best_detour
from relguide.kernels.extremals import MAX_ROWS, fly_piece
from relguide.kernels.hold import HOLD_PIECES
from relguide.kernels.passage import GRAZE, best_word
from relguide.kernels.ride import MAX_NODES, ride_pieces
from relguide.kernels.tangent import tangents
from relguide.kernels.waiting import wait_for_opening
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.trajectory import LEFT, RIGHT, BoundaryArc, Segment
from relguide.planning.words import (
    HORIZON,
    NO_TURN,
    SIGN_ROWS,
    Candidate,
    Candidates,
    assemble,
    candidate_of,
    segments_of,
)
from relguide.units import Second

SAME = 2e-4
"""A way handed over as segments takes as long as the one searched, to this [R/V_P]: some ms."""
BEARINGS = 60
"""How finely the disc is scanned round a leader that keeps straight: every 6°."""
TURNING_BEARINGS = 72
"""Round one that turns: every 5°, since contacts must fall into the time of one piece."""


def detour(found: Candidates, *, beat: Second) -> Candidate | None:
    """The fastest way through contacts with d = d_min, if it arrives before `beat` [s].

    Up to the first contact, between contacts and from the last one on, the way is an extremal
    without the limit, from the same complete enumeration of words, or it rides along d_min. The
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
    time, count = best_detour(
        *start,
        *disc,
        frame.t_open,
        BEARINGS if len(leader) == 1 else TURNING_BEARINGS,
        tangents(*start, *disc),
        beat / scale,
        legs,
    )
    if count > 0:
        around = flown(situation, frame, leader, limit, legs[:count])
        if around is not None and around.time_to_converge <= (time + SAME) * scale:
            return around
    if beat < HORIZON:
        return None
    time, sign, turned, straight = any_way(
        *start, leader, frame.alpha, limit, frame.t_open, beat / scale, row
    )
    if time >= beat / scale:
        return None
    signs = [sign, 0.0, *SIGN_ROWS[int(row[1])]]
    return assemble(situation, frame, signs, [turned, straight, *row[2:].tolist()], "")


def flown(
    situation: Situation, frame: SlotFrame, leader: np.ndarray, limit: float, legs: np.ndarray
) -> Candidate | None:
    """The legs of a way as segments; the last word anew, from where the rides really end.

    Args:
        situation: gives the pursuer.
        frame: its slot frame.
        leader: table of its pieces in there. shape (k, 5)
        limit: d_min [R].
        legs: as `chain.fly_links` gives them. shape (n, 6)

    Returns:
        `None` if no word leads on from there.
    """
    x, y, h, t = frame.x, frame.y, frame.h, 0.0
    segments: list[Segment] = []
    signs: list[float] = []  # of the words since the last ride: where they meet, turns may be one
    amounts: list[float] = []
    for leg in legs[:-1].tolist():
        if leg[0] == RIDE:
            _, side, first, last, _, _ = leg
            bends = np.empty((2 * MAX_NODES, 2))
            n, x, y, h, t = ride_pieces(
                x, y, h, t, leader, frame.alpha, limit + GRAZE, side, first, last, bends
            )
            segments += (
                *segments_of(frame.radius, signs, amounts),
                _ridden(frame, side, bends[:n]),
            )
            signs, amounts = [], []
        else:
            word = SIGN_ROWS[int(leg[2])]
            signs += word
            amounts += leg[3:]
            for sign, amount in zip(word, leg[3:], strict=True):
                x, y, h = fly_piece(x, y, h, sign, amount)
                t += amount
    last_row = legs[-1, 1:]
    rode = any(isinstance(segment, BoundaryArc) for segment in segments)
    if legs[-1, 0] == WAIT:
        pieces = np.empty((HOLD_PIECES, 2))
        if not wait_for_opening(
            x, y, h, t, leader, frame.alpha, limit - GRAZE, frame.t_open, pieces
        ):
            return None
        signs += pieces[:, 0].tolist()
        amounts += pieces[:, 1].tolist()
    else:
        if rode:
            rows = np.empty((MAX_ROWS, 5))
            # a ride's last node lies within rounding of the limit: it must not cost the best word
            _, i = best_word(
                x, y, h, t, leader, frame.alpha, limit - GRAZE, frame.t_open, inf, rows
            )
            if i < 0:
                return None
            last_row = rows[i]
        signs += SIGN_ROWS[int(last_row[1])]
        amounts += last_row[2:].tolist()
    segments += segments_of(frame.radius, signs, amounts)
    return candidate_of(situation.pursuer, tuple(segments))


def _ridden(frame: SlotFrame, side: float, bends: np.ndarray) -> BoundaryArc:
    radius = frame.radius
    return BoundaryArc(
        side=LEFT if side > 0.0 else RIGHT,
        # counter-clockwise rates become curvatures positive to the right
        bends=tuple((amount * radius, -rate / radius) for amount, rate in bends.tolist()),
    )


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
