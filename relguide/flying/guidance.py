"""Guidance, once a second: what the pursuer knows → a reference for its autopilot, and a speed.

Modes: converge flies the committed plan; capture closes onto the leader's route by the laws of
`capture.py`, where the minimum-time problem is ill-posed; follow flies the leader's own path, D
behind it, so it turns where the leader turned; heading holds a heading that keeps d_min while there
is no plan. Every answer is a new memory and an `Advice`: nothing here changes in place.
"""

from dataclasses import replace
from math import hypot

from relguide.flying.aircraft import ground_velocity
from relguide.flying.announcements import (
    TURNED,
    Event,
    NewPlan,
    PlanReason,
    Refused,
    expectation,
    leader_change,
    reason_sentence,
    summary,
)
from relguide.flying.assignment import Assignment, Observation, situation_of, slot_of
from relguide.flying.capture import Offsets, Slot, braking_distance, offsets, spacing_tas
from relguide.flying.closing import (
    CAPTURE_HEADING,
    JOINED_ALONG,
    capture,
    follow,
)
from relguide.flying.commitment import Cause, Choice, Commitment, NoChoice, choose
from relguide.flying.flown_path import extend_path
from relguide.flying.holding import buffered_separation, hold_heading, reason_to_turn_away
from relguide.flying.memory import Advice, Memory, enter_mode, is_slot_open
from relguide.flying.steering import Steering, steer
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.plan import Plan, Planner
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Arc, Trajectory
from relguide.units import DEG, NM, Metre, MetrePerSecond, Radian, Second

TURNED_IN_CAPTURE: Radian = 3.0 * DEG  # moves the slot by 0.5 km, which capture corrects
CAPTURE_TURN: Radian = 160.0 * DEG  # a final turn is flown as planned down to this angle
LAST_STRETCH: Second = 30.0  # it brakes by now, so a plan at V_P is not what it will fly
GOING_AROUND: Radian = 120.0 * DEG  # a plan from near the slot that turns so much goes round again
CAPTURE_ACROSS: Metre = 1_500.0  # within the intercept law's linear range (30° ↔ 3.1 km)
SHOWN_WITHIN: Metre = 0.25 * NM  # a path solved again is shown if it is farther from the shown one
SHOWN_WITHIN_TIME: Second = 3.0  # … or if it arrives so much earlier or later
SHOWN_WITHIN_SHARE = 0.01  # and by this much of the time to go


def advise(
    memory: Memory, seen: Observation, assignment: Assignment, planner: Planner
) -> tuple[Memory, Advice]:
    """What to fly for the next second."""
    wind = assignment.wind
    memory = replace(
        memory,
        flown=extend_path(
            memory.flown,
            seen.leader,
            ground_velocity(seen.leader, wind.east, wind.north),
            seen.leader_turn_rate,
            assignment.slot_distance,
        ),
    )
    if memory.mode == "follow":
        followed = follow(memory, seen, assignment)
        if followed is not None:
            return followed
    situation = situation_of(seen, assignment, assignment.min_separation)
    bend = wrap_signed(seen.final_heading - memory.slot_heading)
    if memory.mode == "capture" and abs(bend) < TURNED_IN_CAPTURE:
        captured = capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured
    return _converge(memory, seen, assignment, situation, planner)


def _converge(
    memory: Memory,
    seen: Observation,
    assignment: Assignment,
    situation: Situation,
    planner: Planner,
) -> tuple[Memory, Advice]:
    slot = slot_of(situation)
    from_slot = offsets(seen.pursuer, slot)
    near = _is_close_in(from_slot, slot, assignment)
    if seen.turning_unannounced and not near:
        away = reason_to_turn_away(memory, seen, assignment, situation)
        if away is not None:
            return hold_heading(memory, seen, assignment, situation, away)
    choice = choose(
        memory.committed,
        seen.t,
        preferred=replace(situation, min_separation=buffered_separation(assignment)),
        required=situation,
        planner=planner,
        model=assignment.model,
    )
    memory = replace(memory, slot_heading=slot.heading)
    memory, refused = _count_refusal(memory, choice)
    if isinstance(choice, NoChoice):
        captured = capture(memory, seen, assignment, situation) if near else None
        memory, advice = captured or hold_heading(
            memory, seen, assignment, situation, choice.answer
        )
        return memory, replace(advice, events=(*refused, *advice.events))
    memory, events = _commit(memory, seen, choice)
    events = *refused, *events
    steering = steer(choice.plan.trajectory, assignment.model)
    around = near and _total_turn_angle(choice.plan.trajectory) > GOING_AROUND
    if around or _is_last_stretch(steering, choice.plan, slot, assignment):
        captured = capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured[0], replace(captured[1], events=(*events, *captured[1].events))
    mode, mode_events = enter_mode(memory, "converge", f"Converging by {choice.plan.word}.")
    # the plan gains so much on the slot; braking may have to begin before the last turn
    to_gain = max(assignment.tas - slot.tas, 0.0) * choice.plan.time_to_converge
    return replace(memory, mode=mode), Advice(
        reference=steering.reference,
        commanded_tas=_braking_tas(to_gain, slot, assignment),
        mode=mode,
        slot=slot,
        slot_open=is_slot_open(memory, seen, assignment),
        to_slot=-from_slot.ahead,
        time_to_go=choice.plan.time_to_converge,
        joined=False,
        events=(*events, *mode_events),
    )


