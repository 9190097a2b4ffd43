"""Which bearings round the leader somebody can be at by a time, who keeps d_min.

Whoever is at bearing b from the leader, r ≥ d_min away, and flies at V_P whichever way, passes
bearings counter-clockwise at most at the rate of

    (1 + α sin b)/r − ω ≤ (1 + α sin b)/d_min − ω,

ω being the leader's turn rate, and clockwise at (1 − α sin b)/d_min + ω; behind a leader that is
faster the numerator may be negative, and then bearings pass fastest far away. The disc lets nobody
through: so from one bearing all that can be reached lies between two that move so, whatever the
words. It takes no sine to look up whether another contact is among it, and half are not.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, sin

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import piece_at, piece_end

MOST_SWEPT = 400
"""Steps in time at most: some two hundred lead all round a slow leader."""
_STEP = 0.05  # from one to the next, in d_min and at V_P
_ROUNDING = 0.02  # far more than steps so short leave out [rad]


@njit(cache=True, nogil=True)
def sweep_bearings(scene: Scene, t: float, bearing: float, until: float, swept: FloatArray) -> int:
    """Follow from a contact the bearings that can be reached, up to a time or all round.

    Args:
        scene: the leader and d_min.
        t: when it begins [R/V_P].
        bearing: of the contact, from the leader's heading [rad].
        until: when it may end [R/V_P].
        swept: takes the least and the greatest bearing reached by the end of each step, relative to
            the leader's heading then or before, not wrapped [rad]. shape (MOST_SWEPT, 2)

    Returns:
        how many steps.
    """
    step = _STEP * scene.d_min
    low = high = bearing
    least, greatest = low - _ROUNDING, high + _ROUNDING
    i, n = piece_at(scene.leader, t), 0
    while n < MOST_SWEPT and t < until and greatest - least < TWO_PI:
        left = step
        while left > 0.0:
            to_end, turning = piece_end(scene.leader, i) - t, scene.leader[i, 4]
            ends = to_end <= left
            part = to_end if ends else left
            high += part * _rate(scene, high, 1.0, turning, 0.5 * part)
            low += part * _rate(scene, low, -1.0, turning, 0.5 * part)
            left -= part
            t += part
            i += 1 if ends else 0
            least, greatest = min(least, low - _ROUNDING), max(greatest, high + _ROUNDING)
        swept[n, 0], swept[n, 1] = least, greatest
        n += 1
    if n == MOST_SWEPT:
        swept[n - 1, 1] = inf
    return n


@njit(cache=True, nogil=True)
def _rate(scene: Scene, bearing: float, sense: float, turning: float, later: float) -> float:
    """How fast bearings can be passed one way, in the middle of a step [V_P/R].

    Args:
        scene: the leader and d_min.
        bearing: at its beginning, from the leader's heading [rad].
        sense: +1 counter-clockwise, −1 clockwise.
        turning: the leader's turn rate, ω [V_P/R].
        later: half of how long the step is [R/V_P].
    """
    rate = 0.0
    for after in (0.0, later):
        ahead = 1.0 + sense * scene.alpha * sin(bearing + after * rate)
        rate = sense * max(ahead, 0.0) / scene.d_min - turning
    return rate


@njit(cache=True, nogil=True)
def may_be_swept(scene: Scene, swept: FloatArray, within: float, bearing: float) -> bool:
    """Whether a bearing can be reached within a time of the beginning.

    Args:
        scene: as before.
        swept: of `sweep_bearings`. shape (steps, 2)
        within: how long after [R/V_P].
        bearing: from the leader's heading [rad].
    """
    if len(swept) == 0:
        return True
    step = int(min(within / (_STEP * scene.d_min), len(swept) - 1.0))
    least, greatest = swept[step, 0], swept[step, 1]
    return bool(wrap(bearing - least) <= greatest - least)
