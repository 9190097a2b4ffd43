"""JSON of readsb, Flightradar24 and traffic: read, and refused by the point that is wrong."""

import json
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

import pytest

from relguide.flying.recordings.files import load_track
from relguide.units import FT, KT

POINT = [0, 48.0, 2.0, 31000, 400, 70.0, 0, 0, {"flight": "KLM12  "}]
PLACE = {
    "timestamp": 1633608000, "latitude": 48.0, "longitude": 2.0, "altitude": {"feet": 31000},
    "speed": {"kts": 400}, "heading": 70,
}  # fmt: skip


def straight(seconds: int) -> list[tuple[int, float, float]]:
    """Time, latitude and longitude, at 400 kt to the north."""
    return [(t, 48.0 + t * 400.0 / 3600.0 / 60.0, 2.0) for t in range(seconds)]


def trace(points: list[Any]) -> dict[str, Any]:
    return {"icao": "ABC123", "t": "A320", "timestamp": 1633608000.5, "trace": points}


def playback(points: list[Any]) -> dict[str, Any]:
    flight = {
        "identification": {"callsign": "KLM12"},
        "aircraft": {"model": {"code": "A320"}, "identification": {"modes": "ABC123"}},
        "track": points,
    }
    return {"result": {"response": {"data": {"flight": flight}}}}


def records(count: int) -> list[dict[str, Any]]:
    return [
        {
            "timestamp": (1633608000 + t) * 1000, "icao24": "abc123", "callsign": "KLM12",
            "latitude": lat, "longitude": lon, "altitude": 31000.0, "groundspeed": 400.0,
            "track": 0.0, "typecode": "A320",
        }
        for t, lat, lon in straight(count)
    ]  # fmt: skip


FORMS = {
    "trace_full_abc123.json": trace(
        [[t, lat, lon, 31000, 400, 0.0, *POINT[6:]] for t, lat, lon in straight(100)]
    ),
    "fr24.json": playback(
        [
            PLACE | {"timestamp": 1633608000 + t, "latitude": lat, "longitude": lon, "heading": 0}
            for t, lat, lon in straight(100)
        ]
    ),
    "records.json": records(100),
    "columns.json": {
        name: {str(n): row[name] for n, row in enumerate(records(100))} for name in records(1)[0]
    },
}


@pytest.mark.parametrize("form", FORMS)
def test_the_same_flight_is_read_of_each(tmp_path: Path, form: str) -> None:
    (tmp_path / form).write_text("\ufeff" + json.dumps(FORMS[form]))
    track = load_track(tmp_path / form)
    assert (track.ident, track.aircraft_type, track.duration) == ("KLM12", "A320", 99.0)
    assert track.ground_speed / KT == pytest.approx(400.0, abs=2.0)
    assert track.altitude == pytest.approx(31000.0 * FT)
    assert load_track(tmp_path / form, "abc123").ident == "KLM12"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (trace([POINT, [1, 2]]), r"trace\[1\]: a point is \[seconds, latitude,"),
        (trace([POINT, ["a", *POINT[1:]]]), r"trace\[1\]: a point is"),
        (trace("a"), "is no trace: it needs a timestamp and a list of points"),  # type: ignore[arg-type]
        (playback([PLACE, {}]), r"track\[1\]: a point has timestamp, latitude,"),
        ([*records(1), {"timestamp": "noon"}], "is no table of reports as traffic writes them"),
        ([{"timestamp": 1}], r"has no latitude\. Found: timestamp\."),
        ([{**records(1)[0], "timestamp": None}], "has reports without a time"),
        ({"kind": "else"}, r"holds no recorded flight\. Read are tables"),
        (trace([]), "has no reports"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, content: Any, sentence: str) -> None:
    (tmp_path / "a.json").write_text(json.dumps(content))
    with pytest.raises(ValueError, match=sentence):
        load_track(tmp_path / "a.json")


@pytest.mark.slow
def test_what_people_really_have_is_read() -> None:
    """In the samples of traffic: traces, playbacks, and recordings with errors."""
    samples = Path(str(distribution("traffic").locate_file("traffic/data/samples")))
    track = load_track(samples / "fr24" / "3376ab31.json")
    assert (track.ident, track.aircraft_type) == ("JAL516", "A359")
    assert track.duration > 1000.0
    assert "silences of more than 30 s" in track.taken
    track = load_track(samples / "readsb" / "trace_full_ac671b.json", "DAL1812")
    assert (track.ident, track.aircraft_type) == ("DAL1812", "B739")
    assert load_track(samples / "noisy" / "noisy_ground.json.gz").duration > 500.0
    assert load_track(samples / "noisy" / "noisy_spoofing.json.gz").duration > 2000.0
    assert load_track(samples / "calibration" / "nice.json.gz").duration > 3600.0
