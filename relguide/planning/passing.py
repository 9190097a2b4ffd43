"""passing(trajectory, surroundings): behind the leader or ahead of it, and on which side.

Seen from the leader all paths to the slot lead from one place to one other, and as long as they
avoid the leader itself, how far the line of sight turns along them differs only by whole turns. The
path that keeps behind the leader is the one whose line of sight never sweeps, on balance, over the
line ahead.
"""

from dataclasses import dataclass
from math import atan2, hypot, pi
from typing import Literal

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.winding import sight_turn
from relguide.planning.slot import slot_offset
from relguide.planning.tables import path_of
from relguide.planning.trajectory import LEFT, RIGHT, Trajectory, Turn
from relguide.planning.words import Candidates
from relguide.units import Metre, Radian

NEAREST = 1e-2
"""Below this separation the side on which the leader is passed is not resolved [R]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Passing:
    """How a path passes the leader."""

    side: Turn
    """`LEFT`: the line of sight turns counter-clockwise on balance; the pursuer goes round the
    leader in that sense and has it on its left hand. `RIGHT`: clockwise. As for boundary arcs."""
    laps: int
    """How often it crosses the line ahead of the leader on its final leg, clockwise round it
    positive, counter-clockwise negative: 0 for a path that passes behind."""

    @property
    def where(self) -> Literal["behind", "ahead"]:
        """Whether it passes behind the leader or ahead of it."""
        return "ahead" if self.laps else "behind"


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings:
    """What all paths of a situation have in common, as seen from the leader.

    Angles are those of the pursuer, clockwise from straight behind the leader on its final leg.
    """

    leader: FloatArray
    """What the leader flies, as kernels take it."""
    nearest: Metre
    """The separation below which steps grow no shorter."""
    begins: Radian
    """Where the pursuer is at first."""
    ends: Radian
    """Where the slot is: 0 but for wind."""


def surroundings(found: Candidates) -> Surroundings:
    """What the paths of a situation have in common."""
    pursuer, leader, frame = found.situation.pursuer, found.leader, found.frame
    nearest = NEAREST * frame.radius
    slot_x, slot_y, _ = slot_offset(frame.heading, leader.tas, found.situation)

    def from_behind(dx: Metre, dy: Metre) -> Radian:
        if hypot(dx, dy) < nearest:  # a slot at the leader's own place
            return 0.0
        return wrap_signed(atan2(dx, dy) - frame.heading - pi)

    return Surroundings(
        leader=path_of(leader),
        nearest=nearest,
        begins=from_behind(pursuer.x - leader.x, pursuer.y - leader.y),
        ends=from_behind(slot_x, slot_y),
    )


def passing(trajectory: Trajectory, around: Surroundings) -> Passing:
    """How a trajectory that ends in the slot passes the leader."""
    turned = sight_turn(path_of(trajectory), around.leader, trajectory.duration, around.nearest)
    laps = round((around.begins + turned - around.ends) / (2.0 * pi))
    return Passing(side=RIGHT if turned > 0.0 else LEFT, laps=laps)
