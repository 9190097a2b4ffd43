"""What time and flights do to clearances: they expire, begin, deviate, are asked for anew, end."""

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from relguide_server.app import create_app
from relguide_server.atc.cases import Case
from relguide_server.atc.desk import Desk
from relguide_server.atc.watching import DISCONNECTED, GONE, MOVED
from relguide_server.settings import ServiceSettings

from relguide.atc.settings import AtcSettings
from tests.server.atc.asking import CLEARANCES, LEADER, METRES_A_DEGREE, ask, request
from tests.server.serving import TestClient, ideal_app

FLIGHTS = "/api/v1/flights"


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    """A service that really flies, and whose automation answers."""
    with TestClient(create_app(ServiceSettings(workers=0))) as client:
        yield client


@pytest.fixture
def calm() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def desk_of(client: TestClient) -> Desk:
    desk: Desk = client.app.state.desk  # type: ignore[attr-defined]
    return desk


def wait_for(condition: Callable[[], object], patience: float = 20.0) -> None:
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def start(client: TestClient, **wanted: Any) -> str:
    body = {"scenario": "fig_6b", "engagement": "designated", "rate": 4.0} | wanted
    flight: str = client.post(FLIGHTS, json=body).json()["id"]
    if body["engagement"] != "off":
        wait_for(lambda: client.get(f"{FLIGHTS}/{flight}").json()["t_s"] > 0.5)
    return flight


def tell(client: TestClient, flight: str, **command: Any) -> None:
    answer = client.post(f"{FLIGHTS}/{flight}/commands", json=command)
    assert answer.status_code == 202, answer.text


def cleared(client: TestClient, flight: str) -> Case:
    """A flight that has asked and is accepted."""
    asked = client.post(CLEARANCES, json={"flight_id": flight})
    assert asked.status_code == 201, asked.text
    case = desk_of(client).find(asked.json()["id"])
    wait_for(lambda: case.state != "validating")
    assert case.state == "accepted", case.clearance.history
    return case


def flying(client: TestClient, **wanted: Any) -> tuple[str, Case]:
    """A flight that flies what it is cleared to fly."""
    flight = start(client, engagement="engaged", **wanted)
    case = cleared(client, flight)
    client.post(f"{CLEARANCES}/{case.clearance.id}/replies", json={"reply": "WILCO"})
    wait_for(lambda: case.state == "flying")
    return flight, case


def test_a_proposal_is_cleared_begun_flown_and_finished(client: TestClient) -> None:
    flight = start(client)
    case = cleared(client, flight)
    assert case.clearance.sky == flight  # it is not flown by UTC
    tell(client, flight, command="set_engagement", engagement="armed")
    answer = client.post(f"{CLEARANCES}/{case.clearance.id}/replies", json={"reply": "WILCO"})
    assert answer.json()["state"] == "wilco"
    wait_for(lambda: client.get(f"{FLIGHTS}/{flight}").json()["engagement"] == "armed")
    tell(client, flight, command="set_engagement", engagement="engaged")
    wait_for(lambda: case.state == "flying")
    tell(client, flight, command="set_rate", rate=60.0)
    wait_for(lambda: not case.lives, 60.0)
    assert case.state == "flown", case.clearance.history
    assert [step.state for step in case.clearance.history] == [
        "requested", "validating", "accepted", "wilco", "flying", "flown",
    ]  # fmt: skip
    assert case.clearance.deviations == ()


def test_what_is_not_replied_to_expires(client: TestClient) -> None:
    flight = start(client, rate=40.0)
    case = cleared(client, flight)
    wait_for(lambda: case.state == "expired")
    assert "did not reply" in case.clearance.history[-1].message


def test_a_new_plan_that_is_not_covered_is_asked_for_anew(client: TestClient) -> None:
    flight, case = flying(client)
    tell(client, flight, command="leader_heading", heading_deg=0.0)
    wait_for(lambda: case.state == "superseded")
    newer = client.get(CLEARANCES, params={"limit": "1"}).json()["clearances"][0]
    assert newer["id"] in case.clearance.history[-1].message
    assert newer["flight_id"] == flight
    client.delete(f"{FLIGHTS}/{flight}")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"command": "set_engagement", "engagement": "off"}, DISCONNECTED),
        (None, GONE),
    ],
)
def test_who_flies_no_more_is_cleared_no_more(
    client: TestClient, change: dict[str, Any] | None, said: str
) -> None:
    flight, case = flying(client)
    if change is None:
        client.delete(f"{FLIGHTS}/{flight}")
    else:
        tell(client, flight, **change)
    wait_for(lambda: not case.lives)
    assert (case.state, case.clearance.history[-1].message) == ("cancelled", said)


