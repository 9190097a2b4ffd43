"""When a fan of joins is opened and closed: only for viewers, and not each second."""

from collections.abc import Callable, Iterator

from relguide.flying.belief import Belief
from relguide.flying.documents import FanChanged
from relguide.flying.guidance.fan import is_uncertain, open_fan
from relguide.flying.logbook import fan_document
from relguide.flying.pursuit import Pursuit
from relguide.planning.outcome import Planner
from relguide.units import Second

FAN_EVERY: Second = 5.0
"""A fan is made anew this often at most, …"""
FAN_SHARE = 0.04
"""… and after this share of the time to go: far from the slot it changes slowly."""
Wants = Callable[[Second], bool]
"""Whether a fan that is due at a flight time is to be made: it takes as long as twenty plans."""


def no_fans(t: Second) -> bool:
    """No fan is wanted: the flight has no viewer."""
    del t
    return False


def all_fans(t: Second) -> bool:
    """Each fan that is due is wanted."""
    del t
    return True


def follow_fan(
    one: Pursuit, belief: Belief, planner: Planner, wants: Wants
) -> Iterator[FanChanged]:
    """Open the fan anew if it is due, and close it once it says nothing any more.

    Args:
        one: after guidance has acted.
        belief: what it acted on.
        planner: makes the plans.
        wants: asked before a fan is made.
    """
    t, names = belief.t, one.names
    if not is_uncertain(one.memory, belief, one.assignment):
        if one.fan_due > 0.0:
            one.fan_due = 0.0
            yield FanChanged(t=t, ident=names.pursuer, joins=(), most_saved=0.0, mean_saved=0.0)
        return
    if t < one.fan_due or not wants(t):
        return
    to_go = 0.0 if one.advice is None else one.advice.time_to_go
    one.fan_due = t + max(FAN_EVERY, FAN_SHARE * to_go)
    yield fan_document(t, names, open_fan(one.memory, belief, one.assignment, planner))
