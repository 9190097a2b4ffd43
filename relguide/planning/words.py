"""candidates(situation): every extremal that reaches the slot, whether or not it keeps d_min."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.word_bound import arrives_at_release
from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.words.delay import (
    DELAY_PIECES,
    MAX_DELAYS,
    straight_delays,
    turning_delays,
)
from relguide.kernels.words.extremals import MAX_ROWS, WORDS, solve_and_measure
from relguide.planning.candidate import SIGN_ROWS, Candidate, assemble
from relguide.planning.inputs import expect
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.trajectory import Trajectory
from relguide.units import Second

HORIZON: Second = 43_200.0
"""Plans longer than this are not given: 12 hours, longer than any aircraft's fuel lasts [s]. At
nearly equal speeds paths last up to 10¹⁸ s, and their lengths are nothing but rounding."""
_Pieces = tuple[list[float], list[float]]
"""ε, and turn angle [rad] or length [R], of each piece of a path."""


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
    straight_delays: list[_Pieces]
    """The pieces of the first of `at_release`: a straight takes up the time."""
    reachable_at_release: bool
    """Whether a path may be there just as it opens: in about one in a hundred situations the
    shortest is short enough, and yet none has that length."""

    @property
    def bound(self) -> Second:
        """No path to the slot is faster than this, with or without the separation limit [s]."""
        time = self.frame.t_release if self.reachable_at_release else self.rows[0, 0]
        return float(time) * self.frame.radius / self.situation.pursuer.tas

    @property
    def at_release(self) -> Iterator[Candidate]:
        """Paths that arrive exactly when the slot opens, all equally fast; fewest turns first.

        Each is made when asked for: there may be hundreds.
        """
        if self.reachable_at_release:
            for signs, amounts in self.straight_delays:
                yield assemble(self.situation, self.frame, signs, amounts, "")
            for signs, amounts in _turning_delays(self.frame):
                yield assemble(self.situation, self.frame, signs, amounts, "")

    @property
    def later(self) -> Iterator[Candidate]:
        """Extremals that arrive after the slot opens, fastest first, each made when asked for."""
        for _, word, *amounts in self.rows.tolist():
            signs = SIGN_ROWS[int(word)]
            yield assemble(self.situation, self.frame, signs, amounts, WORDS[int(word)])

    def __bool__(self) -> bool:
        return self.reachable_at_release or len(self.rows) > 0

    def __len__(self) -> int:
        turning = len(_turning_delays(self.frame)) if self.reachable_at_release else 0
        return len(self.straight_delays) + turning + len(self.rows)

    def __iter__(self) -> Iterator[Candidate]:
        yield from self.at_release
        yield from self.later


def candidates(situation: Situation) -> Candidates:
    """Every extremal that reaches the slot, fastest first.

    With no separation limit the first is the global optimum; an empty answer means that the slot
    cannot be reached (possible only for V_L ≥ V_P).

    Examples:
        >>> [found.word for found in rg.candidates(rg.scenario("fig_6b").situation)][:2]
        ['SRSR', 'RSRS']
    """
    expect("situation", situation, Situation)
    leader = situation.leader.trajectory
    frame = slot_frame(situation, leader)
    rows = np.empty((MAX_ROWS, 5))
    n, shortest = solve_and_measure(frame.x, frame.y, frame.h, frame.alpha, frame.t_release, rows)
    reachable = shortest <= frame.t_release + NO_TURN
    straight = _straight_delays(frame) if reachable or _is_in_slot(frame) else []
    if reachable and not straight:
        # the shortest path fits, and yet there may be none of just that length
        reachable = arrives_at_release(frame.x, frame.y, frame.h, frame.alpha, frame.t_release)
    elif not reachable and _is_in_slot(frame):
        reachable = bool(straight or _turning_delays(frame))
    within = HORIZON * situation.pursuer.tas / frame.radius
    while n > 1 and rows[n - 1, 0] > within:
        n -= 1
    if n == 1 and rows[0, 0] > within and reachable and (straight or _turning_delays(frame)):
        n = 0
    return Candidates(
        situation=situation,
        leader=leader,
        frame=frame,
        rows=rows[:n],
        straight_delays=straight,
        reachable_at_release=reachable,
    )


def _is_in_slot(frame: SlotFrame) -> bool:
    """Whether going straight just reaches the slot as it opens: a pursuer in it, and as fast."""
    straight = hypot(frame.alpha * frame.t_release - frame.x, frame.y)
    return frame.t_release > 0.0 and abs(straight - frame.t_release) <= NO_TURN


def _straight_delays(frame: SlotFrame) -> list[_Pieces]:
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n = straight_delays(frame.pose, frame.alpha, frame.t_release, paths)
    return _in_order(paths[:, :n])


def _turning_delays(frame: SlotFrame) -> list[_Pieces]:
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n = turning_delays(frame.pose, frame.alpha, frame.t_release, paths, 0)
    return _in_order(paths[:, :n])


def _in_order(paths: FloatArray) -> list[_Pieces]:
    signs, amounts = paths.tolist()
    return sorted(zip(signs, amounts, strict=True), key=_canonical_order)


def _canonical_order(pieces: _Pieces) -> tuple[int, float]:
    """Fewest turns, then least turning; counted as `segments_of` makes them."""
    turns, turning, last = 0, 0.0, 2.0
    for sign, amount in zip(*pieces, strict=True):
        if amount > NO_TURN:
            if sign != 0.0:
                turns += sign != last
                turning += amount
            last = sign
    return turns, turning
