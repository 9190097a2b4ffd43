"""Orders to the aircraft of a flight, read from JSON lines, and given to them at their times.

{"t_s": 60, "intent_known": false}
{"t_s": 300, "leader_heading_deg": 180, "direction": "left"}
{"t_s": 950, "leader_tas_mps": 210, "ident": "BAW12"}
{"t_s": 990, "autopilot": false}

A crew's script has the orders of crews only, and they may wait for what is said of the flight:

{"on": "proposed", "after_s": 5, "engagement": "armed"}

A recording holds all orders that were given in its flight, which is flown again by them.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import IO, Any, NamedTuple, TypeVar

from pydantic import BaseModel, RootModel

from relguide.contract.crew_lines import CrewLine, CrewOrderLine
from relguide.contract.order_lines import LeaderLine, OrderLine
from relguide.contract.refusal import ContractError, loads, parse
from relguide.flying.documents import (
    CommandGiven,
    ControlChanged,
    Document,
    EngagementChanged,
    FlightStarted,
    Sample,
)
from relguide.flying.engagement import Engagement
from relguide.flying.orders import Command, SetDirector, order_fault
from relguide.flying.scripted_crew import CrewOrder
from relguide.flying.world import World
from relguide.planning.inputs import expect
from relguide.units import Second

MAX_LINE = 10_000
"""Longest line that is read [bytes]; an order has some 70."""
M = TypeVar("M", bound=BaseModel)


class OrderBody(RootModel[OrderLine]):
    """A line of orders."""


class CrewOrderBody(RootModel[CrewOrderLine]):
    """A line of a crew's script."""


class Order(NamedTuple):
    """A command and its flight time [s]."""

    t: Second
    command: Command


class FlownAgain(NamedTuple):
    """What a flight is flown again by, beside its scenario."""

    orders: tuple[Order, ...]
    engagement: Engagement
    """How far guidance was engaged at the start."""
    seed: int
    scenario: str
    """The name of what was flown."""
    by_pilot: bool = False
    """Whether a modelled pilot flew it by hand."""


def read_orders(stream: IO[bytes], name: str) -> tuple[Order, ...]:
    """Read orders, one a line, in order of time; blank lines are passed over.

    Args:
        stream: what to read.
        name: what the reader knows it by, for messages.

    Raises:
        ValueError: naming the first line that is not an order, and what would be right.
    """
    orders: list[Order] = []
    for where, body in _bodies(stream, name, OrderBody):
        try:
            orders.append(order_of(body.root, orders[-1].t if orders else 0.0))
        except ContractError as error:
            raise ValueError(f"{where}: {error}") from None
    return tuple(orders)


def order_of(line: LeaderLine | CrewLine, before: Second = 0.0) -> Order:
    """The order of a line, whose shape is right.

    Args:
        line: as it was read.
        before: time of the order before it.

    Raises:
        ContractError: if it has no time, or comes before the one before it.
    """
    if line.t_s is None:
        said = "waits for a cue, which only a crew's script has: give t_s."
        raise ContractError([("on", said)])
    return Order(_in_order(line.t_s, before), line.command())


def _in_order(t: Second, before: Second) -> Second:
    if t < before:
        said = f"must be at least {before:.12g}, that of the order before, not {t:.12g}."
        raise ContractError([("t_s", said)])
    return t


def read_crew(stream: IO[bytes], name: str) -> tuple[CrewOrder, ...]:
    """Read a crew's script, one order a line; blank lines are passed over.

    Args:
        stream: what to read.
        name: what the reader knows it by, for messages.

    Raises:
        ValueError: naming the first line that is no order of a crew, and what would be right; or
            if there is no order at all.
    """
    script, before = list[CrewOrder](), 0.0
    for where, body in _bodies(stream, name, CrewOrderBody):
        try:
            script.append(crew_order(body.root, before))
        except ContractError as error:
            raise ValueError(f"{where}: {error}") from None
        before = body.root.t_s or before
    if not script:
        raise ValueError(f"{name}: It is empty, and a crew's script has one order or more.")
    return tuple(script)


