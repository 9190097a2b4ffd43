"""turning_times(situations, intents): times behind leaders that turn, where cheap tests prove them.

What they leave undecided, one airliner's situation in a hundred, is for `plan`.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.angles import FULL_TURN_SLACK, TWO_PI
from relguide.kernels.maps import turning_rows as kernel
from relguide.planning import limits
from relguide.planning.batch import Floats, Situations
from relguide.planning.intent import ROUNDED
from relguide.planning.words import HORIZON
from relguide.units import DEG


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Intents:
    """What leaders have declared, as columns: the pieces of all of them, one after another."""

    counts: NDArray[np.int64]
    """How many pieces each has. shape (n,)"""
    pieces: Floats
    """ε, 0 for a straight; the heading at its end [rad], or how long the straight is flown [s]; |φ|
    of the turn [rad]. shape (m, 3)"""

    def can_be_flown(self) -> NDArray[np.bool_]:
        """Which of them can be flown, to be sure: shape (n,)."""
        turns = self.pieces[:, 0] != 0.0
        amounts, banks = self.pieces[:, 1], self.pieces[:, 2] / DEG
        fine = np.where(
            turns,
            limits.HEADING.admits(amounts) & limits.BANK.admits(banks),
            limits.PIECE.admits(amounts),
        )
        good = self.counts <= limits.MAX_PIECES
        good[np.repeat(np.arange(len(self.counts)), self.counts)[~fine]] = False
        return good

    def final_headings(self, headings: Floats) -> Floats:
        """Where they lead from these headings, clockwise from north [rad], of shape (n,)."""
        final = headings.copy()
        turns = self.pieces[:, 0] != 0.0
        # of several that are put in one place the last stays
        final[np.repeat(np.arange(len(self.counts)), self.counts)[turns]] = self.pieces[turns, 1]
        return final

    def unrounded(self, headings: Floats) -> "Intents":
        """The same from these headings, but turns that miss a full one by rounding the other way.

        As `Leader.trajectory` has them; see `ROUNDED`.
        """
        turns = np.flatnonzero(self.pieces[:, 0])
        whose = np.repeat(np.arange(len(self.counts)), self.counts)[turns]
        before, to = headings[whose], self.pieces[turns, 1]
        again = np.flatnonzero(np.diff(whose) == 0)
        before[again + 1] = to[again]
        missing = np.mod(self.pieces[turns, 0] * (to - before), TWO_PI)
        around = turns[(missing > FULL_TURN_SLACK) & (missing < ROUNDED)]
        pieces = self.pieces.copy()
        pieces[around, 0] *= -1.0
        return Intents(counts=self.counts, pieces=pieces)

    def __getitem__(self, rows: NDArray[np.bool_]) -> "Intents":
        """Some of them, by a mask."""
        pieces = self.pieces[np.repeat(rows, self.counts)]
        return Intents(counts=self.counts[rows], pieces=pieces)


class TurningTimes(NamedTuple):
    """Answers to situations with intents, in columns of one length n."""

    time_to_converge: Floats
    """T of the optimum [s]; infinite where it is not decided. shape (n,)"""
    decided: NDArray[np.bool_]
    """Whether T is the optimum, proved. shape (n,)"""
    already_lost: NDArray[np.bool_]
    """Whether the aircraft are too close from the start. shape (n,)"""


def can_be_flown(situations: Situations, intents: Intents) -> NDArray[np.bool_]:
    """Which situations can be flown, to be sure: shape (n,). `Situation` says what is wrong."""
    headings = np.asarray(situations.leader_heading)
    final = replace(situations, leader_heading=intents.final_headings(headings))
    # the leader must make headway on its final leg alone
    return intents.can_be_flown() & limits.HEADING.admits(headings) & final.can_be_flown()


def turning_times(situations: Situations, intents: Intents) -> TurningTimes:
    """The time to each slot, as `plan` gives it, where a simple path is proved to be the optimum.

    Args:
        situations: as columns that can be flown.
        intents: of their leaders, as many.
    """
    rows = np.column_stack(situations.full_columns())
    starts = np.concatenate((np.zeros(1, np.int64), np.cumsum(intents.counts)))
    answers = np.empty((len(rows), 2))
    headings = np.broadcast_to(np.asarray(situations.leader_heading), len(rows))
    pieces = intents.unrounded(headings).pieces
    kernel.turning_rows(rows, starts, pieces, HORIZON, answers)
    return TurningTimes(
        answers[:, 0], answers[:, 1] == kernel.OPTIMUM, answers[:, 1] == kernel.ALREADY_LOST
    )
