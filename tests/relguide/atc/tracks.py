"""Tracks of any shape, for tests."""

from math import cos, pi, sin

import numpy as np
from hypothesis import strategies as st

from relguide.atc.picture import Seen
from relguide.atc.track import Track
from relguide.units import DEG


def track_of_legs(
    legs: list[tuple[float, float, float]],
    *,
    x: float = 0.0,
    y: float = 0.0,
    begin: float = 0.0,
    altitude: float = 9_000.0,
) -> Track:
    """Legs of (duration [s], direction [rad], ground speed [m/s]), one behind another."""
    t, xs, ys = [begin], [x], [y]
    for duration, direction, speed in legs:
        t.append(t[-1] + duration)
        xs.append(xs[-1] + duration * speed * sin(direction))
        ys.append(ys[-1] + duration * speed * cos(direction))
    level = np.full(len(t), altitude)
    return Track(t=np.array(t), x=np.array(xs), y=np.array(ys), low=level, high=level, error=0.0)


def turning_legs(
    *, side: int = 1, turned: float = 60.0, rate: float = 1.0, speed: float = 200.0
) -> list[tuple[float, float, float]]:
    """North for 120 s, a turn in pieces of 2 s, and straight on for 200 s; angles in degrees."""
    pieces = round(turned / (2.0 * rate))
    angles = [side * rate * (2.0 * k + 1.0) * DEG for k in range(pieces)]
    return [
        (120.0, 0.0, speed),
        *((2.0, angle, speed) for angle in angles),
        (200.0, side * turned * DEG, speed),
    ]


def tracks() -> st.SearchStrategy[Track]:
    """Legs that turn by up to 30° from one to the next, as pieces of arcs do."""
    leg = st.tuples(
        st.floats(1.0, 120.0), st.floats(-30.0 * DEG, 30.0 * DEG), st.floats(100.0, 280.0)
    )
    return st.builds(_track, st.floats(-pi, pi), st.lists(leg, min_size=2, max_size=15))


def _track(first: float, legs: list[tuple[float, float, float]]) -> Track:
    directions = np.cumsum([first, *(turned for _, turned, _ in legs[1:])]).tolist()
    return track_of_legs(
        [(span, angle, speed) for (span, _, speed), angle in zip(legs, directions, strict=True)]
    )


def seen_on(
    track: Track, t: float, *, right: float = 0.0, early: float = 0.0, above: float = 0.0
) -> Seen:
    """An aircraft at a time, so far to the right of the place where it is to be `early` later."""
    x, y = track.place(t + early)
    east, north = track.velocity(t + early)
    speed = float(np.hypot(east, north))
    return Seen(
        ident="RG 06",
        t=t,
        x=x + right * north / speed,
        y=y - right * east / speed,
        track=float(np.arctan2(east, north)) % (2.0 * pi),
        ground_speed=speed,
        altitude=float(track.low[0]) + above,
    )
