"""Guidance, once a second: what the pursuer knows → a reference for its autopilot, and a speed.

Modes: converge flies the committed plan; capture closes onto the leader's route by the laws of
`capture.py`, where the plan's problem is ill-posed; follow flies the leader's own path D behind it,
so it turns where the leader turned. With nothing to fly it holds a heading that keeps d_min.
Every answer is a new memory and an `Advice`: nothing here changes in place.
"""

from dataclasses import replace
from math import hypot, pi

from relguide.flying.aircraft import ground_velocity
from relguide.flying.announcements import (
    TURNED,
    Event,
    NewPlan,
    PlanMissing,
    PlanReason,
    because,
    expectation,
    leader_change,
    summary,
)
from relguide.flying.assignment import Assignment, Seen, situation_of, slot_of
from relguide.flying.autopilot import HoldHeading
from relguide.flying.capture import Offsets, Slot, braking_distance, offsets, spacing_tas
from relguide.flying.closing import (
    CAPTURE_HEADING,
    JOINED_ALONG,
    SEPARATION_BUFFER,
    capture,
    follow,
)
from relguide.flying.commitment import Cause, Choice, Commitment, choose
from relguide.flying.escape import escape_path
from relguide.flying.flown_path import path_extended
from relguide.flying.memory import Advice, Memory, into_mode, is_slot_open
from relguide.flying.steering import Steering, steer
from relguide.planning.plan import NoPlan, Plan, Planner, Reason
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Arc, Trajectory
from relguide.units import DEG, NM, Metre, MetrePerSecond, Radian, Second

TURNED_IN_CAPTURE: Radian = 3.0 * DEG  # less moves the slot by 0.5 km, which capture takes up
CAPTURE_TURN: Radian = 160.0 * DEG  # a longer final turn is flown as planned until this is left
LAST_STRETCH: Second = 30.0  # braking by now, the plan at V_P is no longer what will be flown
GOING_AROUND: Radian = 120.0 * DEG  # a plan that turns so much from close in is a detour, or a loop
CAPTURE_ACROSS: Metre = 1_500.0  # within the intercept law's linear range (30° ↔ 3.1 km)
A_SECOND: Second = 1.0  # until guidance speaks again
SHOWN_WITHIN: Metre = 0.25 * NM  # a re-solved path farther than this from the shown one is shown
SHOWN_WITHIN_TIME: Second = 3.0  # … or one that arrives so much earlier or later
SHOWN_WITHIN_SHARE = 0.01  # and by this much of the time to go


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
        followed = follow(memory, seen, assignment)
        if followed is not None:
            return followed
    situation = situation_of(seen, assignment, assignment.min_separation)
    bend = (seen.final_heading - memory.slot_heading + pi) % (2.0 * pi) - pi
    if memory.mode == "capture" and abs(bend) < TURNED_IN_CAPTURE:
        captured = capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured
    return _converge(memory, seen, assignment, situation, planner)


def _converge(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation, planner: Planner
) -> tuple[Memory, Advice]:
    slot = slot_of(situation)
    from_slot = offsets(seen.pursuer, slot)
    near = _close_in(from_slot, slot, assignment)
    if seen.turning_unannounced and not near:
        trapped = _trapped(memory, seen, assignment, situation)
        if trapped is not None:
            return _hold(memory, seen, assignment, situation, trapped)
    choice = choose(
        memory.committed,
        seen.t,
        preferred=replace(situation, min_separation=_buffered(assignment)),
        required=situation,
        planner=planner,
        model=assignment.model,
    )
    memory = replace(memory, slot_heading=slot.heading)
    if isinstance(choice, NoPlan):
        captured = capture(memory, seen, assignment, situation) if near else None
        return captured or _hold(memory, seen, assignment, situation, choice)
    memory, events = _commit(memory, seen, choice)
    steering = steer(choice.plan.trajectory, assignment.model)
    around = near and _turning(choice.plan.trajectory) > GOING_AROUND
    if around or _final(steering, choice.plan, slot, assignment):
        captured = capture(memory, seen, assignment, situation)
        if captured is not None:
            return captured[0], replace(captured[1], events=(*events, *captured[1].events))
    mode, mode_events = into_mode(memory, "converge", f"Converging by {choice.plan.word}.")
    # what the plan gains on the slot: braking may have to begin before the last turn does
    to_gain = max(assignment.tas - slot.tas, 0.0) * choice.plan.time_to_converge
    return replace(memory, mode=mode), Advice(
        reference=steering.reference,
        commanded_tas=_braked(to_gain, slot, assignment),
        mode=mode,
        slot=slot,
        slot_open=is_slot_open(memory, seen, assignment),
        to_slot=-from_slot.ahead,
        time_to_go=choice.plan.time_to_converge,
        joined=False,
        events=(*events, *mode_events),
    )


def _commit(memory: Memory, seen: Seen, choice: Choice) -> tuple[Memory, tuple[Event, ...]]:
    """Remember the plan, and announce it if it is news."""
    due = seen.t + choice.plan.time_to_converge
    unchanged = leader_change(memory.expected, seen, TURNED) is None
    if memory.committed is not None and choice.cause == "continued" and unchanged:
        due = memory.committed.due
    commitment = Commitment(plan=choice.plan, made_at=seen.t, due=due)
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


def _trapped(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation
) -> NoPlan | None:
    """Why to turn away now from a leader who turns without a word; `None` if it can wait.

    What is planned keeps d_min if he stops turning. If there might be no way out a second later,
    were he to go on, it is taken now, and left when there is room to spare.
    """
    spare = SEPARATION_BUFFER if memory.mode == "heading" and memory.missing else 0.0
    keep = _buffered(assignment) + spare
    out = escape_path(
        situation,
        bank=seen.pursuer.bank,
        model=assignment.model,
        keep=keep,
        leader_turn_rate=seen.leader_turn_rate,
        delay=A_SECOND,
    )
    if out.least_separation >= keep:
        return None
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message="The leader turns, and if he goes on there may soon be no way out.",
    )


def _buffered(assignment: Assignment) -> Metre:
    """What new plans should keep; the slot itself must be far enough [m]."""
    return min(assignment.min_separation + SEPARATION_BUFFER, assignment.slot_distance)


def _hold(
    memory: Memory, seen: Seen, assignment: Assignment, situation: Situation, answer: NoPlan
) -> tuple[Memory, Advice]:
    """Nothing to fly: hold the present heading, or the nearest that keeps clear of the leader."""
    slot = slot_of(situation)
    out = escape_path(
        situation,
        bank=seen.pursuer.bank,
        model=assignment.model,
        keep=_buffered(assignment),
        leader_turn_rate=seen.leader_turn_rate if seen.turning_unannounced else 0.0,
    )
    news = () if memory.missing == answer.reason else (PlanMissing(answer=answer),)
    mode, events = into_mode(
        memory, "heading", f"No plan: holding a safe heading. {answer.message}"
    )
    memory = replace(memory, mode=mode, committed=None, shown=None, missing=answer.reason)
    return memory, Advice(
        reference=HoldHeading(out.heading),
        commanded_tas=assignment.tas,
        mode=mode,
        slot=slot,
        slot_open=is_slot_open(memory, seen, assignment),
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
