"""Other aircraft as a pursuer sees them, and where each is expected to be from now on.

An aircraft that has declared its intent flies that. One that is guided shares its forecast. Any
other one flies straight on as soon as it has rolled out; while it turns, it may also turn on.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import atan, inf

import numpy as np
from numpy.typing import NDArray

from relguide.flying.leaders.declared import intent_after
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import Body
from relguide.planning.aircraft import Traffic
from relguide.planning.heights import ALWAYS, Interval
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.limits import BANK, MAX_PIECES, TAS
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.planning.wind import Wind
from relguide.units import DEG, G0, Metre, Radian, RadianPerSecond, Second

TURNS: RadianPerSecond = 0.3 * DEG
"""An aircraft that turns slower flies straight [rad/s]."""
TURNS_ON: Radian = 180.0 * DEG
"""An aircraft that turned farther would fly back to where it came from [rad]."""
LEAST_TURN: Radian = 1.0 * DEG
"""A shared path that turns by less goes straight on [rad]."""


@dataclass(frozen=True, kw_only=True)
class SeenOther:
    """Another aircraft as it is seen now, and what it is expected to fly."""

    ident: str
    body: Body
    """As perceived, over the ground."""
    heading: Radian
    """Where it points, once it has rolled out of a turn that it has not declared [rad]."""
    wind: Wind
    """As the pursuer believes it."""
    min_separation: Metre
    """How near the pursuer may come to it [m]."""
    intent: tuple[IntentPiece, ...] = ()
    """What it is expected to fly from now on, then straight ahead."""
    declared: bool = False
    """Whether it has said so itself."""
    broke_its_word: bool = False
    """Whether it was found not to fly what it had declared."""
    shared: FloatArray | None = None
    """Where it will be each second from now on by its own forecast; `None` if it shares none.
    shape (n, 2)"""
    margin: Metre = 0.0
    """What is kept beside its minimum, as it is not seen exactly [m]."""
    counts: tuple[Interval, ...] = ALWAYS
    """From when until when its minimum counts, since 1,000 ft are not certain, from now on [s]."""

    @cached_property
    def turn_rate(self) -> RadianPerSecond:
        """As observed, positive to the right [rad/s]."""
        return turn_rate(self.body.tas, self.body.bank)

    def may_count(self, within: Second = inf) -> bool:
        """Whether its minimum counts at any time within so many seconds from now."""
        return bool(self.counts) and self.counts[0][0] <= within

    def counts_at(self, seconds: int) -> NDArray[np.bool_]:
        """Whether its minimum counts at each second from now on; of shape (seconds + 1,)."""
        t = np.arange(seconds + 1.0)
        found = np.zeros(len(t), dtype=bool)
        for since, until in self.counts:
            found |= (t >= since - 1.0) & (t <= until + 1.0)
        return found

    @property
    def turns_unannounced(self) -> bool:
        """Whether it turns, and nothing says how far."""
        return not self.declared and abs(self.turn_rate) > TURNS

    @cached_property
    def traffic(self) -> Traffic:
        """As plans take it, now."""
        return self.after(0.0)

    def after(self, seconds: Second, *, wider: Metre = 0.0) -> Traffic:
        """As plans take it some time from now, where it is expected over the ground then.

        Args:
            seconds: from now [s], ≥ 0.
            wider: a berth that it is given besides [m].
        """
        body = self.body
        now = Traffic(
            ident=self.ident,
            x=body.x,
            y=body.y,
            heading=wrap(self.heading),
            tas=min(max(body.tas, TAS.low), TAS.high),
            min_separation=self.min_separation + wider,
            intent=self.intent,
        )
        if seconds == 0.0:
            return now
        then = now.trajectory.pose_at(seconds)
        x, y = then.x + self.wind.east * seconds, then.y + self.wind.north * seconds
        intent = intent_after(now, seconds)
        return replace(now, x=x, y=y, heading=then.heading, intent=intent)

    def later(self, seconds: Second) -> "SeenOther":
        """The same some time later, if it flies as expected."""
        then = self.after(seconds)
        body = self.body._replace(x=then.x, y=then.y, heading=then.heading, bank=0.0)
        shared = None if self.shared is None else self.shared[int(seconds) :]
        counts = tuple(
            (max(since - seconds, 0.0), until - seconds)
            for since, until in self.counts
            if until > seconds
        )
        return replace(
            self,
            counts=counts,
            body=body,
            heading=then.heading,
            intent=then.intent,
            shared=shared if shared is not None and len(shared) > 1 else None,
        )

    def places(self, seconds: int) -> FloatArray:
        """Where it is expected each second from now on, over the ground.

        Returns:
            east and north [m], the present first. shape (seconds + 1, 2)
        """
        if self.shared is not None:
            return prolonged(self.shared, seconds)
        t = np.arange(seconds + 1.0)
        flown = self.traffic.trajectory.sample(t)
        return np.column_stack((flown.x + self.wind.east * t, flown.y + self.wind.north * t))

    def places_turning_on(self, seconds: int) -> FloatArray:
        """The same if its present turn goes on for as much as 180° more."""
        rate, tas = self.turn_rate, self.body.tas
        t = np.arange(seconds + 1.0)
        turned = np.minimum(t, TURNS_ON / abs(rate))
        half, straight = 0.5 * rate * turned, t - turned
        chord = tas * turned * np.sinc(half / np.pi)
        end = self.body.heading + 2.0 * half
        x = self.body.x + chord * np.sin(self.body.heading + half) + tas * straight * np.sin(end)
        y = self.body.y + chord * np.cos(self.body.heading + half) + tas * straight * np.cos(end)
        return np.column_stack((x + self.wind.east * t, y + self.wind.north * t))


def prolonged(places: FloatArray, seconds: int) -> FloatArray:
    """Places each second from now on, straight on past the last; of shape (seconds + 1, 2)."""
    missing = seconds + 1 - len(places)
    if missing <= 0:
        return places[: seconds + 1]
    steps = np.arange(1.0, missing + 1.0)[:, None]
    return np.vstack((places, places[-1] + steps * (places[-1] - places[-2])))


def pieces_along(rows: FloatArray) -> tuple[IntentPiece, ...]:
    """What a flight ahead does, as pieces of an intent: its turns, and the straights between.

    Args:
        rows: a second apart, the present first. shape (n, 7), as `Body`
    """
    headings, tas = rows[:, 2], float(rows[0, 5])
    rates = np.diff(headings)
    sides = np.where(np.abs(rates) > TURNS, np.sign(rates), 0.0)
    ends = [*(np.flatnonzero(np.diff(sides)) + 1).tolist(), len(sides)]
    pieces: list[IntentPiece] = []
    begun, straight = 0, 0.0
    for end in ends:
        side, turned = float(sides[begun]), float(headings[end] - headings[begun])
        if side == 0.0 or abs(turned) < LEAST_TURN:
            straight += end - begun
        else:
            if straight > 0.0:
                pieces.append(FlyStraight(duration=straight))
            bank = atan(tas * abs(turned) / (end - begun) / G0)
            low, high = BANK.low * DEG, BANK.high * DEG
            turn: Turn = RIGHT if side > 0.0 else LEFT
            to = wrap(float(headings[end]))
            pieces.append(TurnTo(heading=to, turn=turn, bank=min(max(bank, low), high)))
            straight = 0.0
        begun = end
    return tuple(pieces[:MAX_PIECES])
