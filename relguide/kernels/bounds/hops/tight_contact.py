"""How much longer than round the disc it takes to a contact where no path can slide: proved.

Where k > 1 (see `junction`) no bank is enough to follow the circle of radius d_min, which the time
round it does not know (see `around`). Behind a leader that keeps straight, let L be a contact
there, which passes counter-clockwise, and P the one before it. Seen from the leader let a(X → Y) be
the time counter-clockwise round the disc, negative where Y is passed before X, full rounds counted.
No path takes less from X to Y. So from any contact F by way of P to L it takes at least

    a(F → P) + T(P → L) = a(F → L) + e,    e = T(P → L) − a(P → L),

T being the time of the word that leads from P to L: see `hop`. The bound is the least e of all P.

- A word with a full loop takes 2π, and so does a way round for so long: these are left out.
- Near L there is no P, since the separation has fallen for a while (`apart_by`).
- From a P with k < 1 no path begins with a turn toward the leader. And if |k| ≤ 1 all the way from
  a bearing P₀ to P, a path that bank allows slides there: so a(P₀ → P) + T(P → L) is no less than
  the time of the soonest word of all from P₀ to L. So of a cell of P only its beginning matters.
  Where it pays to leave the circle λ_ψ = 0, so near the best P this is nearly exact.
- A path that has come to a contact L of a cell may turn on toward the leader to X, where its
  heading is that of the cell's last contact L₁. The turn takes h(L₁) − h(L), and dh = k da along
  the circle:

      e ≥ T(P → X) − a(P → L₁) − ∫ (k − 1) da    from L to L₁.

  Seen from the leader X strays from L₁ by d_min (k − 1) |b(L₁) − b(L)| at most. So of a cell of L
  little more than its end matters where k is hardly more than 1.

From a contact with k > 1 on to the next one it is the same, turned round. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import pi
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Scene, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import round_bound, round_most
from relguide.kernels.bounds.hops.hop import hop_bound, hop_toward, standing, turned_round
from relguide.kernels.bounds.words.cell_words import word_toward
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.junction import apart_by, can_slide, slide_turns
from relguide.kernels.bounds.words.sets import unknown_sensitivity

_TURNED = 0.1  # more is not turned from the first contact of a cell to its last one [rad]
LONGEST = TWO_PI - _TURNED
"""What takes longer is not bounded [R/V_P]."""
_CELLS = 16  # of each side, at first
_MOST = 500  # times one is halved
_FINE = 0.1  # and how much smaller than the contact's own cell they may become
_ROUNDING = 1e-9  # of a time, as part of it


class _Tight(NamedTuple):
    """Contacts that pass counter-clockwise, to which the excess is asked for."""

    cell: Cell
    """Of them."""
    end: Poses
    """Where all paths that turn left through one of them are on the heading of the last one."""
    longer: float
    """How much longer than round the disc it may take to turn there [R/V_P]."""
    apart: float
    """For how long there is no other contact before one of them [R/V_P]."""
    longest: float
    """What takes longer to one of them is not bounded [R/V_P] …"""
    until: float
    """… nor what takes longer until it is on that heading [R/V_P]."""


@njit(cache=True, nogil=True)
def tight_excess(
    scene: Scene, table: FloatArray, cell: Cell, last: bool, enough: float, longest: float
) -> float:
    """How much longer than round the disc it takes to any contact of a cell, or on from it.

    That is from any other contact, or to any, the way that the cell's side says.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        last: whether it is come to, and not left.
        enough: no more than this is wanted [R/V_P].
        longest: what takes longer to the next contact does not matter, nor what takes `LONGEST`
            [R/V_P].

    Returns:
        [R/V_P], for what takes less than that to the next contact; 0 where a path might slide.
    """
    # mirrored, so that it passes counter-clockwise; and turned round, so that it is come to
    asked = standing(cell.piece, 1.0, cell.side * cell.bearing, cell.half)
    if not last:
        asked = turned_round(asked)
    if slide_turns(scene, asked)[0] <= 1.0:
        return 0.0
    along = round_most(table, asked.bearing - asked.half, 2.0 * asked.half)
    most = slide_turns(scene, asked)[1]
    if most * along > _TURNED:
        return 0.0
    at_once = Cell(asked.piece, 1.0, asked.bearing, asked.half, 0.0, 0.0)
    end, longer = _turned_on(scene, asked, most), (most - 1.0) * along
    longest = min(longest, LONGEST)
    tight = _Tight(
        asked, end, longer, apart_by(scene, at_once, -1.0), longest, longest + most * along
    )
    return _least(scene, table, tight, enough)


@njit(cache=True, nogil=True)
def _least(scene: Scene, table: FloatArray, tight: _Tight, enough: float) -> float:
    """The least excess by way of any contact, by halving their cells."""
    room = 2 * _CELLS + _MOST
    sides, bearings, halves = np.empty(room), np.empty(room), np.empty(room)
    bounds = np.empty(room)
    count, half = 0, pi / _CELLS
    for k in range(_CELLS):
        for side in (1.0, -1.0):
            sides[count], bearings[count], halves[count] = side, (2 * k + 1) * half - pi, half
            other = standing(tight.cell.piece, side, bearings[count], half)
            bounds[count] = _excess(scene, table, other, tight, enough)
            count += 1
    at = int(np.argmin(bounds[:count]))
    while count < room and bounds[at] < enough and halves[at] > _FINE * tight.cell.half:
        side, bearing, half, least = sides[at], bearings[at], 0.5 * halves[at], bounds[at]
        for k in range(2):
            place = at if k == 0 else count
            sides[place], bearings[place], halves[place] = side, bearing + (2 * k - 1) * half, half
            other = standing(tight.cell.piece, side, bearings[place], half)
            bounds[place] = max(least, _excess(scene, table, other, tight, enough))
        count += 1
        at = int(np.argmin(bounds[:count]))
    return float(bounds[at])


@njit(cache=True, nogil=True)
def _excess(scene: Scene, table: FloatArray, other: Cell, tight: _Tight, enough: float) -> float:
    """The least excess by way of contacts of the other cell, no more than `enough`."""
    cell = tight.cell
    ahead, reach = wrap(cell.bearing - other.bearing), cell.half + other.half
    least, full = enough, float(table[0, -1])
    # beyond the contact, and back to it
    back = round_bound(table, 0, cell, other)
    took = max(tight.apart, round_bound(table, 1, other, cell))
    if took + back < least and took < tight.longest:
        window = Window(0.0, min(least - back, tight.longest))
        took = max(took, hop_bound(scene, other, cell, window))
        if took < tight.longest:
            least = min(least, took + back)
    # before it, and on in the same turn to the heading of the last contact of the cell
    around = ahead + reach >= TWO_PI
    soonest, begin = round_bound(table, 0, other, cell), other.bearing - other.half
    latest = round_most(table, begin, ahead + reach - (TWO_PI if around else 0.0))
    if around and full - latest < tight.longest:
        return 0.0
    if soonest >= tight.longest:
        return least
    latest += tight.longer
    took = max(tight.apart, soonest)
    if took < min(latest + least, tight.until):
        window = Window(soonest * (1.0 - _ROUNDING), min(latest + least, tight.until))
        # a path that turns on flies no word to there, but lies that near one
        astray = (tight.until - tight.longest) * (2.0 + window.beat)
        took = max(took, hop_toward(scene, other, tight.end, window, astray))
    if took >= tight.until:
        return least
    if took < latest + least and other.side > 0.0 and can_slide(scene, other):
        # sliding to where the word begins counts here as well
        at = poses_of(scene, standing(other.piece, 1.0, begin, 0.0))
        took = max(took, word_toward(scene, at, tight.end, latest + least, took))
    return min(least, max(took - latest, 0.0))


@njit(cache=True, nogil=True)
def _turned_on(scene: Scene, cell: Cell, most: float) -> Poses:
    """Where paths that turn left through a contact of the cell are on its last one's heading."""
    last = poses_of(scene, standing(cell.piece, 1.0, cell.bearing + cell.half, 0.0))
    apart = 2.0 * scene.d_min * cell.half * (most - 1.0)
    return Poses(
        last.t, last.span, last.middle, last.vx, last.vy, 0.0, last.left + apart,
        last.right + apart, unknown_sensitivity(),
    )  # fmt: skip
