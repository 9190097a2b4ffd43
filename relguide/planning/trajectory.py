"""What an aircraft flies in the air mass: turns at nominal bank and straights, eqs. (17)–(19).

The paper numbers the pieces backward from the slot; here they run forward from 0.
"""

from dataclasses import dataclass, field
from itertools import chain
from math import inf, isfinite
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import advance
from relguide.planning.inputs import expect, number, turn_sign
from relguide.planning.sampling import Samples, sample_bends
from relguide.planning.wind import Wind
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

Turn = Literal[1, -1]
"""Direction of a turn, ε of the paper: +1 is a left turn."""
LEFT: Turn = 1
RIGHT: Turn = -1


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """Where an aircraft is and where its nose points.

    Examples:
        >>> ahead = rg.Straight(length=2_000.0)
        >>> flown = rg.Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(ahead,))
        >>> flown.pose_at(5.0)
        Pose(x=0.0, y=1000.0, heading=0.0)
    """

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """Clockwise from north [rad], in [0, 2π)."""


Bend = tuple[Metre, float]
"""A piece of constant curvature: length [m], and curvature [rad/m], positive to the right."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arc:
    """A turn at constant bank.

    Examples:
        >>> rg.Arc(turn=rg.LEFT, turn_angle=0.5, radius=9_000.0).length
        4500.0
    """

    turn: Turn
    """`LEFT` or `RIGHT`."""
    turn_angle: Radian
    """Heading change θ_i, as an absolute value [rad], ≥ 0."""
    radius: Metre
    """Turn radius [m], > 0."""

    @property
    def length(self) -> Metre:
        """Path length [m]."""
        return self.turn_angle * self.radius

    @property
    def bends(self) -> tuple[Bend, ...]:
        """Its one piece of constant curvature."""
        return ((self.length, -self.turn / self.radius),)


@dataclass(frozen=True, slots=True, kw_only=True)
class Straight:
    """A piece at constant heading.

    Examples:
        >>> rg.Straight(length=2_000.0).length / 200.0  # at 200 m/s [s]
        10.0
    """

    length: Metre
    """l_i [m], ≥ 0."""

    @property
    def bends(self) -> tuple[Bend, ...]:
        """Its one piece of no curvature."""
        return ((self.length, 0.0),)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryArc:
    """A piece that slides along d = d_min with less than full bank, as short arcs.

    Examples:
        >>> rg.BoundaryArc(side=rg.LEFT, bends=((500.0, -1e-4), (400.0, -8e-5))).length  # [m]
        900.0
    """

    side: Turn
    """`LEFT` boundary arcs counter-clockwise round the leader, turning left; `RIGHT` the other way.
    """
    bends: tuple[Bend, ...]
    """The arcs, in order."""

    @property
    def length(self) -> Metre:
        """Path length [m]."""
        return sum(length for length, _ in self.bends)


Segment = Arc | Straight | BoundaryArc


def heading_change(segment: Segment) -> Radian:
    """What a segment adds to the heading, positive to the right [rad]."""
    return sum(length * curvature for length, curvature in segment.bends)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Trajectory:
    """Segments flown one after another at constant true airspeed, in the air mass.

    In wind the air mass moves: over the ground the same trajectory is displaced by wind × t.

    Examples:
        >>> ahead = rg.Straight(length=2_000.0)
        >>> rg.Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(ahead,)).duration
        10.0
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
    _breakpoints: tuple[Pose, ...] | None = field(
        default=None, init=False, repr=False, compare=False
    )
    """Found when first asked for."""

    def __post_init__(self) -> None:
        """Refuse what no aircraft could fly."""
        # a planner makes one for every candidate: nearly always all four are finite floats
        x, y, heading, tas = self.x, self.y, self.heading, self.tas
        if not (
            type(x) is type(y) is type(heading) is type(tas) is float
            and isfinite(x + y + heading + tas)
        ):
            for name in ("x", "y", "heading", "tas"):
                object.__setattr__(self, name, number(name, getattr(self, name)))
        if self.tas <= 0.0:
            raise ValueError(f"tas must be above 0 m/s, not {self.tas:g} m/s.")
        if not isinstance(self.segments, tuple):
            raise ValueError("segments must be a tuple of Arc, Straight and BoundaryArc.")
        if not all(map(_is_sound, self.segments)):
            object.__setattr__(self, "segments", tuple(map(_accept, self.segments)))
        if not self.duration < inf:
            raise ValueError("All segments together must have a finite length and duration.")

    @classmethod
    def of_sound(
        cls,
        x: Metre,
        y: Metre,
        heading: Radian,
        tas: MetrePerSecond,
        segments: tuple[Segment, ...],
    ) -> "Trajectory":
        """One of numbers that are known to be sound, for planners: nothing is looked at."""
        made = object.__new__(cls)
        settle = object.__setattr__
        settle(made, "x", x)
        settle(made, "y", y)
        settle(made, "heading", heading)
        settle(made, "tas", tas)
        settle(made, "segments", segments)
        settle(made, "_breakpoints", None)
        return made

    @property
    def length(self) -> float:
        """Path length in the air mass [m], Σ (l_k + R θ_k) of eq. (17)."""
        length = 0.0
        for segment in self.segments:
            length += segment.length
        return length

    @property
    def duration(self) -> Second:
        """How long it takes [s]."""
        return self.length / self.tas

    @property
    def turns(self) -> int:
        """Number of turns, a boundary arc along d_min counted as one."""
        return sum(not isinstance(segment, Straight) for segment in self.segments)

    @property
    def letters(self) -> str:
        """One letter a segment: L, R, S, or B for a boundary arc along d_min."""
        return "".join(_letter(segment) for segment in self.segments)

    def turn_rates(self) -> tuple[RadianPerSecond, ...]:
        """Turn rate at the start of each segment [rad/s], positive to the right."""
        return tuple(segment.bends[0][1] * self.tas for segment in self.segments)

    def durations(self) -> tuple[Second, ...]:
        """Duration of each segment [s]."""
        return tuple(segment.length / self.tas for segment in self.segments)

    def bends(self) -> tuple[tuple[Second, RadianPerSecond], ...]:
        """Duration [s] and turn rate [rad/s] of each piece of constant curvature."""
        pieces: list[tuple[Second, RadianPerSecond]] = []
        for segment in self.segments:
            for length, curvature in segment.bends:
                pieces.append((length / self.tas, curvature * self.tas))
        return tuple(pieces)

    def pose_at(self, t: Second) -> Pose:
        """Where it is at time t [s]; past the end it goes on straight."""
        x, y, heading, left = self.x, self.y, self.heading, max(number("t", t), 0.0)
        for duration, rate in (*self.bends(), (left, 0.0)):
            x, y, heading = advance(x, y, heading, self.tas, rate, min(left, duration))
            left -= duration
            if left <= 0.0:
                break
        return Pose(x=x, y=y, heading=wrap(heading))

    def sample(self, t: ArrayLike) -> Samples:
        """Where it is at many times at once, in the air mass; past the end it goes on straight.

        Args:
            t: times [s], ≥ 0. shape (n,), or one number
        """
        return sample_bends((self.x, self.y, self.heading), self.tas, self.bends(), t)

    def over_ground(self, wind: Wind, t: ArrayLike | None = None) -> Samples:
        """As `sample`, over the ground: arcs become trochoids.

        Args:
            wind: moves the air mass, which is the world frame at t = 0.
            t: times [s], ≥ 0; each second and the end if left out. shape (n,)
        """
        expect("wind", wind, Wind)
        if t is None:
            t = np.append(np.arange(0.0, self.duration, 1.0), self.duration)
        return self.sample(t).over_ground(wind)

    def __repr__(self) -> str:
        return f"Trajectory({pieces_text(self)}; {self.duration:.1f} s)"

    def breakpoints(self) -> tuple[Pose, ...]:
        """Start of the first segment, then the end of each."""
        if self._breakpoints is not None:
            return self._breakpoints
        poses = [Pose(x=self.x, y=self.y, heading=wrap(self.heading))]
        x, y, heading = self.x, self.y, self.heading
        for segment in self.segments:
            for length, curvature in segment.bends:
                x, y, heading = advance(x, y, heading, 1.0, curvature, length)
            poses.append(Pose(x=x, y=y, heading=wrap(heading)))
        found = tuple(poses)
        object.__setattr__(self, "_breakpoints", found)
        return found


