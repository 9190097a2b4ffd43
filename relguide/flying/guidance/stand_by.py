"""Standing by: the crew flies a heading; where a leader is designated, guidance proposes paths."""

from relguide.flying.belief import Belief
from relguide.flying.engagement import Engagement, refusal
from relguide.flying.guidance.announcements import (
    EngagementChange,
    Event,
    ProposedPlan,
    UnableTo,
    summary,
)
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.preference import begun_now
from relguide.flying.guidance.commit.proposal import NoProposal, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.memory import LONG_AGO, Announced, Memory, enter
from relguide.flying.guidance.plan_news import (
    count_refusal,
    leads_elsewhere,
    retry_pause,
    say_no_plan,
)
from relguide.flying.modes import NUMBERS
from relguide.kernels.flight.guide import Progress
from relguide.planning.outcome import Planner
from relguide.planning.phrases import compass
from relguide.units import MetrePerSecond, Radian, Second

ENGAGES_WITHIN: Second = 30.0
"""How long a crew may take from accepting a path to engaging it: two calls and a look outside."""


def order_engagement(memory: Memory, belief: Belief, to: Engagement) -> tuple[Memory, list[Event]]:
    """Do what the crew orders, or say why not."""
    now = memory.engagement
    why = refusal(now, to, proposed=memory.proposed is not None)
    if why and to == "engaged" and memory.reoffered:
        why = f"{memory.reoffered}: accept it again first."
    if why:
        return memory, [EngagementChange(engagement=now, previous=now, message=why)]
    message = {
        "off": "Relative guidance is off.",
        "designated": "The leader is designated: a path is looked for.",
        "armed": "The proposal is accepted. Engage when ready.",
        "engaged": "Relative guidance is engaged.",
    }[to]
    if now == "engaged":
        return stop(memory, belief, to, "Relative guidance is disconnected")
    said = EngagementChange(engagement=to, previous=now, message=message)
    if to == "engaged":
        # What was accepted is what is looked for: the first path that is flown is held against it.
        return memory._replace(engagement=to, asked=LONG_AGO), [said]
    proposed = memory.proposed if to == "armed" else None
    asked = memory.asked if to == "armed" else LONG_AGO
    memory = memory._replace(
        engagement=to, proposed=proposed, reoffered="", asked=asked, missing=None
    )
    return memory, [said]


def offer_again(memory: Memory, how: str) -> tuple[Memory, list[Event]]:
    """The proposal is not the one that was accepted: it is offered, to be accepted by one order.

    Args:
        memory: as it is, armed.
        how: it is another one, as a sentence without full stop.
    """
    change = EngagementChange(
        engagement="designated", previous="armed", message=f"{how}: accept it again."
    )
    memory = memory._replace(
        engagement="designated", proposed=None, reoffered=how, missing=None, asked=LONG_AGO
    )
    return memory, [change]


def stop(memory: Memory, belief: Belief, to: Engagement, why: str) -> tuple[Memory, list[Event]]:
    """Hand the aircraft back: its present heading and speed are held."""
    heading = belief.own.heading
    message = f"{why}: holding {compass(heading)}."
    said = EngagementChange(engagement=to, previous=memory.engagement, message=message)
    memory, news = enter(memory, belief, "heading", message)
    memory = memory._replace(
        engagement=to,
        progress=Progress(NUMBERS["heading"], 0.0, heading, belief.own.tas),
        committed=None,
        forecast=None,
        announced=None,
        promise=None,
        pending="engaged",
        asked=LONG_AGO,
        proposed=None,
        reoffered="",
        missing=None,
        unable=None,
    )
    return memory, [said, *news]


def plan_anew(memory: Memory) -> Memory:
    """What guidance is to do has changed: plan at once, and fly no path that was for another."""
    return memory._replace(asked=LONG_AGO, committed=None, proposed=None, missing=None)


