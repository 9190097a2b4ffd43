"""The soonest a path without the limit can meet a target, from any pose of a small set: proved.

The counterpart of `extremals`: there exact times from one pose, here a lower bound that holds for
every pose of a set at once. A set is a pose (x, y, h), how far the centre of its left circle and of
its right one may lie from where they are drawn, and how much its heading may differ. Frame, target
and words as in `csc` and `ccc`.

Intervals of each word's unknown (see `word_intervals`) that are not ruled out are halved until
their width counts for no more than the set's. What cannot be decided is let through: that may lower
the bound, and never raises it. Words can be told apart by what they do at the set: see `junction`.
Intervals that are left are kept, and a part of the set need only look at those: see `rest`.
"""

from math import cos, floor, inf, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import ROUNDING, Flown, NearWord, Sieve, breach_time
from relguide.kernels.bounds.rest import (
    LEFT_OUT,
    OPPOSITE_TURNS,
    SAME_TURNS,
    THREE_TURNS,
    Rest,
    begin_rest,
    keep,
    no_rest,
)
from relguide.kernels.bounds.word_intervals import (
    FINEST,
    MOST_TURNS,
    Blur,
    Interval,
    Side,
    intercept_span,
    opposite_turns_within,
    same_turns,
    side_of,
    sine_cosine,
    span_of,
    three_turns_within,
)

_TANGENT, _LASTING, _BEAT = 2, 3, 4  # places in what is lowered, after both turns at the set
_BREACH = 5  # and where the last word that was left out broke the limit
_FOUND = 6  # and the time of any word that was found, also of those that were left out
_DEPTH, _COLUMNS = 64, 8  # more rows than halvings of a whole turn to the shortest interval
_MUCH_LESS = 0.4  # if no more is left of an interval it is not halved as well
_IMPOSSIBLE, _LEFT_OUT, _POSSIBLE = 0, 1, 2  # what words in an interval are
_STRIDE = 0.02  # least step of the look for a breach [R/V_P]


class Junction(NamedTuple):
    """What is asked of the turn with which a word leaves the poses of a set: see `junction`."""

    asked: bool
    """Whether anything is."""
    outward: int
    """The turn that went on before the set, 0 left, 1 right; the other one is toward the leader."""
    beyond: float
    """Of `junction.beyond_outward` [rad]."""
    straight: bool
    """Whether the costate of the heading may vanish at the set."""
    inward: bool
    """Whether the turn may then be toward the leader."""


class ByTurn(NamedTuple):
    """How soon the target is met, by what the word does at the set; infinite if it is not."""

    left: float
    """In a left turn [R/V_P]."""
    right: float
    """In a right turn [R/V_P]."""
    tangent: float
    """Where the costate of the heading vanishes [R/V_P]."""
    lasting: float
    """In an outward turn, and how long that was there before the set, too [R/V_P]."""
    any: bool
    """Whether it is met by words at all, also by those left out."""


class _Asked(NamedTuple):
    """What is asked, and what is known so far."""

    earliest: float
    """Words that meet the target earlier do not count [R/V_P]."""
    beat: float
    """Nor do those that meet it no sooner [R/V_P]."""
    enough: float
    """Once one is found that is no later, nothing else matters [R/V_P]."""
    sieve: Sieve
    """Words left out."""
    junction: Junction
    """What is asked of the turn at the set."""
    work: FloatArray
    """Its first row is lowered: the fields of `ByTurn`, and how late a word may be; or one of any
    word. Then how far along the last word that was left out broke the limit, and when any was
    found. The other rows are a stack of intervals. shape (_DEPTH, _COLUMNS)"""
    rest: Rest
    """What a set that holds this one has left, and takes what is left now."""


_NO_JUNCTION = Junction(False, 0, 0.0, False, False)


