"""Chains beside a refined one, round a leader that turns: what all moves to them share.

The arrival of a chain has a cliff where a turn between two contacts would have to be less than
none, since it is a full one there. The least arrival often lies at the foot of one cliff, or of
two, and they move with the time at which the contacts are reached. So bearings that are moved one
after another get stuck. Four moves change more than a bearing, and refine the chain again:
`more_arcs`, `other_words`, `touch_and_slide` and `begun_nearby`.

All take a chain and its arrival, and return those of the best. Slot frame: lengths in R, times in
R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from typing import NamedTuple

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray

WORTH = 1e-4
"""How much sooner a chain has to be [R/V_P]: 5 ms."""
LATER = 0.3
"""A chain that is so much later at first is not refined [R/V_P] …"""
LATE = 0.1
"""… nor one that is so much later with the bearings beside the change moved [R/V_P] …"""
STILL_LATER = 0.03
"""… nor one that is so much later once it has been moved roughly [R/V_P]."""
SHORT = 0.05
"""A boundary arc as it is begun [rad]."""
MOMENT = 1e-3
"""So soon a path has not left [R/V_P]."""


class Task(NamedTuple):
    """What chains are flown for, and how they are refined."""

    start: Pose
    """Where they begin, at t = 0."""
    scene: Scene
    """What they have to reckon with."""
    stride: float
    """How far bearings are moved at first [rad]."""
    legs: FloatArray
    """Room. shape (MAX_LEGS, 6)"""
