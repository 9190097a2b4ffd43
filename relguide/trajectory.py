"""What an aircraft flies in the air mass: turns at nominal bank and straights, eqs. (17)–(19).

The paper numbers the pieces backward from the slot; here they run forward from 0.
"""

from dataclasses import dataclass
from math import isfinite, pi
from typing import Literal

from relguide.kernels.motion import advance
from relguide.units import Metre, MetrePerSecond, Radian, Second

Turn = Literal[1, -1]
"""Direction of a turn, ε of the paper: +1 is a left turn."""
LEFT: Turn = 1
RIGHT: Turn = -1


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """Where an aircraft is and where its nose points."""

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """Clockwise from north [rad], in [0, 2π)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arc:
    """A turn at constant bank."""

    turn: Turn
    """`LEFT` or `RIGHT`."""
    turn_angle: Radian
    """Heading change θ_i, as an absolute value [rad], ≥ 0."""
    radius: Metre
    """Turn radius [m], > 0."""

    @property
    def length(self) -> float:
        """Path length [m]."""
        return self.turn_angle * self.radius


@dataclass(frozen=True, slots=True, kw_only=True)
class Straight:
    """A piece at constant heading."""

    length: Metre
    """l_i [m], ≥ 0."""


Segment = Arc | Straight


@dataclass(frozen=True, slots=True, kw_only=True)
class Trajectory:
    """Segments flown one after another at constant true airspeed, in the air mass.

    In wind the air mass moves: over the ground the same trajectory is displaced by wind × t.
    """

    x: Metre
    """East at t = 0 [m]."""
    y: Metre
    """North at t = 0 [m]."""
    heading: Radian
    """Heading at t = 0, clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed [m/s], > 0."""
    segments: tuple[Segment, ...]
    """In the order they are flown."""

    def __post_init__(self) -> None:
        """Refuse what no aircraft could fly."""
        for segment in self.segments:
            if not (isfinite(segment.length) and segment.length >= 0.0):
                raise ValueError(
                    f"A segment must have a finite length of 0 m or more, not {segment.length} m."
                )

    @property
    def length(self) -> float:
        """Path length in the air mass [m], Σ (l_k + R θ_k) of eq. (17)."""
        return sum(segment.length for segment in self.segments)

    @property
    def duration(self) -> Second:
        """How long it takes [s]."""
        return self.length / self.tas

    @property
    def turns(self) -> int:
        """Number of turns."""
        return sum(isinstance(segment, Arc) for segment in self.segments)

    @property
    def letters(self) -> str:
        """One letter a segment: L, R or S."""
        return "".join(_letter(segment) for segment in self.segments)

    def turn_rates(self) -> tuple[float, ...]:
        """Turn rate of each segment [rad/s], positive to the right, 0 on a straight."""
        return tuple(
            -segment.turn * self.tas / segment.radius if isinstance(segment, Arc) else 0.0
            for segment in self.segments
        )

    def durations(self) -> tuple[float, ...]:
        """Duration of each segment [s]."""
        return tuple(segment.length / self.tas for segment in self.segments)

    def pose_at(self, t: float) -> Pose:
        """Where it is at time t [s]; past the end it goes on straight."""
        x, y, heading, left = self.x, self.y, self.heading, max(t, 0.0)
        for duration, rate in zip(self.durations(), self.turn_rates(), strict=True):
            x, y, heading = advance(x, y, heading, self.tas, rate, min(left, duration))
            left -= duration
            if left <= 0.0:
                break
        else:
            x, y, heading = advance(x, y, heading, self.tas, 0.0, left)
        return Pose(x=x, y=y, heading=heading % (2.0 * pi))

    def breakpoints(self) -> tuple[Pose, ...]:
        """Start of the first segment, then the end of each."""
        poses = [Pose(x=self.x, y=self.y, heading=self.heading % (2.0 * pi))]
        x, y, heading = self.x, self.y, self.heading
        for duration, rate in zip(self.durations(), self.turn_rates(), strict=True):
            x, y, heading = advance(x, y, heading, self.tas, rate, duration)
            poses.append(Pose(x=x, y=y, heading=heading % (2.0 * pi)))
        return tuple(poses)


def _letter(segment: Segment) -> str:
    match segment:
        case Straight():
            return "S"
        case Arc():
            return "L" if segment.turn == LEFT else "R"
