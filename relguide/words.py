"""candidates(situation): every extremal that reaches the slot, whether or not it keeps d_min."""

from dataclasses import dataclass
from math import hypot

import numpy as np

from relguide.frames import SlotFrame, slot_frame
from relguide.kernels.extremals import MAX_ROWS, SIGNS, WORDS, solve
from relguide.kernels.hold import HOLD_PIECES, MAX_HOLDS, holds
from relguide.situation import Situation
from relguide.trajectory import LEFT, RIGHT, Arc, Segment, Straight, Trajectory
from relguide.units import Second

NO_TURN = 1e-9
"""A turn below this is rounding [rad]; likewise a straight, in R."""


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

    at_opening: tuple[Candidate, ...]
    """Paths that arrive exactly when the slot opens, all equally fast; fewest turns first."""
    later: tuple[Candidate, ...]
    """Extremals that arrive after it opens, fastest first; the first is the best, proved."""
    slot_opens: Second
    """t_open: no arrival before this counts [s]."""
    reachable_at_opening: bool
    """Whether the shortest way to the slot's place at t_open is short enough to be there then."""

    @property
    def in_order(self) -> tuple[Candidate, ...]:
        """All of them, fastest first."""
        return self.at_opening + self.later


def candidates(situation: Situation) -> tuple[Candidate, ...]:
    """Every extremal that reaches the slot, fastest first.

    With no separation limit the first is the global optimum; an empty answer means that the slot
    cannot be reached (possible only for V_L ≥ V_P).
    """
    return all_candidates(situation).in_order


def all_candidates(situation: Situation) -> Candidates:
    """As `candidates`, with what is known of the slot's opening."""
    frame = slot_frame(situation, situation.leader.trajectory)
    scale = frame.radius / situation.pursuer.tas
    rows = np.empty((MAX_ROWS, 5))
    later = tuple(
        _candidate(situation, frame, SIGNS[int(row[1])], row[2:], WORDS[int(row[1])])
        for row in rows[: solve(frame.x, frame.y, frame.h, frame.alpha, frame.t_open, rows)]
    )
    at_opening: tuple[Candidate, ...] = ()
    reachable = False
    if frame.t_open > 0.0:
        reachable = _dubins_length(frame) <= frame.t_open + NO_TURN
        if reachable:
            at_opening = _at_opening(situation, frame, first_turns=False)
    return Candidates(
        at_opening=at_opening,
        later=later,
        slot_opens=frame.t_open * scale,
        reachable_at_opening=reachable,
    )


def detours_at_opening(situation: Situation) -> tuple[Candidate, ...]:
    """More paths that arrive exactly when the slot opens: those that begin with one more turn.

    For when none of `Candidates.at_opening` keeps d_min; fewest turns first. Costs some 20 ms.
    """
    return _at_opening(
        situation, slot_frame(situation, situation.leader.trajectory), first_turns=True
    )


def _at_opening(
    situation: Situation, frame: SlotFrame, *, first_turns: bool
) -> tuple[Candidate, ...]:
    signs = np.empty((MAX_HOLDS, HOLD_PIECES))
    amounts = np.empty((MAX_HOLDS, HOLD_PIECES))
    n = holds(frame.x, frame.y, frame.h, frame.alpha, frame.t_open, first_turns, signs, amounts)
    found = [_candidate(situation, frame, signs[i], amounts[i], "") for i in range(n)]
    return tuple(sorted(found, key=_canonical_order))


def _canonical_order(candidate: Candidate) -> tuple[int, float]:
    """Fewest turns, then least turning."""
    trajectory = candidate.trajectory
    turning = sum(s.turn_angle for s in trajectory.segments if isinstance(s, Arc))
    return trajectory.turns, turning


def _dubins_length(frame: SlotFrame) -> float:
    """Shortest way to the slot's place at t_open [R]: the extremals to a slot at rest."""
    end_x = frame.alpha * frame.t_open
    if hypot(end_x - frame.x, frame.y) > frame.t_open:
        return float("inf")
    rows = np.empty((MAX_ROWS, 5))
    solve(frame.x - end_x, frame.y, frame.h, 0.0, 0.0, rows)
    return float(rows[0, 0])


def _candidate(
    situation: Situation, frame: SlotFrame, signs: np.ndarray, amounts: np.ndarray, word: str
) -> Candidate:
    segments: list[Segment] = []
    for sign, amount in zip(signs.tolist(), amounts.tolist(), strict=True):
        if amount <= NO_TURN:
            continue
        if sign == 0.0:
            segments.append(Straight(length=amount * frame.radius))
        else:
            turn = LEFT if sign > 0.0 else RIGHT
            segments.append(Arc(turn=turn, turn_angle=amount, radius=frame.radius))
    pursuer = situation.pursuer
    trajectory = Trajectory(
        x=pursuer.x,
        y=pursuer.y,
        heading=pursuer.heading,
        tas=pursuer.tas,
        segments=tuple(segments),
    )
    return Candidate(word=word or trajectory.letters, trajectory=trajectory)