def crew_order(line: CrewLine, before: Second = 0.0) -> CrewOrder:
    """What a line of a crew's script says.

    Args:
        line: as it was read.
        before: time of the last order before it that waits for no cue.

    Raises:
        ContractError: if it comes before that one.
    """
    if line.on is None:
        return CrewOrder(command=line.command(), after=_in_order(line.t_s, before))
    return CrewOrder(command=line.command(), on=line.on, after=line.after_s)


def crew_of(script: Sequence[Mapping[str, Any]]) -> tuple[CrewOrder, ...]:
    """A crew's script from its orders as objects.

    Raises:
        ValueError: naming the first that is no order of a crew, and what would be right.
    """
    expect("crew", script, list, tuple)
    orders, before = list[CrewOrder](), 0.0
    for number, order in enumerate(script, start=1):
        try:
            line = parse(CrewOrderBody, dict(order) if isinstance(order, Mapping) else None).root
            orders.append(crew_order(line, before))
        except ContractError as error:
            raise ValueError(f"crew, order {number}: {error}") from None
        before = line.t_s or before
    return tuple(orders)


def flown_again(documents: Iterable[Document]) -> FlownAgain:
    """What a recorded flight is flown again by.

    Raises:
        ValueError: if its documents do not begin with its start.
    """
    orders: list[Order] = []
    seed, first, scenario = -1, "", ""
    engaged: list[Engagement] = []
    bars: list[bool] = []  # at the start they are on only where a pilot is modelled
    for document in documents:
        match document:
            case FlightStarted():
                seed, scenario = document.seed, document.scenario
                first = next((link.pursuer for link in document.links), "")
            case CommandGiven():
                orders.append(Order(document.t, document.command))
                bars += [False] if isinstance(document.command, SetDirector) else []
            case ControlChanged(ident=ident, director=director) if ident == first:
                bars.append(director)
            case EngagementChanged(ident=ident, previous=previous) if ident == first:
                engaged.append(previous)
            case Sample(guidance=guidance):
                engaged += [one.engagement for one in guidance[:1]]
                bars += [one.director for one in guidance[:1]]
    if seed < 0:
        raise ValueError("The recording lacks its beginning, so it cannot be flown again.")
    return FlownAgain(
        tuple(orders), engaged[0] if engaged else "engaged", seed, scenario, bars[:1] == [True]
    )


def commands_of(orders: Sequence[Order]) -> Callable[[Second], Iterable[Command]]:
    """What `fly` polls for commands: each is given once, at the first step at or after its time."""
    left = deque(orders)

    def due(t: Second) -> Iterable[Command]:
        while left and left[0].t <= t + 1e-9:  # a step's time is a product, and may fall short
            yield left.popleft().command

    return due


def expect_flying(orders: Sequence[Order], script: Sequence[CrewOrder], world: World) -> None:
    """Refuse an order to an aircraft that does not fly, or cannot be given it.

    Raises:
        ValueError: for the first such order, with its time and what would be right.
    """
    for order in orders:
        if fault := fault_in(order.command, world):
            raise ValueError(f"The order at {order.t:.12g} s: {fault}")
    for number, one in enumerate(script, start=1):
        if fault := fault_in(one.command, world):
            raise ValueError(f"The crew's order {number}: {fault}")


def fault_in(command: Command, world: World) -> str:
    """Why an aircraft of a world cannot be given a command, in a sentence; empty if it can."""
    links = [(link.pursuer, link.leader) for link in world.links]
    return order_fault(command, [one.ident for one in world.aircraft], links)


def _bodies(stream: IO[bytes], name: str, model: type[M]) -> Iterator[tuple[str, M]]:
    """Each line that is not blank, and where it stands."""
    for number, line in enumerate(_lines(stream), start=1):
        if line.strip():
            where = f"{name}, line {number}"
            try:
                yield where, _body(line, model)
            except ContractError as error:
                raise ValueError(f"{where}: {error}") from None


def _lines(stream: IO[bytes]) -> Iterator[bytes]:
    while line := stream.readline(MAX_LINE + 1):
        yield line


def _body(line: bytes, model: type[M]) -> M:
    if len(line) > MAX_LINE:
        raise ContractError([("", f"This is longer than {MAX_LINE:,} bytes, so it is no order.")])
    content = loads(line)
    if not isinstance(content, dict):
        raise ContractError([("", "A line must be an object with fields: an order.")])
    return parse(model, content)