@njit(cache=True, nogil=True)
def soonest(pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve) -> float:
    """No word meets the target sooner than this, from any pose of the set.

    Arguments as `soonest_by_turn`.
    """
    return soonest_kept(pose, blur, target, window, sieve, no_rest())[0]


@njit(cache=True, nogil=True)
def soonest_beyond(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, enough: float
) -> float:
    """The same, but any time no greater than `enough` if it is met as soon [R/V_P]."""
    work = _unknown(window.beat)
    rest = no_rest()
    asked = _Asked(window.earliest, window.beat, enough, sieve, _NO_JUNCTION, work, rest)
    _bound_all(pose, blur, target, asked)
    return float(work[0, 0]) if work[0, 0] < window.beat else inf


@njit(cache=True, nogil=True)
def soonest_kept(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, rest: Rest
) -> tuple[float, bool]:
    """The same, and whether it is met by words at all, also by those left out."""
    work = _unknown(window.beat)
    asked = _Asked(window.earliest, window.beat, 0.0, sieve, _NO_JUNCTION, work, rest)
    _bound_all(pose, blur, target, asked)
    return float(work[0, 0]) if work[0, 0] < window.beat else inf, bool(work[0, _FOUND] < inf)


@njit(cache=True, nogil=True)
def soonest_by_turn(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, junction: Junction,
    rest: Rest,
) -> ByTurn:  # fmt: skip
    """The same by what words do at the set.

    Args:
        pose: middle of the set, seen from the target along the heading to meet it on.
        blur: how far the set reaches.
        target: its velocity.
        window: words that meet it earlier do not count; bounds from `beat` on do not matter, and
            come back as infinite.
        sieve: words left out.
        junction: what is asked.
        rest: what was left by a set that holds this one; takes what is left now.
    """
    work = _unknown(window.beat)
    asked = _Asked(window.earliest, window.beat, 0.0, sieve, junction, work, rest)
    _bound_all(pose, blur, target, asked)
    for k in range(_LASTING):
        if work[0, k] >= window.beat:
            work[0, k] = inf
    any_word = bool(work[0, _FOUND] < inf)
    return ByTurn(work[0, 0], work[0, 1], work[0, _TANGENT], work[0, _LASTING], any_word)


@njit(cache=True, nogil=True, inline="always")
def _unknown(beat: float) -> FloatArray:
    """Nothing but `beat` is known: see `_Asked.work`."""
    work = np.empty((_DEPTH, _COLUMNS))
    for k in range(_FOUND + 1):
        work[0, k] = beat
    work[0, _LASTING] = work[0, _BREACH] = work[0, _FOUND] = inf
    return work


@njit(cache=True, nogil=True)
def _bound_all(pose: Pose, blur: Blur, target: Velocity, asked: _Asked) -> None:
    """Lower what is known to what any word comes to."""
    begin_rest(asked.rest)
    # a word is no shorter than the way to where the target can be met
    astray = min(blur.left, blur.right) + blur.heading + ROUNDING
    if asked.beat <= intercept_span(-pose.x, -pose.y, target, astray)[0]:
        return
    for hand in range(2):
        side = side_of(pose, blur, target, hand)
        if asked.rest.known >= 0:
            _bound_rest(side, asked)
            continue
        for k in range(MOST_TURNS):
            _bound_same_side(k, side, asked)
        for turns in range(2):
            _bound_by_halves(turns == 1, side, asked)


