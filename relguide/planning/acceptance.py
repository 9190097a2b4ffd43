"""ask(planner, situation): a planner's answer if it may be flown, else the exact plan.

Whoever made a plan, it is held to the same conditions: it begins where the pursuer is, turns no
steeper than it may, joins (eq. 7), and keeps d_min. What a planner says of its plan counts for
nothing: the certificate is made anew, for the situation that was asked about.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from inspect import signature
from math import hypot, inf
from types import FunctionType
from typing import Literal, NamedTuple

from relguide.kernels.base.angles import wrap_signed
from relguide.planning.aircraft import Pursuer
from relguide.planning.arrival import (
    MAX_EARLY,
    MAX_HEADING_ERROR,
    MAX_SLOT_ERROR,
    arrival,
)
from relguide.planning.certificate import Certificate, certify, lost_to
from relguide.planning.deadline import end_of, left_until
from relguide.planning.levels import is_at_level
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.phrases import distance, duration, too_close, too_close_to
from relguide.planning.plan import plan as exact_plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.units import DEG, Second

STEEPER = 1e-3
"""By so much of itself a turn's curvature may exceed the tightest: 0.02° of bank at 25°."""

Fault = Literal["no_answer", "start", "bank", "slot", "heading", "too_early", "level", "separation"]
"""What is wrong with a planner's answer: it is neither a plan nor says why there is none; it does
not begin where the pursuer is; it turns too steeply; it ends beside the slot, on another heading,
before the slot opens, or at another level; it does not keep d_min."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Refusal:
    """Why a planner's answer is not flown."""

    planner: str
    """The name the plan gives its planner; empty if the answer is no plan."""
    fault: Fault
    message: str
    """A sentence for people."""


class FlyableAnswer(NamedTuple):
    """What may be flown, and whose it is."""

    plan: Plan | NoPlan
    fell_back: bool
    """Whether it is the exact plan: the planner gave no answer, or one that was refused."""
    refusal: Refusal | None
    """Why the planner's own answer is not flown; `None` if it is."""


def ask(planner: Planner, situation: Situation, *, deadline: Second | None = None) -> FlyableAnswer:
    """A planner's answer if it may be flown; if not, the exact plan and why.

    What a planner raises is not caught: that is its caller's to see.

    Args:
        planner: who is asked.
        situation: what to plan.
        deadline: as in `plan`, for a planner that takes one: any other is let finish, and the exact
            plan has what is left [s].
    """
    if deadline is None:
        answer = planner(situation)
        until = inf
    else:
        until = end_of(deadline)
        answer = with_deadline(planner, left_until(until))(situation)
    if planner is exact_plan:
        return FlyableAnswer(answer, fell_back=False, refusal=None)
    return judge_answer(answer, situation, until)


def with_deadline(planner: Planner, deadline: Second | None) -> Planner:
    """A planner that answers by a deadline [s], if it is one that takes `deadline`."""
    if deadline is None or not takes_deadline(planner):
        return planner
    timed: Callable[..., Plan | NoPlan] = planner
    return partial(timed, deadline=deadline)


@lru_cache(64)
def takes_deadline(planner: Planner) -> bool:
    """Whether a planner can be given a `deadline`, as `plan` can."""
    if isinstance(planner, FunctionType):
        return _names_deadline(planner)
    return "deadline" in signature(planner).parameters


@lru_cache(maxsize=64)
def _names_deadline(planner: FunctionType) -> bool:
    """Whether a function does: reading its signature takes longer than some plans."""
    return "deadline" in signature(planner).parameters


