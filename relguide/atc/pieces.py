"""Time cut into pieces in which an aircraft and each of many others fly straight, at one speed.

A track is far from most others nearly all the time. So windows in which they cannot come near are
left out first; the rest is cut at every knot, and where height begins or ceases to keep apart.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.planning.heights import WHOLE_METRE
from relguide.units import Metre, Second

WINDOW: Second = 30.0
"""Windows are not much longer than this [s]."""
_UNBOUNDED: Metre = 1e9
"""An altitude that no aircraft has, in place of an infinite one [m]."""
Integers = NDArray[np.intp]


class Columns(NamedTuple):
    """Many tracks, one behind another; times are from the begin of what is looked at."""

    t: FloatArray
    x: FloatArray
    y: FloatArray
    low: FloatArray
    high: FloatArray
    first: Integers
    """Where each track begins. shape (n + 1,)"""
    key: FloatArray
    """Ascending through all: the track's number times `span`, and the time of the knot."""
    span: Second
    fastest: FloatArray
    """The largest speed of each. shape (n,)"""

    def knot(self, of: Integers, t: FloatArray) -> Integers:
        """The knot from which each of some tracks flies at a time; the last but one past its end.

        Args:
            of: numbers of the tracks. shape (m,)
            t: times. shape (m,)
        """
        inside = np.clip(t, -0.4 * self.span, 0.4 * self.span)
        found = np.searchsorted(self.key, of * self.span + inside, side="right") - 1
        return np.clip(found, self.first[of], self.first[of + 1] - 2)

    def motion(
        self, of: Integers, t: FloatArray, during: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Place and velocity at times `t`, by the piece flown at times `during`."""
        k = self.knot(of, during)
        time = self.t[k + 1] - self.t[k]
        east = (self.x[k + 1] - self.x[k]) / time
        north = (self.y[k + 1] - self.y[k]) / time
        since = t - self.t[k]
        return self.x[k] + east * since, self.y[k] + north * since, east, north

    def heights(
        self, of: Integers, t: FloatArray, during: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Bounds on the altitudes at times `t`; beyond a track's ends those of its ends."""
        k = self.knot(of, during)
        share = np.clip((t - self.t[k]) / (self.t[k + 1] - self.t[k]), 0.0, 1.0)
        low = self.low[k] + share * (self.low[k + 1] - self.low[k])
        return low, self.high[k] + share * (self.high[k + 1] - self.high[k])


class Pieces(NamedTuple):
    """Pieces of time in which height does not keep apart, those of one track one behind another.

    Each array has one value a piece, shape (m,).
    """

    of: Integers
    """The other track's number."""
    begin: FloatArray
    length: FloatArray
    own_x: FloatArray
    """At the begin, as all that follows."""
    own_y: FloatArray
    own_east: FloatArray
    """Velocity."""
    own_north: FloatArray
    x: FloatArray
    y: FloatArray
    east: FloatArray
    north: FloatArray


def columns_of(tracks: Sequence[Track], begin: Second, end: Second) -> Columns:
    """Tracks one behind another, with times from `begin` on."""
    lengths = [track.t.size for track in tracks]
    first = np.concatenate(([0], np.cumsum(lengths))).astype(np.intp)
    t = np.concatenate([track.t for track in tracks]) - begin
    x = np.concatenate([track.x for track in tracks])
    y = np.concatenate([track.y for track in tracks])
    low = np.concatenate([track.low for track in tracks])
    high = np.concatenate([track.high for track in tracks])
    span = 4.0 * max(float(np.max(np.abs(t))), end - begin, 1.0)
    number = np.repeat(np.arange(len(tracks)), lengths)
    with np.errstate(divide="ignore", invalid="ignore"):  # from one track to the next
        speeds = np.hypot(np.diff(x), np.diff(y)) / np.diff(t)
    speeds[first[1:-1] - 1] = 0.0
    return Columns(
        t=t,
        x=x,
        y=y,
        low=np.maximum(low, -_UNBOUNDED),
        high=np.minimum(high, _UNBOUNDED),
        first=first,
        key=number * span + t,
        span=span,
        fastest=np.maximum.reduceat(np.append(speeds, 0.0), first[:-1]),
    )


def edges_of(length: Second) -> FloatArray:
    """Windows of equal length, the last one's end behind their begins [s]."""
    return np.linspace(0.0, length, max(int(np.ceil(length / WINDOW)), 1) + 1)


def pieces_of(
    own: Columns, others: Columns, edges: FloatArray, near: NDArray[np.bool_], vertical: Metre
) -> Pieces:
    """Pieces of the windows in which an aircraft and others may come near.

    Args:
        own: one track.
        others: n tracks.
        edges: of w windows. shape (w + 1,)
        near: whether they may come near each other in a window. shape (n, w)
        vertical: height that keeps apart [m].
    """
    of, window = np.nonzero(near)
    groups = np.arange(len(of))
    knots = np.searchsorted(own.t, edges)
    own_group, own_knot = _runs(groups, knots[window], knots[window + 1])
    begins = np.searchsorted(others.key, of * others.span + edges[window])
    ends = np.searchsorted(others.key, of * others.span + edges[window + 1])
    other_group, other_knot = _runs(groups, begins, ends)
    group = np.concatenate((groups, own_group, other_group))
    t = np.concatenate((edges[window], own.t[own_knot], others.t[other_knot]))
    order = np.lexsort((t, group))
    group, t = group[order], t[order]
    last = np.append(group[1:] != group[:-1], True)
    until = np.where(last, edges[window + 1][group], np.append(t[1:], 0.0))
    lasts = until > t
    of, t, until = of[group[lasts]], t[lasts], until[lasts]
    return _counted(own, others, of, t, until, vertical)


def _runs(groups: Integers, begins: Integers, ends: Integers) -> tuple[Integers, Integers]:
    """For each group all numbers from its begin to before its end: groups, and numbers."""
    counts = ends - begins
    shifts = np.repeat(np.cumsum(counts) - counts, counts)
    numbers = np.arange(int(counts.sum())) - shifts + np.repeat(begins, counts)
    return np.repeat(groups, counts), numbers


def _counted(
    own: Columns, others: Columns, of: Integers, t: FloatArray, until: FloatArray, vertical: Metre
) -> Pieces:
    """The parts of pieces in which height is not certain to keep apart; at most one in each."""
    middle, alone = 0.5 * (t + until), np.zeros(len(of), dtype=np.intp)
    begin, end = t.copy(), until.copy()
    enough = vertical - WHOLE_METRE
    (low, high), (low_end, high_end) = (own.heights(alone, at, middle) for at in (t, until))
    (floor, top), (floor_end, top_end) = (others.heights(of, at, middle) for at in (t, until))
    for gap, then in ((low - top, low_end - top_end), (floor - high, floor_end - high_end)):
        # below `enough` in one interval, as it is linear
        rise = np.where(then != gap, then - gap, 1.0)
        cross = t + (enough - gap) / rise * (until - t)
        begin = np.where((gap >= enough) & (then < enough), np.maximum(begin, cross), begin)
        end = np.where((gap < enough) & (then >= enough), np.minimum(end, cross), end)
        end = np.where((gap >= enough) & (then >= enough), begin, end)
    counts = end > begin
    of, alone, begin, end, middle = (
        of[counts], alone[counts], begin[counts], end[counts], middle[counts],
    )  # fmt: skip
    return Pieces(
        of,
        begin,
        end - begin,
        *own.motion(alone, begin, middle),
        *others.motion(of, begin, middle),
    )


def vertical_gap(own: Columns, others: Columns, of: Integers, t: FloatArray) -> FloatArray:
    """Least height between an aircraft and others at times [m]; ≤ 0 where none is certain."""
    low, high = own.heights(np.zeros(len(of), dtype=np.intp), t, t)
    floor, top = others.heights(of, t, t)
    return np.maximum(np.maximum(low - top, floor - high), 0.0)
