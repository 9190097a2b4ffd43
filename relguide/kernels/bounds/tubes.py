"""Paths that differ little from one that is followed, and when they may touch: to first order.

A tube holds all paths of a few pieces that begin at the contacts of a small cell, and whose turns
and straights are nearly as long. It is known how each of these moves the path, and its time, and
how far from that it may be, to second order. So along the path it is known how d and d′ may differ:
where neither can be zero at once nobody touches, and where d is certainly less than d_min all have
broken the limit. Nobody touches either while d″ < 0.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.borrowed import uncounted
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, fastest_turn
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.junction import jerk_of, left_of_piece, parted_by
from relguide.kernels.bounds.ways import no_ways
from relguide.kernels.bounds.word_intervals import intercept_span
from relguide.kernels.separation.clearance import leader_heading, piece_at, piece_end
from relguide.kernels.words.extremals import fly_piece

_STEPS = 2_000  # no more of them
_FINEST = 1e-5  # shortest step [R/V_P], or
_PART = 0.2  # as part of how far d may differ
_SHARE = 1.0  # or for which d′ changes by this part of how far it may differ
_STRAIGHT = 1e-3  # d″ is taken to be able to fall to less than minus this [V_P²/R]


class Shift(NamedTuple):
    """How a path at the edge of a tube differs from its middle, by one of the things that may."""

    x: float
    """Where it is [R]."""
    y: float
    """[R]."""
    h: float
    """Its heading [rad]."""
    t: float
    """When it is there [R/V_P]."""


_NOTHING = Shift(0.0, 0.0, 0.0, 0.0)


class Tube(NamedTuple):
    """Paths from a contact on, along one piece."""

    at: Pose
    """Where the piece of the middle begins."""
    t: float
    """When [R/V_P]."""
    flown: float
    """Since the contact [R/V_P]."""
    bearing: Shift
    """By the bearing of the contact …"""
    time: Shift
    """… and its time …"""
    turn: Shift
    """… by how long the turn is that went on …"""
    piece: Shift
    """… and by the piece after it."""
    bends: float
    """How far besides [R]."""
    twists: float
    """And how much besides the heading may differ [rad]."""


class Course(NamedTuple):
    """What tubes are followed for."""

    scene: Scene
    """The leader and d_min."""
    goal: Goal
    """Where the paths are to arrive."""
    cell: Cell
    """Of the contacts from which they begin."""
    span: float
    """Half of its window of time [R/V_P]."""
    beat: float
    """Arrivals from here on do not matter [R/V_P]."""
    rate: float
    """The leader's greatest turn rate [V_P/R]."""
    alike: float
    """So long after each contact the leader goes on as it does [R/V_P]."""
    jerk: float
    """Of `junction.jerk_of`."""


class Zone(NamedTuple):
    """Where along a piece paths of a tube may touch."""

    begin: float
    """Infinite if none does [R/V_P]."""
    end: float
    """Where it is over, or so far the piece has been followed [R/V_P]."""
    lives: bool
    """Whether any paths go on from there: not if all have broken the limit, or are late."""
    far: float
    """How far paths may be from the middle there, seen from the leader [R]; infinite if that was
    followed in vain."""


class Spread(NamedTuple):
    """How much the paths of a tube may differ from its middle somewhere along it."""

    gap: float
    """How much d may differ [R]."""
    opens: float
    """And d′ [V_P]."""
    far: float
    """How far they may be, seen from the leader [R]."""
    heads: float
    """How much headings may differ [rad]."""
    times: float
    """And times [R/V_P]."""


class Seen(NamedTuple):
    """What the leader sees of the middle of a tube."""

    d: float
    """How far it is away [R]."""
    ex: float
    """In which direction …"""
    ey: float
    """… as a unit vector."""
    vx: float
    """How it moves relative to the leader [V_P]."""
    vy: float
    """[V_P]."""
    c: float
    """Cosine of its heading …"""
    s: float
    """… and sine."""
    lead_x: float
    """How the leader moves [V_P]."""
    lead_y: float
    """[V_P]."""
    rate: float
    """And turns [V_P/R]."""


