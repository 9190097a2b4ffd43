"""When fronts from a cell of contacts are at another cell, or on the final leg.

A front that goes round from a cell (see `front`) is the same for every other cell that is asked
for, until it has to wait for that cell's heading. A proof asks for hundreds of other cells. So the
places where a front has been are kept, every so many steps, and the front is followed on from
there. A front that is kept later may overwrite them; then the front is followed anew.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import round_anywhere, round_bound, round_over
from relguide.kernels.bounds.fronts.front import (
    ANY,
    ARRIVED,
    FAST,
    FREE,
    GOING,
    LATE,
    ROUNDING,
    SLIDES,
    UNKNOWN,
    Headings,
    Place,
    bearings_of,
    begins,
    follow,
    inside_share,
    step_of,
)
from relguide.kernels.bounds.words.breach import INSIDE
from relguide.kernels.bounds.words.cells import Cell, poses_of
from relguide.kernels.bounds.words.junction import slide_turns
from relguide.kernels.bounds.words.sets import EDGE
from relguide.kernels.contact.nodes import IntArray

KEPT = 8191
"""Fronts at most: a prime number, so that those of neighbours do not share a place."""
_PLACES = 96  # that are kept of one
_T, _BEARING, _COURSE, _SWEPT, _MOST, _COLUMNS = 0, 1, 2, 3, 4, 5
_OWNER, _COUNT, _ENDED = 0, 1, 2
_CLOSE, _CLOSER = 0.05, 2e-3  # cells narrower than this are looked at closely [rad]
_PARTS = (1.0, 4.0, 16.0)  # of a step, for wide cells, close ones, and closer ones
_STRIDES = (4, 8, 32, 8)  # so many steps lie between places that are kept; the last where one turns
_KINDS = 4
_TURNS = 3  # kind of a front that must turn from the first cell's heading


class Fronts(NamedTuple):
    """Where fronts have been that go round from cells of contacts."""

    places: FloatArray
    """The fields of `Place` of each front, one place after another. shape (KEPT, _PLACES, 5)"""
    kept: IntArray
    """Whose they are, how many there are, and whether nothing comes after them. shape (KEPT, 3)"""


@njit(cache=True, nogil=True)
def begin_fronts() -> Fronts:
    """None has been followed."""
    return Fronts(np.empty((KEPT, _PLACES, _COLUMNS)), np.full((KEPT, 3), -1))


@njit(cache=True, nogil=True)
def round_arrival(
    fronts: Fronts, n: int, scene: Scene, table: FloatArray, cell: Cell, other: Cell, latest: float
) -> float:
    """How soon something that starts in a cell of contacts can be in another one [R/V_P].

    Args:
        fronts: takes where fronts from the cell have been.
        n: number of the cell, always of this one.
        scene: the leader and d_min.
        table: of `round_time.times_round`.
        cell: from which it starts; its window of time has an end.
        other: to which it goes.
        latest: arrivals from here on do not matter, and come back as infinite.
    """
    low, high = bearings_of(scene, cell)
    begin, end = bearings_of(scene, other)
    blur = 0.5 * (high - low) + 0.5 * (end - begin)
    apart = 0.5 * (begin + end) - 0.5 * (low + high)
    soonest, width = inf, max(cell.half, other.half)
    kind = 0 if width >= _CLOSE else 1 if width >= _CLOSER else 2
    # the shorter way first: it ends the search along the other
    shorter = 0 if wrap(apart) < pi else 1
    for way in (shorter, 1 - shorter):
        sense = 1.0 - 2.0 * way
        angle = wrap(sense * apart) - blur
        if angle <= 0.0 or angle + 2.0 * blur >= TWO_PI or scene.alpha > FAST:
            return cell.start
        since, end = begins(cell.start, high if way == 0 else low), min(latest, soonest)
        number = _KINDS * (2 * n + way)
        arrival = _arrives_freely(fronts, number + kind, scene, table, since, way, angle, end)
        slides = _may_slide(scene, cell, sense) and _may_slide(scene, other, sense)
        if arrival < end and kind > 0 and not slides:
            headings = _headings_of(scene, cell, other, end)
            end = min(end, headings.until)
            closer = _arrives(fronts, number + _TURNS, scene, since, sense, angle, end, headings)
            arrival = max(arrival, closer)
        soonest = min(soonest, arrival)
    return soonest


@njit(cache=True, nogil=True)
def _may_slide(scene: Scene, cell: Cell, sense: float) -> bool:
    """Whether a path that touches in a cell may slide along the edge that way, for all we know.

    Then it does not matter how it heads.
    """
    return cell.side == sense and slide_turns(scene, cell)[0] <= 1.0


@njit(cache=True, nogil=True)
def _headings_of(scene: Scene, cell: Cell, other: Cell, latest: float) -> Headings:
    """The headings of contacts of a cell, and of contacts of another to which something goes."""
    first, last = poses_of(scene, cell), poses_of(scene, other)
    return Headings(
        first.middle.h, first.differs, cell.start,
        last.middle.h, last.differs, min(latest, other.end + EDGE),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _arrives_freely(
    fronts: Fronts, number: int, scene: Scene, table: FloatArray, since: Place, way: int,
    angle: float, latest: float,
) -> float:  # fmt: skip
    """When a front has swept an angle that needs no time to turn; infinite from `latest` on.

    Arguments as `_go_on`.
    """
    sense, step = 1.0 - 2.0 * way, step_of(scene) / _PARTS[number % _KINDS]
    at = _go_on(fronts, number, scene, since, sense, step, angle, latest, FREE)
    place = _last_before(fronts, at, angle)
    place, fate = follow(scene, place, sense, step, ANY, angle, latest, FREE, True)
    t, left = place.t, angle - place.swept
    if fate == SLIDES and t < latest:
        edge = wrap_signed(place.bearing - scene.leader[-1, 3])
        t += round_over(table, way, edge, left) * inside_share(scene)
    return t - ROUNDING if fate != LATE and t < latest else inf


@njit(cache=True, nogil=True)
def _arrives(
    fronts: Fronts, number: int, scene: Scene, since: Place, sense: float, angle: float,
    latest: float, headings: Headings,
) -> float:  # fmt: skip
    """When a front has swept an angle that must turn; infinite from `latest` on.

    Arguments as `_go_on`; `headings` are those from the one cell to the other.
    """
    step = step_of(scene) / _PARTS[1]
    alone = Headings(
        headings.first, headings.first_differs, headings.since, 0.0, inf, inf
    )  # fmt: skip
    at = _go_on(fronts, number, scene, since, sense, step, angle, latest, alone)
    place = _last_unaware(fronts, at, angle, headings)
    place, fate = follow(scene, place, sense, step, ANY, angle, latest, headings, False)
    return place.t - ROUNDING if fate != LATE and place.t < latest else inf


@njit(cache=True, nogil=True)
def _go_on(
    fronts: Fronts, number: int, scene: Scene, since: Place, sense: float, step: float,
    angle: float, latest: float, headings: Headings,
) -> int:  # fmt: skip
    """Follow a front until it has swept an angle, or as far as there is room.

    Args:
        fronts: takes where it has been.
        number: of the front, which says its cell, which way it goes and its kind.
        scene: the leader and d_min.
        since: where it begins.
        sense: as in `Front`.
        step: how long it keeps its direction [R/V_P].
        angle: how far it is to sweep [rad].
        latest: when to end [R/V_P].
        headings: how something heads that goes with it.

    Returns:
        where in `fronts` it is.
    """
    at, kind = number % KEPT, number % _KINDS
    kept, places = fronts.kept[at], fronts.places[at]
    if kept[_OWNER] != number:
        kept[_OWNER], kept[_COUNT], kept[_ENDED] = number, 1, 0
        _put(places, 0, since)
    last = int(kept[_COUNT]) - 1
    while (
        kept[_ENDED] == 0
        and last + 1 < _PLACES
        and places[last, _MOST] < angle
        and places[last, _T] < latest
    ):
        place, fate = follow(
            scene, _place(places, last), sense, step, _STRIDES[kind], inf, inf, headings,
            kind != _TURNS,
        )  # fmt: skip
        last += 1
        _put(places, last, place)
        if fate == ARRIVED:
            places[last, _MOST] = inf  # the front has left the disc
        kept[_COUNT], kept[_ENDED] = last + 1, 0 if fate == GOING else 1
    return at


@njit(cache=True, nogil=True)
def _last_before(fronts: Fronts, at: int, angle: float) -> Place:
    """The last place that is kept before a front had swept an angle."""
    places, low, high = fronts.places[at], 0, int(fronts.kept[at, _COUNT])
    while high - low > 1:
        middle = (low + high) // 2
        if places[middle, _MOST] < angle:
            low = middle
        else:
            high = middle
    return _place(places, low)


@njit(cache=True, nogil=True)
def _last_unaware(fronts: Fronts, at: int, angle: float, headings: Headings) -> Place:
    """As `_last_before`, and before it had to wait for the heading on which something ends."""
    places, count, k = fronts.places[at], int(fronts.kept[at, _COUNT]), 0
    while k + 1 < count and places[k + 1, _MOST] < angle:
        then = places[k + 1]
        # e turns one way only
        turned = abs(then[_COURSE] - places[k, _COURSE])
        turns = abs(wrap_signed(then[_COURSE] - headings.last)) + turned
        if min(turns, pi) - headings.last_differs > headings.until - then[_T]:
            break
        k += 1
    return _place(places, k)


@njit(cache=True, nogil=True)
def _place(places: FloatArray, k: int) -> Place:
    row = places[k]
    return Place(row[_T], row[_BEARING], row[_COURSE], row[_SWEPT], row[_MOST])


@njit(cache=True, nogil=True)
def _put(places: FloatArray, k: int, place: Place) -> None:
    row = places[k]
    row[_T], row[_BEARING], row[_COURSE] = place.t, place.bearing, place.course
    row[_SWEPT], row[_MOST] = place.swept, place.most


@njit(cache=True, nogil=True)
def round_between(
    fronts: Fronts, n: int, scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float
) -> float:
    """How soon a path can be at a contact of the other cell from one of this, round the leader.

    Arguments as `contact_bound.cell_bound`, `round_bound` and `round_arrival`; infinite from `beat`
    on.
    """
    if other.end < cell.start:
        return inf
    apart = other.start - cell.end
    beat = min(beat, other.end - cell.start + EDGE)
    if apart < beat and min(cell.piece, other.piece) + 1 == len(scene.leader):
        apart = max(
            apart, min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
        )
    elif apart < beat:
        arrival = round_arrival(fronts, n, scene, table, cell, other, cell.start + beat)
        apart = max(apart, arrival - cell.start)
    return apart if apart < beat else inf


@njit(cache=True, nogil=True)
def slides_from(scene: Scene, table: FloatArray, cell: Cell, way: int, latest: float) -> float:
    """How soon a path that starts in a cell on another leg can be anywhere on the final leg.

    It is at a bearing y no sooner than this and sense · `round_time(table, way, y)`, and as long as
    `whole_rounds` take. So the cell and y can each be looked at alone.

    Args:
        scene: the leader and d_min.
        table: of `round_time.times_round`.
        cell: of contacts on another leg.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        latest: arrivals on the final leg from here on do not matter, and come back as infinite.

    Returns:
        `UNKNOWN` if a front leaves the disc.
    """
    if scene.alpha > FAST:
        return UNKNOWN
    step = step_of(scene) / (_PARTS[2] if cell.half < _CLOSER else _PARTS[1])
    sense, (low, high) = 1.0 - 2.0 * way, bearings_of(scene, cell)
    place = begins(cell.start, high if way == 0 else low)
    place, fate = follow(scene, place, sense, step, ANY, inf, latest, FREE, True)
    if fate == ARRIVED:
        return UNKNOWN
    if fate == LATE and place.t < scene.leader[-1, 0]:
        return inf
    # a front that may not slide yet is faster, so it has gained most at last
    since = sense * round_anywhere(table, way, place.bearing - scene.leader[-1, 3])
    # fronts go round inside the edge
    slack = ROUNDING + table[way, -1] * INSIDE / scene.d_min
    return float(place.t - slack - since)
