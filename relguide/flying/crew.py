"""What a pursuer's crew orders: how far guidance is engaged, and a heading; and what it hears."""

from collections.abc import Iterator
from typing import assert_never

from relguide.flying.by_hand import bars_in_view, obey_hands
from relguide.flying.documents import Document
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.announcements import Event
from relguide.flying.guidance.stand_by import (
    hold_heading,
    order_engagement,
    refused_heading,
)
from relguide.flying.logbook import event_document
from relguide.flying.orders import (
    CrewCommand,
    LeaderData,
    PursuerBank,
    PursuerHeading,
    PursuerSpeed,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    SetSpacing,
    Stick,
)
from relguide.flying.pursuit import Pursuit
from relguide.units import Second


def obey_crew(one: Pursuit, command: CrewCommand, fleet: Fleet, t: Second) -> Iterator[Document]:
    """Do what the crew orders, and say what becomes of it."""
    belief, events = one.belief(fleet, t), list[Event]()
    match command:
        case SetEngagement(engagement=engagement):
            one.memory, events = order_engagement(one.memory, belief, engagement)
        case PursuerHeading(heading=heading):
            if one.memory.engagement == "engaged":
                events = [refused_heading(one.memory)]
            else:
                one.memory = hold_heading(one.memory, heading, belief.own.tas)
        case LeaderData(received=True):
            one.heard = None
        case LeaderData():
            one.heard = one.heard or belief
        case SetAutopilot() | SetDirector() | Stick():
            by_hand, shown = not one.autopilot, bars_in_view(one)
            yield from obey_hands(one, command, fleet, t)
            if by_hand and one.autopilot and not shown and one.memory.engagement != "engaged":
                # no bar showed the heading of before: the one that was flown to is held
                one.memory = hold_heading(one.memory, belief.own.heading, belief.own.tas)
        case PursuerBank() | PursuerSpeed() | SetSpacing():
            one.asked = (*one.asked, command)  # guidance answers, as it plans anew
        case _:
            assert_never(command)
    for event in events:
        yield event_document(t, one.names, event)
