"""The catalogue: what can be flown, scenarios by name and situations of your own."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from math import inf
from time import monotonic
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

from relguide.contract.messages import FlightRequest, ScenarioInfo, ScenarioList
from relguide.contract.orders import commands_of
from relguide.contract.places import UNANCHORED, Anchor
from relguide.flying.flight import Scenario, fly
from relguide.flying.scenarios import SCENARIOS, scenario
from relguide.flying.scripted_crew import both, with_crew
from relguide.planning.outcome import Planner
from relguide.planning.situation import Situation
from relguide_server.flights.flight_requests import ordered_in, scenario_of, with_intent
from relguide_server.flights.live_flight import Source

ENDLESS = 1e9
"""A flight goes on until somebody ends it, or nobody watches it any more [s]."""
FAN_PAUSE = 0.5
"""By the wall clock, between two fans of a flight: each takes some 30 ms [s]."""
REHEARSED = "fig_6b"
"""The scenario that is flown for a while at the start, so that its kernels are compiled."""
REHEARSAL = 400
"""Documents of it: 20 s of flight."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RequestedFlight:
    """A flight ready to start."""

    scenario: str
    """Its name; empty for a situation of your own."""
    title: str
    source: Source
    anchor: Anchor = UNANCHORED
    """How its world lies on the earth."""
    first: Situation | None = None
    """What is planned first, if that is known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightCatalogue:
    """What can be flown. A test may pass its own."""

    scenarios: Callable[[], ScenarioList]
    find: Callable[[FlightRequest], RequestedFlight]
    """Raises `ContractError` for what cannot be flown."""
    rehearse: Callable[[], None]
    """Fly for a while and discard it: afterwards everything is compiled."""


async def catalogue_of(connection: HTTPConnection) -> FlightCatalogue:
    """The catalogue of the app that serves this connection."""
    catalogue: FlightCatalogue = connection.app.state.catalogue
    return catalogue


CatalogueOf = Annotated[FlightCatalogue, Depends(catalogue_of)]
"""How a route asks for them."""


def library_catalogue(planner: Planner, name: str | None = None) -> FlightCatalogue:
    """The library's scenarios, guided by a planner, of that name if it has one."""

    def find(wanted: FlightRequest) -> RequestedFlight:
        flown, found, anchor = scenario_of(wanted)
        found = replace(found, duration_limit=ENDLESS, after_joining=ENDLESS)
        ordered, seed = ordered_in(wanted, found), wanted.seed
        return RequestedFlight(
            scenario=flown,
            title=found.title,
            source=lambda commands: with_crew(
                ordered.script,
                partial(
                    fly,
                    found,
                    planner,
                    seed=seed,
                    engagement=ordered.engagement,
                    planner_name=name,
                    wants_fan=not_too_often(),
                ),
                both(commands, commands_of(ordered.orders)),
            ),
            anchor=anchor,
            first=_known_situation(found),
        )

    def rehearse() -> None:
        for _ in islice(fly(scenario(REHEARSED), planner), REHEARSAL):
            pass

    return FlightCatalogue(scenarios=_scenarios, find=find, rehearse=rehearse)


def not_too_often(clock: Callable[[], float] = monotonic) -> Callable[[float], bool]:
    """Whether to make a fan of joins now: a flight at ×60 would be busy with little else."""
    last = -inf

    def wants(t: float) -> bool:
        nonlocal last
        del t
        if clock() < last + FAN_PAUSE:
            return False
        last = clock()
        return True

    return wants


def _known_situation(flown: Scenario) -> Situation:
    """Its situation, with as much of the leader's intent as the pursuer knows."""
    if not flown.intent_known:
        return with_intent(flown.situation, ())
    if flown.declared_intent is not None:
        return with_intent(flown.situation, flown.declared_intent)
    return flown.situation


def _scenarios() -> ScenarioList:
    infos = [
        ScenarioInfo(
            name=named.name,
            title=named.title,
            description=named.description,
            available=not named.missing(),
            message=named.missing(),
        )
        for named in SCENARIOS.values()
    ]
    return ScenarioList(scenarios=infos)
