"""reassign(memory, belief, …): the crew asks for another D, d_min, bank or speed in flight.

Where a path is flown, one to what is asked now is flown at once. Behind the leader, on its path,
speed alone opens or closes the spacing, unless that takes long and a path is sooner there. Where
neither can be flown the order is refused, and what was flown is flown on: it keeps what it was
made for, and a crew that turns a knob has not given up its join. It may disconnect.
"""

from dataclasses import replace

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Event, NewPromise, clock
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import BRAKES_FOR
from relguide.flying.guidance.commit.proposal import NoProposal, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.forecast import NO_COURSE, Forecast, forecast
from relguide.flying.guidance.leader_news import is_steady
from relguide.flying.guidance.memory import LONG_AGO, Memory, Promise, enter
from relguide.flying.guidance.plan_news import count_refusal, fly_proposal
from relguide.flying.guidance.stand_by import offer_again
from relguide.flying.modes import NUMBERS
from relguide.planning.outcome import Planner
from relguide.planning.phrases import distance
from relguide.units import KT, Second

BY_SPEED_FOR: Second = 3_600.0
"""How far it is looked ahead for when speed alone has changed the spacing [s]."""
SOONER = 0.5
"""A path is flown in place of a change of speed if it joins in this share of its time."""


def reassign(
    memory: Memory,
    belief: Belief,
    was: Assignment,
    asked: Assignment,
    why: str,
    planner: Planner,
) -> tuple[Memory, list[Event]] | str:
    """What becomes of what is flown or proposed; or why the order cannot be obeyed, as a sentence.

    Args:
        memory: as it is.
        belief: what is known now, with all that the aircraft can do.
        was: what it was to do until now.
        asked: what it is to do from now on.
        why: what the crew asked for, as a sentence without full stop.
        planner: makes plans.
    """
    belief = replace(belief, limits=asked.can(belief.limits))
    memory = memory._replace(because=why)
    if memory.engagement == "armed":
        memory = memory._replace(proposed=None, missing=None, asked=LONG_AGO)
        return offer_again(memory, f"{why}, and the proposal is made anew")
    if memory.engagement != "engaged":
        return memory._replace(proposed=None, missing=None, asked=LONG_AGO), []
    if memory.mode == "converge":
        return _converge(memory, belief, asked, planner)
    if memory.mode in ("capture", "follow"):
        return _go_on_behind(memory, belief, was, asked, planner)
    if memory.mode == "heading":  # without a plan until now: one to this may exist
        memory = memory._replace(missing=None, asked=LONG_AGO)
    return memory, []


def _converge(
    memory: Memory, belief: Belief, asked: Assignment, planner: Planner
) -> tuple[Memory, list[Event]] | str:
    """A path to what is asked, from the one that is flown."""
    found = propose(belief, asked, memory.committed, planner)
    if isinstance(found, NoProposal):
        return found.answer.message
    memory, events = count_refusal(memory._replace(asked=belief.t), found)
    return fly_proposal(memory, belief, asked, found, "assignment_changed", events)


def _go_on_behind(
    memory: Memory, belief: Belief, was: Assignment, asked: Assignment, planner: Planner
) -> tuple[Memory, list[Event]] | str:
    """On the leader's path: by speed, or by another path."""
    apart = belief.counted_separation
    if asked.min_separation > was.min_separation and apart < asked.min_separation:
        return (
            f"The aircraft are {distance(apart)} apart, closer than "
            f"{distance(asked.min_separation)}: open D first."
        )
    ahead = _by_speed(memory, belief, asked)
    kept, wanted = ahead.least(belief.t, asked.settings.caution), asked.min_separation
    if kept[0] < min(wanted, apart):
        seconds = max(kept[1] - belief.t, 0.0)
        return f"In {seconds:.0f} s the leader would be {distance(kept[0])} away."
    memory = memory._replace(forecast=None)
    if asked.aim == was.aim or (ahead.joins and ahead.join_time <= belief.t):
        return memory, []
    if asked.spacing > 0.0:
        return f"It keeps {asked.spacing:.0f} s behind the leader, whatever D is."
    if not ahead.joins or ahead.join_time > belief.t + BRAKES_FOR:
        found = propose(belief, asked, None, planner)
        if isinstance(found, Proposal) and _is_sooner(found, ahead, belief):
            memory, events = count_refusal(memory._replace(asked=belief.t), found)
            return fly_proposal(memory, belief, asked, found, "assignment_changed", events)
    if not ahead.joins:
        if asked.selected_tas > 0.0:
            return f"At {asked.selected_tas / KT:.0f} kt, the speed selected, D stays as it is."
        return "There is no speed that leads there within an hour, and no path."
    wider = asked.aim > was.aim
    turned = f"{'Opening' if wider else 'Closing'} to {distance(asked.slot_distance)} by speed."
    memory, events = enter(memory, belief, "capture", turned)
    settled = is_steady(memory, belief, asked)
    said = NewPromise(
        joins=ahead.join_time,
        was=belief.t if memory.promise is None else memory.promise.joins,
        message=f"{memory.because}: joins in {clock(ahead.join_time - belief.t)}.",
    )
    promise = Promise(belief.t, ahead.join_time, settled)
    memory = memory._replace(promise=promise, captured=belief.leader_rolled_out)
    return memory, [*events, said]


def _by_speed(memory: Memory, belief: Belief, asked: Assignment) -> Forecast:
    """The flight ahead along the leader's path."""
    capturing = memory.progress._replace(mode=NUMBERS["capture"])
    return forecast(belief, asked, capturing, NO_COURSE, until=belief.t + BY_SPEED_FOR)


def _is_sooner(found: Proposal, by_speed: Forecast, belief: Belief) -> bool:
    """Whether a path joins so much sooner than a change of speed that it is worth its turns."""
    joins = found.committed.joins_at(found.committed.forecast)
    return not by_speed.joins or (joins - belief.t < SOONER * (by_speed.join_time - belief.t))
