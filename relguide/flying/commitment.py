"""Which plan to fly: the committed one, until another is better by a margin or it fails.

The plan is discontinuous in the situation: 100 m may move it by a minute and to the other side.
Flown as it comes, it would chatter. So the same branch is solved again from where the aircraft
is, and given up only for a reason.
"""

from dataclasses import dataclass, replace
from math import cos, hypot, inf, sin
from typing import Literal

from relguide.flying.aircraft import AircraftModel
from relguide.flying.steering import rest, steer
from relguide.kernels.base.motion import advance
from relguide.planning.certificate import certify
from relguide.planning.plan import AS_FAST, NoPlan, Optimality, Plan, Planner
from relguide.planning.plan import plan as exact_plan
from relguide.planning.situation import Situation
from relguide.planning.slot import over_ground, slot_frame
from relguide.planning.trajectory import Arc, Pose, Trajectory
from relguide.planning.words import Candidate, candidates
from relguide.units import Metre, Second

Cause = Literal["continued", "better_plan", "deviation", "separation"]
"""Why the trajectory flown from now on is what it is."""

MARGIN: Second = 1.0  # a change of mind costs a roll reversal or two: about a second each
SHARE = 0.005  # and what is far ahead is uncertain: half a percent of the time to go
SAME_WAY: Metre = 300.0  # replanning moves a path by metres, another way is kilometres off
SAME_WAY_SHARE = 0.03  # … and by this much of its length while rolling, when a turn begins late
OVERDUE: Second = 10.0  # two rolls' worth: more is not what rolling costs
AT_THE_END: Second = 30.0  # by then it brakes (guidance's LAST_STRETCH), and no longer at V_P
LEASH: Metre = 600.0  # what one roll-in costs; farther off, the committed path is not being flown


@dataclass(frozen=True, slots=True, kw_only=True)
class Commitment:
    """A plan being flown."""

    plan: Plan
    """Its trajectory is of the air mass, which was the world frame at `made_at`."""
    made_at: Second
    """Flight time [s]."""
    due: Second
    """When it was to arrive before it was solved again for the first time, flight time [s]."""

    def rest_at(self, t: Second, situation: Situation) -> Trajectory:
        """What is left of it at flight time t, in the situation's own air-mass frame."""
        elapsed = t - self.made_at
        left = rest(self.plan.trajectory, elapsed)
        wind = situation.wind
        if wind.east == wind.north == 0.0:
            return left
        return replace(left, x=left.x + wind.east * elapsed, y=left.y + wind.north * elapsed)

    def place_at(self, t: Second, situation: Situation) -> tuple[Pose, Second]:
        """Where it is at flight time t, seen as by `rest_at`, and how long it goes on."""
        elapsed, wind = t - self.made_at, situation.wind
        left = max(self.plan.time_to_converge - elapsed, 0.0)
        return over_ground(self.plan.trajectory.pose_at(elapsed), elapsed, wind), left


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """What to fly from now on, and why."""

    plan: Plan
    cause: Cause
    fell_back: bool
    """Whether the planner had none of its own that certifies and the exact plan stood in."""


def choose(
    committed: Commitment | None,
    t: Second,
    *,
    preferred: Situation,
    required: Situation,
    planner: Planner,
    model: AircraftModel,
) -> Choice | NoPlan:
    """Decide what to fly.

    The last turn is flown as it was planned. Full bank has nothing to spare: solved again a few
    metres outside it, the exact answer swings wide first, by a turn that grows with the root of
    those metres. Turns before it are solved again, which makes good what rolling into them cost,
    but not for ever: once overdue, they too are flown as they were planned last. So is a plan
    that arrives as the slot opens: nothing is faster, and of the many that are as fast one is kept.

    Args:
        committed: what is flown now; `None` only before the first plan.
        t: flight time [s].
        preferred: the situation with the separation that new plans should keep.
        required: the same with d_min itself, which the committed plan is held to, and new plans
            when nothing keeps the preferred separation.
        planner: makes plans; the certificate judges them, whoever made them.
        model: how the aircraft rolls.
    """
    if committed is not None:
        left = committed.rest_at(t, required)
        overdue = t + left.duration > committed.due + OVERDUE
        if _as_planned(left, model, overdue=overdue) or _arrives_at_release(left, required):
            kept = _followed_on(left, committed.plan, required)
            if kept is not None:
                return Choice(plan=kept, cause="continued", fell_back=False)
    answer, fell_back = _first_answer(planner, preferred, required)
    if committed is None:
        if isinstance(answer, NoPlan):
            return answer
        return Choice(plan=answer, cause="better_plan", fell_back=fell_back)
    if isinstance(answer, Plan) and _same_way(left, answer.trajectory, SAME_WAY_SHARE):
        return Choice(plan=answer, cause="continued", fell_back=fell_back)
    kept = _solved_again(left, required) or _followed_on(left, committed.plan, required)
    if kept is None:
        if isinstance(answer, NoPlan):
            return answer
        lost = not certify(left, required).holds
        return Choice(plan=answer, cause="separation" if lost else "deviation", fell_back=fell_back)
    if isinstance(answer, Plan):
        gain = kept.time_to_converge - answer.time_to_converge
        if gain > max(MARGIN, SHARE * kept.time_to_converge):
            return Choice(plan=answer, cause="better_plan", fell_back=fell_back)
    return Choice(plan=kept, cause="continued", fell_back=fell_back)


