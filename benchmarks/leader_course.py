"""The leader's intent as direct transcription takes it: straights and turns in turn.

Worked out here from the trajectory, and not from the tables that the planner's searches use.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from typing import NamedTuple

from relguide import Situation
from relguide.planning.slot import SlotFrame


class Turn(NamedTuple):
    """A turn of the leader's, and the straight before it."""

    before: float
    """How long it keeps straight first [R/V_P]."""
    rate: float
    """Turn rate, left positive, not 0 [V_P/R]."""
    lasts: float
    """[R/V_P]; 0 if there is none."""


NO_TURN = Turn(0.0, 1.0, 0.0)


class Course(NamedTuple):
    """What the leader flies."""

    x: float
    """Where it is at t = 0, ahead of the slot [R]."""
    y: float
    """To the left of it [R]."""
    h: float
    """Its heading then, from the final one [rad]."""
    turns: tuple[Turn, ...]

    @property
    def ends(self) -> float:
        """When its final leg begins [R/V_P]."""
        return sum(turn.before + turn.lasts for turn in self.turns)

    def padded(self, turns: int) -> list[float]:
        """All of it as one list, with so many turns."""
        spare = turns - len(self.turns)
        if spare < 0:
            raise ValueError(f"The leader turns {len(self.turns)} times, not {turns} at most.")
        every = (*self.turns, *spare * (NO_TURN,))
        return [self.x, self.y, self.h, *(number for turn in every for number in turn)]


def course_of(situation: Situation, frame: SlotFrame) -> Course:
    """The course of a situation's leader."""
    leader, unit = situation.leader, frame.radius / situation.pursuer.tas
    path = leader.trajectory
    turns, before = [], 0.0
    for duration, rate in zip(path.durations(), path.turn_rates(), strict=True):
        if rate == 0.0:
            before += duration / unit
        else:
            turns.append(Turn(before, -rate * unit, duration / unit))
            before = 0.0
    x, y = frame.to_slot(leader.x, leader.y)
    return Course(x, y, frame.heading - leader.heading, tuple(turns))
