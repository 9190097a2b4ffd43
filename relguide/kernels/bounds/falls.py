"""How far behind a front something falls that turns at full bank at most: proved.

A front that slides along the edge turns with it, at k V_P/R (see `round_turning`, `junction`).
Where k > 1 no bank is enough for that. Let P be where it is, at V_P along e, and n the normal of e,
out from the disc. Something that is at P − λ e + δ n and heads φ outward from e moves, seen so, by

    λ′ = 1 − cos φ + k δ,    δ′ = sin φ − k λ,    φ′ = k − w,    |w| ≤ 1,

w being how fast it turns toward the leader. Let m be how far a fixed vector reaches along −e, and p
how far along n, so that m′ = k p and p′ = −k m. Then of V = m λ + p δ + r φ, whatever r is,

    V′ = m (1 − cos φ) + p sin φ + r′ φ + r (k − w).

Let the vector be along −e at a time t₁, and have turned by θ, so m = cos θ and p = −sin θ; and let
r be 0, and later 1 − cos u, with u′ = 1. What comes before r (k − w) is least at φ = θ − u; and
r (k − w) at w = 1. So V grows at least by

    r (θ − u) + ∫ cos θ dt − (the time until r differs from 0) − sin u.

At another time the vector may change: outward from the leader, since nothing is inside the disc, or
ahead, since nothing is ahead of the front. Turned round, the same holds from there to a time t₂,
when r is 0 again and the vector m₂ along −e. V is no less than 0 at t₁: so λ is no less at t₂ than
all that V has grown by, over m₂. That is as long as something flies that slides until t₁, goes
straight, turns, touches once, turns, and goes straight until it slides again: so hardly anybody is
sooner. What starts in a contact has λ, δ and φ of 0 there, and r and p need not be.

This is so of what heads nowhere more than some `off` from e. Who does falls behind as he turns
off, and as he turns back. Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, inf, pi, sin
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.slides import AHEAD, AT, COSINE, SINE, STEP, TURNED, turns_at

_MOST_TURN = 1.4  # of u and θ [rad]
_OFF, _OFF_STEP = 0.7, 0.15  # the least `off` that is asked for, and between those tried [rad]
_TRIED = 12  # times when the vector changes, and when it is along −e before
_CLOSER = 3  # and so often around the best ones
_MOST_AWAY = 1.6  # before no bank is enough that it is along −e [R/V_P]
_CERTAIN = 0.7  # part of what is fallen behind by turning off that is counted on


class Fall(NamedTuple):
    """A bound of how far behind something falls on a slide, points of which are numbered."""

    lag: float
    """λ at the end, at least [R]."""
    begin: int
    """Where the vector is along −e at first …"""
    change: int
    """… where it changes; the same if something starts there in a contact …"""
    end: int
    """… and where it is along −e again; −1 if nothing is known."""
    turn: float
    """How long after the change r is 0 [R/V_P]."""
    scale: float
    """m at the end."""
    off: float
    """It holds for what heads no further off e than this, on the way [rad]."""


NO_FALL = Fall(-inf, -1, -1, -1, 0.0, 1.0, 0.0)
"""Nothing is known."""


@njit(cache=True, nogil=True)
def grown(rows: FloatArray, at: int, turn: float, end: int) -> tuple[float, float]:
    """What r is at a point if the vector is along −e and of length 1 at another; how V grows.

    Args:
        rows: of `slide_of`.
        at: the one point.
        turn: for how long r differs from 0 beside it [R/V_P].
        end: the other, before or after it.
    """
    first, last = min(at, end), max(at, end)
    s, c = sine_and_cosine(rows[TURNED, end])
    along = c * (rows[COSINE, last] - rows[COSINE, first])
    along += s * (rows[SINE, last] - rows[SINE, first])
    turned = abs(rows[TURNED, at] - rows[TURNED, end])
    straight = rows[AT, last] - rows[AT, first] - turn
    turn_s, turn_c = sine_and_cosine(turn)
    r = 1.0 - turn_c
    return r, r * (turned - turn) + along - straight - turn_s


@njit(cache=True, nogil=True)
def is_least(turned: float, turn: float, off: float) -> bool:
    """Whether what comes before r (k − w) is least at φ = θ − u of all |φ| ≤ `off`.

    Args:
        turned: θ [rad].
        turn: u [rad].
        off: no more than π/2 [rad].
    """
    if turn >= _MOST_TURN or turned >= _MOST_TURN:
        return False
    s, c = sine_and_cosine(turn)
    return bool(c - cos(turned + off) >= s * (turned - turn + off))


@njit(cache=True, nogil=True)
def turn_between(rows: FloatArray, i: int, j: int) -> float:
    """For how long something turns that touches at both points, heading as who slides."""
    return float(min(abs(rows[TURNED, j] - rows[TURNED, i]), abs(rows[AT, j] - rows[AT, i])))


@njit(cache=True, nogil=True)
def lost_by_turning(rows: FloatArray, fall: Fall) -> float:
    """How far behind who turns off by more than `off` falls by that alone [R].

    He turns by up to 1 + k beside e. He falls behind as much, or more, until he has turned back.
    """
    fastest = 0.0
    for i in range(fall.begin, fall.end):
        fastest = max(fastest, turns_at(rows, i))
    return _CERTAIN * (fall.off - sin(fall.off)) / (1.0 + fastest)


@njit(cache=True, nogil=True)
def best_fall(rows: FloatArray) -> Fall:
    """The most that something falls behind which comes from elsewhere. Argument of `slide_of`."""
    best, count, i = NO_FALL, rows.shape[1], 0
    while i + 2 < count:
        # where no bank is enough
        if turns_at(rows, i) <= 1.0:
            i += 1
            continue
        j = i
        while j + 1 < count and turns_at(rows, j) > 1.0:
            j += 1
        fall = _about(rows, i, j)
        if _worth(fall) > _worth(best):
            best = fall
        i = j
    return best


@njit(cache=True, nogil=True)
def fall_from_contact(rows: FloatArray) -> Fall:
    """The most that something falls behind which starts in a contact where the slide begins."""
    best, count = NO_FALL, rows.shape[1]
    for meets in range(1, count, 2):
        turn = rows[AT, meets] - rows[AT, 0]
        if turn >= _MOST_TURN:
            break
        for end in range(meets, count, 2):
            turned = rows[TURNED, end] - rows[TURNED, 0]
            if rows[AHEAD, 0] + turned >= pi or not is_least(turned, turn, 0.5 * pi):
                break
            _, grows = grown(rows, 0, turn, end)
            if grows > best.lag:
                best = Fall(grows, 0, 0, end, turn, 1.0, 0.5 * pi)
    return best


@njit(cache=True, nogil=True)
def _about(rows: FloatArray, first: int, last: int) -> Fall:
    """The best of falls whose vector changes between two points, where no bank is enough."""
    best, far = NO_FALL, int(_MOST_AWAY / STEP)
    low, high, near, until = max(first - far, 0), last - 1, first, last
    for _ in range(_CLOSER):
        step, stride = max((high - low) // _TRIED, 1), max((until - near) // _TRIED, 1)
        for begin in range(low, high + 1, step):
            for change in range(max(near, begin + 1), until + 1, stride):
                fall = _fall_by(rows, begin, change)
                if _worth(fall) > _worth(best):
                    best = fall
        if best.end < 0:
            break
        low, high = max(best.begin - step, 0), best.begin + step
        near, until = max(best.change - stride, first), min(best.change + stride, last)
    return best


@njit(cache=True, nogil=True)
def _worth(fall: Fall) -> float:
    """How far behind anybody falls, about."""
    return min(fall.lag, _CERTAIN * (fall.off - sin(fall.off)))


@njit(cache=True, nogil=True)
def _fall_by(rows: FloatArray, begin: int, change: int) -> Fall:
    """A fall whose vector is along −e at a point, and changes at a later one."""
    turned, ahead = rows[TURNED, change] - rows[TURNED, begin], rows[AHEAD, change]
    turn = turn_between(rows, begin, change)
    low, high = change + 1, rows.shape[1] - 1
    if turn <= 0.0 or ahead <= turned or low > high:
        return NO_FALL
    off = _most_off(turned, turn, 0.5 * pi)
    if off < _OFF:
        return NO_FALL
    r, grows = grown(rows, change, turn, begin)
    beyond = sin(ahead - turned)
    if not _may_end(rows, change, low, r, beyond):
        return NO_FALL
    while high > low:
        middle = (low + high + 1) // 2
        if _may_end(rows, change, middle, r, beyond):
            low = middle
        else:
            high = middle - 1
    back = turn_between(rows, change, low)
    off = _most_off(rows[TURNED, low] - rows[TURNED, change], back, off)
    fallen, more = grown(rows, change, back, low)
    m = r / fallen
    return Fall(grows / m + more, begin, change, low, back, m, off)


@njit(cache=True, nogil=True)
def _may_end(rows: FloatArray, change: int, end: int, r: float, beyond: float) -> bool:
    """Whether the vector changes outward from the leader, or ahead, if it ends there along −e."""
    turned, turn = rows[TURNED, end] - rows[TURNED, change], turn_between(rows, change, end)
    turns = rows[AHEAD, change] + turned
    if turns >= pi or not is_least(turned, turn, _OFF):
        return False
    return bool(r * sin(turns) >= (1.0 - cos(turn)) * beyond)


@njit(cache=True, nogil=True)
def _most_off(turned: float, turn: float, off: float) -> float:
    """The most that `is_least` holds for, no more than `off`; less than `_OFF` if not for that."""
    while off >= _OFF and not is_least(turned, turn, off):
        off -= _OFF_STEP
    return off
