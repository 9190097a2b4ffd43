"""Air traffic as it comes: taken as it was said; each defect has a sentence."""

from datetime import UTC, datetime
from math import pi
from typing import Any

import pytest

from relguide.atc.reported import Reported
from relguide.contract.moments import moment
from relguide.contract.refusal import ContractError, parse
from relguide.contract.traffic_bodies import (
    AHEAD,
    MAX_POINTS,
    OLDEST,
    SeenAircraft,
    TrafficReport,
    aircraft_card,
    reported_from_body,
)

NOW = datetime(2026, 11, 23, 6, 30, tzinfo=UTC).timestamp()
AIRCRAFT: dict[str, Any] = {
    "ident": "BAW12", "lat_deg": 50.0, "lon_deg": 8.0, "altitude_m": 9449.0, "track_deg": 450.0,
    "ground_speed_mps": 230.0, "climb_mps": -2.0,
    "intent": [
        {"t_s": 60.0, "lat_deg": 50.1, "lon_deg": 8.0},
        {"t_s": 120.0, "lat_deg": 50.2, "lon_deg": 8.0, "altitude_m": 9000.0},
    ],
}  # fmt: skip


def taken(*aircraft: dict[str, Any], as_of: str = "2026-11-23T06:29:58Z") -> list[Reported]:
    return reported_from_body(
        parse(TrafficReport, {"as_of": as_of, "aircraft": list(aircraft)}), NOW
    )


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