def pieces_text(trajectory: Trajectory) -> str:
    """Each segment's letter, with how far it turns or how long it is: `R 5.2° S 203.00 km`."""
    return " ".join(map(_piece_text, trajectory.segments))


def _piece_text(segment: Segment) -> str:
    if isinstance(segment, Arc):
        return f"{_letter(segment)} {segment.turn_angle / DEG:.1f}°"
    return f"{_letter(segment)} {segment.length / 1000.0:.2f} km"


def _is_sound(segment: Segment) -> bool:
    """The short way to say that of most segments."""
    if type(segment) is Arc:
        turn, angle, radius = segment.turn, segment.turn_angle, segment.radius
        return (
            type(turn) is int
            and (turn == LEFT or turn == RIGHT)
            and type(angle) is type(radius) is float
            and 0.0 <= angle < inf
            and 0.0 < radius < inf
        )
    if type(segment) is BoundaryArc:
        # dozens of pieces: a few passes over all take a third of looking at each
        if type(segment.bends) is not tuple or not segment.bends:
            return False
        if set(map(type, segment.bends)) != {tuple} or set(map(len, segment.bends)) != {2}:
            return False
        numbers = tuple(chain.from_iterable(segment.bends))
        return (
            type(segment.side) is int
            and (segment.side == LEFT or segment.side == RIGHT)
            and set(map(type, numbers)) == {float}
            and min(numbers[::2]) >= 0.0
            and isfinite(sum(map(abs, numbers)))
        )
    return type(segment) is Straight and type(segment.length) is float and segment.length >= 0.0


