"""advise(memory, belief): what to fly for the next second, and what to say of it.

Each second: what is new of the leader → which path to fly, or to propose where guidance is not
engaged → one act of the laws → the monitor, and an escape if what is flown now would lose d_min.
Every answer is a new memory and an `Advice`: nothing here changes in place.
"""

from dataclasses import replace
from math import cos, hypot, sin

from relguide.flying.belief import SEEMS, Belief
from relguide.flying.guidance.amid import Nearing, keeps_clear
from relguide.flying.guidance.announcements import (
    Event,
    PlanReason,
    UnableReason,
    UnableTo,
    leader_change,
)
from relguide.flying.guidance.as_flown import look_out_by_hand
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.better import better, change_margin, may_be_improved
from relguide.flying.guidance.commit.committed import (
    BRAKES_FOR,
    Committed,
    place_on,
    slot_mismatch,
)
from relguide.flying.guidance.commit.proposal import NoProposal, NotBetter, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.forecast import NO_COURSE, forecast
from relguide.flying.guidance.joining import judge_spacing, promise_anew
from relguide.flying.guidance.leader_news import (
    is_steady,
    judge_speed,
    notice_leader,
    turns_unannounced,
)
from relguide.flying.guidance.leaving import (
    clear_way,
    keep_heading,
    must_leave,
    turn_away,
)
from relguide.flying.guidance.memory import Advice, Memory, Slot, enter
from relguide.flying.guidance.monitor import (
    Outlook,
    highest,
    is_as_forecast,
    judge_others,
    judge_separation,
    leader_is_as_forecast,
    look_out,
)
from relguide.flying.guidance.plan_news import (
    announce_pending,
    count_refusal,
    fly_proposal,
    retry_pause,
    say_no_plan,
)
from relguide.flying.guidance.situations import situation_now
from relguide.flying.guidance.stand_by import give_up_old_data, stand_by
from relguide.flying.modes import NAMES, NUMBERS
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.flight import marks as at
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import Act, Progress, act
from relguide.kernels.flight.marks import mark_at
from relguide.planning.outcome import Planner
from relguide.planning.phrases import distance
from relguide.planning.slot import slot_frame
from relguide.units import Metre, Second


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
        memory, news = _try_to_plan(memory, belief, assignment, planner)
        events += news
    elif memory.mode == "converge":
        memory, news = _stay_or_change(memory, belief, assignment, planner)
        events += news
    elif _has_left_capture(memory, belief, assignment):
        strayed = _has_strayed(memory, belief, assignment)
        reason: PlanReason = "deviation" if strayed else "leader_turned"
        memory, news = _plan_again(memory, belief, assignment, planner, reason=reason)
        events += news
    if engaged:
        memory, news = keep_heading(memory, belief, assignment)
        events += news
    done = _act(memory, belief, assignment)
    outlook = _outlook(memory, belief, assignment)
    if memory.mode == "converge" and outlook.pressing(belief.t) is not None:
        memory, news = _plan_around(memory, belief, assignment, planner, outlook)
        if news:
            events += news
            done = _act(memory, belief, assignment)
            outlook = _outlook(memory, belief, assignment)
    if memory.mode not in ("heading", "escape") and must_leave(memory, belief, assignment, outlook):
        memory, news = _replan_or_escape(memory, belief, assignment, planner, outlook)
        events += news
        done = _act(memory, belief, assignment)
        outlook = _outlook(memory, belief, assignment)
    memory, news = _follow_act(memory, belief, done)
    events += news
    flown = look_out_by_hand(outlook, belief, assignment)
    alert, said = judge_separation(memory.alert, flown, belief, assignment)
    standing, of_others = judge_others(memory.others, flown, belief, assignment)
    memory = memory._replace(alert=alert, others=standing, forecast=outlook.forecast)
    memory, news = promise_anew(memory, belief, assignment)
    events += news
    memory, news = judge_spacing(memory, belief, assignment, done, outlook)
    events += news
    return memory, _advice(memory, belief, assignment, done, (*events, *said, *of_others))


