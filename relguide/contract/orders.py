"""Orders to the aircraft of a flight, read from JSON lines, and given to them at their times.

{"t_s": 60, "intent_known": false}
{"t_s": 300, "leader_heading_deg": 180, "direction": "left"}
{"t_s": 950, "leader_tas_mps": 100}
{"t_s": 990, "leader_level_m": 8000, "rate_mps": 8}
{"t_s": 950, "leader_tas_mps": 210, "ident": "BAW12"}
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import IO, Annotated, NamedTuple

from pydantic import Field

from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import ClimbRate
from relguide.contract.other_bodies import Tas
from relguide.contract.places import Altitude
from relguide.contract.refusal import ContractError, Strict, loads, parse
from relguide.flying.leaders.declared import TurnChoice
from relguide.flying.orders import (
    Command,
    IntentKnown,
    LeaderHeading,
    LeaderLevel,
    LeaderSpeed,
    order_fault,
)
from relguide.flying.world import World
from relguide.units import Second

MAX_LINE = 10_000
"""Longest line that is read [bytes]; an order has some 70."""

Ident = Annotated[str, Field(max_length=100)]
OrderTime = Annotated[float, Field(ge=0.0)]


class HeadingOrder(Strict):
    """The leader is to turn to a heading."""

    t_s: OrderTime
    """Flight time at which it is given."""
    leader_heading_deg: float
    """Clockwise from true north."""
    direction: TurnChoice = "shorter"
    """Which way round."""
    ident: Ident = ""
    """Who is to do so; empty for the first link's leader."""

    def command(self) -> Command:
        """What the flight is given."""
        heading = heading_of(self.leader_heading_deg)
        return LeaderHeading(heading=heading, direction=self.direction, ident=self.ident)


class SpeedOrder(Strict):
    """The leader is to fly at a speed."""

    t_s: OrderTime
    """Flight time at which it is given."""
    leader_tas_mps: Tas
    """True airspeed."""
    ident: Ident = ""
    """Who is to do so; empty for the first link's leader."""

    def command(self) -> Command:
        """What the flight is given."""
        return LeaderSpeed(tas=self.leader_tas_mps, ident=self.ident)


class LevelOrder(Strict):
    """The leader is to climb or descend."""

    t_s: OrderTime
    """Flight time at which it is given."""
    leader_level_m: Altitude
    """Pressure altitude to level off at."""
    rate_mps: ClimbRate = 7.62
    """How fast; 1,500 ft/min if left out."""
    ident: Ident = ""
    """Who is to do so; empty for the first link's leader."""

    def command(self) -> Command:
        """What the flight is given."""
        return LeaderLevel(altitude=self.leader_level_m, rate=self.rate_mps, ident=self.ident)


class IntentOrder(Strict):
    """The leader's intent is given to the pursuer, or withdrawn."""

    t_s: OrderTime
    """Flight time at which that happens."""
    intent_known: bool
    ident: Ident = ""
    """Whose it is; empty for the first link's leader."""

    def command(self) -> Command:
        """What the flight is given."""
        return IntentKnown(known=self.intent_known, ident=self.ident)


_MODELS: dict[str, type[HeadingOrder] | type[SpeedOrder] | type[LevelOrder] | type[IntentOrder]] = {
    "leader_heading_deg": HeadingOrder,
    "leader_tas_mps": SpeedOrder,
    "leader_level_m": LevelOrder,
    "intent_known": IntentOrder,
}
"""The field that only this kind of order has."""


class Order(NamedTuple):
    """A command and its flight time [s]."""

    t: Second
    command: Command


def read_orders(stream: IO[bytes], name: str) -> tuple[Order, ...]:
    """Read orders, one a line, in order of time; blank lines are passed over.

    Args:
        stream: what to read.
        name: what the reader knows it by, for messages.

    Raises:
        ValueError: naming the first line that is not an order, and what would be right.
    """
    orders: list[Order] = []
    for number, line in enumerate(_lines(stream), start=1):
        if not line.strip():
            continue
        try:
            order = _order(line)
            if orders and order.t < orders[-1].t:
                before = f"at least {orders[-1].t:.12g}, that of the order before"
                raise ContractError([("t_s", f"must be {before}, not {order.t:.12g}.")])
        except ContractError as error:
            raise ValueError(f"{name}, line {number}: {error}") from None
        orders.append(order)
    return tuple(orders)


def commands_of(orders: Sequence[Order]) -> Callable[[Second], Iterable[Command]]:
    """What `fly` polls for commands: each is given once, at the first step at or after its time."""
    left = list(orders)

    def due(t: Second) -> Iterable[Command]:
        while left and left[0].t <= t + 1e-9:  # a step's time is a product, and may fall short
            yield left.pop(0).command

    return due


def expect_flying(orders: Sequence[Order], world: World) -> None:
    """Refuse an order to an aircraft that does not fly, or cannot be given it.

    Raises:
        ValueError: for the first such order, with its time and what would be right.
    """
    links = [(link.pursuer, link.leader) for link in world.links]
    for order in orders:
        fault = order_fault(order.command, [one.ident for one in world.aircraft], links)
        if fault:
            raise ValueError(f"The order at {order.t:.12g} s: {fault}")


def _lines(stream: IO[bytes]) -> Iterator[bytes]:
    while line := stream.readline(MAX_LINE + 1):
        yield line


def _order(line: bytes) -> Order:
    if len(line) > MAX_LINE:
        raise ContractError([("", f"This is longer than {MAX_LINE:,} bytes, so it is no order.")])
    content = loads(line)
    if not isinstance(content, dict):
        raise ContractError([("", "A line must be an object with fields: an order.")])
    given = [name for name in _MODELS if name in content]
    if len(given) != 1:
        names = "leader_heading_deg, leader_tas_mps, leader_level_m or intent_known"
        raise ContractError([("", f"An order has one of {names}, not {len(given)} of them.")])
    body = parse(_MODELS[given[0]], content)
    return Order(body.t_s, body.command())