@njit(cache=True, nogil=True)
def course_of(scene: Scene, goal: Goal, cell: Cell, beat: float) -> Course:
    """A course from the contacts of a cell, whose window of time has an end."""
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    return Course(
        scene, goal, cell, 0.5 * (cell.end - cell.start), beat, rate,
        left_of_piece(scene, cell, 1.0), jerk_of(scene, rate),
    )  # fmt: skip


@uncounted
def tube_from(poses: Poses) -> Tube:
    """The tube that begins at the contacts of a cell with these poses."""
    way, span = poses.ways.bearing, poses.span
    return Tube(
        poses.middle, poses.t, 0.0, Shift(way.x, way.y, way.h, 0.0),
        Shift(span * poses.vx, span * poses.vy, poses.ways.time.h, span), _NOTHING, _NOTHING,
        poses.ways.bends, poses.ways.twists,
    )  # fmt: skip


@uncounted
def flown(tube: Tube, sign: float, amount: float) -> Tube:
    """The tube at the end of a piece."""
    at = fly_piece(tube.at, sign, amount)
    dx, dy = at.x - tube.at.x, at.y - tube.at.y
    return Tube(
        at, tube.t + amount, tube.flown + amount, _moved(tube.bearing, dx, dy),
        _moved(tube.time, dx, dy), _moved(tube.turn, dx, dy), _moved(tube.piece, dx, dy),
        tube.bends, tube.twists,
    )  # fmt: skip


@uncounted
def with_turn(tube: Tube, sign: float, half: float) -> Tube:
    """The tube where the turn that ends there may be longer or shorter by so much."""
    return Tube(
        tube.at, tube.t, tube.flown, tube.bearing, tube.time, _longer(tube.at, sign, half),
        tube.piece, tube.bends, tube.twists,
    )  # fmt: skip


@uncounted
def with_piece(tube: Tube, sign: float, half: float) -> Tube:
    """The tube where another piece that ends there may be longer or shorter by so much.

    If that was so of pieces before, it is of all of them alike.
    """
    longer, piece = _longer(tube.at, sign, half), tube.piece
    return Tube(
        tube.at, tube.t, tube.flown, tube.bearing, tube.time, tube.turn,
        Shift(piece.x + longer.x, piece.y + longer.y, piece.h + longer.h, piece.t + longer.t),
        tube.bends, tube.twists,
    )  # fmt: skip


@uncounted
def with_bearing(tube: Tube, sign: float, half: float) -> Tube:
    """The tube where the piece that ends there is longer by so much at the end of the bearings."""
    longer, bearing = _longer(tube.at, sign, half), tube.bearing
    return Tube(
        tube.at, tube.t, tube.flown,
        Shift(
            bearing.x + longer.x, bearing.y + longer.y, bearing.h + longer.h, bearing.t + longer.t
        ),
        tube.time, tube.turn, tube.piece, tube.bends, tube.twists,
    )  # fmt: skip


@uncounted
def poses_in(tube: Tube, goal: Goal) -> tuple[Poses, float]:
    """Where the paths of a tube are as their piece begins, and how much earlier or later [R/V_P].

    As poses at one time, at which the goal is where it is then.
    """
    blur, heads, times = 0.0, 0.0, 0.0
    for k in range(4):
        shift = _of(tube, k)
        x = shift.x - shift.t * goal.speed
        blur += norm(x, shift.y) + abs(shift.h)
        heads, times = heads + abs(shift.h), times + abs(shift.t)
    blur += _second(tube, 0.0, heads, times)
    heads += tube.twists
    there = Poses(tube.t, 0.0, tube.at, 0.0, 0.0, heads, blur, blur, no_ways())
    return there, times


