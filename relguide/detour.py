"""detour(candidates): the fastest way to the slot that touches d_min once."""

import numpy as np

from relguide.kernels.detour import GRAZE, best_detour
from relguide.situation import Situation
from relguide.slot import SlotFrame
from relguide.units import Second
from relguide.words import SIGN_ROWS, Candidate, Candidates, assemble

BEARINGS = 90
"""How finely the disc is scanned: every 4°. Twice as fine finds nothing better in golden cases."""


def detour(found: Candidates, *, beat: Second) -> Candidate | None:
    """The fastest way through one contact with d = d_min, if it arrives before `beat` [s].

    Its two halves are extremals without the limit, from the same complete enumeration of words; the
    contact's bearing is searched round the leader, for each piece of its intent and both sides.
    """
    situation, frame = found.situation, found.frame
    scale = frame.radius / situation.pursuer.tas
    limit = situation.min_separation / frame.radius
    if limit <= 0.0:
        return None
    way = np.zeros((2, 5))
    time = best_detour(
        frame.x, frame.y, frame.h, leader_table(situation, frame), frame.alpha,
        limit + GRAZE, frame.t_open, BEARINGS, beat / scale, way,
    )  # fmt: skip
    if time >= beat / scale:
        return None
    signs = [sign for row in way for sign in SIGN_ROWS[int(row[1])]]
    return assemble(situation, frame, signs, way[:, 2:].ravel().tolist(), "")


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
