"""Airspaces as they come: taken as they were said; each defect has a sentence."""

from math import inf
from typing import Any

import pytest

from relguide.atc.reported import ReportedAirspace
from relguide.contract.airspace_bodies import (
    MAX_ALL_CORNERS,
    AirspaceReport,
    airspace_feature,
    airspaces_from_body,
)
from relguide.contract.moments import utc
from relguide.contract.refusal import ContractError, parse

RING = [[8.0, 50.0], [8.4, 50.0], [8.4, 50.3], [8.0, 50.3], [8.0, 50.0]]


def closed(ring: list[list[float]], **properties: Any) -> list[ReportedAirspace]:
    feature = {
        "type": "Feature",
        "properties": {"ident": "D112", **properties},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    body = {"type": "FeatureCollection", "features": [feature]}
    return airspaces_from_body(parse(AirspaceReport, body))


def test_an_airspace_is_what_was_said() -> None:
    since, until = "2026-11-23T06:00:00Z", "2026-11-23T16:00:00+02:00"
    (one,) = closed(RING, from_altitude_m=3000, since=since, until=until)
    assert (one.lon_deg, one.lat_deg) == ((8.0, 8.4, 8.4, 8.0), (50.0, 50.0, 50.3, 50.3))
    assert (one.low, one.high) == (3000.0, inf)
    assert (one.since, one.until) == (utc(since), utc(until))
    shown = airspace_feature(one, "chart")
    body = {"type": "FeatureCollection", "features": [shown]}
    assert airspaces_from_body(parse(AirspaceReport, body)) == [one]
    assert "to_altitude_m" not in shown["properties"]


@pytest.mark.parametrize(
    ("ring", "said"),
    [
        (RING[:-1], "closed"),
        ([*RING[:2], [8.4, 91.0], *RING[3:]], r"\[longitude, latitude\]"),
        ([[8.0, 50.0], [8.4, 50.0], [8.0, 50.0], [8.0, 50.0]], "three corners"),
        ([[8.0, 50.0], [8.4, 50.3], [8.4, 50.0], [8.0, 50.3], [8.0, 50.0]], "cross itself"),
        ([[-60.0, 50.0], [8.4, 50.3], [8.4, 40.0], [-60.0, 50.0]], "km round"),
    ],
)
def test_an_outline_that_is_none_is_refused(ring: list[list[float]], said: str) -> None:
    with pytest.raises(ContractError, match=said):
        closed(ring)


@pytest.mark.parametrize(
    ("properties", "said"),
    [
        ({"from_altitude_m": 3000, "to_altitude_m": 3000}, "above from_altitude_m"),
        ({"since": "2026-11-23T06:00:00Z", "until": "2026-11-23T06:00:00Z"}, "later than since"),
        ({"since": "0001-01-01T00:00:00+14:00"}, "must be a time"),
        ({"floor": 100}, "leave it out"),
    ],
)
def test_levels_and_times_are_in_order(properties: dict[str, Any], said: str) -> None:
    with pytest.raises(ContractError, match=said):
        closed(RING, **properties)


def test_an_airspace_across_180_degrees_does_not_cross_itself() -> None:
    ring = [[179.0, 0.0], [-179.0, 0.0], [-179.0, 1.0], [179.5, 0.5], [179.0, 1.0], [179.0, 0.0]]
    (one,) = closed(ring)
    assert len(one.lat_deg) == 5
    turned = [[179.0, 0.0], [-179.0, 1.0], [-179.0, 0.0], [179.0, 1.0], [179.0, 0.0]]
    with pytest.raises(ContractError, match="cross itself"):
        closed(turned)


def test_corners_are_bounded() -> None:
    ring = [[8.0 + k / 2000.0, 50.0 + k * k / 2e6] for k in range(1000)]
    features = [
        {
            "type": "Feature",
            "properties": {"ident": f"D{k}"},
            "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
        }
        for k in range(MAX_ALL_CORNERS // 1000 + 1)
    ]
    with pytest.raises(ContractError, match="20,000 corners"):
        airspaces_from_body(
            parse(AirspaceReport, {"type": "FeatureCollection", "features": features})
        )