@njit(cache=True, nogil=True)
def _bound_rest(side: Side, asked: _Asked) -> None:
    """As `_bound_all`, for intervals that are known to be all that is left of a larger set."""
    table, known = asked.rest.table, asked.rest.known
    for n in range(known + 1, known + 1 + int(table[known, 0])):
        word = int(table[n, 0])
        left_out = word >= LEFT_OUT
        if left_out:
            word -= LEFT_OUT
        if word // 3 != side.hand:
            continue
        mid, half, h, around = table[n, 1], table[n, 2], table[n, 3], table[n, 4]
        # the heading is told to full turns only
        turns, kind = floor((side.h - h) / TWO_PI + 0.5), word % 3
        low, high = 0.0, 0.0
        if kind == SAME_TURNS:
            around += turns
        else:
            around += TWO_PI * turns
            low, high = _span_of(kind == THREE_TURNS, around, side, asked)
            low, high = max(low, mid - half), min(high, mid + half)
        if low > high:
            continue
        mid, half = 0.5 * (low + high), 0.5 * (high - low)
        if left_out and asked.sieve.used:
            if _within(kind, mid, half, around, side, asked).time < inf:
                asked.work[0, _FOUND] = asked.earliest
                _keep(_LEFT_OUT, kind, mid, half, around, side, asked)
        elif kind == SAME_TURNS:
            _bound_same_side(int(around), side, asked)
        else:
            _bound_within(kind == THREE_TURNS, mid, half, around, side, asked)


@njit(cache=True, nogil=True)
def _beat(side: Side, asked: _Asked) -> float:
    """Words of this side that are later do not lower anything."""
    junction, work = asked.junction, asked.work
    if not junction.asked:
        return float(work[0, 0]) if work[0, 0] > asked.enough else 0.0
    beat = max(work[0, side.hand], work[0, _TANGENT] if junction.straight else 0.0)
    if side.hand == junction.outward:
        beat = max(beat, min(work[0, _LASTING], work[0, _BEAT]))
    return float(beat)


@njit(cache=True, nogil=True)
def _bound_same_side(turns: int, side: Side, asked: _Asked) -> None:
    """As `_bound_all`, for LSL, see `same_turns`."""
    found = same_turns(turns, side, Window(asked.earliest, _beat(side, asked)))
    fate = _POSSIBLE
    if found.time < inf:
        fate = _take_all(found, (-1.0, 0.0, -1.0), 3, 0.0, side, asked)
    elif asked.rest.room < 0:
        return
    elif _within(SAME_TURNS, 0.0, 0.0, float(turns), side, asked).time == inf:
        return
    _keep(fate, SAME_TURNS, 0.0, 0.0, float(turns), side, asked)


@njit(cache=True, nogil=True)
def _bound_by_halves(three_turns: bool, side: Side, asked: _Asked) -> None:
    """As `_bound_all`, for LSR, or for LRL if `three_turns`."""
    for k in range(-1, 4):
        around = TWO_PI * k
        low, high = _span_of(three_turns, around, side, asked)
        if low <= high:
            mid, half = 0.5 * (low + high), 0.5 * (high - low) + FINEST
            _bound_within(three_turns, mid, half, around, side, asked)


@njit(cache=True, nogil=True)
def _span_of(three_turns: bool, around: float, side: Side, asked: _Asked) -> tuple[float, float]:
    """As `span_of`. Words that are too late to matter now may matter to a part of the set."""
    beat = asked.beat if asked.rest.room >= 0 else _beat(side, asked)
    return span_of(three_turns, around, side, Window(asked.earliest, beat))


