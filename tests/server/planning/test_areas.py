"""REST: convergence areas of situations and of flights; garbage in, sentences out."""

import json
from collections.abc import Iterator
from copy import deepcopy

import numpy as np
import pytest
from relguide_server.planning.areas import MOST_SEARCHED
from relguide_server.planning.plans import EXAMPLE

from relguide.contract.area_bodies import AreaAnswer
from relguide.contract.refusal import parse
from tests.server.serving import TestClient, ideal_app
from tests.server.test_api import is_problem

URL = "/api/v1/areas"
STRAIGHT = deepcopy(EXAMPLE)
del STRAIGHT["leader"]["intent"]
SMALL = {"columns": "32", "rows": "24"}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def ask(situation: dict = STRAIGHT, **parameters: object) -> dict[str, object]:
    return {"situation": json.dumps(situation), **SMALL, **parameters}


def test_an_area_of_a_situation(client: TestClient) -> None:
    answer = client.get(URL, params=ask(level_s=["300", "600"], times="true"))
    assert answer.status_code == 200
    area = answer.json()
    assert parse(AreaAnswer, area).grid.columns == 32
    assert area["levels_s"] == [300.0, 600.0] == [c["level_s"] for c in area["contours"]]
    assert area["pursuer_heading_deg"] == pytest.approx(90.0)
    assert sum(area["count"].values()) == 32 * 24
    assert area["compute_ms"] > 0.0
    assert {"LSL", "RSR", "LSR", "RSL"} <= {region["word"] for region in area["regions"]}
    for contour in area["contours"]:
        for x, y in (point for line in contour["lines"] for point in line):
            assert abs(x) <= 80_000.0
            assert abs(y) <= 60_000.0


def test_times_are_those_of_plans(client: TestClient) -> None:
    area = client.get(URL, params=ask(times="true", columns="5", rows="4")).json()
    x = np.linspace(-80e3, 80e3, 5)
    y = np.linspace(-60e3, 60e3, 4)
    for row, north in enumerate(y.tolist()):
        for column, east in enumerate(x.tolist()):
            body = deepcopy(STRAIGHT)
            body["pursuer"] |= {"x_m": east, "y_m": north}
            planned = client.post("/api/v1/plans?max_ms=10000", json=body).json()
            time, bound = area["times_s"][row][column], area["lower_bounds_s"][row][column]
            if planned["status"] == "no_plan":
                assert time is None
            else:
                assert bound - 0.01 <= planned["time_to_converge_s"] <= time + 0.01


def test_left_out_it_is_round_the_leader_and_levels_are_round(client: TestClient) -> None:
    area = client.get(URL, params={"situation": json.dumps(STRAIGHT)}).json()
    assert area["grid"] == {
        "x_m": 0.0, "y_m": 0.0, "width_m": 160_000.0, "height_m": 120_000.0,
        "columns": 160, "rows": 120,
    }  # fmt: skip
    assert len(area["levels_s"]) >= 5
    assert "times_s" not in area


def test_with_latitudes_points_have_them(client: TestClient) -> None:
    body = deepcopy(STRAIGHT)
    for aircraft, lat, lon in (("pursuer", 48.0, 11.0), ("leader", 48.3, 11.5)):
        del body[aircraft]["x_m"], body[aircraft]["y_m"]
        body[aircraft] |= {"lat_deg": lat, "lon_deg": lon}
    area = client.get(URL, params=ask(body, level_s="600")).json()
    ((line, *_),) = (contour["lines"] for contour in area["contours"])
    for x, y, lat, lon in line:
        assert lat == pytest.approx(48.3 + y / 111_200.0, abs=0.02)
        assert lon == pytest.approx(11.5 + x / 74_000.0, abs=0.05)


def test_an_area_of_a_flight_is_that_of_now(client: TestClient) -> None:
    flight = client.post("/api/v1/flights", json={"scenario": "ideal", "paused": True}).json()
    area = client.get(URL, params={"flight": flight["id"], **SMALL})
    assert area.status_code == 200
    assert area.json()["pursuer_heading_deg"] == pytest.approx(90.0)
    assert any("final leg" in note for note in area.json()["notes"])
    assert client.delete(f"/api/v1/flights/{flight['id']}").status_code == 204
    gone = client.get(URL, params={"flight": flight["id"]})
    is_problem(gone, 404, URL)


