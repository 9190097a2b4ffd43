"""How far apart two paths come, and whether they are the same path but for small differences."""

from math import hypot, inf

from relguide.kernels.base.motion import advance
from relguide.planning.trajectory import Trajectory
from relguide.units import Metre

SAME_PATH: Metre = 300.0  # replanning moves a path by metres, another path is kilometres off
SAME_PATH_SHARE = 0.03  # … and by this much of its length while rolling, when a turn begins late
SHARES = (0.33, 0.67, 1.0)
"""Where along their lengths two paths are compared."""


def is_same_path(one: Trajectory, other: Trajectory, *, share: float = SAME_PATH_SHARE) -> bool:
    """Whether two paths from about the same place are as near as replanning leaves them.

    Args:
        one: a path.
        other: another; its length is the scale.
        share: how much of that length they may be apart, besides `SAME_PATH`.
    """
    return distance_between(one, other) <= SAME_PATH + share * other.length


def distance_between(one: Trajectory, other: Trajectory) -> Metre:
    """The largest distance of two paths at the same shares of their lengths [m]."""
    return max(
        hypot(a[0] - b[0], a[1] - b[1])
        for a, b in zip(_places_along(one), _places_along(other), strict=True)
    )


def _places_along(path: Trajectory) -> list[tuple[Metre, Metre]]:
    """Where it is at each of `SHARES`, in one go: this is asked for every second."""
    places: list[tuple[Metre, Metre]] = []
    x, y, heading, begun = path.x, path.y, path.heading, 0.0
    bends, length = [bend for segment in path.segments for bend in segment.bends], path.length
    marks = [share * length for share in SHARES]
    for stretch, curvature in (*bends, (inf, 0.0)):
        while len(places) < len(marks) and marks[len(places)] <= begun + stretch:
            there = advance(x, y, heading, 1.0, curvature, marks[len(places)] - begun)
            places.append(there[:2])
        if len(places) == len(marks):
            break
        x, y, heading = advance(x, y, heading, 1.0, curvature, stretch)
        begun += stretch
    return places
