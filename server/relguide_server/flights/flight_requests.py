"""From a request for a flight to the scenario that it asks for."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

from relguide.contract.crew_lines import CrewLine, StickOrder
from relguide.contract.flown_bodies import scenario_from_body
from relguide.contract.intent_bodies import intent_from_body
from relguide.contract.messages import (
    MAX_ORDERS,
    FlightRequest,
    ScenarioFlightRequest,
    SituationFlightRequest,
)
from relguide.contract.order_lines import LeaderLine
from relguide.contract.orders import Order, crew_order, fault_in, order_of
from relguide.contract.pilot_bodies import pilot_of
from relguide.contract.places import UNANCHORED, Anchor
from relguide.contract.refusal import ContractError
from relguide.flying.engagement import Engagement
from relguide.flying.flight import Scenario, world_of
from relguide.flying.orders import Command
from relguide.flying.scenarios import scenario
from relguide.flying.scripted_crew import CrewOrder, begun
from relguide.flying.tracks import RecordedTrack
from relguide.planning.intent import IntentPiece
from relguide.planning.situation import Situation
from relguide.units import Second

Line = TypeVar("Line", bound=LeaderLine | CrewLine)
Given = TypeVar("Given")


class Ordered(NamedTuple):
    """What is ordered in a flight from its beginning."""

    orders: tuple[Order, ...]
    script: tuple[CrewOrder, ...]
    """Of a crew that reacts."""
    engagement: Engagement
    """How far guidance is engaged at the start."""


def scenario_of(wanted: FlightRequest) -> tuple[str, Scenario, Anchor]:
    """What a request asks for.

    Returns:
        the scenario's name, empty for a situation of one's own; the scenario; and how its world
        frame lies on the earth.

    Raises:
        ContractError: for what cannot be flown.
    """
    match wanted:
        case ScenarioFlightRequest():
            name, found = wanted.scenario, _find_scenario(wanted.scenario)
            source = found.leader_source
            anchor: Anchor = source.origin if isinstance(source, RecordedTrack) else UNANCHORED
        case SituationFlightRequest():
            name, (found, anchor) = "", _own_scenario(wanted)
    if wanted.intent_known is not None:
        found = replace(found, intent_known=wanted.intent_known)
    if wanted.spacing_time_s is not None:
        found = replace(found, spacing=wanted.spacing_time_s)
    found = replace(found, by_hand=pilot_of(wanted.by_hand, wanted.seed))
    return name, found, anchor


def ordered_in(wanted: FlightRequest, found: Scenario) -> Ordered:
    """What a request orders in the scenario that it asks for.

    Raises:
        ContractError: for the first order that cannot be given.
    """
    orders = _in_order("orders", wanted.orders, order_of)
    lines = _in_order("crew", wanted.crew or (), crew_order)
    _expect_flying("orders", [order.command for order in orders], found)
    _expect_flying("crew", [line.command for line in lines], found)
    begins, script = begun(lines)
    if wanted.crew is None or "engagement" in wanted.model_fields_set:
        begins = wanted.engagement
    return Ordered(orders, script, begins)


def _in_order(
    name: str, lines: Sequence[Line], read: Callable[[Line, Second], Given]
) -> tuple[Given, ...]:
    """What lines order, each read with the time of the one before."""
    found, before = list[Given](), 0.0
    for index, line in enumerate(lines):
        try:
            found.append(read(line, before))
        except ContractError as error:
            (path, said), *_ = error.problems
            raise ContractError([(f"{name}[{index}].{path}", said)]) from None
        before = line.t_s or before
    return tuple(found)


def kept_request(wanted: FlightRequest) -> str:
    """A request as it is put on record, JSON: an hour of sticks is not kept twice.

    Each is a document of its flight once it is given; what has a thousand orders at most is whole.
    """
    if len(wanted.orders) > MAX_ORDERS:
        others = [line for line in wanted.orders if not isinstance(line, StickOrder)]
        wanted = wanted.model_copy(update={"orders": others})
    return wanted.model_dump_json(exclude_unset=True)


def _expect_flying(name: str, commands: Sequence[Command], found: Scenario) -> None:
    if not commands:
        return
    world = world_of(found)
    for index, command in enumerate(commands):
        if fault := fault_in(command, world):
            raise ContractError([(f"{name}[{index}].ident", fault)])


def with_intent(situation: Situation, intent: tuple[IntentPiece, ...]) -> Situation:
    """A situation whose leader declares another intent."""
    return replace(situation, leader=replace(situation.leader, intent=intent))


def _find_scenario(name: str) -> Scenario:
    try:
        return scenario(name)
    except ValueError as error:  # unknown, or its data are not installed: the error says which
        raise ContractError([("scenario", str(error))]) from None


def _own_scenario(wanted: SituationFlightRequest) -> tuple[Scenario, Anchor]:
    try:
        own, anchor = scenario_from_body(wanted.situation)
        if wanted.flown_intent is None:
            return own, anchor
        flown = with_intent(own.situation, intent_from_body(wanted.flown_intent))
        declared = own.situation.leader.intent
        return replace(own, situation=flown, declared_intent=declared), anchor
    except ContractError as error:
        under = [(f"situation.{path}".rstrip("."), said) for path, said in error.problems]
        raise ContractError(under) from None
    except ValueError as error:  # no level at which the aircraft could fly it, in a sentence
        raise ContractError([("situation.pursuer", str(error))]) from None
