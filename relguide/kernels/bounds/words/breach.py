"""Whether all paths of a word break the limit, when its amounts are known only nearly.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.borrowed import uncounted
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine

ROUNDING = 2e-7
"""Added to every blur: twice what an accepted path may miss its end by, `extremals.CLOSURE` [R]."""
INSIDE = 2e-6
"""A path must come this much closer than d_min to count as breaking it [R]: 2 cm at R = 12 km."""
_BENDS = 1e-6  # a leader that turns more slowly is taken to keep straight, but for its bend [V_P/R]
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
    """The end that is known, on the heading it is left on; one that moves at t = 0."""
    speed: float
    """Of that end, along the x axis [V_P]."""
    scene: Scene
    """The leader, and the separation to be kept."""
    sense: float
    """+1 from the start on, −1 back from the goal."""
    low: float
    """When the known end is left, and when flown back the earliest that the other one is
    [R/V_P]."""
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


class _Piece(NamedTuple):
    """A turn or a straight from a pose, with what a place along it is computed from."""

    at: Pose
    """Where it begins."""
    sign: float
    """ε."""
    sin_h: float
    """sin h there."""
    cos_h: float
    """cos h there."""


@uncounted
def breaks_limit(start: Pose, word: NearWord, flown: Flown, scene: Scene, stride: float) -> bool:
    """Whether every path of a word with amounts near these comes closer than the limit in time.

    Arguments as `breach_time`.
    """
    return breach_time(start, word, flown, scene, stride, inf) < inf


@uncounted
def breach_time(
    start: Pose, word: NearWord, flown: Flown, scene: Scene, stride: float, guess: float
) -> float:
    """How far along every path of a word with amounts near these is closer than the limit [R/V_P].

    It is looked at now and then only: a breach that is short may be missed, and none is made up.

    Args:
        start: the end from which it is flown, when it is left.
        word: which paths.
        flown: when, and which way in time.
        scene: the leader, and the separation to be kept.
        stride: least step from one look to the next [R/V_P].
        guess: where another word did so, which is looked at first; infinite if none is known.

    Returns:
        infinite if none is seen.
    """
    if word.middle_blur == inf:
        return inf
    leader, looks, final = scene.leader, 0, len(scene.leader) - 1
    # headings differ by no more than this in the second piece and in the third
    slow = word.first_blur if word.signs[1] == 0.0 else 2.0 * word.first_blur
    fast = 2.0 * (word.first_blur + word.middle_blur)
    first, middle = max(word.first, 0.0), max(word.middle, 0.0)
    parted = max(first - word.first_blur, 0.0)
    turning = parted + max(middle - word.middle_blur, 0.0)
    piece, begun, ends = _piece_from(start, word.signs[0]), 0.0, first
    # on the final leg the leader keeps its place from a slot, and elsewhere it may lie astray
    drift_final = abs(flown.speed - scene.alpha) * flown.astray if flown.astray > 0.0 else 0.0
    drift = (flown.speed + scene.alpha) * flown.astray
    i, number = -1, 0
    lx, ly, lh, rate, cos_l, sin_l = 0.0, 0.0, 0.0, 0.0, 1.0, 0.0
    t, guessed = 0.0, guess < word.until
    if guessed:
        t = guess
    while t < word.until and looks < MOST_LOOKS:
        looks += 1
        while t > ends and number < 2:
            number += 1
            amount, begun = ends - begun, ends
            piece = _piece_from(_along(piece, amount), word.signs[number])
            ends = inf if number == 2 else begun + middle
        at = _along(piece, t - begun)
        now = flown.begin + flown.sense * t
        j = max(i, 0)
        while j < final and leader[j + 1, 0] <= now:
            j += 1
        while j > 0 and leader[j, 0] > now:
            j -= 1
        if j != i:
            i = j
            lx, ly, lh, rate = leader[i, 1], leader[i, 2], leader[i, 3], leader[i, 4]
            sin_l, cos_l = sine_and_cosine(lh)
        since = now - leader[i, 0]
        ahead, bend = scene.alpha * since, 0.0
        if abs(rate) > _BENDS:
            # as `leader_at`, where sine and cosine are known
            radius, h = scene.alpha / rate, lh + rate * since
            s, c = sine_and_cosine(h)
            dx, dy = at.x - lx - radius * (s - sin_l), at.y - ly + radius * (c - cos_l)
        else:
            dx, dy = at.x - lx - ahead * cos_l, at.y - ly - ahead * sin_l
            bend = 0.5 * abs(rate * ahead * since)
        astray = bend + slow * max(t - parted, 0.0) + fast * max(t - turning, 0.0)
        astray += drift_final if now - flown.astray >= leader[final, 0] else drift
        gap = sqrt(dx * dx + dy * dy) + astray + ROUNDING - scene.d_min
        if gap < 0.0:
            return t
        if guessed:
            # it may be as good from the start on
            guessed, t, number = False, 0.0, 0
            piece, begun, ends = _piece_from(start, word.signs[0]), 0.0, first
        else:
            t += max(gap / (1.0 + scene.alpha), stride)
    return inf


@njit(cache=True, nogil=True, inline="always")
def _piece_from(at: Pose, sign: float) -> _Piece:
    s, c = sine_and_cosine(at.h)
    return _Piece(at, sign, s, c)


@njit(cache=True, nogil=True, inline="always")
def _along(piece: _Piece, amount: float) -> Pose:
    """As `fly_piece`, where many places along a piece are asked for."""
    (x, y, h), sign, s, c = piece
    if sign == 0.0:
        return Pose(x + amount * c, y + amount * s, h)
    end = h + sign * amount
    end_s, end_c = sine_and_cosine(end)
    return Pose(x + sign * (end_s - s), y - sign * (end_c - c), end)
