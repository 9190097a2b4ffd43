"""A path to be tracked: pieces of constant curvature, and how an aircraft that rolls flies them.

A plan changes its bank at once. An aircraft rolls at a constant rate, in time to have half of the
roll behind it where the plan switches: so the path it can fly has curvature ramps centred on the
switches. Only the heading is smoothed so; the ramps displace the path by Δκ h²/6, some metres,
which the feedback removes.
"""

from math import cos, sin

import numpy as np
from numba import njit

from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import bank_for_turn_rate

S, X, Y, HEADING, CURVATURE, RAMP = 0, 1, 2, 3, 4, 5
"""Columns of a path's rows: length before the piece [m], where it begins [m], the heading there
[rad, continuous], its curvature [rad/m, right positive], half the length of the ramp there [m]."""
KEPT = 4_000.0
"""Of a path that has been flown, so much is kept, for its ramps [m]."""
ROLL_SHARE = 0.67
"""Ramps roll at this share of what the type can: an aircraft that rolls 30 % slower still does.
At 0.8 a plan begins a second sooner, but such an aircraft strays by half a kilometre in a row of
reversals."""


@njit(cache=True, nogil=True)
def lay_path(
    x: float, y: float, heading: float, bends: FloatArray, tas: float, bank: float, roll_rate: float
) -> FloatArray:
    """A path from its pieces, with an endless straight behind them.

    Args:
        x: east of its start, in the air mass [m].
        y: north [m].
        heading: there [rad].
        bends: length [m] and curvature [rad/m, right positive] of each piece. shape (n, 2)
        tas: at which it is flown [m/s].
        bank: of the aircraft at its start [rad].
        roll_rate: fastest of the aircraft [rad/s].

    Returns:
        rows as above. shape (n + 1, 6)
    """
    rows = np.empty((len(bends) + 1, 6))
    s, before = 0.0, bank
    for k in range(len(rows)):
        curvature = bends[k, 1] if k < len(bends) else 0.0
        after = bank_for_turn_rate(tas, tas * curvature)
        rows[k, S], rows[k, X], rows[k, Y], rows[k, HEADING] = s, x, y, heading
        rows[k, CURVATURE] = curvature
        rows[k, RAMP] = 0.5 * tas * abs(after - before) / (ROLL_SHARE * roll_rate)
        before = after
        if k < len(bends):
            s += bends[k, 0]
            x, y, heading = advance(x, y, heading, 1.0, curvature, bends[k, 0])
    rows[0, RAMP] = 0.0  # what the aircraft does at the start is its own affair
    return rows


@njit(cache=True, nogil=True)
def row_at(path: FloatArray, s: float) -> int:
    """The row that length s [m] lies on; before the start it is the first."""
    k = len(path) - 1
    while k > 0 and path[k, S] > s:
        k -= 1
    return k


@njit(cache=True, nogil=True)
def pose_on(path: FloatArray, s: float) -> tuple[float, float, float]:
    """Where the path is at length s [m], and its heading there, as planned."""
    k = row_at(path, s)
    row = path[k]
    return advance(row[X], row[Y], row[HEADING], 1.0, row[CURVATURE], s - row[S])


@njit(cache=True, nogil=True)
def heading_on(path: FloatArray, s: float) -> float:
    """The heading at length s [m] of an aircraft that rolls [rad, continuous].

    Within h of a switch at s_k: ψ + Δκ (h − |s − s_k|)²/(4 h).
    """
    k = row_at(path, s)
    heading = path[k, HEADING] + path[k, CURVATURE] * (s - path[k, S])
    for i in range(1, len(path)):
        h = path[i, RAMP]
        inside = h - abs(s - path[i, S])
        if inside > 0.0:
            bend = path[i, CURVATURE] - path[i - 1, CURVATURE]
            heading += bend * inside * inside / (4.0 * h)
    return float(heading)


@njit(cache=True, nogil=True)
def project(path: FloatArray, x: float, y: float, s: float) -> tuple[float, float]:
    """The point of the path next to a place.

    Args:
        path: rows.
        x: east, in the path's own frame [m].
        y: north [m].
        s: about where it should be [m].

    Returns:
        its length [m], and how far to the right of the path the place is [m].
    """
    right = 0.0
    for _ in range(3):
        px, py, heading = pose_on(path, s)
        ahead = (x - px) * sin(heading) + (y - py) * cos(heading)
        right = (x - px) * cos(heading) - (y - py) * sin(heading)
        bend = path[row_at(path, s), CURVATURE]
        s += ahead / max(1.0 - bend * right, 0.2)
    return s, right


@njit(cache=True, nogil=True)
def turning_after(path: FloatArray, s: float) -> float:
    """How much the path turns beyond length s, left and right added [rad]."""
    turned = 0.0
    for k in range(len(path) - 1):
        length = path[k + 1, S] - max(path[k, S], s)
        if length > 0.0:
            turned += abs(path[k, CURVATURE]) * length
    return turned


@njit(cache=True, nogil=True)
def splice(
    path: FloatArray, s: float, cut: float, bends: FloatArray, tas: float, roll_rate: float
) -> FloatArray:
    """The path up to a length, and other pieces from there on, with an endless straight behind.

    Args:
        path: rows; those that end behind `s` are left out.
        s: where the aircraft is on it [m].
        cut: where the new pieces begin [m], > s.
        bends: length [m] and curvature [rad/m, right positive] of each new piece. shape (n, 2)
        tas: at which it is flown [m/s].
        roll_rate: fastest of the aircraft [rad/s].

    Returns:
        rows; lengths go on from those of the path. shape (k + n + 1, 6)
    """
    last = row_at(path, cut)
    first = min(row_at(path, s - KEPT), last)
    x, y, heading = pose_on(path, cut)
    added = lay_path(x, y, heading, bends, tas, 0.0, roll_rate)
    kept = last - first + 1
    rows = np.empty((kept + len(added), 6))
    rows[:kept] = path[first : last + 1]
    rows[kept:] = added
    rows[kept:, S] += cut
    before = bank_for_turn_rate(tas, tas * path[last, CURVATURE])
    after = bank_for_turn_rate(tas, tas * added[0, CURVATURE])
    rows[kept, RAMP] = 0.5 * tas * abs(after - before) / (ROLL_SHARE * roll_rate)
    return rows


@njit(cache=True, nogil=True)
def pieces_between(path: FloatArray, s: float, until: float) -> FloatArray:
    """Length and curvature of each piece between two lengths [m], a row each."""
    first, last = row_at(path, s), row_at(path, until)
    pieces = np.empty((last - first + 1, 2))
    for k in range(first, last + 1):
        end = path[k + 1, S] if k < last else until
        pieces[k - first, 0] = end - max(path[k, S], s)
        pieces[k - first, 1] = path[k, CURVATURE]
    return pieces
