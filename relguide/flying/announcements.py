"""What guidance has to say: its modes, its new plans, and why, in sentences for the pilot."""

from dataclasses import dataclass
from math import pi
from typing import Literal

from relguide.flying.assignment import Seen
from relguide.flying.commitment import Commitment
from relguide.planning.plan import NoPlan, Plan
from relguide.units import DEG, KT, NM, MetrePerSecond, Radian

Mode = Literal["heading", "converge", "capture", "follow"]
"""heading: nothing to fly, holds its heading; converge: flies the plan; capture: closes onto the
leader's route at its own speed; follow: on the route at D, speed matched."""
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
TURNED: Radian = 1.0 * DEG  # five times what the leader's own autopilot wanders
CHANGED_SPEED: MetrePerSecond = 2.0 * KT  # below what a crew would call a speed change


@dataclass(frozen=True, slots=True, kw_only=True)
class NewPlan:
    """Another plan is flown."""

    commitment: Commitment
    reason: PlanReason
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanMissing:
    """There is no plan."""

    answer: NoPlan


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeChange:
    """Guidance works differently from now on."""

    mode: Mode
    previous: Mode
    message: str


Event = NewPlan | PlanMissing | ModeChange


@dataclass(frozen=True, slots=True, kw_only=True)
class Expectation:
    """The leader as the shown plan took it."""

    final_heading: Radian
    tas: MetrePerSecond
    intent_known: bool


def expectation(seen: Seen) -> Expectation:
    """The leader as it is known now."""
    return Expectation(
        final_heading=seen.final_heading,
        tas=seen.leader.tas,
        intent_known=seen.intent_known,
    )


def leader_change(was: Expectation, seen: Seen, turned: Radian) -> PlanReason | None:
    """What the leader does that the last plan did not know."""
    now = expectation(seen)
    if now.intent_known != was.intent_known:
        return "intent_received" if now.intent_known else "intent_withdrawn"
    if abs((now.final_heading - was.final_heading + pi) % (2.0 * pi) - pi) > turned:
        return "leader_turned"
    if abs(now.tas - was.tas) > CHANGED_SPEED:
        return "leader_changed_speed"
    return None


def because(reason: PlanReason, seen: Seen) -> str:
    """Why there is a new plan."""
    match reason:
        case "engaged":
            return "Relative guidance engaged"
        case "better_plan":
            return "A faster way opened"
        case "deviation":
            return "Planned again from here"
        case "separation":
            return "The plan no longer kept the separation"
        case "leader_turned":
            heading = f"{round(seen.final_heading / DEG) % 360:03d}°"
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
    """What it brings."""
    minutes, seconds = divmod(round(plan.time_to_converge), 60)
    least = plan.certificate.least_separation / NM
    return f"{plan.word} joins in {minutes} min {seconds:02d} s and keeps {least:.1f} NM"
