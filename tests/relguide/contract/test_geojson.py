"""A plan as GeoJSON: lines on the earth that are the plan's path, the leader's, and the others'."""

import itertools
from math import cos, hypot, pi, radians
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.contract.answers import answer
from relguide.contract.bodies import situation_from_json
from relguide.contract.geojson import line_geometry
from relguide.contract.refusal import ContractError
from relguide.planning.frames import LocalPlane
from relguide.planning.plan import plan
from tests.bodies import BODY

PURSUER = {"heading_deg": 90.0, "tas_mps": 240.0, "max_bank_deg": 25.0}
LEADER = {
    "heading_deg": 90.0,
    "tas_mps": 200.0,
    "intent": [
        {"straight_s": 60.0},
        {"turn_to_heading_deg": 135.0, "direction": "right", "bank_deg": 20.0},
    ],
}


def placed(lat: float, lon: float) -> dict[str, Any]:
    return {
        "pursuer": {"lat_deg": lat + 0.4, "lon_deg": lon, **PURSUER},
        "leader": {"lat_deg": lat, "lon_deg": lon, **LEADER},
        "slot_distance_m": 12e3,
        "min_separation_m": 9260.0,
        "wind": {"from_deg": 270.0, "speed_mps": 15.0},
    }


def drawn(lat: float, lon: float, **asked: Any) -> tuple[dict[str, Any], Any, LocalPlane]:
    situation, anchor = situation_from_json(placed(lat, lon))
    assert isinstance(anchor, LocalPlane)
    given = answer(situation, anchor, plan, form="geojson", **asked)
    return given, plan(situation), anchor


def lines_of(feature: dict[str, Any]) -> list[list[list[float]]]:
    geometry = feature["geometry"]
    cut = geometry["type"] == "MultiLineString"
    return geometry["coordinates"] if cut else [geometry["coordinates"]]


def test_its_features_and_the_members_of_the_plan() -> None:
    given, planned, _ = drawn(50.0, 8.0)
    assert given["type"] == "FeatureCollection"
    assert [feature["id"] for feature in given["features"]] == ["path", "leader", "slot"]
    plain = answer(planned.situation, situation_from_json(placed(50.0, 8.0))[1], plan)
    assert given.keys() - plain.keys() == {"type", "features"}
    assert {**given, "compute_ms": 0.0}.items() >= {**plain, "compute_ms": 0.0}.items()
    slot = given["features"][2]
    end = plain["segments"][-1]["end"]
    assert slot["geometry"]["coordinates"] == pytest.approx([end["lon_deg"], end["lat_deg"]])
    assert slot["properties"]["t_s"] == pytest.approx(plain["time_to_converge_s"])


@given(lat=st.floats(-70.0, 70.0), lon=st.floats(-180.0, 180.0))
@settings(max_examples=25, deadline=None)
def test_points_and_chords_lie_on_the_path(lat: float, lon: float) -> None:
    given, planned, plane = drawn(lat, lon)
    for feature, flown in zip(
        given["features"], (planned.trajectory, planned.situation.leader.trajectory), strict=False
    ):
        times = feature["properties"]["t_s"]
        assert times[0] == 0.0
        assert times[-1] == pytest.approx(planned.time_to_converge, abs=1e-3)
        exact = flown.over_ground(planned.situation.wind, np.linspace(0.0, times[-1], 2000))
        for line in lines_of(feature):
            for (lon_a, lat_a), (lon_b, lat_b) in itertools.pairwise(line):
                assert abs(lon_b - lon_a) < 180.0
                x, y = plane.to_local((lat_a + lat_b) / 2.0, (lon_a + lon_b) / 2.0)
                assert np.hypot(exact.x - x, exact.y - y).min() < 250.0
        apart = [
            hypot((b[0] - a[0]) * cos(radians(a[1])), b[1] - a[1]) * 111e3
            for line in lines_of(feature)
            for a, b in itertools.pairwise(line)
        ]
        assert max(apart) < 5.2e3


def test_a_chord_strays_by_metres() -> None:
    given, planned, plane = drawn(60.0, 8.0)
    for feature, flown in zip(
        given["features"], (planned.trajectory, planned.situation.leader.trajectory), strict=False
    ):
        (line,) = lines_of(feature)
        times = np.array(feature["properties"]["t_s"])
        middle = flown.over_ground(planned.situation.wind, (times[:-1] + times[1:]) / 2.0)
        for k, ((lon_a, lat_a), (lon_b, lat_b)) in enumerate(itertools.pairwise(line)):
            x, y = plane.to_local((lat_a + lat_b) / 2.0, (lon_a + lon_b) / 2.0)
            assert hypot(x - middle.x[k], y - middle.y[k]) < 5.0


def test_lines_are_cut_where_they_pass_the_date_line() -> None:
    given, _, _ = drawn(50.0, 179.9)
    path, leader = (lines_of(feature) for feature in given["features"][:2])
    for lines in (path, leader):
        assert [len(lines)] == [2]
        assert lines[0][-1][0] == 180.0
        assert lines[1][0] == [-180.0, lines[0][-1][1]]


