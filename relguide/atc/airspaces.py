"""Whether a track comes into closed airspace: exact for its straight lines and a bound about them.

Over the time that an airspace is closed, and that the track may be at its levels, each straight
line of the track is a segment. Its least distance to the polygon is 0 inside; outside it is the
least of that to each edge, and two segments that do not cross are closest at an end of one.
"""

from typing import NamedTuple

import numpy as np

from relguide.atc.picture import Airspace
from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.units import Metre, Second

_UNBOUNDED: Metre = 1e9
"""An altitude that no aircraft has, in place of an infinite one [m]."""


class Entry(NamedTuple):
    """How near a track comes to a closed airspace."""

    ident: str
    least: Metre
    """From its edge; 0 inside [m]."""
    at: Second
    """When it is there, or first inside [s]."""


def entries(
    track: Track, airspaces: tuple[Airspace, ...], *, begin: Second, end: Second, bound: Metre,
    spare: Metre,
) -> tuple[Entry, ...]:  # fmt: skip
    """The airspaces that a track comes into, or as near as a bound and its error; soonest first.

    Args:
        track: over the ground.
        airspaces: all that there are.
        begin: from when on, in the clock of the sky [s].
        end: until when [s].
        bound: how far the aircraft may be from its track [m].
        spare: … and from its level [m].
    """
    found = []
    for airspace in airspaces:
        entry = _nearest(track, airspace, begin, end, spare)
        if entry is not None and entry.least <= bound + track.error:
            found.append(entry)
    return tuple(sorted(found, key=lambda entry: entry.at))


def _nearest(
    track: Track, airspace: Airspace, begin: Second, end: Second, spare: Metre
) -> Entry | None:
    """How near it comes while the airspace counts; `None` if it never counts."""
    begin, end = max(begin, airspace.since), min(end, airspace.until)
    if end <= begin:
        return None
    inside = track.t[(track.t > begin) & (track.t < end)]
    times = np.concatenate(([begin], inside, [end]))
    a, b = _at_levels(track, airspace, times[:-1], times[1:], spare)
    if not len(a):
        return None
    starts, ends = _places(track, a), _places(track, b)
    corners = np.column_stack((airspace.x, airspace.y))
    share, least = _to_polygon(starts, ends, corners)
    k = int(np.argmin(least))  # the first of equal ones: 0 is the entry
    return Entry(airspace.ident, float(least[k]), float(a[k] + share[k] * (b[k] - a[k])))


def _at_levels(
    track: Track, airspace: Airspace, a: FloatArray, b: FloatArray, spare: Metre
) -> tuple[FloatArray, FloatArray]:
    """The parts of straight lines that may be between an airspace's floor and its ceiling."""
    (low, high), (low_end, high_end) = _heights(track, a), _heights(track, b)
    begin, end = a.copy(), b.copy()
    floor, ceiling = max(airspace.low, -_UNBOUNDED), min(airspace.high, _UNBOUNDED)
    for above, above_end in (
        (high - floor + spare, high_end - floor + spare),
        (ceiling - low + spare, ceiling - low_end + spare),
    ):
        rise = np.where(above_end != above, above_end - above, 1.0)
        cross = a - above / rise * (b - a)
        begin = np.where((above < 0.0) & (above_end >= 0.0), np.maximum(begin, cross), begin)
        end = np.where((above >= 0.0) & (above_end < 0.0), np.minimum(end, cross), end)
        end = np.where((above < 0.0) & (above_end < 0.0), begin, end)
    counts = end > begin
    return begin[counts], end[counts]


def _heights(track: Track, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds on the altitude at times [m]."""
    low, high = np.maximum(track.low, -_UNBOUNDED), np.minimum(track.high, _UNBOUNDED)
    return np.interp(t, track.t, low), np.interp(t, track.t, high)


def _places(track: Track, t: FloatArray) -> FloatArray:
    """Where a track is at times; shape (n, 2)."""
    return np.array([track.place(time) for time in t.tolist()])


def _to_polygon(
    starts: FloatArray, ends: FloatArray, corners: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Least distance from segments to a polygon, and where on each segment it is.

    Args:
        starts: of the segments. shape (n, 2)
        ends: … and their ends. shape (n, 2)
        corners: of the polygon in turn. shape (m, 2)

    Returns:
        the share of each segment up to there, and the distance, 0 inside [m]. shape (n,) each
    """
    following = np.roll(corners, -1, axis=0)
    way, edge = ends - starts, following - corners
    shares = [np.where(_within(starts, corners), 0.0, np.inf)]
    # crossings: starts + s way = corner + e edge
    offset = corners[None] - starts[:, None]  # (n, m, 2)
    cross = way[:, None, 0] * edge[None, :, 1] - way[:, None, 1] * edge[None, :, 0]
    safe = np.where(cross != 0.0, cross, 1.0)
    s = (offset[..., 0] * edge[None, :, 1] - offset[..., 1] * edge[None, :, 0]) / safe
    e = (offset[..., 0] * way[:, None, 1] - offset[..., 1] * way[:, None, 0]) / safe
    crosses = (cross != 0.0) & (s >= 0.0) & (s <= 1.0) & (e >= 0.0) & (e <= 1.0)
    shares.append(np.min(np.where(crosses, s, np.inf), axis=1))
    first = np.minimum(*shares)
    best, at = np.full(len(starts), np.inf), np.zeros(len(starts))
    for share, far in (
        _from_points(starts, corners, edge, 0.0),
        _from_points(ends, corners, edge, 1.0),
        _from_corners(starts, way, corners),
    ):
        nearer = far < best
        best, at = np.where(nearer, far, best), np.where(nearer, share, at)
    hits = np.isfinite(first)
    return np.where(hits, first, at), np.where(hits, 0.0, best)


def _from_points(
    points: FloatArray, corners: FloatArray, edge: FloatArray, share: float
) -> tuple[FloatArray, FloatArray]:
    """From points to the nearest edge."""
    offset = points[:, None] - corners[None]
    along = np.sum(offset * edge[None], axis=2) / np.maximum(np.sum(edge * edge, axis=1), 1e-12)
    rest = offset - np.clip(along, 0.0, 1.0)[..., None] * edge[None]
    return np.full(len(points), share), np.min(np.hypot(rest[..., 0], rest[..., 1]), axis=1)


def _from_corners(
    starts: FloatArray, way: FloatArray, corners: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """From segments to the nearest corner, and where on each."""
    offset = corners[None] - starts[:, None]
    squared = np.maximum(np.sum(way * way, axis=1), 1e-12)
    along = np.clip(np.sum(offset * way[:, None], axis=2) / squared[:, None], 0.0, 1.0)
    rest = offset - along[..., None] * way[:, None]
    far = np.hypot(rest[..., 0], rest[..., 1])
    k = np.argmin(far, axis=1)
    rows = np.arange(len(starts))
    return along[rows, k], far[rows, k]


def _within(points: FloatArray, corners: FloatArray) -> np.ndarray:
    """Whether points lie inside a polygon, by the parity of crossings to the east; shape (n,)."""
    x, y = points[:, None, 0], points[:, None, 1]
    ax, ay = corners[None, :, 0], corners[None, :, 1]
    bx, by = np.roll(ax, -1, axis=1), np.roll(ay, -1, axis=1)
    straddles = (ay > y) != (by > y)
    rise = np.where(by != ay, by - ay, 1.0)
    east = ax + (y - ay) / rise * (bx - ax) > x
    odd: np.ndarray = np.sum(straddles & east, axis=1) % 2 == 1
    return odd
