"""Recorded positions and velocities, noisy and with holes, made into a smooth motion.

ADS-B positions come about once a second, are stamped late by something that wanders by half a
second (50–100 m along the track, 10 kt in a speed made of them), repeat while nothing new was heard
and now and then are simply wrong. Broadcast velocities are good to a knot and say nothing of where.
So: keep the longest chain of points that one aircraft can have flown, integrate the velocities, and
correct the result by a slow smoothing spline through what is left of the positions,
min Σ (xᵢ − ∫v − f(tᵢ))² + λ ∫ f″², which passes what takes longer than λ^¼ seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from relguide.flying.spline import Array, smoothing_spline

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
MAX_ACCELERATION = 20.0
"""Fastest believable change of velocity [m/s²], 2 g."""
VELOCITY_SLACK = 10.0
"""What a broadcast velocity may be wrong by [m/s]: NACv 1."""
VELOCITY_SMOOTHING = 2.0
"""λ^¼ for velocities [s]: steps of 1 kt, and an airliner rolls into a turn in 7 s."""
POSITION_SMOOTHING = 40.0
"""λ^¼ for positions beside integrated velocities [s]: time stamps wander within 10–20 s."""
BARE_SMOOTHING = 8.0
"""λ^¼ for positions without velocities [s]: the best match to broadcast velocities on samples."""
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
    unbelieved: int
    """How many positions between its ends no aircraft can have flown."""


def smooth_motion(
    t: Array, place: Array, velocity: Array, altitude: Array, *, step: float
) -> SmoothMotion:
    """The longest believable stretch of a recording, smooth.

    Args:
        t: time stamps [s], in any order.
        place: (n, 2), east and north [m]; NaN where it is missing.
        velocity: (n, 2), over the ground toward the east and north [m/s]; NaN where it is missing.
        altitude: (n,) [m]; NaN where it is missing.
        step: of the even grid [s].

    Raises:
        ValueError: if no stretch of the recording is long enough.
    """
    order = np.argsort(t, kind="stable")
    t, place, velocity, altitude = t[order], place[order], velocity[order], altitude[order]
    fresh = _drop_repeats(place)
    at, heard = _chain(t, fresh, MAX_SPEED, POSITION_SLACK)
    if len(at) < MIN_POINTS:
        raise ValueError(
            f"has no stretch of {MIN_POINTS} positions without a gap of more than {MAX_GAP:g} s; "
            f"its longest has {len(at)}."
        )
    # 1 ms: seconds since 1970 are good to 0.2 µs
    grid = at[0] + step * np.arange(int((at[-1] - at[0] + 1e-3) / step) + 1)
    flown, smoothing = _velocity_on(grid, t, velocity), POSITION_SMOOTHING
    if flown is None:
        flown, smoothing = np.zeros((len(grid), 2)), BARE_SMOOTHING
    base = np.vstack([np.zeros(2), np.cumsum((flown[1:] + flown[:-1]) * (step / 2.0), axis=0)])
    left = heard - np.column_stack([np.interp(at, grid, base[:, k]) for k in (0, 1)])
    correction = smoothing_spline(at, left, smoothing**4)
    # what is still far off is no noise: fit once more without it
    near = np.hypot(*(correction.at(at) - left).T) < POSITION_SLACK
    if near.sum() < MIN_POINTS:
        raise ValueError(
            f"has only {near.sum()} positions near a smooth path; {MIN_POINTS} are needed."
        )
    correction = smoothing_spline(at[near], left[near], smoothing**4)
    x, y = (base + correction.at(grid)).T
    east, north = (flown + correction.slope_at(grid)).T
    level = _altitude_on(grid, t, altitude)
    return SmoothMotion(
        t=grid,
        x=x,
        y=y,
        east=east,
        north=north,
        altitude=level,
        unbelieved=int(np.sum(_known(fresh) & (t >= at[0]) & (t <= at[-1])) - near.sum()),
    )


def _velocity_on(grid: Array, t: Array, velocity: Array) -> Array | None:
    """Broadcast velocities on the grid; none if they leave a part of it out."""
    at, heard = _chain(t, velocity, MAX_ACCELERATION, VELOCITY_SLACK)
    if len(at) < MIN_POINTS or at[0] > grid[0] + MAX_GAP or at[-1] < grid[-1] - MAX_GAP:
        return None
    smooth = smoothing_spline(at, heard, VELOCITY_SMOOTHING**4)
    return smooth.at(np.clip(grid, at[0], at[-1]))


def _altitude_on(grid: Array, t: Array, altitude: Array) -> Array:
    inside = (t >= grid[0]) & (t <= grid[-1])
    at, heard = _chain(t[inside], altitude[inside, None], MAX_CLIMB, ALTITUDE_SLACK)
    if len(at) < MIN_POINTS:
        raise ValueError(f"has only {len(at)} believable altitudes; {MIN_POINTS} are needed.")
    # constant beyond the altitudes that were heard: a cubic would run away
    smooth = smoothing_spline(at, heard, ALTITUDE_SMOOTHING**4)
    return smooth.at(np.clip(grid, at[0], at[-1]))[:, 0]


def _chain(t: Array, values: Array, max_rate: float, slack: float) -> tuple[Array, Array]:
    """The longest believable chain of the values that are not missing."""
    known = _known(values)
    t, values = t[known], values[known]
    chain = longest_chain(t, values, max_rate, slack)
    return t[chain], values[chain]


def _known(values: Array) -> NDArray[np.bool_]:
    known: NDArray[np.bool_] = np.all(np.isfinite(values), axis=1)
    return known


def _drop_repeats(place: Array) -> Array:
    """Places that are not held over from the row before; the others are missing."""
    held = np.all(np.diff(place, axis=0, prepend=np.nan) == 0.0, axis=1)
    return np.where(held[:, None], np.nan, place)


def longest_chain(t: Array, values: Array, max_rate: float, slack: float) -> NDArray[np.intp]:
    """Indices of the longest chain of points that one moving thing can have made.

    Neighbours in the chain are at most `MAX_GAP` apart, not at the same time, and differ by no
    more than max_rate·Δt + slack. Dynamic programming: the longest chain that ends at i is one
    longer than the longest that ends at a point i can follow. Mostly that is the point before it,
    where none of the chains so far is longer.

    Args:
        t: rising [s], repeats allowed.
        values: (n, k), in units of their own.
        max_rate: largest rate of |values| [units/s].
        slack: what they may jump by besides [units].
    """
    n = len(t)
    longest, before = np.ones(n, dtype=np.intp), np.full(n, -1, dtype=np.intp)
    first = np.searchsorted(t, t - MAX_GAP)
    steps, jumps = np.diff(t), np.sqrt(np.sum(np.diff(values, axis=0) ** 2, axis=1))
    near = (steps > 0.0) & (jumps <= max_rate * steps + slack) & (first[1:] < np.arange(1, n))
    top = 1
    for i in range(1, n):
        top = max(top, int(longest[i - 1]))
        if near[i - 1] and longest[i - 1] == top:
            longest[i], before[i] = top + 1, i - 1
            continue
        window = slice(int(first[i]), i)
        jump = np.sqrt(np.sum((values[window] - values[i]) ** 2, axis=1))
        elapsed = t[i] - t[window]
        reachable = np.flatnonzero((jump <= max_rate * elapsed + slack) & (elapsed > 0.0))
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
