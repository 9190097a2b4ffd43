"""How soon something is round the leader that hops onto the final leg from where it cannot slide.

While the leader turns, let F be a contact with k > 1 (see `junction`). Nobody can slide from there,
which fronts that go round the disc from it do not know (see `to_final_leg`). For a while there is no
other contact (`apart_by`). If the leader has ended its last turn by then, the next contact, N, lies
on the final leg, and from there on it takes no less than round the disc. So nobody who goes round
counter-clockwise is at a bearing y sooner than

    r(y) + min over N of (t(F) + T(F → N) − r(N)),

r being `round_anywhere`, and T the time of the word from F to N: see `hop`. Words that come through
the disc are left out. If k < 1 at N the word does not end in a turn toward the leader, and if k < 0
not straight. And if |k| ≤ 1 all the way from N to a bearing N′, who slides there flies a path that
bank allows: so of a cell of N its end counts as well, with the soonest word of all. Where it pays
to come to the circle λ_ψ = 0, so near the best N this is nearly exact. Clockwise it is the same.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.between import blur_between, moved_with, word_toward
from relguide.kernels.bounds.breach import Sieve, no_sieve
from relguide.kernels.bounds.cell_words import seen_from_start
from relguide.kernels.bounds.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.hop import LONG, as_may_be, limit_for, standing
from relguide.kernels.bounds.junction import can_slide, junction_of
from relguide.kernels.bounds.rest import no_rest
from relguide.kernels.bounds.round_time import round_anywhere
from relguide.kernels.bounds.round_turning import bearings_of
from relguide.kernels.bounds.ways import drifting, ways_from
from relguide.kernels.bounds.word_bound import soonest, soonest_by_turn
from relguide.kernels.bounds.word_intervals import Blur
from relguide.kernels.contact.contact import to_frame_of

_CELLS = 16  # of each side, at first
_MOST = 300  # times one is halved
_FINE = 0.1  # and how much smaller than the cell of F they may become
_ROUNDING = 1e-9  # of a time, as part of it


class _Leaving(NamedTuple):
    """Contacts that are left, round the leader one way."""

    cell: Cell
    """Of them."""
    begin: Poses
    """Theirs."""
    way: int
    """0 counter-clockwise round the leader, 1 clockwise."""
    edge: float
    """The furthest bearing of them that way, relative to the slot's heading [rad]."""
    slides: float
    """As in `hops_from` [R/V_P]."""
    apart: float
    """Likewise [R/V_P]."""
    longest: float
    """Likewise [R/V_P]."""


@njit(cache=True, nogil=True)
def hops_from(
    scene: Scene, table: FloatArray, cell: Cell, way: int, slides: float, apart: float,
    enough: float, longest: float,
) -> float:  # fmt: skip
    """As `to_final_leg.slides_from`, for what turns at full bank at most: see above.

    Args:
        scene: the leader and d_min.
        table: of `times_round`.
        cell: of contacts on another leg.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        slides: what `slides_from` says.
        apart: for how long there is no other contact after one of the cell [R/V_P].
        enough: no more than this is wanted [R/V_P].
        longest: what takes so long to the next contact does not matter, nor what takes as long as
            `never_round` says [R/V_P].

    Returns:
        that, no less than `slides`; where the next contact may lie on another leg it is that.
    """
    longest, final = min(longest, never_round(scene)), len(scene.leader) - 1
    begin = poses_of(scene, cell)
    if cell.start + apart < scene.leader[final, 0] or begin.differs == inf:
        return slides
    low, high = bearings_of(scene, cell)
    edge = high if way == 0 else low
    leaving = _Leaving(cell, begin, way, edge, slides, apart, longest)
    room = 2 * _CELLS + _MOST
    sides, bearings, halves = np.empty(room), np.empty(room), np.empty(room)
    bounds = np.empty(room)
    count, half = 0, pi / _CELLS
    for k in range(_CELLS):
        for side in (1.0, -1.0):
            sides[count], bearings[count], halves[count] = side, (2 * k + 1) * half - pi, half
            other = standing(final, side, bearings[count], half)
            bounds[count] = _by_way_of(scene, table, leaving, other, enough)
            count += 1
    at = int(np.argmin(bounds[:count]))
    while count < room and bounds[at] < enough and halves[at] > _FINE * cell.half:
        side, bearing, half, least = sides[at], bearings[at], 0.5 * halves[at], bounds[at]
        for k in range(2):
            place = at if k == 0 else count
            sides[place], bearings[place], halves[place] = side, bearing + (2 * k - 1) * half, half
            other = standing(final, side, bearings[place], half)
            bounds[place] = max(least, _by_way_of(scene, table, leaving, other, enough))
        count += 1
        at = int(np.argmin(bounds[:count]))
    return max(float(bounds[at]), slides)


