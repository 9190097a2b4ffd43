"""What a pursuer knows of itself, its leader, the leader's intent and the air.

Guidance reads this and nothing else.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot, inf

import numpy as np

from relguide.flying.leaders.declared import intent_after as intent_after
from relguide.flying.perception import CERTAIN, Spread
from relguide.flying.seen_others import SeenOther
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.ahead import add_mark
from relguide.kernels.flight.flight_records import Body, Drift, Limits
from relguide.kernels.flight.laws import ground_track
from relguide.kernels.flight.marks import straight_for
from relguide.kernels.flight.program import roll_lead
from relguide.planning.aircraft import Leader
from relguide.planning.cells import Cell
from relguide.planning.heights import (
    ALWAYS,
    FASTEST,
    JOINED_HEIGHT,
    UNKNOWN,
    VERTICAL_MINIMUM,
    WHOLE_METRE,
    Heights,
    Interval,
    counted,
)
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.wind import Wind
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

SPARE: Metre = 20_000.0
"""Of the leader's flown path, D and so much more is kept, and assumed straight behind it at first
sight [m]."""
SEEMS = 3.0
"""How many σ off something has to be to be news."""
ROLLING_OUT: Radian = 3.0 * DEG
"""So near the heading that it holds, a leader is on it but for its roll [rad]."""
ROOM = 600
"""Marks that a track has room for at first; it grows."""


class FlownTrack:
    """The leader's flown path over the ground, a mark a second; it grows as it is flown."""

    def __init__(self, leader: Body, wind: Drift, t: Second, behind: Metre) -> None:
        """At first sight: the leader is assumed to have come straight.

        Args:
            leader: now.
            wind: moves it.
            t: flight time [s].
            behind: how much of its path to assume [m].
        """
        direction, speed = ground_track(leader, wind)
        rows = np.zeros((ROOM, 7))
        east, north = np.sin(direction), np.cos(direction)
        rows[0] = (
            -behind, leader.x - behind * east, leader.y - behind * north,
            leader.heading, direction, speed, t - behind / max(speed, 1.0),
        )  # fmt: skip
        rows[1] = 0.0, leader.x, leader.y, leader.heading, direction, speed, t
        self._rows, self._count = rows, 2

    @property
    def marks(self) -> FloatArray:
        """Rows as in `kernels/flight/marks.py`, the last one now."""
        return self._rows[: self._count]

    def add(self, leader: Body, wind: Drift, t: Second) -> None:
        """A mark where the leader is now; not if it is the same report again."""
        if self._rows[self._count - 1, 6] >= t:
            return
        if self._count == len(self._rows):
            self._rows = np.vstack([self._rows, np.zeros_like(self._rows)])
        add_mark(self._rows, self._count, leader, wind, t)
        self._count += 1


