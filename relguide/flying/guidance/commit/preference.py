"""Of two plans that are nearly as fast, the one like the path before is flown.

The fastest plan is discontinuous in the situation: 100 m may change it by a minute, and move it to
the other side of the leader. So the same branch is solved again from where the path leads, and left
only for much.
"""

from dataclasses import replace

from relguide.flying.belief import Belief
from relguide.flying.guidance.commit.path_distance import distance_between, is_same_path
from relguide.kernels.base.angles import wrap
from relguide.planning.certificate import certify
from relguide.planning.outcome import AS_FAST, Optimality, Plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import candidates
from relguide.units import Second

LIKE_BEFORE = 0.06
"""Share of its length that a path solved again may lie from the one before."""


def begun_now(path: Trajectory, belief: Belief) -> Trajectory:
    """A path with the same turns and lengths, from where the aircraft is."""
    own = belief.own
    return replace(path, x=own.x, y=own.y, heading=wrap(own.heading))


def turns_like(plan: Plan, path: Trajectory) -> bool:
    """Whether a plan turns to the same sides as a path, one after the other."""
    return _sides(plan.trajectory) == _sides(path)


def _sides(path: Trajectory) -> str:
    return path.letters.replace("S", "")


def nearest(plan: Plan, before: Trajectory, stay: Second) -> Plan:
    """The plan, or the extremal nearest to the path before if it is little slower.

    Args:
        plan: the fastest.
        before: the path before, from about where the plan begins.
        stay: how much slower the extremal may be [s].
    """
    if is_same_path(before, plan.trajectory):
        return plan
    found = candidates(plan.situation)
    near: list[Trajectory] = [
        candidate.trajectory
        for candidate in (*found.at_release, *found.later)
        if is_same_path(before, candidate.trajectory, share=LIKE_BEFORE)
        and candidate.time_to_converge < plan.time_to_converge + stay
    ]
    near.sort(key=lambda trajectory: distance_between(before, trajectory))
    for trajectory in near:
        kept = _as_plan(trajectory, plan.situation, found.bound)
        if kept.certificate.holds:
            return kept
    return plan


def _as_plan(trajectory: Trajectory, situation: Situation, bound: Second) -> Plan:
    fastest = trajectory.duration <= bound + AS_FAST  # the same root, rounded
    return Plan(
        situation=situation,
        trajectory=trajectory,
        word=trajectory.letters,
        certificate=certify(trajectory, situation),
        optimality=Optimality(proof="relaxation" if fastest else "none", lower_bound=bound),
        planner="exact",
        compute_time=0.0,
    )
