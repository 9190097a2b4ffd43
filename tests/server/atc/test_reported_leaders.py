"""A live flight behind a leader that others report: it begins, flies and is lost as that one is."""

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from relguide_server.app import create_app
from relguide_server.atc.reported_leaders import ReportedLeaders
from relguide_server.atc.reports import Reports
from relguide_server.records.clock import date
from relguide_server.settings import ServiceSettings

from tests.server.atc.asking import METRES_A_DEGREE
from tests.server.serving import TestClient

FLIGHTS, TRAFFIC = "/api/v1/flights", "/api/v1/traffic"
LAT, LON = 50.0, 8.0
SPEED = 200.0


@pytest.fixture
def client() -> Iterator[TestClient]:
    """A service that really flies."""
    with TestClient(create_app(ServiceSettings(workers=0))) as client:
        yield client


def report(client: TestClient, since: float) -> None:
    """BAW12 flies east along a parallel, so fast that places are easily told."""
    now = time.time()
    seen = {
        "ident": "BAW12", "lat_deg": LAT, "lon_deg": LON + SPEED * (now - since) / METRES_A_DEGREE,
        "altitude_m": 9_449.0, "track_deg": 90.0, "ground_speed_mps": SPEED,
    }  # fmt: skip
    answer = client.put(TRAFFIC, json={"as_of": date(now), "aircraft": [seen]})
    assert answer.status_code == 200, answer.text


def wanted(**more: Any) -> dict[str, Any]:
    pursuer = {
        "lat_deg": LAT + 0.1, "lon_deg": LON - 0.3, "heading_deg": 90.0, "tas_mps": 230.0,
        "max_bank_deg": 25.0, "altitude_m": 9_449.0,
    }  # fmt: skip
    leader = {"lat_deg": LAT, "lon_deg": LON, "heading_deg": 0.0, "tas_mps": 150.0}
    situation = {
        "pursuer": pursuer, "leader": leader, "slot_distance_m": 9_260.0,
        "min_separation_m": 5_556.0,
    }  # fmt: skip
    return {"situation": situation, "reported_leader": "BAW12", **more}


def wait_for(condition: Callable[[], object], patience: float = 15.0) -> None:
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_it_is_where_it_is_reported(client: TestClient) -> None:
    since = time.time()
    report(client, since)
    started = client.post(FLIGHTS, json=wanted())
    assert started.status_code == 201, started.text
    flight = client.app.state.fleet.find(started.json()["id"])  # type: ignore[attr-defined]
    assert [one.ident for one in flight.history.started[0].aircraft] == ["PURSUER", "BAW12"]
    skies = client.app.state.desk.skies  # type: ignore[attr-defined]

    def off() -> float:
        """How far it is from where it is reported, along the parallel [m]."""
        report(client, since)
        (sample,) = flight.history.newest
        lat, lon = flight.label.plane.to_geodetic(sample.aircraft[1].x, sample.aircraft[1].y)
        assert lat == pytest.approx(LAT, abs=1e-4)
        true = SPEED * (skies.begun(flight) + sample.t - since)
        return abs((lon - LON) * METRES_A_DEGREE - true)

    def right_again() -> bool:
        now = flight.t
        wait_for(lambda: flight.t > now + 2.5, patience=60.0)
        return off() < 60.0

    # a flight that is held up runs so late from then on, by any part of a second
    wait_for(right_again, patience=60.0)
    for _ in range(3):
        flight.pace.pause()
        time.sleep(0.3)
        flight.pace.play()
        wait_for(right_again, patience=60.0)
    for order in ({"command": "pause"}, {"command": "set_rate", "rate": 5.0}):
        answer = client.post(f"{FLIGHTS}/{started.json()['id']}/commands", json=order)
        assert (answer.status_code, "by the clock on the wall" in answer.text) == (409, True)


def test_silence_is_told_once_and_so_is_its_end(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide_server.atc.reported_leaders.SILENT", 1.5)
    since = time.time()
    report(client, since)
    flight_id = client.post(FLIGHTS, json=wanted(engagement="off")).json()["id"]
    flight = client.app.state.fleet.find(flight_id)  # type: ignore[attr-defined]

    def age() -> float:
        return float(flight.history.newest[0].guidance[0].leader_age)

    wait_for(lambda: age() > 1.0)

    def heard() -> bool:
        report(client, since)
        return age() == 0.0

    wait_for(heard)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"reported_leader": "AFR1"}, "AFR1 is not in the picture of air traffic"),
        ({"rate": 2.0}, "at rate 1, and never paused"),
        ({"paused": True}, "at rate 1, and never paused"),
    ],
)
def test_what_cannot_be_flown_so_is_refused(
    client: TestClient, change: dict[str, Any], said: str
) -> None:
    report(client, time.time())
    answer = client.post(FLIGHTS, json=wanted(**change))
    assert (answer.status_code, said in answer.text) == (422, True)


def test_a_situation_on_no_earth_is_refused(client: TestClient) -> None:
    report(client, time.time())
    body = wanted()
    for one in ("pursuer", "leader"):
        body["situation"][one] |= {"x_m": 0.0, "y_m": 0.0 if one == "leader" else 40e3}
        del body["situation"][one]["lat_deg"], body["situation"][one]["lon_deg"]
    answer = client.post(FLIGHTS, json=body)
    assert (answer.status_code, "place both by lat_deg, lon_deg" in answer.text) == (422, True)


def test_nothing_is_heard_of_who_is_not_reported(client: TestClient) -> None:
    state = client.app.state  # type: ignore[attr-defined]
    leaders = ReportedLeaders(state.fleet, Reports(), state.desk.skies)
    assert leaders.place("BAW12") is None
