"""Whether a path may touch again after a first contact that it passes in a turn.

How it goes on is known but for one number (see `pencil`): it turns on, for how long is free, then
the other way, and then back; or it turns on for a known time and flies straight, for how long is
free, and turns either way. So contacts that come next are single points, where pairs of contacts
have two dimensions more; most first contacts have none. All those paths are followed (see `tubes`),
in parts of the free number that are halved where some may touch and be at the goal in time. Of a
contact that may come next it is asked the same, as it is known how paths come to it; and whether it
may be the last one.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.along_piece import (
    CROSSED,
    QUEUE,
    ROW,
    STRAIGHT,
    TOUCHED,
    UNKNOWN,
    Piece,
    along,
    in_time_until,
)
from relguide.kernels.bounds.breach import INSIDE, Sieve
from relguide.kernels.bounds.cell_words import blur_backward, seen_from_start
from relguide.kernels.bounds.cells import EDGE, Cell, poses_of
from relguide.kernels.bounds.found_word import MOST_WORDS
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.junction import apart_by, away_for, junction_of
from relguide.kernels.bounds.pencil import Arrived, Pencil, off_line, pencil_of, straight_after
from relguide.kernels.bounds.rest import Rest
from relguide.kernels.bounds.tubes import (
    Course,
    Tube,
    course_of,
    flown,
    tube_from,
    with_bearing,
    with_piece,
    with_turn,
)
from relguide.kernels.bounds.word_bound import words_by_turn

_COARSE = 0.2  # greatest part of the free number that is looked at [R/V_P]
_FINE, _FINEST = 0.5, 1e-5  # and the least, as part of the cell's half width, and at all,
_PART_OF = 0.3  # and as part of how nearly the turn before a straight is known;
_SURE = 1.3  # nor are parts halved in which the line is known this nearly as well as at a point
_DEPTH = 128  # more than halvings of such a part
_WIDE = 0.3  # turns that end in a straight must be known as nearly [rad]


@njit(cache=True, nogil=True)
def touches_again(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, apart: float, rest: Rest
) -> tuple[bool, int]:
    """Whether a path in time may touch again after a first contact in a cell.

    And how many pieces of paths were followed to find that out.

    Args:
        start: where it begins, at t = 0.
        scene: the leader and d_min.
        goal: where it is to arrive.
        cell: of contacts that are passed in a turn; its window of time has an end.
        beat: arrivals from here on do not matter [R/V_P].
        apart: of `junction.apart_by` [R/V_P].
        rest: what is left of the words that lead to the contact.
    """
    poses = poses_of(scene, cell)
    if poses.ways.bends == inf:
        return True, 0
    at, target = seen_from_start(start, poses)
    sieve = Sieve(True, start, 0.0, with_limit(scene, scene.d_min - INSIDE), 1.0, 0.0, 0.0)
    junction = junction_of(scene, cell, 1.0, False)
    words = words_by_turn(
        at, blur_backward(start, poses), target, Window(cell.start - EDGE, cell.end + EDGE), sieve,
        junction, rest,
    )  # fmt: skip
    count = int(words[0, 0])
    if count > MOST_WORDS:
        return True, 0
    for k in range(1, count + 1):
        words[k, 0] = 0.0 if words[k, 0] == junction.outward else 1.0
    queue = np.empty((QUEUE + 1, ROW))
    together = _joined(words)
    may = _any_goes_on(scene, goal, cell, beat, apart, together, queue)
    pieces = int(queue[0, 1])
    if may and together[0, 0] < words[0, 0]:
        may = _any_goes_on(scene, goal, cell, beat, apart, words, queue)
        pieces += int(queue[0, 1])
    return may, pieces


@njit(cache=True, nogil=True)
def touches_again_after_spare(
    scene: Scene, goal: Goal, cell: Cell, beat: float, contact: float
) -> tuple[bool, int]:
    """The same of a contact that is come to with time to spare.

    The path from there is known (see `after_spare`): it turns away, and then either way, for as
    long each time.

    Args:
        scene: as in `touches_again`.
        goal: likewise.
        cell: likewise.
        beat: likewise.
        contact: of `after_spare.Onward` [R/V_P].
    """
    poses = poses_of(scene, cell)
    if poses.ways.bends == inf:
        return True, 0
    queue = np.empty((QUEUE + 1, ROW))
    queue[0, 0], queue[0, 1] = 0.0, 0.0
    course = course_of(scene, goal, cell, beat)
    low, middle, high = _eta(scene, cell, -1.0), _eta(scene, cell, 0.0), _eta(scene, cell, 1.0)
    turn, half, off = TWO_PI - 2.0 * middle, low - high, abs(low + high - 2.0 * middle) + EDGE
    if turn < abs(half) + off:
        return True, 0
    tube, sign, since, by = tube_from(poses), -cell.side, contact, abs(half) + off
    # no more than three pieces lead to a contact
    for k in range(3):
        piece = Piece(sign, turn + by, turn - by, CROSSED, turn - by, turn + by)
        may, until = along(course, tube, piece, since, True, queue)
        if may:
            return True, int(queue[0, 1])
        if until <= turn - by:
            break
        tube = with_bearing(flown(tube, sign, turn), sign, half)
        if k == 0:
            tube = with_turn(tube, sign, off)
        else:
            tube = with_piece(tube, sign, off)
        since, sign = max(since - turn - by, 0.0), -sign
    may = _queued_go_on(scene, goal, beat, queue)
    return may, int(queue[0, 1])


@njit(cache=True, nogil=True)
def _eta(scene: Scene, cell: Cell, way: float) -> float:
    """How far the leader is to one side of the heading at a contact of a cell [rad]."""
    return acos(min(max(-scene.alpha * cos(cell.bearing + way * cell.half), -1.0), 1.0))


@njit(cache=True, nogil=True)
def _any_goes_on(
    scene: Scene, goal: Goal, cell: Cell, beat: float, apart: float, words: FloatArray,
    queue: FloatArray,
) -> bool:  # fmt: skip
    """The same of paths that come to the contact by some words."""
    queue[0, 0], queue[0, 1] = 0.0, 0.0
    course = course_of(scene, goal, cell, beat)
    for k in range(int(words[0, 0])):
        if _goes_on(course, _arrived(words[k + 1]), apart, queue):
            return True
    return _queued_go_on(scene, goal, beat, queue)


@njit(cache=True, nogil=True)
def _queued_go_on(scene: Scene, goal: Goal, beat: float, queue: FloatArray) -> bool:
    """The same of contacts that come next, or next to those."""
    done = 0
    while done < int(queue[0, 0]):
        done += 1
        row = queue[done]
        other = Cell(int(row[6]), row[7], row[8], row[9], row[10], row[11])
        course = course_of(scene, goal, other, beat)
        if _goes_on(course, _arrived(row), apart_by(scene, other, 1.0), queue):
            return True
    return False


@njit(cache=True, nogil=True)
def _arrived(row: FloatArray) -> Arrived:
    """How a contact is come to, by its row in the queue; words have the same columns."""
    return Arrived(row[0] != 0.0, row[1] != 0.0, max(row[2], 0.0), row[3], row[4], row[5])


@njit(cache=True, nogil=True)
def _joined(words: FloatArray) -> FloatArray:
    """Words that lie side by side in one row."""
    together, count = words.copy(), 0
    for k in range(1, int(words[0, 0]) + 1):
        row, is_new = words[k], True
        for j in range(1, count + 1):
            near = together[j]
            slack = 0.5 * (row[3] - row[2] + near[3] - near[2])
            if (
                near[0] == row[0]
                and near[1] == row[1]
                and max(near[2], row[2]) <= min(near[3], row[3]) + slack
            ):
                near[2], near[3] = min(row[2], near[2]), max(row[3], near[3])
                near[4], near[5] = min(row[4], near[4]), max(row[5], near[5])
                is_new = False
                break
        if is_new:
            count += 1
            together[count] = row
    together[0, 0] = count
    return together


@njit(cache=True, nogil=True)
def _goes_on(course: Course, arrived: Arrived, apart: float, queue: FloatArray) -> bool:
    """Whether paths that come to a contact like this may touch again, and be in time."""
    cell = course.cell
    poses = poses_of(course.scene, cell)
    if poses.ways.bends == inf:
        return True
    inward, sense = arrived.inward, cell.side if arrived.inward else -cell.side
    one, other = _eta(course.scene, cell, -1.0), _eta(course.scene, cell, 1.0)
    eta, eta_off = 0.5 * (one + other), 0.5 * abs(one - other)
    pencil = pencil_of(arrived, eta, eta_off)
    # the turn would have gone on for so long without the contact, and does if nothing else counts
    low, high = TWO_PI - arrived.high, TWO_PI - arrived.low
    if arrived.three:
        low, high = arrived.least - arrived.high, arrived.most - arrived.low
    first, last, begin = 0.0, high, apart
    if not inward:
        away = TWO_PI - 2.0 * eta
        first = max(min(low, away - 2.0 * eta_off), 0.0)
        last = max(high, away + 2.0 * eta_off)
        begin = max(apart, away_for(course.scene, cell, 1.0, TWO_PI))
    turning = tube_from(poses)
    on = Piece(sense, TWO_PI, first, UNKNOWN, pi, pi)
    may, until = along(course, turning, on, begin, True, queue)
    if may:
        return True
    finest = max(_FINE * cell.half, _FINEST)
    until, straight = in_time_until(course, turning, sense, until), 0.0
    for root in range(2):
        low, high = straight_after(arrived, pencil, root)
        if low == inf:
            continue
        straight = max(straight, high)
        if low <= until and _straight_on(course, turning, sense, apart, low, high, finest, queue):
            return True
    if inward and not arrived.three and 0.0 < straight and arrived.high + eta + eta_off < pi:
        # by then it ends, however great the change of λ_p
        last = straight
    else:
        last = max(last, straight)
    return _turns_back(
        course, turning, pencil, sense, apart, first, min(last, until), finest, queue
    )


@njit(cache=True, nogil=True)
def _straight_on(
    course: Course, turning: Tube, sense: float, apart: float, low: float, high: float,
    finest: float, queue: FloatArray,
) -> bool:  # fmt: skip
    """The same where a straight follows the turn, which is known nearly."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    if half > _WIDE:
        return True
    straight = with_turn(flown(turning, sense, middle), sense, half)
    latest, finest = high, max(finest, _PART_OF * half)
    since, longest = max(apart - high, 0.0), course.beat - course.cell.start - low
    ahead = Piece(0.0, longest, 0.0, STRAIGHT, pi, pi)
    may, until = along(course, straight, ahead, since, True, queue)
    if may:
        return True
    until = in_time_until(course, straight, 0.0, until)
    stack, n = np.empty((_DEPTH, 2)), 1
    stack[0, 0], stack[0, 1] = 0.0, until
    while n > 0:
        n -= 1
        low, high = stack[n, 0], stack[n, 1]
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        may = half > _COARSE
        if not may:
            tube = with_piece(flown(straight, 0.0, middle), 0.0, half)
            for k in range(2):
                sign = sense if k == 0 else -sense
                off = Piece(sign, TWO_PI, TWO_PI, STRAIGHT, TWO_PI, TWO_PI)
                since = max(apart - latest - high, 0.0)
                may, _ = along(course, tube, off, since, half < finest, queue)
                if may:
                    break
        if not may:
            continue
        if half < finest or n + 2 > _DEPTH:
            return True
        stack[n, 0], stack[n, 1] = low, middle
        stack[n + 1, 0], stack[n + 1, 1] = middle, high
        n += 2
    return False


