"""candidates(situation): every extremal that reaches the slot, whether or not it keeps d_min."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, delay_paths
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, WORDS, solve_and_measure
from relguide.planning.inputs import expect
from relguide.planning.situation import Pursuer, Situation
from relguide.planning.slot import SlotFrame, slot_frame
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

HORIZON: Second = 43_200.0
"""Plans longer than this are not given: 12 hours, longer than any aircraft's fuel lasts [s]. At
nearly equal speeds paths last up to 10¹⁸ s, and their lengths are nothing but rounding."""
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidates:
    """All candidates of a situation, and what is known without the separation limit."""

    situation: Situation
    leader: Trajectory
    """What the leader flies, `situation.leader.trajectory`: made once."""
    frame: SlotFrame
    rows: np.ndarray
    """The extremals that arrive after the slot opens, fastest first, as `solve` gives them: those
    within the horizon; if no other path is known, the first even if it is beyond."""
    at_release: tuple[Candidate, ...]
    """Paths that arrive exactly when the slot opens, all equally fast; fewest turns first."""
    reachable_at_release: bool
    """Whether the shortest path to where the slot opens is short enough to be there in time."""

    @property
    def bound(self) -> Second:
        """No path to the slot is faster than this, with or without the separation limit [s]."""
        time = self.frame.t_release if self.reachable_at_release else self.rows[0, 0]
        return float(time) * self.frame.radius / self.situation.pursuer.tas

    @property
    def later(self) -> Iterator[Candidate]:
        """Extremals that arrive after the slot opens, fastest first, each made when asked for."""
        for _, word, *amounts in self.rows.tolist():
            signs = SIGN_ROWS[int(word)]
            yield assemble(self.situation, self.frame, signs, amounts, WORDS[int(word)])

    def __len__(self) -> int:
        return len(self.at_release) + len(self.rows)

    def __iter__(self) -> Iterator[Candidate]:
        yield from self.at_release
        yield from self.later


def candidates(situation: Situation) -> Candidates:
    """Every extremal that reaches the slot, fastest first.

    With no separation limit the first is the global optimum; an empty answer means that the slot
    cannot be reached (possible only for V_L ≥ V_P).
    """
    expect("situation", situation, Situation)
    leader = situation.leader.trajectory
    frame = slot_frame(situation, leader)
    rows = np.empty((MAX_ROWS, 5))
    n, shortest = solve_and_measure(frame.x, frame.y, frame.h, frame.alpha, frame.t_release, rows)
    reachable = shortest <= frame.t_release + NO_TURN
    at_release = _at_release(situation, frame) if reachable else ()
    within = HORIZON * situation.pursuer.tas / frame.radius
    while n > (0 if at_release else 1) and rows[n - 1, 0] > within:
        n -= 1
    return Candidates(
        situation=situation,
        leader=leader,
        frame=frame,
        rows=rows[:n],
        at_release=at_release,
        reachable_at_release=reachable,
    )


def _at_release(situation: Situation, frame: SlotFrame) -> tuple[Candidate, ...]:
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n = delay_paths(frame.pose, frame.alpha, frame.t_release, paths)
    signs, amounts = paths[:, :n].tolist()
    found = [assemble(situation, frame, *pieces, "") for pieces in zip(signs, amounts, strict=True)]
    return tuple(sorted(found, key=_canonical_order))


def _canonical_order(candidate: Candidate) -> tuple[int, float]:
    """Fewest turns, then least turning."""
    trajectory = candidate.trajectory
    turning = sum(s.turn_angle for s in trajectory.segments if isinstance(s, Arc))
    return trajectory.turns, turning


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
    """A candidate from segments that lead to the slot; without a word, their letters are it."""
    trajectory = pursuer.flying(segments)
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


def segments_flown(radius: Metre, pieces: np.ndarray) -> tuple[Segment, ...]:
    """Pieces of `kernels.pieces` as segments.

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