def _count_refusal(memory: Memory, choice: Choice | NoChoice) -> tuple[Memory, tuple[Event, ...]]:
    """Count that the exact plan took over, and say why if the planner's fault is a new one."""
    fault = None if choice.refusal is None else choice.refusal.fault
    news: tuple[Event, ...] = ()
    if choice.refusal is not None and fault != memory.refused:
        news = (Refused(refusal=choice.refusal),)
    return replace(memory, fallbacks=memory.fallbacks + choice.fell_back, refused=fault), news


def _commit(memory: Memory, seen: Observation, choice: Choice) -> tuple[Memory, tuple[Event, ...]]:
    """Remember the plan, and announce it if it is new to the reader."""
    due = seen.t + choice.plan.time_to_converge
    unchanged = leader_change(memory.expected, seen, TURNED) is None
    if memory.committed is not None and choice.cause == "continued" and unchanged:
        due = memory.committed.due
    commitment = Commitment(plan=choice.plan, made_at=seen.t, due=due)
    memory = replace(
        memory,
        committed=commitment,
        missing=None,
    )
    reason = _reason_to_announce(memory, seen, choice.cause)
    if reason is None:
        return memory, ()
    message = f"{reason_sentence(reason, seen)}: {summary(choice.plan)}."
    memory = replace(memory, shown=commitment, planned=True, expected=expectation(seen))
    return memory, (NewPlan(commitment=commitment, reason=reason, message=message),)


def _reason_to_announce(memory: Memory, seen: Observation, cause: Cause) -> PlanReason | None:
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
    shown, left = memory.shown.place_at(seen.t, plan.situation)
    here = plan.trajectory
    tolerance = max(SHOWN_WITHIN_TIME, SHOWN_WITHIN_SHARE * plan.time_to_converge)
    pursuer, leader = plan.situation.pursuer.tas, plan.situation.leader.tas
    gain = (pursuer - leader) * plan.time_to_converge
    # while it brakes, arriving later than planned is no news
    cruising = gain > braking_distance(pursuer, leader)
    late = cruising and abs(plan.time_to_converge - left) > tolerance
    off = hypot(here.x - shown.x, here.y - shown.y) > SHOWN_WITHIN
    return "deviation" if late or off else None


def _is_last_stretch(steering: Steering, plan: Plan, slot: Slot, assignment: Assignment) -> bool:
    """Whether only the last turn of the plan, or only its braking, is still to be flown."""
    if (
        plan.time_to_converge < LAST_STRETCH
        and _total_turn_angle(plan.trajectory) < CAPTURE_HEADING
    ):
        return True
    arcs = [segment for segment in steering.segments if isinstance(segment, Arc)]
    if len(arcs) == 0:
        closing = (assignment.tas - slot.tas) * plan.time_to_converge
        return closing <= braking_distance(assignment.tas, slot.tas)
    return len(steering.segments) == 1 and arcs[0].turn_angle < CAPTURE_TURN


def _total_turn_angle(trajectory: Trajectory) -> Radian:
    return sum(s.turn_angle for s in trajectory.segments if isinstance(s, Arc))


def _is_close_in(seen: Offsets, slot: Slot, assignment: Assignment) -> bool:
    """Whether the pursuer is so near the slot and so well aligned that no plan is needed."""
    margin = max(assignment.slot_distance - assignment.min_separation, JOINED_ALONG)
    braking = braking_distance(assignment.tas, slot.tas)
    return (
        abs(seen.right) < CAPTURE_ACROSS
        and abs(seen.heading) < CAPTURE_HEADING
        and -margin < -seen.ahead < braking
    )


def _braking_tas(to_gain: Metre, slot: Slot, assignment: Assignment) -> MetrePerSecond:
    """V_P, or less when braking for the slot; a pursuer slower than the slot does not brake."""
    if assignment.tas <= slot.tas:
        return assignment.tas
    return spacing_tas(to_gain, slot.tas, model=assignment.model, fastest=assignment.tas)
