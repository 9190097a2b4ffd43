"""What a crew hears in capture and follow: when it joins, and whether the spacing is kept."""

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Alerted, Event, NewPromise, promise_sentence
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.leader_news import is_steady
from relguide.flying.guidance.memory import LONG_AGO, Memory, Promise
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.guidance.plan_news import may_speak
from relguide.flying.guidance.settings import Settings
from relguide.kernels.flight.guide import Act
from relguide.planning.phrases import distance
from relguide.units import KT, Second


def promise_anew(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Say when it joins, if that is no longer what was said: at once, but not each second.

    A plan that is announced says so itself. But while the leader does something new, plans are
    flown that are not announced yet; the same path may join at another time, since the leader flies
    otherwise; and in capture the path is the leader's own.
    """
    ahead, said = memory.forecast, memory.promise
    if memory.mode not in ("converge", "capture"):
        return memory, []
    if ahead is None or said is None or not ahead.joins:
        return memory, []
    memory = _compare_later_plans(memory, belief, assignment)
    joins, settings = ahead.join_time, assignment.settings
    settled = is_steady(memory, belief, assignment)
    size = _change(joins, said.joins, belief, settings, settled=settled or said.settled)
    if size <= 1.0:
        return memory, []
    if belief.t < said.t + max(settings.promise_every / size, settings.promise_soonest):
        return memory, []
    message = promise_sentence(joins - belief.t, said.joins - belief.t)
    memory = memory._replace(promise=Promise(belief.t, joins, settled))
    return memory, [NewPromise(joins=joins, was=said.joins, message=message)]


def _compare_later_plans(memory: Memory, belief: Belief, assignment: Assignment) -> Memory:
    """Compare plans to come with the present join, once the leader has settled."""
    ahead, last, settings = memory.forecast, memory.announced, assignment.settings
    if ahead is None or last is None or memory.pending is not None:
        return memory
    if _change(ahead.join_time, last.joins, belief, settings, settled=True) <= 1.0:
        return memory
    if not may_speak(memory, belief, assignment):
        return memory
    quiet = belief.t + settings.announce_after
    return memory._replace(announced=last._replace(joins=ahead.join_time, quiet_until=quiet))


def _other_speed(belief: Belief, assignment: Assignment) -> str:
    """That a selected speed does not keep the spacing, in a sentence; empty if it does."""
    selected, leader = assignment.selected_tas, belief.leader.tas
    slack = assignment.settings.leader_speed + belief.speed_slack
    if selected == 0.0 or abs(selected - leader) <= slack:
        return ""
    return (
        f"{selected / KT:.0f} kt is selected and the leader flies {leader / KT:.0f} kt: it is not "
        "kept until guidance sets the speed."
    )


def _change(
    joins: Second, was: Second, belief: Belief, settings: Settings, *, settled: bool
) -> float:
    """How much sooner or later a join is than another; above 1 a crew has to know."""
    least, share = settings.shown_time, settings.shown_share
    if not settled:
        least, share = settings.unsettled_time, settings.unsettled_share
    return abs(joins - was) / max(least, share * (joins - belief.t))


def judge_spacing(
    memory: Memory, belief: Belief, assignment: Assignment, done: Act, outlook: Outlook
) -> tuple[Memory, list[Event]]:
    """Say so once the pursuer follows and has been out of the gate for a minute, and once it is in.

    A speed that the crew has selected and that is not the leader's is said at once.

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
    other_speed = _other_speed(belief, assignment)
    if memory.mode == "follow" and (is_out or other_speed):
        since = t if out.since == LONG_AGO else out.since
        memory = memory._replace(out_of_gate=out._replace(since=since))
        if out.said or (t - since < settings.out_for and not other_speed):
            return memory, []
        where = "too far behind" if along > 0.0 else "too near"
        text = f"{distance(abs(along))} {where}, {distance(abs(done.right))} aside."
        text = f"Spacing: {other_speed or text}"
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
