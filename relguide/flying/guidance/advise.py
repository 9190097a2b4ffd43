"""advise(memory, belief): what to fly for the next second, and what to say of it.

Each second: what is new of the leader → which path to fly → one act of the laws → the monitor, and
an escape if what is flown now would lose d_min. Every answer is a new memory and an `Advice`:
nothing here changes in place.
"""

from dataclasses import replace
from math import cos, hypot, sin

from relguide.flying.belief import Belief
from relguide.flying.guidance import converge
from relguide.flying.guidance.announcements import (
    Event,
    ModeChange,
    NewPlan,
    PlanMissing,
    PlanReason,
    Refused,
    UnableReason,
    UnableTo,
    expectation,
    leader_change,
    reason_sentence,
    summary,
)
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.committed import (
    Committed,
    situation_now,
    shown_plan,
    slot_mismatch,
)
from relguide.flying.guidance.converge import NoProposal, Proposal
from relguide.flying.guidance.escape import escape, kept_on_heading
from relguide.flying.guidance.forecast import NO_COURSE
from relguide.flying.guidance.memory import Advice, Announced, Memory, Slot
from relguide.flying.guidance.path_distance import is_same_path
from relguide.flying.modes import NAMES, NUMBERS, Mode, change
from relguide.flying.guidance.monitor import (
    Outlook,
    is_as_forecast,
    judge_separation,
    leader_is_as_forecast,
    look_out,
)
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.flight import marks as at
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import Act, Progress, act
from relguide.kernels.flight.marks import mark_at
from relguide.planning.phrases import distance
from relguide.planning.plan import NoPlan, Planner, Reason
from relguide.planning.slot import slot_frame
from relguide.units import DEG, KT, Metre, MetrePerSecond, Second

OWN_TUBE: Metre = 60.0
"""What an escape must keep beyond d_min: its turn is planned without the roll's soft ends [m]."""
TURNED: float = 3.0 * DEG
"""A leader that has turned so far since capture began has left the route that was captured [rad].
It moves the slot by 0.5 km, which capture takes up."""
ESCAPES_FOR: Second = 10.0
"""An escape is flown for so long at least: nothing is gained by wavering [s]."""
ROOM: Metre = 400.0
"""So much more than d_min is wanted before an escape is left [m]."""


def advise(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, Advice]:
    """What to fly for the next second."""
    memory, slowing = _notice_leader(memory, belief, assignment)
    memory, unfit = _judge_speed(memory, belief, assignment)
    events: list[Event] = [*unfit]
    if memory.unable == "speed":
        if memory.mode not in ("heading", "escape"):
            memory, news = _leave(memory, belief, assignment, "The leader cannot be followed.")
            events += news
    elif memory.mode in ("heading", "escape"):
        memory, news = _try_to_plan(memory, belief, assignment, planner)
        events += news
    elif memory.mode == "converge":
        memory, news = _stay_or_change(memory, belief, assignment, planner)
        events += news
    elif _has_left_capture(memory, belief, assignment):
        memory, news = _plan_again(memory, belief, assignment, planner)
        events += news
    memory = _keep_heading(memory, belief, assignment)
    done = _act(memory, belief, assignment)
    outlook = _outlook(memory, belief, assignment, slowing)
    if memory.mode not in ("heading", "escape") and _must_leave(
        memory, belief, assignment, outlook, slowing
    ):
        memory, news, saved = _replan_or_escape(memory, belief, assignment, planner, outlook)
        events += news
        done = _act(memory, belief, assignment)
        outlook = saved or _outlook(memory, belief, assignment, slowing)
    memory, news = _follow_act(memory, done, assignment, belief)
    events += news
    apart = hypot(belief.own.x - belief.leader.x, belief.own.y - belief.leader.y)
    alert, said = judge_separation(memory.alert, outlook, apart, belief, assignment)
    memory = replace(memory, alert=alert, forecast=outlook.forecast)
    return memory, _advice(memory, belief, assignment, done, (*events, *said))


