"""Latitude and longitude exchanged: places lie where their own speeds and tracks do not lead."""

import numpy as np

from relguide.flying.smoothing import MAX_GAP
from relguide.flying.spline import Array
from relguide.planning.frames import middle_of
from relguide.units import DEG, Second

APART: Second = 10.0
"""Reports this far apart are compared, so that places heard late count little."""
MIN_STEPS = 5
"""Fewer steps say nothing."""
MISSES = 0.25
"""Share of a step by which places may miss where speed and track lead: a heading in place of a
track, or a wrong wind, takes less."""


def refuse_exchanged(numbers: Array, source: str) -> None:
    """Refuse reports whose places fit their speeds and tracks only once exchanged.

    Where reports have no speeds or tracks nothing can be said.

    Args:
        numbers: as in `Reports`, of one aircraft, in order of time.
        source: whose reports they are, for people.

    Raises:
        ValueError: if latitude and longitude are exchanged, saying how it shows.
    """
    told = numbers[np.all(np.isfinite(numbers[:, (1, 2, 4, 5)]), axis=1)]
    t, lat, lon, _, speed, track, _ = told.T
    _, chosen = np.unique(t // APART, return_index=True)
    t, lat, lon, speed, track = (column[chosen] for column in (t, lat, lon, speed, track))
    if not t.size or np.max(np.abs(lon)) > 90.0:
        return
    written, exchanged = (_miss(t, *places, speed, track) for places in ((lat, lon), (lon, lat)))
    if exchanged < MISSES < written and 2.0 * exchanged < written:
        raise ValueError(
            f"{source}: latitude and longitude are exchanged. As written, its places miss where "
            f"its own speeds and tracks lead by {written:.0%} of the way; exchanged, by "
            f"{exchanged:.0%}. Exchange the names of the two columns."
        )


def _miss(t: Array, lat: Array, lon: Array, speed: Array, track: Array) -> float:
    """By what share of a step the next place misses where speed and track lead, in the median."""
    plane = middle_of(lat, lon)
    direction = track * DEG + plane.meridian_each(lat, lon)
    velocity = speed * np.exp(1j * (np.pi / 2 - direction))
    x, y = plane.to_local_each(lat, lon)
    step = np.diff(t)
    led = step * (velocity[1:] + velocity[:-1]) / 2.0
    told = (step <= MAX_GAP + APART) & (np.abs(led) > 0.0)
    if np.count_nonzero(told) < MIN_STEPS:
        return 0.0
    return float(np.median(np.abs(np.diff(x + 1j * y) - led)[told] / np.abs(led)[told]))
