"""Constrained paths of a given template behind a leader who turns, solved next to a guess.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, cos, inf, isnan, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, start_at, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import boundary_arc_arrival
from relguide.kernels.contact.chain import BOUNDARY_ARC, DELAY, WORD
from relguide.kernels.contact.clear_words import EARLY, best_word, word_clears
from relguide.kernels.contact.contact import GRAZE, disc_on, to_frame_of
from relguide.kernels.contact.delay_after_contact import delay_until_release
from relguide.kernels.contact.touch_points import mirror_disc, straight_tangents
from relguide.kernels.networks.near_guess import (
    LR,
    LS,
    ON_B,
    ON_DELAY,
    ON_LR,
    ON_RL,
    RL,
    Room,
    Task,
    contact_of,
    descend,
    empty_room,
    enter,
    leave,
    time_through,
)
from relguide.kernels.networks.template_edges import time_at_edge
from relguide.kernels.networks.template_legs import (
    clears,
    straight_turn,
    turn_straight,
    two_turns,
    write_legs,
)
from relguide.kernels.networks.turn_templates import (
    DELAYED,
    FREE,
    NONE,
    PARTS,
    QUARTER,
    SEVERAL,
    turn_template_of,
)
from relguide.kernels.networks.turning_leader import turning_scene
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece
from relguide.kernels.words.to_point import word_from

_STRIDES = (0.01, 0.02, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.7, 0.9, 1.2)
_BESIDE = np.array([0.0] + [sign * stride for stride in _STRIDES for sign in (1.0, -1.0)])
"""Where contacts are tried from which a path may arrive as the slot opens [rad]."""
_BESIDE_TOUCH = np.array((0.06, -0.06, 0.15, -0.15, 0.3, -0.3))
"""And guesses of two pieces from a contact to the slot [in their units]."""
_LOOKS, _APART = 12, 0.045  # bearings where it is looked anew, on either side [rad]
_ROUND = 60  # of these, on either side, for paths that arrive as the slot opens
_MOST_TIMES = 8  # at which a branch is at a contact
_LOOK, _LATER = 0.25, 2.0  # times: from one to the next, and so much later than guessed [R/V_P]
_JUMP = 2.5  # what is less is no jump of a turn, which are full circles
_TURNS = 36  # sizes of a first turn: every 10°
_STEPS = 16  # of Newton's method
_DIFFERENCE = 1e-6  # by which its slopes are measured [rad or R]
_MET = 1e-11  # where it ends [R]


@njit(cache=True, nogil=True)
def solve_turn_template(
    start: Pose, scene: Scene, template: int, guess: FloatArray, beat: float, anew: bool,
    legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest path of a template next to a guess, if it keeps the limit.

    Args:
        start: slot frame, its heading in [0, 2π).
        scene: a leader that turns once, α below 1.
        template: number of `turn_templates.TEMPLATES`; neither `SEVERAL` nor `NONE`.
        guess: of its numbers. shape (GUESS,)
        beat: arrivals from here on do not matter [R/V_P].
        anew: whether it is looked farther away where there is none: in ten times the time.
        legs: takes the legs, as `chain.Chain`. shape (≥ 3, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is none.
    """
    eased = with_limit(scene, scene.d_min - GRAZE)
    if template == FREE:
        rows = np.empty((MAX_ROWS, 5))
        time, k = best_word(start, 0.0, eased, beat, rows)
        if k < 0:
            return inf, 0
        legs[0, 0] = WORD
        legs[0, 1:6] = rows[k]
        return time, 1
    if template == DELAYED:
        pieces = np.empty((DELAY_PIECES, 2))
        if scene.t_release >= beat or not delay_until_release(start, 0.0, eased, pieces):
            return inf, 0
        legs[0, 0] = DELAY
        return scene.t_release, 1
    entry, side, on = PARTS[template]
    disc = disc_on(scene, len(scene.leader) - 1, float(side))
    task = Task(start, eased, disc, int(entry), int(on))
    room = empty_room()
    room.about[0] = guess[2] / QUARTER
    if task.entry >= LS:
        time, count = _solve_from_touch(task, guess, beat, room, legs)
        if count == 0 and anew:
            time, count = _solve_from_any_touch(task, guess, beat, room, legs)
        return time, count
    if task.on == ON_LR or task.on == ON_RL:
        time, count = _solve_before_touch(task, guess, beat, legs)
        if count == 0 and anew:
            trial = guess.copy()
            for beside in _BESIDE_TOUCH:
                for k in range(3):
                    trial[:] = guess
                    trial[k] += beside
                    found, n = _solve_before_touch(task, trial, min(beat, time), legs)
                    if n > 0:
                        return found, n
        return time, count
    bearing = atan2(guess[1], guess[0])
    if task.on == ON_DELAY:
        if scene.t_release >= beat:
            return inf, 0
        for beside in _BESIDE:
            room.about[0] = guess[2] / QUARTER
            if _delay_from(task, bearing + beside, room, legs):
                return scene.t_release, 2
        if anew and _delay_anew(task, bearing, room, legs):
            return scene.t_release, 2
        return inf, 0
    time, count = _solve_next_to(task, bearing, beat, room, legs)
    if count == 0 and anew:
        room.about[0] = guess[2] / QUARTER
        bearing = _begin_anew(task, bearing, beat, room)
        if not isnan(bearing):
            time, count = _solve_next_to(task, bearing, beat, room, legs)
    return time, count


