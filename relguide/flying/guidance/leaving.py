"""Leaving: when what is flown would lose d_min, and on what heading the aircraft turns away."""

from dataclasses import replace
from math import hypot

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Event
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.escape import escape, kept_on_heading
from relguide.flying.guidance.leader_news import turns_unannounced
from relguide.flying.guidance.memory import Memory, enter
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.modes import NUMBERS
from relguide.kernels.flight.guide import Progress
from relguide.planning.phrases import compass
from relguide.units import Metre, MetrePerSecond, Radian, Second

SLOWS_FOR: Second = 20.0
"""A leader that slows down may go on for so long before an escape has to keep clear of it [s]."""
OWN_TUBE: Metre = 60.0
"""What an escape must keep beyond d_min: its turn is planned without the roll's soft ends [m]."""


def turn_away(
    memory: Memory, belief: Belief, assignment: Assignment, why: str
) -> tuple[Memory, list[Event]]:
    """Turn away to a heading that keeps clear."""
    out = clear_heading(belief, assignment)
    memory, news = enter(memory, belief, "escape", f"{why} Turning to {compass(out)}.")
    progress = Progress(NUMBERS["escape"], 0.0, out, belief.own.tas)
    return replace(memory, progress=progress, committed=None, forecast=None), news


def clear_heading(belief: Belief, assignment: Assignment) -> Radian:
    """The heading nearest to the present one that keeps clear of the leader [rad]."""
    turns_on = turns_unannounced(belief, assignment)
    wanted = assignment.buffered_separation
    return escape(belief, assignment, wanted, turns_on=turns_on).heading


def keep_heading(memory: Memory, belief: Belief, assignment: Assignment) -> Memory:
    """Keep the heading held for as long as it keeps clear, so that it does not jump."""
    if memory.mode not in ("heading", "escape"):
        return memory
    progress = memory.progress
    turns_on = turns_unannounced(belief, assignment)
    wanted = assignment.min_separation + OWN_TUBE
    if kept_on_heading(belief, assignment, progress.heading, turns_on=turns_on) >= wanted:
        return memory
    out = escape(belief, assignment, assignment.buffered_separation, turns_on=turns_on)
    now = kept_on_heading(belief, assignment, progress.heading, turns_on=turns_on)
    if out.least_separation < now + OWN_TUBE:
        return memory
    return replace(memory, progress=progress._replace(heading=out.heading))


def must_leave(
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
    turns_on = turns_unannounced(belief, assignment)
    if not turns_on and slowing == 0.0 and outlook.least >= limit:
        return False
    apart = hypot(belief.own.x - belief.leader.x, belief.own.y - belief.leader.y)
    wanted = min(limit + OWN_TUBE, apart)
    slows_to = belief.leader.tas - slowing * SLOWS_FOR
    later = escape(belief, assignment, wanted, turns_on=turns_on, slows_to=slows_to, delay=1.0)
    return later.least_separation < wanted
