"""What is new of the leader: that it does something new, and whether it can be followed at all."""

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import (
    Event,
    UnableTo,
    expectation,
    leader_change,
)
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.memory import LONG_AGO, Memory
from relguide.units import KT, MetrePerSecond

STEADY: MetrePerSecond = 0.1
"""A speed that changes less in a second is held [m/s]."""


SMOOTH = 0.2
"""Share that each second has in what is seen of a change of speed, where reports are noisy."""
NOISE_LEFT = 0.25
"""Share of the noise of a velocity that is then left in it, and more [1/s]."""


def notice_leader(memory: Memory, belief: Belief, assignment: Assignment) -> Memory:
    """Remember when the leader last did something new, and how fast it changes its speed.

    A flight ahead that expects something else of it is forgotten, though the leader may still be
    where that has it: orders are known before they are seen.
    """
    settings, now, was = assignment.settings, expectation(belief), memory.leader
    rate = now.tas - was.tas
    if belief.spread.velocity > 0.0:  # what is seen of a second is noise
        rate = memory.leader_rate + SMOOTH * (rate - memory.leader_rate)
    steady = STEADY + NOISE_LEFT * belief.spread.velocity
    trend = rate if abs(rate) > steady else 0.0
    moved = turns_unannounced(belief, assignment) or trend != 0.0
    moved = moved or now.intent_known != was.intent_known
    changed = belief.t if moved else memory.changed
    memory = memory._replace(leader=now, leader_trend=trend, leader_rate=rate, changed=changed)
    turned = settings.leader_turned + belief.heading_slack
    if leader_change(was, now, turned, settings.leader_speed + belief.speed_slack) is not None:
        memory = memory._replace(forecast=None)
    return memory


def is_steady(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the leader has done nothing new for a while."""
    return belief.t - memory.changed >= assignment.settings.settled_for


def turns_unannounced(belief: Belief, assignment: Assignment) -> bool:
    """Whether the leader turns, and nothing says how far."""
    return not belief.intent_known and abs(belief.leader_turn_rate) > assignment.settings.turning


def judge_speed(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, tuple[Event, ...]]:
    """Whether the leader is slower than the pursuer can fly, and what is said of it once."""
    if not belief.at_level:
        return memory, ()  # at the leader's level other speeds can be flown
    slow, in_hand = belief.leader.tas, assignment.settings.speed_in_hand
    if slow < assignment.min_tas - in_hand - belief.speed_slack:
        if memory.unable == "speed":
            return memory, ()
        message = (
            f"Unable to follow: the leader flies {slow / KT:.0f} kt, and "
            f"{assignment.min_tas / KT:.0f} kt is the least speed of this "
            f"{assignment.aircraft_type} at its level."
        )
        said = UnableTo(reason="speed", message=message)
        return memory._replace(unable="speed"), (said,)
    if memory.unable == "speed" and slow > assignment.min_tas:
        return memory._replace(unable=None, asked=LONG_AGO), ()
    return memory, ()