def _accept(segment: Segment) -> Segment:
    """A segment with numbers that are floats, or a sentence that says what would be right."""
    match segment:
        case Straight(length=length):
            segment = Straight(length=number("A straight's length", length))
        case Arc(turn=turn, turn_angle=angle, radius=radius):
            segment = Arc(
                turn=LEFT if turn_sign("A turn's direction", turn) == LEFT else RIGHT,
                turn_angle=number("A turn's angle", angle),
                radius=number("A turn's radius", radius),
            )
            if segment.turn_angle < 0.0 or segment.radius <= 0.0:
                raise ValueError(
                    f"A turn must have an angle of 0 rad or more and a radius above 0 m, not "
                    f"{segment.turn_angle:g} rad and {segment.radius:g} m."
                )
        case BoundaryArc(side=side, bends=bends):
            if not (isinstance(bends, tuple) and bends and all(map(_is_pair, bends))):
                raise ValueError("A boundary arc must have bends: a tuple of (length, curvature).")
            segment = BoundaryArc(
                side=LEFT if turn_sign("A boundary arc's side", side) == LEFT else RIGHT,
                bends=tuple(
                    (
                        number("A boundary arc's piece", length),
                        number("A boundary arc's curvature", curvature),
                    )
                    for length, curvature in bends
                ),
            )
        case _:
            raise ValueError(f"A segment must be an Arc, Straight or BoundaryArc, not {segment!r}.")
    for length, _ in segment.bends:
        if not 0.0 <= length < inf:
            raise ValueError(f"A segment must have a finite length of 0 m or more, not {length} m.")
    return segment


def _is_pair(bend: object) -> bool:
    return isinstance(bend, tuple) and len(bend) == 2


def _letter(segment: Segment) -> str:
    match segment:
        case Straight():
            return "S"
        case Arc():
            return "L" if segment.turn == LEFT else "R"
        case BoundaryArc():
            return "B"
