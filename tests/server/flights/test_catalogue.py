"""What can be flown for real: the library's scenarios and situations of one's own."""

import time
from itertools import islice
from pathlib import Path

import httpx2
import pytest
from relguide_server.app import create_app
from relguide_server.flights.catalogue import FAN_PAUSE, library_catalogue, not_too_often
from relguide_server.flights.routes import NewFlight
from relguide_server.planning.plans import EXAMPLE
from relguide_server.records.service import records_service
from relguide_server.settings import ServiceSettings

from relguide.contract.messages import MAX_STICKS, SituationFlightRequest
from relguide.contract.protocol import PROTOCOL
from relguide.contract.refusal import parse
from relguide.flying.documents import CommandGiven, FlightStarted, LeaderChanged, Sample
from relguide.flying.orders import no_commands
from relguide.planning.intent import TurnTo
from relguide.planning.plan import plan
from relguide.planning.trajectory import RIGHT
from tests.server.serving import TestClient

JSON = {"Content-Type": "application/json"}
TURN = {"direction": "right", "bank_deg": 20.0}


@pytest.mark.parametrize("asked", [{"scenario": "fig_6b"}, {"situation": EXAMPLE}])
def test_a_flight_names_who_plans_it(asked: dict[str, object]) -> None:
    wanted = parse(NewFlight, asked).root
    departure = library_catalogue(plan, "exact").find(wanted)
    started = next(iter(departure.source(no_commands)))
    assert isinstance(started, FlightStarted)
    assert started.planner == "exact"
    assert departure.scenario == asked.get("scenario", "")


@pytest.mark.slow
def test_a_real_flight_obeys_its_commands() -> None:
    with TestClient(create_app(ServiceSettings())) as client:
        started = client.post("/api/v1/flights", json={"scenario": "fig_6b", "rate": 60.0})
        assert started.status_code == 201, started.text
        where = started.headers["location"]
        with client.websocket_connect(
            started.json()["stream_url"], subprotocols=[PROTOCOL]
        ) as socket:
            first = socket.receive_json()
            assert first["documents"][0]["kind"] == "flight_started"
            command = {"command": "leader_heading", "heading_deg": 20.0, "direction": "left"}
            assert client.post(f"{where}/commands", json=command).status_code == 202
            kinds: list[str] = []
            until = time.monotonic() + 10.0
            while "plan_changed" not in kinds and time.monotonic() < until:
                kinds += [document["kind"] for document in socket.receive_json()["documents"]]
            assert "leader_changed" in kinds
            assert "plan_changed" in kinds[kinds.index("leader_changed") :]


@pytest.mark.slow
def test_a_situation_of_ones_own_flies() -> None:
    with TestClient(create_app(ServiceSettings())) as client:
        body = {"situation": EXAMPLE, "rate": 60.0, "intent_known": False}
        started = client.post("/api/v1/flights", json=body)
        assert started.status_code == 201, started.text
        assert started.json()["scenario"] == ""
        wrong = {"situation": {**EXAMPLE, "slot_distance_m": 1.0}}
        refused = client.post("/api/v1/flights", json=wrong)
        assert refused.status_code == 422
        assert refused.json()["errors"][0]["path"] == "situation.slot_distance_m"


def test_a_crew_is_asked_for_with_the_flight_and_begins_as_it_says() -> None:
    crew = [{"t_s": 1, "engagement": "designated"}]
    begins = {"t_s": 0, "engagement": "engaged"}
    orders = [{"t_s": 2, "autopilot": False}]
    for asked, engagement, given in (
        ({}, "engaged", []),
        ({"orders": orders}, "engaged", [2.0]),
        ({"crew": crew, "orders": orders}, "off", [1.0, 2.0]),
        ({"engagement": "off"}, "off", []),
        ({"crew": [begins]}, "engaged", []),
        ({"crew": crew, "engagement": "armed"}, "armed", [1.0]),
    ):
        wanted = parse(NewFlight, {"scenario": "fig_6b", **asked}).root
        departure = library_catalogue(plan, "exact").find(wanted)
        flown = list(islice(departure.source(no_commands), 100))
        first = next(document for document in flown if isinstance(document, Sample))
        assert first.guidance[0].engagement == engagement
        assert [one.t for one in flown if isinstance(one, CommandGiven)] == given


def sticks(count: int) -> list[dict[str, float]]:
    """A stick moved at each step."""
    return [{"t_s": k / 20, "stick_roll": (-1) ** k * 0.123456789} for k in range(count)]


