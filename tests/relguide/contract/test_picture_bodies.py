"""Traffic and airspaces as they come: taken as they were said; each defect has a sentence."""

from datetime import UTC, datetime
from math import inf, pi
from typing import Any

import pytest

from relguide.atc.reported import Reported, ReportedAirspace
from relguide.contract.picture_bodies import (
    AHEAD,
    MAX_ALL_CORNERS,
    MAX_POINTS,
    OLDEST,
    AirspaceReport,
    SeenAircraft,
    TrafficReport,
    aircraft_card,
    airspace_feature,
    airspaces_from_body,
    moment,
    reported_from_body,
    utc,
)
from relguide.contract.refusal import ContractError, parse

NOW = datetime(2026, 11, 23, 6, 30, tzinfo=UTC).timestamp()
AIRCRAFT: dict[str, Any] = {
    "ident": "BAW12", "lat_deg": 50.0, "lon_deg": 8.0, "altitude_m": 9449.0, "track_deg": 450.0,
    "ground_speed_mps": 230.0, "climb_mps": -2.0,
    "intent": [
        {"t_s": 60.0, "lat_deg": 50.1, "lon_deg": 8.0},
        {"t_s": 120.0, "lat_deg": 50.2, "lon_deg": 8.0, "altitude_m": 9000.0},
    ],
}  # fmt: skip
RING = [[8.0, 50.0], [8.4, 50.0], [8.4, 50.3], [8.0, 50.3], [8.0, 50.0]]


def taken(*aircraft: dict[str, Any], as_of: str = "2026-11-23T06:29:58Z") -> list[Reported]:
    return reported_from_body(
        parse(TrafficReport, {"as_of": as_of, "aircraft": list(aircraft)}), NOW
    )


def closed(ring: list[list[float]], **properties: Any) -> list[ReportedAirspace]:
    feature = {
        "type": "Feature",
        "properties": {"ident": "D112", **properties},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    body = {"type": "FeatureCollection", "features": [feature]}
    return airspaces_from_body(parse(AirspaceReport, body))


def test_what_is_taken_is_what_was_said() -> None:
    (one,) = taken(AIRCRAFT)
    assert (one.ident, one.t, one.altitude, one.climb) == ("BAW12", NOW - 2.0, 9449.0, -2.0)
    assert one.track == pytest.approx(pi / 2.0)
    assert [(point.t, point.altitude) for point in one.waypoints] == [
        (NOW + 58.0, None),
        (NOW + 118.0, 9000.0),
    ]
    shown = aircraft_card(one, NOW, "radar", ["other"])
    assert parse(SeenAircraft, shown).age_s == 2.0
    # and what is shown is taken again, the same
    again = {name: shown[name] for name in shown if name not in ("age_s", "source", "also_from")}
    assert taken(again) == [one]


def test_an_aircraft_may_have_a_time_of_its_own_in_any_zone() -> None:
    (one,) = taken({**AIRCRAFT, "as_of": "2026-11-23T08:29:30.250+02:00"})
    assert one.t == NOW - 29.75


@pytest.mark.parametrize(
    ("change", "path", "said"),
    [
        ({"track_deg": "east"}, "aircraft[0].track_deg", "number"),
        ({"ground_speed_mps": 601}, "aircraft[0].ground_speed_mps", "600 m/s"),
        ({"altitude_m": 31_000}, "aircraft[0].altitude_m", "20000 m"),
        ({"ident": ""}, "aircraft[0].ident", ""),
        ({"as_of": "2026-11-23"}, "aircraft[0].as_of", "2026-11-23T06:30:00Z"),
        ({"as_of": "2026-11-23T06:31:00Z"}, "aircraft[0].as_of", "60 s from now"),
        ({"altitude_m": None}, "aircraft[0].intent[1].altitude_m", "altitude_m of the aircraft"),
        ({"gs": 1}, "aircraft[0].gs", "leave it out"),
    ],
)
def test_a_defect_has_its_path(change: dict[str, Any], path: str, said: str) -> None:
    with pytest.raises(ContractError) as refused:
        taken({**AIRCRAFT, **change})
    assert refused.value.problems[0][0] == path
    assert said in refused.value.problems[0][1]


@pytest.mark.parametrize(
    ("point", "path", "said"),
    [
        ({"t_s": 60.0, "lat_deg": 50.1, "lon_deg": 8.0}, "intent[1].t_s", "later than 60 s"),
        ({"t_s": 61.0, "lat_deg": 50.3, "lon_deg": 8.0}, "intent[1]", "22,239 m/s"),
        ({"t_s": 20_000.0, "lat_deg": 50.1, "lon_deg": 8.0}, "intent[1].t_s", "14400 s"),
    ],
)
def test_an_intent_is_one_that_can_be_flown(point: dict[str, Any], path: str, said: str) -> None:
    intent = [AIRCRAFT["intent"][0], point]
    with pytest.raises(ContractError) as refused:
        taken({**AIRCRAFT, "intent": intent})
    assert refused.value.problems == ((f"aircraft[0].{path}", refused.value.problems[0][1]),)
    assert said in refused.value.problems[0][1]


@pytest.mark.parametrize(
    ("seconds", "said"), [(AHEAD + 1.0, "from now"), (-OLDEST - 1.0, "send it while it is new")]
)
def test_a_picture_is_of_now(seconds: float, said: str) -> None:
    with pytest.raises(ContractError, match=said):
        taken(AIRCRAFT, as_of=moment(NOW + seconds))
    assert taken(AIRCRAFT, as_of=moment(NOW + seconds - (1.0 if seconds > 0 else -1.0)))


def test_an_aircraft_is_reported_once_and_intents_are_bounded() -> None:
    with pytest.raises(ContractError, match=r"that of aircraft\[0\] already"):
        taken(AIRCRAFT, AIRCRAFT)
    point = {"lat_deg": 50.0, "lon_deg": 8.0}
    long = [{"t_s": float(k + 1), **point} for k in range(100)]
    many = [{**AIRCRAFT, "ident": f"A{k}", "intent": long} for k in range(MAX_POINTS // 100 + 1)]
    with pytest.raises(ContractError, match="20,000 points"):
        taken(*many)


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
