"""A leader as it was recorded, or is reported, step by step, as the kernels take it."""

from math import cos, sin
from typing import NamedTuple

import numpy as np

from relguide.flying.tracks import RecordedTrack, TrackState, hermite
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.flight_records import Body
from relguide.planning.wind import Wind
from relguide.units import G0, Metre, Second


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


def steps_to(
    then: TrackState, now: Body, altitude: Metre, wind: Wind, step: Second
) -> RecordedLeader:
    """How an aircraft flies in a second to where it is reported: position and velocity continuous.

    Args:
        then: where it is in a second, over the ground.
        now: how it flies now.
        altitude: how high it is now [m].
        wind: that moves it.
        step: between rows [s].
    """
    u = np.linspace(0.0, 1.0, round(1.0 / step) + 1)
    a, b, c, da, db, dc = hermite(u)
    east0, north0 = now.tas * sin(now.heading) + wind.east, now.tas * cos(now.heading) + wind.north
    east1, north1 = then.ground_speed * sin(then.track), then.ground_speed * cos(then.track)
    east = da * (now.x - then.x) + db * east0 + dc * east1 - wind.east
    north = da * (now.y - then.y) + db * north0 + dc * north1 - wind.north
    heading = np.unwrap(np.append(now.heading, np.arctan2(east[1:], north[1:])))
    tas, zero = np.hypot(east, north), np.zeros(len(u))
    bank = np.arctan(tas * (heading[-1] - heading[0]) / G0)
    rows = np.column_stack(
        [
            a * now.x + (1.0 - a) * then.x + b * east0 + c * east1,
            a * now.y + (1.0 - a) * then.y + b * north0 + c * north1,
            heading, bank, zero, tas, zero,
        ]
    )  # fmt: skip
    rows[0] = now
    return RecordedLeader(rows, altitude + u * (then.altitude - altitude))
