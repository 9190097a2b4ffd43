"""What a pursuer perceives: its leader by reports, the wind by air data and ground track.

    truth → Receiver → LeaderTrack → the leader as guidance sees it
    airspeed, heading, ground velocity → wind triangle → wind as guidance believes it

Where all is seen exactly and the air is as it is believed to be, there is nothing to perceive:
guidance then sees the truth.
"""

from math import atan, atan2, cos, hypot, sin
from typing import NamedTuple

import numpy as np

from relguide.flying.leader_track import LeaderTrack
from relguide.flying.surveillance import Receiver, Report, Surveillance
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.flight_records import Body, Drift
from relguide.kernels.flight.wind_estimate import (
    MEASURED_VARIANCE,
    UNKNOWN_VARIANCE,
    WANDERING,
    estimate,
)
from relguide.units import DEG, G0, Metre, MetrePerSecond, RadianPerSecond, Second

LISTENED = 30
"""For so many seconds before a flight begins the leader was seen and the wind was measured: no crew
joins at first sight."""
AIR_DATA: MetrePerSecond = 1.0
"""σ of the wind that is measured in a second [m/s]: 0.7 m/s of airspeed, ¼° of heading."""
FLIES_STRAIGHT: RadianPerSecond = 0.2 * DEG
"""A leader that seems to turn slower flies straight: reports show as much of a turn by themselves
[rad/s]."""
SURE = 2.0
"""So many σ are kept beside d_min."""
AHEAD: Second = 20.0
"""What the leader's velocity may be wrong by is kept for so long: then guidance has seen it [s]."""


class Spread(NamedTuple):
    """How uncertain is what is believed: σ of each axis; all 0 where all is known exactly."""

    place: Metre = 0.0
    """Of the leader's position [m]."""
    velocity: MetrePerSecond = 0.0
    """Of its ground velocity [m/s]."""
    wind: MetrePerSecond = 0.0
    """Of the wind [m/s]."""

    @property
    def margin(self) -> Metre:
        """What is kept beside d_min for it [m]."""
        return SURE * hypot(self.place, AHEAD * self.velocity)


CERTAIN = Spread()
"""Where all is known exactly."""


class Perceived(NamedTuple):
    """What is perceived at one instant."""

    leader: Body
    """In the air as it is believed to move."""
    wind: Drift
    spread: Spread
    age: Second
    """How long ago the leader was last heard of [s]."""


class Perception:
    """What one pursuer perceives: one of the few things here that change."""

    def __init__(
        self,
        surveillance: Surveillance,
        wind: Drift,
        gusts: MetrePerSecond,
        rng: np.random.Generator,
    ) -> None:
        """Before anything is seen.

        Args:
            surveillance: how well the leader is seen.
            wind: what is believed of it.
            gusts: how strong they are [m/s].
            rng: of noise and losses.
        """
        self._rng, self._gusts = rng, gusts
        self._receiver = Receiver(surveillance, rng)
        self._wind, self._variance = wind, UNKNOWN_VARIANCE
        self._track: LeaderTrack | None = None

    def beside(self, rng: np.random.Generator) -> "Perception":
        """How the same pursuer perceives another aircraft, before it is seen.

        Args:
            rng: of its noise and losses.
        """
        return Perception(self._receiver.surveillance, self._wind, self._gusts, rng)

    def share_wind(self, measured: "Perception") -> None:
        """Believe of the wind what the same pursuer believes that looks at its leader."""
        self._wind, self._variance = measured._wind, measured._variance

    def listen(self, leader: Body, moves: Drift, own_wind: Drift | None) -> None:
        """See and measure until the flight begins: both have come straight.

        Args:
            leader: where it begins.
            moves: the wind that moves it.
            own_wind: the wind that moves the pursuer; `None` where that is measured elsewhere.
        """
        east = leader.tas * sin(leader.heading) + moves.east
        north = leader.tas * cos(leader.heading) + moves.north
        for second in range(-LISTENED, 0):
            before = leader._replace(x=leader.x + east * second, y=leader.y + north * second)
            self.see(float(second), before, moves, own_wind)

    def see(self, t: Second, leader: Body, moves: Drift, measured: Drift | None) -> Perceived:
        """What is perceived now.

        Args:
            t: flight time [s].
            leader: the truth.
            moves: the wind that moves it.
            measured: the wind that moved the pursuer in the last second; `None` at the start.
        """
        if measured is not None:
            east, north = AIR_DATA * self._rng.standard_normal(2)
            self._wind, self._variance = estimate(
                self._wind, self._variance, Drift(measured.east + east, measured.north + north),
                MEASURED_VARIANCE, WANDERING, 1.0,
            )  # fmt: skip
        east = leader.tas * sin(leader.heading) + moves.east
        north = leader.tas * cos(leader.heading) + moves.north
        report = self._receiver.hear(t, leader.x, leader.y, east, north)
        wind_sigma = float(np.sqrt(self._variance))
        if self._receiver.surveillance.kind == "exact" and self._gusts == 0.0:
            body = self._in_air(leader, leader.x, leader.y, east, north, None)
            return Perceived(body, self._wind, Spread(wind=wind_sigma), 0.0)
        track = self._follow(t, report)
        place, steady = max(track.position_sigma), track.steady
        if steady.is_known:
            east, north, rate, velocity = steady.east, steady.north, 0.0, steady.sigma
        else:
            east, north = track.speed * sin(track.track), track.speed * cos(track.track)
            rate, velocity = track.rate, max(track.velocity_sigma)
        body = self._in_air(leader, track.x, track.y, east, north, rate)
        return Perceived(body, self._wind, Spread(place, velocity, wind_sigma), track.age)

    def _follow(self, t: Second, report: Report | None) -> LeaderTrack:
        """The track with what has been reported; the first report always arrives.

        A gust that moves the leader now is gone in seconds: so what is reported of its velocity is
        as uncertain as gusts are strong, of which the pursuer has its share.
        """
        if report is not None and self._gusts > 0.0:
            gusty = hypot(report.velocity_sigma, self._gusts)
            place = max(report.position_sigma, self._gusts)
            report = report._replace(position_sigma=place, velocity_sigma=gusty)
        if self._track is None:
            assert report is not None
            self._track = LeaderTrack(self._receiver.surveillance, report)
        self._track.second(t, report)
        return self._track

    def _in_air(
        self,
        leader: Body,
        x: Metre,
        y: Metre,
        east: MetrePerSecond,
        north: MetrePerSecond,
        rate: RadianPerSecond | None,
    ) -> Body:
        """The leader as the believed wind has it, from its place and velocity over the ground.

        Args:
            leader: the truth: gives how many full turns its heading counts, and its bank where it
                is seen exactly.
            x: east [m].
            y: north [m].
            east: ground velocity [m/s].
            north: the same [m/s].
            rate: turn rate seen [rad/s]; `None` where the bank is known.
        """
        east, north = east - self._wind.east, north - self._wind.north
        tas = hypot(east, north)
        heading = leader.heading + wrap_signed(atan2(east, north) - leader.heading)
        if rate is None:
            return leader._replace(heading=heading, tas=tas)
        bank = atan(tas * rate / G0) if abs(rate) > FLIES_STRAIGHT else 0.0
        return Body(x, y, heading, bank, 0.0, tas, 0.0)
