"""The client for programs that wait: each method asks, and gives the answer."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from types import TracebackType
from typing import Any, Self, TypeVar

import httpx2
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from relguide.client import calls
from relguide.client.bodies import Asked
from relguide.client.calls import (
    Answer,
    Call,
    Include,
    IncludeDrawn,
    Invalid,
    Line,
    Lines,
    PlannerName,
    expect_served,
    streaming,
)
from relguide.contract.area_bodies import AreaAnswer
from relguide.contract.messages import FlightStatus
from relguide.contract.protocol import STREAM
from relguide.contract.simulation_bodies import SimulationAnswer
from relguide.flying.documents import Document
from relguide.flying.engagement import Engagement
from relguide.flying.pilot_model import PilotModel
from relguide.units import Second

T = TypeVar("T")


class Client:
    """A service, asked by a program that waits.

    Every method raises `Refused` where the service does not serve, and httpx2's `TransportError`
    where it is not reached.
    """

    def __init__(
        self, url: str = "http://127.0.0.1:8000", *, token: str = "", timeout: Second = 60.0
    ) -> None:
        """Prepare to ask.

        Args:
            url: where the service is, with the path that a proxy serves it below.
            token: that shows what this program may do; none by default.
            timeout: how long to wait for an answer [s].
        """
        self._url = calls.base_url(url)
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._http = httpx2.Client(base_url=self._url, headers=self._headers, timeout=timeout)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def plan(
        self,
        asked: Asked,
        *,
        max_ms: float | None = None,
        include: Sequence[Include] = (),
        planner: PlannerName | None = None,
    ) -> Answer:
        """Plan a situation.

        Args:
            asked: the situation.
            max_ms: how long planning may take; if left out, as the service says [ms].
            include: what to add to the plan.
            planner: who plans; the service's own if left out.
        """
        return self.ask(calls.plan(asked, max_ms=max_ms, include=include, planner=planner))

    def plan_geojson(
        self,
        asked: Asked,
        *,
        max_ms: float | None = None,
        include: Sequence[IncludeDrawn] = (),
        planner: PlannerName | None = None,
    ) -> dict[str, Any]:
        """Plan a situation that lies on the earth (latitudes in its body), as GeoJSON.

        The object has the features and the members of the plan. Arguments as `plan`, and `paths` in
        `include` draws the other paths; `flown` adds where the plan is flown, and when it joins.
        """
        call = calls.plan_geojson(asked, max_ms=max_ms, include=include, planner=planner)
        return self.ask(call)

    def simulate(
        self,
        flights: Iterable[str | Asked | Mapping[str, Any]],
        *,
        planner: PlannerName | None = None,
    ) -> list[SimulationAnswer]:
        """Fly flights to their end at once, up to 32, and give the figures of each.

        Args:
            flights: names of scenarios, situations, or bodies as `POST /simulations` takes them.
            planner: who plans.
        """
        return self.ask(calls.simulate(flights, planner=planner))

    def plan_batch(
        self,
        asked: Iterable[Asked],
        *,
        max_ms: float | None = None,
        planner: PlannerName | None = None,
    ) -> Iterator[Answer | Invalid]:
        """The answers to any number of situations, in their order, as they come.

        Args:
            asked: the situations.
            max_ms: how long planning each may take [ms].
            planner: who plans.
        """
        for call in calls.plan_batch(asked, max_ms=max_ms, planner=planner):
            with self._http.stream(call.method, call.path, **call.options()) as response:
                if not response.is_success:
                    response.read()
                expect_served(response)
                lines = Lines()
                for part in response.iter_bytes():
                    for line in lines.add(part):
                        yield call.read(line)

    def area(self, asked: Asked, **wanted: Any) -> AreaAnswer:
        """The convergence area of a situation; `wanted` are further members of `AreaRequest`."""
        return self.ask(calls.area(asked, **wanted))

    def fly(
        self,
        what: str | Asked,
        *,
        rate: float = 1.0,
        paused: bool = False,
        seed: int = 0,
        engagement: Engagement | None = None,
        by_hand: bool | PilotModel = False,
        orders: Sequence[Line] = (),
        crew: Sequence[Line] | None = None,
    ) -> "Flight":
        """Start a flight.

        Args:
            what: the name of a scenario, or a situation.
            rate: simulated seconds per second.
            paused: whether it waits for the command `play`.
            seed: of its random numbers.
            engagement: how far guidance is engaged at the start; if left out, engaged, and with a
                crew as its script says.
            by_hand: whether a pilot model flies along the flight director's bars, and which.
            orders: what aircraft do at flight times, as `{"t_s": 60, "intent_known": False}`.
            crew: the script of a crew that reacts, as `{"on": "plan_proposed", "engagement":
                "armed"}`.
        """
        call = calls.fly(
            what, rate=rate, paused=paused, seed=seed, engagement=engagement, by_hand=by_hand,
            orders=orders, crew=crew,
        )  # fmt: skip
        return Flight(self, self.ask(call).id)

    def records(self, **sought: str | int) -> Iterator[dict[str, Any]]:
        """All flights on record, the newest first.

        Args:
            sought: as `GET /records/flights` takes it; of `limit` so many are asked for at a time.
        """
        cursor = ""
        while True:
            some, cursor = self.ask(calls.some_records(cursor, **sought))
            yield from some
            if not cursor:
                return

    def recorded(self, flight_id: str) -> Iterator[Document]:
        """The documents of a flight on record, in their order."""
        first = 0
        while some := self.ask(calls.recorded(flight_id, first)):
            for number, document in some:
                yield document
                first = number + 1

    def ask(self, call: Call[T]) -> T:
        """Send a request, and read its answer."""
        response = self._http.request(call.method, call.path, **call.options())
        expect_served(response)
        return call.read(response.content)

    def watch(self, flight_id: str) -> Iterator[Document]:
        """As `Flight.documents`."""
        address = calls.stream_url(self._url, flight_id)
        opened = partial(
            connect,
            address,
            subprotocols=[Subprotocol(STREAM)],
            additional_headers=self._headers,
            max_size=None,
        )
        with streaming(), opened() as stream:
            for message in stream:
                documents, ended = calls.documents_of(message)
                yield from documents
                if ended:
                    return


class Flight:
    """A flight that the service flies."""

    def __init__(self, client: Client, flight_id: str) -> None:
        self.id = flight_id
        self._client = client

    def status(self) -> FlightStatus:
        """Where it stands."""
        return self._client.ask(calls.status(self.id))

    def command(self, name: str, **members: Any) -> FlightStatus:
        """Tell it something, e.g. `command("leader_heading", heading_deg=135.0)`."""
        return self._client.ask(calls.command(self.id, name, **members))

    def documents(self) -> Iterator[Document]:
        """What it does, as it does it, to its end: first what happened before.

        Samples come twenty times a second. A reader that is slow misses some, and may get a
        document again.
        """
        return self._client.watch(self.id)

    def end(self) -> None:
        """End it."""
        self._client.ask(calls.end(self.id))
