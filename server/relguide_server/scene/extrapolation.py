"""How far a picture is carried on between two samples, so that it glides at any rate."""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, sin

from relguide.flying.aircraft_documents import AircraftSample
from relguide.flying.documents import Document, Sample
from relguide.flying.plan_documents import PathPoint
from relguide.units import Metre, MetrePerSecond, Second

FRAME: Second = 1.0 / 50.0
"""Between two pictures, by the wall clock."""
SLOW = 1.5
"""Up to this rate the samples themselves move the picture by less than a pixel."""
HELD: Second = 0.15
"""Without a sample for so long by the wall clock, the picture stands: the flight may be paused."""


class Glide:
    """The pace of the samples that come, measured."""

    def __init__(self) -> None:
        self._t: Second | None = None
        self._wall: Second = 0.0
        self._rate = 0.0

    def note(self, documents: Sequence[Document], wall: Second) -> None:
        """Take note of samples that came at a time of the wall clock."""
        samples = [each.t for each in documents if isinstance(each, Sample)]
        if not samples:
            return
        t = samples[-1]
        if self._t is not None and 0.0 < wall - self._wall < HELD:
            measured = (t - self._t) / (wall - self._wall)
            self._rate += 0.3 * (measured - self._rate)
        else:
            self._rate = 0.0
        self._t, self._wall = t, wall

    def patience(self, wall: Second) -> Second | None:
        """How long to wait for a sample before the picture is carried on; `None` for ever."""
        return FRAME if self._rate > SLOW and wall - self._wall < HELD else None

    def ahead(self, wall: Second) -> Second:
        """How far after the newest sample the flight is [s, flight time]."""
        return max(0.0, self._rate) * min(max(0.0, wall - self._wall), HELD)


def carry(aircraft: AircraftSample, dt: Second) -> AircraftSample:
    """An aircraft a moment later, turning on as it does."""
    turned = aircraft.turn_rate * dt
    x, y = _step(aircraft.ground_speed, aircraft.track + turned / 2.0, dt)
    return replace(aircraft, x=aircraft.x + x, y=aircraft.y + y, heading=aircraft.heading + turned)


def onward(point: PathPoint, speed: MetrePerSecond, direction: float, dt: Second) -> PathPoint:
    """A point that moves in a direction [rad], a moment later."""
    x, y = _step(speed, direction, dt)
    return replace(point, x=point.x + x, y=point.y + y)


def _step(speed: MetrePerSecond, direction: float, dt: Second) -> tuple[Metre, Metre]:
    return speed * dt * sin(direction), speed * dt * cos(direction)
