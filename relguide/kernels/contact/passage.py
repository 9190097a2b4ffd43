"""Through one contact with d = d_min: the ways to it, and the best one on from it.

Up to a contact and from it on, the path is an extremal without the limit: so it is fixed by the
contact, and that by one bearing and a side (see `contact`). Both halves come from the same
enumeration of words.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import inf

from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_exists, contact_on
from relguide.kernels.contact.paths_to_contact import not_before_slot, paths_to_contact
from relguide.kernels.separation.clearance import piece_clears
from relguide.kernels.words.extremals import SIGNS, fly_piece, solve

GRAZE = 3e-7
"""The contact is flown this far outside d_min [R], so that rounding cannot break it."""
_EARLY = 1e-9  # this much before it opens the slot counts as open [R/V_P], as in `solve`


@njit(cache=True, nogil=True)
def pieces_clear(
    x: float, y: float, h: float, t: float, signs: FloatArray, amounts: FloatArray,
    leader: FloatArray, alpha: float, limit: float,
) -> bool:  # fmt: skip
    """Whether pieces at full bank or straight, flown from time t, stay `limit` away."""
    for k in range(len(signs)):
        sign, amount = signs[k], amounts[k]
        if amount > 0.0 and not piece_clears(
            Pose(x, y, h), sign, t, amount, Scene(leader, alpha, limit, 0.0)
        ):
            return False
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        t += amount
    return True


@njit(cache=True, nogil=True)
def word_clears(
    x: float, y: float, h: float, t: float, row: FloatArray, leader: FloatArray, alpha: float,
    limit: float,
) -> bool:  # fmt: skip
    """Whether a row of `solve`, flown from time t, stays `limit` away from the leader."""
    return pieces_clear(x, y, h, t, SIGNS[int(row[1])], row[2:5], leader, alpha, limit)


@njit(cache=True, nogil=True)
def first_clear(
    x: float, y: float, h: float, t: float, rows: FloatArray, leader: FloatArray, alpha: float,
    limit: float, t_release: float, beat: float,
) -> tuple[float, int]:  # fmt: skip
    """The first of the rows of `solve`, flown from time t, that is not early and clears.

    Returns:
        arrival time and its number; infinite and −1 if none arrives before `beat`.
    """
    for k in range(len(rows)):
        arrival = t + rows[k, 0]
        if arrival >= beat:
            break
        if arrival >= t_release - _EARLY and word_clears(x, y, h, t, rows[k], leader, alpha, limit):
            return arrival, k
    return inf, -1


@njit(cache=True, nogil=True)
def best_word(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, limit: float,
    t_release: float, beat: float, rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest extremal to the slot, from time t on, that clears; arrival time and its row.

    Infinite and −1 if none arrives before `beat`.
    """
    n = solve(Pose(x - alpha * t, y, wrap(h)), alpha, max(t_release - t, 0.0), rows)
    return first_clear(x, y, h, t, rows[:n], leader, alpha, limit, t_release, beat)


@njit(cache=True, nogil=True)
def through_contact(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_release: float, bearing: float, side: float, beat: float, rows: FloatArray,
    onward: FloatArray, way: FloatArray, reached: FloatArray,
) -> float:  # fmt: skip
    """Arrival by the fastest way through one contact that clears, if it is before `beat`.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        i: piece it is on at the contact.
        alpha: V_L/V_P.
        delta: distance at the contact [R].
        t_release: when the slot opens [R/V_P].
        bearing: of the contact from the leader, relative to its heading [rad].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        beat: arrivals from here on do not matter [R/V_P].
        rows: room for words. shape (MAX_ROWS, 5)
        onward: the same.
        way: takes the two rows of the way found. shape (2, 5)
        reached: takes the earliest time the contact is reached clear of the limit, and before what
            no way on from there arrives; infinite if not in time. shape (2,)

    Returns:
        arrival time; infinite if there is none before `beat`.
    """
    reached[:] = inf
    if not contact_exists(bearing, alpha):
        return inf
    limit = delta - GRAZE
    n = paths_to_contact(x, y, h, 0.0, leader, i, alpha, delta, bearing, side, rows)
    m = -1
    for k in range(n):
        t = rows[k, 0]
        if t >= beat:
            continue
        cx, cy, ch = contact_on(leader, i, t, bearing, side, alpha, delta)
        if not_before_slot(cx, cy, ch, t, alpha, t_release) >= beat:
            continue
        if m < 0 or i + 1 < len(leader):
            # on the final leg the ways on are the same at any time
            m = solve(Pose(cx - alpha * t, cy, wrap(ch)), alpha, 0.0, onward)
        if m == 0:
            continue
        # the cheap test first: could it be in time at all? What is too early may wait
        lower = max(t + onward[0, 0], t_release)
        if lower >= beat or not word_clears(x, y, h, 0.0, rows[k], leader, alpha, limit):
            continue
        if t < reached[0]:
            reached[0], reached[1] = t, lower
        arrival, j = first_clear(cx, cy, ch, t, onward[:m], leader, alpha, limit, t_release, beat)
        if j >= 0:
            beat = arrival
            way[0] = rows[k]
            way[1] = onward[j]
    return beat
