"""A leader as it was recorded, step by step, as the kernels take it."""

from typing import NamedTuple

import numpy as np

from relguide.flying.tracks import RecordedTrack
from relguide.kernels.base.roots import FloatArray
from relguide.planning.wind import Wind
from relguide.units import G0, Second


class RecordedLeader(NamedTuple):
    """A recorded leader at each step."""

    rows: FloatArray
    """As `Body`. shape (n, 7)"""
    altitude: FloatArray
    """[m]. shape (n,)"""


def steps_of_track(track: RecordedTrack, wind: Wind, step: Second) -> RecordedLeader:
    """Where a recorded leader is at each step, from its start to its end.

    Heading and airspeed follow from the wind, the bank from how fast the heading changes.

    Args:
        track: the recording.
        wind: that it flew in, as far as is known.
        step: between rows [s].
    """
    count = round(track.duration / step) + 1
    t = np.minimum(np.arange(count) * step, track.duration)
    x, y, east, north, altitude = track.sample(t)
    heading = np.unwrap(np.arctan2(east - wind.east, north - wind.north))
    tas = np.hypot(east - wind.east, north - wind.north)
    second = max(round(1.0 / step), 1)
    later = np.append(heading[second:], np.full(min(second, count), heading[-1]))[:count]
    bank = np.arctan(tas * (later - heading) / G0)
    zero = np.zeros(count)
    return RecordedLeader(np.column_stack([x, y, heading, bank, zero, tas, zero]), altitude)
