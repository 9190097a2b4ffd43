"""Where an aircraft is at many times at once, as columns: in the air mass, or over the ground."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relguide.kernels.base.angles import wrap_each
from relguide.planning.wind import Wind

Floats = NDArray[np.float64]
LATEST = 1e9
"""Latest time that is sampled [s]: thirty years, where a metre is still a metre."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Samples:
    """Columns of one length n, each of shape (n,); angles clockwise from north."""

    t: Floats
    """From the start of the trajectory [s]."""
    x: Floats
    """East [m]."""
    y: Floats
    """North [m]."""
    heading: Floats
    """Where the nose points [rad], in [0, 2π)."""
    turn_rate: Floats
    """Positive to the right [rad/s]; at the end of a segment, that of the next one."""
    track: Floats
    """Direction of the velocity [rad], in [0, 2π); in the air mass it is the heading."""
    speed: Floats
    """Its amount [m/s]: true airspeed in the air mass, ground speed over the ground."""

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"Samples({len(self)} times: {', '.join(self.to_dict())})"

    def to_dict(self) -> dict[str, Floats]:
        """The columns by name, as data frames and savez take them."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def over_ground(self, wind: Wind) -> "Samples":
        """The same in a wind: the air mass is the world frame at t = 0, and drifts from there."""
        east = self.speed * np.sin(self.track) + wind.east
        north = self.speed * np.cos(self.track) + wind.north
        return replace(
            self,
            x=self.x + wind.east * self.t,
            y=self.y + wind.north * self.t,
            track=wrap_each(np.arctan2(east, north)),
            speed=np.hypot(east, north),
        )


def sample_bends(
    start: tuple[float, float, float],
    tas: float,
    bends: Sequence[tuple[float, float]],
    times: ArrayLike,
) -> Samples:
    """Sample pieces of constant turn rate, all times at once.

        x + V τ sinc(r τ/2) sin(ψ + r τ/2),  y likewise with cos;  τ from the piece's start

    Args:
        start: x, y [m] and ψ [rad] at t = 0.
        tas: V [m/s].
        bends: duration [s] and turn rate r [rad/s] of each piece; past the last it flies straight.
        times: when [s], ≥ 0. shape (n,), or one number

    Raises:
        ValueError: for times that are no finite numbers of 0 or more, or of two axes.
    """
    t = _times(times)
    durations = np.array([duration for duration, _ in bends])
    rates = np.array([*(rate for _, rate in bends), 0.0])
    begins = np.concatenate(([0.0], np.cumsum(durations)))
    headings = start[2] + np.concatenate(([0.0], np.cumsum(durations * rates[:-1])))
    east, north = _displacement(headings[:-1], rates[:-1], durations, tas)
    xs = start[0] + np.concatenate(([0.0], np.cumsum(east)))
    ys = start[1] + np.concatenate(([0.0], np.cumsum(north)))
    piece = np.searchsorted(begins, t, side="right") - 1
    since = t - begins[piece]
    east, north = _displacement(headings[piece], rates[piece], since, tas)
    heading = wrap_each(headings[piece] + rates[piece] * since)
    return Samples(
        t=t,
        x=xs[piece] + east,
        y=ys[piece] + north,
        heading=heading,
        turn_rate=rates[piece],
        track=heading,
        speed=np.full(len(t), tas),
    )


def _times(given: ArrayLike) -> Floats:
    try:
        t = np.atleast_1d(np.asarray(given))
    except ValueError:
        raise ValueError("times must be a column, not rows of different lengths.") from None
    if t.dtype.kind not in "fiu" or t.ndim != 1:
        raise ValueError("times must be a number or a column of numbers.")
    t = t.astype(np.float64)
    if not ((t >= 0.0) & (t <= LATEST)).all():  # NaN is neither
        raise ValueError(f"times must lie in 0 … {LATEST:g} s.")
    return t


def _displacement(
    heading: Floats, rate: Floats, duration: Floats, tas: float
) -> tuple[Floats, Floats]:
    """East and north of where it began [m]."""
    half = 0.5 * rate * duration
    chord = tas * duration * np.sinc(half / pi)  # numpy's sinc has the π in it
    return chord * np.sin(heading + half), chord * np.cos(heading + half)