@uncounted
def touching(course: Course, tube: Tube, sign: float, begin: float, lasts: float) -> Zone:
    """Where along a piece paths may touch first.

    Args:
        course: what is asked.
        tube: the paths.
        sign: of the piece, ε.
        begin: no contact is looked for before this [R/V_P].
        lasts: how long the piece is [R/V_P].
    """
    scene, goal, d_min, alpha = course.scene, course.goal, course.scene.d_min, course.scene.alpha
    touch, far, w, fast = inf, 0.0, begin, 1.0 + course.scene.alpha
    x, y, h = tube.at
    s, c = sine_and_cosine(h)
    for _ in range(_STEPS):
        if w >= lasts:
            return Zone(touch, lasts, True, far)
        # as `fly_piece`, with sine and cosine of each heading found once
        t, on_s, on_c = tube.t + w, s, c
        at = Pose(x + w * c, y + w * s, h)
        if sign != 0.0:
            on_s, on_c = sine_and_cosine(h + sign * w)
            at = Pose(x + sign * (on_s - s), y - sign * (on_c - c), h + sign * w)
        seen = _seen(scene, at, on_s, on_c, t)
        spread = spread_of(course, tube, at, w, seen)
        # who is to be at the goal in time cannot be further away than this
        astray, ahead = spread.far + fast * spread.times, goal.x + goal.speed * t - at.x
        on = intercept_span(ahead, -at.y, Velocity(goal.speed, 0.0), astray)[0]
        if t - spread.times + on >= course.beat:
            return Zone(touch, w, False, far)
        gap, opens = seen.d - d_min, seen.ex * seen.vx + seen.ey * seen.vy
        if gap < -spread.gap - EDGE:
            return Zone(touch, w, False, far)
        rate = _rate_from(scene, t - spread.times)
        # d″ is no less than −falls, nor greater than sways outside the disc
        falls = max(abs(sign) + alpha * rate, _STRAIGHT)
        sways, sure = falls + fast * fast / d_min, _SHARE * spread.opens
        finest = max(_FINEST, _PART * spread.gap, sure / sways)
        step, room, least, touches = 0.0, gap - spread.gap, opens - spread.opens, False
        if room > 0.0:
            step = (least + sqrt(least * least + 2.0 * falls * room)) / falls
        if step < finest:
            bends, differs, alike = bends_of(course, seen, spread, sign, t, opens)
            free, bent = (abs(opens) - spread.opens) / sways, abs(bends) + differs
            # so long d′ changes by no more than `sure`, as far as d″ is known
            slow = 2.0 * sure / (bent + sqrt(bent * bent + 4.0 * course.jerk * sure))
            if finest < min(slow, alike):
                finest, sways = min(slow, alike), bent + course.jerk * slow
            # nobody touches while d″ < 0, nor before d′ may vanish
            falling = min((-bends - differs) / course.jerk, alike)
            touches = abs(opens) <= spread.opens + sways * finest and falling < finest
            step = max(free, finest, falling)
        if touches:
            touch, far = min(touch, w), max(far, spread.far)
        elif touch < inf:
            return Zone(touch, w, True, max(far, spread.far))
        w += step
    return Zone(min(touch, w), lasts, True, inf)


@uncounted
def _moved(shift: Shift, dx: float, dy: float) -> Shift:
    return Shift(shift.x - shift.h * dy, shift.y + shift.h * dx, shift.h, shift.t)


@uncounted
def _longer(at: Pose, sign: float, half: float) -> Shift:
    s, c = sine_and_cosine(at.h)
    return Shift(half * c, half * s, half * sign, half)


@uncounted
def _of(tube: Tube, k: int) -> Shift:
    if k == 0:
        return tube.bearing
    if k == 1:
        return tube.time
    return tube.turn if k == 2 else tube.piece


@uncounted
def _second(tube: Tube, w: float, heads: float, times: float) -> float:
    """How far paths may be from where first order says [R]."""
    turned, length = heads + tube.twists, tube.flown + w
    return (
        tube.bends + turned * (times + turned * (1.0 + 0.5 * length)) + tube.twists * (1.0 + length)
    )


@uncounted
def seen_at(scene: Scene, at: Pose, t: float) -> Seen:
    """What the leader sees of a pose at a time."""
    s, c = sine_and_cosine(at.h)
    return _seen(scene, at, s, c, t)


