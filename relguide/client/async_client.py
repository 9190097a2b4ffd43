"""The client for programs that do other things meanwhile: as `Client`, awaited."""

from collections.abc import AsyncIterator, Iterable, Mapping, Sequence
from types import TracebackType
from typing import Any, Self, TypeVar

import httpx2
from websockets.asyncio.client import connect
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


class AsyncClient:
    """A service, asked by a program that does other things meanwhile; otherwise as `Client`."""

    def __init__(
        self, url: str = "http://127.0.0.1:8000", *, token: str = "", timeout: Second = 60.0
    ) -> None:
        """As `Client`."""
        self._url = calls.base_url(url)
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._http = httpx2.AsyncClient(base_url=self._url, headers=self._headers, timeout=timeout)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """As `Client.close`."""
        await self._http.aclose()

    async def plan(
        self,
        asked: Asked,
        *,
        max_ms: float | None = None,
        include: Sequence[Include] = (),
        planner: PlannerName | None = None,
    ) -> Answer:
        """As `Client.plan`."""
        return await self.ask(calls.plan(asked, max_ms=max_ms, include=include, planner=planner))

    async def plan_geojson(
        self,
        asked: Asked,
        *,
        max_ms: float | None = None,
        include: Sequence[IncludeDrawn] = (),
        planner: PlannerName | None = None,
    ) -> dict[str, Any]:
        """As `Client.plan_geojson`."""
        call = calls.plan_geojson(asked, max_ms=max_ms, include=include, planner=planner)
        return await self.ask(call)

    async def simulate(
        self,
        flights: Iterable[str | Asked | Mapping[str, Any]],
        *,
        planner: PlannerName | None = None,
    ) -> list[SimulationAnswer]:
        """As `Client.simulate`."""
        return await self.ask(calls.simulate(flights, planner=planner))

    async def plan_batch(
        self,
        asked: Iterable[Asked],
        *,
        max_ms: float | None = None,
        planner: PlannerName | None = None,
    ) -> AsyncIterator[Answer | Invalid]:
        """As `Client.plan_batch`."""
        for call in calls.plan_batch(asked, max_ms=max_ms, planner=planner):
            async with self._http.stream(call.method, call.path, **call.options()) as response:
                if not response.is_success:
                    await response.aread()
                expect_served(response)
                lines = Lines()
                async for part in response.aiter_bytes():
                    for line in lines.add(part):
                        yield call.read(line)

    async def area(self, asked: Asked, **wanted: Any) -> AreaAnswer:
        """As `Client.area`."""
        return await self.ask(calls.area(asked, **wanted))

    async def fly(
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
    ) -> "AsyncFlight":
        """As `Client.fly`."""
        call = calls.fly(
            what, rate=rate, paused=paused, seed=seed, engagement=engagement, by_hand=by_hand,
            orders=orders, crew=crew,
        )  # fmt: skip
        return AsyncFlight(self, (await self.ask(call)).id)

    async def records(self, **sought: str | int) -> AsyncIterator[dict[str, Any]]:
        """As `Client.records`."""
        cursor = ""
        while True:
            some, cursor = await self.ask(calls.some_records(cursor, **sought))
            for record in some:
                yield record
            if not cursor:
                return

    async def recorded(self, flight_id: str) -> AsyncIterator[Document]:
        """As `Client.recorded`."""
        first = 0
        while some := await self.ask(calls.recorded(flight_id, first)):
            for number, document in some:
                yield document
                first = number + 1

    async def ask(self, call: Call[T]) -> T:
        """As `Client.ask`."""
        response = await self._http.request(call.method, call.path, **call.options())
        expect_served(response)
        return call.read(response.content)

    async def watch(self, flight_id: str) -> AsyncIterator[Document]:
        """As `AsyncFlight.documents`."""
        address = calls.stream_url(self._url, flight_id)
        with streaming():
            async with connect(
                address,
                subprotocols=[Subprotocol(STREAM)],
                additional_headers=self._headers,
                max_size=None,
            ) as stream:
                async for message in stream:
                    documents, ended = calls.documents_of(message)
                    for document in documents:
                        yield document
                    if ended:
                        return


class AsyncFlight:
    """A flight that the service flies."""

    def __init__(self, client: AsyncClient, flight_id: str) -> None:
        self.id = flight_id
        self._client = client

    async def status(self) -> FlightStatus:
        """As `Flight.status`."""
        return await self._client.ask(calls.status(self.id))

    async def command(self, name: str, **members: Any) -> FlightStatus:
        """Tell it something, e.g. `command("leader_heading", heading_deg=135.0)`."""
        return await self._client.ask(calls.command(self.id, name, **members))

    def documents(self) -> AsyncIterator[Document]:
        """As `Flight.documents`."""
        return self._client.watch(self.id)

    async def end(self) -> None:
        """As `Flight.end`."""
        await self._client.ask(calls.end(self.id))
