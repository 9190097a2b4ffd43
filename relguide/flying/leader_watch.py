"""What is new of a leader: a turn that nobody announced, a broken intent, another route.

A command that the leader gets is announced as it is given; the turn that follows is no news.
"""

from collections.abc import Iterator

from relguide.flying.belief import Belief
from relguide.flying.documents import LeaderChanged, LeaderRoute
from relguide.flying.fleet import Fleet
from relguide.flying.knowledge import breaks_its_word
from relguide.flying.logbook import leader_route
from relguide.flying.orders import (
    IntentKnown,
    LeaderCommand,
    LeaderHeading,
    LeaderLevel,
    LeaderReport,
    LeaderSpeed,
)
from relguide.flying.pursuit import Pursuit
from relguide.kernels.base.angles import wrap_signed
from relguide.units import DEG, KT, MetrePerSecond, Radian, RadianPerSecond, Second

ROUTE_TURNED: Radian = 1.0 * DEG
"""A route drawn a degree off ends 2 % of its length aside [rad]."""
ROUTE_SPEED: MetrePerSecond = 2.0 * KT
"""What the display rounds to [m/s]."""
TURN_OVER: RadianPerSecond = 0.1 * DEG
"""A turn that slow is over [rad/s]."""
DOUBTED_FOR = 5
"""So many seconds off its intent, a leader is no longer relied on."""


def note_command(one: Pursuit, command: LeaderCommand, t: Second) -> None:
    """A command was given to the leader, and announced."""
    match command:
        case LeaderHeading():
            one.declared = None  # what it is ordered to do is what it declares from now on
            said = "The leader was ordered to turn."
            one.view = one.view._replace(turn_ordered=True)
        case LeaderSpeed():
            said = "The leader was ordered to another speed."
        case LeaderLevel():
            said = "The leader was ordered to another level."
        case LeaderReport():
            one.declared = None
            return
        case IntentKnown():
            return
    one.view = one.view._replace(rerouted=True, changed=said, changed_at=t)


def doubt_leader(one: Pursuit, fleet: Fleet, t: Second) -> Iterator[LeaderChanged]:
    """Find out a leader that does not fly what it declared; from then on its intent is unknown."""
    if one.declared is None or not one.known:
        return
    one.doubted = one.doubted + 1 if breaks_its_word(fleet, one.leader, one.declared) else 0
    if one.doubted >= DOUBTED_FOR:
        one.declared, one.known = None, False
        message = "The leader does not fly what it declared; its intent is no longer relied on."
        one.view = one.view._replace(changed="The leader broke its word.", changed_at=t)
        if not one.queued:  # the first of a queue says it for all
            ident = one.names.leader
            yield LeaderChanged(t=t, ident=ident, change="intent_broken", message=message)
    else:
        one.declared.fly_second(t)


def watch_leader(one: Pursuit, seen: Belief) -> Iterator[LeaderChanged | LeaderRoute]:
    """Announce a turn that was not to be expected, and draw the route anew if it changed."""
    yield from _notice_turn(one, seen)
    if one.view.rerouted or _route_is_news(one.view.shown, seen):
        one.view = one.view._replace(shown=seen, rerouted=False)
        if not one.queued:
            yield expected_route(one, seen)


def expected_route(one: Pursuit, seen: Belief) -> LeaderRoute:
    """What the leader is expected to fly, as a document."""
    return leader_route(
        seen.t, one.names, seen.leader_after(0.0), intent_known=seen.intent_known, wind=seen.wind
    )


def _notice_turn(one: Pursuit, seen: Belief) -> Iterator[LeaderChanged]:
    """Whether the leader turns, and the news if it begins to without having announced it."""
    view, rate = one.view, seen.leader_turn_rate
    if view.turning:
        one.view = view._replace(turning=abs(rate) > TURN_OVER)
        if one.view.turning and not seen.intent_known:
            one.view = one.view._replace(changed_at=seen.t)
        return
    if abs(rate) < one.assignment.settings.turning:
        return
    one.view = view._replace(turning=True, turn_ordered=False)
    if seen.intent_known or view.turn_ordered:
        return
    side = "right" if rate > 0.0 else "left"
    message = f"The leader turns {side}."
    if one.memory.mode in ("converge", "capture") or one.memory.proposed is not None:
        message = f"The leader turns {side} and its intent is not known: the join is uncertain."
    said = f"The leader turned {side} unannounced."
    one.view = one.view._replace(changed=said, changed_at=seen.t)
    if not one.queued:
        yield LeaderChanged(t=seen.t, ident=one.names.leader, change="heading", message=message)


def _route_is_news(shown: Belief, seen: Belief) -> bool:
    """Whether the route last shown is no longer what is expected."""
    if shown.intent_known != seen.intent_known:
        return True
    if abs(shown.leader.tas - seen.leader.tas) > ROUTE_SPEED + seen.speed_slack:
        return True
    turned = abs(wrap_signed(seen.final_heading - shown.final_heading))
    return turned > ROUTE_TURNED + seen.heading_slack
