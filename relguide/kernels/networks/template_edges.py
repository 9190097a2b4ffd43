"""Ways through one contact that are fastest at an edge: where they begin to keep the limit.

The least of t₁(b) + t₂(b) may lie where a word before or behind the contact leads through the disc
elsewhere. Then the fastest that keeps the limit is next to it, at the edge: it touches once more,
or there a word of the pair ceases to exist. The edge is bracketed from a guess, and halved.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import inf

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.near_guess import through
from relguide.kernels.networks.template_legs import as_legs, clears

_STRIDE = 0.01  # of the first look beside a guess [rad]
_LOOKS = 5  # each twice as far as the last: up to 0.31 rad away
_FINEST = 1e-9  # brackets end here: a time is then good to 10⁻⁷ R/V_P, however steep


@njit(cache=True, nogil=True)
def _standing(
    bearing: float, x: float, y: float, h: float, slot: float, alpha: float, delta: float,
    side: float, entry: int, on: int, leader: FloatArray, found: FloatArray, rows: FloatArray,
    way: FloatArray, link: FloatArray, legs: FloatArray,
) -> tuple[float, bool]:  # fmt: skip
    """Time through a contact, and whether the way keeps the limit."""
    time = through(
        bearing, x, y, h, slot, alpha, delta, side, entry, on, link[:2], found, rows, way, link
    )
    if time == inf:
        return inf, False
    count = as_legs(side, on, bearing, way, link, legs)
    return time, clears(x, y, h, leader, alpha, delta, side, legs[:count])


@njit(cache=True, nogil=True)
def at_edge(
    bearing: float, x: float, y: float, h: float, slot: float, alpha: float, delta: float,
    side: float, entry: int, on: int, leader: FloatArray, found: FloatArray, rows: FloatArray,
    way: FloatArray, link: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """The time of the fastest way through one contact that keeps the limit, next to a guess.

    Args:
        bearing: guess of the contact's, from the leader [rad].
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        slot: D [R].
        alpha: V_L/V_P.
        delta: distance at the contact [R].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        entry: branch to the contact.
        on: branch from there on.
        leader: its leg as `passage.word_clears` takes it. shape (1, 5)
        found: room to work in. shape (MAX_ROWS, 4)
        rows: the same. shape (MAX_ROWS, 5)
        way: takes the row to the contact and that on from there. shape (2, 5)
        link: room to work in. shape (5,)
        legs: takes the legs. shape (≥ 2, 6)

    Returns:
        time; infinite if there is no edge there.
    """
    where = x, y, h, slot, alpha, delta, side, entry, on, leader, found, rows, way, link, legs
    here, stands = _standing(bearing, *where)
    good, bad = bearing, bearing
    if stands:
        # downhill, until it stands no more
        ahead, _ = _standing(bearing + _STRIDE, *where)
        behind, _ = _standing(bearing - _STRIDE, *where)
        if (ahead < here) == (behind < here) and (ahead < inf) == (behind < inf):
            return inf
        forward = ahead < here or (ahead == inf and behind >= here)
        stride = _STRIDE if forward else -_STRIDE
        for _ in range(_LOOKS):
            bad = good + stride
            _, stands = _standing(bad, *where)
            if not stands:
                break
            good = bad
            stride *= 2.0
        if stands:
            return inf
    else:
        stride = _STRIDE
        for _ in range(_LOOKS):
            for direction in (1.0, -1.0):
                there = bearing + direction * stride
                _, stands = _standing(there, *where)
                if stands:
                    good, bad = there, bearing + 0.5 * direction * stride
                    if stride == _STRIDE:
                        bad = bearing
                    break
            if stands:
                break
            stride *= 2.0
        if not stands:
            return inf
    while abs(good - bad) > _FINEST:
        middle = 0.5 * (good + bad)
        _, stands = _standing(middle, *where)
        if stands:
            good = middle
        else:
            bad = middle
    time, _ = _standing(good, *where)
    return time
