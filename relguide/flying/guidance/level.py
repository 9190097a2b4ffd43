"""The level that a pursuer flies at: its leader's, to which it goes at once, and then with it.

A leader that declares its changes is followed to the declared level at once; else to where it will
be some seconds from now, and only when it is time to: higher up the same airspeed indicated is a
higher true one. The rate is the leader's, and more or less by what lacks in height, so that both
level off together.
"""

from typing import NamedTuple

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.memory import Memory
from relguide.planning.levels import CLIMB_RATE, level_rate
from relguide.units import FT, Metre, MetrePerSecond, Second

NEAR: Metre = 100.0 * FT
"""A level so near is kept [m]: altimeters differ by as much."""
CLIMBS: MetrePerSecond = 200.0 * FT / 60.0
"""A leader that climbs or descends faster changes its level [m/s]."""
STEEPEST: MetrePerSecond = 4_000.0 * FT / 60.0
"""No faster change is asked for [m/s]."""
AHEAD: Second = 20.0
"""An undeclared climb or descent is followed to where it leads in so long [s]."""
GOES_DOWN_BY: MetrePerSecond = 5.0
"""By so much more than its leader a pursuer can climb or descend at the least [m/s]."""
BEFORE: Second = 60.0
"""So long before it joins it is to be at the leader's level [s]."""
MADE_GOOD: Second = 30.0
"""What lacks in height is made good in so long [s]."""


class LevelAsked(NamedTuple):
    """What a pursuer is to do."""

    to: Metre
    """Level to fly at [m]."""
    rate: MetrePerSecond
    """How fast to go there at most [m/s], > 0."""


def follow_level(memory: Memory, belief: Belief, assignment: Assignment) -> LevelAsked | None:
    """What is asked for now; `None` to go on as before.

    A pursuer that turns away from its leader keeps its level as far as it can: it levels off where
    1,000 ft keep both apart.
    """
    own, leader, height = belief.own_heights.altitude, belief.leader_heights.altitude, belief.height
    if memory.engagement != "engaged" or own is None or leader is None or height is None:
        return None
    if memory.mode == "escape" and belief.counts and belief.counts[0][0] > 0.0:
        return LevelAsked(own, CLIMB_RATE)
    if not belief.intent_known and not _is_time(memory, belief, height, assignment):
        return None
    declared = [change for change in belief.leader_heights.changes if change.at <= 0.0]
    climb = belief.leader_climb
    if abs(climb) < CLIMBS and not declared:
        return None if abs(height) <= NEAR else LevelAsked(leader, level_rate(own, leader))
    to = declared[0].to_altitude if declared else leader + AHEAD * climb
    way = 1.0 if to > own else -1.0
    if abs(to - own) <= NEAR:
        return None
    rate = way * (climb + height / MADE_GOOD)
    return LevelAsked(to, min(max(rate, CLIMBS), STEEPEST))


def _is_time(memory: Memory, belief: Belief, height: Metre, assignment: Assignment) -> bool:
    """Whether to go to the level of a leader of unknown intent.

    That is when it takes as long as is left; once the pursuer flies beside it; and where the leader
    is too slow for this level.
    """
    if memory.mode in ("capture", "follow"):
        return True
    if belief.leader.tas < assignment.min_tas + assignment.settings.speed_in_hand:
        return True
    ahead = memory.forecast
    if memory.mode != "converge" or ahead is None or not ahead.joins:
        return False
    return ahead.join_time - belief.t <= BEFORE + abs(height) / GOES_DOWN_BY