@njit(cache=True, nogil=True)
def _bound_within(
    three_turns: bool, mid: float, half: float, around: float, side: Side, asked: _Asked
) -> None:
    """As `_bound_by_halves`, within an interval."""
    # of each interval its middle and half its width, and sine and cosine of what is asked for
    stack = asked.work
    part = 0.5 if three_turns else 1.0
    kind = THREE_TURNS if three_turns else OPPOSITE_TURNS
    stack[1, 0], stack[1, 1] = mid, half
    stack[1, 2], stack[1, 3] = sin(part * mid), cos(part * mid)
    n = 2
    while n > 1:
        n -= 1
        mid, half, s, c = stack[n, 0], stack[n, 1], stack[n, 2], stack[n, 3]
        left = Window(asked.earliest, _beat(side, asked))
        if three_turns:
            found = three_turns_within(mid, half, s, c, around, side, left)
        else:
            found = opposite_turns_within(mid, half, s, c, around, side, left)
        if (
            asked.rest.room >= 0
            and left.beat < asked.beat
            and (found.time == inf or not found.fine)
        ):
            # words that are too late to matter now may matter to a part of the set
            all_words = _within(kind, mid, half, around, side, asked)
            if found.time == inf and all_words.time < inf:
                _keep(_POSSIBLE, kind, mid, half, around, side, asked)
            elif found.time < inf:
                found = all_words
        if found.time == inf:
            continue
        if not found.fine:
            # what is left of it, or both halves of that, of which the sooner is looked at first
            count = 1 if found.middle_blur < _MUCH_LESS * half else 2
            half = found.middle_blur / count
            for j in range(count):
                angle = found.middle + half * (count - 1 - 2 * j)
                sine, cosine = sine_cosine(part * angle)
                stack[n, 0], stack[n, 1] = mid + angle, half
                stack[n, 2], stack[n, 3] = s * cosine + c * sine, c * cosine - s * sine
                n += 1
        elif three_turns:
            fate = _take_all(found, (-1.0, 1.0, -1.0), 2, half, side, asked)
            _keep(fate, kind, mid, half, around, side, asked)
        else:
            spare = half + side.heading
            fate = _take(found, (1.0, 0.0, -1.0), found.first, spare, side, asked)
            _keep(fate, kind, mid, half, around, side, asked)


@njit(cache=True, nogil=True)
def _within(
    kind: int, mid: float, half: float, around: float, side: Side, asked: _Asked
) -> Interval:
    """What an interval leaves possible, be it soon enough to matter now or not."""
    window = Window(asked.earliest, asked.beat)
    if kind == SAME_TURNS:
        return same_turns(int(around), side, window)
    if kind == THREE_TURNS:
        s, c = sin(0.5 * mid), cos(0.5 * mid)
        return three_turns_within(mid, half, s, c, around, side, window)
    return opposite_turns_within(mid, half, sin(mid), cos(mid), around, side, window)


@njit(cache=True, nogil=True)
def _keep(
    fate: int, kind: int, mid: float, half: float, around: float, side: Side, asked: _Asked
) -> None:
    """Keep an interval for parts of the set, unless there can be no word in it."""
    if asked.rest.room >= 0 and fate != _IMPOSSIBLE:
        word = 3 * side.hand + kind + (LEFT_OUT if fate == _LEFT_OUT else 0)
        keep(asked.rest, word, mid, half, side.h, around)


@njit(cache=True, nogil=True)
def _take_all(
    found: Interval, signs: tuple[float, float, float], turns: int, half: float, side: Side,
    asked: _Asked,
) -> int:  # fmt: skip
    """As `_bound_all`, for a word whose outer turns are between none and a full one.

    Args:
        found: what is asked about.
        signs: of the pieces, read backward, but for the mirror.
        turns: how many full turns the first turn may be off.
        half: how much both outer turns together may differ besides [rad].
        side: of which words.
        asked: what is lowered.

    Returns:
        `_POSSIBLE`, `_LEFT_OUT` or `_IMPOSSIBLE`.
    """
    fate = _IMPOSSIBLE
    for j in range(turns):
        first = found.first + TWO_PI * j
        other, spare = found.turned - first, found.astray + half + side.heading
        if (
            -found.astray - side.end <= first <= TWO_PI + found.astray + side.end
            and -spare <= other <= TWO_PI + spare
            and not (signs[1] != 0.0 and _has_lesser_middle(found, first, other, spare))
        ):
            fate = max(fate, _take(found, signs, first, spare, side, asked))
    return fate


