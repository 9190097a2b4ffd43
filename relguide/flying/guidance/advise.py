"""advise(memory, belief): what to fly for the next second, and what to say of it.

Each second: what is new of the leader → which path to fly, or to propose where guidance is not
engaged → one act of the laws → the monitor, and an escape if what is flown now would lose d_min.
Every answer is a new memory and an `Advice`: nothing here changes in place.
"""

from dataclasses import replace
from math import cos, sin

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import (
    Event,
    PlanReason,
)
from relguide.flying.guidance.as_flown import look_out_by_hand
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import (
    BRAKES_FOR,
)
from relguide.flying.guidance.forecast import NO_COURSE
from relguide.flying.guidance.joining import judge_spacing, promise_anew
from relguide.flying.guidance.leader_news import (
    judge_speed,
    notice_leader,
    turns_unannounced,
)
from relguide.flying.guidance.leaving import (
    keep_heading,
    must_leave,
    turn_away,
)
from relguide.flying.guidance.memory import Advice, Memory, Slot, enter
from relguide.flying.guidance.monitor import (
    Outlook,
    highest,
    is_as_forecast,
    judge_data,
    judge_others,
    judge_separation,
    look_out,
)
from relguide.flying.guidance.replanning import (
    has_left_capture,
    has_strayed,
    plan_again,
    plan_around,
    replan_or_escape,
    stay_or_change,
    try_to_plan,
)
from relguide.flying.guidance.situations import situation_now
from relguide.flying.guidance.stand_by import give_up_old_data, stand_by
from relguide.flying.modes import NAMES, NUMBERS
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.flight import marks as at
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import Act, act
from relguide.kernels.flight.marks import mark_at
from relguide.planning.outcome import Planner
from relguide.planning.slot import slot_frame


def advise(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, Advice]:
    """What to fly for the next second."""
    memory = notice_leader(memory, belief, assignment)
    memory, events = give_up_old_data(memory, belief, assignment)
    if memory.engagement != "off":
        memory, unfit = judge_speed(memory, belief, assignment)
        events += unfit
    engaged = memory.engagement == "engaged"
    if not engaged:
        memory, news = stand_by(memory, belief, assignment, planner)
        events += news
    elif memory.unable == "speed":
        if memory.mode not in ("heading", "escape"):
            why = "The leader cannot be followed."
            memory, news = turn_away(memory, belief, assignment, why, slower=True)
            events += news
    elif memory.mode in ("heading", "escape"):
        memory, news = try_to_plan(memory, belief, assignment, planner)
        events += news
    elif memory.mode == "converge":
        memory, news = stay_or_change(memory, belief, assignment, planner)
        events += news
    elif has_left_capture(memory, belief, assignment):
        strayed = has_strayed(memory, belief, assignment)
        reason: PlanReason = "deviation" if strayed else "leader_turned"
        memory, news = plan_again(memory, belief, assignment, planner, reason=reason)
        events += news
    if engaged:
        memory, news = keep_heading(memory, belief, assignment)
        events += news
    done = _act(memory, belief, assignment)
    outlook = _outlook(memory, belief, assignment)
    if memory.mode == "converge" and outlook.pressing(belief.t) is not None:
        memory, news = plan_around(memory, belief, assignment, planner, outlook)
        if news:
            events += news
            done = _act(memory, belief, assignment)
            outlook = _outlook(memory, belief, assignment)
    if memory.mode not in ("heading", "escape") and must_leave(memory, belief, assignment, outlook):
        memory, news = replan_or_escape(memory, belief, assignment, planner, outlook)
        events += news
        done = _act(memory, belief, assignment)
        outlook = _outlook(memory, belief, assignment)
    memory, news = _follow_act(memory, belief, done)
    events += news
    flown = look_out_by_hand(outlook, belief, assignment)
    alert, said = judge_separation(memory.alert, flown, belief, assignment)
    standing, of_others = judge_others(memory.others, flown, belief, assignment)
    unheard, of_data = judge_data(memory.unheard, belief, assignment)
    memory = memory._replace(
        alert=alert, others=standing, unheard=unheard, forecast=outlook.forecast
    )
    memory, news = promise_anew(memory, belief, assignment)
    events += news
    memory, news = judge_spacing(memory, belief, assignment, done, outlook)
    events += news
    return memory, _advice(memory, belief, assignment, done, (*events, *said, *of_data, *of_others))


