"""Which plan to fly: the committed one, until it fails or another is better by a margin.

The fastest plan is discontinuous in the situation: 100 m may change it by a minute, and move it to
the other side of the leader. Always to fly the fastest would be to chatter between the two. So the
same branch is solved again from where the aircraft is, and left only for a reason.
"""

from dataclasses import dataclass, replace
from math import hypot
from typing import Literal

from relguide.flying.aircraft import AircraftModel
from relguide.flying.path_distance import SAME_PATH_SHARE, distance_between, is_same_path
from relguide.flying.steering import remaining, steer
from relguide.planning.acceptance import Answer, Refusal, ask
from relguide.planning.arrival import arrival
from relguide.planning.candidate import Candidate
from relguide.planning.certificate import certify
from relguide.planning.plan import AS_FAST, NoPlan, Optimality, Plan, Planner
from relguide.planning.situation import Situation
from relguide.planning.slot import over_ground, slot_frame
from relguide.planning.trajectory import Arc, Pose, Trajectory
from relguide.planning.words import candidates
from relguide.units import Metre, Second

Cause = Literal["continued", "better_plan", "deviation", "separation"]
"""Why the trajectory flown from now on is what it is."""

MARGIN: Second = 1.0  # a change of plan costs one or two roll reversals, about a second each
SHARE = 0.005  # what is far ahead is uncertain: half a percent of the time to go
OVERDUE: Second = 10.0  # what two rolls cost; a longer delay has another cause
AT_THE_END: Second = 30.0  # it brakes by then (LAST_STRETCH of guidance) and is slower than V_P
LEASH: Metre = 600.0  # what one roll-in costs; farther off, the committed path is not being flown


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """A plan being flown."""

    plan: Plan
    """Its trajectory is of the air mass, which was the world frame at `made_at`."""
    made_at: Second
    """Flight time [s]."""
    due: Second
    """When it was to arrive, before it was solved again for the first time, flight time [s]."""

    def remaining_at(self, t: Second, situation: Situation) -> Trajectory:
        """The part still to be flown at flight time t, in the situation's own air-mass frame."""
        elapsed = t - self.made_at
        left = remaining(self.plan.trajectory, elapsed)
        wind = situation.wind
        if wind.east == wind.north == 0.0:
            return left
        return replace(left, x=left.x + wind.east * elapsed, y=left.y + wind.north * elapsed)

    def place_at(self, t: Second, situation: Situation) -> tuple[Pose, Second]:
        """Where it is at flight time t, in the same frame, and how long it still takes."""
        elapsed, wind = t - self.made_at, situation.wind
        left = max(self.plan.time_to_converge - elapsed, 0.0)
        return over_ground(self.plan.trajectory.pose_at(elapsed), elapsed, wind), left


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """What to fly from now on, and why."""

    plan: Plan
    cause: Cause
    fell_back: bool
    """Whether the planner's own answer may not be flown, and the exact plan took its place."""
    refusal: Refusal | None
    """Why the planner's own plan is not flown; `None` if it was not asked, or may be flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoChoice:
    """Nothing to fly, and why."""

    answer: NoPlan
    fell_back: bool
    """As in `Choice`: the exact planner had no plan either."""
    refusal: Refusal | None


def choose(
    committed: Commitment | None,
    t: Second,
    *,
    preferred: Situation,
    required: Situation,
    planner: Planner,
    model: AircraftModel,
) -> Choice | NoChoice:
    """Decide what to fly.

    The last turn is flown as it was planned. Full bank has nothing to spare: solved again from a
    few metres outside it, the exact answer swings wide first, by a turn that grows with the root of
    those metres. Turns before it are solved again, which makes good what rolling into them cost,
    but not for ever: once overdue, they too are flown as last planned. So is a plan that arrives as
    the slot opens: nothing is faster, and one of the many that are as fast is kept.

    Args:
        committed: what is flown now; `None` only before the first plan.
        t: flight time [s].
        preferred: the situation with the separation that new plans should keep.
        required: the same with d_min itself, which the committed plan must keep, and new plans when
            nothing keeps the preferred separation.
        planner: makes plans; they are judged before they are flown, whoever made them.
        model: how the aircraft rolls.
    """
    if committed is not None:
        left = committed.remaining_at(t, required)
        overdue = t + left.duration > committed.due + OVERDUE
        if _only_turns_left(left, model, overdue=overdue) or _arrives_at_release(left, required):
            kept = _continue_as_planned(left, committed.plan, required)
            if kept is not None:
                return Choice(plan=kept, cause="continued", fell_back=False, refusal=None)
    answer, fell_back, refusal = _first_answer(planner, preferred, required)

    def chosen(plan: Plan, cause: Cause) -> Choice:
        return Choice(plan=plan, cause=cause, fell_back=fell_back, refusal=refusal)

    if committed is None:
        if isinstance(answer, NoPlan):
            return NoChoice(answer=answer, fell_back=fell_back, refusal=refusal)
        return chosen(answer, "better_plan")
    if isinstance(answer, Plan) and is_same_path(left, answer.trajectory):
        return chosen(answer, "continued")
    kept = _solve_again(left, required) or _continue_as_planned(left, committed.plan, required)
    if kept is None:
        if isinstance(answer, NoPlan):
            return NoChoice(answer=answer, fell_back=fell_back, refusal=refusal)
        return chosen(answer, "deviation" if certify(left, required).holds else "separation")
    if isinstance(answer, Plan):
        gain = kept.time_to_converge - answer.time_to_converge
        if gain > max(MARGIN, SHARE * kept.time_to_converge):
            return chosen(answer, "better_plan")
    return chosen(kept, "continued")


def _first_answer(planner: Planner, preferred: Situation, required: Situation) -> Answer:
    """A plan that keeps the preferred separation, or the required one."""
    pursuer, leader = required.pursuer, required.leader
    apart = hypot(pursuer.x - leader.x, pursuer.y - leader.y)
    if apart < preferred.min_separation or preferred.min_separation <= required.min_separation:
        return ask(planner, required)  # nothing keeps what is lost already
    wide = ask(planner, preferred)
    if isinstance(wide.plan, Plan):
        return wide
    close = ask(planner, required)
    return Answer(
        close.plan,
        fell_back=wide.fell_back or close.fell_back,
        refusal=close.refusal or wide.refusal,
    )


def _solve_again(left: Trajectory, situation: Situation) -> Plan | None:
    """The certified extremal nearest to the part still to be flown, if there is one near."""
    found = candidates(situation)
    near = [
        candidate
        for candidate in (*found.at_release, *found.later)
        if is_same_path(left, candidate.trajectory, share=2.0 * SAME_PATH_SHARE)
    ]
    near.sort(key=lambda candidate: distance_between(left, candidate.trajectory))
    for candidate in near:
        plan = _as_plan(candidate, situation, found.bound)
        if plan.certificate.holds:
            return plan
    return None


def _as_plan(candidate: Candidate, situation: Situation, bound: Second) -> Plan:
    fastest = candidate.time_to_converge <= bound + AS_FAST  # the same root, rounded
    return Plan(
        situation=situation,
        trajectory=candidate.trajectory,
        word=candidate.word,
        certificate=certify(candidate.trajectory, situation),
        optimality=Optimality(proof="relaxation" if fastest else "none", lower_bound=bound),
        planner="exact",
        compute_time=0.0,
    )


def _continue_as_planned(left: Trajectory, plan: Plan, situation: Situation) -> Plan | None:
    """The rest of the plan as it was, if it certifies, is being flown and ends at the slot."""
    pursuer = situation.pursuer
    if hypot(pursuer.x - left.x, pursuer.y - left.y) > LEASH or left.duration == 0.0:
        return None
    if arrival(left, situation).slot_error > LEASH:  # the leader may not be where the plan had it
        return None
    certificate = certify(left, situation)
    if not certificate.holds or not _keeps_clear_beside(left, situation):
        return None
    return Plan(
        situation=situation,
        trajectory=left,
        word=left.letters,
        certificate=certificate,
        optimality=Optimality(proof="none", lower_bound=0.0),
        planner=plan.planner,
        compute_time=0.0,
    )


def _keeps_clear_beside(left: Trajectory, situation: Situation) -> bool:
    """Whether d_min is kept on the parallel path from where the aircraft really is.

    A loss near its end does not count: there the spacing is off, and speed corrects it.
    """
    pursuer = situation.pursuer
    beside = certify(replace(left, x=pursuer.x, y=pursuer.y), situation)
    return beside.holds or beside.at_time > left.duration - AT_THE_END


def _only_turns_left(left: Trajectory, model: AircraftModel, *, overdue: bool) -> bool:
    """Whether only the last turn is left to fly, or only turns on a plan that is overdue."""
    segments = steer(left, model).segments
    if not all(isinstance(segment, Arc) for segment in segments):
        return False
    return len(segments) == 1 or (overdue and len(segments) > 1)


def _arrives_at_release(left: Trajectory, situation: Situation) -> bool:
    """Whether it arrives as the slot opens, so that no plan can be better by the margin."""
    if not situation.leader.intent:
        return left.duration < MARGIN
    frame = slot_frame(situation, situation.leader.trajectory)
    slot_release = frame.t_release * frame.radius / situation.pursuer.tas
    return left.duration < slot_release + MARGIN
