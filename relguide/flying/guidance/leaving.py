"""Leaving: when what is flown would lose d_min, and on what heading the aircraft turns away."""

from math import cos, hypot, inf, sin, sqrt

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Event, UnableTo
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.escape import (
    Escape,
    escape,
    flown_escape,
    kept_on_heading,
    separation_flown,
)
from relguide.flying.guidance.leader_news import turns_unannounced
from relguide.flying.guidance.memory import Memory, enter
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.guidance.situations import situation_now
from relguide.flying.modes import NUMBERS
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.guide import Progress
from relguide.planning.least_bad import restore
from relguide.planning.phrases import compass
from relguide.units import MetrePerSecond, Radian, Second


def turn_away(
    memory: Memory, belief: Belief, assignment: Assignment, why: str, *, slower: bool = False
) -> tuple[Memory, list[Event]]:
    """Turn away to a heading that keeps clear.

    Args:
        memory: as it is.
        belief: what is known now.
        assignment: what was asked.
        why: a sentence.
        slower: whether the leader is likely to slow down further.
    """
    out = clear_way(memory, belief, assignment, slower=slower)
    how = ", slowing down" if out.tas < belief.own.tas else ""
    text = f"{why} Turning to {compass(out.heading)}{how}."
    memory, news = enter(memory, belief, "escape", text)
    progress = Progress(NUMBERS["escape"], 0.0, out.heading, out.tas)
    return memory._replace(progress=progress, committed=None, forecast=None), news


def clear_way(
    memory: Memory, belief: Belief, assignment: Assignment, *, slower: bool = False
) -> Escape:
    """The heading nearest to the present one that keeps clear of all, and the speed."""
    other_tas = _other_tas(memory, belief, assignment)
    if slower:
        other_tas = assignment.settings.slows_to_share * belief.leader.tas
    turns_on = turns_unannounced(belief, assignment)
    out = escape(
        belief,
        assignment,
        assignment.buffered_separation,
        turns_on=turns_on,
        other_tas=other_tas,
    )
    wanted = assignment.min_separation + assignment.settings.escape_tube
    # what the leader may do besides is known to the one alone: the other flies it as is expected
    if turns_on or other_tas is not None or out.least_separation >= wanted:
        return out
    kept = separation_flown(belief, assignment, out.heading, out.tas)
    return flown_escape(belief, assignment, wanted, kept) or out


def keep_heading(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Keep the heading held for as long as it keeps clear; a new one does not come in silence."""
    if memory.mode not in ("heading", "escape") or not belief.counts:
        return memory, []
    settings, progress = assignment.settings, memory.progress
    turns_on = turns_unannounced(belief, assignment)
    other_tas = _other_tas(memory, belief, assignment)
    kept, of = kept_on_heading(
        belief, assignment, progress.heading, turns_on=turns_on, other_tas=other_tas
    )
    if kept >= assignment.min_separation + settings.escape_tube:
        return memory, []
    if not of and belief.counted_separation < min(
        assignment.min_separation, kept + settings.escape_tube
    ):
        # already lost, and at its least: nothing is to be kept, but d_min regained soonest
        soonest = restore(situation_now(belief, assignment))
        gained = _regained_in(belief, progress.heading, assignment) - soonest.at_time
        if soonest.at_time == inf or gained < settings.escapes_for:
            return memory, []
        heading, tas, purpose = soonest.heading, progress.tas, "to regain the separation soonest"
    else:
        better_than = kept + settings.escape_tube
        if not turns_on and other_tas is None:
            flown = separation_flown(belief, assignment, progress.heading, progress.tas)
            if flown >= assignment.min_separation + settings.forecast_error:
                return memory, []
            better_than = max(kept, flown) + settings.forecast_error
        out = clear_way(memory, belief, assignment)
        if out.least_separation < better_than:
            return memory, []
        heading, tas = out.heading, out.tas
        purpose = f"to keep clear of {of or 'the leader'}"
    said: list[Event] = []
    if tas < progress.tas:
        purpose = f"slowing down, {purpose}"
    if tas < progress.tas or abs(wrap_signed(heading - progress.heading)) > settings.heading_news:
        message = f"Turning to {compass(heading)}, {purpose}."
        said.append(UnableTo(reason="traffic" if of else "separation", message=message))
    return memory._replace(progress=progress._replace(heading=heading, tas=tas)), said


def _regained_in(belief: Belief, heading: Radian, assignment: Assignment) -> Second:
    """When d_min is regained on a heading, the leader flying on as it points [s]."""
    own, other = belief.own, belief.leader
    x, y = own.x - other.x, own.y - other.y
    east = own.tas * sin(heading) - other.tas * sin(other.heading)
    north = own.tas * cos(heading) - other.tas * cos(other.heading)
    speed = max(hypot(east, north), 1e-3)
    # |p + w t| = d_min: the later of its two times, as they are inside it now
    along = (x * east + y * north) / speed
    inside = assignment.min_separation**2 - x * x - y * y
    return (sqrt(along * along + max(inside, 0.0)) - along) / speed


def must_leave(memory: Memory, belief: Belief, assignment: Assignment, outlook: Outlook) -> bool:
    """Whether what is flown now would lose d_min, or soon leave no way to keep it."""
    t, limit = belief.t, assignment.min_separation
    settings = assignment.settings
    pressing = outlook.pressing(t, settings.watch)
    if pressing is not None and pressing.breaks - t <= settings.caution:
        return True
    ahead, kept = outlook.forecast, limit
    if memory.committed is None:
        kept = min(limit + settings.forecast_error, belief.separation)
    if ahead.rest(t) < kept and ahead.least(t, settings.caution)[0] < kept:
        return True
    turns_on = turns_unannounced(belief, assignment)
    if not turns_on and outlook.least >= limit and pressing is None:
        return False  # a change of speed is answered by speed, as the outlook has it
    wanted = min(limit + settings.escape_tube, belief.separation)
    other_tas = _other_tas(memory, belief, assignment)
    later = escape(belief, assignment, wanted, turns_on=turns_on, other_tas=other_tas, delay=1.0)
    return later.least_separation < wanted


def _other_tas(memory: Memory, belief: Belief, assignment: Assignment) -> MetrePerSecond | None:
    """The speed that the leader comes to if it goes on changing it; `None` if it does not."""
    if memory.leader_trend == 0.0:
        return None
    return belief.leader.tas + memory.leader_trend * assignment.settings.speed_goes_on_escaping
