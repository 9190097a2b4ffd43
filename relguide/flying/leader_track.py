"""What is known of another aircraft from its reports: its track, how certain it is, how old."""

from math import cos, hypot, inf, sin, sqrt
from typing import Literal, NamedTuple

import numpy as np

from relguide.flying.surveillance import DRIFTING, Report, Surveillance
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.tracker import RATE, SPEED, TRACK, X, Y, begin, predict, update
from relguide.units import Metre, MetrePerSecond, Radian, RadianPerSecond, Second

Standing = Literal["normal", "coasting", "old", "lost", "gone"]
"""`normal`: as reported; `coasting`: expected to fly on, shown with its age; `old`: no new plan,
caution; `lost`: no slot, no guidance behind it; `gone`: not shown."""
LADDER: tuple[tuple[Second, Standing], ...] = (
    (2.0, "normal"), (5.0, "coasting"), (10.0, "old"), (24.0, "lost"), (inf, "gone"),
)  # fmt: skip
"""Up to which age [s] a track has which standing; the ages are the project's own."""
FEW = 8
"""The mean of fewer reports is no better than the filter."""
MANY = 60
"""Older reports than this count less and less: no aircraft keeps its velocity for ever."""
LEFT_BY = 3.0
"""So many σ from its mean velocity an aircraft does something new [σ]."""
ALIKE = 2.0
"""Errors of so many reports in a row are about the same: gusts last for seconds."""
FORGOTTEN: Second = 30.0
"""An older track says nothing of a new report: it is begun anew [s]."""
LEAST_SIGMAS: tuple[Metre, MetrePerSecond] = (0.1, 0.01)
"""σ of a position [m] and a velocity [m/s] at least: the algebra needs some, also of exact
reports."""
FAR = 6.0
"""A report may be so many σ from where it is expected [σ] …"""
HARDEST = 6.0
"""… and as far as this acceleration takes it since the last one: a turn at 31° of bank [m/s²]."""


class Sigma(NamedTuple):
    """σ in the direction of flight, and across it."""

    across: float
    """To either side."""
    along: float
    """Ahead or behind."""


def standing(age: Second) -> Standing:
    """What may be done with a track whose last report is so old."""
    return next(name for most, name in LADDER if age <= most + 1e-6)


class SteadyVelocity:
    """The mean of the velocities reported since the aircraft last did something new.

    What it flies on with is known better by many reports than by the last few, and a slot minutes
    ahead is as uncertain as the velocity that it is predicted by.
    """

    def __init__(self) -> None:
        """Nothing is reported yet."""
        self.east = self.north = 0.0
        self.sigma = inf
        """Of both [m/s]."""
        self._count = 0

    def add(self, report: Report, seen: "LeaderTrack") -> None:
        """Take in a report, or begin anew where the aircraft no longer flies so.

        Args:
            report: the last one.
            seen: the track with it, which follows what is new.
        """
        if self._count >= FEW:
            east, north = seen.speed * sin(seen.track), seen.speed * cos(seen.track)
            off = hypot(east - self.east, north - self.north)
            if off > LEFT_BY * hypot(max(seen.velocity_sigma), self.sigma):
                self._count = 0
        self._count = min(self._count + 1, MANY)
        self.east += (report.east - self.east) / self._count
        self.north += (report.north - self.north) / self._count
        self.sigma = report.velocity_sigma * sqrt(ALIKE / self._count)

    @property
    def is_known(self) -> bool:
        """Whether it is better than what the last reports say."""
        return self._count > FEW


