"""How far an aircraft is from where its track has it: beside it, and before or behind it in time.

With q the nearest place of the track within `WINDOW`, flown at τ, and p the aircraft's place at t,

    along = τ − t,    across² = max(|p − q|², |p − place(t)|² − (v along)²),

where v is the track's fastest within `WINDOW`. On a straight both terms are one. Outside of a turn
the second is larger, by some tens of metres at 5 s. So |p − place(t)| ≤ hypot(across, v along)
always: what validation adds to a track holds whatever it does.
"""

from itertools import pairwise
from math import inf, isinf, sqrt
from typing import NamedTuple

import numpy as np

from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.units import Metre, Second

WINDOW: Second = 30.0
"""The nearest place is looked for so long before and behind [s]: twice the alert of `along`, and
less than it takes the steepest turn to come back near itself."""


class OffPath(NamedTuple):
    """How far a place is from a track at a time."""

    across: Metre
    """Beside it, positive to its right."""
    along: Second
    """Before it, as flown too early; negative behind it."""


def off_path(track: Track, t: Second, x: Metre, y: Metre) -> OffPath:
    """How far a place is from a track at a time.

    Args:
        track: where an aircraft is to be; before its first knot and past its last it is straight.
        t: when [s].
        x: east [m].
        y: north [m].
    """
    since, until = t - WINDOW, t + WINDOW
    first = min(max(int(np.searchsorted(track.t, since)) - 1, 0), len(track.t) - 2)
    last = max(min(int(np.searchsorted(track.t, until)), len(track.t) - 1), first + 1)
    kept = slice(first, last + 1)
    knots = list(
        zip(track.t[kept].tolist(), track.x[kept].tolist(), track.y[kept].tolist(), strict=True)
    )
    fastest, least, when, right = 0.0, inf, t, 0.0
    away = None
    for k, ((begin, ax, ay), (end, bx, by)) in enumerate(pairwise(knots)):
        final = k == len(knots) - 2
        east, north = (bx - ax) / (end - begin), (by - ay) / (end - begin)
        square = east * east + north * north
        fastest = max(fastest, square)
        dx, dy = x - ax, y - ay
        nearest = begin + (dx * east + dy * north) / max(square, 1e-12)
        nearest = max(nearest, since if k == 0 else begin)
        nearest = min(nearest, until if final else end, until)
        from_x, from_y = dx - east * (nearest - begin), dy - north * (nearest - begin)
        apart = from_x * from_x + from_y * from_y
        if apart < least:
            least, when, right = apart, nearest, from_x * north - from_y * east
        if away is None and (t <= end or final):
            away = (dx - east * (t - begin)) ** 2 + (dy - north * (t - begin)) ** 2
    assert away is not None
    across = sqrt(max(least, away - fastest * (when - t) ** 2))
    return OffPath(-across if right < 0.0 else across, when - t)


def heights(track: Track, t: Second) -> tuple[Metre, Metre]:
    """Bounds on the altitude at a time, beyond the ends those of the ends [m].

    Beside a knot where a bound is not known it is infinite.
    """
    k = min(max(int(np.searchsorted(track.t, t)) - 1, 0), len(track.t) - 2)
    begin, end = track.t[k : k + 2].tolist()
    share = min(max((t - begin) / (end - begin), 0.0), 1.0)
    return _between(track.low[k : k + 2], share), _between(track.high[k : k + 2], share)


def _between(bounds: FloatArray, share: float) -> Metre:
    before, after = bounds.tolist()
    if isinf(before) or isinf(after):
        return float(before if isinf(before) else after)
    return float(before + share * (after - before))
