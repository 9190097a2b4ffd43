"""How close a path comes to a weather cell, with a proved lower bound.

Seen from the cell, which moves straight, only the pursuer moves. The signed distance s to a convex
shape is a convex function of the place, and outside its gradient n is a unit vector. So, over a
window of half-width w about its middle, with p the pursuer seen from the cell, v its velocity there
and A = V|r| its acceleration,

    s(p(τ)) ≥ s(p₀) + n·v τ − ½ A τ²,      and with growth g:      margin = s − g t.

The least of that is at an end of the window. Windows whose bound is not above the best margin seen
are halved. World frame of the air mass; lengths [m], times [s].
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.motion import advance, motion_along
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine

ROUNDING = 1e-6
"""Taken off every proved bound for rounding [m]."""
_MOST_WINDOWS = 131_072  # after these, pending windows keep the bound they have
_DEPTH = 64


@njit(cache=True, nogil=True)
def signed_distance(x: float, y: float, corners: FloatArray, radius: float) -> FloatArray:
    """From a point to the edge of a convex shape, less a radius, and the gradient of that.

    Args:
        x: east [m].
        y: north [m].
        corners: counter-clockwise; one corner alone is a point. shape (n, 2)
        radius: how far the shape's edge lies outside its corners [m].

    Returns:
        distance, negative inside [m], and its rates to the east and to the north. shape (3,)
    """
    found = np.empty(3)
    n = len(corners)
    if n == 1:
        dx, dy = x - corners[0, 0], y - corners[0, 1]
        far = norm(dx, dy)
        found[0] = far - radius
        found[1], found[2] = (dx / far, dy / far) if far > 0.0 else (1.0, 0.0)
        return found
    inside, outside = -inf, inf
    nx, ny, ox, oy = 1.0, 0.0, 1.0, 0.0
    for i in range(n):
        ax, ay = corners[i, 0], corners[i, 1]
        ex, ey = corners[(i + 1) % n, 0] - ax, corners[(i + 1) % n, 1] - ay
        length = norm(ex, ey)
        ex, ey = ex / length, ey / length
        beyond = (x - ax) * ey - (y - ay) * ex
        if beyond > inside:
            inside, nx, ny = beyond, ey, -ex
        along = min(max((x - ax) * ex + (y - ay) * ey, 0.0), length)
        dx, dy = x - ax - along * ex, y - ay - along * ey
        far = norm(dx, dy)
        if far < outside:
            outside = far
            ox, oy = (dx / far, dy / far) if far > 0.0 else (ey, -ex)
    if inside <= 0.0:
        found[0], found[1], found[2] = inside - radius, nx, ny
    else:
        found[0], found[1], found[2] = outside - radius, ox, oy
    return found


@njit(cache=True, nogil=True)
def least_from_cell(
    path: FloatArray, corners: FloatArray, cell: FloatArray, begin: float, end: float,
    tolerance: float,
) -> tuple[float, float, float]:  # fmt: skip
    """The least distance of a path from the edge of a moving, growing cell, with a proved bound.

    Args:
        path: the pursuer's, as `motion_along` takes it; past its end it goes on straight.
        corners: the cell's at t = 0, counter-clockwise; one for a disc. shape (n, 2)
        cell: its radius [m], growth [m/s], and velocity east and north in the air mass [m/s].
            shape (4,)
        begin: from when on [s].
        end: until when [s], ≥ begin.
        tolerance: how far below the least found the bound may stay [m], > 0.

    Returns:
        least distance found, negative inside [m], when [s], proved lower bound [m].
    """
    pursuer = motion_along(path)
    radius, growth, east, north = cell
    best, best_at, proved = inf, begin, inf
    looked, t, i = 0, 0.0, 0
    x, y, psi = pursuer.x, pursuer.y, pursuer.heading
    mids, halves = np.empty(_DEPTH), np.empty(_DEPTH)
    while t < end:
        rate = pursuer.pieces[i, 1] if i < len(pursuer.pieces) else 0.0
        left = pursuer.pieces[i, 0] if i < len(pursuer.pieces) else inf
        low, high = max(begin - t, 0.0), min(left, end - t)
        mids[0], halves[0] = 0.5 * (low + high), 0.5 * (high - low)
        n = 1 if low < high else 0
        while n > 0:
            n -= 1
            looked += 1
            mid, half = mids[n], halves[n]
            px, py, heading = advance(x, y, psi, pursuer.tas, rate, mid)
            now = t + mid
            s, c = sine_and_cosine(heading)
            distance, nx, ny = signed_distance(
                px - east * now, py - north * now, corners, radius + growth * now
            )
            if distance < best:
                best, best_at = distance, now
            closing = nx * (pursuer.tas * s - east) + ny * (pursuer.tas * c - north) - growth
            bound = distance - abs(closing) * half - 0.5 * pursuer.tas * abs(rate) * half * half
            if bound >= best - tolerance or n + 2 > _DEPTH or looked > _MOST_WINDOWS:
                proved = min(proved, bound)
            else:
                near = 0.5 * half if closing <= 0.0 else -0.5 * half
                mids[n], halves[n] = mid - near, 0.5 * half
                mids[n + 1], halves[n + 1] = mid + near, 0.5 * half
                n += 2
        span = min(left, end - t)
        x, y, psi = advance(x, y, psi, pursuer.tas, rate, span)
        t += span
        i += 1
    return best, best_at, min(proved, best) - ROUNDING
