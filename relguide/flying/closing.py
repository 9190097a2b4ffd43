"""The modes near the slot: capture closes onto the leader's route, follow flies its path at D."""

from dataclasses import replace
from math import hypot

from relguide.flying.aircraft import roll_lead
from relguide.flying.assignment import Assignment, Observation, slot_of
from relguide.flying.autopilot import TurnRate
from relguide.flying.capture import (
    Offsets,
    Slot,
    closing_turn_rate,
    distance_to_slot,
    offsets,
    spacing_tas,
)
from relguide.flying.escape import keeps_clear
from relguide.flying.memory import Advice, Memory, enter_mode, is_slot_open
from relguide.planning.situation import Situation
from relguide.units import DEG, NM, Metre, Radian

JOINED_ALONG: Metre = 0.2 * NM  # half of D − d_min in fig. 6; closing at 13 m/s there
JOINED_ACROSS: Metre = 0.1 * NM  # RNP 0.1, the tightest navigation an airliner is approved for
JOINED_HEADING: Radian = 2.0 * DEG  # drifts 35 m in a kilometre: the route is kept from there on
SEPARATION_BUFFER: Metre = 0.1 * NM  # what a roll-in begun half a second late can cost at 400 m/s
CAPTURE_HEADING: Radian = 30.0 * DEG  # the intercept angle itself
LOST_ACROSS: Metre = 3_000.0  # twice what capture accepts: no alternation between the modes
LOST_HEADING: Radian = 175.0 * DEG  # beyond it the tangent arc is no longer the shorter way


def capture(
    memory: Memory, seen: Observation, assignment: Assignment, situation: Situation
) -> tuple[Memory, Advice] | None:
    """Close onto the route; `None` where the laws do not apply or d_min would be lost."""
    slot, model = slot_of(situation), assignment.model
    from_slot = offsets(seen.pursuer, slot)
    if abs(from_slot.heading) > LOST_HEADING:
        return None
    on_course = abs(from_slot.heading) < CAPTURE_HEADING
    if on_course and abs(from_slot.right) > LOST_ACROSS:
        return None
    to_slot = distance_to_slot(from_slot)
    if not keeps_clear(from_slot, to_slot, situation):
        return None
    is_open = is_slot_open(memory, seen, assignment)
    joined = is_open and _joined(from_slot)
    limit_bank = model.max_bank if from_slot.right < 0.0 else -model.max_bank
    lead = min(roll_lead(model, seen.pursuer.bank, limit_bank), roll_lead(model, 0.0, limit_bank))
    rate = closing_turn_rate(from_slot, seen.pursuer, model=model, lead=lead)
    message = "Joined: following the leader's path." if joined else "Capturing the leader's route."
    mode, events = enter_mode(memory, "follow" if joined else "capture", message)
    closing = max(seen.pursuer.tas - slot.tas, 5.0)  # 10 kt: the last metres close slowly
    return replace(memory, mode=mode, committed=None), Advice(
        reference=TurnRate(rate),
        commanded_tas=spacing_tas(to_slot, slot.tas, model=model, fastest=assignment.tas),
        mode=mode,
        slot=slot,
        slot_open=is_open,
        to_slot=to_slot,
        time_to_go=0.0 if joined else abs(to_slot) / closing,
        joined=joined,
        events=events,
    )


def follow(
    memory: Memory, seen: Observation, assignment: Assignment
) -> tuple[Memory, Advice] | None:
    """Fly the leader's path D behind it; `None` when the pursuer has strayed from it."""
    model, path = assignment.model, memory.flown
    from_slot = path.offsets(seen.pursuer, assignment.slot_distance)
    if abs(from_slot.right) > LOST_ACROSS or abs(from_slot.heading) > LOST_HEADING:
        return None
    mark = path.at(path.last.s - assignment.slot_distance)
    slot = Slot(mark.x, mark.y, mark.heading, seen.leader.tas, mark.turn_rate)
    # turn where the leader turned; the roll takes time, so look ahead by it
    lead = roll_lead(model, 0.0, model.max_bank)
    ahead = path.at(mark.s + from_slot.ahead + seen.pursuer.tas * lead)
    rate = ahead.turn_rate * seen.pursuer.tas / seen.leader.tas
    rate += closing_turn_rate(from_slot, seen.pursuer, model=model, lead=0.0)
    apart = hypot(seen.pursuer.x - seen.leader.x, seen.pursuer.y - seen.leader.y)
    # on a bend the leader is nearer than D along its path: the shorter distance sets the speed
    room = apart - assignment.min_separation - SEPARATION_BUFFER
    to_slot = min(-from_slot.ahead, room) if room < 0.0 else -from_slot.ahead
    mode, events = enter_mode(memory, "follow", "Following the leader's path.")
    return memory, Advice(
        reference=TurnRate(rate),
        commanded_tas=spacing_tas(to_slot, slot.tas, model=model, fastest=assignment.tas),
        mode=mode,
        slot=slot,
        slot_open=True,
        to_slot=-from_slot.ahead,
        time_to_go=0.0,
        joined=_joined(from_slot),
        events=events,
    )


def _joined(seen: Offsets) -> bool:
    """Eq. (7) within tolerance."""
    return (
        abs(seen.ahead) <= JOINED_ALONG
        and abs(seen.right) <= JOINED_ACROSS
        and abs(seen.heading) <= JOINED_HEADING
    )