@pytest.mark.slow
def test_an_hour_of_flying_by_hand_is_asked_for_in_one_body(tmp_path: Path) -> None:
    level = {"t_s": 1800.0, "leader_level_m": 8000.0}
    hour: list[dict[str, float]] = [*sticks(MAX_STICKS), level]
    records = records_service(
        records="on", database_url="", data=str(tmp_path), record_plans=0, keep_days=1.0,
        keep_mb=10.0,
    )  # fmt: skip
    with TestClient(create_app(ServiceSettings(workers=0), records=records)) as client:

        def ask(orders: list[dict[str, float]], key: str = "") -> httpx2.Response:
            body = {"scenario": "fig_6b", "orders": orders}
            headers = {"Idempotency-Key": key} if key else {}
            return client.post("/api/v1/flights", json=body, headers=headers)

        started = ask(hour, "hour")
        assert started.status_code == 201, started.text
        assert ask(hour, "hour").json() == started.json()
        kept = client.get(f"/api/v1/records/flights/{started.json()['id']}").json()["request"]
        assert kept == {"scenario": "fig_6b", "orders": [level]}
        for orders, said in (
            ([*hour[:-1], hour[-2]], "must have at most 36,000 sticks, not 36,001."),
            ([level] * 1001, "must have at most 1,000 beside sticks, not 1,001."),
            ([level] * 37_001, "must have at most 37,000 entries, not 37,001."),
        ):
            (fault,) = ask(orders).json()["errors"]
            assert fault == {"path": "orders", "message": said}
        whole = ask(sticks(1000)).json()["id"]
        kept = client.get(f"/api/v1/records/flights/{whole}").json()["request"]
        assert kept["orders"] == sticks(1000)
        long = client.post("/api/v1/flights", content=b" " * (3 * 1024 * 1024 + 1), headers=JSON)
        assert long.json()["detail"].startswith("The body of this request may have at most 3,145,")


def test_a_leader_breaks_its_word_whoever_watches() -> None:
    declared = [{"straight_s": 400.0}, {**TURN, "turn_to_heading_deg": 150.0}]
    leader = {**EXAMPLE["leader"], "intent": declared}
    flown = [{"straight_s": 20.0}, {**TURN, "turn_to_heading_deg": 40.0, "direction": "left"}]
    body = {"situation": {**EXAMPLE, "leader": leader}, "flown_intent": flown}
    departure = library_catalogue(plan).find(SituationFlightRequest.model_validate(body))
    assert departure.first is not None
    _, promised = departure.first.leader.intent
    assert isinstance(promised, TurnTo)
    assert promised.turn == RIGHT
    noticed = next(d for d in departure.source(no_commands) if isinstance(d, LeaderChanged))
    assert "does not fly what it declared" in noticed.message
    assert 20.0 < noticed.t < 60.0


@pytest.mark.parametrize(("key", "value"), [("tas_mps", 300.0), ("max_bank_deg", 45.0)])
def test_what_the_aircraft_cannot_fly_is_refused(key: str, value: float) -> None:
    with TestClient(create_app(ServiceSettings())) as client:
        body = {"situation": {**EXAMPLE, "pursuer": {**EXAMPLE["pursuer"], key: value}}}
        refused = client.post("/api/v1/flights", json=body)
        assert refused.status_code == 422
        (error,) = refused.json()["errors"]
        assert error["path"] == "situation.pursuer"
        assert "A306" in error["message"]
        assert "choose" in error["message"]


def test_scenarios_say_whether_they_can_be_flown() -> None:
    client = TestClient(create_app(ServiceSettings()))
    scenarios = client.get("/api/v1/scenarios").json()["scenarios"]
    assert {"fig_6a", "fig_6b", "recorded_leader"} <= {s["name"] for s in scenarios}
    for scenario in scenarios:
        assert scenario["available"] == (scenario["message"] == "")


def test_a_time_to_keep_behind_the_leader_can_be_asked_for() -> None:
    with TestClient(create_app(ServiceSettings())) as client:
        body = {"scenario": "fig_6b", "paused": True, "spacing_time_s": 75.0}
        started = client.post("/api/v1/flights", json=body)
        assert started.status_code == 201, started.text
        with client.websocket_connect(
            started.json()["stream_url"], subprotocols=[PROTOCOL]
        ) as socket:
            (link,) = socket.receive_json()["documents"][0]["links"]
        assert (link["spacing"], link["spacing_time_s"]) == ("time", 75.0)
        refused = client.post("/api/v1/flights", json={**body, "spacing_time_s": 0.0})
        assert refused.status_code == 422
        assert refused.json()["errors"][0]["path"] == "spacing_time_s"


def test_a_fan_is_wanted_twice_a_second_at_most_however_fast_it_flies() -> None:
    now = 100.0
    wants = not_too_often(lambda: now)
    assert wants(0.0)
    assert not wants(5.0)
    now += FAN_PAUSE / 2.0
    assert not wants(30.0)
    now += FAN_PAUSE
    assert wants(60.0)
    assert not wants(60.0)
