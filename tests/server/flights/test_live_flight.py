"""What the service itself says in a flight: in its stream and on its record, in order of time."""

import asyncio
from itertools import pairwise

from relguide_server.flights.live_flight import FlightLabel, LiveFlight
from relguide_server.http.metrics import Metrics
from relguide_server.records.entries import Outcome
from relguide_server.records.recorder import Recorder

from relguide.flying.documents import ClearanceNews, Document, FlightEnded, Sample
from tests.server.flown import OWN, ideal_flight


class Kept(Recorder):
    """Keeps documents in memory."""

    def __init__(self) -> None:
        super().__init__(0.0)
        self.documents: list[Document] = []
        self.outcomes: list[Outcome] = []

    def add(self, document: Document) -> None:
        self.documents.append(document)

    def end(self, outcome: Outcome) -> None:
        self.outcomes.append(outcome)


def news(t: float) -> ClearanceNews:
    return ClearanceNews(
        t=t,
        ident=OWN,
        clearance_id="c1",
        clearance="sent",
        level="none",
        message="",
        automated=False,
    )


def fly(kept: Kept, *, paused: bool) -> LiveFlight:
    return LiveFlight(
        FlightLabel(id="one", scenario="", title=""), lambda commands: ideal_flight(commands),
        rate=60.0, paused=paused, metrics=Metrics(), recording=kept,
    )  # fmt: skip


def test_what_is_said_while_a_flight_is_paused_is_seen_at_once() -> None:
    async def run() -> None:
        kept = Kept()
        flight = fly(kept, paused=True)
        await flight.wait_for_first_sample()
        flight.say(news)
        (said,) = [d for d in flight.collect() if isinstance(d, ClearanceNews)]
        assert said in flight.history.documents()
        assert kept.documents[-1] is said
        await flight.land("removed")

    asyncio.run(run())


def test_what_is_said_stands_in_order_of_time_and_never_behind_the_end() -> None:
    async def run() -> None:
        kept = Kept()
        flight = fly(kept, paused=False)
        while not kept.outcomes:
            flight.say(news)
            await asyncio.sleep(0.002)
        flight.say(news)
        assert isinstance(kept.documents[-1], FlightEnded)
        said = [d for d in kept.documents if isinstance(d, ClearanceNews)]
        assert len(said) > 10
        assert all(a.t <= b.t for a, b in pairwise(kept.documents))
        assert any(isinstance(d, Sample) for d in kept.documents)
        assert flight.collect()[-1] is kept.documents[-1]
        await flight.land("removed")

    asyncio.run(run())