def test_other_paths_are_drawn_if_asked_for() -> None:
    given, _, _ = drawn(50.0, 8.0, include=["paths"])
    others = [f for f in given["features"] if f["id"].startswith("other-")]
    assert [f["properties"]["why"] for f in others] == [other["why"] for other in given["others"]]
    assert others


def test_what_lies_nowhere_on_the_earth_is_refused() -> None:
    situation, anchor = situation_from_json(BODY)
    with pytest.raises(ContractError, match="lat_deg, lon_deg in both aircraft"):
        answer(situation, anchor, plan, form="geojson")


def test_no_plan_has_no_features() -> None:
    body = placed(50.0, 8.0)
    situation, anchor = situation_from_json(
        {**body, "leader": {**body["leader"], "tas_mps": 390.0, "intent": []}}
    )
    given = answer(situation, anchor, plan, form="geojson")
    assert (given["type"], given["features"]) == ("FeatureCollection", [])
    assert given["status"] == "no_plan"


def area_of(geometry: dict[str, Any]) -> list[list[list[list[float]]]]:
    cut = geometry["type"] == "MultiPolygon"
    return geometry["coordinates"] if cut else [geometry["coordinates"]]


@pytest.mark.parametrize("lon", [8.0, 179.95, -179.95, 180.0])
def test_others_are_lines_and_areas(lon: float) -> None:
    body = placed(50.0, lon)
    east = (lon + 2.0 + 180.0) % 360.0 - 180.0
    flying = {"lat_deg": 51.0, "lon_deg": east, "heading_deg": 10.0, "tas_mps": 200.0}
    body["traffic"] = [{"ident": "BAW12", "altitude_m": 9e3, "min_separation_m": 5e3, **flying}]
    disc = {"lat_deg": 53.0, "lon_deg": lon, "radius_m": 25e3}
    corners = [(47.0, lon), (47.0, east), (48.0, lon)]
    polygon = [{"lat_deg": a, "lon_deg": b} for a, b in corners]
    body["cells"] = [
        {"ident": "CB1", "disc": disc, "velocity_mps": [10.0, 5.0], "growth_mps": 1.0},
        {"ident": "CB2", "polygon": polygon},
    ]
    situation, plane = situation_from_json(body)
    assert isinstance(plane, LocalPlane)
    features = answer(situation, plane, plan, form="geojson")["features"][3:]
    assert [feature["id"] for feature in features] == ["traffic-0", "cell-0", "cell-1"]
    traffic, around, inside = features
    assert traffic["properties"]["ident"] == "BAW12"
    assert traffic["properties"]["min_separation_m"] == 5e3
    assert traffic["properties"]["altitude_m"] == 9e3
    assert lines_of(traffic)[0][0] == pytest.approx([east, 51.0], abs=1e-6)
    assert around["properties"]["velocity_mps"] == pytest.approx([10.0, 5.0], abs=1e-5)
    assert around["properties"]["growth_mps"] == 1.0
    # round the disc, counter-clockwise; cut in two where it lies across 180°
    assert around["geometry"]["type"] == ("Polygon" if lon == 8.0 else "MultiPolygon")
    x, y = plane.to_local(53.0, lon)
    for (ring,) in area_of(around["geometry"]):
        assert ring[0] == ring[-1]
        assert max(a for a, _ in ring) - min(a for a, _ in ring) < 10.0
        for a, b in ring:
            px, py = plane.to_local(b, a)
            assert hypot(px - x, py - y) < 25e3 * 1.001
    swept = sum(_area(ring, plane) for (ring,) in area_of(around["geometry"]))
    assert swept == pytest.approx(pi * 25e3**2, rel=2e-3)
    swept = sum(_area(ring, plane) for (ring,) in area_of(inside["geometry"]))
    flat = [plane.to_local(a, b) for a, b in corners]
    (x0, y0), (x1, y1), (x2, y2) = flat
    assert swept == pytest.approx(abs((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2, rel=2e-3)


def _area(ring: list[list[float]], plane: LocalPlane) -> float:
    """Positive if it goes round counter-clockwise [m²]."""
    points = [plane.to_local(b, a) for a, b in ring]
    return sum(a * d - b * c for (a, b), (c, d) in itertools.pairwise(points)) / 2.0


def test_a_line_keeps_what_else_its_points_have_where_it_is_cut() -> None:
    places = [[179.0, 50.0, 1000.0], [-179.0, 52.0, 2000.0], [-178.0, 52.0, 2000.0]]
    assert line_geometry(places) == {
        "type": "MultiLineString",
        "coordinates": [
            [[179.0, 50.0, 1000.0], [180.0, 51.0, 1500.0]],
            [[-180.0, 51.0, 1500.0], *places[1:]],
        ],
    }
    assert line_geometry(places[1:]) == {"type": "LineString", "coordinates": places[1:]}
    assert line_geometry(places[:1]) == {"type": "Point", "coordinates": places[0]}
