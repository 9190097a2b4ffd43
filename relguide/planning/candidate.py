"""A path that reaches the slot: pieces of the slot frame made the pursuer's trajectory."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.words.extremals import SIGNS
from relguide.planning.aircraft import Pursuer
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.trajectory import (
    LEFT,
    RIGHT,
    Arc,
    BoundaryArc,
    Segment,
    Straight,
    Trajectory,
)
from relguide.units import Metre, Second

SIGN_ROWS: list[list[float]] = SIGNS.tolist()
"""`SIGNS` as lists."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """A word with its solved lengths: it reaches the slot, open and on the leader's heading."""

    word: str
    """Its letters in the order flown, e.g. `"LSR"`."""
    trajectory: Trajectory
    """In the air mass."""

    @property
    def time_to_converge(self) -> Second:
        """T [s]."""
        return self.trajectory.duration


def assemble(
    situation: Situation, frame: SlotFrame, signs: list[float], amounts: list[float], word: str
) -> Candidate:
    """A path of the slot frame as the pursuer's trajectory.

    Args:
        situation: gives the pursuer.
        frame: its slot frame.
        signs: ε of each piece, 0 for straights.
        amounts: turn angles [rad] and lengths [R].
        word: its name; the letters of its segments if empty.
    """
    return candidate_of(situation.pursuer, segments_of(frame.radius, signs, amounts), word)


def candidate_of(pursuer: Pursuer, segments: tuple[Segment, ...], word: str = "") -> Candidate:
    """A candidate from segments that lead to the slot; without a word, their letters are it.

    The segments are known to be sound: all come from kernels.
    """
    trajectory = Trajectory.of_sound(pursuer.x, pursuer.y, pursuer.heading, pursuer.tas, segments)
    return Candidate(word=word or trajectory.letters, trajectory=trajectory)


def segments_of(
    radius: Metre, signs: Sequence[float], amounts: Sequence[float]
) -> tuple[Segment, ...]:
    """Pieces of the slot frame as segments; rounding is left out, equal neighbours are joined.

    Args:
        radius: R [m].
        signs: ε of each piece, 0 for straights.
        amounts: turn angles [rad] and lengths [R].
    """
    segments: list[Segment] = []
    last = 2.0
    for sign, amount in zip(signs, amounts, strict=True):
        if amount <= NO_TURN:
            continue
        if sign == last:  # two pieces that meet in a contact may be one turn, or one straight
            amount += segments.pop().length / radius
        if sign == 0.0:
            segments.append(Straight(length=amount * radius))
        else:
            turn = LEFT if sign > 0.0 else RIGHT
            segments.append(Arc(turn=turn, turn_angle=amount, radius=radius))
        last = sign
    return tuple(segments)


def segments_of_pieces(radius: Metre, pieces: np.ndarray) -> tuple[Segment, ...]:
    """Pieces of a constrained path as segments.

    Args:
        radius: R [m].
        pieces: a column each, as `pieces_of` gives them. shape (3, n)
    """
    boundary_arcs, bends, amounts = pieces.tolist()
    segments: list[Segment] = []
    at = 0
    while at < len(boundary_arcs):
        boundary_arc, bend, amount = boundary_arcs[at], bends[at], amounts[at]
        end = at + 1
        if boundary_arc != 0.0:
            end = at + boundary_arcs.count(boundary_arc)
            arcs = tuple(zip(amounts[at:end], bends[at:end], strict=True))
            segments.append(BoundaryArc(side=LEFT if boundary_arc > 0.0 else RIGHT, bends=arcs))
        elif bend == 0.0:
            segments.append(Straight(length=amount))
        else:
            turn = LEFT if bend > 0.0 else RIGHT
            segments.append(Arc(turn=turn, turn_angle=amount, radius=radius))
        at = end
    return tuple(segments)
