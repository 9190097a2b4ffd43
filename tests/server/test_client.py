"""The client asks the service as a program does, waiting and not waiting alike."""

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from math import radians
from typing import Any

import orjson
import pytest
from hypothesis import given, settings
from relguide_server.app import create_app
from relguide_server.flights.catalogue import RequestedFlight
from relguide_server.records.service import records_service
from relguide_server.settings import ServiceSettings

from relguide.client import AsyncClient, Client, Invalid, Placed, Refused, calls
from relguide.client.bodies import body_of
from relguide.contract.bodies import plan_to_wire, situation_from_json
from relguide.contract.bulk import refused_line
from relguide.contract.messages import FlightRequest
from relguide.contract.orders import crew_order, order_of
from relguide.contract.pilot_bodies import pilot_of
from relguide.contract.places import UNANCHORED
from relguide.contract.wire import to_wire
from relguide.flying.cards import plan_card
from relguide.flying.documents import FlightStarted, Sample
from relguide.flying.orders import Stick
from relguide.flying.pilot_model import PilotModel
from relguide.flying.plan_documents import NoPlanCard, PathPoint, PlanCard
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from tests.bodies import AMID, BODY
from tests.server.records.test_writer import wait_for
from tests.server.serving import ideal_app, ideal_catalogue, serve
from tests.situations import situations

SITUATION, _ = situation_from_json(BODY)
AIRCRAFT = {
    name: {k: v for k, v in BODY[name].items() if k not in ("x_m", "y_m")}
    for name in ("pursuer", "leader")
}


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    records = records_service(
        records="on", database_url="", data=str(tmp_path_factory.mktemp("records")),
        record_plans=0, keep_days=1.0, keep_mb=10.0,
    )  # fmt: skip
    app = create_app(
        ServiceSettings(workers=0, root_path="/relguide"),
        catalogue=ideal_catalogue(),
        records=records,
    )
    with serve(app) as address:
        yield f"http://{address}/relguide"


@pytest.fixture(scope="module")
def client(url: str) -> Iterator[Client]:
    with Client(url) as client:
        yield client


