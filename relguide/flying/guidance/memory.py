"""What guidance remembers from one second to the next, and the advice it gives."""

from dataclasses import dataclass
from typing import NamedTuple

from relguide.flying.belief import Belief
from relguide.flying.engagement import Engagement
from relguide.flying.guidance.amid import Nearing
from relguide.flying.guidance.announcements import (
    AlertState,
    Event,
    Expectation,
    ModeChange,
    PlanReason,
    UnableReason,
    expectation,
)
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.modes import NUMBERS, Mode, change
from relguide.kernels.flight.flight_records import Control
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.planning.acceptance import Fault
from relguide.planning.outcome import Reason
from relguide.planning.trajectory import Trajectory
from relguide.planning.wind import Wind
from relguide.units import Metre, MetrePerSecond, Radian, RadianPerSecond, Second

LONG_AGO: Second = -1e9


class Slot(NamedTuple):
    """Where the pursuer has to be, and how that place moves."""

    x: Metre
    """East over the ground, now [m]."""
    y: Metre
    """North over the ground, now [m]."""
    heading: Radian
    """The heading to have there, clockwise from north [rad]."""
    tas: MetrePerSecond
    """Its speed through the air, along that heading [m/s]."""
    turn_rate: RadianPerSecond = 0.0
    """How fast that heading turns there [rad/s]: not 0 where the leader's own path bends."""


class Announced(NamedTuple):
    """The plan that a crew was last shown."""

    t: Second
    """When, flight time [s]."""
    joins: Second
    """When it promised to join, flight time [s]."""
    path: Trajectory
    """Its path over the air mass of then."""
    quiet_until: Second
    """What follows a change of the leader waits until then, flight time [s]."""


class Promise(NamedTuple):
    """What was last said of the join: with a plan, or alone."""

    t: Second
    """When it was said, flight time [s]."""
    joins: Second
    """When it was to be, flight time [s]."""
    settled: bool
    """Whether the leader had settled then."""


class StandingAlert(NamedTuple):
    """The alert that stands."""

    level: AlertState = "none"
    seen: Second = LONG_AGO
    """When its cause was last seen, flight time [s]."""


class OutOfGate(NamedTuple):
    """How long a pursuer that follows has not been in the gate."""

    since: Second = LONG_AGO
    """When it left, flight time [s]; `LONG_AGO` while it is in, or does not follow."""
    said: bool = False
    """Whether that was said."""


class Memory(NamedTuple):
    """What guidance remembers from one second to the next: some are made in each."""

    engagement: Engagement
    """How far the crew has engaged guidance."""
    mode: Mode
    since: Second
    """When the mode was entered [s]."""
    progress: Progress
    committed: Committed | None
    """`None` where no path is tracked."""
    forecast: Forecast | None
    """The flight ahead as last flown; `None` at first."""
    expected: Expectation
    """What the announced plan assumes of the leader."""
    leader: Expectation
    """What was known of the leader a second ago."""
    leader_trend: MetrePerSecond
    """How fast the leader changes its speed [m/s²]; 0 if it does not."""
    leader_rate: MetrePerSecond
    """The same, however slowly [m/s²]."""
    captured: Radian
    """The leader's heading when capture began [rad]."""
    changed: Second
    """When the leader last did something new, flight time [s]."""
    announced: Announced | None
    """`None` before the first plan."""
    promise: Promise | None
    """`None` as above."""
    proposed: Announced | None
    """The last proposal; `None` if there is none, or guidance is engaged."""
    accepted: Announced | None
    """The one that the crew has accepted: only that path is flown; `None` if none waits for it."""
    engaging: bool
    """Whether the crew has just ordered to engage what it accepted."""
    reoffered: str
    """How the proposal is another one than was accepted, as a sentence without full stop; empty if
    it is not."""
    pending: PlanReason | None
    """Why there is a plan that was not announced yet; `None` if there is none."""
    asked: Second
    """When a plan was last asked for [s]."""
    missing: Reason | None
    """Why there was no plan then; `None` if there was one."""
    unable: UnableReason | None
    """Why guidance cannot go on, as was said; `None` if it can."""
    alert: StandingAlert
    out_of_gate: OutOfGate
    fallbacks: int
    """How often an exact plan took the place of the planner's, for whatever reason."""
    refused: Fault | None
    """What was wrong with the planner's last plan; `None` if it could be flown."""
    others: tuple[tuple[Nearing, StandingAlert], ...] = ()
    """The alerts that stand on others, with what was last seen of each."""
    unheard: StandingAlert = StandingAlert()
    """That nothing is heard of the leader."""
    avoided: Second = LONG_AGO
    """When a plan was last asked for because another came in the way, flight time [s]."""
    because: str = ""
    """What that one did, or the crew asked for last, as a sentence without full stop."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Advice:
    """What guidance asks for during the next second."""

    control: Control
    engagement: Engagement
    leader_age: Second
    """How old what is known of the leader is [s]."""
    mode: Mode
    slot: Slot
    """Over the ground, now."""
    slot_open: bool
    to_slot: Metre
    """Distance still to close along the route [m]."""
    wind: Wind
    """As it is believed."""
    margin: Metre
    """What is kept beside d_min for what is not certain [m]."""
    along: Metre
    """How far it is behind D along the route, in capture and follow; negative if too near [m]."""
    across: Metre
    """How far to the right of what it tracks [m]."""
    time_to_go: Second
    """Until it joins, by the forecast [s]; 0 where it does not, or has."""
    joined: bool
    """Eq. (7) holds: within 0.2 NM of the slot along and 0.1 NM across, heading within 2°, open."""
    alert: AlertState
    forecast: Forecast | None
    """The flight ahead; `None` where guidance does not look ahead."""
    events: tuple[Event, ...]


def begin(belief: Belief, engagement: Engagement = "engaged") -> Memory:
    """The memory at the start of a flight."""
    known = expectation(belief)
    return Memory(
        engagement=engagement,
        mode="heading",
        since=belief.t,
        progress=Progress(HOLD, 0.0, belief.own.heading, belief.own.tas),
        committed=None,
        forecast=None,
        expected=known,
        leader=known,
        leader_trend=0.0,
        leader_rate=0.0,
        captured=belief.leader.heading,
        changed=LONG_AGO,
        announced=None,
        promise=None,
        proposed=None,
        accepted=None,
        engaging=False,
        reoffered="",
        pending="engaged",
        asked=LONG_AGO,
        missing=None,
        unable=None,
        alert=StandingAlert(),
        out_of_gate=OutOfGate(),
        fallbacks=0,
        refused=None,
    )


def enter(memory: Memory, belief: Belief, to: Mode, message: str) -> tuple[Memory, list[Event]]:
    """The mode entered, and the event that says so if it is a new one."""
    if to == memory.mode:
        return memory, []
    event = ModeChange(mode=change(memory.mode, to), previous=memory.mode, message=message)
    progress = memory.progress._replace(mode=NUMBERS[to])
    return memory._replace(mode=to, since=belief.t, progress=progress), [event]
