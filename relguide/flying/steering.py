"""From a planned trajectory to a reference for the autopilot, with the roll anticipated.

A plan changes its bank at once; an aircraft takes seconds to roll. So each segment is left early,
by half the duration of the roll to the next one: the same turn is flown with rounded ends. What
the first roll-in costs is made good by planning again.
"""

from typing import NamedTuple

from relguide.flying.aircraft import AircraftModel, roll_lead
from relguide.flying.autopilot import HoldHeading, Reference, TurnRate
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.turn import bank_for_turn_rate
from relguide.planning.trajectory import (
    Arc,
    BoundaryArc,
    Segment,
    Straight,
    Trajectory,
    after,
    heading_change,
)
from relguide.units import MetrePerSecond, Radian, RadianPerSecond, Second

HALF_TICK: Second = 0.5
"""Guidance acts once a second, so on average a switch comes half a second late."""


class Steering(NamedTuple):
    """What to do now, and the segments it leads through."""

    reference: Reference
    segments: tuple[Segment, ...]
    """From the one being flown on."""


def remaining(trajectory: Trajectory, elapsed: Second) -> Trajectory:
    """The part of a trajectory still to be flown after a time [s]."""
    pose = trajectory.pose_at(elapsed)
    left, segments = elapsed * trajectory.tas, list[Segment]()
    for segment in trajectory.segments:
        if left >= segment.length:
            left -= segment.length
            continue
        segments.append(after(segment, left))
        left = 0.0
    return Trajectory(
        x=pose.x, y=pose.y, heading=pose.heading, tas=trajectory.tas, segments=tuple(segments)
    )


def steer(trajectory: Trajectory, model: AircraftModel) -> Steering:
    """The reference that flies a trajectory from its start.

    Shortly before a turn, the mean turn rate over the roll's lead is asked for, so that the
    aircraft rolls in time. When it is a little inside its arc, the exact path from here begins with
    a sliver of the opposite turn; the mean then reduces the bank in proportion, and does not
    reverse it. A segment too short to roll for is skipped when no turn follows: the heading after
    it is held, and the heading loop rolls out.
    """
    tas, segments, heading = trajectory.tas, trajectory.segments, trajectory.heading
    rates = trajectory.turn_rates()
    for i, segment in enumerate(segments):
        following = segments[i + 1 : i + 2]
        rate_after = rates[i + 1] if following else 0.0
        window = roll_lead(model, _bank(rates[i], tas), _bank(rate_after, tas)) + HALF_TICK
        left = segment.length / tas
        if left > window:
            return Steering(_reference(segment, heading, rates[i]), segments[i:])
        if following and rate_after != 0.0 and following[0].length / tas > window:
            mean = (left * rates[i] + (window - left) * rate_after) / window
            return Steering(TurnRate(mean), segments[i + 1 :])
        heading += heading_change(segment)
    return Steering(HoldHeading(wrap(heading)), ())


def _reference(segment: Segment, heading: Radian, rate: RadianPerSecond) -> Reference:
    match segment:
        case Straight():
            return HoldHeading(wrap(heading))
        case Arc() | BoundaryArc():
            return TurnRate(rate)


def _bank(rate: RadianPerSecond, tas: MetrePerSecond) -> Radian:
    """Bank of a turn rate, eq. (8)."""
    return bank_for_turn_rate(tas, rate)
