"""How soon something is round the leader that turns at full bank at most: fronts that fall behind.

As `held_front`, with all that something falls behind where no bank is enough: see `falls`. After a
fall the front goes on from where its line is then. Who has his last contact before a fall is over
has fallen behind by less: that is known for some places where he may have it. Slot frame: lengths
in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.falls import (
    NO_FALL,
    Fall,
    best_fall,
    fall_from_contact,
    grown,
    is_least,
    lost_by_turning,
    turn_between,
)
from relguide.kernels.bounds.held_front import PARTS, since_of, slack_of
from relguide.kernels.bounds.round_time import round_anywhere
from relguide.kernels.bounds.round_turning import (
    ANY,
    ARRIVED,
    FAST,
    FREE,
    LATE,
    NO_HOLD,
    UNKNOWN,
    Hold,
    Place,
    bearings_of,
    begins,
    follow,
    leader_then,
    step_of,
)
from relguide.kernels.bounds.slides import AHEAD, AT, BEARING, TURNED, slide_of, turns_at

LEVELS = 20
"""Rows of `lags_from`."""
SINCE, PAST = 0, 1
"""And its columns."""
_FALLS = 3  # one after another
_STEPS = 60  # until a front may slide again
_TRIED = 12  # of places where who has his last contact before the change may have left the edge
_SHARES = (0.98, 0.8, 0.65, 0.5, 0.4, 0.32, 0.25, 0.2, 0.16, 0.12, 0.09, 0.06, 0.04, 0.025, 0.015)
"""Of how far behind one falls: from where on last contacts that are nearer are so late."""
_NEARLY = 1e-9  # of a heading [rad]
_MISSED = 1e-6  # of how V grows [R]
_CERTAIN = 0.999  # part of how much less far round something is, by steps


@njit(cache=True, nogil=True)
def no_lags() -> FloatArray:
    """Nothing is known: see `lags_from`."""
    lags = np.zeros((LEVELS, 2))
    lags[:, SINCE] = -inf
    return lags


@njit(cache=True, nogil=True)
def lags_from(
    scene: Scene, table: FloatArray, cell: Cell, way: int, latest: float, holds: FloatArray
) -> FloatArray:
    """How soon something is on the final leg that has its first and its last contact on one side.

    Args:
        scene: the leader and d_min.
        table: of `times_round`.
        cell: of first contacts, which pass this way; its window of time has an end.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        latest: what is on the final leg no sooner does not matter [R/V_P].
        holds: of `held_front.holds_of`.

    Returns:
        in each row that, as `slides_from` counts, of who has his last contact no nearer than at a
        bearing, and that bearing, as `Place` counts, less the slot's heading [R/V_P, rad]. Those
        are the later, the further round; −∞ where nothing is known. shape (LEVELS, 2)
    """
    sense, step = 1.0 - 2.0 * way, step_of(scene) / PARTS
    low, high = bearings_of(scene, cell)
    place = begins(cell.start, high if way == 0 else low)
    lags, touches, fallen = no_lags(), True, False
    if scene.alpha > FAST:
        return lags
    for k in range(len(holds)):
        hold = Hold(holds[k, 0], holds[k, 1])
        end = min(hold.until, latest)
        place, falls = _fall_before(scene, cell, place, sense, end, hold, touches)
        touches, fallen = False, fallen or falls
        place, fate = follow(scene, place, sense, step, ANY, inf, end, FREE, True, hold)
        if fate != LATE:
            return lags
    for _ in range(_FALLS):
        place, slides = _until_sliding(scene, place, sense, latest, NO_HOLD)
        if not slides:
            break
        if fallen and lags[0, SINCE] == -inf and place.t < scene.leader[-1, 0]:
            since = since_of(scene, table, way, place, step, latest)
            _put(lags, since, -sense * inf, sense)
        rows = slide_of(scene, place, sense, latest, inf)
        fall = _first_fall(scene, cell, rows, touches)
        touches, behind = False, _behind(scene, rows, fall)
        if behind <= 0.0:
            break
        _put_fall(lags, scene, table, way, rows, fall, behind, latest)
        place = _line_behind(scene, rows, fall, _certainly(rows, fall, behind), sense)
        if place.t == inf:
            break
    return lags


@njit(cache=True, nogil=True)
def lag_at(lags: FloatArray, bearing: float, sense: float) -> float:
    """What `lags_from` says of who has his last contact at a bearing, or further round."""
    for k in range(LEVELS):
        if sense * (bearing - lags[k, PAST]) >= 0.0:
            return float(lags[k, SINCE])
    return -inf


@njit(cache=True, nogil=True)
def _put(lags: FloatArray, since: float, past: float, sense: float) -> None:
    """Put down that, in place of what says no more; the least are left out if there is no room."""
    if since <= max(UNKNOWN, lag_at(lags, past, sense)):
        return
    k, count = 0, 0
    kept = no_lags()
    while k < LEVELS and lags[k, SINCE] > since:
        kept[count] = lags[k]
        k, count = k + 1, count + 1
    if count < LEVELS:
        kept[count, SINCE], kept[count, PAST] = since, past
        count += 1
    while k < LEVELS and count < LEVELS:
        if lags[k, SINCE] > -inf and sense * (lags[k, PAST] - past) < 0.0:
            kept[count] = lags[k]
            count += 1
        k += 1
    lags[:] = kept


@njit(cache=True, nogil=True)
def _fall_before(
    scene: Scene, cell: Cell, place: Place, sense: float, end: float, hold: Hold, touches: bool
) -> tuple[Place, bool]:
    """Where a front is after falls on a slide that ends where it is held; whether any falls."""
    falls = False
    for _ in range(_FALLS):
        at, slides = _until_sliding(scene, place, sense, end, hold)
        if not slides:
            break
        rows = slide_of(scene, at, sense, end, hold.course)
        fall = _first_fall(scene, cell, rows, touches)
        touches, behind = False, _behind(scene, rows, fall)
        if behind <= 0.0:
            break
        at = _line_behind(scene, rows, fall, _certainly(rows, fall, behind), sense)
        if at.t == inf:
            break
        place, falls = at, True
    return place, falls


@njit(cache=True, nogil=True)
def _first_fall(scene: Scene, cell: Cell, rows: FloatArray, touches: bool) -> Fall:
    """The best fall on a slide; or the best that ends before that begins, if there is any.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        rows: of `slide_of`.
        touches: whether the slide begins in one of these contacts.
    """
    fall, within = best_fall(rows), rows
    for _ in range(2):
        if touches:
            other = _fall_from_cell(scene, cell, within)
            if other.lag > fall.lag:
                fall = other
        within = rows[:, : fall.begin + 1]
        sooner = best_fall(within)
        if sooner.lag <= 0.0:
            break
        fall = sooner
    return fall


@njit(cache=True, nogil=True)
def _fall_from_cell(scene: Scene, cell: Cell, rows: FloatArray) -> Fall:
    """As `fall_from_contact`, of all contacts of a cell, where the slide begins at its edge."""
    fall = fall_from_contact(rows)
    if fall.end < 0:
        return NO_FALL
    low, high = bearings_of(scene, cell)
    span = cell.end - cell.start
    # to first order V is no less than 0 beside the edge
    apart = high - low + span * (1.0 + scene.alpha) / scene.d_min
    r, _ = grown(rows, 0, fall.turn, fall.end)
    less = scene.d_min * apart * apart + 1.5 * span * r * max(turns_at(rows, 0) - 1.0, 0.0)
    return Fall(fall.lag - less, 0, 0, fall.end, fall.turn, fall.scale, fall.off)


@njit(cache=True, nogil=True)
def _behind(scene: Scene, rows: FloatArray, fall: Fall) -> float:
    """How V grows in a fall, less what may be missed [R]; no more than 0 if nothing is known.

    Where the vector changes something may be nearer the leader than the tangent there, as it is
    behind and the disc is round.
    """
    if fall.end < 0:
        return 0.0
    less = _MISSED
    if fall.change > fall.begin:
        before = rows[TURNED, fall.change] - rows[TURNED, fall.begin]
        after = rows[TURNED, fall.end] - rows[TURNED, fall.change]
        outward = (fall.scale * sin(after) + sin(before)) / sin(rows[AHEAD, fall.change])
        # twice as far round as at the end
        astray = 2.0 * _lags_round(scene, rows, fall, fall.lag * fall.scale)
        less += outward * scene.d_min * 0.5 * astray * astray
    return fall.lag * fall.scale - less


@njit(cache=True, nogil=True)
def _lags_round(scene: Scene, rows: FloatArray, fall: Fall, behind: float) -> float:
    """How much less far round the line is at the end of a fall [rad]; infinite if it is nowhere."""
    ahead = rows[AHEAD, fall.end]
    reached = cos(ahead) - behind / (fall.scale * scene.d_min)
    return acos(reached) - ahead if -1.0 < reached < 1.0 else inf


@njit(cache=True, nogil=True)
def _line_behind(scene: Scene, rows: FloatArray, fall: Fall, behind: float, sense: float) -> Place:
    """Where the front is that is as far behind as something falls; at no time if it is nowhere."""
    lags, end = _lags_round(scene, rows, fall, behind), fall.end
    if lags == inf:
        return Place(inf, 0.0, 0.0, 0.0, 0.0)
    bearing = rows[BEARING, end]
    return Place(
        rows[AT, end], bearing - sense * lags, bearing + sense * rows[AHEAD, end], 0.0, 0.0
    )


@njit(cache=True, nogil=True)
def _certainly(rows: FloatArray, fall: Fall, behind: float) -> float:
    """How V grows by the end of a fall, of whoever turns off as well [R]."""
    return min(behind, fall.scale * lost_by_turning(rows, fall))


@njit(cache=True, nogil=True)
def _until_sliding(
    scene: Scene, place: Place, sense: float, latest: float, hold: Hold
) -> tuple[Place, bool]:
    """Follow a front until it may be turned to where someone sliding heads; whether it may be."""
    step = step_of(scene) / PARTS
    for _ in range(_STEPS):
        ahead = acos(scene.alpha * cos(place.bearing - leader_then(scene, place.t).h))
        if place.t >= latest:
            break
        if sense * (place.course - place.bearing) <= ahead + _NEARLY:
            return place, True
        place, fate = follow(scene, place, sense, step, 1, inf, latest, FREE, False, hold)
        if fate == ARRIVED:
            break
    return place, False


@njit(cache=True, nogil=True)
def _put_fall(
    lags: FloatArray, scene: Scene, table: FloatArray, way: int, rows: FloatArray, fall: Fall,
    behind: float, latest: float,
) -> None:  # fmt: skip
    """Put down what a fall says of who comes to the final leg."""
    sense, at, step = 1.0 - 2.0 * way, fall.end, step_of(scene) / PARTS
    place = _line_behind(scene, rows, fall, 0.0, sense)
    freely = since_of(scene, table, way, place, step, latest)
    place = _line_behind(scene, rows, fall, behind, sense)
    if not UNKNOWN < freely < inf or place.t == inf:
        return
    # by when he has his last contact who turns off has turned back, too
    lost = 2.0 * lost_by_turning(rows, fall) / (1.0 + scene.alpha)
    since = min(since_of(scene, table, way, place, step, latest), freely + lost)
    ends, heading = float(scene.leader[-1, 0]), float(scene.leader[-1, 3])
    slack = slack_of(scene, table, way)
    if rows[AT, at] <= ends:
        _put(lags, since, -sense * inf, sense)
        return
    least = since
    for k in range(len(_SHARES)):
        wanted = freely + _SHARES[k] * (since - freely)
        while at > 0 and rows[AT, at - 1] >= ends:
            then = _since_at(scene, table, way, rows, fall, behind, at - 1) - slack
            if then < wanted:
                break
            at -= 1
            least = min(least, then)
        _put(lags, least, rows[BEARING, at] - heading, sense)


@njit(cache=True, nogil=True)
def _since_at(
    scene: Scene, table: FloatArray, way: int, rows: FloatArray, fall: Fall, behind: float, i: int
) -> float:
    """The same of who has his last contact when the front is at a point."""
    if i >= fall.change:
        turn = max(fall.turn - (rows[AT, i] - rows[AT, fall.change]), 0.0)
        r, rest = grown(rows, i, turn, fall.end)
        turned = rows[TURNED, fall.end] - rows[TURNED, i]
        vector = fall.scale * cos(turned), fall.scale * sin(turned), fall.scale * r
        return _at_contact(scene, table, way, rows, i, vector, behind - fall.scale * rest)
    # the vector need not change before it
    best, step = -inf, max((i - fall.begin) // _TRIED, 1)
    for begin in range(fall.begin, i, step):
        turn, turned = turn_between(rows, begin, i), rows[TURNED, i] - rows[TURNED, begin]
        if rows[AHEAD, i] <= turned or not is_least(turned, turn, fall.off):
            continue
        r, grows = grown(rows, i, turn, begin)
        vector = cos(turned), -sin(turned), r
        best = max(best, _at_contact(scene, table, way, rows, i, vector, grows - _MISSED))
    return best


@njit(cache=True, nogil=True)
def _at_contact(
    scene: Scene, table: FloatArray, way: int, rows: FloatArray, i: int,
    vector: tuple[float, float, float], behind: float,
) -> float:  # fmt: skip
    """When something is in a contact, less the time round to there, that is behind at a point.

    How far round it is follows from V, which grows as that falls.

    Args:
        scene: the leader and d_min.
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        rows: of `slide_of`.
        i: the point.
        vector: m, p and r there.
        behind: V there [R].
    """
    sense, ahead, d_min, (m, p, r) = 1.0 - 2.0 * way, rows[AHEAD, i], scene.d_min, vector
    bearing = rows[BEARING, i] - leader_then(scene, rows[AT, i]).h
    slope = d_min * (m * sin(ahead) + p * cos(ahead)) + r
    if behind <= 0.0 or slope <= 0.0:
        return -inf
    lags = behind / slope
    for _ in range(4):
        less = acos(scene.alpha * cos(bearing - sense * lags))
        value = m * d_min * (cos(ahead) - cos(ahead + lags))
        value += p * d_min * (sin(ahead + lags) - sin(ahead)) + r * (ahead - less + lags)
        if value <= 0.0:
            return -inf
        lags *= behind / value
    at = rows[BEARING, i] - sense * _CERTAIN * lags - scene.leader[-1, 3]
    return float(rows[AT, i] - sense * round_anywhere(table, way, at))
