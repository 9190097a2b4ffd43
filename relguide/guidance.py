"""Guidance, once a second: what the pursuer knows → a reference for its autopilot, and a speed.

Modes: converge flies the committed plan; capture closes onto the leader's route by the laws of
`capture.py`, where the plan's problem is ill-posed; follow flies the leader's own path D behind it,
so it turns where the leader turned. With nothing to fly it holds a heading that keeps d_min.
Every answer is a new memory and an `Advice`: nothing here changes in place.
"""

from dataclasses import dataclass, replace
from math import hypot, pi

from relguide.aircraft import ground_velocity, roll_lead
from relguide.announcements import (
    TURNED,
    Event,
    Expectation,
    Mode,
    ModeChange,
    NewPlan,
    PlanMissing,
    PlanReason,
    because,
    expectation,
    leader_change,
    summary,
)
from relguide.assignment import Assignment, Seen, situation_of, slot_of
from relguide.autopilot import HoldHeading, Reference, TurnRate
from relguide.capture import (
    Offsets,
    Slot,
    braking_distance,
    closing_turn_rate,
    distance_to_slot,
    offsets,
    spacing_tas,
)
from relguide.commitment import Cause, Choice, Commitment, choose
from relguide.escape import keeps_clear, safe_heading
from relguide.flown_path import FlownPath, path_begun, path_extended
from relguide.plan import NoPlan, Plan, Planner, Reason
from relguide.situation import Situation
from relguide.steering import Steering, steer
from relguide.trajectory import Arc, Trajectory
from relguide.units import DEG, NM, Metre, MetrePerSecond, Radian, Second

TURNED_IN_CAPTURE: Radian = 3.0 * DEG  # less moves the slot by 0.5 km, which capture takes up
JOINED_ALONG: Metre = 0.2 * NM  # half of D − d_min in fig. 6; closing at 13 m/s there
JOINED_ACROSS: Metre = 0.1 * NM  # RNP 0.1, the tightest navigation an airliner is approved for
JOINED_HEADING: Radian = 2.0 * DEG  # 35 m of drift a kilometre: the route is kept from there on
SEPARATION_BUFFER: Metre = 0.1 * NM  # what a roll-in begun half a second late can cost at 400 m/s
CAPTURE_TURN: Radian = 160.0 * DEG  # a longer final turn is flown as planned until this is left
LAST_STRETCH: Second = 30.0  # braking by now, the plan at V_P is no longer what will be flown
GOING_AROUND: Radian = 120.0 * DEG  # a plan that turns so much from close in is a detour, or a loop
CAPTURE_ACROSS: Metre = 1_500.0  # within the intercept law's linear range (30° ↔ 3.1 km)
CAPTURE_HEADING: Radian = 30.0 * DEG  # the intercept angle itself
LOST_ACROSS: Metre = 3_000.0  # twice what capture accepts: no flapping between the modes
LOST_HEADING: Radian = 175.0 * DEG  # beyond it the tangent arc is no longer the shorter way
SHOWN_WITHIN: Metre = 0.25 * NM  # a re-solved path farther than this from the shown one is shown
SHOWN_WITHIN_TIME: Second = 3.0  # … or one that arrives so much earlier or later
SHOWN_WITHIN_SHARE = 0.01  # and by this much of the time to go


@dataclass(frozen=True, slots=True, kw_only=True)
class Memory:
    """What guidance carries from one second to the next."""

    mode: Mode
    flown: FlownPath
    """The leader's, over the ground."""
    expected: Expectation
    committed: Commitment | None
    """`None` until there is a plan, and after it is given up."""
    shown: Commitment | None
    """The plan last announced."""
    missing: Reason | None
    """Why there was no plan a second ago; `None` if there was one."""
    slot_heading: Radian
    """Final heading when capture began [rad]."""
    planned: bool
    """Whether a plan was ever announced."""
    fallbacks: int
    """How often a planner's answer did not certify and the exact plan stood in."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Advice:
    """Guidance's answer for the next second."""

    reference: Reference
    commanded_tas: MetrePerSecond
    mode: Mode
    slot: Slot
    """Over the ground, now."""
    slot_open: bool
    to_slot: Metre
    """Distance still to close along the route [m]."""
    time_to_go: Second
    joined: bool
    """Eq. (7) holds: within 0.2 NM of the slot along and 0.1 NM across, heading within 2°, open."""
    events: tuple[Event, ...]


def begin(seen: Seen, assignment: Assignment) -> Memory:
    """The memory at engagement."""
    wind = assignment.wind
    velocity = ground_velocity(seen.leader, wind.east, wind.north)
    return Memory(
        mode="heading",
        flown=path_begun(seen.leader, velocity, assignment.slot_distance),
        expected=expectation(seen),
        committed=None,
        shown=None,
        missing=None,
        slot_heading=0.0,
        planned=False,
        fallbacks=0,
    )


