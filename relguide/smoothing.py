"""Recorded positions, noisy and with holes, made into a smooth motion on an even time grid.

ADS-B positions come about once a second, stamped to the second (an error of up to 100 m along the
track), repeat while nothing new was heard, and now and then are simply wrong. So: drop the repeats,
keep the longest chain of points that one aircraft can have flown, and lay a smoothing spline
through it, min Σ (xᵢ − f(tᵢ))² + λ ∫ f″², which passes motions slower than λ^¼ seconds.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MAX_GAP = 30.0
"""Longest silence that is bridged [s]: surveillance drops a track after as long."""
MAX_SPEED = 450.0
"""Fastest believable ground speed [m/s]: 400 m/s true airspeed in a jet stream."""
POSITION_SLACK = 300.0
"""What position and time stamp may be wrong by, together [m]."""
MAX_CLIMB = 60.0
"""Fastest believable climb or descent [m/s], 12,000 ft/min."""
ALTITUDE_SLACK = 30.0
"""Quantum of 100 ft in old transponders [m]."""
TRACK_SMOOTHING = 4.0
"""λ^¼ for positions [s]: an airliner rolls into a turn in 7 s."""
ALTITUDE_SMOOTHING = 10.0
"""λ^¼ for altitudes [s]: steps of 25 ft at 1,500 ft/min come every second."""
MIN_POINTS = 30
"""Fewest positions that make a track."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SmoothMotion:
    """A motion at even steps; all arrays have the same length."""

    t: Array
    """On the clock of the recording [s]."""
    x: Array
    """East [m]."""
    y: Array
    """North [m]."""
    east: Array
    """Ground velocity toward the east [m/s]."""
    north: Array
    """Ground velocity toward the north [m/s]."""
    altitude: Array
    """[m]."""


def smooth_motion(t: Array, x: Array, y: Array, altitude: Array, *, step: float) -> SmoothMotion:
    """The longest believable stretch of a recording, smooth.

    Args:
        t: time stamps [s], in any order.
        x: east [m].
        y: north [m].
        altitude: [m]; NaN where it is missing.
        step: of the even grid [s].

    Raises:
        ValueError: if no stretch of the recording is long enough.
    """
    t, x, y, altitude = _heard(t, x, y, altitude)
    chain = believable(t, np.column_stack([x, y]), MAX_SPEED, POSITION_SLACK)
    if len(chain) < MIN_POINTS:
        raise ValueError(
            f"has no stretch of {MIN_POINTS} positions without a gap of more than {MAX_GAP:g} s; "
            f"its longest has {len(chain)}."
        )
    at, x, y = t[chain], x[chain], y[chain]
    grid = np.arange(at[0], at[-1] + 1e-9, step)
    # a residual this large is no noise: fit once more without those points
    fit_x, fit_y = _spline(at, x, TRACK_SMOOTHING), _spline(at, y, TRACK_SMOOTHING)
    near = np.hypot(fit_x(at) - x, fit_y(at) - y) < POSITION_SLACK
    fit_x = _spline(at[near], x[near], TRACK_SMOOTHING)
    fit_y = _spline(at[near], y[near], TRACK_SMOOTHING)
    return SmoothMotion(
        t=grid,
        x=fit_x(grid),
        y=fit_y(grid),
        east=fit_x(grid, 1),
        north=fit_y(grid, 1),
        altitude=_smooth_altitude(t, altitude, grid),
    )


def believable(t: Array, values: Array, max_rate: float, slack: float) -> NDArray[np.intp]:
    """Indices of the longest chain of points that one moving thing can have made.

    Neighbours in the chain are at most `MAX_GAP` apart and differ by no more than
    max_rate·Δt + slack. Dynamic programming: the longest chain that ends at i is one longer than
    the longest that ends at a point i can follow.

    Args:
        t: rising [s].
        values: (n, k), in units of their own.
        max_rate: largest rate of |values| [units/s].
        slack: what they may jump by besides [units].
    """
    n = len(t)
    longest, before = np.ones(n, dtype=np.intp), np.full(n, -1, dtype=np.intp)
    first = np.searchsorted(t, t - MAX_GAP)
    for i in range(1, n):
        window = slice(int(first[i]), i)
        jump = np.sqrt(np.sum((values[window] - values[i]) ** 2, axis=1))
        reachable = np.flatnonzero(jump <= max_rate * (t[i] - t[window]) + slack)
        if reachable.size:
            # the latest of the longest, so that chains do not skip points
            best = reachable[::-1][np.argmax(longest[window][reachable[::-1]])] + window.start
            longest[i], before[i] = longest[best] + 1, best
    chain = []
    i = int(np.argmax(longest)) if n else -1
    while i >= 0:
        chain.append(i)
        i = int(before[i])
    return np.array(chain[::-1], dtype=np.intp)


def _heard(t: Array, *columns: Array) -> tuple[Array, ...]:
    """In order of time, without rows that repeat a time or, held, the position before."""
    order = np.argsort(t, kind="stable")
    t, x, y, altitude = t[order], *(column[order] for column in columns)
    known = np.isfinite(t) & np.isfinite(x) & np.isfinite(y)
    t, x, y, altitude = t[known], x[known], y[known], altitude[known]
    moved = (np.diff(x, prepend=np.inf) != 0.0) | (np.diff(y, prepend=np.inf) != 0.0)
    new = moved & (np.diff(t, prepend=-np.inf) > 0.0)
    return t[new], x[new], y[new], altitude[new]


def _smooth_altitude(t: Array, altitude: Array, grid: Array) -> Array:
    near = (t >= grid[0]) & (t <= grid[-1]) & np.isfinite(altitude)
    t, altitude = t[near], altitude[near]
    chain = believable(t, altitude[:, None], MAX_CLIMB, ALTITUDE_SLACK)
    if len(chain) < MIN_POINTS:
        raise ValueError(f"has only {len(chain)} believable altitudes; {MIN_POINTS} are needed.")
    at, altitude = t[chain], altitude[chain]
    # constant beyond the altitudes that were heard: a cubic would run away
    smooth: Array = _spline(at, altitude, ALTITUDE_SMOOTHING)(np.clip(grid, at[0], at[-1]))
    return smooth


def _spline(t: Array, values: Array, seconds: float) -> Any:
    # 0.2 s to import, and only recorded tracks need it
    from scipy.interpolate import make_smoothing_spline  # type: ignore[import-untyped]

    return make_smoothing_spline(t, values, lam=seconds**4)
