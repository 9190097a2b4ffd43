"""The crew changes in flight what its guidance is to do: D, d_min, the bank of plans, the speed."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import assert_never

from relguide.flying.belief import Belief
from relguide.flying.documents import AssignmentChanged, Document
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.choice import Reassigning
from relguide.flying.guidance.stand_by import plan_anew
from relguide.flying.logbook import event_document
from relguide.flying.metrics import count_event
from relguide.flying.orders import NewTask, PursuerBank, PursuerSpeed, SetSpacing
from relguide.flying.pursuit import Pursuit
from relguide.flying.queues import behind_head
from relguide.flying.slots import refuse_taken
from relguide.flying.world import Link
from relguide.planning.limits import CLEARANCE, DISTANCE
from relguide.planning.phrases import distance
from relguide.units import DEG, KT, NM, Second


def obey_tasks(
    one: Pursuit,
    pursuits: Sequence[Pursuit],
    fleet: Fleet,
    belief: Belief,
    reassign: Reassigning,
    t: Second,
) -> Iterator[Document]:
    """Do what a crew asked of its guidance just now, or say why not.

    Args:
        one: whose crew.
        pursuits: all of them: the slots of a queue are counted from its head.
        fleet: their aircraft.
        belief: what the pursuer knows.
        reassign: of its guidance.
        t: flight time [s].
    """
    orders, one.asked = one.asked, ()
    for order in orders:
        why = _refusal(one, order, pursuits, fleet)
        if why:
            yield _changed(one, t, f"{_stays(one, order)} {why}")
            continue
        link, asked = _asked_for(one, order)
        answer = reassign(one.memory, belief, one.assignment, asked, _said(order, asked, link))
        if isinstance(answer, str):
            yield _changed(one, t, f"{_stays(one, order)} {answer}")
            continue
        one.link, one.assignment, (one.memory, events) = link, asked, answer
        one.flown = replace(
            one.flown, slot_distance=asked.slot_distance, min_separation=asked.min_separation
        )
        yield _changed(one, t, f"{_said(order, asked, link)}.")
        for event in events:
            document = event_document(t, one.watched, event)
            one.metrics = count_event(one.metrics, document, one.names.leader)
            yield document
        _move_those_behind(one, pursuits, fleet)


def _asked_for(one: Pursuit, order: NewTask) -> tuple[Link, Assignment]:
    """What link and assignment would be."""
    link, now = one.link, one.assignment
    match order:
        case PursuerBank(bank=bank):
            return link, replace(now, asked_bank=bank)
        case PursuerSpeed(tas=tas):
            return link, replace(now, selected_tas=tas)
        case SetSpacing(slot_distance=slot_distance, min_separation=min_separation):
            wider = slot_distance - link.slot_distance if slot_distance else 0.0
            kept = min_separation or link.min_separation
            link = replace(link, slot_distance=link.slot_distance + wider, min_separation=kept)
            behind = now.slot_distance + wider  # the head, in a queue
            return link, replace(now, slot_distance=behind, min_separation=kept)
        case _:
            assert_never(order)


def _refusal(one: Pursuit, order: NewTask, pursuits: Sequence[Pursuit], fleet: Fleet) -> str:
    """Why an order cannot be obeyed, whatever is flown, in a sentence; empty if it may be."""
    match order:
        case PursuerBank(bank=bank):
            most = one.assignment.max_bank
            if bank > most:
                return f"The autopilot banks {most / DEG:.0f}° at most: select no more."
        case PursuerSpeed(tas=tas):
            limits = fleet.believed(one.pursuer)
            if tas and not limits.min_tas <= tas <= limits.max_tas:
                low, high = limits.min_tas / KT, limits.max_tas / KT
                return f"The aircraft flies {low:.0f} to {high:.0f} kt here: select such a speed."
        case SetSpacing(slot_distance=slot_distance, min_separation=min_separation):
            slot_distance = slot_distance or one.link.slot_distance
            min_separation = min_separation or one.link.min_separation
            if not CLEARANCE.admits(slot_distance - min_separation):
                return (
                    f"D of {distance(slot_distance)} is less than d_min of "
                    f"{distance(min_separation)}: the slot itself would be too close."
                )
            changed, asked = _asked_for(one, order)
            others = [other.link for other in pursuits if other is not one]
            if not DISTANCE.admits(asked.slot_distance):
                return f"The queue would be longer than {distance(DISTANCE.high)}."
            speeds = {aircraft.ident: aircraft.tas for aircraft in fleet.world.aircraft}
            try:
                refuse_taken([*others, changed], speeds)
            except ValueError as taken:
                return str(taken)
        case _:
            assert_never(order)
    return ""


def _move_those_behind(one: Pursuit, pursuits: Sequence[Pursuit], fleet: Fleet) -> None:
    """Those that follow in a queue have their slots as far behind as before."""
    links = [other.link for other in pursuits]
    buffer = fleet.world.settings.separation_buffer
    for other in pursuits:
        if other.names.pursuer not in one.behind:
            continue
        flown = behind_head(other.link, links, buffer)
        if flown.slot_distance != other.flown.slot_distance:
            other.flown = flown
            other.assignment = replace(other.assignment, slot_distance=flown.slot_distance)
            other.memory = plan_anew(other.memory)


def _said(order: NewTask, asked: Assignment, link: Link) -> str:
    """What is asked for, as a sentence without full stop."""
    match order:
        case PursuerBank():
            return f"Plans turn with {asked.asked_bank / DEG:.0f}° of bank"
        case PursuerSpeed(tas=0.0):
            return "Guidance sets the speed"
        case PursuerSpeed(tas=tas):
            return f"{tas / KT:.0f} kt is selected"
        case SetSpacing():
            d, d_min = link.slot_distance / NM, link.min_separation / NM
            return f"D is {d:.1f} NM, d_min {d_min:.1f} NM"
        case _:
            assert_never(order)


def _stays(one: Pursuit, order: NewTask) -> str:
    """What was refused, and what stays, in a sentence."""
    now, link = one.assignment, one.link
    match order:
        case PursuerBank(bank=bank):
            stays = f"the bank stays {now.asked_bank / DEG:.0f}°"
            return f"{bank / DEG:.0f}° of bank is refused, {stays}."
        case PursuerSpeed(tas=tas):
            wanted = f"{tas / KT:.0f} kt" if tas else "Guidance's speed"
            kept = f"{now.selected_tas / KT:.0f} kt stays" if now.selected_tas else "it stays"
            return f"{wanted} is refused, {kept} as it is."
        case SetSpacing():
            d, d_min = link.slot_distance / NM, link.min_separation / NM
            return f"Refused: D stays {d:.1f} NM, d_min {d_min:.1f} NM."
        case _:
            assert_never(order)


def _changed(one: Pursuit, t: Second, message: str) -> AssignmentChanged:
    now = one.assignment
    return AssignmentChanged(
        t=t,
        ident=one.names.pursuer,
        slot_distance=one.link.slot_distance,
        min_separation=one.link.min_separation,
        max_bank=now.asked_bank,
        selected_tas=(now.selected_tas,) if now.selected_tas else (),
        message=message,
    )
