"""Standing by: the crew flies a heading; where a leader is designated, guidance proposes paths."""

from relguide.flying.belief import Belief
from relguide.flying.engagement import Engagement, refusal
from relguide.flying.guidance.accepted import difference, kept_branch
from relguide.flying.guidance.announcements import (
    EngagementChange,
    Event,
    PlanReason,
    ProposedPlan,
    UnableTo,
    past_slot,
    summary,
)
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.proposal import NoProposal, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.memory import LONG_AGO, Announced, Memory, enter
from relguide.flying.guidance.plan_news import count_refusal, fly_proposal, retry_pause, say_no_plan
from relguide.flying.modes import NUMBERS
from relguide.kernels.flight.guide import Progress
from relguide.planning.outcome import Planner
from relguide.planning.phrases import compass
from relguide.units import MetrePerSecond, Radian

LAPSED = "The proposal that was accepted can no longer be flown"
"""Without another in its place."""
ENGAGED = "Relative guidance is engaged."


def order_engagement(memory: Memory, belief: Belief, to: Engagement) -> tuple[Memory, list[Event]]:
    """Do what the crew orders, or say why not."""
    now = memory.engagement
    why = refusal(now, to, proposed=memory.proposed is not None)
    if why and to == "engaged" and memory.reoffered:
        stands = memory.proposed is not None
        why = f"{memory.reoffered}: {'accept it again first' if stands else 'there is no other'}."
    if why:
        return memory, [EngagementChange(engagement=now, previous=now, message=why)]
    message = {
        "off": "Relative guidance is off.",
        "designated": "The leader is designated: a path is looked for.",
        "armed": "The proposal is accepted. Engage when ready.",
        "engaged": ENGAGED,
    }[to]
    if now == "engaged":
        return stop(memory, belief, to, "Relative guidance is disconnected")
    if to == "engaged":  # guidance answers, as it looks once more for what was accepted
        return memory._replace(engaging=True), []
    said = EngagementChange(engagement=to, previous=now, message=message)
    proposed = memory.proposed if to == "armed" else None
    asked = memory.asked if to == "armed" else LONG_AGO
    memory = memory._replace(
        engagement=to,
        engaging=False,
        proposed=proposed,
        accepted=proposed,
        reoffered="",
        asked=asked,
        missing=None,
    )
    return memory, [said]


def offer_again(memory: Memory, how: str) -> tuple[Memory, list[Event]]:
    """The proposal is not the one that was accepted: it is offered, to be accepted by one order.

    Args:
        memory: as it is, armed.
        how: it is another one, as a sentence without full stop.
    """
    message = f"{how}." if how == LAPSED else f"{how}: accept it again."
    change = EngagementChange(engagement="designated", previous="armed", message=message)
    memory = memory._replace(engagement="designated", accepted=None, reoffered=how)
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
        accepted=None,
        reoffered="",
        missing=None,
        unable=None,
    )
    return memory, [said, *news]


def plan_anew(memory: Memory) -> Memory:
    """What guidance is to do has changed: plan at once, and fly no path that was for another."""
    return memory._replace(
        asked=LONG_AGO, committed=None, proposed=None, accepted=None, missing=None
    )


def hold_heading(memory: Memory, heading: Radian, tas: MetrePerSecond) -> Memory:
    """Fly a heading that the crew selects [rad], at a speed [m/s], until guidance is engaged."""
    progress = Progress(NUMBERS["heading"], 0.0, heading, tas)
    return memory._replace(progress=progress, forecast=None, proposed=None)


def refused_heading(memory: Memory) -> EngagementChange:
    """Why a heading is not flown while guidance is engaged."""
    now, message = memory.engagement, "Relative guidance flies: disconnect it to select a heading."
    return EngagementChange(engagement=now, previous=now, message=message)


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
    """Propose a path, if a leader is designated and it is time for a new proposal.

    The order to engage is answered at once: what was accepted is flown, and nothing else.
    """
    engaging = memory.engaging and memory.engagement == "armed"  # and not called off since
    memory = memory._replace(engaging=False)
    if memory.engagement == "off" or belief.leader_age > assignment.settings.proposes_on_data_of:
        said = list[Event]()
        if engaging:
            message = f"Nothing was heard of the leader for {belief.leader_age:.0f} s."
            said.append(EngagementChange(engagement="armed", previous="armed", message=message))
        return memory._replace(proposed=None), said
    if memory.unable == "speed":
        return _without_proposal(memory)
    wait = assignment.settings.propose_every
    if memory.missing is not None:
        wait = retry_pause(memory, belief, assignment)
    if belief.t - memory.asked < wait and not engaging:
        return memory, []
    like, stay = (
        (None, assignment.settings.shown_time)
        if memory.accepted is None
        else kept_branch(memory.accepted, memory.proposed, assignment.settings)
    )
    found = propose(belief, assignment, None, planner, like=like, stay=stay)
    memory, events = count_refusal(memory._replace(asked=belief.t), found)
    if isinstance(found, NoProposal):
        memory, events = say_no_plan(memory, belief, assignment, found.answer, events)
        memory, news = _without_proposal(memory)
        return memory, [*events, *news]
    if engaging and not _how_changed(memory, belief, assignment, found):
        said = [EngagementChange(engagement="engaged", previous="armed", message=ENGAGED)]
        memory = memory._replace(engagement="engaged", proposed=None, accepted=None)
        reason: PlanReason = "engaged" if memory.announced is None else "resumed"
        return fly_proposal(memory, belief, assignment, found, reason, [*events, *said])
    memory, news = _say_proposal(memory, belief, assignment, found)
    return memory, [*events, *news]


def _say_proposal(
    memory: Memory, belief: Belief, assignment: Assignment, found: Proposal
) -> tuple[Memory, list[Event]]:
    """The path proposed now; one that was accepted is not exchanged for another in silence.

    While armed, each proposal is held against the one that was accepted, not against the one
    before: many small steps away from it are a large one.
    """
    shown = found.shown
    joins = found.committed.joins_at(found.committed.forecast)
    then = past_slot(found.committed.forecast, belief, assignment)
    said: list[Event] = [
        ProposedPlan(
            committed=found.committed,
            shown=shown,
            message=f"Proposed: {summary(shown, joins - belief.t)}{then}.",
        )
    ]
    how = _how_changed(memory, belief, assignment, found)
    if how:
        memory, news = offer_again(memory, f"The proposal has changed ({how})")
        said += news
    return memory._replace(missing=None, proposed=_as_proposed(belief, found)), said


def _as_proposed(belief: Belief, found: Proposal) -> Announced:
    joins = found.committed.joins_at(found.committed.forecast)
    return Announced(belief.t, joins, found.shown.trajectory, belief.t)


def _how_changed(memory: Memory, belief: Belief, assignment: Assignment, found: Proposal) -> str:
    """How a path is another one than was accepted, in a clause; empty if it is the same."""
    if memory.accepted is None:
        return ""
    return difference(memory.accepted, _as_proposed(belief, found), assignment.settings)


def _without_proposal(memory: Memory) -> tuple[Memory, list[Event]]:
    if memory.engagement != "armed":
        return memory._replace(proposed=None), []
    return offer_again(memory._replace(proposed=None), LAPSED)
