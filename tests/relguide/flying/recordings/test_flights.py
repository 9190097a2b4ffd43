"""Which flight of a recording is flown: one address is one aircraft, a silence ends a flight."""

from pathlib import Path

import pytest

from relguide.flying.recordings.files import load_track
from tests.written_flights import Row, rows, write_csv


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "track.csv"


def test_of_several_flights_one_must_be_chosen(file: Path) -> None:
    other = [{**r, "callsign": "OTHER"} for r in rows(100)]
    write_csv(file, rows(200) + other)
    with pytest.raises(ValueError, match=r"choose one\. It has 2, for example OTHER, TEST12\."):
        load_track(file)
    with pytest.raises(ValueError, match="has no flight 'NONE'"):
        load_track(file, "NONE")
    assert load_track(file, "OTHER").duration == 99.0


def later(some: list[Row], hours: int, **changed: str) -> list[Row]:
    """The same rows, hours later."""
    moved = []
    for one in some:
        time = str(one["timestamp"]).replace(" 12:", f" {12 + hours}:")
        moved.append({**one, "timestamp": time, **changed})
    return moved


def test_two_addresses_under_one_callsign_are_two_flights(file: Path) -> None:
    write_csv(file, rows(100) + [{**r, "icao24": "ABCDEF"} for r in rows(200)])
    track = load_track(file)
    assert track.duration == 199.0
    assert track.taken.startswith(
        "TEST12 is 2 flights: 1 (39bd20 12:00:00 to 12:01:39), 2 (abcdef 12:00:00 to 12:03:19). "
        "Flight 2 is flown, the longest; TEST12/1 to TEST12/2 name them. Flown: "
    )
    assert load_track(file, "TEST12/1").duration == 99.0
    assert load_track(file, "39BD20").duration == 99.0
    with pytest.raises(ValueError, match=r"has 2 flights of 'TEST12', not 3: 1 \(39bd20"):
        load_track(file, "TEST12/3")


def test_a_callsign_that_comes_back_hours_later_is_two_flights(file: Path) -> None:
    write_csv(file, later(rows(300), 3) + rows(200))
    track = load_track(file)
    assert track.taken.startswith("TEST12 is 2 flights: 1 (39bd20 12:00:00 to 12:03:19), 2 (")
    assert (track.duration, load_track(file, "test12/1").duration) == (299.0, 199.0)


def test_a_missing_callsign_is_that_of_the_reports_around_it(file: Path) -> None:
    some = rows(100)
    for row in some[:20] + some[50:70]:
        row["callsign"] = ""
    track = load_track(write_csv(file, some))
    assert (track.ident, track.duration) == ("TEST12", 99.0)


def test_without_callsigns_the_address_is_the_name(file: Path) -> None:
    some = [{**r, "callsign": ""} for r in rows(100)]
    write_csv(file, some + [{**r, "icao24": "abcdef"} for r in some])
    with pytest.raises(ValueError, match=r"It has 2, for example 39bd20, abcdef\."):
        load_track(file)
    assert load_track(file, "abcdef").ident == "abcdef"
