"""What guidance announces: its modes and new plans with their reasons, in sentences for a pilot."""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.assignment import Observation
from relguide.flying.commitment import Commitment
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.acceptance import Refusal
from relguide.planning.phrases import compass
from relguide.planning.plan import NoPlan, Plan
from relguide.units import DEG, KT, NM, MetrePerSecond, Radian

Mode = Literal["heading", "converge", "capture", "follow", "escape"]
"""heading: no plan, a heading is held; converge: the plan is flown; capture: closes onto the
leader's route under speed control; follow: on the route D behind the leader, at its speed; escape:
turns away, as the separation would be lost on what was flown."""
PlanReason = Literal[
    "engaged",
    "better_plan",
    "deviation",
    "separation",
    "leader_turned",
    "leader_changed_speed",
    "intent_received",
    "intent_withdrawn",
]
"""Why a new plan was made."""
TURNED: Radian = 1.0 * DEG  # five times as far as the leader's own autopilot wanders
CHANGED_SPEED: MetrePerSecond = 2.0 * KT  # below what a crew would call a speed change


@dataclass(frozen=True, slots=True, kw_only=True)
class NewPlan:
    """A new plan is flown."""

    commitment: Commitment
    reason: PlanReason
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanMissing:
    """There is no plan."""

    answer: NoPlan


@dataclass(frozen=True, slots=True, kw_only=True)
class Refused:
    """The planner's own plan may not be flown."""

    refusal: Refusal


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeChange:
    """Guidance changes its mode."""

    mode: Mode
    previous: Mode
    message: str


Event = NewPlan | PlanMissing | Refused | ModeChange


@dataclass(frozen=True, slots=True, kw_only=True)
class Expectation:
    """What the announced plan assumes of the leader."""

    final_heading: Radian
    tas: MetrePerSecond
    intent_known: bool


def expectation(seen: Observation) -> Expectation:
    """What is known of the leader now."""
    return Expectation(
        final_heading=seen.final_heading,
        tas=seen.leader.tas,
        intent_known=seen.intent_known,
    )


def leader_change(was: Expectation, seen: Observation, turned: Radian) -> PlanReason | None:
    """What the leader does that the announced plan did not expect; `None` if nothing."""
    now = expectation(seen)
    if now.intent_known != was.intent_known:
        return "intent_received" if now.intent_known else "intent_withdrawn"
    if abs(wrap_signed(now.final_heading - was.final_heading)) > turned:
        return "leader_turned"
    if abs(now.tas - was.tas) > CHANGED_SPEED:
        return "leader_changed_speed"
    return None


def reason_sentence(reason: PlanReason, seen: Observation) -> str:
    """Why there is a new plan, without a full stop."""
    match reason:
        case "engaged":
            return "Relative guidance engaged"
        case "better_plan":
            return "A faster path was found"
        case "deviation":
            return "Planned again, as the aircraft has left its path"
        case "separation":
            return "The plan no longer kept the minimum separation"
        case "leader_turned":
            heading = compass(seen.final_heading)
            if seen.turn_to_come:
                return f"The leader will turn to {heading}"
            return f"The leader's heading is {heading}"
        case "leader_changed_speed":
            return f"The leader flies {seen.leader.tas / KT:.0f} kt"
        case "intent_received":
            return "The leader's intent is known"
        case "intent_withdrawn":
            return "The leader's intent is no longer known"


def summary(plan: Plan) -> str:
    """Its word, its time and the separation it keeps, in a clause."""
    minutes, seconds = divmod(round(plan.time_to_converge), 60)
    least = plan.certificate.least_separation / NM
    return f"{plan.word} joins in {minutes} min {seconds:02d} s and keeps {least:.1f} NM"
