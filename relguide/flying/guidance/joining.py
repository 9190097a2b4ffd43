"""What a crew hears in capture and follow: when it joins, and whether the spacing is kept."""

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Alerted, Event, NewPromise, clock
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.memory import LONG_AGO, Memory
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.guidance.plan_news import may_speak
from relguide.kernels.flight.guide import Act
from relguide.planning.phrases import distance


def promise_anew(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Say when it joins, if that is no longer what was said and the leader has settled.

    A new plan says so itself. But the same path may join at another time, since the leader flies
    otherwise; and in capture the path is the leader's own.
    """
    settings, ahead, last = assignment.settings, memory.forecast, memory.announced
    if memory.mode not in ("converge", "capture") or memory.pending is not None:
        return memory, []
    if ahead is None or last is None or not ahead.joins:
        return memory, []
    later, left = ahead.join_time - last.joins, ahead.join_time - belief.t
    if abs(later) <= max(settings.shown_time, settings.shown_share * left):
        return memory, []
    if not may_speak(memory, belief, assignment):
        return memory, []
    than = "later" if later > 0.0 else "sooner"
    message = f"Joins in {clock(left)}, {clock(abs(later))} {than} than was said."
    quiet = belief.t + settings.announce_after
    memory = memory._replace(announced=last._replace(joins=ahead.join_time, quiet_until=quiet))
    return memory, [NewPromise(joins=ahead.join_time, message=message)]


def judge_spacing(
    memory: Memory, belief: Belief, assignment: Assignment, done: Act, outlook: Outlook
) -> tuple[Memory, list[Event]]:
    """Say so once the pursuer follows and has been out of the gate for a minute, and once it is in.

    Args:
        memory: as it is.
        belief: what is known now.
        assignment: what was asked.
        done: how the pursuer stands to the slot.
        outlook: gives the least separation ahead, which every alert tells.
    """
    t, out, settings = belief.t, memory.out_of_gate, assignment.settings
    along = done.to_slot + assignment.aim - assignment.slot_distance
    is_out = (
        abs(along) > settings.joined_along + belief.place_slack
        or abs(done.right) > settings.joined_across + belief.place_slack
    )
    if memory.mode == "follow" and is_out:
        since = t if out.since == LONG_AGO else out.since
        memory = memory._replace(out_of_gate=out._replace(since=since))
        if out.said or t - since < settings.out_for:
            return memory, []
        where = "too far behind" if along > 0.0 else "too near"
        text = f"Spacing: {distance(abs(along))} {where}, {distance(abs(done.right))} aside."
    else:
        memory = memory._replace(out_of_gate=out._replace(since=LONG_AGO))
        if not out.said:
            return memory, []
        follows = memory.mode == "follow"
        text = "The spacing is kept again." if follows else "The leader is no longer followed."
    memory = memory._replace(out_of_gate=memory.out_of_gate._replace(said=not out.said))
    said = Alerted(
        subject="spacing",
        level="advisory",
        message=text,
        predicted_least=min(outlook.least, belief.separation),
        predicted_at=outlook.at,
        cleared=out.said,
    )
    return memory, [said]