@dataclass(frozen=True, kw_only=True)
class Belief:
    """What a pursuer knows at one instant; what follows from it is computed once."""

    t: Second
    """Flight time [s]."""
    own: Body
    """Itself."""
    limits: Limits
    """What it can do."""
    leader: Body
    """The leader, heading continuous."""
    leader_limits: Limits
    """What the leader is assumed to be able to do."""
    intent: tuple[IntentPiece, ...]
    """The part of the leader's intent still to be flown; empty if unknown."""
    intent_known: bool
    program: FloatArray
    """The intent as the kernels take it; no rows if unknown. shape (k, 3)"""
    cursor: int
    """Its piece being flown."""
    held: Radian
    """The leader's heading before the first piece, continuous [rad]."""
    holds: Radian
    """The heading that a leader of known intent holds on its straights, continuous [rad]."""
    leader_tas: MetrePerSecond
    """The speed that the leader is expected to hold [m/s]."""
    track: FlownTrack
    """The leader's flown path."""
    wind: Wind
    """As it is believed."""
    spread: Spread = CERTAIN
    """How uncertain all that is."""
    leader_age: Second = 0.0
    """How long ago the leader was last heard of; since then it is expected to fly on [s]."""
    own_heights: Heights = UNKNOWN
    """Its altitude, and the changes of level that guidance is to make."""
    leader_heights: Heights = UNKNOWN
    """The leader's, with those that it has declared, if its intent is known."""
    leader_climb: MetrePerSecond = 0.0
    """How fast the leader climbs now; negative if it descends [m/s]."""
    others: tuple[SeenOther, ...] = ()
    """All other aircraft."""
    cells: tuple[Cell, ...] = ()
    """Weather to be kept out of, as it is now."""
    by_hand: bool = False
    """Whether the crew flies it by hand: it may not fly what guidance asks."""

    @cached_property
    def height(self) -> Metre | None:
        """How far the leader is above [m]; `None` if that is not known."""
        own, leader = self.own_heights.altitude, self.leader_heights.altitude
        return None if own is None or leader is None else leader - own

    @cached_property
    def at_level(self) -> bool:
        """Whether the pursuer is at the leader's level, as far as is known."""
        return self.height is None or abs(self.height) <= JOINED_HEIGHT

    @cached_property
    def counts(self) -> tuple[Interval, ...]:
        """From when until when the horizontal minimum counts, from now on [s].

        A leader of unknown intent may climb or descend toward the pursuer at once.
        """
        if self.height is None:
            return ALWAYS
        if self.intent_known:
            return counted(self.own_heights, self.leader_heights)
        spare = abs(self.height) - VERTICAL_MINIMUM + WHOLE_METRE
        return ALWAYS if spare <= 0.0 else ((spare / FASTEST, inf),)

    @property
    def counted_separation(self) -> Metre:
        """Distance to the leader, infinite while 1,000 ft keep both apart [m]."""
        counts = self.counts
        return self.separation if counts and counts[0][0] <= 0.0 else inf

    @cached_property
    def drift(self) -> Drift:
        """The wind as kernels take it."""
        return Drift(self.wind.east, self.wind.north)

    @property
    def place_slack(self) -> Metre:
        """A leader so far from where it was expected may only seem to be [m]."""
        return SEEMS * self.spread.place

    @property
    def speed_slack(self) -> MetrePerSecond:
        """A speed so much off may only seem to be [m/s]."""
        return SEEMS * hypot(self.spread.velocity, self.spread.wind)

    @property
    def heading_slack(self) -> Radian:
        """A heading so far off may only seem to be [rad]."""
        return self.speed_slack / max(self.leader.tas, 1.0)

    @cached_property
    def separation(self) -> Metre:
        """Distance to the leader [m]."""
        return hypot(self.own.x - self.leader.x, self.own.y - self.leader.y)

    @cached_property
    def turn_to_come(self) -> bool:
        """Whether the leader's known intent has a turn that is not over."""
        return any(isinstance(piece, TurnTo) for piece in self.intent)

    @property
    def last_turn(self) -> int:
        """Number of the last turn of the program; −1 if there is none."""
        turns = [k for k in range(len(self.program)) if self.program[k, 0] != 0.0]
        return turns[-1] if turns else -1

    @cached_property
    def leader_turn_rate(self) -> RadianPerSecond:
        """As observed, positive to the right [rad/s]."""
        return turn_rate(self.leader.tas, self.leader.bank)

    @cached_property
    def leader_rolled_out(self) -> Radian:
        """The leader's heading if it stops turning now, continuous [rad]."""
        if abs(self.leader.bank) < 1e-3:
            return self.leader.heading
        lead = roll_lead(self.leader_limits, self.leader.bank, 0.0)
        return self.leader.heading + self.leader_turn_rate * lead

    @cached_property
    def final_heading(self) -> Radian:
        """The leader's heading on its final leg as far as is known, in [0, 2π) [rad]."""
        turns = [piece.heading for piece in self.intent if isinstance(piece, TurnTo)]
        return wrap(turns[-1] if turns else self._straight_heading)

    @property
    def _straight_heading(self) -> Radian:
        """Where the leader points, or, rolling out of a turn, will point [rad, continuous]."""
        if not self.intent_known:
            return self.leader_rolled_out
        turns = bool(self.intent) and isinstance(self.intent[0], TurnTo)
        near = abs(self.leader.heading - self.holds) < ROLLING_OUT
        return self.holds if near and not turns else self.leader.heading

    def slot_open(self, slot_distance: Metre) -> bool:
        """Whether the leader has flown D on its final leg, as far as is known."""
        return not self.turn_to_come and straight_for(self.track.marks, slot_distance)

    def leader_after(self, seconds: Second) -> Leader:
        """The leader as it is expected to be, over the ground, with the rest of its intent.

        Args:
            seconds: from now [s], ≥ 0.
        """
        x, y, tas, intent = self.leader.x, self.leader.y, self.leader.tas, self.intent
        heading = wrap(self._straight_heading)
        if intent and isinstance(intent[0], FlyStraight) and intent[0].duration > seconds > 0.0:
            left = FlyStraight(duration=intent[0].duration - seconds)
            x, y, heading = advance(x, y, heading, tas, 0.0, seconds)
            intent = (left, *intent[1:])
        elif intent and seconds > 0.0:
            now = Leader(x=x, y=y, heading=heading, tas=tas, intent=intent)
            then, intent = now.trajectory.pose_at(seconds), intent_after(now, seconds)
            x, y, heading = then.x, then.y, then.heading
        elif seconds > 0.0:
            x, y, heading = advance(x, y, heading, tas, 0.0, seconds)
        x, y = x + self.wind.east * seconds, y + self.wind.north * seconds
        return Leader(x=x, y=y, heading=heading, tas=tas, intent=intent)


def coasting(heard: Belief, t: Second, own: Body) -> Belief:
    """What is believed of a leader that is no longer heard of: it flies on as was expected.

    Args:
        heard: when it was last heard of.
        t: flight time now [s].
        own: the pursuer now.
    """
    age = t - heard.t
    then = heard.leader_after(age)
    turned = wrap_signed(then.heading - heard.leader.heading)
    leader = heard.leader._replace(
        x=then.x, y=then.y, heading=heard.leader.heading + turned, bank=0.0, roll_rate=0.0
    )
    return replace(
        heard, t=t, own=own, leader=leader, intent=then.intent, leader_age=age,
        leader_heights=UNKNOWN, leader_climb=0.0,
    )  # fmt: skip
