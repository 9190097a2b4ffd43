"""How long it takes at least to go round the disc of a leader that turns, without time to turn.

A front sweeps round the disc: the half-line from a point P of its edge outward that is normal to e,
with e ahead. It moves at V_P along e. A path behind it can at most keep up with it, since no more
than V_P of its speed is along e; nor does the disc let any path through. Now and then the front is
turned about P, to the side the disc is on; what is outside then moves ahead still more. So no path
is at a bearing sooner than P. P is as slow as it can be if e is where a path that slides along the
edge would head,

    e at bearing β + s arccos(α cos b),    s = +1 counter-clockwise,

with b = β less the leader's heading. So e is turned there, unless that is to the other side. The
front keeps e for a step at a time; P is then where a line at V_P cuts a disc that moves as the
leader does, in closed form. On a straight leg this is `around.round_time`.

A path that must turn is slower still. If it leaves a contact at heading h, it heads no further than
t from h a time t later, and of its speed no more than V_P cos(φ − t) is along e, if e lies φ > t
from h. So the front need not be faster; and likewise before a contact to which a path comes. That
counts where a path passes the leader the other way round than it goes on, and has to turn back, and
where no bank is enough to slide.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, floor, inf, pi, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import INSIDE
from relguide.kernels.bounds.words.cells import Cell, fastest_turn
from relguide.kernels.bounds.words.sets import EDGE
from relguide.kernels.separation.clearance import leader_at, piece_at, piece_end

_STEP = 0.1  # for which a front keeps its direction, in d_min and at V_P
_WIDEST = 3.1  # e is no further than this from the bearing of P, so that the disc is beside it
_TRIES = 8  # to say when P arrives within a step, to a tenth of `ROUNDING`
ROUNDING = 1e-5  # 0.5 ms for an airliner: more than what rounding makes of all of this [R/V_P]
UNKNOWN = -1e9
"""Long before everything [R/V_P]."""
FAST = 0.999  # for a leader faster than this the time round the disc is not bounded
GOING, LATE, SLIDES, ARRIVED = 0, 1, 2, 3
"""A front is followed so many steps; until it is too late; until on the final leg `round_time` says
what follows; or until it has swept the angle."""
ANY = 1_000_000_000
"""More steps than any front is followed."""


class Front(NamedTuple):
    """A front while it keeps its direction."""

    sense: float
    """+1 counter-clockwise, −1 clockwise."""
    course: float
    """Of e [rad]."""
    ahead_x: float
    """e."""
    ahead_y: float
    """e."""
    from_course: float
    """How far P is from there at first, counted against the way it goes [rad]."""
    past: float
    """How far along e the line then lies [R]."""
    speed: float
    """How fast the line moves along e [V_P]."""


class Place(NamedTuple):
    """Where a front is, and how far it has come."""

    t: float
    """When [R/V_P]."""
    bearing: float
    """Of P then [rad]."""
    course: float
    """Of e until then [rad]."""
    swept: float
    """How far round P has moved since it began [rad] …"""
    most: float
    """… and how far at most, at any time until then."""


class Headings(NamedTuple):
    """How something heads that goes from one contact to another, turning at most at full bank."""

    first: float
    """Where it begins [rad]."""
    first_differs: float
    """Or this much from there [rad]; infinite for something that needs no time to turn."""
    since: float
    """It does not begin before [R/V_P]."""
    last: float
    """Where it ends [rad]."""
    last_differs: float
    """Or this much from there [rad]; infinite likewise."""
    until: float
    """It does not end after [R/V_P]."""


FREE = Headings(0.0, inf, 0.0, 0.0, inf, inf)
"""It heads wherever it likes."""


@njit(cache=True, nogil=True)
def bearings_of(scene: Scene, cell: Cell) -> tuple[float, float]:
    """The bearings of a cell's contacts from the leader, least and greatest [rad].

    Relative to the slot's heading.
    """
    first = _heading_at(scene, cell.piece, cell.start)
    last = first if cell.end == inf else _heading_at(scene, cell.piece, cell.end)
    low, high = cell.bearing - cell.half, cell.bearing + cell.half
    return low + min(first, last), high + max(first, last)


@njit(cache=True, nogil=True)
def _heading_at(scene: Scene, i: int, t: float) -> float:
    """The leader's heading at time t on its piece i [rad]."""
    return float(scene.leader[i, 3] + scene.leader[i, 4] * (t - scene.leader[i, 0]))


@njit(cache=True, nogil=True)
def leader_then(scene: Scene, t: float) -> Pose:
    """The leader's pose at time t."""
    return leader_at(scene, piece_at(scene.leader, t), t)


