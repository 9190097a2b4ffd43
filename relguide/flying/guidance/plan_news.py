"""Which plans a crew is shown: those that are news, once the leader has settled; never all."""

from math import hypot

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import (
    Event,
    NewPlan,
    PlanMissing,
    PlannerRefused,
    PlanReason,
    UnableReason,
    UnableTo,
    expectation,
    past_slot,
    reason_sentence,
    summary,
)
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.proposal import NoProposal, NotBetter, Proposal
from relguide.flying.guidance.commit.shown_plan import shown_rest
from relguide.flying.guidance.leader_news import is_steady
from relguide.flying.guidance.memory import Announced, Memory, Promise, enter
from relguide.flying.guidance.settings import Settings
from relguide.flying.modes import NUMBERS
from relguide.kernels.flight.guide import Progress
from relguide.planning.outcome import NoPlan, Plan, Reason
from relguide.planning.trajectory import Trajectory
from relguide.units import Second

UNABLE: dict[Reason, UnableReason] = {
    Reason.SLOT_UNREACHABLE: "speed",
    Reason.BEYOND_HORIZON: "speed",
    Reason.TRAFFIC: "traffic",
}
"""Why guidance is unable without a plan; for all other reasons: `separation`."""
FRESH: tuple[PlanReason, ...] = (
    "engaged", "resumed", "separation", "better_plan", "assignment_changed",
)  # fmt: skip
"""A plan made for one of these is news, wherever it leads; for separation, not twice at once."""
SHARES = (0.33, 0.67, 1.0)
"""Where along their durations two paths are compared."""


def fly_proposal(
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
    memory, news = enter(memory, belief, "converge", message)
    memory = memory._replace(
        committed=committed,
        forecast=committed.forecast,
        progress=Progress(NUMBERS["converge"], committed.s, 0.0, 0.0),
        missing=None,
    )
    shown = found.shown
    fresh = is_news(memory, belief, assignment, committed, shown.trajectory, reason)
    announced = fresh and (
        memory.announced is None
        or reason in ("separation", "traffic", "assignment_changed", "engaged", "resumed")
        or may_speak(memory, belief, assignment)
    )
    joins = committed.joins_at(committed.forecast)
    why = reason_sentence(reason, belief, memory.because)
    then = past_slot(committed.forecast, belief, assignment)
    text = f"{why}: {summary(shown, joins - belief.t)}{then}."
    said = NewPlan(
        committed=committed, shown=shown, reason=reason, message=text, announced=announced
    )
    if announced:
        begins = reason in ("engaged", "resumed")
        pause = 0.0 if begins else assignment.settings.announce_after
        memory = _announce(memory, belief, assignment, shown, joins, pause)
    elif fresh:
        memory = memory._replace(pending=reason)
    return memory, [*events, *news, said]


def _announce(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    shown: Plan,
    joins: Second,
    pause: Second,
) -> Memory:
    said = Announced(belief.t, joins, shown.trajectory, belief.t + pause)
    return memory._replace(
        announced=said,
        promise=Promise(belief.t, joins, is_steady(memory, belief, assignment)),
        pending=None,
        expected=expectation(belief),
    )


def may_speak(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether the leader has settled, and the last announcement is not of just now."""
    last = memory.announced
    rested = last is None or belief.t >= last.quiet_until
    return rested and is_steady(memory, belief, assignment)


def is_news(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    committed: Committed,
    path: Trajectory,
    reason: PlanReason,
) -> bool:
    """Whether the path or its time is not what a crew was shown."""
    settings, last = assignment.settings, memory.announced
    once_more = last is not None and reason == "separation" and belief.t < last.quiet_until
    if last is None or (reason in FRESH and not once_more):
        return True
    if memory.pending is not None:
        return True
    joins = committed.joins_at(committed.forecast)
    left = joins - belief.t
    if abs(joins - last.joins) > max(settings.shown_time, settings.shown_share * left):
        return True
    return leads_elsewhere(last, path, belief, settings)


def leads_elsewhere(last: Announced, path: Trajectory, belief: Belief, settings: Settings) -> bool:
    """Whether a path is at other places than the announced one has it at the same times."""
    elapsed, wind = belief.t - last.t, belief.wind
    for share in SHARES:
        ahead = share * path.duration
        now, then = path.pose_at(ahead), last.path.pose_at(elapsed + ahead)
        apart = hypot(now.x - then.x - wind.east * elapsed, now.y - then.y - wind.north * elapsed)
        if apart > settings.shown_apart + settings.shown_share * path.length * share:
            return True
    return False


def announce_pending(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Say now what was not said while the leader was doing something new."""
    committed, reason = memory.committed, memory.pending
    if committed is None or reason is None or not may_speak(memory, belief, assignment):
        return memory, []
    shown = shown_rest(committed, belief, assignment)
    ahead = memory.forecast or committed.forecast
    joins = committed.joins_at(ahead)
    why = reason_sentence(reason, belief, memory.because)
    then = past_slot(ahead, belief, assignment)
    text = f"{why}: {summary(shown, joins - belief.t)}{then}."
    said = NewPlan(committed=committed, shown=shown, reason=reason, message=text, announced=True)
    pause = assignment.settings.announce_after
    memory = memory._replace(fallbacks=memory.fallbacks + committed.plan.fell_back)
    return _announce(memory, belief, assignment, shown, joins, pause), [said]


def count_refusal(
    memory: Memory, found: Proposal | NoProposal | NotBetter
) -> tuple[Memory, list[Event]]:
    """Count that the exact plan took over, and say why if the planner's fault is a new one."""
    fault = None if found.refusal is None else found.refusal.fault
    news: list[Event] = []
    if found.refusal is not None and fault != memory.refused:
        news.append(PlannerRefused(refusal=found.refusal))
    if fault == memory.refused and not found.fell_back:
        return memory, news
    return memory._replace(fallbacks=memory.fallbacks + found.fell_back, refused=fault), news


def retry_pause(memory: Memory, belief: Belief, assignment: Assignment) -> Second:
    """How long to wait for the next try without a plan [s]: longer, if nothing is new for long."""
    settings = assignment.settings
    if memory.missing == Reason.TRAFFIC:  # which moves on
        return settings.retry
    quiet = settings.retry_share * (belief.t - max(memory.changed, memory.since))
    return min(max(settings.retry, quiet), settings.retry_longest)


def say_no_plan(
    memory: Memory, belief: Belief, assignment: Assignment, answer: NoPlan, events: list[Event]
) -> tuple[Memory, list[Event]]:
    """Why there is no plan, once while the reason stays the same."""
    if memory.missing != answer.reason:
        events.append(PlanMissing(answer=answer))
        reason = UNABLE.get(answer.reason, "separation")
        events.append(UnableTo(reason=reason, message=f"Unable: {answer.message}"))
    return memory._replace(missing=answer.reason), events
