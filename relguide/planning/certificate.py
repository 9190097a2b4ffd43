"""certify(trajectory, situation): a proved lower bound on the separation, all turns included.

It does not depend on where the trajectory comes from: it reads the segments alone.
"""

from dataclasses import dataclass

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.approach import least_on_paths
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.inputs import expect
from relguide.planning.situation import Situation
from relguide.planning.tables import leader_path, path_of
from relguide.planning.trajectory import Trajectory
from relguide.units import Metre, Second

TOLERANCE = 1e-7
"""How far below the least separation found the proof may stop [R]: 1 mm for an airliner."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Least separation of a trajectory from the leader over [0, T], with its proof."""

    least_separation: Metre
    """The least separation found, reached at `at_time` [m]."""
    at_time: Second
    """When it is reached [s]."""
    lower_bound: Metre
    """No separation anywhere in [0, T] is below this [m]: proved, not sampled."""
    holds: bool
    """Whether `lower_bound` keeps d_min, to 1e-6 R."""


def certify(trajectory: Trajectory, situation: Situation) -> Certificate:
    """Judge a trajectory of the air mass against the situation's real leader, its turns included.

    Args:
        trajectory: the pursuer's, from t = 0 to its end.
        situation: gives the leader with its intent, and d_min. Uniform wind moves both alike.
    """
    expect("trajectory", trajectory, Trajectory)
    expect("situation", situation, Situation)
    return judge(trajectory, situation, situation.pursuer.turn_radius, leader_path(situation))


def judge(
    trajectory: Trajectory, situation: Situation, radius: Metre, leading: FloatArray
) -> Certificate:
    """As `certify`, for many trajectories of one situation.

    Args:
        trajectory: the pursuer's.
        situation: gives the leader and d_min.
        radius: R, which callers have at hand [m].
        leading: the situation's `leader_path`, or `path_of` what its leader flies.
    """
    least, at, bound = least_on_paths(path_of(trajectory), leading, TOLERANCE * radius)
    return Certificate(
        least_separation=least,
        at_time=at,
        lower_bound=bound,
        holds=bound >= situation.min_separation - SLACK * radius,
    )
