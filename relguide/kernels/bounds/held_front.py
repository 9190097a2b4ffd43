"""How a front goes round from a cell that stops turning where that pays later on.

While the leader turns, who slides along the edge may have to turn away from the leader for a while,
k < 0 (see `junction`). It is sooner then to leave the edge before, straight, and to come back to it
where it turns the other way again. A front that is turned wherever that makes it slower at once
(see `round_turning`) is turned too far before, and can never be turned back. So its turning is held
before, on the course of that straight: by how far from the edge somebody is who left it on a course
when the front may turn again, false position finds the course for which he just touches. Whatever
the course is the front is a bound; this one is the best.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, inf, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import INSIDE
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.round_time import round_anywhere
from relguide.kernels.bounds.round_turning import (
    ANY,
    ARRIVED,
    FAST,
    FREE,
    GOING,
    LATE,
    NO_HOLD,
    ROUNDING,
    UNKNOWN,
    Hold,
    Place,
    bearings_of,
    begins,
    follow,
    leader_then,
    step_of,
)
from relguide.kernels.contact.contact import contact_at

PARTS = 4
"""A front keeps its direction for such a part of a step from cells elsewhere."""
_CLOSER, _FINER = 2e-3, 16  # and of those narrower than this, which may be held as well [rad]
_DEEP = 1e-3  # in a zone he turns away by more than this [rad]
_LEAST = 0.1  # the first course that is tried, as part of the way from `low` to `high`
_ZONES = 3  # no more of them
_TRIES = 6  # courses for each
_NEARLY = 1e-9  # of a heading [rad]
_NEAR = 1e-6  # who passes as close to the edge touches it [R]


class _Zone(NamedTuple):
    """Where who slides turns away from the leader, so that a front cannot be turned with him."""

    low: float
    """How he heads at the end of it, counted the way fronts are turned [rad] …"""
    high: float
    """… and at its beginning [rad]; infinite if there is no such zone."""


@njit(cache=True, nogil=True)
def holds_of(scene: Scene, cell: Cell, way: int, latest: float) -> FloatArray:
    """Where fronts from a cell, elsewhere than on the final leg, are held best.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        latest: what comes later does not matter [R/V_P].

    Returns:
        the fields of a `Hold` in each row, one after another. shape (·, 2)
    """
    holds, count = np.empty((_ZONES, 2)), 0
    if cell.half < _CLOSER and scene.alpha <= FAST:
        place, sense, step = _begins(scene, cell, way), 1.0 - 2.0 * way, step_of(scene) / PARTS
        for _ in range(_ZONES):
            zone = _zone_ahead(scene, place, sense, step, latest)
            if zone.high == inf:
                break
            hold = _hold_before(scene, place, sense, step, latest, zone)
            if hold.until >= latest:
                break
            holds[count, 0], holds[count, 1] = hold
            count += 1
            place, fate = follow(
                scene, place, sense, step, ANY, inf, hold.until, FREE, True, hold
            )  # fmt: skip
            if fate != LATE:
                break
    return holds[:count]


@njit(cache=True, nogil=True)
def slides_from(
    scene: Scene, table: FloatArray, cell: Cell, way: int, latest: float, holds: FloatArray
) -> float:
    """How soon something can be anywhere on the final leg that starts in a cell, elsewhere.

    At a bearing y it is no sooner than this and sense · `round_time(table, way, y)`, and as long as
    `whole_rounds` take. So what is known of the cell, and of y, need not be looked at together.

    Args:
        scene: the leader and d_min.
        table: of `round_time.times_round`.
        cell: of contacts on another leg.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        latest: what is on the final leg no sooner does not matter, and comes back as infinite.
        holds: of `holds_of`, of a cell nearby.

    Returns:
        `UNKNOWN` if a front leaves the disc.
    """
    if scene.alpha > FAST:
        return UNKNOWN
    step = step_of(scene) / (_FINER if cell.half < _CLOSER else PARTS)
    sense, place = 1.0 - 2.0 * way, _begins(scene, cell, way)
    for k in range(len(holds)):
        hold = Hold(holds[k, 0], holds[k, 1])
        end = min(hold.until, latest)
        place, fate = follow(scene, place, sense, step, ANY, inf, end, FREE, True, hold)
        if fate == ARRIVED:
            return UNKNOWN
    return since_of(scene, table, way, place, step, latest)


@njit(cache=True, nogil=True)
def since_of(
    scene: Scene, table: FloatArray, way: int, place: Place, step: float, latest: float
) -> float:
    """As `slides_from`, of a front that is somewhere and is not held from then on.

    Args:
        scene: the leader and d_min.
        table: of `round_time.times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        place: where it is.
        step: how long it keeps its direction [R/V_P].
        latest: as in `slides_from`.
    """
    sense = 1.0 - 2.0 * way
    place, fate = follow(scene, place, sense, step, ANY, inf, latest, FREE, True, NO_HOLD)
    if fate == ARRIVED:
        return UNKNOWN
    if fate == LATE and place.t < scene.leader[-1, 0]:
        return inf
    # a front that may not slide yet is faster, so it has gained most at last
    since = sense * round_anywhere(table, way, place.bearing - scene.leader[-1, 3])
    return float(place.t - slack_of(scene, table, way) - since)


@njit(cache=True, nogil=True)
def slack_of(scene: Scene, table: FloatArray, way: int) -> float:
    """What may be missed of when a front is on the final leg, and of the time round from there."""
    return float(ROUNDING + table[way, -1] * INSIDE / scene.d_min)


@njit(cache=True, nogil=True)
def _begins(scene: Scene, cell: Cell, way: int) -> Place:
    """A front where it begins, at the edge of a cell."""
    low, high = bearings_of(scene, cell)
    return begins(cell.start, high if way == 0 else low)


@njit(cache=True, nogil=True)
def _sliding(scene: Scene, place: Place, sense: float) -> Pose:
    """The pose of who slides where a front is."""
    there = leader_then(scene, place.t)
    return contact_at(scene, place.t, place.bearing - there.h, sense)


@njit(cache=True, nogil=True)
def _zone_ahead(scene: Scene, place: Place, sense: float, step: float, latest: float) -> _Zone:
    """The next zone in which a front is that is not held."""
    low, high, fate = inf, inf, GOING
    while fate == GOING and place.t < latest:
        place, fate = follow(scene, place, sense, step, 1, inf, latest, FREE, True, NO_HOLD)
        slides, course = sense * _sliding(scene, place, sense).h, sense * place.course
        if slides < course - _NEARLY:
            low, high = min(low, slides), course
        elif high < inf:
            if high - low > _DEEP:
                return _Zone(low, high)
            low, high = inf, inf
    return _Zone(inf, inf)


@njit(cache=True, nogil=True)
def _hold_before(
    scene: Scene, place: Place, sense: float, step: float, latest: float, zone: _Zone
) -> Hold:
    """How a front is held best before a zone."""
    low, high = zone.low + _LEAST * (zone.high - zone.low), zone.high - _NEARLY
    at_low, until = _passes(scene, place, sense, step, latest, low)
    at_high, ends = _passes(scene, place, sense, step, latest, high)
    best = Hold(high, ends)
    if at_low < 0.0:
        return Hold(low, until)
    for _ in range(_TRIES):
        if not at_high < 0.0 < at_low:
            break
        course = (low * at_high - high * at_low) / (at_high - at_low)
        at, until = _passes(scene, place, sense, step, latest, course)
        best = Hold(course, until)
        if abs(at) < _NEAR:
            break
        if at > 0.0:
            low, at_low = course, at
            at_high *= 0.5
        else:
            high, at_high = course, at
            at_low *= 0.5
    return best


@njit(cache=True, nogil=True)
def _passes(
    scene: Scene, place: Place, sense: float, step: float, latest: float, course: float
) -> tuple[float, float]:
    """How far from the edge somebody is who left it on a course, when a front may turn again.

    Returns:
        that [R], and when; infinite if the front may not before `latest` [R/V_P].
    """
    hold, begun, turned, fate = Hold(course, inf), -inf, False, GOING
    x, y = 0.0, 0.0
    while fate == GOING and place.t < latest:
        before = place
        place, fate = follow(scene, place, sense, step, 1, inf, latest, FREE, True, hold)
        if begun == -inf and sense * place.course >= course - _NEARLY:
            begun, (x, y, _) = before.t, _sliding(scene, before, sense)
        if begun > -inf:
            away = sense * _sliding(scene, place, sense).h < course - _NEARLY
            if turned and not away:
                there, took = leader_then(scene, place.t), place.t - begun
                x += took * cos(sense * course) - there.x
                y += took * sin(sense * course) - there.y
                return norm(x, y) - scene.d_min, place.t
            turned = turned or away
    return 0.0, inf
