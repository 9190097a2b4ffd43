"""Recorded flights in other forms: what the routes' tests do not show."""

import json
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from relguide_server.records.exports import as_geojson

from relguide import fly, own_scenario, plan
from relguide.contract.bodies import situation_from_json
from relguide.contract.wire import dumps
from relguide.planning.frames import LocalPlane

FIELD = Path(__file__).parents[2] / "golden" / "field"


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
    features = json.loads(as_geojson(plane, [lines]))["features"]
    assert [feature["geometry"]["type"] for feature in features] == ["MultiLineString"] * 2
    for feature in features:
        assert max(steps(feature)) < 0.1
        before, after = feature["geometry"]["coordinates"]
        assert (before[-1][0], after[0][0]) == (180.0, -180.0)
        assert len(feature["properties"]["t_s"]) == len(before) + len(after) - 2
