"""How near a track comes to many others, exactly, and how near what may differ brings them.

In a piece of time in which both fly straight, with Δp and Δv at its begin, s = |Δv| and
h = |Δp × Δv| / s, they are d(τ) = √(h² + s² (τ − τ₀)²) apart, τ₀ = −Δp·Δv / s². Both least values
are in closed form,

    min d          at τ = τ₀,
    min d − g τ    at τ = τ₀ + g h / (s √(s² − g²))       for a bound that grows by g < s,

held to the piece: d is convex, and so is d − g τ. Both are conflicted between the roots of

    (s² − g²) τ² + 2 (Δp·Δv − M g) τ + |Δp|² − M² = 0,    M the bound at the begin.

The wind moves all alike, so tracks over the ground suffice.
"""

from collections.abc import Sequence
from math import inf, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.atc.bounds import Stray
from relguide.atc.fans import Fans, least_margin
from relguide.atc.pieces import Columns, Pieces, columns_of, edges_of, pieces_of, vertical_gap
from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.units import NM, Metre, Radian, Second

SHOWN: Metre = 5.0 * NM
"""Others that come no nearer than this beyond their bound are left out [m]."""


class Other(NamedTuple):
    """Another aircraft, and how far one is to keep from it."""

    track: Track
    minimum: Metre
    """What is to be kept [m]."""
    stray: Stray
    """How far both together may be from their tracks, beside the tracks' errors."""
    fan: Radian = nan
    """It may turn by so much to either side from the track's first knot on; NaN: it will not."""


class Approach(NamedTuple):
    """How near another aircraft comes."""

    number: int
    """Of the other, in the order given."""
    at: Second
    """When both are closest on their tracks …"""
    least: Metre
    """… and how close."""
    margin: Metre
    """Least of the distance less all that may differ and the minimum: proved, negative if lost."""
    bound: Metre
    """What is added for what may differ, where the margin is least."""
    vertical: Metre
    """Height that is certain between them when they are closest; 0 without any."""
    since: Second
    """From when the margin is negative …"""
    until: Second
    """… until when; both are `at` where it never is."""


def probe(
    own: Track, others: Sequence[Other], *, begin: Second, end: Second, vertical: Metre
) -> tuple[Approach, ...]:
    """How near a track comes to each of many others, while height does not keep them apart.

    Args:
        own: the track.
        others: all others.
        begin: from when on, in the clock of the sky [s].
        end: until when [s].
        vertical: height that keeps apart [m].

    Returns:
        those that come near, or may; all others keep `SHOWN` more than they must, or height.
    """
    if not others or end <= begin:
        return ()
    ours = columns_of([own], begin, end)
    theirs = columns_of([other.track for other in others], begin, end)
    errors = np.array([own.error + other.track.error for other in others])
    minima = np.array([other.minimum for other in others])
    strays = np.array([other.stray for other in others])
    # (n, 3): the bound grows from `since` on, which may lie before the begin
    growth = strays[:, 1]
    first = strays[:, 0] + growth * (begin - strays[:, 2])
    kept = minima + errors + first
    edges = edges_of(end - begin)
    near = _near(ours, theirs, edges, kept + growth * (end - begin) + SHOWN)
    pieces = pieces_of(ours, theirs, edges, near, vertical)
    found = _on_tracks(pieces, kept, growth, len(others))
    halves = np.array([other.fan for other in others])
    fanned = np.isfinite(halves)
    if fanned.any():
        _in_fans(found, ours, theirs, edges, kept, growth, halves, vertical)
        unseen = np.isinf(found.least) & (found.margin < SHOWN)
        everywhere = np.repeat(unseen[:, None], len(edges) - 1, axis=1)
        straight_on = _on_tracks(
            pieces_of(ours, theirs, edges, everywhere, vertical), kept, growth, len(others)
        )
        found.least[unseen], found.at[unseen] = straight_on.least[unseen], straight_on.at[unseen]
    # of others, windows in which they are nearer may have been left out
    listed = np.flatnonzero(found.margin < SHOWN)
    heights = vertical_gap(ours, theirs, listed, found.at[listed])
    return tuple(
        Approach(
            number=int(i),
            at=begin + float(found.at[i]),
            least=float(found.least[i]),
            margin=float(found.margin[i]),
            bound=float(first[i] + growth[i] * found.margin_at[i]),
            vertical=float(height),
            since=begin + float(found.since[i] if found.margin[i] < 0.0 else found.at[i]),
            until=begin + float(found.until[i] if found.margin[i] < 0.0 else found.at[i]),
        )
        for i, height in zip(listed, heights, strict=True)
    )


class _Found(NamedTuple):
    """Of each other the best so far; infinite without any. shape (n,) each."""

    at: FloatArray
    least: FloatArray
    margin_at: FloatArray
    margin: FloatArray
    since: FloatArray
    until: FloatArray


