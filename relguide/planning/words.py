"""candidates(situation): every extremal that reaches the slot, whether or not it keeps d_min."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

import numpy as np

from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, delay_paths
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
    release_paths: list[_Pieces]
    """The pieces of `at_release`."""
    reachable_at_release: bool
    """Whether the shortest path to where the slot opens is short enough to be there in time."""

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
        for signs, amounts in self.release_paths:
            yield assemble(self.situation, self.frame, signs, amounts, "")

    @property
    def later(self) -> Iterator[Candidate]:
        """Extremals that arrive after the slot opens, fastest first, each made when asked for."""
        for _, word, *amounts in self.rows.tolist():
            signs = SIGN_ROWS[int(word)]
            yield assemble(self.situation, self.frame, signs, amounts, WORDS[int(word)])

    def __len__(self) -> int:
        return len(self.release_paths) + len(self.rows)

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
    release_paths = _release_paths(frame) if reachable or _is_in_slot(frame) else []
    reachable = reachable or len(release_paths) > 0
    within = HORIZON * situation.pursuer.tas / frame.radius
    while n > (0 if release_paths else 1) and rows[n - 1, 0] > within:
        n -= 1
    return Candidates(
        situation=situation,
        leader=leader,
        frame=frame,
        rows=rows[:n],
        release_paths=release_paths,
        reachable_at_release=reachable,
    )


def _is_in_slot(frame: SlotFrame) -> bool:
    """Whether going straight just reaches the slot as it opens: a pursuer in it, and as fast."""
    straight = hypot(frame.alpha * frame.t_release - frame.x, frame.y)
    return frame.t_release > 0.0 and abs(straight - frame.t_release) <= NO_TURN


def _release_paths(frame: SlotFrame) -> list[_Pieces]:
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n = delay_paths(frame.pose, frame.alpha, frame.t_release, paths)
    signs, amounts = paths[:, :n].tolist()
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