@njit(cache=True, nogil=True)
def _take(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float, side: Side,
    asked: _Asked,
) -> int:  # fmt: skip
    """As `_take_all`, for one first turn; the turn at the set may differ by `spare`."""
    junction, work, time = asked.junction, asked.work, found.time
    work[0, _FOUND] = time
    hand = side.hand if junction.asked else 0
    sooner, tangent, lasts = time < work[0, hand], False, inf
    if junction.asked:
        if junction.straight and time < work[0, _TANGENT]:
            tangent = _costate_vanishes(found, signs, first, spare, side, junction)
        if side.hand == junction.outward and time < work[0, _LASTING]:
            lasts = time + _lasted(found, signs, first, spare, junction)
            if lasts >= work[0, _LASTING]:
                lasts = inf
    if not (sooner or tangent or lasts < inf):
        return _POSSIBLE
    if _is_ruled_out(found, signs, first, side, asked):
        return _LEFT_OUT
    if sooner:
        work[0, hand] = time
    if tangent:
        work[0, _TANGENT] = time
    if lasts < inf:
        work[0, _LASTING] = lasts
    return _POSSIBLE


@njit(cache=True, nogil=True)
def _has_lesser_middle(found: Interval, first: float, other: float, spare: float) -> bool:
    """Whether the middle of three turns is certainly less than an outer one: then no costate fits.

    λ_ψ vanishes on a line, on which both switches lie: so it would again, as long after the second
    and before the first (see `costate`).
    """
    middle = found.middle + found.middle_blur
    return (first - found.astray > middle and other > spare) or (
        other - spare > middle and first > found.astray
    )


@njit(cache=True, nogil=True)
def _is_free(found: Interval, signs: tuple[float, float, float], first: float) -> bool:
    """Whether the word may have two turns only, so that the costate vanishes anywhere."""
    return first <= found.astray if signs[1] != 0.0 else found.shortest <= 0.0


@njit(cache=True, nogil=True)
def _costate_vanishes(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float, side: Side,
    junction: Junction,
) -> bool:  # fmt: skip
    """Whether λ_ψ may vanish at the set.

    That is on the straight, a full turn from it, and as far from the middle of three turns as that
    is long. Arguments as `_take`.
    """
    turn = found.turned - first
    if turn <= spare:
        return True
    if side.hand != junction.outward and not junction.inward:
        return False
    back = signs[1] != 0.0 and abs(turn - found.middle) <= spare + found.middle_blur
    return _is_free(found, signs, first) or back or abs(turn - TWO_PI) <= spare


@njit(cache=True, nogil=True)
def _lasted(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float,
    junction: Junction,
) -> float:  # fmt: skip
    """How long the turn was there before the set, at least. Arguments as `_take`."""
    if _is_free(found, signs, first):
        return 0.0
    whole = found.shortest if signs[1] != 0.0 else TWO_PI
    turn = found.turned - first
    return max(min(whole - turn - spare, junction.beyond), 0.0)


@njit(cache=True, nogil=True)
def _is_ruled_out(
    found: Interval, signs: tuple[float, float, float], first: float, side: Side, asked: _Asked
) -> bool:
    """Whether a word is left out, as every path of it certainly breaks the limit."""
    sieve = asked.sieve
    if not sieve.used:
        return False
    m = side.mirror
    word = NearWord(
        (m * signs[0], m * signs[1], m * signs[2]), first, found.astray, found.middle,
        found.middle_blur, found.time,
    )  # fmt: skip
    begin, astray = 0.0, 0.0
    if sieve.sense < 0.0:
        # flown back from the goal, of which it is known only nearly when it is met
        begin = sieve.low + found.time
        latest = sieve.high + found.latest
        if latest < inf:
            astray = 0.5 * max(latest - begin, 0.0)
            begin += astray
        elif sieve.speed != sieve.scene.alpha:
            return False
    end = Pose(sieve.end.x + sieve.speed * begin, sieve.end.y, sieve.end.h)
    flown = Flown(begin, sieve.sense, sieve.speed, astray)
    breach = breach_time(end, word, flown, sieve.scene, _STRIDE, asked.work[0, _BREACH])
    if breach < inf:
        asked.work[0, _BREACH] = breach
    return breach < inf
