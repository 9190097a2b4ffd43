"""What guidance announces, in sentences for a crew, and when something is news."""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.belief import Belief
from relguide.flying.engagement import Engagement
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.modes import Mode
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.acceptance import Refusal
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.phrases import compass
from relguide.units import KT, NM, Metre, MetrePerSecond, Radian, Second

PlanReason = Literal[
    "engaged",
    "resumed",
    "better_plan",
    "deviation",
    "separation",
    "leader_turned",
    "leader_changed_speed",
    "leader_elsewhere",
    "intent_received",
    "intent_withdrawn",
    "braking",
    "traffic",
    "assignment_changed",
]
"""Why a new plan was made."""
AlertLevel = Literal["advisory", "caution", "warning"]
"""advisory: to be known; caution: to be seen to at once; warning: to be acted upon at once."""
AlertSubject = Literal["separation", "spacing", "speed", "data", "geometry"]
"""separation: d_min will be lost; spacing: the pursuer follows, and has not been in the gate for a
minute; speed: the leader flies at a speed that cannot be matched; data: what is known of the leader
is old or contradicts itself; geometry: it flies where it cannot be followed, as when it turns
back."""
AlertState = Literal["none", "advisory", "caution", "warning"]
"""The level of the alert that stands, or that there is none."""
UnableReason = Literal["separation", "speed", "geometry", "envelope", "data", "traffic"]
"""separation: d_min would be lost; speed: the leader flies at a speed that cannot be matched;
geometry: it flies where it cannot be followed; envelope: the aircraft cannot do what its task asks
of it; data: what is known of the leader is old or contradicts itself; traffic: another aircraft,
or weather, would come too close."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NewPlan:
    """A new plan is flown."""

    committed: Committed
    shown: Plan
    """The plan with its lead-in, from where it begins."""
    reason: PlanReason
    message: str
    announced: bool
    """Whether it is news for a crew; if not, it is kept in the record."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ProposedPlan:
    """A path that could be flown from now on."""

    committed: Committed
    shown: Plan
    """The plan with its lead-in, from where it begins."""
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class EngagementChange:
    """The crew has engaged guidance further, or less far; or what it ordered could not be done."""

    engagement: Engagement
    previous: Engagement
    """The same, if the order was refused."""
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanMissing:
    """There is no plan."""

    answer: NoPlan


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerRefused:
    """The planner's own plan may not be flown."""

    refusal: Refusal


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeChange:
    """Guidance changes its mode."""

    mode: Mode
    previous: Mode
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NewPromise:
    """The pursuer joins at another time than was last said."""

    joins: Second
    """When, flight time [s]."""
    was: Second
    """When it was last said to join, flight time [s]."""
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Alerted:
    """An alert begins, becomes more urgent or less, or is over."""

    subject: AlertSubject
    level: AlertLevel
    """Of the alert that begins or, when cleared, ends."""
    message: str
    predicted_least: Metre
    predicted_at: Second
    """When the minimum is lost or, where it is kept, the least comes, flight time [s]."""
    cleared: bool
    ident: str = ""
    """Of the aircraft or cell that it is about; empty for the leader."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnableTo:
    """Guidance cannot go on with what it was asked to do."""

    reason: UnableReason
    message: str


Event = (
    NewPlan
    | ProposedPlan
    | EngagementChange
    | PlanMissing
    | PlannerRefused
    | ModeChange
    | NewPromise
    | Alerted
    | UnableTo
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Expectation:
    """What the announced plan assumes of the leader."""

    final_heading: Radian
    tas: MetrePerSecond
    intent_known: bool


def expectation(belief: Belief) -> Expectation:
    """What is known of the leader now."""
    return Expectation(
        final_heading=belief.final_heading,
        tas=belief.leader.tas,
        intent_known=belief.intent_known,
    )


def leader_change(
    was: Expectation, now: Expectation, turned: Radian, speed: MetrePerSecond
) -> PlanReason | None:
    """What the leader does that was not expected; `None` if there is nothing.

    Args:
        was: what was expected.
        now: what is known now.
        turned: a smaller change of its final heading does not count [rad].
        speed: a smaller change of its speed does not count [m/s].
    """
    if now.intent_known != was.intent_known:
        return "intent_received" if now.intent_known else "intent_withdrawn"
    if abs(wrap_signed(now.final_heading - was.final_heading)) > turned:
        return "leader_turned"
    if abs(now.tas - was.tas) > speed:
        return "leader_changed_speed"
    return None


def reason_sentence(reason: PlanReason, belief: Belief, because: str = "") -> str:
    """Why there is a new plan, without a full stop.

    Args:
        reason: of the plan.
        belief: what is known now.
        because: with the reason `traffic`, what the others did; with `assignment_changed`, what the
            crew asked for: as a sentence without full stop.
    """
    match reason:
        case "engaged":
            return "Relative guidance engaged"
        case "resumed":
            return "Relative guidance resumed"
        case "better_plan":
            return "A faster path was found"
        case "deviation":
            return "Planned again, as the aircraft has left its path"
        case "separation":
            return "The plan no longer kept the minimum separation"
        case "leader_turned":
            heading = compass(belief.final_heading)
            if belief.turn_to_come:
                return f"The leader will turn to {heading}"
            return f"The leader's heading is {heading}"
        case "leader_changed_speed":
            return f"The leader flies {belief.leader.tas / KT:.0f} kt"
        case "leader_elsewhere":
            return "The leader is not where it was expected"
        case "intent_received":
            return "The leader's intent is known"
        case "intent_withdrawn":
            return "The leader's intent is no longer known"
        case "braking":
            return "The aircraft slows down otherwise than its data say"
        case "traffic" | "assignment_changed":
            return because


def summary(plan: Plan, joins_in: Second) -> str:
    """Its word, when it joins and the separation it keeps, in a clause."""
    least = plan.certificate.least_separation / NM
    height = " or 1,000 ft" if plan.certificate.vertical else ""
    return f"{plan.word} joins in {clock(joins_in)} and keeps {least:.1f} NM{height}"


def past_slot(ahead: Forecast, belief: Belief, assignment: Assignment) -> str:
    """To what separation a selected speed leads past the slot, in a clause; empty if d_min is kept.

    Args:
        ahead: the closed loop flown ahead.
        belief: what is known now.
        assignment: what was asked.
    """
    selected, (least, _) = assignment.selected_tas, ahead.least(belief.t)
    if selected == 0.0 or least >= assignment.min_separation:
        return ""
    return f"; then {selected / KT:.0f} kt would lead to {least / NM:.1f} NM"


def promise_sentence(joins_in: Second, was_in: Second) -> str:
    """When it joins, and when that was to be as was last said."""
    if was_in <= 0.0:
        return f"Joins in {clock(joins_in)}, and should have joined by now."
    return f"Joins in {clock(joins_in)}, was {clock(was_in)}."


def clock(duration: Second) -> str:
    """A duration as crews read it: `6 min 05 s`."""
    minutes, seconds = divmod(round(duration), 60)
    return f"{minutes} min {seconds:02d} s"
