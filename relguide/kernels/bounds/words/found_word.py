"""What a word counts for that an interval leaves possible, and which intervals stay open.

A word counts by what it does at the set: see `junction`. It does not count if it certainly breaks
the limit, or if no costate fits it. Intervals of the words' unknown that a set leaves open are
kept: parts of the set search only these, since their poses are among the set's. Lengths in R, times
in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.borrowed import uncounted
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.breach import Flown, NearWord, Sieve, breach_time
from relguide.kernels.bounds.words.first_order import FIRST_ROW, ROWS
from relguide.kernels.bounds.words.intervals import Interval, Side

SAME_TURNS, OPPOSITE_TURNS, THREE_TURNS = 0, 1, 2
"""What kind a word is: LSL, LSR or LRL, and with 3 more in the mirror."""
LEFT_OUT = 6
"""Added to the kind of words that certainly break the limit."""
MOST = 48
"""Intervals that are kept of a set at most."""
COLUMNS = 5
"""Of what is kept of one: kind of word, middle of the interval and half its width, heading of the
set's middle as the word sees it, and full turns, see `word_bound`."""
UNKNOWN = -1
"""Instead of a row: all words are to be looked at, or nothing is to be kept."""
TANGENT, LASTING = 2, 3
"""Columns of the first row of `Asked.work`, after both turns at the set …"""
_BEAT, _BREACH = 4, 5  # … how late a word may be, where the last one left out broke the limit …
FOUND, LATEST = 6, 7
"""… the time of any word that was found, also of those that were left out; and how late one may
be."""
_COLUMNS = 8
IMPOSSIBLE, CERTAINLY_OUT, POSSIBLE = 0, 1, 2
"""What words in an interval are."""
_STRIDE = 0.02  # least step of the look for a breach [R/V_P]


class OpenIntervals(NamedTuple):
    """Intervals that were left, and room for those that are left now."""

    table: FloatArray
    """Intervals, those of each set together. A row before them begins with how many they are.
    shape (·, COLUMNS)"""
    known: int
    """That row of a set that holds this one, or `UNKNOWN`."""
    room: int
    """And where there is room, or `UNKNOWN`."""


@njit(cache=True, nogil=True)
def all_open() -> OpenIntervals:
    """Nothing is known, and nothing is to be kept."""
    return OpenIntervals(np.empty((0, COLUMNS)), UNKNOWN, UNKNOWN)


@njit(cache=True, nogil=True)
def begin_open(open_intervals: OpenIntervals) -> None:
    """Nothing is kept so far."""
    if open_intervals.room >= 0:
        open_intervals.table[open_intervals.room, 0] = 0.0


@njit(cache=True, nogil=True)
def keep_open(
    open_intervals: OpenIntervals, word: int, mid: float, half: float, heading: float, around: float
) -> None:
    """Keep an interval, if there is room."""
    table, room = open_intervals.table, open_intervals.room
    table[room, 0] += 1.0
    n = int(table[room, 0])
    if n <= MOST:
        n += room
        table[n, 0], table[n, 1], table[n, 2] = word, mid, half
        table[n, 3], table[n, 4] = heading, around


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
    switch: bool
    """Whether there may be a pose in the set at which a path arrives as its turn changes, or has
    flown two turns only; where not, these words are only nearly so."""


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
    latest: float
    """No word meets it later, if that was asked for [R/V_P]."""


