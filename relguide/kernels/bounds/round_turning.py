"""How long it takes at least to go round the disc of a leader that turns, without turning oneself.

A front sweeps round the disc: the half-line from a point P of its edge outward that is normal to e,
with e ahead. It moves at V_P along e. Who is behind it can at most keep up with it, since no more
than V_P of his speed is along e; nor does the disc let anyone through. If now and then it is turned
about P, to the side the disc is on, what is outside moves ahead still more. So nobody is sooner at
a bearing than P. P is as slow as it can be if e is where someone sliding along the edge would head,

    e at bearing β + s arccos(α cos b),    s = +1 counter-clockwise,

with b = β less the leader's heading: so e is turned there, unless that is to the other side. It is
kept for a step at a time; P is then where a line at V_P cuts a disc that moves as the leader does,
in closed form. On a straight leg this is `round_time`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, sin, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Scene
from relguide.kernels.bounds.breach import INSIDE
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.separation.clearance import leader_at, piece_at

_STEP = 0.1  # for which a front keeps its direction, in d_min and at V_P
_WIDEST = 3.1  # e is no further than this from the bearing of P, so that the disc is beside it
_HALVINGS = 16  # of the step in which P arrives: to 1e-5 R/V_P
ROUNDING = 1e-5  # 0.5 ms for an airliner: more than what rounding makes of all of this [R/V_P]
FAST = 0.999  # for a leader faster than this the time round the disc is not bounded


class Front(NamedTuple):
    """A front while it keeps its direction."""

    sense: float
    """+1 counter-clockwise, −1 clockwise."""
    pace: float
    """+1 on in time, −1 back, where the leader flies backward."""
    bearing: float
    """Of P from the leader, at first [rad]."""
    course: float
    """Of e [rad]."""
    past: float
    """How far along e the line then lies [R]."""
    t: float
    """When that is [R/V_P]."""


@njit(cache=True, nogil=True)
def round_arrival(scene: Scene, cell: Cell, other: Cell, latest: float) -> float:
    """How soon something that starts in a cell of contacts can be in another one [R/V_P].

    Args:
        scene: the leader and d_min.
        cell: from which it starts; its window of time has an end.
        other: to which it goes.
        latest: arrivals from here on do not matter, and come back as infinite.
    """
    low, high = bearings_of(scene, cell)
    begin, end = bearings_of(scene, other)
    blur = 0.5 * (high - low) + 0.5 * (end - begin)
    apart = 0.5 * (begin + end) - 0.5 * (low + high)
    soonest = inf
    for way in range(2):
        sense = 1.0 - 2.0 * way
        angle = wrap(sense * apart) - blur
        if angle <= 0.0 or angle + 2.0 * blur >= TWO_PI or scene.alpha > FAST:
            return cell.start
        edge = high if way == 0 else low
        soonest = min(soonest, _sweep(scene, cell.start, edge, angle, sense, min(latest, soonest)))
    return soonest


@njit(cache=True, nogil=True)
def bearings_of(scene: Scene, cell: Cell) -> tuple[float, float]:
    """The bearings of a cell's contacts from the leader, least and greatest [rad].

    Relative to the slot's heading.
    """
    first = leader_at(scene, cell.piece, cell.start).h
    last = first if cell.end == inf else leader_at(scene, cell.piece, cell.end).h
    low, high = cell.bearing - cell.half, cell.bearing + cell.half
    return low + min(first, last), high + max(first, last)


@njit(cache=True, nogil=True)
def _sweep(
    scene: Scene, t: float, bearing: float, angle: float, sense: float, latest: float
) -> float:
    """When a front that begins at a bearing has swept an angle; infinite from `latest` on."""
    step, course = step_of(scene), bearing
    while t < latest:
        front = front_from(scene, t, bearing, course, sense, 1.0)
        swept = swept_by(scene, front, step)
        if swept >= angle:
            t += time_to(scene, front, angle, step)
            break
        bearing, course = bearing + sense * swept, front.course
        angle -= swept
        t += step
    return t - ROUNDING if t < latest else inf


@njit(cache=True, nogil=True)
def step_of(scene: Scene) -> float:
    """For how long a front keeps its direction [R/V_P]."""
    return _STEP * scene.d_min


@njit(cache=True, nogil=True)
def front_from(
    scene: Scene, t: float, bearing: float, course: float, sense: float, pace: float
) -> Front:
    """A front for the next step.

    Args:
        scene: the leader and d_min.
        t: when the step begins [R/V_P].
        bearing: of P then [rad].
        course: of e until then; the bearing, if it only begins [rad].
        sense: as in `Front`.
        pace: as in `Front`.
    """
    there = leader_at(scene, piece_at(scene.leader, t), t)
    alpha, later = pace * scene.alpha, 0.5 * step_of(scene)
    # where someone heads who slides along the edge, in the middle of the step
    along = alpha * cos(bearing - there.h)
    rate = (sqrt(1.0 - along * along) + sense * alpha * sin(bearing - there.h)) / scene.d_min
    on, soon = bearing + sense * rate * later, t + pace * later
    heading = leader_at(scene, piece_at(scene.leader, soon), soon).h
    wanted = sense * (on - bearing) + acos(alpha * cos(on - heading))
    course = bearing + sense * max(sense * (course - bearing), min(wanted, _WIDEST))
    across = there.x * cos(course) + there.y * sin(course)
    past = across + (scene.d_min - INSIDE) * cos(bearing - course)
    return Front(sense, pace, bearing, course, past, t)


@njit(cache=True, nogil=True)
def swept_by(scene: Scene, front: Front, took: float) -> float:
    """How far P has moved round the leader after a time; infinite if the front left the disc."""
    t = front.t + front.pace * took
    there = leader_at(scene, piece_at(scene.leader, t), t)
    ahead = front.past + took - there.x * cos(front.course) - there.y * sin(front.course)
    ahead /= scene.d_min - INSIDE
    if ahead >= 1.0:
        return inf
    return float(front.sense * (front.course - front.bearing) - acos(max(ahead, -1.0)))


@njit(cache=True, nogil=True)
def time_to(scene: Scene, front: Front, angle: float, step: float) -> float:
    """How long P has not moved so far round, at least: less than a step."""
    low, high = 0.0, step
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if swept_by(scene, front, middle) >= angle:
            high = middle
        else:
            low = middle
    return low
