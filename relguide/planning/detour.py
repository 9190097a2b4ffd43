"""detour(candidates): the fastest way to the slot that touches d_min, or rides along it."""

import numpy as np

from relguide.kernels.detour import any_way, best_detour
from relguide.kernels.extremals import MAX_ROWS, fly_piece
from relguide.kernels.passage import GRAZE, best_word
from relguide.kernels.ride import MAX_NODES, best_ride, ride_pieces
from relguide.kernels.tangent import tangents
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.trajectory import LEFT, RIGHT, BoundaryArc, Segment, Trajectory
from relguide.planning.words import SIGN_ROWS, Candidate, Candidates, assemble, segments_of
from relguide.units import Second

HORIZON: Second = 43_200.0
"""Plans longer than this are not given: 12 hours, longer than any aircraft's fuel lasts [s]."""
SAME = 1e-6
"""A ride handed over as arcs takes as long as the ride searched, to this [R/V_P]."""
BEARINGS = 90
"""How finely the disc is scanned: every 4°. Twice as fine finds nothing better in golden cases."""


def detour(found: Candidates, *, beat: Second) -> Candidate | None:
    """The fastest way through a contact with d = d_min, if it arrives before `beat` [s].

    Up to the contact and from it on the way is an extremal without the limit, from the same
    complete enumeration of words. The contact's bearing is searched round the leader, for each
    piece of its intent and both sides; then the ways that ride along d_min between two contacts.
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
    scan = frame.t_open, BEARINGS, tangents(*start, *disc)
    way, row = np.zeros((2, 5)), np.zeros(5)
    time = best_detour(*start, *disc, *scan, beat / scale, way)
    ride_time, side, first, last = best_ride(*start, *disc, *scan, time, row)
    if ride_time < time:
        ridden = _along_the_limit(found, leader, limit, row, side, first, last)
        if ridden is not None and ridden.time_to_converge <= (ride_time + SAME) * scale:
            return ridden
    if time < beat / scale:
        signs = [sign for part in way for sign in SIGN_ROWS[int(part[1])]]
        return assemble(situation, frame, signs, way[:, 2:].ravel().tolist(), "")
    if beat < HORIZON:
        return None
    time, sign, turned, straight = any_way(
        *start, leader, frame.alpha, limit, frame.t_open, beat / scale, row
    )
    if time >= beat / scale:
        return None
    signs = [sign, 0.0, *SIGN_ROWS[int(row[1])]]
    return assemble(situation, frame, signs, [turned, straight, *row[2:].tolist()], "")


def _along_the_limit(
    found: Candidates,
    leader: np.ndarray,
    limit: float,
    row: np.ndarray,
    side: float,
    first: float,
    last: float,
) -> Candidate | None:
    """The way that rides from one bearing to another, as segments."""
    situation, frame = found.situation, found.frame
    x, y, h, t = frame.x, frame.y, frame.h, 0.0
    signs = SIGN_ROWS[int(row[1])]
    for sign, amount in zip(signs, row[2:].tolist(), strict=True):
        x, y, h = fly_piece(x, y, h, sign, amount)
        t += amount
    bends = np.empty((2 * MAX_NODES, 2))
    n, x, y, h, t = ride_pieces(
        x, y, h, t, leader, frame.alpha, limit + GRAZE, side, first, last, bends
    )
    rows = np.empty((MAX_ROWS, 5))
    # the ride's own last node lies within rounding of the limit, which must not cost the best word
    _, i = best_word(
        x, y, h, t, leader, frame.alpha, limit - GRAZE, frame.t_open, float("inf"), rows
    )
    if i < 0:
        return None
    radius = frame.radius
    ride = BoundaryArc(
        side=LEFT if side > 0.0 else RIGHT,
        # counter-clockwise rates become curvatures positive to the right
        bends=tuple((amount * radius, -rate / radius) for amount, rate in bends[:n].tolist()),
    )
    segments: tuple[Segment, ...] = (
        *segments_of(frame, signs, row[2:].tolist()),
        ride,
        *segments_of(frame, SIGN_ROWS[int(rows[i, 1])], rows[i, 2:].tolist()),
    )
    pursuer = situation.pursuer
    trajectory = Trajectory(
        x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas, segments=segments
    )
    return Candidate(word=trajectory.letters, trajectory=trajectory)


def leader_table(situation: Situation, frame: SlotFrame) -> np.ndarray:
    """The leader's pieces in the slot frame, a row each: start time, x, y, heading, turn rate.

    Lengths in R, times in R/V_P, angles counter-clockwise; the last row is the endless final leg.
    """
    leader, tas = situation.leader.trajectory, situation.pursuer.tas
    table = np.empty((len(leader.segments) + 1, 5))  # (pieces, 5)
    t = 0.0
    pieces = zip((*leader.durations(), 0.0), (*leader.turn_rates(), 0.0), strict=True)
    for row, pose, (duration, rate) in zip(table, leader.breakpoints(), pieces, strict=True):
        x, y = frame.to_slot(pose.x, pose.y)
        row[:] = (
            t * tas / frame.radius,
            x,
            y,
            frame.heading - pose.heading,
            -rate * frame.radius / tas,
        )
        t += duration
    return table