def test_what_is_not_acceptable_comes_with_what_would_be(client: TestClient) -> None:
    flight = start(client, scenario="crossing_stream", engagement="engaged")
    tried = client.post(f"{CLEARANCES}?dry_run=true", json={"flight_id": flight}).json()
    found = tried["validation"]
    assert found["verdict"] == "unable"
    assert found["alternatives"]
    for offered in found["alternatives"]:
        assert offered["least_m"] >= 5 * 1852.0
        assert len(offered["route"]["t_s"]) > 2
    client.delete(f"{FLIGHTS}/{flight}")


PLACED = {
    "pursuer": {
        "lat_deg": 50.3, "lon_deg": 7.6, "heading_deg": 90, "tas_mps": 235, "max_bank_deg": 25,
    },
    "leader": {"lat_deg": 50.0, "lon_deg": 8.0, "heading_deg": 90, "tas_mps": 200},
    "slot_distance_m": 12000,
    "min_separation_m": 9260,
}  # fmt: skip


def start_on_earth(client: TestClient) -> str:
    body = {"situation": PLACED, "engagement": "engaged", "rate": 1.0}
    flight: str = client.post(FLIGHTS, json=body).json()["id"]
    return flight


def test_flights_on_the_earth_share_a_sky(client: TestClient) -> None:
    flight = start_on_earth(client)
    case = cleared(client, flight)
    assert case.clearance.sky == ""
    assert abs(case.clearance.history[0].t - time.time()) < 60.0
    other = start_on_earth(client)
    second = client.post(CLEARANCES, json={"flight_id": other}).json()
    assert second["sky"] == ""
    assert second["aircraft"] != case.clearance.request.ident
    assert other[:5] in second["aircraft"]
    queued = desk_of(client).find(second["id"])
    wait_for(lambda: queued.state != "validating")
    named = {name for found in queued.clearance.history for name in found.message.split()}
    assert queued.state in ("standby", "unable"), named  # both fly at the same place
    client.delete(f"{FLIGHTS}/{other}")
    tell(client, flight, command="set_rate", rate=2.0)
    wait_for(lambda: not case.lives)
    assert case.clearance.history[-1].message == MOVED
    client.delete(f"{FLIGHTS}/{flight}")


def put(client: TestClient, *, aside: float = 0.0) -> None:
    """Say that a leader flies, and another behind it, so far beside the line [m]."""
    now = time.time()
    stamp = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(now)) + f".{int(now % 1 * 1e3):03d}Z"
    flown = (now - put.began) * 200.0 / METRES_A_DEGREE  # type: ignore[attr-defined]
    common = {"altitude_m": 9_449.0, "track_deg": 90.0, "ground_speed_mps": 200.0}
    leader = {"ident": LEADER, "lat_deg": 50.0, "lon_deg": 8.0 + flown, **common}
    own = request()["aircraft"]
    follower = {
        "ident": "RG 06", "lat_deg": 50.0 + aside / 111_200.0,
        "lon_deg": own["lon_deg"] + flown, **common,
    }  # fmt: skip
    answer = client.put("/api/v1/traffic", json={"as_of": stamp, "aircraft": [leader, follower]})
    assert answer.status_code == 200, answer.text


def test_a_reported_aircraft_that_strays_deviates_comes_back_and_is_terminated(
    calm: TestClient,
) -> None:
    """A deviation is found, said and ends; who does not come back is cleared no more."""
    desk = desk_of(calm)
    put.began = time.time()  # type: ignore[attr-defined]
    asked = ask(calm)
    put(calm)
    calm.post(f"{CLEARANCES}/{asked['id']}/replies", json={"reply": "WILCO"})
    case = desk.find(asked["id"])

    def goes(state: str, aside: float) -> Callable[[], bool]:
        def there() -> bool:
            put(calm, aside=aside)
            return case.state == state

        return there

    wait_for(goes("flying", 0.0))
    wait_for(goes("deviated", 2_500.0))
    (deviation,) = [one for one in case.clearance.deviations if one.subject == "across"]
    assert deviation.level == "alert"
    assert 2_300.0 < deviation.amount < 2_700.0
    wait_for(goes("flying", 0.0))
    assert case.clearance.deviations == ()
    desk.rules = AtcSettings(back_within=1.5)
    wait_for(goes("terminated", 2_500.0))
    assert "did not come back" in case.clearance.history[-1].message


def test_a_flight_with_a_clearance_makes_no_room_for_others(client: TestClient) -> None:
    flight = start(client)
    case = cleared(client, flight)
    found = desk_of(client).skies.flight(flight)
    assert found is not None
    before = found.last_seen
    found.last_seen = before - 300.0  # nobody asks for it
    wait_for(lambda: found.last_seen >= before)
    assert case.lives
