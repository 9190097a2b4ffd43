"""Templates: the kinds of constrained paths among which a network chooses.

A template says how a path reaches the disc, on which side it passes, and how it goes on:

    entry    a branch (see `near_guess`); or LS, RS, LR, RL, which touch the disc by themselves
    side     +1 counter-clockwise round the leader, −1 clockwise
    on       a branch; or LR, RL, which touch the disc by themselves; or B, a boundary arc along the
             disc, and on by a straight and a turn; or a turn and a straight to such a boundary arc;
             or a boundary arc, a straight and a turn to one more contact, and on from there

Three more have no parts: `FREE`, the fastest extremal that keeps the limit; `SEVERAL`, paths
through several contacts and other rare ones; `NONE`, no path at all.

A guess is two numbers within about −1 … 1: cosine and sine of the bearing of the one contact that
is not fixed by itself; or else the two turns that touch the disc by themselves, in π and less 1.
"""

import numpy as np
from numba import njit

from relguide.kernels.words.branches import BRANCHES

FREE, SEVERAL, NONE = 0, 1, 2
ENTRIES = (*BRANCHES, "LS", "RS", "LR", "RL")
"""How a path may reach the disc, by number."""
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
"""Entry, side and on of the templates with a contact: all that were met more than once in 20,000
paths."""
TEMPLATES = (
    "free",
    "several",
    "none",
    *(f"{entry} {'left' if side > 0 else 'right'} {on}" for entry, side, on in CONTACTS),
)
"""Templates by their number; left and right is where the leader is passed: the disc's side."""
SIZE = len(TEMPLATES)
PARTS = np.array(
    [(-1, 0, -1)] * 3 + [(ENTRIES.index(e), s, ONWARD.index(o)) for e, s, o in CONTACTS]
)
"""Numbers of entry, side and on of each template. shape (SIZE, 3)"""


@njit(cache=True, nogil=True)
def template_number(entry: int, side: int, on: int) -> int:
    """The number of the template with these parts; `SEVERAL` if it is not one of them."""
    for template in range(3, SIZE):
        parts = PARTS[template]
        if parts[0] == entry and parts[1] == side and parts[2] == on:
            return template
    return SEVERAL
