"""Recorded flights in other forms: what the routes' tests do not show."""

import json
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from relguide_server.records.exports import Origin, as_czml, as_geojson

from relguide import fly, own_scenario, plan, scenario
from relguide.contract.bodies import situation_from_json
from relguide.contract.wire import dumps
from relguide.planning.frames import LocalPlane

FIELD = Path(__file__).parents[2] / "golden" / "field"
ORIGIN = Origin(
    flight_id="3f2a9c0d71be", started_at="2026-11-23T23:59:30.000Z", relguide_version="0.2.0"
)


def steps(feature: dict[str, Any]) -> Iterator[float]:
    """Of longitude, from each point of a feature's lines to the next [°]."""
    lines = feature["geometry"]["coordinates"]
    for line in lines if feature["geometry"]["type"] == "MultiLineString" else [lines]:
        yield from (abs(there[0] - here[0]) for here, there in pairwise(line))


@pytest.mark.slow
def test_a_flight_over_the_antimeridian_is_cut_there() -> None:
    body = json.loads((FIELD / "13-flight-over-antimeridian.json").read_bytes())["situation"]
    situation, plane = situation_from_json(body)
    assert isinstance(plane, LocalPlane)
    scenario = replace(own_scenario(situation), duration_limit=400.0)
    lines = [dumps(document) for document in fly(scenario, plan, sample_period=10.0)]
    features = json.loads(as_geojson(ORIGIN, plane, [lines]))["features"]
    assert [feature["geometry"]["type"] for feature in features] == ["MultiLineString"] * 2
    for feature in features:
        assert max(steps(feature)) < 0.1
        before, after = feature["geometry"]["coordinates"]
        assert (before[-1][0], after[0][0]) == (180.0, -180.0)
        assert len(feature["properties"]["t_s"]) == len(before) + len(after) - 2


def test_czml_is_a_clock_and_two_aircraft_that_move() -> None:
    plane = LocalPlane(lat_deg=48.0, lon_deg=2.0)
    lines = [dumps(d) for d in fly(scenario("fig_6b"), plan, sample_period=10.0) if d.t <= 60.0]
    document, own, leader = json.loads(as_czml(ORIGIN, "Fig. 6b", plane, [lines]))
    span = "2026-11-23T23:59:30.000Z/2026-11-24T00:00:30.000Z"
    assert (document["id"], document["version"], document["name"]) == ("document", "1.0", "Fig. 6b")
    assert document["clock"]["interval"] == span
    assert document["properties"] == {
        "flight_id": "3f2a9c0d71be",
        "started_at": "2026-11-23T23:59:30.000Z",
        "relguide_version": "0.2.0",
    }
    assert [own["id"], leader["id"]] == ["PURSUER", "LEADER"]
    for aircraft in (own, leader):
        assert aircraft["availability"] == span
        places = aircraft["position"]["cartographicDegrees"]
        assert places[0::4] == [10.0 * k for k in range(7)]
        assert set(places[3::4]) == {9449.0}
    assert leader["position"]["cartographicDegrees"][1:3] == [2.0, 48.0]