def advise(
    memory: Memory, seen: Seen, assignment: Assignment, planner: Planner
) -> tuple[Memory, Advice]:
    """What to fly for the next second."""
    wind = assignment.wind
    memory = replace(
        memory,
        flown=path_extended(
            memory.flown,
            seen.leader,
            ground_velocity(seen.leader, wind.east, wind.north),
            seen.leader_turn_rate,
            assignment.slot_distance,
        ),
    )
    if memory.mode == "follow":
        followed = _follow(memory, seen, assignment)
        if followed is not None:
            return followed
    situation = situation_of(seen, assignment, assignment.min_separation)
    bend = (seen.final_heading - memory.slot_heading + pi) % (2.0 * pi) - pi
    if memory.mode == "capture" and abs(bend) < TURNED_IN_CAPTURE:
        captured = _capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured
    return _converge(memory, seen, assignment, situation, planner)


def _converge(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation, planner: Planner
) -> tuple[Memory, Advice]:
    buffered = min(assignment.min_separation + SEPARATION_BUFFER, assignment.slot_distance)
    choice = choose(
        memory.committed,
        seen.t,
        preferred=situation_of(seen, assignment, buffered),
        required=situation,
        planner=planner,
        model=assignment.model,
    )
    slot = slot_of(situation)
    from_slot = offsets(seen.pursuer, slot)
    near = _close_in(from_slot, slot, assignment)
    memory = replace(memory, slot_heading=slot.heading)
    if isinstance(choice, NoPlan):
        captured = _capture(memory, seen, assignment, situation) if near else None
        return captured or _hold(memory, seen, assignment, situation, choice)
    memory, events = _commit(memory, seen, choice)
    steering = steer(choice.plan.trajectory, assignment.model)
    around = near and _turning(choice.plan.trajectory) > GOING_AROUND
    if around or _final(steering, choice.plan, slot, assignment):
        captured = _capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured[0], replace(captured[1], events=(*events, *captured[1].events))
    mode, mode_events = _mode(memory, "converge", f"Converging by {choice.plan.word}.")
    # what the plan gains on the slot: braking may have to begin before the last turn does
    to_gain = max(assignment.tas - slot.tas, 0.0) * choice.plan.time_to_converge
    return replace(memory, mode=mode), Advice(
        reference=steering.reference,
        commanded_tas=_braked(to_gain, slot, assignment),
        mode=mode,
        slot=slot,
        slot_open=_slot_open(memory, seen, assignment),
        to_slot=-from_slot.ahead,
        time_to_go=choice.plan.time_to_converge,
        joined=False,
        events=(*events, *mode_events),
    )


def _commit(memory: Memory, seen: Seen, choice: Choice) -> tuple[Memory, tuple[Event, ...]]:
    """Remember the plan, and announce it if it is news."""
    commitment = Commitment(plan=choice.plan, made_at=seen.t)
    memory = replace(
        memory,
        committed=commitment,
        missing=None,
        fallbacks=memory.fallbacks + choice.fell_back,
    )
    reason = _news(memory, seen, choice.cause)
    if reason is None:
        return memory, ()
    message = f"{because(reason, seen)}: {summary(choice.plan)}."
    memory = replace(memory, shown=commitment, planned=True, expected=expectation(seen))
    return memory, (NewPlan(commitment=commitment, reason=reason, message=message),)


def _news(memory: Memory, seen: Seen, cause: Cause) -> PlanReason | None:
    if not memory.planned:
        return "engaged"
    change = leader_change(memory.expected, seen, TURNED)
    if change is not None:
        return change
    if cause != "continued":
        return cause
    if memory.shown is None or memory.committed is None:
        return "deviation"
    plan = memory.committed.plan
    shown = memory.shown.rest_at(seen.t, plan.situation)
    here = plan.trajectory
    tolerance = max(SHOWN_WITHIN_TIME, SHOWN_WITHIN_SHARE * plan.time_to_converge)
    pursuer, leader = plan.situation.pursuer.tas, plan.situation.leader.tas
    gain = (pursuer - leader) * plan.time_to_converge
    # while it brakes, arriving later than planned is no news
    cruising = gain > braking_distance(pursuer, leader)
    late = cruising and abs(plan.time_to_converge - shown.duration) > tolerance
    off = hypot(here.x - shown.x, here.y - shown.y) > SHOWN_WITHIN
    return "deviation" if late or off else None


def _final(steering: Steering, plan: Plan, slot: Slot, assignment: Assignment) -> bool:
    """Whether only the last turn, or nothing but the braking, is left of the plan."""
    if plan.time_to_converge < LAST_STRETCH and _turning(plan.trajectory) < CAPTURE_HEADING:
        return True
    arcs = [segment for segment in steering.segments if isinstance(segment, Arc)]
    if len(arcs) == 0:
        closing = (assignment.tas - slot.tas) * plan.time_to_converge
        return closing <= braking_distance(assignment.tas, slot.tas)
    return len(steering.segments) == 1 and arcs[0].turn_angle < CAPTURE_TURN