def _act(memory: Memory, belief: Belief, assignment: Assignment) -> Act:
    course = NO_COURSE if memory.committed is None else memory.committed.course
    done = act(
        memory.progress, belief.own, belief.limits, course, belief.track.marks,
        belief.turn_to_come, assignment.task, assignment.gate, assignment.gains, belief.drift,
        belief.t,
    )  # fmt: skip
    if done.joined and memory.mode != "follow" and not belief.at_level:
        progress = done.progress._replace(mode=NUMBERS["capture"])
        return done._replace(joined=False, progress=progress)
    return done


def _outlook(memory: Memory, belief: Belief, assignment: Assignment) -> Outlook:
    ahead = memory.forecast
    trusted = ahead if ahead is not None and is_as_forecast(ahead, belief, assignment) else None
    committed, until = memory.committed, belief.t + assignment.settings.watch
    if committed is not None:  # all of its path, which is drawn
        until = max(committed.due, belief.t) + BRAKES_FOR
    elif memory.mode == "capture":  # until it joins, which is promised
        until = belief.t + BRAKES_FOR
    return look_out(
        belief,
        assignment,
        memory.progress,
        NO_COURSE if committed is None else committed.course,
        trusted,
        until=until,
        turns_on=turns_unannounced(belief, assignment),
        trend=memory.leader_trend,
    )


def _follow_act(memory: Memory, belief: Belief, done: Act) -> tuple[Memory, list[Event]]:
    """The progress that the laws made, and the mode that they reached."""
    mode = NAMES[done.progress.mode]
    message = (
        "Joined: following the leader's path."
        if mode == "follow"
        else "Capturing the leader's route."
    )
    memory, events = enter(memory, belief, mode, message)
    committed = None if memory.mode in ("capture", "follow") else memory.committed
    captured = memory.captured
    if events and mode == "capture":
        captured = belief.leader_rolled_out
    memory = memory._replace(progress=done.progress, committed=committed, captured=captured)
    return memory, events


def _advice(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    done: Act,
    events: tuple[Event, ...],
) -> Advice:
    ahead = memory.forecast
    assert ahead is not None  # the outlook has just flown it
    go = 0.0
    if not done.joined and memory.mode not in ("heading", "escape"):
        committed = memory.committed
        joins = ahead.join_time if committed is None else committed.joins_at(ahead)
        go = max(joins - belief.t, 0.0)
    control = done.control
    tas = min(max(control.tas, belief.limits.min_tas), belief.limits.max_tas)
    return Advice(
        control=control if tas == control.tas else control._replace(tas=tas),
        engagement=memory.engagement,
        leader_age=belief.leader_age,
        mode=memory.mode,
        slot=_slot(memory, belief, assignment),
        slot_open=belief.slot_open(assignment.slot_distance),
        to_slot=done.to_slot,
        wind=belief.wind,
        margin=assignment.margin,
        along=done.to_slot + assignment.aim - assignment.slot_distance,
        across=done.right,
        time_to_go=go,
        joined=done.joined,
        alert=highest(memory.alert, memory.unheard, *(alert for _, alert in memory.others)),
        forecast=ahead,
        events=events,
    )


def _slot(memory: Memory, belief: Belief, assignment: Assignment) -> Slot:
    """The slot now: on the leader's flown path, or on its final leg laid backward."""
    if memory.mode in ("capture", "follow"):
        marks = belief.track.marks
        s = float(marks[-1, at.S]) - assignment.slot_distance
        if assignment.spacing > 0.0:
            s = mark_at(marks, at.T, marks[-1, at.T] - assignment.spacing)[0]
        _, x, y, heading, _ = mark_at(marks, at.S, s)
        later = mark_at(marks, at.S, s + belief.leader.tas)[3]
        return Slot(x, y, wrap(heading), belief.leader.tas, wrap_signed(later - heading))
    if memory.committed is not None:
        course, since = memory.committed.course, belief.t - memory.committed.course.begun
        place = course.slot + course.slot_tas * since + assignment.aim - assignment.slot_distance
        last = course.path[-1]
        ahead = place - last[on.S]
        heading = float(last[on.HEADING])
        return Slot(
            float(last[on.X]) + ahead * sin(heading) + course.wind.east * since,
            float(last[on.Y]) + ahead * cos(heading) + course.wind.north * since,
            wrap(heading),
            course.slot_tas,
        )
    situation = replace(situation_now(belief, assignment), slot_distance=assignment.slot_distance)
    frame = slot_frame(situation, situation.leader.trajectory)
    return Slot(frame.origin_x, frame.origin_y, frame.heading, belief.leader.tas)
