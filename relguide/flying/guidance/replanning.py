"""When another path is asked for, and what is flown if there is none.

From a held heading; on a committed path, where the leader is not as expected or something better
may be found; off the leader's flown path; and where what is flown would come too close to another.
"""

from math import hypot

from relguide.flying.belief import SEEMS, Belief
from relguide.flying.guidance.amid import Nearing, keeps_clear
from relguide.flying.guidance.announcements import (
    Event,
    PlanReason,
    UnableReason,
    UnableTo,
    leader_change,
)
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
from relguide.flying.guidance.forecast import forecast
from relguide.flying.guidance.leader_news import (
    is_steady,
    turns_unannounced,
)
from relguide.flying.guidance.leaving import (
    clear_way,
    turn_away,
)
from relguide.flying.guidance.memory import Memory, enter
from relguide.flying.guidance.monitor import (
    Outlook,
    leader_is_as_forecast,
)
from relguide.flying.guidance.plan_news import (
    announce_pending,
    count_refusal,
    fly_proposal,
    retry_pause,
    say_no_plan,
)
from relguide.flying.modes import NUMBERS
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight import marks as at
from relguide.kernels.flight.guide import Progress
from relguide.kernels.flight.marks import mark_at
from relguide.planning.outcome import Planner
from relguide.planning.phrases import distance
from relguide.units import Metre, Second

MAY_MOVE: Metre = 600.0
"""A slot minutes ahead may seem to move so far, as the leader's velocity is uncertain [m]."""


def try_to_plan(
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


def stay_or_change(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """On a committed path: go on, unless the leader moved the slot, or another path is better."""
    settings, committed, t = assignment.settings, memory.committed, belief.t
    if committed is None:
        return plan_again(memory, belief, assignment, planner, reason="assignment_changed")
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
        return plan_again(memory, belief, assignment, planner, reason="deviation")
    off = slot_mismatch(belief, committed) - committed.accepted
    news = now.intent_known != memory.expected.intent_known
    if not as_forecast and (news or off > settings.slot_moved + _slot_slack(belief, committed)):
        steady = is_steady(memory, belief, assignment)
        stay = 0.0 if steady else settings.better_while_turning
        reason: PlanReason = changed or "leader_elsewhere"
        if news or turns_unannounced(belief, assignment):
            return plan_again(memory, belief, assignment, planner, reason=reason, stay=stay)
        return _plan_if_sooner(memory, committed, belief, assignment, planner, reason)
    if _is_overdue(memory, belief, assignment):
        return plan_again(memory, belief, assignment, planner, reason="leader_elsewhere")
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
        return plan_again(memory, belief, assignment, planner, reason=reason)
    found = propose(belief, assignment, committed, planner)
    memory, events = count_refusal(memory._replace(asked=belief.t), found)
    margin = change_margin(committed, belief.t, assignment)
    if isinstance(found, Proposal):
        other = found.committed.forecast
        if other.joins and other.join_time < ahead.join_time - margin:
            return fly_proposal(memory, belief, assignment, found, reason, events)
    kept = committed._replace(forecast=ahead, accepted=slot_mismatch(belief, committed))
    return memory._replace(committed=kept, forecast=ahead), events


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


def plan_again(
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


def has_left_capture(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the pursuer is no longer near the leader's flown path, or the slot is far off it."""
    if has_strayed(memory, belief, assignment):
        return True
    if memory.mode == "follow":
        return False
    settings, s, marks = assignment.settings, memory.progress.s, belief.track.marks
    turned = abs(wrap_signed(belief.leader_rolled_out - memory.captured))
    to_slot = marks[-1, at.S] - assignment.aim - s
    return bool(turned > settings.route_left and abs(to_slot) > settings.too_far)


def has_strayed(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the pursuer is far beside the leader's flown path, or flies across it."""
    settings, own = assignment.settings, belief.own
    _, x, y, heading, _ = mark_at(belief.track.marks, at.S, memory.progress.s + own.tas)
    if hypot(own.x - x, own.y - y) > settings.lost_across:
        return True
    return abs(wrap_signed(own.heading - heading)) > settings.lost_heading


def plan_around(
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


def replan_or_escape(
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
