"""A leader as if it had been recorded: north, then round to the right."""

import numpy as np

from relguide.flying.tracks import RecordedTrack
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, MetrePerSecond, RadianPerSecond, Second

SPEED: MetrePerSecond = 180.0
RATE: RadianPerSecond = 1.0 * DEG


def recording(seconds: int, *, turns_at: Second) -> RecordedTrack:
    """From (0, 0) on, a point a second."""
    t = np.arange(seconds + 1.0)
    angle = np.maximum(t - turns_at, 0.0) * RATE
    radius = SPEED / RATE
    return RecordedTrack(
        ident="REC1",
        aircraft_type="A306",
        origin=LocalPlane(49.0, 2.0),
        t=t,
        x=radius * (1.0 - np.cos(angle)),
        y=SPEED * np.minimum(t, turns_at) + radius * np.sin(angle),
        track=angle,
        ground_speed=np.full(len(t), SPEED),
        altitude=np.full(len(t), 9_000.0),
    )
