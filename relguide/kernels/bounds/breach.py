"""Whether all paths of a word break the limit, when its amounts are known only nearly.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import hypot, inf
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import fly_piece

ROUNDING = 2e-7
"""Added to every blur: twice what an accepted path may miss its end by, `extremals.CLOSURE` [R]."""
INSIDE = 2e-6
"""A path must come this much closer than d_min to count as breaking it [R]: 2 cm at R = 12 km."""
MOST_LOOKS = 20_000
"""At a path that follows the leader for hours, hardly outside the limit: some milliseconds."""


class Sieve(NamedTuple):
    """Which words are left out: those that certainly break the limit.

    They are flown from the end that is known: on from the start, or back from the goal, of which it
    is only nearly known when it is met.
    """

    used: bool
    """Whether any are."""
    end: Pose
    """The end that is known, at t = 0, on the heading it is left on."""
    speed: float
    """Of that end, along the x axis [V_P]."""
    scene: Scene
    """The leader, and the separation to be kept."""
    sense: float
    """+1 from the start on, −1 back from the goal."""
    low: float
    """The earliest that the other end is left, when flown back [R/V_P]."""
    high: float
    """And the latest; infinite only on the final leg [R/V_P]."""


class Flown(NamedTuple):
    """When a word is flown from the end that is known."""

    begin: float
    """When it is there [R/V_P]."""
    sense: float
    """As in `Sieve`."""
    speed: float
    """As in `Sieve`."""
    astray: float
    """How much earlier or later it may be there [R/V_P]."""


class NearWord(NamedTuple):
    """All paths of a word whose amounts lie near these."""

    signs: tuple[float, float, float]
    """ε of the pieces."""
    first: float
    """Amount of the first piece [rad]."""
    first_blur: float
    """How much it may differ."""
    middle: float
    """Amount of the second [rad or R]."""
    middle_blur: float
    """How much it may differ; infinite if it is not known."""
    until: float
    """When the word is not yet over [R/V_P]."""


@njit(cache=True, nogil=True)
def no_sieve(scene: Scene) -> Sieve:
    """No word is left out."""
    return Sieve(False, Pose(0.0, 0.0, 0.0), 0.0, scene, 1.0, 0.0, 0.0)


@njit(cache=True, nogil=True)
def breaks_limit(start: Pose, word: NearWord, flown: Flown, scene: Scene, stride: float) -> bool:
    """Whether every path of a word with amounts near these comes closer than the limit in time.

    It is looked at now and then only: a breach that is short may be missed, and none is made up.

    Args:
        start: the end from which it is flown, when it is left.
        word: which paths.
        flown: when, and which way in time.
        scene: the leader, and the separation to be kept.
        stride: least step from one look to the next [R/V_P].
    """
    if word.middle_blur == inf:
        return False
    leader, looks, final = scene.leader, 0, len(scene.leader) - 1
    # headings differ by no more than this in the second piece and in the third
    slow = word.first_blur if word.signs[1] == 0.0 else 2.0 * word.first_blur
    fast = 2.0 * (word.first_blur + word.middle_blur)
    first, middle = max(word.first, 0.0), max(word.middle, 0.0)
    parted = max(first - word.first_blur, 0.0)
    turning = parted + max(middle - word.middle_blur, 0.0)
    second = fly_piece(start, word.signs[0], first)
    third = fly_piece(second, word.signs[1], middle)
    i = piece_at(leader, flown.begin)
    # on the final leg the leader keeps its place from a slot, and elsewhere it may lie astray
    drift_final = abs(flown.speed - scene.alpha) * flown.astray if flown.astray > 0.0 else 0.0
    drift = (flown.speed + scene.alpha) * flown.astray
    t = 0.0
    while t < word.until and looks < MOST_LOOKS:
        looks += 1
        now = flown.begin + flown.sense * t
        while i < final and leader[i + 1, 0] <= now:
            i += 1
        while i > 0 and leader[i, 0] > now:
            i -= 1
        if t <= first:
            at = fly_piece(start, word.signs[0], t)
        elif t <= first + middle:
            at = fly_piece(second, word.signs[1], t - first)
        else:
            at = fly_piece(third, word.signs[2], t - first - middle)
        there = leader_at(scene, i, now)
        astray = slow * max(t - parted, 0.0) + fast * max(t - turning, 0.0)
        astray += drift_final if now - flown.astray >= leader[final, 0] else drift
        gap = hypot(at.x - there.x, at.y - there.y) + astray + ROUNDING - scene.d_min
        if gap < 0.0:
            return True
        t += max(gap / (1.0 + scene.alpha), stride)
    return False