def _first_answer(
    planner: Planner, preferred: Situation, required: Situation
) -> tuple[Plan | NoPlan, bool]:
    """A plan that keeps the preferred separation, or the required one; as `_ask`."""
    pursuer, leader = required.pursuer, required.leader
    apart = hypot(pursuer.x - leader.x, pursuer.y - leader.y)
    if apart < preferred.min_separation or preferred.min_separation <= required.min_separation:
        return _ask(planner, required)  # nothing keeps what is lost already
    answer, fell_back = _ask(planner, preferred)
    if isinstance(answer, Plan):
        return answer, fell_back
    answer, fell_back_again = _ask(planner, required)
    return answer, fell_back or fell_back_again


def _ask(planner: Planner, situation: Situation) -> tuple[Plan | NoPlan, bool]:
    """The planner's answer if it certifies, else the exact plan; whether that stood in."""
    answer = planner(situation)
    if isinstance(answer, NoPlan):
        return answer, False
    if certify(answer.trajectory, situation).holds:
        return answer, answer.fell_back
    return exact_plan(situation), True


def _solved_again(left: Trajectory, situation: Situation) -> Plan | None:
    """The extremal nearest to what is left, if it certifies."""
    found = candidates(situation)
    near = [
        candidate
        for candidate in (*found.at_release, *found.later)
        if _same_way(left, candidate.trajectory, 2.0 * SAME_WAY_SHARE)
    ]
    near.sort(key=lambda candidate: _distance_between(left, candidate.trajectory))
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


def _followed_on(left: Trajectory, plan: Plan, situation: Situation) -> Plan | None:
    """What is left, as it was planned, if the aircraft is on it, it leads there and certifies."""
    pursuer = situation.pursuer
    if hypot(pursuer.x - left.x, pursuer.y - left.y) > LEASH or left.duration == 0.0:
        return None
    if _misses(left, situation) > LEASH:
        return None
    certificate = certify(left, situation)
    if not certificate.holds or not _clear_beside(left, situation):
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


def _clear_beside(left: Trajectory, situation: Situation) -> bool:
    """Whether d_min is kept from where the aircraft really is, beside the path it is to follow.

    Not at its end: there it is the spacing that is off, and speed the answer.
    """
    pursuer = situation.pursuer
    beside = certify(replace(left, x=pursuer.x, y=pursuer.y), situation)
    return beside.holds or beside.at_time > left.duration - AT_THE_END


def _as_planned(left: Trajectory, model: AircraftModel, *, overdue: bool) -> bool:
    """Whether only the last turn is left, or only turns and no time to lose."""
    segments = steer(left, model).segments
    if not all(isinstance(segment, Arc) for segment in segments):
        return False
    return len(segments) == 1 or (overdue and len(segments) > 1)


def _arrives_at_release(left: Trajectory, situation: Situation) -> bool:
    """Whether no plan can be better by the margin."""
    if not situation.leader.intent:
        return left.duration < MARGIN
    frame = slot_frame(situation, situation.leader.trajectory)
    slot_release = frame.t_release * frame.radius / situation.pursuer.tas
    return left.duration < slot_release + MARGIN


def _misses(left: Trajectory, situation: Situation) -> Metre:
    """How far from the slot a path ends: the leader may not be where the plan had it."""
    frame = slot_frame(situation, situation.leader.trajectory)
    flown = situation.leader.tas * left.duration
    end = left.pose_at(left.duration)
    return hypot(
        end.x - frame.origin_x - flown * sin(frame.heading),
        end.y - frame.origin_y - flown * cos(frame.heading),
    )


def _same_way(left: Trajectory, other: Trajectory, share: float) -> bool:
    return _distance_between(left, other) <= SAME_WAY + share * other.length


def _distance_between(left: Trajectory, other: Trajectory) -> Metre:
    """How far apart two paths come, looked at after each third of the way."""
    return max(
        hypot(a[0] - b[0], a[1] - b[1])
        for a, b in zip(_on_the_way(left), _on_the_way(other), strict=True)
    )


def _on_the_way(path: Trajectory) -> list[tuple[Metre, Metre]]:
    """Where it is after each third, in one go: this is asked for every second."""
    places: list[tuple[Metre, Metre]] = []
    x, y, heading, begun = path.x, path.y, path.heading, 0.0
    bends, length = [bend for segment in path.segments for bend in segment.bends], path.length
    marks = [share * length for share in (0.33, 0.67, 1.0)]
    for stretch, curvature in (*bends, (inf, 0.0)):
        while len(places) < 3 and marks[len(places)] <= begun + stretch:
            there = advance(x, y, heading, 1.0, curvature, marks[len(places)] - begun)
            places.append(there[:2])
        if len(places) == 3:
            break
        x, y, heading = advance(x, y, heading, 1.0, curvature, stretch)
        begun += stretch
    return places
