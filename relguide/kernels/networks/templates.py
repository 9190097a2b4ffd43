"""Kinds of ways round the limit: what a network chooses among; how they are told.

A kind says how a way comes to the disc, on which side it passes, and how it goes on:

    entry    a branch (see `near_guess`); or LS, RS, LR, RL, which touch the disc by themselves
    side     +1 counter-clockwise round the leader, −1 clockwise
    on       a branch; or LR, RL, which touch the disc by themselves; or a boundary arc along the
    disc, and
             on by a straight and a turn; or a turn and a straight to such a boundary arc; or a
             boundary arc, a straight and a turn to one more contact, and on from there

Three more touch nothing, or more than can be told: `FREE`, the fastest extremal that keeps the
limit; `SEVERAL`, ways through several contacts and other rare ones; `NONE`, no way at all.

A guess is two numbers within about −1 … 1: cosine and sine of the bearing of the one contact that
is not fixed by itself; else the two turns that touch the disc by themselves, in π and less 1.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, cos, hypot, inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, WORD
from relguide.kernels.networks.near_guess import (
    AGAIN_ARCS,
    ARCS_AGAIN,
    ARCS_ON,
    LR,
    ON_LR,
    ON_RL,
    RL,
)
from relguide.kernels.words.branches import BRANCHES, branch_of
from relguide.kernels.words.extremals import SIGNS, fly_piece

FREE, SEVERAL, NONE = 0, 1, 2
ENTRIES = (*BRANCHES, "LS", "RS", "LR", "RL")
"""How a way may come to the disc, by number."""
ONWARD = (*BRANCHES, "B", "LR", "RL", "touch, B", "B, touch")
"""And how it may go on."""
CONTACTS = (
    ("LS", 1, "B"), ("RS", 1, "B"), ("LR", 1, "B"), ("LS", -1, "B"),
    ("RS", -1, "B"), ("RSR", -1, "RLR long"), ("LSR", -1, "RLR long"), ("LSL", 1, "LSL"),
    ("RSL", 1, "LSL"), ("LRL", 1, "LSL"), ("LRL long", 1, "LSL"), ("LSL", -1, "LSL"),
    ("RSR", 1, "LSL"), ("LSR", 1, "LSL"), ("RSR", -1, "RSR"), ("LSR", -1, "RSR"),
    ("RLR long", -1, "RSR"), ("RSR", -1, "RLR"), ("LSR", -1, "RLR"), ("LSL", 1, "RSL"),
    ("RSL", 1, "RSL"), ("LRL", 1, "RSL"), ("LRL long", 1, "RSL"), ("RSR", 1, "RSL"),
    ("LSL", 1, "LRL long"), ("RSL", 1, "LRL long"), ("RSL", -1, "LR"), ("LSL", -1, "LR"),
    ("RSR", -1, "LR"), ("LSR", -1, "LR"), ("RSR", 1, "RL"), ("LSR", 1, "RL"), ("RSL", 1, "RL"),
    ("LR", 1, "RSL"), ("LR", 1, "LSL"), ("LR", -1, "RLR long"), ("LR", -1, "RLR"),
    ("LR", -1, "RSR"), ("LR", -1, "RSL"), ("RL", 1, "LSR"), ("RL", 1, "LSL"),
    ("RL", 1, "LRL long"), ("RL", -1, "LRL"), ("LSL", 1, "touch, B"),
    ("RSL", 1, "touch, B"), ("LRL", 1, "touch, B"), ("LRL long", 1, "touch, B"),
    ("RSR", -1, "touch, B"), ("LS", 1, "B, touch"), ("RS", 1, "B, touch"),
    ("LS", -1, "B, touch"), ("RS", -1, "B, touch"),
)  # fmt: skip
"""Entry, side and on of the kinds with a contact: all that were met
more than once in 20,000 ways."""
TEMPLATES = (
    "free",
    "several",
    "none",
    *(f"{entry} {'left' if side > 0 else 'right'} {on}" for entry, side, on in CONTACTS),
)
"""The kinds by their number; left and right is where the leader is passed: the disc's side."""
SIZE = len(TEMPLATES)
PARTS = np.array(
    [(-1, 0, -1)] * 3 + [(ENTRIES.index(e), s, ONWARD.index(o)) for e, s, o in CONTACTS]
)
"""Numbers of entry, side and on of each kind. shape (SIZE, 3)"""
_NO_TURN = 1e-4  # pieces shorter than this end where two turns touch the disc by themselves
_ALMOST_NO_STRAIGHT = 3e-3  # the search ends here in such a contact: nothing is gained further on
_LOOKS = 64  # along a turn, for where it touches
_ALMOST = 0.02  # and before and behind a boundary arc, which is begun and ended a little aside


@njit(cache=True, nogil=True)
def _template_number(entry: int, side: int, on: int) -> int:
    for kind in range(3, SIZE):
        if PARTS[kind, 0] == entry and PARTS[kind, 1] == side and PARTS[kind, 2] == on:
            return kind
    return SEVERAL


