"""evaluate(regular, situation): what the paper asks of a regular trajectory, (17)–(24) corrected.

The leader keeps straight. Nodes are laid forward from the pursuer's state (18); their error at the
slot is that of (19). Laid backward from the slot, as the paper numbers them, the error is that of
(18). The separation (20) is tested pair by pair: the straight in closed form, the turn
as the arc it is, which (21)–(24) lay out as a straight.
"""

from dataclasses import dataclass
from math import cos, inf, sin

import numpy as np

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.motion import Motion, advance
from relguide.kernels.separation.approach import closest_of_straights, least_separation
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.certificate import TOLERANCE
from relguide.planning.inputs import expect
from relguide.planning.regular import RegularTrajectory, Triplet
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_offset
from relguide.planning.trajectory import Arc, Pose, Trajectory
from relguide.units import Metre, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class EndError:
    """By how much an end condition is missed."""

    along: Metre
    """Along the leader's heading [m]."""
    left: Metre
    """To the left of it [m]."""
    heading: Radian
    """Clockwise of what it should be [rad], in [−π, π)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairSeparation:
    """The separation on one pair: (20), by (21)–(24) in their corrected form."""

    turn_least: Metre
    """Least separation during the turn, flown as the arc it is [m]."""
    turn_bound: Metre
    """A proved lower bound of it [m]."""
    t_star: Second
    """T_i* of (21), counted back from node i: where two endless straights would be closest [s]."""
    straight_least: Metre
    """Least separation on the straight: (22) if T* ≤ 0, (23) if T* ≥ l/V_P, (24) between [m]."""
    holds: bool
    """Whether both keep d_min, to 1e-6 R."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularEvaluation:
    """A regular trajectory, flown from the initial situation."""

    order: int
    length: Metre
    """(17) [m]."""
    duration: Second
    nodes: tuple[Pose, ...]
    """In the air mass; the first is node 1, the last node n, which is the pursuer's state (18)."""
    initial: EndError
    """Laid backward from the slot, how far it begins from the pursuer's state (18)."""
    final: EndError
    """Flown from the pursuer's state, how far it ends from the slot (19)."""
    separations: tuple[PairSeparation, ...]
    """Numbered as the triplets."""
    keeps_separation: bool
    """(20): whether every pair keeps d_min."""


def evaluate(regular: RegularTrajectory, situation: Situation) -> RegularEvaluation:
    """Length, end conditions and separation of a regular trajectory.

    Args:
        regular: the parameters.
        situation: the pursuer, D, d_min, the wind, and a leader that keeps straight. In wind the
            slot of (19) is D behind the leader over the ground.

    Raises:
        ValueError: if the leader's intent turns.
    """
    expect("regular", regular, RegularTrajectory)
    expect("situation", situation, Situation)
    pursuer, leader = situation.pursuer, situation.leader.trajectory
    if any(isinstance(s, Arc) and s.turn_angle > 0.0 for s in leader.segments):
        raise ValueError(
            "The paper's regular trajectories join a leader that keeps straight; the intent of "
            "this one turns: leave it out."
        )
    length = regular.length(pursuer.turn_radius)
    duration = length / pursuer.tas
    at_end = leader.pose_at(duration)
    east, north, _ = slot_offset(at_end.heading, leader.tas, situation)
    slot = Pose(x=at_end.x + east, y=at_end.y + north, heading=at_end.heading)
    present = Pose(x=pursuer.x, y=pursuer.y, heading=wrap(pursuer.heading))
    nodes, separations, t = [present], [], 0.0
    for pair in reversed(regular.triplets):
        separations.append(_separation(pair, nodes[-1], t, leader, situation))
        nodes.append(_fly(pair, nodes[-1], situation))
        t += (pair.length + pursuer.turn_radius * pair.turn_angle) / pursuer.tas
    start = slot
    for pair in regular.triplets:
        start = _fly_back(pair, start, situation)
    return RegularEvaluation(
        order=regular.order,
        length=length,
        duration=duration,
        nodes=tuple(reversed(nodes)),
        initial=_end_error(start, present, slot.heading),
        final=_end_error(nodes[-1], slot, slot.heading),
        separations=tuple(reversed(separations)),
        keeps_separation=all(separation.holds for separation in separations),
    )


def _rate_and_times(pair: Triplet, situation: Situation) -> tuple[float, float, float]:
    """Turn rate [rad/s, right positive], time in the turn and on the straight [s]."""
    tas, radius = situation.pursuer.tas, situation.pursuer.turn_radius
    return -pair.turn * tas / radius, pair.turn_angle * radius / tas, pair.length / tas


def _fly(pair: Triplet, pose: Pose, situation: Situation) -> Pose:
    tas = situation.pursuer.tas
    rate, turning, straight = _rate_and_times(pair, situation)
    x, y, heading = advance(pose.x, pose.y, pose.heading, tas, rate, turning)
    x, y, heading = advance(x, y, heading, tas, 0.0, straight)
    return Pose(x=x, y=y, heading=wrap(heading))


def _fly_back(pair: Triplet, pose: Pose, situation: Situation) -> Pose:
    tas = situation.pursuer.tas
    rate, turning, straight = _rate_and_times(pair, situation)
    x, y, heading = advance(pose.x, pose.y, pose.heading, tas, 0.0, -straight)
    x, y, heading = advance(x, y, heading, tas, rate, -turning)
    return Pose(x=x, y=y, heading=wrap(heading))


def _end_error(pose: Pose, due: Pose, leader_heading: Radian) -> EndError:
    dx, dy = pose.x - due.x, pose.y - due.y
    along_x, along_y = sin(leader_heading), cos(leader_heading)
    return EndError(
        along=dx * along_x + dy * along_y,
        left=dy * along_x - dx * along_y,
        heading=wrap_signed(pose.heading - due.heading),
    )


def _separation(
    pair: Triplet, start: Pose, t: Second, leader: Trajectory, situation: Situation
) -> PairSeparation:
    """(21)–(24) for the straight, and the arc as an arc.

    Paper: printed for a node with the whole pair laid out along one heading; here r and v are
        those at node i, and T* = r·v / v·v counts back from it.   tests/test_paper.py::test_eq_21
    """
    tas, radius = situation.pursuer.tas, situation.pursuer.turn_radius
    rate, turning, straight = _rate_and_times(pair, situation)
    theirs = leader.pose_at(t)
    least, _, bound = least_separation(
        Motion(start.x, start.y, start.heading, tas, np.array(((turning, rate),))),
        Motion(theirs.x, theirs.y, theirs.heading, leader.tas, np.empty((0, 2))),
        0.0,
        turning,
        TOLERANCE * radius,
    )
    end, theirs = _fly(pair, start, situation), leader.pose_at(t + turning + straight)
    r = end.x - theirs.x, end.y - theirs.y
    v = (
        tas * sin(end.heading) - leader.tas * sin(theirs.heading),
        tas * cos(end.heading) - leader.tas * cos(theirs.heading),
    )
    after_end, _ = closest_of_straights(*r, *v, -inf, inf)
    _, on_straight = closest_of_straights(*r, *v, -straight, 0.0)
    limit = situation.min_separation - SLACK * radius
    return PairSeparation(
        turn_least=least,
        turn_bound=bound,
        t_star=-after_end,
        straight_least=on_straight,
        holds=bound >= limit and on_straight >= limit,
    )