@uncounted
def _seen(scene: Scene, at: Pose, s: float, c: float, t: float) -> Seen:
    """The same, with sine and cosine of the heading."""
    piece = piece_at(scene.leader, t)
    there, lead_s, lead_c = leader_heading(scene, piece, t)
    dx, dy = at.x - there.x, at.y - there.y
    d = norm(dx, dy)
    x, y, per = scene.alpha * lead_c, scene.alpha * lead_s, 1.0 / d
    return Seen(d, dx * per, dy * per, c - x, s - y, c, s, x, y, scene.leader[piece, 4])


@uncounted
def spread_of(course: Course, tube: Tube, at: Pose, w: float, seen: Seen) -> Spread:
    """How much paths differ in a tube.

    Args:
        course: what is asked.
        tube: the paths.
        at: the middle, …
        w: … so far along the piece [R/V_P].
        seen: of it.
    """
    scene, fast = course.scene, 1.0 + course.scene.alpha
    gap, opens, far, heads, times = 0.0, 0.0, 0.0, 0.0, 0.0
    along, per, curved = seen.ex * seen.vx + seen.ey * seen.vy, 1.0 / seen.d, 1.0 / scene.d_min
    # how the direction from the leader changes
    ux, uy = per * (seen.vx - along * seen.ex), per * (seen.vy - along * seen.ey)
    dx, dy = at.x - tube.at.x, at.y - tube.at.y
    for k in range(4):
        shift = _moved(_of(tube, k), dx, dy)
        x, y = shift.x - shift.t * seen.lead_x, shift.y - shift.t * seen.lead_y
        turns = shift.t * seen.rate
        vx, vy = turns * seen.lead_y - shift.h * seen.s, shift.h * seen.c - turns * seen.lead_x
        gap += abs(seen.ex * x + seen.ey * y)
        opens += abs(seen.ex * vx + seen.ey * vy + ux * x + uy * y)
        far += norm(x, y)
        heads, times = heads + abs(shift.h), times + abs(shift.t)
    swings = scene.alpha * course.rate * times
    second = _second(tube, w, heads, times) + swings * times
    heads += tube.twists
    far += second
    second += 0.55 * curved * far * far
    t = tube.t + w
    if piece_at(scene.leader, max(t - times, 0.0)) != piece_at(scene.leader, t + times):
        opens += 2.0 * swings
    turned = heads + course.rate * times
    opens += 2.0 * (turned * turned + curved * (second * fast + far * turned)) + tube.twists
    opens += 2.0 * fast * (curved * far) * (curved * far)
    gap += second
    if tube.flown == 0.0:
        # nothing differs but the contact: there neither d nor d′ does
        parted, grows = parted_by(
            scene, course.cell, course.span, course.rate, course.alike, 1.0, w
        )
        gap, opens = min(gap, parted), min(opens, grows)
    return Spread(gap, opens, far, heads, times)


@uncounted
def _rate_from(scene: Scene, t: float) -> float:
    """The leader's greatest turn rate from then on, either way [V_P/R]."""
    return fastest_turn(scene, piece_at(scene.leader, max(t, 0.0)), len(scene.leader) - 1)


@uncounted
def bends_of(
    course: Course, seen: Seen, spread: Spread, sign: float, t: float, opens: float
) -> tuple[float, float, float]:
    """d″ on the middle of a tube, and how much it may differ on other paths [V_P²/R].

    And how long the leader goes on as it does, seen from all of them [R/V_P].
    """
    scene, d_min, fast = course.scene, course.scene.d_min, 1.0 + course.scene.alpha
    piece = piece_at(scene.leader, max(t - spread.times, 0.0))
    alike = piece_end(scene.leader, piece) - t - spread.times
    ax = seen.rate * seen.lead_y - sign * seen.s
    ay = sign * seen.c - seen.rate * seen.lead_x
    bends = (seen.vx * seen.vx + seen.vy * seen.vy - opens * opens) / seen.d
    bends += seen.ex * ax + seen.ey * ay
    turned = spread.heads + course.rate * spread.times
    differs = spread.far * (1.0 + scene.alpha * course.rate + 3.0 * fast * fast / d_min) / d_min
    differs += turned * (1.0 + scene.alpha * course.rate + 4.0 * fast / d_min)
    return bends, 1.1 * differs, alike