@njit(cache=True, nogil=True)
def begins(t: float, edge: float) -> Place:
    """A front where it begins, at a bearing, with e outward."""
    return Place(t, edge, edge, 0.0, 0.0)


@njit(cache=True, nogil=True)
def follow(
    scene: Scene, place: Place, sense: float, step: float, steps: int, angle: float, latest: float,
    headings: Headings, free: bool,
) -> tuple[Place, int]:  # fmt: skip
    """Follow a front until it has swept an angle.

    Args:
        scene: the leader and d_min.
        place: where it is.
        sense: as in `Front`.
        step: how long it keeps its direction [R/V_P].
        steps: of these it is followed so many at most.
        angle: since it began [rad].
        latest: when to end [R/V_P].
        headings: how something heads that goes with it.
        free: whether that needs no time to turn. On the final leg it is followed until e may be
            turned to where someone sliding heads: what comes then `round_time` says.

    Returns:
        where it is then, and why it is not followed further.
    """
    t, bearing, course, swept, most = place
    there, final = leader_then(scene, t), len(scene.leader) - 1
    for _ in range(steps):
        if t >= latest:
            return Place(t, bearing, course, swept, most), LATE
        took = step
        if free:
            piece = piece_at(scene.leader, t)
            ahead = sense * (course - bearing)
            if piece == final and ahead <= acos(scene.alpha * cos(bearing - there.h)):
                return Place(t, bearing, course, swept, most), SLIDES
            took = min(step, piece_end(scene.leader, piece) - t + EDGE)
        front = front_from(scene, t, there, bearing, course, sense, 1.0, took)
        if not free:
            front = _slowed(front, t, took, headings)
        there = leader_then(scene, t + took)
        reached = reached_by(scene, front, there, took)
        by = swept_by(front, reached)
        if swept + by >= angle:
            t += time_to(scene, front, t, 1.0, min(angle - swept, TWO_PI), took, reached)
            return Place(t, bearing, course, swept, most), ARRIVED
        if front.speed < 1.0:
            meanwhile = swept + _swept_meanwhile(scene, front, t, took, reached)
            if meanwhile >= angle:
                return Place(t, bearing, course, swept, most), ARRIVED
            most = max(most, meanwhile)
        bearing, course = bearing + sense * by, front.course
        swept += by
        most = max(most, swept)
        t += took
    return Place(t, bearing, course, swept, most), GOING


@njit(cache=True, nogil=True)
def inside_share(scene: Scene) -> float:
    """What is left of the time round the disc on the final leg, since fronts go round inside it."""
    return 1.0 - INSIDE / scene.d_min


@njit(cache=True, nogil=True)
def whole_rounds(scene: Scene, cell: Cell, other: Cell, way: int) -> float:
    """How many whole rounds lie between a cell and one on the final leg, as bearings are counted.

    The bearing of the other one lies in [−π, π], and this one's wherever `bearings_of` has it. A
    path round from here to there may pass ±π.

    Args:
        scene: the leader and d_min.
        cell: from which a path goes.
        other: to which it goes.
        way: 0 counter-clockwise round the leader, 1 clockwise.

    Returns:
        `UNKNOWN` if they overlap.
    """
    sense = 1.0 - 2.0 * way
    low, high = bearings_of(scene, cell)
    begin, blur = 0.5 * (low + high) - scene.leader[-1, 3], 0.5 * (high - low) + other.half
    angle = wrap(sense * (other.bearing - begin))
    if angle <= blur or angle + blur >= TWO_PI:
        return UNKNOWN
    return float(sense * floor((begin + sense * angle - other.bearing) / TWO_PI + 0.5))


