"""The soonest a path without the limit can meet a target, from any pose of a small set: proved.

`extremals` gives exact times from one pose; this gives a lower bound for every pose of a set at
once. A set is a pose (x, y, h), how far the centre of its left circle and of its right one may lie
from where they are drawn, and how much its heading may differ. Frame, target and words are as in
`csc` and `ccc`.

Each word has one unknown (see `intervals`). Intervals of it that are not ruled out are halved until
their width counts for no more than the set's. Whatever cannot be decided is let through: that may
lower the bound, and never raises it. Words are told apart by what they do at the set: see
`junction`. Open intervals are kept, and a part of the set searches only these: see `found_word`.
"""

from math import floor, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.borrowed import borrowed, uncounted
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import ROUNDING, Sieve, no_sieve
from relguide.kernels.bounds.words.first_order import (
    opposite_turns_closely,
    put_sensitivity,
    same_turns_closely,
    three_turns_closely,
)
from relguide.kernels.bounds.words.found_word import (
    CERTAINLY_OUT,
    FOUND,
    IMPOSSIBLE,
    LASTING,
    LATEST,
    LEFT_OUT,
    NO_JUNCTION,
    OPPOSITE_TURNS,
    POSSIBLE,
    SAME_TURNS,
    TANGENT,
    THREE_TURNS,
    Asked,
    ByTurn,
    Junction,
    OpenIntervals,
    all_open,
    beat_of,
    begin_open,
    keep_open,
    nothing_known,
    take,
    take_all,
)
from relguide.kernels.bounds.words.intervals import (
    FINEST,
    MOST_TURNS,
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
from relguide.kernels.bounds.words.sets import EDGE, Blur, Goal, fixed, track_of

_MUCH_LESS = 0.4  # if no more is left of an interval it is not halved as well


@njit(cache=True, nogil=True)
def soonest(pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve) -> float:
    """No word meets the target sooner than this, from any pose of the set.

    Arguments as `soonest_by_turn`.
    """
    return soonest_beyond(pose, blur, target, window, sieve, 0.0)


@njit(cache=True, nogil=True)
def soonest_beyond(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, enough: float
) -> float:
    """The same, but any time no greater than `enough` if it is met as soon [R/V_P]."""
    return _of_any(pose, blur, target, window, sieve, enough, all_open())[0]


@njit(cache=True, nogil=True)
def soonest_kept(
    pose: Pose,
    blur: Blur,
    target: Velocity,
    window: Window,
    sieve: Sieve,
    open_intervals: OpenIntervals,
) -> tuple[float, bool]:
    """The same as `soonest`, and whether it is met by words at all, also by those left out."""
    return _of_any(pose, blur, target, window, sieve, 0.0, open_intervals)


@njit(cache=True, nogil=True)
def _of_any(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, enough: float,
    open_intervals: OpenIntervals,
) -> tuple[float, bool]:  # fmt: skip
    work = nothing_known(window.beat)
    lent = borrowed(work)
    junction = NO_JUNCTION
    asked = Asked(
        window.earliest, window.beat, enough, sieve, junction, lent, open_intervals, False
    )
    _bound_all(pose, blur, target, asked)
    return float(work[0, 0]) if work[0, 0] < window.beat else inf, bool(work[0, FOUND] < inf)


@njit(cache=True, nogil=True)
def soonest_by_turn(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, junction: Junction,
    open_intervals: OpenIntervals, late: bool,
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
        open_intervals: those of a set that holds this one; takes those open now.
        late: whether it matters how late words are.
    """
    work = nothing_known(window.beat)
    lent = borrowed(work)
    asked = Asked(window.earliest, window.beat, 0.0, sieve, junction, lent, open_intervals, late)
    _bound_all(pose, blur, target, asked)
    for k in range(LASTING):
        if work[0, k] >= window.beat:
            work[0, k] = inf
    any_word = bool(work[0, FOUND] < inf)
    latest = float(work[0, LATEST])
    return ByTurn(work[0, 0], work[0, 1], work[0, TANGENT], work[0, LASTING], any_word, latest)


@uncounted
def _bound_all(pose: Pose, blur: Blur, target: Velocity, asked: Asked) -> None:
    """Lower what is known to what any word comes to."""
    begin_open(asked.open_intervals)
    # a word is no shorter than the way to where the target can be met
    astray = min(blur.left, blur.right) + blur.heading + ROUNDING
    if asked.beat <= intercept_span(-pose.x, -pose.y, target, astray)[0]:
        return
    for hand in range(2):
        side = side_of(pose, blur, target, hand)
        put_sensitivity(blur, side, asked.work)
        if asked.open_intervals.known >= 0:
            _bound_open(side, asked)
            continue
        for k in range(MOST_TURNS):
            _bound_same_side(k, side, asked)
        for turns in range(2):
            _bound_by_halves(turns == 1, side, asked)


@uncounted
def _bound_open(side: Side, asked: Asked) -> None:
    """As `_bound_all`, for intervals that are known to be all that is left of a larger set."""
    table, known = asked.open_intervals.table, asked.open_intervals.known
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
                asked.work[0, FOUND] = asked.earliest
                _keep(CERTAINLY_OUT, kind, mid, half, around, side, asked)
        elif kind == SAME_TURNS:
            _bound_same_side(int(around), side, asked)
        else:
            _bound_within(kind == THREE_TURNS, mid, half, around, side, asked)


@uncounted
def _bound_same_side(turns: int, side: Side, asked: Asked) -> None:
    """As `_bound_all`, for LSL, see `same_turns`."""
    left = Window(asked.earliest, beat_of(side, asked))
    found = same_turns_closely(same_turns(turns, side, left), side, asked.work)
    fate = IMPOSSIBLE
    if found.time < inf:
        fate = take_all(found, (-1.0, 0.0, -1.0), 3, 0.0, side, asked)
    if asked.open_intervals.room >= 0:
        fate = _also_later(fate, found, left, SAME_TURNS, 0.0, 0.0, float(turns), side, asked)
        _keep(fate, SAME_TURNS, 0.0, 0.0, float(turns), side, asked)


@uncounted
def _bound_by_halves(three_turns: bool, side: Side, asked: Asked) -> None:
    """As `_bound_all`, for LSR, or for LRL if `three_turns`."""
    for k in range(-1, 4):
        around = TWO_PI * k
        low, high = _span_of(three_turns, around, side, asked)
        if low <= high:
            mid, half = 0.5 * (low + high), 0.5 * (high - low) + FINEST
            _bound_within(three_turns, mid, half, around, side, asked)


@uncounted
def _span_of(three_turns: bool, around: float, side: Side, asked: Asked) -> tuple[float, float]:
    """As `span_of`. Words that are too late to matter now may matter to a part of the set."""
    beat = asked.beat if asked.open_intervals.room >= 0 else beat_of(side, asked)
    return span_of(three_turns, around, side, Window(asked.earliest, beat))


@uncounted
def _bound_within(
    three_turns: bool, mid: float, half: float, around: float, side: Side, asked: Asked
) -> None:
    """As `_bound_by_halves`, within an interval."""
    # of each interval its middle and half its width, and sine and cosine of what is asked for
    stack = asked.work
    part = 0.5 if three_turns else 1.0
    kind = THREE_TURNS if three_turns else OPPOSITE_TURNS
    stack[1, 0], stack[1, 1] = mid, half
    stack[1, 2], stack[1, 3] = sine_and_cosine(part * mid)
    n = 2
    while n > 1:
        n -= 1
        mid, half, s, c = stack[n, 0], stack[n, 1], stack[n, 2], stack[n, 3]
        left = Window(asked.earliest, beat_of(side, asked))
        if three_turns:
            found = three_turns_within(mid, half, s, c, around, side, left)
        else:
            found = opposite_turns_within(mid, half, s, c, around, side, left)
        if (
            asked.open_intervals.room >= 0
            and left.beat < asked.beat
            and (found.time == inf or not found.fine)
        ):
            # words that are too late to matter now may matter to a part of the set
            all_words = _within(kind, mid, half, around, side, asked)
            if found.time == inf and all_words.time < inf:
                _keep(POSSIBLE, kind, mid, half, around, side, asked)
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
            found = three_turns_closely(found, half, s, c, side, asked.work)
            fate = take_all(found, (-1.0, 1.0, -1.0), 2, half, side, asked)
            _keep(fate, kind, mid, half, around, side, asked)
        else:
            spare = half + side.heading
            found = opposite_turns_closely(found, half, s, c, side, asked.work)
            fate = take(found, (1.0, 0.0, -1.0), found.first, spare, side, asked)
            fate = _also_later(fate, found, left, kind, mid, half, around, side, asked)
            _keep(fate, kind, mid, half, around, side, asked)


@uncounted
def _within(
    kind: int, mid: float, half: float, around: float, side: Side, asked: Asked
) -> Interval:
    """What an interval leaves possible, be it soon enough to matter now or not."""
    window = Window(asked.earliest, asked.beat)
    if kind == SAME_TURNS:
        return same_turns(int(around), side, window)
    if kind == THREE_TURNS:
        s, c = sine_and_cosine(0.5 * mid)
        return three_turns_within(mid, half, s, c, around, side, window)
    s, c = sine_and_cosine(mid)
    return opposite_turns_within(mid, half, s, c, around, side, window)


@uncounted
def _also_later(
    fate: int, found: Interval, left: Window, kind: int, mid: float, half: float, around: float,
    side: Side, asked: Asked,
) -> int:  # fmt: skip
    """What words in an interval are, with those that are too late to matter now.

    They may matter to a part of the set: so if there are any, what is said of the others alone is
    not said of all.
    """
    if fate == POSSIBLE or asked.open_intervals.room < 0 or left.beat >= asked.beat:
        return fate
    all_words = _within(kind, mid, half, around, side, asked)
    if all_words.time == inf:
        return IMPOSSIBLE
    longest = found.middle + found.middle_blur
    if found.time < inf and all_words.middle + all_words.middle_blur <= longest:
        return fate
    return POSSIBLE


@uncounted
def _keep(
    fate: int, kind: int, mid: float, half: float, around: float, side: Side, asked: Asked
) -> None:
    """Keep an interval for parts of the set, unless there can be no word in it."""
    if asked.open_intervals.room >= 0 and fate != IMPOSSIBLE:
        word = 3 * side.hand + kind + (LEFT_OUT if fate == CERTAINLY_OUT else 0)
        keep_open(asked.open_intervals, word, mid, half, side.h, around)


@njit(cache=True, nogil=True)
def arrives_at_release(x: float, y: float, h: float, alpha: float, t_release: float) -> bool:
    """Whether a path without the limit may be at the slot just as it opens.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: when the slot opens [R/V_P].
    """
    track = track_of(Goal(0.0, alpha, True), t_release)
    no_leader = Scene(np.zeros((1, 5)), 0.0, 0.0, 0.0, inf)
    meets = soonest(
        Pose(x - track.x, y, h), Blur(0.0, 0.0, 0.0, 0.0, fixed(), fixed()), Velocity(1.0, 0.0),
        Window(0.0, t_release + EDGE), no_sieve(no_leader),
    )  # fmt: skip
    return bool(meets < inf)