@njit(cache=True, nogil=True)
def _solve_next_to(
    task: Task, bearing: float, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """By a word to a contact next to a bearing, and on by a word."""
    about = room.about[0]
    time, least_at = descend(bearing, task, np.zeros(2), room)
    if time < inf:
        if time >= beat:
            return inf, 0
        count = write_legs(task, least_at, room, legs)
        if clears(task, legs[:count]):
            return time, count
    room.about[0] = about
    time = time_at_edge(bearing, task, room, legs)
    return (time, 2) if time < beat else (inf, 0)


@njit(cache=True, nogil=True)
def _begin_anew(task: Task, bearing: float, beat: float, room: Room) -> float:
    """A bearing through which a path leads that keeps the limit: the soonest that is seen.

    At each, all times at which the entry's branch may be there are looked at. NaN if none is seen;
    `room` takes when it is there.
    """
    best, found, when = beat, np.nan, 0.0
    legs, none, times = np.zeros((3, 6)), np.zeros(2), np.empty(_MOST_TIMES)
    latest = room.about[0] + _LATER
    for j in range(2 * _LOOKS + 1):
        there = bearing + _APART * (j - _LOOKS)
        for i in range(_times_of(task, there, latest, times)):
            room.about[0] = times[i]
            time = time_through(there, task, none, room)
            if time < best:
                begun = room.about[0]
                count = write_legs(task, there, room, legs)
                if clears(task, legs[:count]):
                    best, found, when = time, there, begun
    room.about[0] = when
    return found


@njit(cache=True, nogil=True)
def _delay_anew(task: Task, bearing: float, room: Room, legs: FloatArray) -> bool:
    """As `_delay_from`, from contacts at all bearings and times: those near this one first."""
    times = np.empty(_MOST_TIMES)
    for j in range(2 * _ROUND):
        there = bearing + pi / _ROUND * ((j + 1) // 2) * (1.0 - 2.0 * (j % 2))
        for i in range(_times_of(task, there, task.scene.t_release, times)):
            room.about[0] = times[i]
            if _delay_from(task, there, room, legs):
                return True
    return False


@njit(cache=True, nogil=True)
def _times_of(task: Task, bearing: float, latest: float, times: FloatArray) -> int:
    """About when an entry's branch may be at a contact, up to a time; how many there are."""
    n, last, piece = 0, np.nan, np.empty(3)
    for k in range(int(latest / _LOOK) + 1):
        t = _LOOK * k
        seen = to_frame_of(task.start, contact_of(task, bearing, t))
        length = word_from(start_at(seen), 0.0, task.entry, piece)
        excess = length - t if length >= 0.0 else np.nan
        # a root, and no jump of a turn
        if last * excess <= 0.0 and abs(last - excess) < _JUMP and n < len(times):
            times[n] = t - _LOOK * abs(excess) / (abs(excess) + abs(last) + 1e-12)
            n += 1
        last = excess
    return n


@njit(cache=True, nogil=True)
def _delay_from(task: Task, bearing: float, room: Room, legs: FloatArray) -> bool:
    """Whether a word to a contact at a bearing leads on to the slot just as it opens.

    All such paths are equally fast: any contact that leads to one will do. `legs` takes it.
    """
    scene = task.scene
    if not enter(task, bearing, room):
        return False
    t, pieces = room.path[0, 0], np.empty((DELAY_PIECES, 2))
    if t >= scene.t_release or not word_clears(task.start, 0.0, room.path[0], scene):
        return False
    there = contact_of(task, bearing, t)
    if not delay_until_release(there, t, scene, pieces):
        return False
    legs[0, 0], legs[1, 0] = WORD, DELAY
    legs[0, 1:6] = room.path[0]
    return True


@njit(cache=True, nogil=True)
def _solve_from_touch(
    task: Task, guess: FloatArray, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """By two pieces that touch the disc next to a guess, and on from there."""
    first = pi * (guess[0] + 1.0)
    bearing, first, second = _touch(task, _first_sign(task), first, guess[2] / QUARTER - first)
    if isnan(first):
        return inf, 0
    return _go_on(task, bearing, first, second, guess[1], beat, room, legs)


@njit(cache=True, nogil=True)
def _solve_from_any_touch(
    task: Task, guess: FloatArray, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """The same, wherever two pieces touch: the fastest.

    For first turns of all sizes the second piece is flown to its closest approach; where that
    passes from one side of the disc's edge to the other, there is a touch.
    """
    sign, other = _first_sign(task), _second_sign(task)
    trial = np.zeros((3, 6))
    best, count, last_miss = beat, 0, np.nan
    longest = TWO_PI if other != 0.0 else guess[2] / QUARTER + _LATER
    for j in range(_TURNS):
        first = TWO_PI * j / _TURNS
        before, miss, second = 0.0, np.nan, 0.0
        for k in range(int(longest / _LOOK)):
            closing, missed, _ = _miss(task, sign, first, other, _LOOK * (k + 1))
            if before < 0.0 <= closing:
                miss, second = missed, _LOOK * (k + 0.5)
                break
            before = closing
        if miss * last_miss <= 0.0:
            bearing, turn, then = _touch(task, sign, first, second)
            if not isnan(turn):
                time, n = _go_on(task, bearing, turn, then, guess[1], best, room, trial)
                if n > 0:
                    best, count = time, n
                    legs[:n] = trial[:n]
        last_miss = miss
    return (best, count) if count > 0 else (inf, 0)


@njit(cache=True, nogil=True)
def _first_sign(task: Task) -> float:
    """Of an entry's first turn."""
    return 1.0 if task.entry == LS or task.entry == LR else -1.0


@njit(cache=True, nogil=True)
def _second_sign(task: Task) -> float:
    """Of its second piece; 0 for a straight."""
    return -_first_sign(task) if task.entry == LR or task.entry == RL else 0.0


@njit(cache=True, nogil=True)
def _go_on(
    task: Task, bearing: float, first: float, second: float, round_it: float, beat: float,
    room: Room, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """From where two pieces touch, by a boundary arc, a delay or a word.

    Args:
        task: its entry says what the pieces are.
        bearing: of the contact [rad].
        first: the first turn [rad].
        second: the second piece [rad or R].
        round_it: how far the boundary arc goes round, about, in π.
        beat: later arrivals do not matter.
        room: to work in.
        legs: takes the legs.
    """
    scene, row, t = task.scene, room.path[0], first + second
    if _second_sign(task) == 0.0:
        turn_straight(_first_sign(task), first, second, row)
    else:
        two_turns(_first_sign(task), first, second, 0.0, row)
    if not word_clears(task.start, 0.0, row, scene):
        return inf, 0
    legs[0, 0] = WORD
    legs[0, 1:6] = row
    if task.on == ON_B:
        time = _slide_to_slot(task, bearing, bearing + pi * round_it, t, legs)
        return (time, 3) if time < beat else (inf, 0)
    there = contact_of(task, bearing, t)
    if task.on == ON_DELAY:
        pieces = np.empty((DELAY_PIECES, 2))
        if not t < scene.t_release < beat or not delay_until_release(there, t, scene, pieces):
            return inf, 0
        legs[1, 0] = DELAY
        return scene.t_release, 2
    if not leave(task, bearing, task.on, room):
        return inf, 0
    legs[1, 0] = WORD
    legs[1, 1:6] = room.path[1]
    time = t + room.path[1, 0]
    if time < beat and word_clears(there, t, room.path[1], scene):
        return time, 2
    return inf, 0


@njit(cache=True, nogil=True)
def _slide_to_slot(task: Task, bearing: float, goal: float, t: float, legs: FloatArray) -> float:
    """From a contact by a boundary arc to where a straight and a turn lead to the slot.

    Args:
        task: where it is solved.
        bearing: of the contact [rad].
        goal: guess of the boundary arc's last bearing, unwrapped [rad].
        t: when it begins [R/V_P].
        legs: takes the second and the third leg.

    Returns:
        arrival time; infinite if there is no such path.
    """
    scene, disc, last = task.scene, task.disc, len(task.scene.leader) - 1
    end, straight, turn = _boundary_arc_end(task)
    if isnan(end):
        return inf
    # once more round, or once less: as far round as it is guessed
    goal = end + TWO_PI * round((goal - end) / TWO_PI)
    left = boundary_arc_arrival(scene, t, bearing, goal, disc.side, last)
    time = left + straight + turn
    if left == inf or time < scene.t_release - EARLY:
        return inf
    legs[1, 0], legs[1, 1], legs[1, 2], legs[1, 3], legs[1, 4] = (
        BOUNDARY_ARC, disc.side, bearing, goal, last,
    )  # fmt: skip
    legs[2, 0] = WORD
    straight_turn(disc.side, straight, turn, legs[2, 1:6])
    there = contact_of(task, goal, left)
    return float(time) if word_clears(there, left, legs[2, 1:6], scene) else inf


@njit(cache=True, nogil=True)
def _boundary_arc_end(task: Task) -> tuple[float, float, float]:
    """As `touch_points.boundary_arc_end`, where the slot may lie aside of the leader's route."""
    final = task.scene.leader[len(task.scene.leader) - 1]
    ahead = final[1] - task.scene.alpha * final[0]
    contacts = np.empty((4, 3))
    n = straight_tangents(
        Pose(ahead, final[2], 0.0), mirror_disc(task.disc), -task.disc.side, contacts
    )
    best, at = inf, -1
    for k in range(n):
        if contacts[k, 1] + contacts[k, 2] < best:
            best, at = contacts[k, 1] + contacts[k, 2], k
    if at < 0:
        return np.nan, np.nan, np.nan
    return contacts[at, 0] + pi, contacts[at, 2], contacts[at, 1]


@njit(cache=True, nogil=True)
def _touch(task: Task, sign: float, first: float, second: float) -> tuple[float, float, float]:
    """A turn and a straight, or a turn the other way, of which the second touches the disc: Newton.

    As `touch_points.turn_tangent`, round a leader that turns; the leader may be on any leg.

    Args:
        task: its entry says what the second piece is.
        sign: of the first turn.
        first: guess of the turn [rad].
        second: and of the second piece [rad or R].

    Returns:
        bearing, first and second piece; these are NaN if there is none next to the guess.
    """
    other = _second_sign(task)
    for _ in range(_STEPS):
        closing, miss, bearing = _miss(task, sign, first, other, second)
        if abs(closing) + abs(miss) < _MET:
            if 0.0 <= first <= TWO_PI and second >= 0.0:
                return bearing, first, second
            break
        a, c, _ = _miss(task, sign, first + _DIFFERENCE, other, second)
        b, d, _ = _miss(task, sign, first, other, second + _DIFFERENCE)
        a, b = (a - closing) / _DIFFERENCE, (b - closing) / _DIFFERENCE
        c, d = (c - miss) / _DIFFERENCE, (d - miss) / _DIFFERENCE
        determinant = a * d - b * c
        if abs(determinant) < 1e-12:
            break
        by_first = (closing * d - miss * b) / determinant
        by_second = (miss * a - closing * c) / determinant
        shorter = min(1.0, 0.5 / max(abs(by_first), abs(by_second), 1e-12))
        first -= shorter * by_first
        second -= shorter * by_second
    return 0.0, np.nan, np.nan


@njit(cache=True, nogil=True)
def _miss(
    task: Task, sign: float, first: float, other: float, second: float
) -> tuple[float, float, float]:
    """How fast the end of two pieces closes in on the leader, how wide it misses, and its bearing.

    p·v,    p × v − s δ |v|,    p, v relative to the leader
    """
    scene, disc, t = task.scene, task.disc, first + second
    pose = fly_piece(fly_piece(task.start, sign, first), other, second)
    at = leader_at(scene, piece_at(scene.leader, t), t)
    x, y = pose.x - at.x, pose.y - at.y
    vx, vy = cos(pose.h) - disc.alpha * cos(at.h), sin(pose.h) - disc.alpha * sin(at.h)
    speed = sqrt(vx * vx + vy * vy)
    miss = x * vy - y * vx - disc.side * disc.distance * speed
    return x * vx + y * vy, miss, atan2(y, x) - at.h


@njit(cache=True, nogil=True)
def _solve_before_touch(
    task: Task, guess: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """By a branch to a contact, and on by two turns of which the first touches there: Newton.

    Unknown are both turns, flown back from the slot, and when the contact is.
    """
    scene, row, last = task.scene, np.zeros(5), np.zeros(5)
    x, off = np.empty(3), np.empty(3)
    x[0], x[1], x[2] = guess[0] / QUARTER, pi * (guess[1] + 1.0), guess[2] / QUARTER
    beside, slopes = np.empty(3), np.empty((3, 3))
    for step in range(_STEPS + 1):
        if step == _STEPS or not _miss_before(task, x, off, row):
            return inf, 0
        if abs(off[0]) + abs(off[1]) + abs(off[2]) < _MET:
            break
        for k in range(3):
            x[k] += _DIFFERENCE
            if not _miss_before(task, x, beside, row):
                return inf, 0
            x[k] -= _DIFFERENCE
            for j in range(3):
                slopes[j, k] = (beside[j] - off[j]) / _DIFFERENCE
        if not _newton_step(slopes, off, x):
            return inf, 0
    first, turn, t = x
    if not (0.0 <= first <= TWO_PI and 0.0 <= turn <= TWO_PI and t > 0.0):
        return inf, 0
    time = t + first + turn
    if time >= beat or time < scene.t_release - EARLY:
        return inf, 0
    _miss_before(task, x, off, row)
    row[0], row[1] = t, WORD_OF[task.entry]
    two_turns(1.0 if task.on == ON_LR else -1.0, first, turn, 0.0, last)
    if not word_clears(task.start, 0.0, row, scene):
        return inf, 0
    if not word_clears(_before_slot(task, first, turn, time), t, last, scene):
        return inf, 0
    legs[0, 0], legs[1, 0] = WORD, WORD
    legs[0, 1:6], legs[1, 1:6] = row, last
    return time, 2


@njit(cache=True, nogil=True)
def _before_slot(task: Task, first: float, turn: float, time: float) -> Pose:
    """Where two pieces begin that end in the slot at that time."""
    sign = 1.0 if task.on == ON_RL else -1.0
    # backward a turn is one to the other side, of the opposite heading
    pose = fly_piece(Pose(task.scene.alpha * time, 0.0, pi), -sign, turn)
    pose = fly_piece(pose, sign, first)
    return Pose(pose.x, pose.y, pose.h - pi)


@njit(cache=True, nogil=True)
def _miss_before(task: Task, x: FloatArray, off: FloatArray, row: FloatArray) -> bool:
    """By how much two pieces before the slot miss their contact, and the entry its time.

    Args:
        task: what is solved.
        x: first piece, last turn, time of the contact. shape (3,)
        off: takes what would be 0. shape (3,)
        row: takes the entry's pieces. shape (5,)

    Returns:
        whether the entry's branch leads there.
    """
    scene, disc, t = task.scene, task.disc, x[2]
    pose = _before_slot(task, x[0], x[1], t + x[0] + x[1])
    at = leader_at(scene, piece_at(scene.leader, t), t)
    dx, dy = pose.x - at.x, pose.y - at.y
    vx, vy = cos(pose.h) - disc.alpha * cos(at.h), sin(pose.h) - disc.alpha * sin(at.h)
    off[0] = dx * vx + dy * vy
    off[1] = dx * vy - dy * vx - disc.side * disc.distance * sqrt(vx * vx + vy * vy)
    length = word_from(start_at(to_frame_of(task.start, pose)), 0.0, task.entry, row[2:5])
    off[2] = length - t
    return bool(length >= 0.0)


@njit(cache=True, nogil=True)
def _newton_step(slopes: FloatArray, off: FloatArray, x: FloatArray) -> bool:
    """One step of Newton's method in three unknowns, not too far; whether there is one."""
    a, b, c = slopes[0], slopes[1], slopes[2]
    cofactors = np.empty((3, 3))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        cofactors[0, k] = b[i] * c[j] - b[j] * c[i]
        cofactors[1, k] = c[i] * a[j] - c[j] * a[i]
        cofactors[2, k] = a[i] * b[j] - a[j] * b[i]
    determinant = a[0] * cofactors[0, 0] + a[1] * cofactors[0, 1] + a[2] * cofactors[0, 2]
    if not abs(determinant) > 1e-12:
        return False
    steps, longest = np.zeros(3), 1e-12
    for k in range(3):
        for j in range(3):
            steps[k] += cofactors[j, k] * off[j] / determinant
        longest = max(longest, abs(steps[k]))
    for k in range(3):
        x[k] -= min(1.0, 0.5 / longest) * steps[k]
    return True


@njit(cache=True, nogil=True)
def label_turn_templates(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray, within: float,
    templates: FloatArray, guesses: FloatArray,
) -> None:  # fmt: skip
    """What is to be learnt of exact answers: the template of each, if its guess leads back to it.

    Args:
        situations: as in `turning_leader`. shape (n, NUMBERS)
        times: of the answers [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.Chain`, as many as there is room for. shape (n, ·, 6)
        within: a template whose path is this much later is not that of the answer [R/V_P].
        templates: takes their numbers. shape (n,)
        guesses: takes their guesses. shape (n, GUESS)
    """
    trial = np.zeros((3, 6))
    for n in range(len(situations)):
        start, scene = turning_scene(situations[n])
        count = int(counts[n])
        template = SEVERAL
        if count <= legs.shape[1]:
            template = turn_template_of(start, scene, legs[n, :count], guesses[n])
        if template != SEVERAL and template != NONE:
            time, _ = solve_turn_template(start, scene, template, guesses[n], inf, True, trial)
            if not time <= times[n] + within:
                template = SEVERAL
        templates[n] = template