@njit(cache=True, nogil=True)
def template_of(
    x: float, y: float, h: float, slot: float, alpha: float, count: int, legs: FloatArray,
    guess: FloatArray,
) -> int:  # fmt: skip
    """The kind of a way, and the guess that leads to it.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        slot: D [R].
        alpha: V_L/V_P.
        count: how many legs it has; 0 if there is none.
        legs: the legs, as `chain.fly_links`. shape (≥ count, 6)
        guess: takes two numbers; 0 where the kind needs none. shape (2,)
    """
    guess[:] = 0.0
    if count == 0:
        return NONE
    if count == 1:
        return FREE
    row, last = legs[0, 1:6], legs[count - 1, 1:6]
    entry = branch_of(row)
    first_turn = 0 if SIGNS[int(row[1]), 0] > 0.0 else 1
    if 3 <= count <= 4 and (legs[1, 0] == BOUNDARY_ARC or legs[2, 0] == BOUNDARY_ARC):
        side = int(legs[1, 1] if legs[1, 0] == BOUNDARY_ARC else legs[2, 1])
        same = 0.0 if side > 0 else 1.0  # the word of two turns to that side
        own = SIGNS[int(last[1]), 2] == side
        if legs[1, 0] == BOUNDARY_ARC and row[4] < _ALMOST:
            if count == 3 and last[2] < _ALMOST and last[1] < 4.0 and own:
                if entry >= 4:
                    guess[0], guess[1] = row[2] / pi - 1.0, row[3] / pi - 1.0
                return _template_number(
                    8 + first_turn if entry < 4 else LR + first_turn, side, ARCS_ON
                )
            if count == 4 and entry < 4 and last[1] == same and legs[2, 0] == WORD:
                # bearing of the second contact: from where the last word begins
                bearing = _contact_before(last, slot, alpha)
                guess[0], guess[1] = cos(bearing), sin(bearing)
                return _template_number(8 + first_turn, side, ARCS_AGAIN)
            return SEVERAL
        if (
            (count == 3) == (legs[1, 0] == BOUNDARY_ARC)
            and last[2] < _ALMOST
            and last[1] < 4.0
            and own
        ):
            bearing, _ = _touch_on_last(x - slot, y, h, alpha, row, count == 3)
            guess[0], guess[1] = cos(bearing), sin(bearing)
            return _template_number(entry, side, AGAIN_ARCS)
        return SEVERAL
    if count != 2 or legs[1, 0] != WORD:
        return SEVERAL
    bearing, side = _touch_on_last(x - slot, y, h, alpha, row, False)
    on = branch_of(last)
    if 2 <= entry < 4 and row[3] < _ALMOST_NO_STRAIGHT:
        guess[0], guess[1] = row[2] / pi - 1.0, row[4] / pi - 1.0
        return _template_number(LR if entry == 2 else RL, side, on)
    if row[4] < _NO_TURN and entry >= 4:
        guess[0], guess[1] = row[2] / pi - 1.0, row[3] / pi - 1.0
        return _template_number(LR if entry < 6 else RL, side, on)
    if row[2] < _NO_TURN and entry >= 4:
        guess[0], guess[1] = row[3] / pi - 1.0, row[4] / pi - 1.0
        return _template_number(RL if entry < 6 else LR, side, on)
    if last[2] < _NO_TURN and on >= 4:
        guess[0], guess[1] = last[3] / pi - 1.0, last[4] / pi - 1.0
        return _template_number(entry, side, ON_RL if on < 6 else ON_LR)
    if 2 <= on < 4 and last[3] < _ALMOST_NO_STRAIGHT:
        guess[0], guess[1] = last[2] / pi - 1.0, last[4] / pi - 1.0
        return _template_number(entry, side, ON_LR if on == 2 else ON_RL)
    guess[0], guess[1] = cos(bearing), sin(bearing)
    return _template_number(entry, side, on)


@njit(cache=True, nogil=True)
def _contact_before(row: FloatArray, slot: float, alpha: float) -> float:
    """The bearing of the contact where a last word begins: flown back from the slot."""
    px, py, ph, t = alpha * row[0], 0.0, 0.0, row[0]
    for k in range(2, -1, -1):
        # backward a turn is one to the other side, of the opposite heading
        bx, by, bh = fly_piece(Pose(px, py, ph + pi), -SIGNS[int(row[1]), k], row[2 + k])
        px, py, ph, t = bx, by, bh - pi, t - row[2 + k]
    return atan2(py, px - slot)


@njit(cache=True, nogil=True)
def _touch_on_last(
    px: float, py: float, h: float, alpha: float, row: FloatArray, inside: bool
) -> tuple[float, int]:
    """Where a word touches the disc: at its end, or inside of its last turn. Bearing and side."""
    ph = h
    for k in range(2):
        px, py, ph = fly_piece(Pose(px, py, ph), SIGNS[int(row[1]), k], row[2 + k])
    px -= alpha * (row[2] + row[3])
    sign = SIGNS[int(row[1]), 2]
    best, bearing, side = inf, 0.0, 1
    # it ends there on a boundary arc: the last of the turn is left out of the search
    last = 0.9 * row[4] if inside else row[4]
    for k in range(_LOOKS + 1):
        turned = last * k / _LOOKS if inside else last
        qx, qy, qh = fly_piece(Pose(px, py, ph), sign, turned)
        qx -= alpha * turned
        if hypot(qx, qy) < best:
            best, bearing = hypot(qx, qy), atan2(qy, qx)
            side = 1 if qx * sin(qh) - qy * (cos(qh) - alpha) > 0.0 else -1
        if not inside:
            break
    return bearing, side
