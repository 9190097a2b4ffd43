"""Whether paths may touch along a piece, and still be at the goal in time.

The paths are those of a tube. Where they may touch (see `tubes`) that contact is put into a cell:
it may be the last one, or others come after it. A turn away from the leader goes on then for a
while (see `junction`), and that may be too long. Where it is not it is asked later whether paths
touch again: see `next_contact`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, floor, inf, pi
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.cell_words import onward_bound, turned_after_bound
from relguide.kernels.bounds.cells import EDGE, Cell, poses_of
from relguide.kernels.bounds.contact_bound import Passed, leaving_bound
from relguide.kernels.bounds.junction import beyond_outward, slide_turns
from relguide.kernels.bounds.rest import no_rest
from relguide.kernels.bounds.tubes import Course, Tube, Zone, flown, poses_in, touching
from relguide.kernels.separation.clearance import leader_at, piece_at, piece_end
from relguide.kernels.words.extremals import fly_piece

QUEUE, ROW = 24, 12
"""So many contacts are looked at after others at most; and columns that each takes."""
UNKNOWN, CROSSED, TOUCHED, STRAIGHT = -1, 0, 1, 2
"""How λ_ψ is known along a piece: not at all; it has vanished on a line that was crossed; or, it
may be, only touched; or all along the straight before it."""
_MOST = 400  # pieces that are followed in all
_NEARLY = 0.03  # how closely it is looked how long a piece may last [R/V_P]
_ZONES = 20  # along a piece in which paths may touch; no more of them
_PARTS, _MOST_PARTS = 8, 24  # into which such a zone is cut; and if it is long, no more than these
_WIDE = 0.3  # contacts are not put into cells that are larger [rad, R/V_P]


class Piece(NamedTuple):
    """A turn or a straight that paths fly, nearly."""

    sign: float
    """ε."""
    lasts: float
    """How long it lasts at most [R/V_P]."""
    goes_on: float
    """And how long at least, if nobody touches along it [R/V_P]."""
    known: int
    """How λ_ψ is known along it."""
    least: float
    """How long a turn between two lines is on which λ_ψ vanishes, at least …"""
    most: float
    """… and at most [rad]."""


@njit(cache=True, nogil=True)
def along(
    course: Course, tube: Tube, piece: Piece, begin: float, fine: bool, queue: FloatArray
) -> tuple[bool, float]:
    """Whether paths may touch along a piece and be in time, and how long any go on.

    Args:
        course: what is asked.
        tube: the paths.
        piece: along which they fly.
        begin: no contact is looked for before this [R/V_P].
        fine: whether contacts may be put into the queue; if not, paths may be in time where they
            would be.
        queue: takes contacts of which it is not known yet whether paths in time touch again after
            them. In the first row how many there are, and how many pieces have been followed; then
            a row of each: how it is come to, and its cell. shape (QUEUE + 1, ROW)
    """
    queue[0, 1] += 1.0
    sign, lasts = piece.sign, piece.lasts
    if queue[0, 1] > _MOST:
        return True, lasts
    for _ in range(_ZONES):
        zone = touching(course, tube, sign, begin, lasts)
        if zone.begin < inf and _is_in_time(course, flown(tube, sign, zone.begin)):
            if _may_touch(course, tube, piece, zone, fine, queue):
                return True, zone.end
        elif zone.begin < inf:
            return False, zone.begin
        if not zone.lives or zone.end >= lasts:
            # where a turn may end is looked at with the next piece
            endless = lasts == TWO_PI and (piece.known == UNKNOWN or piece.goes_on == TWO_PI)
            if zone.lives and endless and _is_in_time(course, flown(tube, sign, lasts)):
                return True, lasts
            return False, zone.end
        begin = zone.end
    return True, lasts


@njit(cache=True, nogil=True)
def in_time_until(course: Course, tube: Tube, sign: float, until: float) -> float:
    """How long a piece may last at most if the goal is to be reached in time from its end.

    Who goes on longer can only be later.
    """
    if until <= 0.0 or _is_in_time(course, flown(tube, sign, until)):
        return until
    low, high = 0.0, until
    while high - low > _NEARLY:
        middle = 0.5 * (low + high)
        if _is_in_time(course, flown(tube, sign, middle)):
            low = middle
        else:
            high = middle
    return high


@njit(cache=True, nogil=True)
def _is_in_time(course: Course, tube: Tube) -> bool:
    """Whether the goal can be reached in time from where a piece begins."""
    there, times = poses_in(tube, course.goal)
    cell = course.cell
    then = Cell(cell.piece, cell.side, cell.bearing, cell.half, tube.t - times, tube.t + times)
    left = course.beat - then.start
    return bool(onward_bound(course.scene, course.goal, then, there, left, no_rest()) < left)


@njit(cache=True, nogil=True)
def _may_touch(
    course: Course, tube: Tube, piece: Piece, zone: Zone, fine: bool, queue: FloatArray
) -> bool:
    """Whether paths may touch in a zone of a piece and be in time: as `along`."""
    length = zone.end - zone.begin
    needed = int(length / (_WIDE * min(course.scene.d_min, 1.0))) + 1
    if zone.far == inf or needed > _MOST_PARTS:
        return True
    parts = min(int(length / (2.0 * zone.far)), _PARTS) if fine else 1
    parts = max(parts, needed)
    for k in range(parts):
        begin, end = zone.begin + k * length / parts, zone.begin + (k + 1) * length / parts
        part = Zone(begin, end, zone.lives, zone.far)
        if _may_touch_part(course, tube, piece, part, fine, queue):
            return True
    return False


@njit(cache=True, nogil=True)
def _may_touch_part(
    course: Course, tube: Tube, piece: Piece, zone: Zone, fine: bool, queue: FloatArray
) -> bool:
    """The same in a part of it."""
    scene, length = course.scene, zone.end - zone.begin
    _, times = poses_in(tube, course.goal)
    low, high = tube.t + zone.begin - times - EDGE, tube.t + zone.end + times + EDGE
    bearing, other, side = 0.0, 0.0, 0.0
    for k in range(2):
        w = zone.begin + k * length
        at, t = fly_piece(tube.at, piece.sign, w), tube.t + w
        there = leader_at(scene, piece_at(scene.leader, t), t)
        dx, dy = at.x - there.x, at.y - there.y
        s, c = sine_and_cosine(at.h)
        here = 1.0 if c * dy < s * dx else -1.0
        if k == 1 and here != side:
            return True
        side = here
        seen = atan2(dy, dx) - there.h
        if k == 0:
            bearing = seen
        other = bearing + wrap_signed(seen - bearing)
    off = 1.1 * zone.far / scene.d_min + course.rate * times + EDGE
    # how far from straight the bearing changes in between
    off += 0.5 * length * length * (1.0 + course.rate) * (1.0 + 4.0 / scene.d_min) / scene.d_min
    if piece_at(scene.leader, max(low, 0.0)) != piece_at(scene.leader, high):
        off += course.rate * length
    first, last = min(bearing, other) - off, max(bearing, other) + off
    if last - first > 2.0 * _WIDE:
        return True
    for i in range(piece_at(scene.leader, max(low, 0.0)), piece_at(scene.leader, high) + 1):
        start, end = max(low, float(scene.leader[i, 0])), min(high, piece_end(scene.leader, i))
        quadrant = float(floor(first / (0.5 * pi)))
        while quadrant * 0.5 * pi < last:
            lowest, on = max(first, quadrant * 0.5 * pi), min(last, (quadrant + 1.0) * 0.5 * pi)
            cell = Cell(i, side, wrap_signed(0.5 * (lowest + on)), 0.5 * (on - lowest), start, end)
            if _may_touch_in(course, cell, piece, zone, fine, queue):
                return True
            quadrant += 1.0
    return False


@njit(cache=True, nogil=True)
def _may_touch_in(
    course: Course, cell: Cell, piece: Piece, zone: Zone, fine: bool, queue: FloatArray
) -> bool:
    """The same in a cell of contacts."""
    scene, goal, left = course.scene, course.goal, course.beat - cell.start
    _, turns = slide_turns(scene, cell)
    tangent = piece.sign == 0.0 or (piece.known == TOUCHED and zone.begin <= 0.0)
    inward = piece.sign * cell.side > 0.0
    if turns < -1.0 - EDGE or (inward and not tangent and turns < 1.0 - EDGE):
        return False
    onward = onward_bound(scene, goal, cell, poses_of(scene, cell), left, no_rest())
    if onward >= left:
        return False
    goes_on_late = False
    if not inward and not tangent:
        turn = min(max(piece.goes_on - zone.end, 0.0), beyond_outward(scene, cell, 1.0))
        goes_on_late = turn > 0.0 and turned_after_bound(scene, goal, cell, turn, left) >= left
    n = int(queue[0, 0]) + 1
    if not goes_on_late and (tangent or piece.known == UNKNOWN or not fine or n > QUEUE):
        return True
    # it may be the last one
    if _last(leaving_bound(scene, goal, cell, left, True, no_rest()), inward, tangent) < left:
        return True
    if goes_on_late:
        return False
    queue[0, 0] = float(n)
    row = queue[n]
    row[0], row[1] = 1.0 if inward else 0.0, 0.0 if piece.known == STRAIGHT else 1.0
    row[2], row[3], row[4], row[5] = zone.begin, zone.end, piece.least, piece.most
    row[6], row[7], row[8] = cell.piece, cell.side, cell.bearing
    row[9], row[10], row[11] = cell.half, cell.start, cell.end
    return False


@njit(cache=True, nogil=True)
def _last(passed: Passed, inward: bool, tangent: bool) -> float:
    """How soon at the goal from a last contact that is passed like this [R/V_P]."""
    if tangent:
        return min(passed.looped, passed.tangent, passed.inward, passed.outward)
    return min(passed.looped, passed.inward if inward else passed.outward)
