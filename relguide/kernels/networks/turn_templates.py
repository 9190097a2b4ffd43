"""Templates of constrained paths behind a leader who turns, and the guess that leads to a path.

As in `templates`: how a path reaches the disc, on which side it passes, and how it goes on.

    entry    a branch, which leads to a contact wherever the leader then is; or LS, RS, LR, RL,
             which touch the disc by themselves
    side     +1 counter-clockwise round the leader, −1 clockwise
    on       a branch; or LR, RL, two turns that touch at the contact by themselves; or D, a path of
             just the right length to the slot as it opens; or B, a boundary arc, and on from its
             end on the final leg by a straight and a turn

Four more have no parts: `FREE`, the fastest extremal that keeps the limit; `DELAYED`, a path that
arrives as the slot opens, without a contact; `SEVERAL`, paths through several contacts and other
rare ones; `NONE`, no path at all.

A guess is three numbers within about −1 … 3: cosine and sine of the contact's bearing from the
leader, then a quarter of its time; or of two pieces that touch, the first turn in π, less 1, how
far a boundary arc then goes round in π, and a quarter of the time for both; or of two turns from
the contact on, a quarter of the first, the last in π, less 1, and a quarter of the contact's time.
"""

from math import atan2, cos, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, DELAY, WORD
from relguide.kernels.networks.near_guess import (
    LR,
    LS,
    ON_B,
    ON_DELAY,
    ON_LR,
    ON_RL,
    RL,
    RS,
)
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.branches import BRANCHES, branch_of
from relguide.kernels.words.extremals import SIGNS, fly_piece

FREE, SEVERAL, NONE, DELAYED = 0, 1, 2, 3
GUESS = 3
"""How many numbers a guess is."""
QUARTER = 0.25
"""Of the times in it [V_P/R]."""
_ENTRIES = (*BRANCHES, "LS", "RS", "LR", "RL")
_ONWARD = {name: number for number, name in enumerate(BRANCHES)} | {
    "B": ON_B, "LR": ON_LR, "RL": ON_RL, "D": ON_DELAY,
}  # fmt: skip
CONTACTS = (
    ("RSL", -1, "LR"), ("LR", -1, "RSL"), ("LSR", 1, "D"), ("RSR", -1, "RLR long"),
    ("RL", 1, "LSR"), ("LSL", 1, "LRL long"), ("RSL", -1, "D"), ("RL", 1, "LRL long"),
    ("RSR", -1, "RSR"), ("LSR", 1, "RL"), ("LSL", -1, "LR"), ("LS", 1, "B"), ("LSL", 1, "LSL"),
    ("LSR", -1, "RLR long"), ("RS", -1, "B"), ("RSL", 1, "LRL long"), ("RSR", 1, "D"),
    ("RSL", 1, "LSL"), ("LR", 1, "D"), ("RS", 1, "B"), ("LR", -1, "RLR long"), ("LSR", -1, "RSR"),
    ("RL", -1, "D"), ("RSR", 1, "RL"), ("LRL long", 1, "LSL"), ("LSL", -1, "D"), ("RL", 1, "LSL"),
    ("RLR", 1, "RL"), ("RSR", -1, "LR"), ("LSL", 1, "RL"), ("RLR", 1, "D"), ("RLR long", -1, "RSR"),
    ("LS", -1, "B"), ("RSR", -1, "D"), ("LR", -1, "RSR"), ("LSR", -1, "D"), ("LR", 1, "B"),
    ("RSR", -1, "RLR"), ("RL", -1, "B"), ("LR", 1, "RLR long"), ("LSR", -1, "RLR"),
    ("LSL", 1, "LRL"), ("LSR", -1, "LR"), ("LRL", 1, "LR"), ("LR", 1, "RSL"), ("RL", -1, "LSR"),
    ("RSL", 1, "RL"), ("LRL", -1, "D"), ("LSL", 1, "D"), ("LRL", 1, "RL"), ("RSL", 1, "LRL"),
    ("LRL", 1, "LSR"), ("RSL", 1, "D"), ("RL", 1, "LRL"), ("LRL long", -1, "D"),
    ("RLR long", 1, "D"), ("RSL", 1, "LSR"), ("LRL", 1, "LRL long"), ("LS", 1, "D"),
    ("LR", 1, "LSL"), ("LRL", 1, "LSL"), ("RS", 1, "D"), ("RS", -1, "D"), ("RLR", 1, "LRL long"),
    ("LRL", -1, "LR"), ("LRL long", 1, "LR"), ("RLR", -1, "RSR"), ("RL", -1, "RSR"),
    ("LSL", 1, "LSR"), ("LRL", 1, "D"), ("LS", -1, "D"), ("LSL", -1, "LSL"), ("LR", -1, "RLR"),
    ("LRL", 1, "LRL"), ("RS", -1, "RLR long"), ("RLR", 1, "LSL"), ("LS", 1, "LRL long"),
    ("LR", 1, "RLR"),
)  # fmt: skip
"""Entry, side and on of the templates with a contact: all that were met 16 times in 102,000 paths.
"""
TEMPLATES = (
    "free",
    "several",
    "none",
    "delayed",
    *(f"{entry} {'left' if side > 0 else 'right'} {on}" for entry, side, on in CONTACTS),
)
"""Templates by their number; left and right is where the leader is passed: the disc's side."""
SIZE = len(TEMPLATES)
PARTS = np.array([(-1, 0, -1)] * 4 + [(_ENTRIES.index(e), s, _ONWARD[o]) for e, s, o in CONTACTS])
"""Numbers of entry, side and on of each template. shape (SIZE, 3)"""
_NO_TURN = 0.02  # boundary arcs are begun and ended a little aside of where pieces touch
_ALMOST_NONE = 3e-3  # of three pieces the one that two that touch by themselves do without