def test_exactly_is_never_slower(client: TestClient) -> None:
    few = {"columns": "12", "rows": "9", "times": "true", "width_m": "60000", "height_m": "45000"}
    fast = client.get(URL, params=ask(**few)).json()
    exact = client.get(URL, params=ask(**few, exact="true")).json()
    assert fast["lower_bounds_s"] == exact["lower_bounds_s"]
    pairs = [
        (a, b)
        for one, other in zip(fast["times_s"], exact["times_s"], strict=True)
        for a, b in zip(one, other, strict=True)
        if a is not None
    ]
    assert pairs
    assert all(b <= a for a, b in pairs)
    assert any("searched at each node" in note for note in exact["notes"])


def test_by_network_times_are_the_exact_ones(client: TestClient) -> None:
    few = {"columns": "40", "rows": "30", "times": "true"}
    exact = client.get(URL, params=ask(**few)).json()
    answer = client.get(URL, params=ask(**few, planner="network"))
    assert answer.status_code == 200
    area = answer.json()
    assert area["times_s"] == exact["times_s"]
    assert area["count"]["proved"] < exact["count"]["proved"]
    assert area["count"]["no_plan"] == exact["count"]["no_plan"]
    assert "network of branches" in area["notes"][0]
    assert "proved" in exact["notes"][0]


@pytest.mark.parametrize(
    ("parameters", "sentence"),
    [
        ({}, "either flight or situation"),
        ({"flight": "x", "situation": "{}"}, "and not both"),
        ({"situation": "{"}, "situation: This is not JSON"),
        ({"situation": "[]"}, "situation"),
        (ask({**STRAIGHT, "slot_distance_m": 3.0}), "slot_distance_m: must be at least"),
        (ask({**STRAIGHT, "wings": 2}), "situation.wings: is not a field"),
        (ask(columns="1"), "columns"),
        (ask(rows="513"), "rows"),
        (ask(columns="many"), "columns"),
        (ask(width_m="nan"), "width_m"),
        (ask(height_m="1e9"), "height_m"),
        (ask(x_m="inf"), "x_m"),
        (ask(x_m="990000"), "The grid must lie within"),
        (ask(level_s=["300", "-1"]), "level_s"),
        (ask(level_s=["1"] * 65), "level_s"),
        (ask(exact="perhaps"), "exact"),
        (ask(planner="oracle"), "planner"),
        (ask(exact="true", columns="60"), f"at most {MOST_SEARCHED:,} nodes"),
        (ask(EXAMPLE, exact="true"), "leader without intent"),
        (ask(levels="3"), "It has columns, exact, flight"),
    ],
)
def test_what_is_no_area_is_refused(
    client: TestClient, parameters: dict[str, object], sentence: str
) -> None:
    document = is_problem(client.get(URL, params=parameters), 422, URL)
    assert sentence in document["detail"]


def test_an_area_is_drawn_from_a_body(client: TestClient) -> None:
    few = {"columns": 32, "rows": 24, "levels_s": [300.0, 600.0]}
    posted = client.post(URL, json={"situation": STRAIGHT, **few})
    assert posted.status_code == 200
    asked = client.get(URL, params=ask(level_s=["300", "600"])).json()
    drawn = posted.json()
    assert {**drawn, "compute_ms": 0.0} == {**asked, "compute_ms": 0.0}


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ({}, "either flight or situation"),
        ({"situation": {**STRAIGHT, "wings": 2}}, "situation.wings: is not a field"),
        ({"situation": STRAIGHT, "columns": 1}, "columns: must be at least 2"),
        ({"situation": STRAIGHT, "x_m": 990_000.0}, "The grid must lie within"),
        ({"situation": STRAIGHT, "level_s": []}, "level_s: is not a field"),
        ([], "must be an object"),
    ],
)
def test_what_is_no_body_of_an_area_is_refused(
    client: TestClient, body: object, sentence: str
) -> None:
    document = is_problem(client.post(URL, json=body), 422, URL)
    assert sentence in document["detail"]
