"""What guidance remembers from one second to the next, and the advice it gives."""

from dataclasses import dataclass

from relguide.flying.aircraft import ground_velocity
from relguide.flying.announcements import Event, Expectation, Mode, ModeChange, expectation
from relguide.flying.assignment import Assignment, Observation
from relguide.flying.autopilot import Reference
from relguide.flying.capture import Slot
from relguide.flying.commitment import Commitment
from relguide.flying.flown_path import FlownPath, begin_path
from relguide.planning.acceptance import Fault
from relguide.planning.plan import Reason
from relguide.units import Metre, MetrePerSecond, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Memory:
    """What guidance remembers from one second to the next."""

    mode: Mode
    flown: FlownPath
    """The leader's path over the ground."""
    expected: Expectation
    committed: Commitment | None
    """`None` until there is a plan, and after it is abandoned."""
    shown: Commitment | None
    """The plan last announced."""
    missing: Reason | None
    """Why there was no plan a second ago; `None` if there was one."""
    slot_heading: Radian
    """Final heading when capture began [rad]."""
    planned: bool
    """Whether a plan was ever announced."""
    fallbacks: int
    """How often a planner's plan could not be flown and the exact plan took its place."""
    refused: Fault | None
    """What was wrong with the planner's last plan; `None` if it could be flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Advice:
    """What guidance asks for during the next second."""

    reference: Reference
    commanded_tas: MetrePerSecond
    mode: Mode
    slot: Slot
    """Over the ground, now."""
    slot_open: bool
    to_slot: Metre
    """Distance still to close along the route [m]."""
    time_to_go: Second
    joined: bool
    """Eq. (7) holds: within 0.2 NM of the slot along and 0.1 NM across, heading within 2°, open."""
    events: tuple[Event, ...]


def begin(seen: Observation, assignment: Assignment) -> Memory:
    """The memory at engagement."""
    wind = assignment.wind
    velocity = ground_velocity(seen.leader, wind.east, wind.north)
    return Memory(
        mode="heading",
        flown=begin_path(seen.leader, velocity, assignment.slot_distance),
        expected=expectation(seen),
        committed=None,
        shown=None,
        missing=None,
        slot_heading=0.0,
        planned=False,
        fallbacks=0,
        refused=None,
    )


def enter_mode(memory: Memory, mode: Mode, message: str) -> tuple[Mode, tuple[Event, ...]]:
    """The mode entered, and the event that says so if it is a new one."""
    if mode == memory.mode:
        return mode, ()
    return mode, (ModeChange(mode=mode, previous=memory.mode, message=message),)


def is_slot_open(memory: Memory, seen: Observation, assignment: Assignment) -> bool:
    """Whether the leader has flown D on its final leg, as far as is known."""
    return not seen.turn_to_come and memory.flown.slot_open(assignment.slot_distance)