@njit(cache=True, nogil=True)
def _turns_back(
    course: Course, turning: Tube, pencil: Pencil, sense: float, apart: float, first: float,
    last: float, finest: float, queue: FloatArray,
) -> bool:  # fmt: skip
    """The same where the other turn follows, and then the first one again."""
    stack, n = np.empty((_DEPTH, 2)), 0
    if first <= last:
        stack[0, 0], stack[0, 1] = first, last
        n = 1
    while n > 0:
        n -= 1
        low, high = stack[n, 0], stack[n, 1]
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        may, fine = half > _COARSE, False
        if not may:
            least, most = off_line(pencil, middle, half)
            if most < 0.0:
                # nobody crosses the line so
                continue
            known = CROSSED if least > 0.0 else TOUCHED
            short, long = TWO_PI - 2.0 * min(most, pi), TWO_PI - 2.0 * max(least, 0.0)
            tube = with_turn(flown(turning, sense, middle), sense, half)
            since, sign = max(apart - high, 0.0), -sense
            # smaller parts are no better where the line itself is not known
            sure = off_line(pencil, middle, 0.0)
            fine = half < finest or most - least < _SURE * (sure[1] - sure[0])
            turn, by = 0.5 * (short + long), 0.5 * (long - short)
            # no more than three pieces lead to a contact
            for k in range(2):
                back = Piece(sign, long, short, known, short, long)
                may, until = along(course, tube, back, since, fine, queue)
                if may or k == 1 or until <= short:
                    break
                # both turns are equally long
                tube = with_piece(flown(tube, sign, turn), sign, by)
                since, sign = max(since - long, 0.0), -sign
        if not may:
            continue
        if fine or n + 2 > _DEPTH:
            return True
        stack[n, 0], stack[n, 1] = low, middle
        stack[n + 1, 0], stack[n + 1, 1] = middle, high
        n += 2
    return False