@njit(cache=True, nogil=True)
def turn_template_number(entry: int, side: int, on: int) -> int:
    """The number of the template with these parts; `SEVERAL` if it is not one of them."""
    for template in range(4, SIZE):
        parts = PARTS[template]
        if parts[0] == entry and parts[1] == side and parts[2] == on:
            return template
    return SEVERAL


@njit(cache=True, nogil=True)
def turn_template_of(start: Pose, scene: Scene, legs: FloatArray, guess: FloatArray) -> int:
    """The template of a path, and the guess that leads to it.

    Args:
        start: where the path begins.
        scene: a leader that turns once.
        legs: the path, as `chain.Chain`; no rows if there is none. shape (n, 6)
        guess: takes its numbers; 0 where the template needs none. shape (GUESS,)

    Returns:
        its number in `TEMPLATES`.
    """
    guess[:] = 0.0
    count = len(legs)
    if count == 0:
        return NONE
    if count == 1:
        return DELAYED if legs[0, 0] == DELAY else FREE
    if legs[0, 0] != WORD:
        return SEVERAL
    bearing, side, t = _contact_after(start, scene, legs[0, 1:6])
    slides = count == 3 and legs[1, 0] == BOUNDARY_ARC
    entry = _touching_entry(legs[0, 1:6], _NO_TURN if slides else _ALMOST_NONE, guess)
    if count == 2 and legs[1, 0] != BOUNDARY_ARC:
        if entry < 0:
            entry = branch_of(legs[0, 1:6])
            guess[0], guess[1] = cos(bearing), sin(bearing)
        guess[2] = QUARTER * t
        on = ON_DELAY if legs[1, 0] == DELAY else branch_of(legs[1, 1:6])
        if legs[1, 0] == WORD and entry < LS:
            on = _touching_end(legs[1, 1:6], on, guess)
        return turn_template_number(entry, side, on)
    last = len(scene.leader) - 1
    if entry >= 0 and slides and legs[2, 0] == WORD:
        if legs[1, 4] == last and _straight_and_turn(legs[2, 1:6], legs[1, 1]):
            guess[1], guess[2] = (legs[1, 3] - legs[1, 2]) / pi, QUARTER * t
            return turn_template_number(entry, int(legs[1, 1]), ON_B)
    return SEVERAL


@njit(cache=True, nogil=True)
def _contact_after(start: Pose, scene: Scene, row: FloatArray) -> tuple[float, int, float]:
    """Bearing, side and time of the contact to which a word leads."""
    pose, t = start, 0.0
    for k in range(3):
        pose = fly_piece(pose, SIGNS[int(row[1]), k], row[2 + k])
        t += row[2 + k]
    at = leader_at(scene, piece_at(scene.leader, t), t)
    x, y = pose.x - at.x, pose.y - at.y
    vx, vy = cos(pose.h) - scene.alpha * cos(at.h), sin(pose.h) - scene.alpha * sin(at.h)
    return atan2(y, x) - at.h, 1 if x * vy - y * vx > 0.0 else -1, t


@njit(cache=True, nogil=True)
def _touching_entry(row: FloatArray, no_turn: float, guess: FloatArray) -> int:
    """LS, RS, LR or RL if a word is two pieces that touch by themselves, −1 if it is three.

    After a straight a last turn below `no_turn` is none. `guess` takes what is guessed of the first
    turn.
    """
    word, first = int(row[1]), row[2]
    left, entry = SIGNS[word, 0] > 0.0, -1
    if word < 4:
        if row[4] < no_turn:
            entry = LS if left else RS
        elif word >= 2 and row[3] < _ALMOST_NONE:
            entry = LR if left else RL
    elif row[4] < _ALMOST_NONE:
        entry = LR if left else RL
    elif first < _ALMOST_NONE:
        first, entry = row[3], RL if left else LR
    if entry >= 0:
        guess[0] = first / pi - 1.0
    return entry


@njit(cache=True, nogil=True)
def _touching_end(row: FloatArray, branch: int, guess: FloatArray) -> int:
    """How a path goes on: ON_LR or ON_RL if by two turns that touch by themselves, else its branch.

    `guess` takes what is guessed of the two turns.
    """
    word, first = int(row[1]), row[3]
    two, on = word >= 4 and row[2] < _ALMOST_NONE, branch
    if 2 <= word < 4 and row[3] < _ALMOST_NONE:
        two, first = True, row[2]
    if two:
        on = ON_RL if SIGNS[word, 2] > 0.0 else ON_LR
    if on != branch:
        guess[0], guess[1] = QUARTER * first, row[4] / pi - 1.0
    return on


@njit(cache=True, nogil=True)
def _straight_and_turn(row: FloatArray, side: float) -> bool:
    """Whether a word is a straight and a turn to this side."""
    return bool(row[2] < _NO_TURN and row[1] < 4.0 and SIGNS[int(row[1]), 2] == side)
