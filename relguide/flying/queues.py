"""Queues: followers of one leader, each behind the one before.

    head ← first ← second ← …

Each flies by the head's path and speed: its slot is so far behind the head as all those before it
take up. So each knows what those ahead of it will do as soon as the head does it, and an error of
one is not handed down to the next.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from relguide.flying.slots import line_of
from relguide.flying.world import Aircraft, Declared, Link
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer, expect_distance
from relguide.planning.inputs import expect, expect_function, text
from relguide.planning.intent import IntentPiece
from relguide.planning.limits import DISTANCE, SPACING
from relguide.planning.outcome import Plan, Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.wind import CALM, Wind
from relguide.units import Metre, Second


def behind_head(link: Link, links: Sequence[Link], buffer: Metre) -> Link:
    """A link as it is flown: behind the head of its queue.

    Where the head is too far ahead, or those between keep a time and others a distance, it is flown
    behind the farthest aircraft ahead to which that does not apply.

    Args:
        link: one of the links.
        links: all of them.
        buffer: what guidance keeps beside d_min [m].
    """
    line = line_of(link, links)
    while len(line) > 1:
        ahead = sum(max(one.slot_distance, one.min_separation + buffer) for one in line[:-1])
        spacing = sum(one.spacing for one in line)
        alike = len({one.spacing > 0.0 for one in line}) == 1
        if alike and DISTANCE.admits(ahead + link.slot_distance) and SPACING.admits(spacing):
            return replace(
                link,
                leader=line[0].leader,
                slot_distance=ahead + link.slot_distance,
                spacing=spacing,
                intent_known=all(one.intent_known for one in line),
                declared_intent=line[0].declared_intent,
            )
        line = line[1:]
    return link


def queue_up(
    followers: Sequence[str],
    leader: str,
    *,
    slot_distance: Metre,
    min_separation: Metre,
    spacing: Second = 0.0,
    intent_known: bool = True,
    declared_intent: tuple[IntentPiece, ...] | None = None,
) -> tuple[Link, ...]:
    """Links that put followers behind a leader, each behind the one before.

    Examples:
        >>> links = rg.queue_up(("B", "C"), "A", slot_distance=10e3, min_separation=9e3)
        >>> [(link.pursuer, link.leader) for link in links]
        [('B', 'A'), ('C', 'B')]

    Args:
        followers: idents of guided aircraft, the one next to the leader first.
        leader: ident of the head.
        slot_distance: D of each, behind the aircraft before it [m].
        min_separation: d_min of each [m].
        spacing: time behind the aircraft before it, kept once joined [s]; 0 to keep D.
        intent_known: whether they know the head's intent.
        declared_intent: what the head declared, if that is not what it flies.
    """
    if isinstance(followers, str) or not isinstance(followers, Sequence):
        raise ValueError(f"followers must be a tuple of idents, not {followers!r}.")
    before = [
        text("leader", leader),
        *(text(f"followers[{i}]", ident) for i, ident in enumerate(followers)),
    ]
    return tuple(
        Link(
            pursuer=follower,
            leader=ahead,
            slot_distance=slot_distance,
            min_separation=min_separation,
            spacing=spacing,
            intent_known=intent_known,
            declared_intent=declared_intent if ahead == leader else None,
        )
        for ahead, follower in pairwise(before)
    )


def soonest_first(
    followers: Sequence[Aircraft],
    leader: Aircraft,
    *,
    slot_distance: Metre,
    min_separation: Metre,
    wind: Wind = CALM,
    planner: Planner = plan,
) -> tuple[str, ...]:
    """In which order followers queue up: each place goes to the one that can be there first.

    Examples:
        >>> from dataclasses import replace
        >>> leader = rg.Aircraft(
        ...     ident="A", airframe=rg.airframe("A306"), aircraft_type="A306", pilot=rg.Declared(),
        ...     x=0.0, y=0.0, heading=1.5, tas=200.0, altitude=9_449.0, max_bank=0.4)
        >>> b = replace(leader, ident="B", pilot=rg.Guided(), x=-60e3, tas=235.0)
        >>> c = replace(b, ident="C", x=-40e3)
        >>> rg.soonest_first((b, c), leader, slot_distance=10e3, min_separation=9_260.0)
        ('C', 'B')

    Args:
        followers: where they begin.
        leader: the head, with its intent.
        slot_distance: D of each, behind the aircraft before it [m].
        min_separation: d_min [m].
        wind: over all of them.
        planner: tells the times.

    Returns:
        Their idents, the one next to the leader first. Those without a path come last.
    """
    if not isinstance(followers, tuple | list):
        raise ValueError(f"followers must be a tuple of Aircraft, not {followers!r}.")
    for i, follower in enumerate(followers):
        expect(f"followers[{i}]", follower, Aircraft)
    expect("leader", leader, Aircraft)
    slot_distance = expect_distance("slot_distance", slot_distance)
    expect_function("planner", planner)
    left, order = list(followers), list[str]()
    while left:
        behind = min((len(order) + 1) * slot_distance, DISTANCE.high)
        first = min(left, key=lambda one: _time(one, leader, behind, min_separation, wind, planner))
        order.append(first.ident)
        left.remove(first)
    return tuple(order)


def _time(
    own: Aircraft, head: Aircraft, behind: Metre, limit: Metre, wind: Wind, planner: Planner
) -> Second:
    """Time to converge to a place behind the head [s]; infinite without a path."""
    intent = head.pilot.intent if isinstance(head.pilot, Declared) else ()
    heading = wrap(own.heading)
    answer = planner(
        Situation(
            pursuer=Pursuer(x=own.x, y=own.y, heading=heading, tas=own.tas, max_bank=own.max_bank),
            leader=Leader(
                x=head.x, y=head.y, heading=wrap(head.heading), tas=head.tas, intent=intent
            ),
            slot_distance=behind,
            min_separation=limit,
            wind=wind,
        )
    )
    return answer.time_to_converge if isinstance(answer, Plan) else float("inf")