def _notice_leader(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, MetrePerSecond]:
    """Remember when the leader last did something new, and by how much it slows down [m/s²]."""
    settings, now, was = assignment.settings, expectation(belief), memory.leader
    turning = not belief.intent_known and abs(belief.leader_turn_rate) > settings.turning
    rate = now.tas - was.tas
    moved = turning or abs(rate) > 0.1 or now.intent_known != was.intent_known
    changed = belief.t if moved else memory.changed
    memory = replace(
        memory, leader=now, leader_heading=belief.leader.heading, changed=changed
    )
    return memory, max(-rate, 0.0) if abs(rate) > 0.1 else 0.0


def _is_steady(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    return belief.t - memory.changed >= assignment.settings.settled_for


def _turns_unannounced(belief: Belief, assignment: Assignment) -> bool:
    return (
        not belief.intent_known
        and abs(belief.leader_turn_rate) > assignment.settings.turning
    )


def _judge_speed(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, tuple[Event, ...]]:
    """Whether the leader is slower than the pursuer can fly, and what is said of it once."""
    slow, in_hand = belief.leader.tas, assignment.settings.speed_in_hand
    if slow < assignment.min_tas - in_hand:
        if memory.unable == "speed":
            return memory, ()
        message = (
            f"Unable to follow: the leader flies {slow / KT:.0f} kt, and "
            f"{assignment.min_tas / KT:.0f} kt is the least speed of this "
            f"{assignment.aircraft_type} at its level."
        )
        said = UnableTo(reason="speed", message=message)
        return replace(memory, unable="speed"), (said,)
    if memory.unable == "speed" and slow > assignment.min_tas:
        return replace(memory, unable=None, asked=-1e9), ()
    return memory, ()


def _enter(memory: Memory, belief: Belief, to: Mode, message: str) -> tuple[Memory, list[Event]]:
    """The mode entered, and the event that says so if it is a new one."""
    if to == memory.mode:
        return memory, []
    event = ModeChange(mode=change(memory.mode, to), previous=memory.mode, message=message)
    progress = memory.progress._replace(mode=NUMBERS[to])
    return replace(memory, mode=to, since=belief.t, progress=progress), [event]


def _leave(
    memory: Memory, belief: Belief, assignment: Assignment, why: str
) -> tuple[Memory, list[Event]]:
    """Turn away to a heading that keeps clear."""
    out = _clear_heading(belief, assignment)
    degrees = round(out / DEG) % 360
    memory, news = _enter(memory, belief, "escape", f"{why} Turning to {degrees:03d}°.")
    progress = Progress(NUMBERS["escape"], 0.0, out, belief.own.tas)
    return replace(memory, progress=progress, committed=None, forecast=None), news


def _clear_heading(belief: Belief, assignment: Assignment) -> float:
    turns_on = _turns_unannounced(belief, assignment)
    wanted = assignment.buffered_separation
    return escape(belief, assignment, wanted, turns_on=turns_on).heading


def _keep_heading(memory: Memory, belief: Belief, assignment: Assignment) -> Memory:
    """Keep the heading held for as long as it keeps clear, so that it does not jump."""
    if memory.mode not in ("heading", "escape"):
        return memory
    progress = memory.progress
    turns_on = _turns_unannounced(belief, assignment)
    wanted = assignment.min_separation + OWN_TUBE
    if kept_on_heading(belief, assignment, progress.heading, turns_on=turns_on) >= wanted:
        return memory
    out = escape(belief, assignment, assignment.buffered_separation, turns_on=turns_on)
    now = kept_on_heading(belief, assignment, progress.heading, turns_on=turns_on)
    if out.least_separation < now + OWN_TUBE:
        return memory
    return replace(memory, progress=progress._replace(heading=out.heading))


def _try_to_plan(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """From a held heading: converge as soon as there is a path that keeps d_min."""
    settings, t = assignment.settings, belief.t
    if t - memory.asked < settings.retry:
        return memory, []
    if memory.mode == "escape":
        apart = hypot(belief.own.x - belief.leader.x, belief.own.y - belief.leader.y)
        rested = t - memory.since >= ESCAPES_FOR and _is_steady(memory, belief, assignment)
        if not rested or apart < min(assignment.min_separation + ROOM, assignment.aim):
            return memory, []
    found = converge.propose(belief, assignment, None, planner)
    memory = replace(memory, asked=t)
    memory, events = _count_refusal(memory, found)
    if isinstance(found, NoProposal):
        return _say_no_plan(memory, belief, assignment, found.answer, events)
    reason: PlanReason = "engaged" if memory.announced is None else "better_plan"
    return _fly(memory, belief, assignment, found, reason, events)


def _say_no_plan(
    memory: Memory, belief: Belief, assignment: Assignment, answer: NoPlan, events: list[Event]
) -> tuple[Memory, list[Event]]:
    if memory.missing != answer.reason:
        events.append(PlanMissing(answer=answer))
        reason: UnableReason = (
            "speed" if answer.reason == Reason.SLOT_UNREACHABLE else "separation"
        )
        events.append(UnableTo(reason=reason, message=f"Unable: {answer.message}"))
    return replace(memory, missing=answer.reason), events


def _stay_or_change(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """On a committed path: go on, unless the leader moved the slot, or another path is better."""
    settings, committed, t = assignment.settings, memory.committed, belief.t
    if committed is None:
        return _plan_again(memory, belief, assignment, planner)
    memory = replace(memory, committed=replace(committed, s=memory.progress.s))
    now = expectation(belief)
    changed = leader_change(memory.expected, now, settings.leader_turned, settings.leader_speed)
    as_forecast = memory.forecast is not None and leader_is_as_forecast(
        memory.forecast, belief, assignment
    )
    strayed = memory.forecast is not None and _strayed(memory, belief, assignment)
    if strayed:
        return _plan_again(memory, belief, assignment, planner, reason="deviation")
    if not as_forecast and (
        now.intent_known != memory.expected.intent_known
        or slot_mismatch(belief, committed) > settings.slot_moved
    ):
        stay = 0.0 if _is_steady(memory, belief, assignment) else settings.better_while_turning
        reason = changed or "deviation"
        return _plan_again(memory, belief, assignment, planner, reason=reason, stay=stay)
    memory, events = _announce_pending(memory, belief, assignment)
    if not as_forecast or not converge.may_be_bettered(committed, t, assignment):
        return memory, events
    if committed.plan.planner == "exact" and t - memory.asked < settings.ask_every:
        return memory, events
    memory = replace(memory, asked=t)
    found = converge.better(belief, assignment, committed, planner)
    if found is None:
        return memory, events
    memory, refused = _count_refusal(memory, found)
    return _fly(memory, belief, assignment, found, "better_plan", [*events, *refused])


def _strayed(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the aircraft is far beside its path."""
    committed = memory.committed
    if committed is None:
        return False
    since, wind = belief.t - committed.course.begun, belief.wind
    x, y = belief.own.x - wind.east * since, belief.own.y - wind.north * since
    _, right = on.project(committed.course.path, x, y, committed.s + belief.own.tas)
    return bool(abs(right) > assignment.settings.strayed)


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
    found = converge.propose(belief, assignment, committed, planner, stay=stay)
    memory = replace(memory, asked=belief.t)
    memory, events = _count_refusal(memory, found)
    if isinstance(found, Proposal):
        return _fly(memory, belief, assignment, found, reason, events)
    memory, events = _say_no_plan(memory, belief, assignment, found.answer, events)
    message = f"No plan: holding a safe heading. {found.answer.message}"
    memory, news = _enter(memory, belief, "heading", message)
    out = _clear_heading(belief, assignment)
    progress = Progress(NUMBERS["heading"], 0.0, out, assignment.tas)
    return replace(memory, progress=progress, committed=None, forecast=None), [*events, *news]


def _fly(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    found: Proposal,
    reason: PlanReason,
    events: list[Event],
) -> tuple[Memory, list[Event]]:
    """Commit to a proposal; announce it if it is news and the leader has settled."""
    committed = found.committed
    message = f"Converging by {committed.plan.word}."
    memory, news = _enter(memory, belief, "converge", message)
    memory = replace(
        memory,
        committed=committed,
        forecast=committed.forecast,
        progress=Progress(NUMBERS["converge"], committed.s, 0.0, 0.0),
        missing=None,
    )
    shown = shown_plan(committed.plan, found.lead, belief, assignment)
    is_news = _is_news(memory, belief, assignment, committed, shown.trajectory, reason)
    announced = is_news and (
        memory.announced is None
        or reason in ("separation", "engaged")
        or _may_speak(memory, belief, assignment)
    )
    joins = committed.forecast.join_time if committed.forecast.joins else committed.due
    text = f"{reason_sentence(reason, belief)}: {summary(shown, joins - belief.t)}."
    said = NewPlan(
        committed=committed, shown=shown, reason=reason, message=text, announced=announced
    )
    if announced:
        memory = _announced(memory, belief, shown, joins)
    elif is_news:
        memory = replace(memory, pending=reason)
    memory = replace(memory, expected=expectation(belief))
    return memory, [*events, *news, said]


def _announced(memory: Memory, belief: Belief, shown: converge.Plan, joins: Second) -> Memory:
    told = Announced(belief.t, joins, shown.trajectory)
    return replace(memory, announced=told, pending=None)


def _may_speak(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the leader has settled, and the last announcement is not of just now."""
    last = memory.announced
    rested = last is None or belief.t - last.t >= assignment.settings.announce_after
    return rested and _is_steady(memory, belief, assignment)


def _is_news(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    committed: Committed,
    path: converge.Trajectory,
    reason: PlanReason,
) -> bool:
    """Whether the path or its time is not what a crew was told."""
    settings, told = assignment.settings, memory.announced
    if told is None or reason in ("engaged", "separation", "better_plan"):
        return True
    if memory.pending is not None:
        return True
    joins = committed.forecast.join_time if committed.forecast.joins else committed.due
    left = joins - belief.t
    if abs(joins - told.joins) > max(settings.shown_time, settings.shown_share * left):
        return True
    return not is_same_path(path, told.path)


def _announce_pending(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Say now what was not said while the leader was doing something new."""
    committed, reason = memory.committed, memory.pending
    if committed is None or reason is None or not _may_speak(memory, belief, assignment):
        return memory, []
    lead = converge.lead_in(belief, assignment, committed)
    left = committed.remaining(belief.t, assignment.tas)
    now = situation_now(belief, assignment)
    now = replace(
        now, pursuer=replace(now.pursuer, x=left.x, y=left.y, heading=left.heading)
    )
    plan = committed.plan
    shown = replace(
        plan,
        situation=now,
        trajectory=left,
        word=left.letters,
        certificate=converge.certify(left, now),
        optimality=replace(
            plan.optimality,
            lower_bound=min(plan.optimality.lower_bound + lead.seconds, left.duration),
            proof="none",
        ),
    )
    ahead = memory.forecast or committed.forecast
    joins = ahead.join_time if ahead.joins else committed.due
    text = f"{reason_sentence(reason, belief)}: {summary(shown, joins - belief.t)}."
    said = NewPlan(committed=committed, shown=shown, reason=reason, message=text, announced=True)
    memory = _announced(memory, belief, shown, joins)
    return replace(memory, expected=expectation(belief)), [said]


def _count_refusal(
    memory: Memory, found: Proposal | NoProposal
) -> tuple[Memory, list[Event]]:
    """Count that the exact plan took over, and say why if the planner's fault is a new one."""
    fault = None if found.refusal is None else found.refusal.fault
    news: list[Event] = []
    if found.refusal is not None and fault != memory.refused:
        news.append(Refused(refusal=found.refusal))
    return replace(memory, fallbacks=memory.fallbacks + found.fell_back, refused=fault), news


def _has_left_capture(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the pursuer is no longer near the leader's flown path, or the slot is far off it."""
    settings, s = assignment.settings, memory.progress.s
    marks = belief.track.marks
    _, x, y, heading, track = mark_at(marks, at.S, s + belief.own.tas)
    right = (belief.own.x - x) * cos(track) - (belief.own.y - y) * sin(track)
    if abs(right) > settings.lost_across:
        return True
    if abs(wrap_signed(belief.own.heading - heading)) > settings.lost_heading:
        return True
    if memory.mode == "follow":
        return False
    turned = abs(wrap_signed(belief.leader_rolled_out - marks[0, at.HEADING]))
    bent = abs(wrap_signed(belief.leader_rolled_out - heading))
    to_slot = marks[-1, at.S] - assignment.aim - s
    return min(turned, bent) > TURNED and abs(to_slot) > settings.too_far


def _act(memory: Memory, belief: Belief, assignment: Assignment) -> Act:
    course = NO_COURSE if memory.committed is None else memory.committed.course
    return act(
        memory.progress, belief.own, belief.limits, course, belief.track.marks,
        belief.turn_to_come, assignment.task, assignment.gate, assignment.gains, belief.drift,
        belief.t,
    )  # fmt: skip


def _outlook(
    memory: Memory, belief: Belief, assignment: Assignment, slowing: MetrePerSecond
) -> Outlook:
    ahead = memory.forecast
    trusted = ahead if ahead is not None and is_as_forecast(ahead, belief, assignment) else None
    course = NO_COURSE if memory.committed is None else memory.committed.course
    return look_out(
        belief,
        assignment,
        memory.progress,
        course,
        trusted,
        turns_on=_turns_unannounced(belief, assignment),
        slowing=slowing,
    )


def _must_leave(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    outlook: Outlook,
    slowing: MetrePerSecond,
) -> bool:
    """Whether what is flown now would lose d_min, or soon leave no way to keep it."""
    t, limit = belief.t, assignment.min_separation
    if outlook.forecast.least(t, assignment.settings.caution)[0] < limit:
        return True
    turns_on = _turns_unannounced(belief, assignment)
    if not turns_on and slowing == 0.0 and outlook.least >= limit:
        return False
    apart = hypot(belief.own.x - belief.leader.x, belief.own.y - belief.leader.y)
    wanted = min(limit + OWN_TUBE, apart)
    slows_to = belief.leader.tas - slowing * 20.0
    later = escape(
        belief, assignment, wanted, turns_on=turns_on, slows_to=slows_to, delay=1.0
    )
    return later.least_separation < wanted


def _replan_or_escape(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    planner: Planner,
    outlook: Outlook,
) -> tuple[Memory, list[Event], Outlook | None]:
    """Another path if there is one that keeps d_min; else away from the leader."""
    turns_on = _turns_unannounced(belief, assignment)
    if memory.mode == "converge" and not turns_on:
        found = converge.propose(belief, assignment, memory.committed, planner)
        if isinstance(found, Proposal):
            memory, events = _count_refusal(memory, found)
            memory, news = _fly(memory, belief, assignment, found, "separation", events)
            return memory, news, None
    why = (
        "The leader is turning; if it goes on, there may soon be no way to keep clear."
        if turns_on
        else f"What is flown would come within {distance(outlook.least)} of the leader."
    )
    said = UnableTo(reason="separation", message=f"Unable: {why}")
    memory, news = _leave(memory, belief, assignment, why)
    return replace(memory, asked=belief.t), [said, *news], None


def _follow_act(
    memory: Memory, done: Act, assignment: Assignment, belief: Belief
) -> tuple[Memory, list[Event]]:
    """The progress that the laws made, and the mode that they reached."""
    mode = NAMES[done.progress.mode]
    message = (
        "Joined: following the leader's path."
        if mode == "follow"
        else "Capturing the leader's route."
    )
    memory, events = _enter(memory, belief, mode, message)
    memory = replace(memory, progress=done.progress)
    if memory.mode in ("capture", "follow"):
        memory = replace(memory, committed=None)
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
        joins = ahead.join_time
        if not ahead.joins and memory.committed is not None:
            joins = memory.committed.due
        go = max(joins - belief.t, 0.0)
    tas = min(max(done.control.tas, belief.limits.min_tas), belief.limits.max_tas)
    return Advice(
        control=done.control._replace(tas=tas),
        mode=memory.mode,
        slot=_slot(memory, belief, assignment),
        slot_open=belief.slot_open(assignment.slot_distance),
        to_slot=done.to_slot,
        time_to_go=go,
        joined=done.joined,
        alert=memory.alert.level,
        forecast=ahead,
        events=events,
    )


def _slot(memory: Memory, belief: Belief, assignment: Assignment) -> Slot:
    """The slot now: on the leader's flown path, or on its final leg laid backward."""
    if memory.mode in ("capture", "follow"):
        marks = belief.track.marks
        s = float(marks[-1, at.S]) - assignment.slot_distance
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
            float(last[on.X]) + ahead * sin(heading) + belief.wind.east * since,
            float(last[on.Y]) + ahead * cos(heading) + belief.wind.north * since,
            wrap(heading),
            course.slot_tas,
        )
    situation = replace(
        situation_now(belief, assignment), slot_distance=assignment.slot_distance
    )
    frame = slot_frame(situation, situation.leader.trajectory)
    return Slot(frame.origin_x, frame.origin_y, frame.heading, belief.leader.tas)
