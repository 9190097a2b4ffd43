"""The picture by REST: put, read, taken back; by whom; and how fast thousands are taken."""

from collections.abc import Iterator
from time import time
from typing import Any

import pytest
from relguide_server.atc.reports import MOST_SOURCES, Reports
from relguide_server.atc.traffic_routes import AIRSPACE_EXAMPLE, TRAFFIC_EXAMPLE

from relguide.contract.moments import moment
from relguide.contract.traffic_bodies import MAX_AIRCRAFT
from relguide.planning.frames import LocalPlane
from tests.server.http.test_access import SETTING, TOKENS
from tests.server.serving import TestClient, ideal_app
from tests.server.test_api import is_problem

TRAFFIC, AIRSPACES = "/api/v1/traffic", "/api/v1/airspaces"


@pytest.fixture
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def report(*idents: str, age: float = 1.0, **more: Any) -> dict[str, Any]:
    (example,) = TRAFFIC_EXAMPLE["aircraft"]
    aircraft = [{**example, "ident": ident, **more} for ident in idents]
    return {"as_of": moment(time() - age), "aircraft": aircraft}


def test_the_picture_is_put_read_and_taken_back(client: TestClient) -> None:
    put = client.put(TRAFFIC, json=report("BAW12", "AFR3"))
    assert put.status_code == 200
    assert put.json() == {
        "source": "traffic", "aircraft": 2, "too_old": [], "known_later": []
    }  # fmt: skip
    seen = client.get(TRAFFIC).json()["aircraft"]
    assert [one["ident"] for one in seen] == ["AFR3", "BAW12"]
    assert seen[0]["source"] == "traffic"
    assert 1.0 <= seen[0]["age_s"] < 3.0
    reports: Reports = client.app.state.reports  # type: ignore[attr-defined]
    (_, on_plane) = reports.aircraft(LocalPlane(50.0, 8.0), time())
    assert on_plane.path is not None
    # what a source says takes the place of what it said
    client.put(TRAFFIC, json=report("AFR3"))
    assert [one["ident"] for one in client.get(TRAFFIC).json()["aircraft"]] == ["AFR3"]
    assert client.delete(TRAFFIC).status_code == 204
    assert client.get(TRAFFIC).json()["aircraft"] == []
    is_problem(client.delete(TRAFFIC), 404, TRAFFIC)


def test_of_two_sources_the_newest_counts_and_both_are_told(client: TestClient) -> None:
    client.put(f"{TRAFFIC}?source=one", json=report("BAW12", age=1.0))
    put = client.put(f"{TRAFFIC}?source=two", json=report("BAW12", age=9.0))
    assert put.json()["known_later"] == ["BAW12"]
    (seen,) = client.get(TRAFFIC).json()["aircraft"]
    assert (seen["source"], seen["also_from"]) == ("one", ["two"])
    assert client.delete(f"{TRAFFIC}?source=one").status_code == 204
    (seen,) = client.get(TRAFFIC).json()["aircraft"]
    assert (seen["source"], seen["also_from"]) == ("two", [])


def test_one_that_is_too_old_is_said_so(client: TestClient) -> None:
    body = report("BAW12", "AFR3")
    body["aircraft"][0]["as_of"] = moment(time() - 100.0)
    assert client.put(TRAFFIC, json=body).json() == {
        "source": "traffic", "aircraft": 1, "too_old": ["BAW12"], "known_later": []
    }  # fmt: skip
    assert [one["ident"] for one in client.get(TRAFFIC).json()["aircraft"]] == ["AFR3"]


def test_a_refusal_says_where_and_changes_nothing(client: TestClient) -> None:
    client.put(TRAFFIC, json=report("BAW12"))
    wrong = client.put(TRAFFIC, json=report("AFR3", track_deg="east"))
    is_problem(wrong, 422, TRAFFIC)
    assert wrong.json()["errors"][0]["path"] == "aircraft[0].track_deg"
    is_problem(client.put(TRAFFIC, content=b"[", headers={"Content-Type": "application/json"}),
               400, TRAFFIC)  # fmt: skip
    is_problem(client.put(f"{TRAFFIC}?source=", json=report("AFR3")), 422, TRAFFIC)
    assert [one["ident"] for one in client.get(TRAFFIC).json()["aircraft"]] == ["BAW12"]


def test_airspaces_are_geojson_both_ways(client: TestClient) -> None:
    put = client.put(
        AIRSPACES, json=AIRSPACE_EXAMPLE, headers={"Content-Type": "application/geo+json"}
    )
    assert put.status_code == 200
    shown = client.get(AIRSPACES)
    assert shown.headers["content-type"] == "application/geo+json"
    assert shown.json() == put.json()
    # what is shown can be put again
    assert client.put(AIRSPACES, json=shown.json()).json() == shown.json()
    reports: Reports = client.app.state.reports  # type: ignore[attr-defined]
    (airspace,) = reports.airspaces(LocalPlane(50.0, 8.0))
    assert (airspace.ident, airspace.low) == ("D112", 6096.0)
    assert client.delete(AIRSPACES).status_code == 204
    assert client.get(AIRSPACES).json()["features"] == []
    is_problem(client.delete(AIRSPACES), 404, AIRSPACES)
    # traffic and airspaces of one source are two things
    client.put(TRAFFIC, json=report("BAW12"))
    is_problem(client.delete(AIRSPACES), 404, AIRSPACES)


def test_sources_are_bounded(client: TestClient) -> None:
    for k in range(MOST_SOURCES):
        assert client.put(f"{TRAFFIC}?source=s{k}", json=report(f"A{k}")).status_code == 200
    full = client.put(f"{TRAFFIC}?source=more", json=report("B"))
    is_problem(full, 429, TRAFFIC)
    assert full.headers["retry-after"] == "60"


def test_who_may_fly_may_not_paint_the_sky() -> None:
    with TestClient(ideal_app(tokens=SETTING)) as client:
        for who, status in (("view", 403), ("fly", 403), ("atc", 200), ("control", 200)):
            headers = {"Authorization": f"Bearer {TOKENS[who]}"}
            assert client.put(TRAFFIC, json=report("A"), headers=headers).status_code == status
            assert client.get(TRAFFIC, headers=headers).status_code == 200


@pytest.mark.slow
def test_thousands_are_taken_and_shown(client: TestClient) -> None:
    body = report(*(f"A{k}" for k in range(MAX_AIRCRAFT)))
    assert client.put(TRAFFIC, json=body).json()["aircraft"] == MAX_AIRCRAFT
    assert len(client.get(TRAFFIC).json()["aircraft"]) == MAX_AIRCRAFT
    body["aircraft"].append(body["aircraft"][0])
    is_problem(client.put(TRAFFIC, json=body), 422, TRAFFIC)