def _turning(trajectory: Trajectory) -> Radian:
    return sum(s.turn_angle for s in trajectory.segments if isinstance(s, Arc))


def _close_in(seen: Offsets, slot: Slot, assignment: Assignment) -> bool:
    """Whether the pursuer is so near the slot, and so aligned, that it only has to slide in."""
    margin = max(assignment.slot_distance - assignment.min_separation, JOINED_ALONG)
    braking = braking_distance(assignment.tas, slot.tas)
    return (
        abs(seen.right) < CAPTURE_ACROSS
        and abs(seen.heading) < CAPTURE_HEADING
        and -margin < -seen.ahead < braking
    )


def _capture(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation
) -> tuple[Memory, Advice] | None:
    """Close onto the route; `None` where the laws do not reach or d_min would be lost."""
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
    is_open = _slot_open(memory, seen, assignment)
    joined = is_open and _joined(from_slot)
    limit_bank = model.max_bank if from_slot.right < 0.0 else -model.max_bank
    lead = min(roll_lead(model, seen.pursuer.bank, limit_bank), roll_lead(model, 0.0, limit_bank))
    rate = closing_turn_rate(from_slot, seen.pursuer, model=model, lead=lead)
    message = "Joined: following the leader's path." if joined else "Capturing the leader's route."
    mode, events = _mode(memory, "follow" if joined else "capture", message)
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


def _follow(memory: Memory, seen: Seen, assignment: Assignment) -> tuple[Memory, Advice] | None:
    """Fly the leader's path at D; `None` when it is lost or leads too close."""
    model, path = assignment.model, memory.flown
    from_slot = path.offsets(seen.pursuer, assignment.slot_distance)
    if abs(from_slot.right) > LOST_ACROSS or abs(from_slot.heading) > LOST_HEADING:
        return None
    mark = path.at(path.last.s - assignment.slot_distance)
    slot = Slot(mark.x, mark.y, mark.heading, seen.leader.tas, mark.turn_rate)
    # turn where the leader turned, begun early by the roll
    lead = roll_lead(model, 0.0, model.max_bank)
    ahead = path.at(mark.s + from_slot.ahead + seen.pursuer.tas * lead)
    rate = ahead.turn_rate * seen.pursuer.tas / seen.leader.tas
    rate += closing_turn_rate(from_slot, seen.pursuer, model=model, lead=0.0)
    apart = hypot(seen.pursuer.x - seen.leader.x, seen.pursuer.y - seen.leader.y)
    # along a bend the leader is nearer than D: whichever is shorter rules the speed
    room = apart - assignment.min_separation - SEPARATION_BUFFER
    to_slot = min(-from_slot.ahead, room) if room < 0.0 else -from_slot.ahead
    mode, events = _mode(memory, "follow", "Following the leader's path.")
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


def _hold(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation, answer: NoPlan
) -> tuple[Memory, Advice]:
    """Nothing to fly: hold the present heading, or the nearest that keeps clear of the leader."""
    slot = slot_of(situation)
    news = () if memory.missing == answer.reason else (PlanMissing(answer=answer),)
    mode, events = _mode(memory, "heading", f"No plan: holding a safe heading. {answer.message}")
    memory = replace(memory, mode=mode, committed=None, shown=None, missing=answer.reason)
    return memory, Advice(
        reference=HoldHeading(safe_heading(situation)),
        commanded_tas=assignment.tas,
        mode=mode,
        slot=slot,
        slot_open=_slot_open(memory, seen, assignment),
        to_slot=-offsets(seen.pursuer, slot).ahead,
        time_to_go=0.0,
        joined=False,
        events=(*news, *events),
    )


def _braked(to_gain: Metre, slot: Slot, assignment: Assignment) -> MetrePerSecond:
    """V_P, less what braking for the slot takes off it; a slower pursuer has nothing to brake."""
    if assignment.tas <= slot.tas:
        return assignment.tas
    return spacing_tas(to_gain, slot.tas, model=assignment.model, fastest=assignment.tas)


def _joined(seen: Offsets) -> bool:
    """Eq. (7) within tolerance."""
    return (
        abs(seen.ahead) <= JOINED_ALONG
        and abs(seen.right) <= JOINED_ACROSS
        and abs(seen.heading) <= JOINED_HEADING
    )


def _slot_open(memory: Memory, seen: Seen, assignment: Assignment) -> bool:
    return not seen.turn_to_come and memory.flown.slot_open(assignment.slot_distance)


def _mode(memory: Memory, mode: Mode, message: str) -> tuple[Mode, tuple[Event, ...]]:
    if mode == memory.mode:
        return mode, ()
    return mode, (ModeChange(mode=mode, previous=memory.mode, message=message),)