def hold_heading(memory: Memory, heading: Radian, tas: MetrePerSecond) -> Memory:
    """Fly a heading that the crew selects [rad], at a speed [m/s], until guidance is engaged."""
    progress = Progress(NUMBERS["heading"], 0.0, heading, tas)
    # What was accepted is kept: the next proposal is held against it.
    accepted = memory.proposed if memory.engagement == "armed" else None
    return memory._replace(progress=progress, forecast=None, proposed=accepted)


def give_up_old_data(
    memory: Memory, belief: Belief, assignment: Assignment
) -> tuple[Memory, list[Event]]:
    """Stop flying where the leader was heard of too long ago."""
    oldest = assignment.settings.flies_on_data_of
    if memory.engagement in ("off", "designated") or belief.leader_age <= oldest:
        return memory, []
    message = f"Unable: nothing was heard of the leader for {belief.leader_age:.0f} s."
    memory, events = stop(memory, belief, "designated", "The leader's data are lost")
    return memory, [UnableTo(reason="data", message=message), *events]


def stand_by(
    memory: Memory, belief: Belief, assignment: Assignment, planner: Planner
) -> tuple[Memory, list[Event]]:
    """Propose a path, if a leader is designated and it is time for a new proposal."""
    if memory.engagement == "off" or belief.leader_age > assignment.settings.proposes_on_data_of:
        return memory._replace(proposed=None), []
    if memory.unable == "speed":
        return _without_proposal(memory)
    wait = assignment.settings.propose_every
    if memory.missing is not None:
        wait = retry_pause(memory, belief, assignment)
    if belief.t - memory.asked < wait:
        return memory, []
    accepted = memory.proposed if memory.engagement == "armed" else None
    like = None if accepted is None else accepted.path
    # Two paths may be as fast: a crew that has accepted one of them is not offered them in turn.
    stay = assignment.settings.shown_time
    found = propose(belief, assignment, None, planner, like=like, stay=stay)
    memory, events = count_refusal(memory._replace(asked=belief.t), found)
    if isinstance(found, NoProposal):
        memory, events = say_no_plan(memory, belief, assignment, found.answer, events)
        memory, news = _without_proposal(memory)
        return memory, [*events, *news]
    memory, news = _say_proposal(memory, belief, assignment, found)
    return memory, [*events, *news]


def _say_proposal(
    memory: Memory, belief: Belief, assignment: Assignment, found: Proposal
) -> tuple[Memory, list[Event]]:
    """The path proposed now; one that was accepted is not exchanged for another in silence.

    While armed, each proposal is held against the one that was accepted, not against the one
    before: many small steps away from it are a large one. It leads to the same places at the same
    times or, for as long as a crew takes to engage, it may be the same path begun later.
    """
    committed, shown = found.committed, found.shown
    accepted = memory.proposed if memory.engagement == "armed" else None
    joins = committed.joins_at(committed.forecast)
    said = ProposedPlan(
        committed=committed,
        shown=shown,
        message=f"Proposed: {summary(shown, joins - belief.t)}.",
    )
    proposed = Announced(belief.t, joins, shown.trajectory, belief.t)
    memory = memory._replace(missing=None)
    if accepted is None:
        return memory._replace(proposed=proposed), [said]
    same = [accepted]
    if belief.t - accepted.t <= ENGAGES_WITHIN:
        waited = accepted.joins + belief.t - accepted.t
        path = begun_now(accepted.path, belief)
        same.append(Announced(belief.t, waited, path, belief.t))
    settings = assignment.settings
    if any(
        joins - each.joins <= settings.shown_time
        and not leads_elsewhere(each, shown.trajectory, belief, settings)
        for each in same
    ):
        return memory, [said]
    message = "The proposal is another one now: accept it again."
    change = EngagementChange(engagement="designated", previous="armed", message=message)
    return memory._replace(engagement="designated", proposed=proposed), [said, change]


def _without_proposal(memory: Memory) -> tuple[Memory, list[Event]]:
    memory = memory._replace(proposed=None)
    if memory.engagement != "armed":
        return memory, []
    message = "The proposal that was accepted can no longer be flown."
    change = EngagementChange(engagement="designated", previous="armed", message=message)
    return memory._replace(engagement="designated"), [change]
