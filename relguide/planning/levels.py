"""The pursuer's own level as a discrete choice: when to go to the level of its leader.

Three choices, each of them planned: with the leader, to its level at once and down or up with it;
to stay as long as possible, and change the level just before joining; and to fly 1,000 ft above or
below the leader's last level meanwhile. A change of level takes the planner's constant airspeed.
"""

from dataclasses import replace

from relguide.planning.heights import (
    JOINED_HEIGHT,
    START_TOLERANCE,
    VERTICAL_MINIMUM,
    Heights,
    heights_of,
)
from relguide.planning.intent import LevelChange
from relguide.planning.limits import ALTITUDE
from relguide.planning.situation import Situation
from relguide.units import FT, Metre, MetrePerSecond, Second

CLIMB_RATE: MetrePerSecond = 1_000.0 * FT / 60.0
"""How fast a pursuer climbs by plan [m/s]: 1,000 ft/min, which airliners do at any level."""
DESCENT_RATE: MetrePerSecond = 2_000.0 * FT / 60.0
"""How fast it descends by plan [m/s]: 2,000 ft/min, near idle."""


def level_rate(own: Metre, to: Metre) -> MetrePerSecond:
    """How fast a pursuer changes its level by plan [m/s]."""
    return CLIMB_RATE if to > own else DESCENT_RATE


def chooses_level(situation: Situation) -> bool:
    """Whether the pursuer has to change its level to join, and has not declared how it does."""
    own, leader = heights_of(situation.pursuer), heights_of(situation.leader)
    if own.altitude is None or leader.altitude is None or situation.pursuer.levels:
        return False
    return bool(leader.changes) or abs(own.altitude - leader.altitude) > JOINED_HEIGHT


def with_leader(situation: Situation) -> Situation:
    """To the leader's level at once, and then as the leader does."""
    own, leader = situation.pursuer.altitude, heights_of(situation.leader)
    return _flying(situation, levels_with(leader, own))


def levels_with(leader: Heights, own: Metre | None) -> tuple[LevelChange, ...]:
    """The changes of level that `with_leader` makes.

    Args:
        leader: whose level is flown to.
        own: the pursuer's level now [m].
    """
    altitude = leader.altitude
    begins_now = bool(leader.changes) and leader.changes[0].at == 0.0
    if altitude is None or own is None or own == altitude or begins_now:
        return leader.changes
    return (_change(0.0, own, altitude), *leader.changes)


def meanwhile(situation: Situation) -> tuple[Metre, ...]:
    """Levels 1,000 ft above and below the leader's last one [m], the nearer to ours first."""
    own, final = situation.pursuer.altitude, heights_of(situation.leader).final_altitude
    assert own is not None
    assert final is not None
    levels = [final + VERTICAL_MINIMUM, final - VERTICAL_MINIMUM]
    levels = [level for level in levels if ALTITUDE.admits(level)]
    return tuple(sorted(levels, key=lambda level: abs(level - own)))


def changing_late(situation: Situation, level: Metre, time: Second) -> Situation | None:
    """At a level as long as possible, and at the leader's last one by a time.

    Args:
        situation: with the pursuer at its own level.
        level: where it stays until then; it goes there at once [m].
        time: when it joins [s].

    Returns:
        the same with both changes; `None` if they take longer.
    """
    own, final = situation.pursuer.altitude, heights_of(situation.leader).final_altitude
    assert own is not None
    assert final is not None
    at = time - START_TOLERANCE - abs(final - level) / level_rate(level, final)
    if at < abs(level - own) / level_rate(own, level):
        return None
    levels = [_change(at, level, final)]
    if level != own:
        levels.insert(0, _change(0.0, own, level))
    return _flying(situation, tuple(levels))


def is_at_level(situation: Situation, time: Second) -> bool:
    """Whether the pursuer is at the leader's level at a time [s], by what both declare."""
    own, leader = heights_of(situation.pursuer).at(time), heights_of(situation.leader).at(time)
    return own is None or leader is None or abs(own - leader) <= JOINED_HEIGHT


def _change(at: Second, own: Metre, to: Metre) -> LevelChange:
    return LevelChange(at=at, to_altitude=to, rate=level_rate(own, to))


def _flying(situation: Situation, levels: tuple[LevelChange, ...]) -> Situation:
    return replace(situation, pursuer=replace(situation.pursuer, levels=levels))
