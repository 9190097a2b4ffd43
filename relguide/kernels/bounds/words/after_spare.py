"""Where a path goes after a contact to which it came with time to spare, until it touches again.

The costate is zero up to such a contact (see `junction`). After it λ_p points along the line from
the leader to the contact, with λ_ψ = 0. So nothing is left to choose: the path turns away from the
leader until it is on that line again, for 2γ with γ = arccos(α cos b), then the other way for as
long, and so on, outward along the line. It never flies straight, since its heading is off the line
by γ whenever it is on it. All this holds whatever the leader does, until the path touches again or
arrives. So of all such contacts only those matter from which that one path does.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.cell_words import later_bound
from relguide.kernels.bounds.words.cells import Cell, Poses, fastest_turn, poses_of
from relguide.kernels.bounds.words.junction import (
    growing_for,
    jerk_of,
    leaves_for,
    left_of_piece,
    parted_by,
    slide_turns,
)
from relguide.kernels.bounds.words.sets import EDGE, Goal, unknown_sensitivity
from relguide.kernels.separation.clearance import leader_at, leader_heading, piece_at, piece_end
from relguide.kernels.words.extremals import fly_piece

_LEAST = 0.3  # if the path turns by less than this at a time, it is not followed [rad]
_PART = 0.2  # shortest step, as part of the size of a cell [R/V_P],
_FINEST, _COARSE = 1e-4, 0.02  # but no less than this, and once the path may touch, than that
_PART_OF = 0.99  # so that rounding does not count
_STEPS = 1_000  # no more of them


class Onward(NamedTuple):
    """What such a path comes to."""

    goal: float
    """How long after the contact it can be at the goal, at least; infinite if it cannot be."""
    contact: float
    """How long after it can touch again, at least; infinite if it cannot."""
    again: float
    """How long after it can be at the goal if it touches again, at least; infinite if not."""


@njit(cache=True, nogil=True)
def after_spare(scene: Scene, goal: Goal, cell: Cell, left: float) -> Onward:
    """What paths come to that have time to spare before a contact of a cell.

    The path from the middle of the cell is followed, with what others may differ from it.

    Args:
        scene: the leader and d_min.
        goal: where they are to arrive.
        cell: of contacts; its window of time has an end.
        left: arrivals and contacts after this do not matter [R/V_P].
    """
    poses = poses_of(scene, cell)
    turn = _turn_of(scene, cell)
    # γ may change without bound where the leader is as fast
    if poses.differs == inf or turn < _LEAST or scene.alpha > 1.0 - EDGE:
        return Onward(0.0, 0.0, 0.0)
    contact, until = _followed(scene, cell, poses.middle, poses.t, poses.span, turn, left)
    soonest, begun, pose, sense, parts = inf, 0.0, poses.middle, -cell.side, 1
    while begun <= until:
        off, _, _ = _parted(scene, cell, poses.span, parts, 0.0)
        _, astray, _ = _parted(scene, cell, poses.span, parts, begun + turn + off)
        needed = wrap(-sense * pose.h)
        if turn + 2.0 * off > TWO_PI - EDGE:
            soonest = begun
            break
        if needed > TWO_PI - off - EDGE:
            needed = 0.0
        if needed <= turn + off + EDGE and begun + needed <= until + off + EDGE:
            at, t = fly_piece(pose, sense, needed), poses.t + begun + needed
            strays = astray + (1.0 + goal.speed) * (off + EDGE)
            strays += (scene.alpha + goal.speed) * poses.span
            if norm(at.x - goal.x - goal.speed * t, at.y) <= strays + EDGE:
                soonest = max(begun + needed - off - EDGE, 0.0)
                break
        pose, begun, sense, parts = fly_piece(pose, sense, turn), begun + turn, -sense, parts + 1
    again = inf
    if contact < inf:
        there, until = before_touching(scene, cell, contact)
        again = max(later_bound(scene, goal, cell, there, until, left), contact)
    return Onward(soonest, contact, again)


@njit(cache=True, nogil=True)
def before_touching(scene: Scene, cell: Cell, contact: float) -> tuple[Poses, float]:
    """Where those paths are that touch again, shortly before they do.

    Args:
        scene: as in `after_spare`.
        cell: likewise.
        contact: of `Onward` [R/V_P].

    Returns:
        where, and how long after the contact [R/V_P].
    """
    poses, changes = poses_of(scene, cell), _turn_changes(scene, cell)
    turn = _turn_of(scene, cell)
    # before any of them ends a turn, and not until all have begun it
    begun = int(contact / turn) if turn > _LEAST else 0
    until = min(contact, (begun + 1) * (turn - changes))
    if until < begun * (turn + changes):
        until, begun = begun * (turn - changes), begun - 1
    if until <= begun * (turn + changes) or changes > turn:
        return poses, 0.0
    pose, sense, differs = poses.middle, -cell.side, poses.differs
    kept = poses.left if sense > 0.0 else poses.right
    for _ in range(begun):
        pose, sense = fly_piece(pose, sense, turn), -sense
        # the centre of the next turn lies across from where this one ends
        kept += 2.0 * (differs + changes)
    # they head otherwise where a turn begins, and by when it does
    differs += changes * (begun + 1 if begun > 0 else 0)
    pose = fly_piece(pose, sense, until - begun * turn)
    other = kept + 2.0 * differs
    left, right = (kept, other) if sense > 0.0 else (other, kept)
    there = Poses(
        poses.t + until,
        poses.span,
        pose,
        poses.vx,
        poses.vy,
        differs,
        left,
        right,
        unknown_sensitivity(),
    )
    return there, until


@njit(cache=True, nogil=True)
def _turn_of(scene: Scene, cell: Cell) -> float:
    """How long each turn is after the contact in the middle of a cell [rad]."""
    return 2.0 * acos(min(max(scene.alpha * cos(cell.bearing), -1.0), 1.0))


@njit(cache=True, nogil=True)
def _turn_changes(scene: Scene, cell: Cell) -> float:
    """How much the length of a turn may differ from that of the middle of the cell [rad]."""
    low, high = abs(cos(cell.bearing - cell.half)), abs(cos(cell.bearing + cell.half))
    along = scene.alpha * max(low, high)
    # γ changes no faster than this with the bearing, nor than the bearing
    return 2.0 * min(scene.alpha / sqrt(1.0 - along * along), 1.0) * cell.half


@njit(cache=True, nogil=True)
def _parted(
    scene: Scene, cell: Cell, span: float, parts: int, took: float
) -> tuple[float, float, float]:
    """How much paths of a cell differ from that of its middle in so many turns.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        span: half of its window of time [R/V_P].
        parts: how many turns there are.
        took: since the contact [R/V_P].

    Returns:
        their headings [rad], where they are, seen from the leader [R], and how fast that grows.
    """
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    swing = cell.half + rate * span
    # each turn ends where the line is met, so the next one's heading is off by two more
    off = swing + (parts + 0.5) * _turn_changes(scene, cell)
    grows = off + scene.alpha * rate * span
    return off, scene.d_min * swing + grows * took, grows


@njit(cache=True, nogil=True)
def _followed(
    scene: Scene, cell: Cell, middle: Pose, t: float, span: float, turn: float, left: float
) -> tuple[float, float]:
    """When the path may touch again first, and until when it does not surely break the limit.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        middle: pose at the contact in its middle.
        t: and when [R/V_P].
        span: half of the cell's window of time [R/V_P].
        turn: how long each turn lasts [rad].
        left: when to end [R/V_P].
    """
    contact, d_min, alpha = inf, scene.d_min, scene.alpha
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    # d″ is no less than −falls, nor greater than sways outside the disc; d‴ is no less than −jerk
    falls, jerk = 1.0 + alpha * rate, jerk_of(scene, rate)
    sways = falls + (1.0 + alpha) * (1.0 + alpha) / d_min
    off, _, _ = _parted(scene, cell, span, 1, 0.0)
    # so long all paths of the cell are in their first turn, and so is the leader in its own
    first = turn - 2.0 * off
    alike = min(left_of_piece(scene, cell, 1.0), first)
    finest = max(_FINEST, _PART * (cell.half + span))
    pose, sense, parts, begun = middle, -cell.side, 1, 0.0
    took = max(leaves_for(scene, cell, 1.0, min(turn, left)), _turned_back_for(scene, cell))
    took = max(min(took, first), _not_again_for(scene, cell, middle, t, alike), 0.0)
    for _ in range(_STEPS):
        if took >= left:
            return contact, left
        while took >= begun + turn:
            pose, sense, begun = fly_piece(pose, sense, turn), -sense, begun + turn
            parts += 1
        seen = _seen(scene, fly_piece(pose, sense, took - begun), sense, t + took)
        _, astray, tilts = _parted(scene, cell, span, parts + 1, took)
        tilts += (1.0 + alpha) * astray / d_min
        bends, falling = inf, 0.0
        if took < first:
            little, slowly = parted_by(scene, cell, span, rate, alike, 1.0, took)
            astray, tilts = min(astray, little), min(tilts, slowly)
            bends = slowly / took if took > 0.0 else inf
            # no path touches where d″ < 0
            falling = min(falling_for(scene, cell, span, took, seen.bends), first - took)
        room, opens, bent = seen.gap - astray, seen.opens - tilts, seen.bends - bends
        if seen.gap < -astray - EDGE:
            return contact, took
        step = 0.0
        if room > 0.0:
            step = (opens + sqrt(opens * opens + 2.0 * falls * room)) / falls
            if opens > 0.0 and bent > 0.0:
                step = max(step, min(3.0 * bent / jerk, alike - took))
        step = max(step, falling)
        if step < finest:
            # a path that touches has d′ = 0
            step = max((abs(seen.opens) - tilts) / sways, finest)
            if abs(seen.opens) <= tilts + sways * finest and contact == inf:
                # from here on only where the limit is surely broken matters
                contact, finest = took, _COARSE
        if contact < inf:
            # nor is it sooner broken than this
            step = max(step, (seen.gap + astray) / (1.0 + alpha))
        took += step
    return min(contact, took), left


@njit(cache=True, nogil=True)
def falling_for(scene: Scene, cell: Cell, span: float, took: float, bends: float) -> float:
    """For how long d″ < 0 on all paths of a cell, as long as all are in their first turn.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        span: half of its window of time [R/V_P].
        took: since the contact [R/V_P].
        bends: d″ on the path from its middle [V_P²/R].

    Returns:
        0 or less if it may be positive now, or the leader may change how it turns [R/V_P].
    """
    rate, left = fastest_turn(scene, 0, len(scene.leader) - 1), left_of_piece(scene, cell, 1.0)
    _, slowly = parted_by(scene, cell, span, rate, left, 1.0, took)
    t = 0.5 * (cell.start + cell.end) + took
    piece = piece_at(scene.leader, max(t - span, 0.0))
    differs = slowly / took if took > 0.0 else inf
    if took > left:
        # the leader heads otherwise since its pieces end sooner or later
        heads = 2.0 * rate * span * (piece - cell.piece)
        fast, d_min = 1.0 + scene.alpha, scene.d_min
        moved = (1.0 + scene.alpha * rate + 3.0 * fast * fast / d_min) / d_min
        differs += scene.alpha * heads * (rate + 2.0 * fast / d_min + moved * (took - left))
    same = piece_end(scene.leader, piece) - t - span
    return float(min((-bends - differs) / jerk_of(scene, rate), same))


@njit(cache=True, nogil=True)
def _not_again_for(scene: Scene, cell: Cell, middle: Pose, t: float, alike: float) -> float:
    """For how long no path of a cell touches again, since d‴ has one sign [R/V_P].

    With d and d′ zero both at the contact and when it touches again, d‴ would vanish in between. At
    a contact d‴ = (3 r′·r″ + r·r‴)/d, with r from the leader to the pursuer.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        middle: pose at the contact in its middle.
        t: and when [R/V_P].
        alike: so long neither changes how it turns [R/V_P].
    """
    alpha, d_min, sense = scene.alpha, scene.d_min, -cell.side
    there, rate = leader_at(scene, cell.piece, t), scene.leader[cell.piece, 4]
    x, y = (middle.x - there.x) / d_min, (middle.y - there.y) / d_min
    s, c = sine_and_cosine(middle.h)
    lead_s, lead_c = sine_and_cosine(there.h)
    ahead, across = alpha * lead_c, alpha * lead_s
    # first, second and third derivative of r
    vx, vy = c - ahead, s - across
    ax, ay = rate * across - sense * s, sense * c - rate * ahead
    jx, jy = rate * rate * ahead - c, rate * rate * across - s
    jerk = 3.0 * (vx * ax + vy * ay) / d_min + x * jx + y * jy
    fast, turns, swings = 1.0 + alpha, 1.0 + alpha * abs(rate), 1.0 + alpha * rate * rate
    # their directions differ by no more than twice the bearings
    parted = (6.0 * turns * (1.0 + fast) / d_min + 2.0 * swings) * cell.half
    # how fast d‴ changes: from d d⁗ = 3 |r″|² + 4 r′·r‴ + r·r⁗ − 3 d″² − 4 d′ d‴
    bends = turns + fast * fast / d_min
    changes = 3.0 * turns * turns + 4.0 * fast * swings + 3.0 * bends * bends
    changes = (changes + 4.0 * fast * jerk_of(scene, abs(rate))) / d_min
    changes += 1.0 + alpha * abs(rate) ** 3
    return float(min(max(_PART_OF * (abs(jerk) - parted) / changes, 0.0), alike))


@njit(cache=True, nogil=True)
def _turned_back_for(scene: Scene, cell: Cell) -> float:
    """For how long no path of a cell touches again, since a leader that begins to turn comes back.

    The separation grows until then, and from there on d″ < 0: so it comes to d_min with d′ < 0.
    """
    following = cell.piece + 1
    if following == len(scene.leader):
        return 0.0
    then = Cell(following, cell.side, cell.bearing, cell.half, cell.start, cell.end)
    least, most = slide_turns(scene, cell)[0], slide_turns(scene, then)[1]
    if least <= -1.0 or most >= -1.0:
        return 0.0
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    until = piece_end(scene.leader, cell.piece) - cell.start
    falling = growing_for(scene, cell, -1.0 - most, rate) / 3.0
    falling = min(falling, piece_end(scene.leader, following) - cell.end)
    if until >= min(growing_for(scene, cell, least + 1.0, rate), falling):
        return 0.0
    return falling


class _Seen(NamedTuple):
    gap: float  # d less d_min [R]
    opens: float  # d′ [V_P]
    bends: float  # d″ [V_P²/R]


@njit(cache=True, nogil=True)
def _seen(scene: Scene, at: Pose, sense: float, t: float) -> _Seen:
    """How the leader is seen from a pose at a time, in a turn of that sense."""
    piece = piece_at(scene.leader, t)
    there, lead_s, lead_c = leader_heading(scene, piece, t)
    x, y, swings = at.x - there.x, at.y - there.y, scene.alpha * scene.leader[piece, 4]
    far = norm(x, y)
    x, y = x / far, y / far
    s, c = sine_and_cosine(at.h)
    vx, vy = c - scene.alpha * lead_c, s - scene.alpha * lead_s
    opens = x * vx + y * vy
    bends = x * (swings * lead_s - sense * s) + y * (sense * c - swings * lead_c)
    return _Seen(far - scene.d_min, opens, bends + (vx * vx + vy * vy - opens * opens) / far)