class Asked(NamedTuple):
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
    found. The other rows are a stack of intervals, more than halvings of a whole turn to the
    shortest one; then those of `first_order`. shape (FIRST_ROW + ROWS, _COLUMNS)"""
    open_intervals: OpenIntervals
    """What a set that holds this one has left, and takes what is left now."""
    late: bool
    """Whether it matters how late words are."""


NO_JUNCTION = Junction(False, 0, 0.0, False, False, True)
"""Nothing is asked of the turn."""


@njit(cache=True, nogil=True, inline="always")
def nothing_known(beat: float) -> FloatArray:
    """Nothing but `beat` is known: see `Asked.work`."""
    work = np.empty((FIRST_ROW + ROWS, _COLUMNS))
    for k in range(FOUND + 1):
        work[0, k] = beat
    work[0, LASTING] = work[0, _BREACH] = work[0, FOUND] = inf
    work[0, LATEST] = -inf
    return work


@uncounted
def beat_of(side: Side, asked: Asked) -> float:
    """Words of this side that are later do not lower anything."""
    junction, work = asked.junction, asked.work
    if asked.late:
        return asked.beat
    if not junction.asked:
        return float(work[0, 0]) if work[0, 0] > asked.enough else 0.0
    beat = max(work[0, side.hand], work[0, TANGENT] if junction.straight else 0.0)
    if side.hand == junction.outward:
        beat = max(beat, min(work[0, LASTING], work[0, _BEAT]))
    return float(beat)


@uncounted
def take_all(
    found: Interval, signs: tuple[float, float, float], turns: int, half: float, side: Side,
    asked: Asked,
) -> int:  # fmt: skip
    """As `word_bound`, for a word whose outer turns are between none and a full one.

    Args:
        found: what is asked about.
        signs: of the pieces, read backward, but for the mirror.
        turns: how many full turns the first turn may be off.
        half: how much both outer turns together may differ besides [rad].
        side: of which words.
        asked: what is lowered.

    Returns:
        `POSSIBLE`, `CERTAINLY_OUT` or `IMPOSSIBLE`.
    """
    fate = IMPOSSIBLE
    for j in range(turns):
        first = found.first + TWO_PI * j
        other, spare = found.turned - first, found.astray + half + side.heading
        if (
            -found.astray - side.end <= first <= TWO_PI + found.astray + side.end
            and -spare <= other <= TWO_PI + spare
            and not (
                signs[1] != 0.0 and _has_lesser_middle(found, first, other, spare, asked.junction)
            )
        ):
            fate = max(fate, take(found, signs, first, spare, side, asked))
    return fate


@uncounted
def take(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float, side: Side,
    asked: Asked,
) -> int:  # fmt: skip
    """As `take_all`, for one first turn; the turn at the set may differ by `spare`."""
    junction, work, time = asked.junction, asked.work, found.time
    if time >= asked.beat or found.latest < asked.earliest:
        return IMPOSSIBLE
    work[0, FOUND] = time
    hand = side.hand if junction.asked else 0
    sooner, tangent, lasts = time < work[0, hand], False, inf
    if junction.asked:
        if junction.straight and time < work[0, TANGENT]:
            tangent = _costate_vanishes(found, signs, first, spare, side, junction)
        if side.hand == junction.outward and time < work[0, LASTING]:
            lasts = time + _lasted(found, signs, first, spare, junction)
            if lasts >= work[0, LASTING]:
                lasts = inf
    later = asked.late and found.latest > work[0, LATEST]
    if later and side.hand != junction.outward and not junction.inward:
        later = junction.straight and _costate_vanishes(found, signs, first, spare, side, junction)
    if not (sooner or tangent or lasts < inf or later):
        return POSSIBLE
    if _is_ruled_out(found, signs, first, side, asked):
        return CERTAINLY_OUT
    if sooner:
        work[0, hand] = time
    if tangent:
        work[0, TANGENT] = time
    if lasts < inf:
        work[0, LASTING] = lasts
    if later:
        work[0, LATEST] = found.latest
    return POSSIBLE


@uncounted
def _has_lesser_middle(
    found: Interval, first: float, other: float, spare: float, junction: Junction
) -> bool:
    """Whether the middle of three turns is certainly less than an outer one: then no costate fits.

    λ_ψ vanishes on a line, on which both switches lie: so it would again, as long after the second
    and before the first (see `costate`). With two turns only, it may be any line.
    """
    middle, three = found.middle + found.middle_blur, junction.asked and not junction.switch
    return (first - found.astray > middle and (three or other > spare)) or (
        other - spare > middle and (three or first > found.astray)
    )


@uncounted
def _is_free(
    found: Interval, signs: tuple[float, float, float], first: float, junction: Junction
) -> bool:
    """Whether the word may have two turns only, so that the costate vanishes anywhere."""
    if not junction.switch:
        return False
    return first <= found.astray if signs[1] != 0.0 else found.shortest <= 0.0


@uncounted
def _costate_vanishes(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float, side: Side,
    junction: Junction,
) -> bool:  # fmt: skip
    """Whether λ_ψ may vanish at the set.

    That is on the straight, a full turn from it, and as far from the middle of three turns as that
    is long. Arguments as `take`.
    """
    turn = found.turned - first
    if turn <= spare:
        return True
    if side.hand != junction.outward and not junction.inward:
        return False
    back = signs[1] != 0.0 and abs(turn - found.middle) <= spare + found.middle_blur
    return _is_free(found, signs, first, junction) or back or abs(turn - TWO_PI) <= spare


@uncounted
def _lasted(
    found: Interval, signs: tuple[float, float, float], first: float, spare: float,
    junction: Junction,
) -> float:  # fmt: skip
    """How long the turn was there before the set, at least. Arguments as `take`."""
    if _is_free(found, signs, first, junction):
        return 0.0
    whole = found.shortest if signs[1] != 0.0 else TWO_PI
    turn = found.turned - first
    return max(min(whole - turn - spare, junction.beyond), 0.0)


@uncounted
def _is_ruled_out(
    found: Interval, signs: tuple[float, float, float], first: float, side: Side, asked: Asked
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
    begin, astray = sieve.low, 0.0
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