def judge_answer(answer: object, situation: Situation, until: float = inf) -> FlyableAnswer:
    """As `ask`, of an answer that has been given; an exact plan is made by then, of `clock.now`."""
    match answer:
        case NoPlan():
            return FlyableAnswer(answer, fell_back=False, refusal=None)
        case Plan():
            asked = _with_levels(situation, answer)
            certificate = certify(answer.trajectory, asked)
            found = find_fault(answer.trajectory, situation)
            if found is None and not is_at_level(asked, answer.time_to_converge):
                found = "level", "it ends at another level than the leader's"
            if found is None and not certificate.holds:
                found = "separation", f"it comes {_how_near(certificate, situation)}"
            if found is None:
                if answer.certificate != certificate or answer.situation is not asked:
                    answer = replace(answer, situation=asked, certificate=certificate)
                return FlyableAnswer(answer, fell_back=answer.fell_back, refusal=None)
            fault, why = found
            message = f"The plan of {answer.planner} is not flown: {why}."
            refusal = Refusal(planner=answer.planner, fault=fault, message=message)
        case _:
            kind = type(answer).__name__
            message = f"The planner answered with neither a Plan nor a NoPlan, but with {kind}."
            refusal = Refusal(planner="", fault="no_answer", message=message)
    instead = exact_plan(situation, deadline=left_until(until))
    if isinstance(instead, Plan):
        instead = replace(instead, fell_back=True)
    return FlyableAnswer(instead, fell_back=True, refusal=refusal)


def _with_levels(situation: Situation, answer: Plan) -> Situation:
    """What was asked about, with the changes of level that were planned."""
    if answer.levels == situation.pursuer.levels:
        return situation
    return replace(situation, pursuer=replace(situation.pursuer, levels=answer.levels))


def _how_near(certificate: Certificate, situation: Situation) -> str:
    lost = lost_to(certificate)
    if lost is None:
        return too_close(certificate.least_separation, situation.min_separation)
    return too_close_to(lost.ident, lost.least_separation, lost.min_separation)


def find_fault(trajectory: Trajectory, situation: Situation) -> tuple[Fault, str] | None:
    """What is wrong with a trajectory from the pursuer to the slot; `None` if nothing is.

    Whether it keeps d_min is not asked here: `certify` judges that.

    Returns:
        what is wrong first, and the second half of a sentence that says so.
    """
    pursuer = situation.pursuer
    start = _fault_at_start(trajectory, pursuer)
    if start is not None:
        return start
    curvature = max((abs(c) for s in trajectory.segments for _, c in s.bends), default=0.0)
    if curvature * pursuer.turn_radius > 1.0 + STEEPER:
        least, bank = distance(pursuer.turn_radius), pursuer.max_bank / DEG
        return "bank", (
            f"it turns on a radius of {distance(1.0 / curvature)}, and {least} is the least at "
            f"{bank:.0f}° of bank"
        )
    end = arrival(trajectory, situation)
    if end.slot_error > MAX_SLOT_ERROR:
        return "slot", f"it ends {distance(end.slot_error)} from the slot"
    if end.heading_error > MAX_HEADING_ERROR:
        return "heading", f"it ends {end.heading_error / DEG:.1f}° off the leader's heading"
    if end.early > MAX_EARLY:
        return "too_early", f"it is at the slot {duration(end.early)} before it opens"
    return None


def _fault_at_start(trajectory: Trajectory, pursuer: Pursuer) -> tuple[Fault, str] | None:
    """To the tolerances of the other end; of the speed, by what it makes of the whole way."""
    beside = hypot(trajectory.x - pursuer.x, trajectory.y - pursuer.y)
    if beside > MAX_SLOT_ERROR:
        return "start", f"it begins {distance(beside)} from where the pursuer is"
    turned = abs(wrap_signed(trajectory.heading - pursuer.heading))
    if turned > MAX_HEADING_ERROR:
        return "start", f"it begins {turned / DEG:.1f}° off the pursuer's heading"
    if abs(trajectory.tas - pursuer.tas) * trajectory.duration > MAX_SLOT_ERROR:
        return "start", f"it is flown at {trajectory.tas:.1f} m/s, not at {pursuer.tas:.1f} m/s"
    return None
