"""The flight service: all flights of this server, their common tick, and room for new ones."""

import asyncio
import secrets
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

from relguide.contract.places import UNANCHORED, Anchor
from relguide_server.flights.live_flight import FlightLabel, LiveFlight, Source
from relguide_server.flights.stream import RESTART
from relguide_server.http.errors import Refusal
from relguide_server.http.metrics import Metrics
from relguide_server.http.proxy import believed
from relguide_server.records.entries import Outcome
from relguide_server.records.recorder import Recorder
from relguide_server.settings import ServiceSettings

REAP_PERIOD = 1.0
"""How often unwatched flights are looked for [s]."""
TAKE_OFF = 60.0
"""How long a new flight may take to its first sample [s]: kernels may have to be compiled first."""
TOO_MANY = (
    "{count} flights are in the air, the most that this server flies at once. End one (DELETE), or "
    "try again when one is no longer watched."
)
TOO_MANY_OF_YOURS = (
    "You have {count} flights in the air, the most of one client's: half of all that this server "
    "flies. End one (DELETE), or try again when one is no longer watched."
)


class LiveFleet:
    """All flights. Lives on the event loop, from `start` to `stop`."""

    def __init__(self, settings: ServiceSettings, metrics: Metrics) -> None:
        self._settings = settings
        self._metrics = metrics
        self._speaks_for_many = believed(settings.proxies)
        self._flights: dict[str, LiveFlight] = {}
        self._tasks: list[asyncio.Task[None]] = []

    def __iter__(self) -> Iterator[LiveFlight]:
        return iter(self._flights.values())

    def start(self) -> None:
        """Start the tick and the removal of unwatched flights."""
        self._tasks = [asyncio.create_task(self._tick()), asyncio.create_task(self._reap())]

    async def stop(self) -> None:
        """End all flights."""
        for task in self._tasks:
            task.cancel()
        for task in self._tasks:
            with suppress(asyncio.CancelledError):
                await task
        await asyncio.gather(*(self._land(flight, "stopped") for flight in list(self)))

    def dismiss(self) -> None:
        """Tell all streams that the service stops."""
        for flight in self:
            flight.dismiss(RESTART, "The service is stopping: it may be back in a moment.")

    def find(self, flight_id: str) -> LiveFlight:
        """A flight by its id.

        Raises:
            Refusal: 404, if there is none.
        """
        flight = self._flights.get(flight_id)
        if flight is None:
            raise Refusal(
                404,
                f"There is no flight {flight_id!r}: it never existed or has been removed. "
                "GET /api/v1/flights lists all flights.",
            )
        flight.note_seen()
        return flight

    def knows(self, flight_id: str) -> bool:
        """Whether there is such a flight."""
        return flight_id in self._flights

    async def launch(
        self,
        scenario: str,
        title: str,
        source: Source,
        *,
        rate: float,
        paused: bool,
        record: Callable[[str], Recorder],
        replay: bool = False,
        modelled: bool = False,
        reported_leader: str = "",
        owner: str = "",
        client: str = "",
        anchor: Anchor = UNANCHORED,
        seed: int = 0,
    ) -> LiveFlight:
        """Start a flight, and wait until it is in the air.

        Args:
            scenario: its name; empty for a situation of the client's own.
            title: for people.
            source: flies it.
            rate: simulated seconds per second.
            paused: whether it waits for `play`.
            record: what records it, given its id.
            replay: whether it is a recording.
            modelled: whether a modelled pilot flies it by hand.
            reported_leader: the aircraft of the picture that its leader flies as, if there is one.
            owner: who starts it, and may command it.
            client: whose share of the flights it counts in.
            anchor: how its world lies on the earth.
            seed: of its random numbers.

        Raises:
            Refusal: 429, if too many fly already; 500, if it broke before its first sample.
        """
        await self._make_room(client)
        label = FlightLabel(
            id=self._new_id(),
            scenario=scenario,
            title=title,
            replay=replay,
            modelled=modelled,
            reported_leader=reported_leader,
            owner=owner,
            client=client,
            anchor=anchor,
            seed=seed,
        )
        flight = LiveFlight(
            label,
            source,
            rate=rate,
            paused=paused,
            metrics=self._metrics,
            recording=record(label.id),
        )
        self._flights[label.id] = flight
        self._metrics.flights_started.inc()
        try:
            began = await asyncio.wait_for(flight.wait_for_first_sample(), TAKE_OFF)
        except TimeoutError:
            began = False
        if not began:
            await self._land(flight, "broken")
            raise Refusal(500, "The flight stopped before it began: the server's log says why.")
        return flight

    def _new_id(self) -> str:
        process = self._settings.process
        return f"{process}-{secrets.token_hex(6)}" if process else secrets.token_hex(6)

    async def remove(self, flight_id: str) -> None:
        """End a flight and forget it."""
        await self._land(self.find(flight_id), "removed")

    async def _land(self, flight: LiveFlight, outcome: Outcome) -> None:
        self._flights.pop(flight.label.id, None)
        await flight.land(outcome)

    async def _make_room(self, client: str) -> None:
        """End a flight that nobody looks at, if there are as many as there may be.

        Of the flights in the air only those of clients with more of them than this one are ended.

        Raises:
            Refusal: 429, where none can be; it says whose share is full.
        """
        most = self._settings.max_flights
        share = most if self._speaks_for_many(client) else max(most // 2, 1)
        while len(own := self._flights_of(client)) >= share:
            await self._end_one(own, TOO_MANY_OF_YOURS.format(count=len(own)))
        while len(self._flights) >= most:
            counts = Counter(flight.label.client for flight in self)
            others = [f for f in self if f.over or counts[f.label.client] > len(own)]
            await self._end_one(others or own, TOO_MANY.format(count=most))

    async def _end_one(self, flights: Sequence[LiveFlight], refusal: str) -> None:
        """End one of some flights that nobody looks at: one that is over, else the one seen last.

        Raises:
            Refusal: if there is none.
        """
        now, spare = asyncio.get_running_loop().time(), self._settings.spare_after
        unseen = [
            flight
            for flight in flights
            if not flight.watched and (flight.over or now - flight.last_seen > spare)
        ]
        if not unseen:
            raise Refusal(429, refusal, headers={"Retry-After": str(round(spare))})
        spared = min(unseen, key=lambda flight: (not flight.over, flight.last_seen))
        await self._land(spared, "unwatched")

    def _flights_of(self, client: str) -> list[LiveFlight]:
        return [flight for flight in self if flight.label.client == client]

    async def _tick(self) -> None:
        loop, period = asyncio.get_running_loop(), 1.0 / self._settings.stream_rate
        due = loop.time()
        while True:
            for flight in list(self):
                flight.beat()
            # Late by more than a tick, e.g. after the machine slept: continue from now.
            due = max(due + period, loop.time() - period)
            await asyncio.sleep(due - loop.time())

    async def _reap(self) -> None:
        loop = asyncio.get_running_loop()
        before = loop.time()
        while True:
            await asyncio.sleep(REAP_PERIOD)
            before, seconds = loop.time(), loop.time() - before
            self._measure_rates(seconds)
            for flight in list(self):
                unseen = loop.time() - flight.last_seen
                if not flight.watched and unseen > self._settings.keep_unseen:
                    await self._land(flight, "unwatched")

    def _measure_rates(self, seconds: float) -> None:
        least = 1.0
        for flight in self:
            flown, asked = flight.progress(seconds)
            if asked > 0.0:
                self._metrics.flight_seconds.inc(flown)
                self._metrics.flight_seconds_asked.inc(asked)
                least = min(least, flown / asked)
        self._metrics.least_rate.set(least)


async def fleet_of(connection: HTTPConnection) -> LiveFleet:
    """The fleet of the app that serves this connection."""
    fleet: LiveFleet = connection.app.state.fleet
    return fleet


FleetOf = Annotated[LiveFleet, Depends(fleet_of)]
"""How a route asks for the fleet."""