@pytest.mark.parametrize("make", [Client, AsyncClient])
@pytest.mark.parametrize(
    ("url", "sentence"),
    [
        (
            "127.0.0.1:8000",
            r"url must begin with http:// or https://, not be '127\.0\.0\.1:8000'\.",
        ),
        ("http://a:8000/api/v1/", r"url must be where the service is, without /api/v1, not"),
    ],
)
def test_an_address_that_is_none_is_refused(make: Any, url: str, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        make(url)


@given(situation=situations())
@settings(max_examples=50, deadline=None)
def test_a_situation_is_sent_as_it_is(situation: Situation) -> None:
    read, _ = situation_from_json(body_of(situation))
    assert (read.slot_distance, read.min_separation) == (
        situation.slot_distance,
        situation.min_separation,
    )
    for ours, theirs in (
        (situation.pursuer, read.pursuer),
        (situation.leader, read.leader),
        *zip(situation.leader.intent, read.leader.intent, strict=True),
    ):
        assert type(theirs) is type(ours)
        for name in ("x", "y", "heading", "tas", "max_bank", "duration", "turn", "bank"):
            assert getattr(theirs, name, None) == pytest.approx(
                getattr(ours, name, None), abs=1e-12
            )
    assert (read.wind.east, read.wind.north) == pytest.approx(
        (situation.wind.east, situation.wind.north), abs=1e-9
    )


def test_a_plan_is_the_librarys_own(client: Client) -> None:
    ours = plan(SITUATION)
    for asked in (SITUATION, BODY):
        theirs = client.plan(asked, max_ms=10_000, include=["alternatives"])
        assert isinstance(theirs, PlanCard)
        assert theirs.word == ours.word
        assert theirs.time_to_converge == pytest.approx(ours.time_to_converge, abs=1e-6)
        assert theirs.segments[0].start.heading == pytest.approx(radians(90.0))
        assert theirs.alternatives
    far = {**BODY, "leader": {**BODY["leader"], "tas_mps": 300.0}}
    assert isinstance(client.plan(far, max_ms=10_000), NoPlanCard)


def test_others_are_asked_about_and_answered(client: Client) -> None:
    asked, _ = situation_from_json(AMID)
    card = client.plan(asked, max_ms=10_000)
    assert isinstance(card, PlanCard)
    assert {other.ident for other in card.separation.others} == {"BAW12", "AFR7", "CB1", "CB2"}
    answers = list(client.plan_batch([asked, SITUATION]))
    assert [len(one.separation.others) for one in answers if isinstance(one, PlanCard)] == [4, 0]


PLACED = {
    **BODY,
    "pursuer": {**AIRCRAFT["pursuer"], "lat_deg": 50.3, "lon_deg": 8.0},
    "leader": {**AIRCRAFT["leader"], "lat_deg": 50.0, "lon_deg": 8.0},
}


def test_latitudes_are_kept(client: Client) -> None:
    card = client.plan(PLACED, max_ms=10_000)
    assert isinstance(card, PlanCard)
    start = card.segments[0].start
    assert isinstance(start, PathPoint)
    assert isinstance(start, Placed)
    assert (start.lat_deg, start.lon_deg) == pytest.approx((50.3, 8.0))
    assert isinstance(card.segments[-1].end, Placed)
    plain = client.plan(BODY, max_ms=10_000)
    assert isinstance(plain, PlanCard)
    assert not isinstance(plain.segments[0].start, Placed)


def test_a_plan_is_drawn(client: Client) -> None:
    drawn = client.plan_geojson(PLACED, max_ms=10_000, include=["paths"])
    assert drawn["status"] == "planned"
    assert {"path", "leader", "slot"} < {feature["id"] for feature in drawn["features"]}
    with pytest.raises(Refused, match="lat_deg"):
        client.plan_geojson(SITUATION)


def test_flights_are_flown_at_once(client: Client) -> None:
    by_name, by_situation = client.simulate(["fig_6b", SITUATION])
    assert (by_name.scenario, by_situation.scenario) == ("fig_6b", "")
    assert by_name.joined


def test_what_a_newer_service_adds_is_passed_over(client: Client) -> None:
    plan_read = calls.plan(BODY, max_ms=None, include=(), planner=None).read
    sent = plan_to_wire(plan_card(plan(SITUATION)), UNANCHORED)
    assert plan_read(orjson.dumps(sent)) == plan_read(orjson.dumps(with_news(sent)))
    flight = client.fly("ideal", rate=60.0)
    status = orjson.dumps(with_news(flight.status().model_dump()))
    assert calls.status("").read(status).id == flight.id
    started, *_ = flight.documents()
    tick = {"ended": False, "documents": [with_news(to_wire(started)), {"kind": "weather_changed"}]}
    assert calls.documents_of(orjson.dumps(tick)) == ([started], False)
    flight.end()


def with_news(said: Any) -> Any:
    """An object with a member in it that nobody knows, and so in each object of it."""
    match said:
        case dict():
            return {name: with_news(part) for name, part in said.items()} | {"news": [1]}
        case list():
            return [with_news(part) for part in said]
        case _:
            return said


def test_a_stream_that_is_refused_says_why(client: Client, url: str) -> None:
    with pytest.raises(Refused, match="There is no such flight") as refused:
        next(client.watch("none"))
    assert refused.value.status == 4404

    async def ask() -> None:
        async with AsyncClient(url) as waiting:
            with pytest.raises(Refused, match="There is no such flight"):
                await anext(aiter(waiting.watch("none")))

    asyncio.run(ask())


def test_a_batch_has_an_answer_a_line(client: Client) -> None:
    asked = [SITUATION, {"pursuer": {}}, BODY]
    first, wrong, last = client.plan_batch(asked, max_ms=10_000)
    assert isinstance(first, PlanCard)
    assert isinstance(wrong, Invalid)
    assert "leader" in wrong.message
    assert isinstance(last, PlanCard)


def test_a_line_of_a_batch_ends_at_a_line_feed_alone(url: str, client: Client) -> None:
    odd = {**BODY, "id": "\u2028 \u2029 \x85 \v \f \x1c \r \n"}

    async def ask() -> list[type]:
        async with AsyncClient(url) as waiting:
            return [type(answer) async for answer in waiting.plan_batch([odd, odd])]

    assert [type(answer) for answer in client.plan_batch([odd, odd])] == [PlanCard] * 2
    assert asyncio.run(ask()) == [PlanCard] * 2


def test_a_line_that_is_refused_says_why_and_when_the_rest_can_be_asked_again() -> None:
    (call,) = calls.plan_batch([BODY], max_ms=None, planner=None)
    with pytest.raises(Refused, match="is stopping") as refused:
        call.read(refused_line(orjson.dumps({**BODY, "id": "a"}), "The service is stopping."))
    assert refused.value.status == 503


def test_what_is_refused_is_a_sentence(client: Client) -> None:
    with pytest.raises(Refused, match="slot_distance_m") as refused:
        client.plan({**BODY, "slot_distance_m": -1.0})
    assert refused.value.status == 422
    with pytest.raises(Refused, match="There is no flight"):
        client.ask(calls.status("none"))


def test_an_area_is_drawn(client: Client) -> None:
    area = client.area({**BODY, "leader": {**BODY["leader"], "intent": []}}, columns=9, rows=9)
    assert (area.grid.columns, area.grid.rows) == (9, 9)


def test_a_flight_is_watched_commanded_recorded_and_ended(client: Client) -> None:
    flight = client.fly("ideal", rate=60.0)
    documents = []
    for document in flight.documents():
        documents.append(document)
        if isinstance(document, Sample) and document.t > 3.0:
            break
    assert isinstance(documents[0], FlightStarted)
    assert flight.command("set_rate", rate=2.0).rate == 2.0
    assert flight.status().id == flight.id
    flight.end()
    with pytest.raises(Refused):
        flight.status()
    wait_for(lambda: flight.id in [one["id"] for one in client.records(outcome="removed")])
    kept = list(client.recorded(flight.id))
    assert isinstance(kept[0], FlightStarted)
    assert len([one for one in kept if isinstance(one, Sample)]) >= 3


CREW = [{"t_s": 0, "engagement": "armed"}, {"on": "armed", "after_s": 5, "engagement": "engaged"}]
STICK = {"t_s": 2, "stick_roll": 0.5}


def test_a_flight_has_a_crew_orders_and_a_pilot() -> None:
    asked: list[FlightRequest] = []
    catalogue = ideal_catalogue()

    def find(wanted: FlightRequest) -> RequestedFlight:
        asked.append(wanted)
        return catalogue.find(wanted)

    async def ask(url: str) -> None:
        async with AsyncClient(url) as client:
            await client.fly("ideal", by_hand=True, crew=CREW, orders=[STICK])

    slow = PilotModel(bandwidth=0.5, threshold=radians(2.0))
    app = create_app(ServiceSettings(workers=0), catalogue=replace(catalogue, find=find))
    with serve(app) as address, Client(f"http://{address}") as client:
        client.fly("ideal")
        client.fly("ideal", by_hand=slow, crew=CREW, engagement="designated")
        asyncio.run(ask(f"http://{address}"))
        with pytest.raises(ValueError, match=r"lead must be 0 s"):
            client.fly("ideal", by_hand=PilotModel.perfect())
    plain, crewed, flown = asked
    assert (plain.engagement, plain.by_hand, plain.crew, plain.orders) == (
        "engaged",
        False,
        None,
        [],
    )
    assert pilot_of(crewed.by_hand, seed=7) == slow
    assert crewed.engagement == "designated"
    assert flown.by_hand is True
    assert "engagement" not in flown.model_fields_set
    for one in (crewed, flown):
        assert [crew_order(line).on for line in one.crew or ()] == ["start", "armed"]
    (line,) = flown.orders
    assert order_of(line).command == Stick(roll=0.5)


def test_the_same_without_waiting(url: str) -> None:
    async def ask() -> None:
        async with AsyncClient(url) as client:
            one, other = await asyncio.gather(
                client.plan(SITUATION, max_ms=10_000), client.plan(BODY, max_ms=10_000)
            )
            assert one.word == other.word
            assert [type(a) async for a in client.plan_batch([BODY, BODY])] == [PlanCard] * 2
            flight = await client.fly("ideal", rate=60.0)
            async for document in flight.documents():
                if isinstance(document, Sample) and document.t > 1.0:
                    break
            assert (await flight.command("pause")).paused
            await flight.end()
            newest = await anext(client.records(limit=1))
            assert newest["id"] == flight.id
            assert [d async for d in client.recorded(flight.id)]
            assert (await client.plan_geojson(PLACED, max_ms=10_000))["status"] == "planned"
            assert [one.joined for one in await client.simulate(["fig_6b"])] == [True]
            assert (await client.area(BODY, columns=5, rows=5)).grid.columns == 5

    asyncio.run(ask())


def test_a_token_is_shown() -> None:
    token = "v" * 16
    with serve(ideal_app(tokens=f"fly:{token}")) as address:
        with Client(f"http://{address}") as nobody, pytest.raises(Refused, match="needs a token"):
            nobody.plan(BODY)
        with Client(f"http://{address}/", token=token) as client:
            flight = client.fly("ideal")
            assert isinstance(next(flight.documents()), FlightStarted)