@njit(cache=True, nogil=True)
def never_round(scene: Scene) -> float:
    """For how long nobody comes all the way round the leader [R/V_P]."""
    return TWO_PI * scene.d_min / (1.0 + scene.alpha)


@njit(cache=True, nogil=True)
def _by_way_of(
    scene: Scene, table: FloatArray, leaving: _Leaving, other: Cell, enough: float
) -> float:
    """The same by way of contacts of another cell, no more than `enough`."""
    way, sense, since = leaving.way, 1.0 - 2.0 * leaving.way, leaving.cell.start
    ahead = wrap(sense * (other.bearing - leaving.edge))
    soonest, least_since = inf, inf
    # behind, ahead, or nearly a round further
    for rounds in range(-1, 2):
        at = leaving.edge + sense * (ahead + TWO_PI * rounds)
        began = round_anywhere(table, way, at - sense * other.half)
        ended = sense * round_anywhere(table, way, at + sense * other.half)
        took = max(leaving.apart, leaving.slides + sense * began - since)
        if took >= leaving.longest or since + took - ended >= enough:
            continue
        soonest, least_since = min(soonest, took), min(least_since, since - ended)
    if soonest == inf:
        return enough
    there = poses_of(scene, other)
    if there.differs == inf:
        return enough
    there = moved_with(there, leaving.begin, True)
    until = min(leaving.longest, enough - least_since)
    took = soonest
    if took < until:
        window = Window(took * (1.0 - _ROUNDING), until)
        looped = inf
        if until > TWO_PI:
            looped = TWO_PI + _looped(scene, leaving.begin, there, until - TWO_PI)
        took = max(took, min(_hop_back(scene, leaving.begin, there, other, window), looped))
    if took >= until:
        return enough
    if other.side == sense and can_slide(scene, other):
        # sliding to where it is left counts here as well
        to = standing(other.piece, sense, wrap_signed(other.bearing + sense * other.half), 0.0)
        far = moved_with(poses_of(scene, to), leaving.begin, True)
        took = max(took, word_toward(scene, leaving.begin, far, enough - least_since, took))
    return min(enough, max(least_since + took, leaving.slides))


@njit(cache=True, nogil=True)
def _hop_back(scene: Scene, begin: Poses, there: Poses, other: Cell, window: Window) -> float:
    """No word leads sooner from any of some poses to a contact of a cell that is the next one.

    Only how it ends is looked at: it is flown back.

    Args:
        scene: the leader and d_min.
        begin: the poses.
        there: of `moved_with`, those of the cell when it begins.
        other: the cell.
        window: as in `hop_bound`.
    """
    s, c = sine_and_cosine(begin.middle.h)
    x, y = begin.span * (begin.vx - there.vx), begin.span * (begin.vy - there.vy)
    moved = max(begin.left, begin.right)
    # read backward, left is right
    blur = Blur(
        there.right + moved, there.left + moved, there.differs + begin.differs, begin.differs,
        ways_from(there.ways, -s, -c), ways_from(drifting(begin.ways, x, y), -s, -c),
    )  # fmt: skip
    seen, target = seen_from_start(begin.middle, _at_once(there))
    junction = junction_of(scene, other, 1.0, True)
    inside = limit_for(scene, begin, window.beat, 0.0)
    sieve = Sieve(window.beat > LONG, begin.middle, 0.0, inside, 1.0, begin.t, begin.t)
    found = soonest_by_turn(seen, blur, target, window, sieve, junction, no_rest(), False)
    return as_may_be(found, junction)


@njit(cache=True, nogil=True)
def _looped(scene: Scene, begin: Poses, there: Poses, left: float) -> float:
    """How soon a word without one of its full loops meets a cell, where it is a loop later."""
    s, c = sine_and_cosine(there.middle.h)
    at = Pose(
        there.middle.x + TWO_PI * there.vx, there.middle.y + TWO_PI * there.vy, there.middle.h
    )
    return soonest(
        to_frame_of(begin.middle, at), blur_between(begin, there),
        Velocity(there.vx * c + there.vy * s, there.vy * c - there.vx * s), Window(0.0, left),
        no_sieve(scene),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _at_once(poses: Poses) -> Poses:
    """The same at t = 0."""
    return Poses(
        0.0, poses.span, poses.middle, poses.vx, poses.vy, poses.differs, poses.left, poses.right,
        poses.ways,
    )  # fmt: skip
