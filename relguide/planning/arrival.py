"""Does a trajectory join the leader? Eq. (7) at its end: in the open slot, on the same heading."""

from dataclasses import dataclass
from math import cos, hypot, sin

from relguide.kernels.base.angles import wrap_signed
from relguide.planning.inputs import expect
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.trajectory import Trajectory
from relguide.units import DEG, Metre, Radian, Second

MAX_SLOT_ERROR: Metre = 100.0
"""A path that ends this near to the slot reaches it [m]: what capture takes up without a turn."""
MAX_HEADING_ERROR: Radian = 0.5 * DEG
"""… and so near to the leader's heading [rad]; exact plans are good to 1e-6 of both."""
MAX_EARLY: Second = 0.5
"""… and no longer than this before the slot opens [s]: 100 m at 200 m/s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrival:
    """How the end of a trajectory meets eq. (7)."""

    slot_error: Metre
    """Distance from the slot when the trajectory ends [m]."""
    heading_error: Radian
    """Between its last heading and the leader's final one [rad], 0 … π."""
    early: Second
    """How long before the slot opens it ends [s]; 0 if the slot is open then."""

    @property
    def holds(self) -> bool:
        """Whether all three are within what counts as joined: 100 m, 0.5°, 0.5 s."""
        return (
            self.slot_error <= MAX_SLOT_ERROR
            and self.heading_error <= MAX_HEADING_ERROR
            and self.early <= MAX_EARLY
        )


def arrival(trajectory: Trajectory, situation: Situation) -> Arrival:
    """Where and when a trajectory of the air mass ends, seen from the slot.

    Args:
        trajectory: the pursuer's, from t = 0 to its end; nobody need have planned it.
        situation: gives the leader with its intent, D and the wind.
    """
    expect("trajectory", trajectory, Trajectory)
    expect("situation", situation, Situation)
    frame = slot_frame(situation, situation.leader.trajectory)
    time = trajectory.duration
    end = trajectory.breakpoints()[-1]
    flown = situation.leader.tas * time
    release_time = frame.t_release * frame.radius / situation.pursuer.tas
    return Arrival(
        slot_error=hypot(
            end.x - frame.origin_x - flown * sin(frame.heading),
            end.y - frame.origin_y - flown * cos(frame.heading),
        ),
        heading_error=abs(wrap_signed(end.heading - frame.heading)),
        early=max(release_time - time, 0.0),
    )
