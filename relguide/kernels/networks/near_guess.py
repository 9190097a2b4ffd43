"""Ways round the limit of a given kind, solved next to a guess: what a network is asked for.

The search of `constrained_search` looks at all bearings and all words. Who knows which word leads
to the contact, on which side, and what follows it, has one unknown left, the bearing b of the
contact; and behind a leader that keeps straight nothing depends on time. So with the way to the
contact t₁(b), and t₂(b) the way on from there,

    t₁(b) + t₂(b)

is minimised near the guess. Where simple pieces touch the disc by themselves, b is none either (see
`touch_points`). A branch is a word, those of three turns by their middle arc: one of `branches`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Disc, Pose, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.contact.touch_points import next_contact, opposite, slide_between
from relguide.kernels.words.extremals import solve_word

LS, RS, LR, RL = 8, 9, 10, 11
"""Entries that touch the disc by themselves; before them come the branches, as `branches`."""
ARCS_ON, ON_LR, ON_RL, AGAIN_ARCS, ARCS_AGAIN = 8, 9, 10, 11, 12
"""Ways on: along the disc; by two turns that touch it; by a turn and a straight to a boundary arc;
by a boundary arc, a straight and a turn to one more contact. Before them come the branches."""
_STRIDE = 0.03  # of the first look beside a guess: 2°, about as good as guesses are [rad]
_PROBES = np.array((0.02, 0.04, 0.06, 0.09, 0.18, 0.27))  # where it is looked again, either way
_MOST = 60  # evaluations of t₁ + t₂ at one go
_FINEST = 1e-6  # bearing steps end here: 1 cm at R = 12 km
_GAIN = 1e-9  # or where a parabola promises less [R/V_P]


@njit(cache=True, nogil=True)
def _row_of(
    x: float, y: float, h: float, ax: float, ay: float, branch: int, found: FloatArray,
    rows: FloatArray,
) -> int:  # fmt: skip
    """The soonest path of a branch to a moving target, as its row in `rows`; −1 if none."""
    word = branch if branch < 4 else 2 + branch // 2
    n = solve_word(Pose(x, y, h), Velocity(ax, ay), 0.0, word, found, rows, 0)
    for i in range(n):
        if branch < 4 or (rows[i, 3] > pi) == (branch % 2 == 1):
            return i
    return -1


@njit(cache=True, nogil=True)
def enter(
    x: float, y: float, h: float, slot: float, alpha: float, delta: float, bearing: float,
    side: float, branch: int, found: FloatArray, way: FloatArray,
) -> int:  # fmt: skip
    """The soonest path of a branch to a contact, as its row in `way`; −1 if there is none."""
    course = contact_heading(bearing, side, alpha)
    c, s = cos(course), sin(course)
    dx, dy = x - slot - delta * cos(bearing), y - delta * sin(bearing)
    return _row_of(
        dx * c + dy * s,
        dy * c - dx * s,
        wrap(h - course),
        alpha * c,
        -alpha * s,
        branch,
        found,
        way,
    )


@njit(cache=True, nogil=True)
def leave(
    slot: float, alpha: float, delta: float, bearing: float, side: float, branch: int,
    found: FloatArray, way: FloatArray,
) -> int:  # fmt: skip
    """The soonest path of a branch from a contact to the slot, as its row in `way`; −1 if none."""
    course = wrap(contact_heading(bearing, side, alpha))
    x, y = slot + delta * cos(bearing), delta * sin(bearing)
    return _row_of(x, y, course, alpha, 0.0, branch, found, way)


@njit(cache=True, nogil=True)
def through(
    bearing: float, x: float, y: float, h: float, slot: float, alpha: float, delta: float,
    side: float, entry: int, on: int, fixed: FloatArray, found: FloatArray, rows: FloatArray,
    way: FloatArray, link: FloatArray,
) -> float:  # fmt: skip
    """Time through the contact that is not fixed by itself: to it, and on from there.

    Args:
        bearing: of the contact from the leader [rad].
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        slot: D [R].
        alpha: V_L/V_P.
        delta: distance at the contact [R].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        entry: branch to the contact; not asked for with `ARCS_AGAIN`.
        on: branch from there on; or `AGAIN_ARCS`; or `ARCS_AGAIN`, which leads to this contact.
        fixed: bearing of the boundary arc's other end, and time from the start to there, or on
            from there. shape (2,)
        found: room to work in. shape (MAX_ROWS, 4)
        rows: the same. shape (MAX_ROWS, 5)
        way: takes the row to the contact and that on from there. shape (2, 5)
        link: takes bearing, turn and straight of the boundary arc's end on this side, the
            bearing of the other end, unwrapped, and how long the boundary arc takes. shape (5,)

    Returns:
        time; infinite if there is no such way.
    """
    disc = Disc(alpha, delta, side, 0.0)
    time = 0.0
    if on != ARCS_AGAIN:
        i = enter(x, y, h, slot, alpha, delta, bearing, side, entry, found, rows)
        if i < 0:
            return inf
        way[0] = rows[i]
        time = float(way[0, 0])
        if on == AGAIN_ARCS:
            course = contact_heading(bearing, side, alpha)
            if not next_contact(bearing, disc, course, link):
                return inf
            link[3], link[4] = slide_between(link[0], fixed[0], disc)
            return float(time + link[1] + link[2] + link[4] + fixed[1])
    branch = on if on != ARCS_AGAIN else (0 if side > 0.0 else 1)
    i = leave(slot, alpha, delta, bearing, side, branch, found, rows)
    if i < 0:
        return inf
    way[1] = rows[i]
    if on == ARCS_AGAIN:
        # backward in time, with the world turned by π, the straight and the turn come after
        course = contact_heading(bearing, side, alpha)
        if not next_contact(bearing + pi, opposite(disc), course, link):
            return inf
        link[0] += pi
        link[3], link[4] = slide_between(fixed[0], link[0], disc)
        time = fixed[1] + link[4] + link[2] + link[1]
    return float(time + way[1, 0])


@njit(cache=True, nogil=True)
def descend(
    x: float, y: float, h: float, slot: float, alpha: float, delta: float, bearing: float,
    side: float, entry: int, on: int, fixed: FloatArray, found: FloatArray, rows: FloatArray,
    way: FloatArray, link: FloatArray,
) -> tuple[float, float]:  # fmt: skip
    """The least time of `through` next to a bearing, and where; infinite if there is none there.

    Where a word begins or ends a guess may lie on the wrong side, and what is least there is an
    edge, minutes later: then it is looked for a little farther away.
    """
    where = x, y, h, slot, alpha, delta, side, entry, on, fixed, found, rows, way, link
    time, least_at, settled = _descend_from(bearing, *where)
    if settled:
        return time, least_at
    least = inf
    for probe in _PROBES:
        for direction in range(2):
            there = bearing + probe * (2.0 * direction - 1.0)
            value = through(there, *where)
            if value < least:
                least, least_at = value, there
    if least == inf:
        return inf, bearing
    time, least_at, settled = _descend_from(least_at, *where)
    return (time, least_at) if settled else (inf, bearing)


@njit(cache=True, nogil=True)
def _descend_from(
    bearing: float, x: float, y: float, h: float, slot: float, alpha: float, delta: float,
    side: float, entry: int, on: int, fixed: FloatArray, found: FloatArray, rows: FloatArray,
    way: FloatArray, link: FloatArray,
) -> tuple[float, float, bool]:  # fmt: skip
    """Downhill from a bearing by parabolas: the time reached, where, and whether it is a valley."""
    trial, joint = np.zeros((2, 5)), np.zeros(5)
    where = x, y, h, slot, alpha, delta, side, entry, on, fixed, found, rows, trial, joint
    stride, count = _STRIDE, 1
    here = through(bearing, *where)
    if here == inf:
        return inf, bearing, False
    way[:], link[:] = trial, joint
    while stride > _FINEST and count < _MOST:
        beside = (inf, inf)
        for k in range(2):
            step = stride * (2.0 * k - 1.0)
            value = through(bearing + step, *where)
            count += 1
            behind = inf
            while value < here and count < _MOST:
                way[:], link[:] = trial, joint
                behind, here, bearing = here, value, bearing + step
                value = through(bearing + step, *where)
                count += 1
            if behind < inf:
                # on the other side lies what was left
                beside = (value, behind) if k == 0 else (behind, value)
                break
            beside = (beside[1], value)
        below, above = beside
        bend = below - 2.0 * here + above
        smooth = False
        if 0.0 < bend < inf:
            shift = 0.5 * stride * (below - above) / bend
            promised = 0.5 * shift * shift * bend / (stride * stride)
            if promised < _GAIN:
                return here, bearing, True
            value = through(bearing + shift, *where)
            count += 1
            smooth = abs(here - value - promised) <= 0.1 * promised + _GAIN
            if value < here:
                way[:], link[:] = trial, joint
                here, bearing = value, bearing + shift
            if smooth and promised < 1e3 * _GAIN:
                return here, bearing, True
        stride *= 0.1 if smooth else 0.3
    return here, bearing, False
