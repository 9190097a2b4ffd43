"""How far an aircraft is behind its leader, along the path that its leader flies."""

from typing import NamedTuple

import numpy as np

from relguide.atc.off_path import off_path
from relguide.atc.track import Track
from relguide.units import Metre, Second


class Behind(NamedTuple):
    """How far an aircraft is behind its leader."""

    length: Metre
    """Along the leader's path."""
    time: Second
    """What the leader takes for that."""


def behind_leader(
    path: Track,
    t: Second,
    leader: tuple[Metre, Metre],
    own: tuple[Metre, Metre],
    expected: Second,
) -> Behind:
    """How far an aircraft is behind its leader at a time.

    Args:
        path: the leader's; it need not be in time on it.
        t: when both are where they are [s].
        leader: where the leader is, east and north [m].
        own: where the aircraft is [m].
        expected: about how long the leader takes for what is between them, to within
            `off_path.WINDOW` [s].
    """
    passes = t + off_path(path, t, *leader).along
    passed = t - expected + off_path(path, t - expected, *own).along
    first, last = min(passes, passed), max(passes, passed)
    between = path.t[(path.t > first) & (path.t < last)].tolist()
    way = np.array([path.place(when) for when in (first, *between, last)])
    length = float(np.sum(np.hypot(*np.diff(way, axis=0).T)))
    time = passes - passed
    return Behind(length if time >= 0.0 else -length, time)