def _try_to_plan(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """From a held heading: converge as soon as there is a path that keeps d_min."""
    settings, t = assignment.settings, belief.t
    if t - memory.asked < retry_pause(memory, belief, assignment):
        return memory, []
    if memory.mode == "escape":
        rested = t - memory.since >= settings.escapes_for and is_steady(memory, belief, assignment)
        clear = min(assignment.min_separation + settings.escape_room, assignment.aim)
        if not rested or belief.counted_separation < clear:
            return memory, []
    found = propose(belief, assignment, None, planner)
    memory, events = count_refusal(memory._replace(asked=t), found)
    if isinstance(found, NoProposal):
        return say_no_plan(memory, belief, assignment, found.answer, events)
    reason: PlanReason = "engaged" if memory.announced is None else "resumed"
    return fly_proposal(memory, belief, assignment, found, reason, events)


def _stay_or_change(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """On a committed path: go on, unless the leader moved the slot, or another path is better."""
    settings, committed, t = assignment.settings, memory.committed, belief.t
    if committed is None:
        return _plan_again(memory, belief, assignment, planner, reason="assignment_changed")
    committed, right = place_on(committed, belief, memory.progress.s)
    memory = memory._replace(committed=committed)
    now = memory.leader  # noticed this second
    changed = leader_change(
        memory.expected,
        now,
        settings.leader_turned + belief.heading_slack,
        settings.leader_speed + belief.speed_slack,
    )
    as_forecast = memory.forecast is not None and leader_is_as_forecast(
        memory.forecast, belief, assignment
    )
    strayed = memory.forecast is not None and abs(right) > settings.strayed
    if strayed:
        return _plan_again(memory, belief, assignment, planner, reason="deviation")
    off = slot_mismatch(belief, committed) - committed.accepted
    news = now.intent_known != memory.expected.intent_known
    if not as_forecast and (news or off > settings.slot_moved + _slot_slack(belief, committed)):
        steady = is_steady(memory, belief, assignment)
        stay = 0.0 if steady else settings.better_while_turning
        reason: PlanReason = changed or "leader_elsewhere"
        if news or turns_unannounced(belief, assignment):
            return _plan_again(memory, belief, assignment, planner, reason=reason, stay=stay)
        return _plan_if_sooner(memory, committed, belief, assignment, planner, reason)
    if _is_overdue(memory, belief, assignment):
        return _plan_again(memory, belief, assignment, planner, reason="leader_elsewhere")
    memory, events = announce_pending(memory, belief, assignment)
    if not as_forecast or not _asks_now(memory, committed, t, assignment):
        return memory, events
    memory = memory._replace(asked=t)
    found = better(belief, assignment, committed, planner)
    memory, refused = count_refusal(memory, found)
    events = [*events, *refused]
    if isinstance(found, NotBetter):
        return memory, events
    return fly_proposal(memory, belief, assignment, found, "better_plan", events)


def _plan_if_sooner(
    memory: Memory,
    committed: Committed,
    belief: Belief,
    assignment: Assignment,
    planner: Planner,
    reason: PlanReason,
) -> tuple[Memory, list[Event]]:
    """Another path, where the leader is not as expected, if it joins sooner than the one flown.

    Near the slot a new path may be a full circle, where a little more or less speed does as well.
    """
    until = max(committed.due, belief.t) + BRAKES_FOR
    ahead = forecast(belief, assignment, memory.progress, committed.course, until=until)
    least = committed.kept(ahead, belief.t, assignment)
    lost = keeps_clear(ahead, belief, assignment) is not None
    if not ahead.joins or least < assignment.kept_separation or lost:
        return _plan_again(memory, belief, assignment, planner, reason=reason)
    found = propose(belief, assignment, committed, planner)
    memory, events = count_refusal(memory._replace(asked=belief.t), found)
    margin = change_margin(committed, belief.t, assignment)
    if isinstance(found, Proposal):
        other = found.committed.forecast
        if other.joins and other.join_time < ahead.join_time - margin:
            return fly_proposal(memory, belief, assignment, found, reason, events)
    kept = committed._replace(forecast=ahead, accepted=slot_mismatch(belief, committed))
    return memory._replace(committed=kept, forecast=ahead), events


MAY_MOVE: Metre = 600.0
"""A slot minutes ahead may seem to move so far, as the leader's velocity is uncertain [m]."""


def _slot_slack(belief: Belief, committed: Committed) -> Metre:
    """How far the slot may only seem to have moved, where it will be when the plan ends [m]."""
    left = max(committed.due - belief.t, 0.0)
    return belief.place_slack + min(SEEMS * belief.spread.velocity * left, MAY_MOVE)


def _is_overdue(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the path has been flown to its end and does not join."""
    committed, t = memory.committed, belief.t
    if committed is None or t < committed.due + assignment.settings.overdue:
        return False
    ahead = committed.forecast if memory.forecast is None else memory.forecast
    return not ahead.joins


def _asks_now(memory: Memory, committed: Committed, t: Second, assignment: Assignment) -> bool:
    """Whether the planner is asked for a path that is better than the committed one."""
    settings = assignment.settings
    if settings.always_ask:
        return True
    if not may_be_improved(committed, t, assignment):
        return False
    return committed.plan.planner != "exact" or t - memory.asked >= settings.ask_every


def _plan_again(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    planner: Planner,
    *,
    reason: PlanReason = "leader_turned",
    stay: Second = 0.0,
) -> tuple[Memory, list[Event]]:
    """A new path; if there is none, hold a heading or turn away."""
    committed = None if reason == "deviation" else memory.committed
    found = propose(belief, assignment, committed, planner, stay=stay)
    memory = memory._replace(asked=belief.t)
    memory, events = count_refusal(memory, found)
    if isinstance(found, Proposal):
        return fly_proposal(memory, belief, assignment, found, reason, events)
    memory, events = say_no_plan(memory, belief, assignment, found.answer, events)
    message = f"No plan: holding a safe heading. {found.answer.message}"
    memory, news = enter(memory, belief, "heading", message)
    out = clear_way(memory, belief, assignment)
    tas = out.tas if out.tas < belief.own.tas else assignment.planned_tas
    progress = Progress(NUMBERS["heading"], 0.0, out.heading, tas)
    return memory._replace(progress=progress, committed=None, forecast=None), [*events, *news]


def _has_left_capture(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the pursuer is no longer near the leader's flown path, or the slot is far off it."""
    if _has_strayed(memory, belief, assignment):
        return True
    if memory.mode == "follow":
        return False
    settings, s, marks = assignment.settings, memory.progress.s, belief.track.marks
    turned = abs(wrap_signed(belief.leader_rolled_out - memory.captured))
    to_slot = marks[-1, at.S] - assignment.aim - s
    return bool(turned > settings.route_left and abs(to_slot) > settings.too_far)


def _has_strayed(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the pursuer is far beside the leader's flown path, or flies across it."""
    settings, own = assignment.settings, belief.own
    _, x, y, heading, _ = mark_at(belief.track.marks, at.S, memory.progress.s + own.tas)
    if hypot(own.x - x, own.y - y) > settings.lost_across:
        return True
    return abs(wrap_signed(own.heading - heading)) > settings.lost_heading


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


def _plan_around(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    planner: Planner,
    outlook: Outlook,
) -> tuple[Memory, list[Event]]:
    """Another path where the one that is flown would come too close to another aircraft or a cell.

    What is far ahead may change again: it is planned for less often than what is near.
    """
    settings, pressing = assignment.settings, outlook.pressing(belief.t)
    assert pressing is not None
    near = pressing.breaks - belief.t <= settings.watch
    if belief.t - memory.avoided < (settings.retry if near else settings.ask_every):
        return memory, []
    found = propose(belief, assignment, memory.committed, planner)
    memory = memory._replace(avoided=belief.t, because=_what_it_did(pressing, belief))
    memory, events = count_refusal(memory, found)
    if isinstance(found, Proposal):
        return fly_proposal(memory, belief, assignment, found, "traffic", events)
    return memory, events


def _what_it_did(near: Nearing, belief: Belief) -> str:
    """Why there is another plan because of one of the others, without a full stop."""
    for other in belief.others:
        if other.ident == near.ident and other.broke_its_word:
            return f"{near.name} does not fly what it declared"
        if other.ident == near.ident and other.turns_unannounced:
            return f"{near.name} turns"
    return near.sentence


def _replan_or_escape(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    planner: Planner,
    outlook: Outlook,
) -> tuple[Memory, list[Event]]:
    """Another path if there is one that keeps clear of all; else away from them."""
    turns_on = turns_unannounced(belief, assignment)
    pressing = outlook.pressing(belief.t, assignment.settings.watch)
    events: list[Event] = []
    if not turns_on and memory.avoided != belief.t:
        found = propose(belief, assignment, memory.committed, planner)
        memory, events = count_refusal(memory, found)
        if isinstance(found, Proposal):
            reason: PlanReason = "separation"
            if pressing is not None:
                reason = "traffic"
                memory = memory._replace(because=_what_it_did(pressing, belief))
            memory, news = fly_proposal(memory, belief, assignment, found, reason, events)
            return memory, news
    if pressing is not None:
        why = f"{_what_it_did(pressing, belief)}."
    elif turns_on:
        why = "The leader is turning; if it goes on, there may soon be no way to keep clear."
    else:
        why = f"What is flown would come within {distance(outlook.least)} of the leader."
    cause: UnableReason = "separation" if pressing is None else "traffic"
    said = UnableTo(reason=cause, message=f"Unable: {why}")
    memory, news = turn_away(memory, belief, assignment, why)
    return memory._replace(asked=belief.t), [*events, said, *news]


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
        alert=highest(memory.alert, *(alert for _, alert in memory.others)),
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
