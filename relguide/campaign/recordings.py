"""The recorded leaders of the campaign: every flight of one collection that makes a track."""

from functools import lru_cache

import numpy as np

from relguide.flying import tracks
from relguide.flying.tracks import QUICKSTART, ROW, RecordedTrack
from relguide.units import Second

LONG_ENOUGH: Second = 180.0
"""A shorter track is nothing to follow."""


def track(number: int) -> RecordedTrack:
    """One of them, in the order of their callsigns; behind the last comes the first again.

    Raises:
        ValueError: if the recorded flights are not installed.
    """
    found = _tracks()
    return found[number % len(found)]


def count() -> int:
    """How many there are.

    Raises:
        ValueError: if they are not installed.
    """
    return len(_tracks())


@lru_cache(maxsize=1)
def _tracks() -> tuple[RecordedTrack, ...]:
    """All of them, from one reading of the file; `load_sample` would read it for each."""
    by_name: dict[str, list[dict[str, object]]] = {}
    for row in tracks._sample(QUICKSTART):
        if row.get("callsign"):
            by_name.setdefault(str(row["callsign"]), []).append(row)
    found = []
    for name, rows in sorted(by_name.items()):
        numbers = np.array([[row.get(column) for column in ROW] for row in rows], dtype=np.float64)
        numbers[:, 0] /= 1000.0  # from milliseconds
        try:
            made = tracks._track(name, str(rows[0].get("typecode") or ""), numbers, name)
        except ValueError:  # it never flies, or has no positions
            continue
        if made.duration >= LONG_ENOUGH:
            found.append(made)
    return tuple(found)