@njit(cache=True, nogil=True)
def _slowed(front: Front, t: float, step: float, headings: Headings) -> Front:
    """The front, no faster along e than a path can be in the step that heads as it must."""
    turned = abs(wrap_signed(front.course - headings.first)) - headings.first_differs
    turns = abs(wrap_signed(front.course - headings.last)) - headings.last_differs
    apart = max(turned - (t + step - headings.since), turns - (headings.until - t))
    if apart <= 0.0:
        return front
    return Front(
        front.sense, front.course, front.ahead_x, front.ahead_y, front.from_course, front.past,
        cos(min(apart, pi)),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _swept_meanwhile(scene: Scene, front: Front, t: float, step: float, reached: float) -> float:
    """How far round P may have moved at some time of the step, to come back again [rad]."""
    rate = fastest_turn(scene, piece_at(scene.leader, t), piece_at(scene.leader, t + step))
    bends = 0.125 * scene.alpha * rate * step * step / (scene.d_min - INSIDE)
    return swept_by(front, max(cos(front.from_course), reached) + bends)


@njit(cache=True, nogil=True)
def step_of(scene: Scene) -> float:
    """For how long a front keeps its direction [R/V_P]."""
    return _STEP * scene.d_min


@njit(cache=True, nogil=True)
def front_from(
    scene: Scene, t: float, there: Pose, bearing: float, course: float, sense: float, pace: float,
    step: float,
) -> Front:  # fmt: skip
    """A front for the next step.

    Args:
        scene: the leader and d_min.
        t: when the step begins [R/V_P].
        there: the leader's pose then.
        bearing: of P then [rad].
        course: of e until then; the bearing, if it only begins [rad].
        sense: as in `Front`.
        pace: +1 on in time, −1 back, where the leader flies backward.
        step: how long it is [R/V_P].
    """
    alpha, later = pace * scene.alpha, 0.5 * step
    # where a path heads that slides along the edge, in the middle of the step
    s, c = sine_and_cosine(bearing - there.h)
    along = alpha * c
    rate = (sqrt(1.0 - along * along) + sense * alpha * s) / scene.d_min
    on, soon = bearing + sense * rate * later, t + pace * later
    heading = _heading_at(scene, piece_at(scene.leader, soon), soon)
    wanted = sense * (on - bearing) + acos(alpha * cos(on - heading))
    from_course = max(sense * (course - bearing), min(wanted, _WIDEST))
    course = bearing + sense * from_course
    y, x = sine_and_cosine(course)
    past = there.x * x + there.y * y + (scene.d_min - INSIDE) * cos(from_course)
    return Front(sense, course, x, y, from_course, past, 1.0)


@njit(cache=True, nogil=True)
def reached_by(scene: Scene, front: Front, there: Pose, took: float) -> float:
    """How far the line lies from the leader along e after a time, as part of d_min.

    At V_P it grows with the time, by 1 − α to 1 + α of V_P.
    """
    ahead = front.past + front.speed * took - there.x * front.ahead_x - there.y * front.ahead_y
    return float(ahead / (scene.d_min - INSIDE))


@njit(cache=True, nogil=True)
def swept_by(front: Front, reached: float) -> float:
    """How far P has moved round the leader by then; infinite if the front has left the disc."""
    if reached >= 1.0:
        return inf
    return float(front.from_course - acos(max(reached, -1.0)))


@njit(cache=True, nogil=True)
def time_to(
    scene: Scene, front: Front, t: float, pace: float, angle: float, step: float, reached: float
) -> float:
    """How long P has not moved so far round, at least: less than a step.

    Args:
        scene: the leader and d_min.
        front: as it is for the step.
        t: when the step begins [R/V_P].
        pace: as in `front_from`.
        angle: how far round [rad].
        step: how long it is [R/V_P].
        reached: of `reached_by` at its end, by which P has moved so far.
    """
    left = front.from_course - angle
    if left >= pi:
        return 0.0
    wanted = cos(max(left, 0.0))
    if front.speed < 1.0:
        return _time_at_least(scene, front, t, wanted, step)
    # by false position; whatever is missed, it takes no longer than this
    slowest = (scene.d_min - INSIDE) / (1.0 - scene.alpha)
    low, at_low = 0.0, cos(front.from_course) - wanted
    high, at_high = step, reached - wanted
    for _ in range(_TRIES):
        if at_low >= 0.0 or at_high <= at_low:
            break
        middle = low - at_low * (high - low) / (at_high - at_low)
        there = leader_then(scene, t + pace * middle)
        at = reached_by(scene, front, there, middle) - wanted
        if at < 0.0:
            low, at_low = middle, at
        else:
            high, at_high = middle, at
        if abs(at) * slowest < 0.1 * ROUNDING:
            break
    return max(low, high - at_high * slowest)


@njit(cache=True, nogil=True)
def _time_at_least(scene: Scene, front: Front, t: float, wanted: float, step: float) -> float:
    """As `time_to`, for a front that is not so fast: by steps too short to miss it.

    Args:
        scene: as in `time_to`.
        front: likewise.
        t: likewise.
        wanted: what `reached_by` has to come to.
        step: as in `time_to`.
    """
    fastest, took = front.speed + scene.alpha, 0.0
    for _ in range(_TRIES):
        left = wanted - reached_by(scene, front, leader_then(scene, t + took), took)
        if left <= 0.0:
            break
        if fastest <= 0.0:
            return step
        took += left * (scene.d_min - INSIDE) / fastest
        if took >= step:
            return step
    return took