def _near(own: Columns, others: Columns, edges: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
    """Whether others may come within their reach in each window; shape (n, w)."""
    middles, half = 0.5 * (edges[:-1] + edges[1:]), 0.5 * (edges[1] - edges[0])
    n, w = len(reach), len(middles)
    x, y, _, _ = own.motion(np.zeros(w, dtype=np.intp), middles, middles)
    of, t = np.repeat(np.arange(n), w), np.tile(middles, n)
    other_x, other_y, _, _ = others.motion(of, t, t)
    apart = np.hypot(other_x.reshape(n, w) - x, other_y.reshape(n, w) - y)
    moved: NDArray[np.bool_] = apart <= (reach + (own.fastest[0] + others.fastest) * half)[:, None]
    return moved


def _on_tracks(pieces: Pieces, kept: FloatArray, growth: FloatArray, n: int) -> _Found:
    """Closest approaches, and least margins, on the tracks."""
    found = _Found(*(np.full(n, start) for start in (0.0, inf, 0.0, inf, inf, -inf)))
    if not len(pieces.of):
        return found
    dx, dy = pieces.own_x - pieces.x, pieces.own_y - pieces.y
    dvx, dvy = pieces.own_east - pieces.east, pieces.own_north - pieces.north
    length, grows = pieces.length, growth[pieces.of]
    bound = kept[pieces.of] + grows * pieces.begin
    squared = dvx * dvx + dvy * dvy
    s = np.sqrt(squared)
    still = squared < 1e-12  # a micrometre a second
    safe = np.where(still, 1.0, squared)
    closest = np.where(still, 0.0, -(dx * dvx + dy * dvy) / safe)
    aside = np.abs(dx * dvy - dy * dvx) / np.sqrt(safe)
    over = squared - grows * grows
    behind = grows * aside / np.sqrt(safe * np.maximum(over, 1e-12))
    tightest = np.where(over > 0.0, closest + behind, length)
    at = np.clip(closest, 0.0, length)
    margin_at = np.clip(tightest, 0.0, length)
    least = np.hypot(dx + dvx * at, dy + dvy * at)
    margin = np.hypot(dx + dvx * margin_at, dy + dvy * margin_at) - bound - grows * margin_at
    _take(found.at, found.least, pieces.of, pieces.begin + at, least)
    _take(found.margin_at, found.margin, pieces.of, pieces.begin + margin_at, margin)
    lost = margin < 0.0
    half_b = dx * dvx + dy * dvy - bound * grows
    root = np.sqrt(np.maximum(half_b**2 - over * (dx * dx + dy * dy - bound * bound), 0.0))
    crosses = lost & (over > 0.0) & (s > 0.0)
    divisor = np.where(crosses, over, 1.0)
    since = np.where(crosses, np.clip((-half_b - root) / divisor, 0.0, length), 0.0)
    until = np.where(crosses, np.clip((-half_b + root) / divisor, 0.0, length), length)
    np.minimum.at(found.since, pieces.of[lost], (pieces.begin + since)[lost])
    np.maximum.at(found.until, pieces.of[lost], (pieces.begin + until)[lost])
    return found


def _in_fans(
    found: _Found, own: Columns, others: Columns, edges: FloatArray, kept: FloatArray,
    growth: FloatArray, halves: FloatArray, vertical: Metre,
) -> None:  # fmt: skip
    """Lower the margins of those that may turn within a fan."""
    heads = others.first[:-1]
    time = others.t[heads + 1] - others.t[heads]
    east = (others.x[heads + 1] - others.x[heads]) / time
    north = (others.y[heads + 1] - others.y[heads]) / time
    fans = Fans(others.x[heads], others.y[heads], others.t[heads], east, north,
                np.hypot(east, north), np.where(np.isfinite(halves), halves, 0.0))  # fmt: skip
    numbers = np.flatnonzero(np.isfinite(halves))
    n, w = len(numbers), len(edges) - 1
    middles, half = 0.5 * (edges[:-1] + edges[1:]), 0.5 * (edges[1] - edges[0])
    x, y, _, _ = own.motion(np.zeros(w, dtype=np.intp), middles, middles)
    of = np.repeat(numbers, w)
    apart = fans.taken(of).distance(np.tile(x, n), np.tile(y, n), np.tile(middles, n))
    limit = (kept + growth * edges[-1] + (own.fastest[0] + fans.speed) * half)[numbers]
    near = np.zeros((len(halves), w), dtype=bool)
    near[numbers] = apart.reshape(n, w) <= limit[:, None]
    pieces = pieces_of(own, others, edges, near, vertical)
    if not len(pieces.of):
        return
    grows = growth[pieces.of]
    bound = kept[pieces.of] + grows * pieces.begin
    margin, at = least_margin(pieces, fans.taken(pieces.of), bound, grows)
    _take(found.margin_at, found.margin, pieces.of, pieces.begin + at, margin)
    lost = margin < 0.0
    np.minimum.at(found.since, pieces.of[lost], pieces.begin[lost])
    np.maximum.at(found.until, pieces.of[lost], (pieces.begin + pieces.length)[lost])


def _take(
    at: FloatArray, least: FloatArray, of: NDArray[np.intp], when: FloatArray, value: FloatArray
) -> None:
    """Keep of each other the least value and when it is, the sooner of equal ones."""
    order = np.lexsort((when, value, of))
    of, when, value = of[order], when[order], value[order]
    heads = np.append(True, of[1:] != of[:-1])
    of, when, value = of[heads], when[heads], value[heads]
    better = value < least[of]
    least[of[better]], at[of[better]] = value[better], when[better]
