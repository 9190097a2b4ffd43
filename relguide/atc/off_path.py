"""How far an aircraft is from where its track has it: beside it, and before or behind it in time.

With q the nearest place of the track within `WINDOW`, flown at τ, and p the aircraft's place at t,

    along = τ − t,    across² = max(|p − q|², |p − place(t)|² − (v along)²),

where v is the track's fastest. On a straight both terms are one. Outside of a turn the second is
larger, by some tens of metres at 5 s. So |p − place(t)| ≤ hypot(across, v along) always: what
validation adds to a track holds whatever it does.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.units import Second

WINDOW: Second = 30.0
"""The nearest place is looked for so long before and behind [s]: twice the alert of `along`, and
less than it takes the steepest turn to come back near itself."""


class OffPath(NamedTuple):
    """How far places are from a track. shape (n,) each."""

    across: FloatArray
    """Beside it, positive to its right [m]."""
    along: FloatArray
    """Before it, as flown too early [s]; negative behind it."""


def off_path(track: Track, t: FloatArray, x: FloatArray, y: FloatArray) -> OffPath:
    """How far places are from a track at their times.

    Args:
        track: where an aircraft is to be; before its first knot and past its last it is straight.
        t: times [s]. shape (n,)
        x: east [m]. shape (n,)
        y: north [m]. shape (n,)
    """
    ends = np.array([min(track.begin, float(np.min(t))), max(track.end, float(np.max(t)))])
    knots = np.concatenate(([ends[0] - WINDOW], track.t, [ends[1] + WINDOW]))
    place_x, place_y = places(track, knots)
    spans = np.diff(knots)
    east, north = np.diff(place_x) / spans, np.diff(place_y) / spans
    # the nearest place of each piece to each aircraft, within its window: (n, m)
    first, last = knots[:-1], knots[1:]
    since = np.maximum(first, t[:, None] - WINDOW)
    until = np.minimum(last, t[:, None] + WINDOW)
    behind_x, behind_y = x[:, None] - place_x[:-1], y[:, None] - place_y[:-1]
    speeds = np.maximum(east * east + north * north, 1e-12)
    when = first + (behind_x * east + behind_y * north) / speeds
    when = np.minimum(np.maximum(when, since), until)
    from_x, from_y = behind_x - east * (when - first), behind_y - north * (when - first)
    square = np.where(since <= until, from_x * from_x + from_y * from_y, np.inf)
    row, piece = np.arange(len(t)), np.argmin(square, axis=1)
    along = when[row, piece] - t
    then_x, then_y = places(track, t)
    whole = (x - then_x) ** 2 + (y - then_y) ** 2 - (track.fastest * along) ** 2
    across = np.sqrt(np.maximum(square[row, piece], whole))
    right = from_x[row, piece] * north[piece] - from_y[row, piece] * east[piece]
    return OffPath(np.where(right < 0.0, -across, across), along)


def places(track: Track, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """As `Track.place`, at many times [m]. shape (n,) each."""
    k = np.clip(np.searchsorted(track.t, t) - 1, 0, len(track.t) - 2)
    share = (t - track.t[k]) / (track.t[k + 1] - track.t[k])
    x = track.x[k] + share * (track.x[k + 1] - track.x[k])
    y = track.y[k] + share * (track.y[k + 1] - track.y[k])
    return x, y


def heights(track: Track, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds on the altitude at many times; beyond the ends those of the ends [m]. shape (n,)."""
    k = np.clip(np.searchsorted(track.t, t) - 1, 0, len(track.t) - 2)
    share = np.clip((t - track.t[k]) / (track.t[k + 1] - track.t[k]), 0.0, 1.0)
    return _between(track.low, k, share, -np.inf), _between(track.high, k, share, np.inf)


def _between(
    bound: FloatArray, k: NDArray[np.intp], share: FloatArray, unknown: float
) -> FloatArray:
    """Unknown beside a knot where it is not known."""
    known = np.isfinite(bound)
    level = np.where(known, bound, 0.0)
    between = level[k] + share * (level[k + 1] - level[k])
    return np.where(known[k] & known[k + 1], between, unknown)