class LeaderTrack:
    """Another aircraft as it is believed to fly: one of the few things here that change."""

    def __init__(self, surveillance: Surveillance, report: Report) -> None:
        """At first sight.

        Args:
            surveillance: how well it is seen.
            report: the first one.
        """
        self.surveillance = surveillance
        self.t = self._heard = report.t
        self.surprise = 0.0
        """Of the last report, as the tracker says; 4 in the mean, more when something changes."""
        self._state, self._covariance = _begun(report)
        self.steady = SteadyVelocity()
        """Its velocity while it does nothing new."""
        self.steady.add(report, self)

    def second(self, t: Second, report: Report | None) -> None:
        """Go on to t [s], and take in what has been reported by then, if anything has."""
        if t > self.t:
            self._state, self._covariance = predict(self._state, self._covariance, t - self.t)
            self.t = t
        if report is None:
            return
        if self.age > FORGOTTEN:
            before = self.track
            self._state, self._covariance = _begun(report)
            self._state[TRACK] = before + wrap_signed(self._state[TRACK] - before)
        elif self._plausible(report):
            self._state, self._covariance, self.surprise = update(
                self._state, self._covariance, *report[1:5], *_sigmas(report)
            )
        else:
            return
        self._heard = t
        self.steady.add(report, self)

    @property
    def x(self) -> Metre:
        """East over the ground [m]."""
        return float(self._state[X])

    @property
    def y(self) -> Metre:
        """North over the ground [m]."""
        return float(self._state[Y])

    @property
    def speed(self) -> MetrePerSecond:
        """Ground speed [m/s]."""
        return float(self._state[SPEED])

    @property
    def track(self) -> Radian:
        """Direction of flight over the ground, continuous [rad]."""
        return float(self._state[TRACK])

    @property
    def rate(self) -> RadianPerSecond:
        """Turn rate of the track, positive to the right [rad/s]."""
        return float(self._state[RATE])

    @property
    def age(self) -> Second:
        """Since the last report that was taken in [s]."""
        return self.t - self._heard

    @property
    def standing(self) -> Standing:
        """What may be done with it."""
        return standing(self.age)

    @property
    def position_sigma(self) -> Sigma:
        """Of the position [m]: the filter's, the drift it cannot see, and along also the lag."""
        drift = DRIFTING * self.surveillance.position_sigma**2
        across, along = self._turned(self._covariance[: Y + 1, : Y + 1])
        lag = self.speed * self.surveillance.lag
        return Sigma(sqrt(across + drift), sqrt(along + drift + lag * lag))

    @property
    def velocity_sigma(self) -> Sigma:
        """Of the ground velocity [m/s]: the filter's, and across what a turn adds by now."""
        late = 0.0 if self.surveillance.kind == "exact" else self.surveillance.latency
        turned = hypot(sqrt(float(self._covariance[TRACK, TRACK])), self.rate * late)
        return Sigma(self.speed * turned, sqrt(float(self._covariance[SPEED, SPEED])))

    def _turned(self, covariance: FloatArray) -> tuple[float, float]:
        """Variances across and along of a covariance of east and north."""
        along = np.array([sin(self.track), cos(self.track)])
        across = np.array([along[1], -along[0]])
        return float(across @ covariance @ across), float(along @ covariance @ along)

    def _plausible(self, report: Report) -> bool:
        """Whether an aircraft could have come there since the last report."""
        position_sigma, velocity_sigma = _sigmas(report)
        off = hypot(report.x - self.x, report.y - self.y)
        east, north = self.speed * sin(self.track), self.speed * cos(self.track)
        changed = hypot(report.east - east, report.north - north)
        place, motion = max(self.position_sigma), max(self.velocity_sigma)
        return (
            off <= FAR * hypot(place, position_sigma) + 0.5 * HARDEST * self.age**2
            and changed <= FAR * hypot(motion, velocity_sigma) + HARDEST * self.age
        )


def _sigmas(report: Report) -> tuple[Metre, MetrePerSecond]:
    """What is new each time in a report's errors: σ of its position and of its velocity."""
    new = sqrt(1.0 - DRIFTING) * report.position_sigma
    return max(new, LEAST_SIGMAS[0]), max(report.velocity_sigma, LEAST_SIGMAS[1])


def _begun(report: Report) -> tuple[FloatArray, FloatArray]:
    """State and covariance after one report."""
    state, covariance = begin(*report[1:5], *_sigmas(report))
    return np.asarray(state), np.asarray(covariance)
