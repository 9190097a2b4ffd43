"""The path that the leader has flown: an aircraft that follows turns where the leader turned."""

from bisect import bisect_left
from dataclasses import dataclass
from math import cos, hypot, sin
from typing import NamedTuple

from relguide.flying.aircraft import AircraftState, GroundVelocity
from relguide.flying.capture import Offsets
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond

STRAIGHT: Radian = 2.0 * DEG  # as for joining; an autopilot takes 10 s for the last degree
SPARE: Metre = 20_000.0  # kept beyond D, and assumed straight behind the first position seen
WINDOW: Metre = 6_000.0  # how far from the expected place the nearest point is searched


class Mark(NamedTuple):
    """The leader at one instant of the past."""

    s: Metre
    """Length of its ground path up to here [m]."""
    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """Where its nose pointed [rad]."""
    track: Radian
    """Where it went over the ground [rad]."""
    turn_rate: RadianPerSecond
    """[rad/s], positive to the right."""
    ground_speed: MetrePerSecond
    """[m/s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlownPath:
    """Marks in order of time, a second or so apart."""

    marks: tuple[Mark, ...]

    @property
    def last(self) -> Mark:
        """The leader now."""
        return self.marks[-1]

    def slot_open(self, slot_distance: Metre) -> bool:
        """Whether the leader has flown D on its present heading; true if it has not turned yet."""
        heading = self.last.heading
        since = bisect_left(self.marks, self.last.s - slot_distance, key=lambda mark: mark.s)
        return all(
            abs(wrap_signed(mark.heading - heading)) < STRAIGHT for mark in self.marks[since:]
        )

    def at(self, s: Metre) -> Mark:
        """The path at length s [m], interpolated linearly between marks."""
        i = min(max(bisect_left(self.marks, s, key=lambda mark: mark.s), 1), len(self.marks) - 1)
        before, after = self.marks[i - 1], self.marks[i]
        share = (s - before.s) / (after.s - before.s)
        bend = wrap_signed(after.heading - before.heading)
        return Mark(
            s,
            before.x + share * (after.x - before.x),
            before.y + share * (after.y - before.y),
            wrap(before.heading + share * bend),
            before.track if share < 0.5 else after.track,
            before.turn_rate + share * (after.turn_rate - before.turn_rate),
            before.ground_speed + share * (after.ground_speed - before.ground_speed),
        )

    def offsets(self, state: AircraftState, slot_distance: Metre) -> Offsets:
        """The pursuer as seen from the place D behind the leader along its path."""
        slot_s = self.last.s - slot_distance
        low = bisect_left(self.marks, slot_s - WINDOW, key=lambda mark: mark.s)
        high = bisect_left(self.marks, slot_s + WINDOW, key=lambda mark: mark.s)
        near = min(
            self.marks[max(low - 1, 0) : high + 1],
            key=lambda mark: hypot(state.x - mark.x, state.y - mark.y),
        )
        # project on the mark's own tangent, then once more where that leads: exact to a metre
        for _ in range(2):
            beyond = (state.x - near.x) * sin(near.track) + (state.y - near.y) * cos(near.track)
            near = self.at(near.s + beyond)
        right = (state.x - near.x) * cos(near.track) - (state.y - near.y) * sin(near.track)
        heading = wrap_signed(state.heading - near.heading)
        return Offsets(ahead=near.s - slot_s, right=right, heading=heading)


def begin_path(leader: AircraftState, velocity: GroundVelocity, slot_distance: Metre) -> FlownPath:
    """The path at first sight: the leader is assumed to have come straight."""
    track, behind = velocity.track, slot_distance + SPARE
    here = Mark(0.0, leader.x, leader.y, leader.heading, track, 0.0, velocity.speed)
    far = here._replace(
        s=-behind, x=leader.x - behind * sin(track), y=leader.y - behind * cos(track)
    )
    return FlownPath(marks=(far, here))


def extend_path(
    path: FlownPath,
    leader: AircraftState,
    velocity: GroundVelocity,
    turn_rate: RadianPerSecond,
    slot_distance: Metre,
) -> FlownPath:
    """The path with one more mark, from a new position of the leader."""
    last = path.last
    flown = hypot(leader.x - last.x, leader.y - last.y)
    if flown < 1.0:  # the same report again
        return path
    s = last.s + flown
    mark = Mark(s, leader.x, leader.y, leader.heading, velocity.track, turn_rate, velocity.speed)
    oldest = s - slot_distance - SPARE
    kept = path.marks[1:] if path.marks[1].s < oldest else path.marks
    return FlownPath(marks=(*kept, mark))
