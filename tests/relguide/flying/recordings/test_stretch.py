"""What is flown of a recording is believable, in the air, and said; what is not, too."""

import math
from pathlib import Path

import pytest

from relguide.flying.recordings.files import load_track
from relguide.flying.recordings.stretch import AIRBORNE
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, FT, KT
from tests.written_flights import COLUMNS, PLANE, SPEED, row, rows, truth, worst, write_csv


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "track.csv"


def test_a_csv_is_read_as_it_was_flown(file: Path) -> None:
    track = load_track(write_csv(file, rows()))
    assert (track.ident, track.aircraft_type) == ("TEST12", "")
    assert track.duration == 599.0
    assert worst(track) < 20.0
    middle = track.state_at(230.0)
    assert middle.track / DEG == pytest.approx(45.0, abs=1.0)
    assert middle.ground_speed == pytest.approx(SPEED, rel=0.01)
    assert middle.altitude == pytest.approx((10000.0 + 20.0 * 230.0) * FT, abs=5.0)


def test_positions_alone_will_do(file: Path) -> None:
    track = load_track(write_csv(file, rows(), ("timestamp", "latitude", "longitude", "altitude")))
    assert track.ident == ""
    assert worst(track) < 60.0  # 8 s of smoothing cut the corner of a turn begun at once
    assert track.state_at(230.0).track / DEG == pytest.approx(45.0, abs=2.0)


def test_held_missing_and_wrong_values_do_no_harm(file: Path) -> None:
    dirty = rows()
    for n in range(20, 580, 10):
        dirty[n]["latitude"], dirty[n]["longitude"] = (
            dirty[n - 1]["latitude"],
            dirty[n - 1]["longitude"],
        )
        dirty[n + 1]["groundspeed"] = dirty[n + 1]["track"] = ""
        dirty[n + 2]["altitude"] = ""
        dirty[n + 3]["latitude"] = dirty[n + 3]["longitude"] = ""
    dirty[0]["latitude"] = 12.0
    dirty[300]["latitude"], dirty[300]["longitude"] = -33.0, 151.0
    dirty[350]["altitude"] = 123_100.0
    dirty[400]["groundspeed"], dirty[400]["track"] = 9000.0, 180.0
    dirty.append(dirty[50])
    track = load_track(write_csv(file, reversed(dirty)))
    assert track.duration >= 598.0
    assert worst(track, start=599.0 - track.duration) < 30.0
    top = max(track.altitude)
    assert top == pytest.approx((10000.0 + 20.0 * 599.0) * FT, abs=20.0)


def test_a_gap_of_more_than_30_s_cuts(file: Path) -> None:
    short_gap = [r for n, r in enumerate(rows()) if not 100 <= n < 129]
    assert load_track(write_csv(file, short_gap)).duration == 599.0
    long_gap = [r for n, r in enumerate(rows()) if not 100 <= n < 131]
    assert load_track(write_csv(file, long_gap)).duration == 599.0 - 131.0


def test_what_sways_faster_than_any_aircraft_is_refused(file: Path) -> None:
    swaying = rows()
    for n, r in enumerate(swaying):
        x, y, _ = truth(float(n))
        r["latitude"], r["longitude"] = PLANE.to_geodetic(x + 4000.0 * math.sin(n / 12.0), y)
    sentence = r"has only \d+ positions near a smooth path; 30 are needed\.$"
    with pytest.raises(ValueError, match=sentence):
        load_track(write_csv(file, swaying[:120]))


def test_what_is_not_airborne_is_left_out(file: Path) -> None:
    landed = rows(500)
    x, y, _ = truth(499.0)
    for n in range(200):  # brakes to taxi speed at the end
        x += 5.0
        r = row(499.0)
        r["latitude"], r["longitude"] = PLANE.to_geodetic(x, y)
        r["timestamp"] = row(500.0 + n)["timestamp"]
        r["groundspeed"] = round(5.0 / KT)
        landed.append(r)
    track = load_track(write_csv(file, landed))
    assert track.duration == pytest.approx(499.0, abs=6.0)
    assert min(track.ground_speed) >= AIRBORNE


def test_no_altitudes_no_track(file: Path) -> None:
    with pytest.raises(ValueError, match="has only 0 believable altitudes"):
        load_track(write_csv(file, [{**r, "altitude": ""} for r in rows(100)]))


def test_feet_given_as_metres_are_asked_about(file: Path) -> None:
    high = [{**r, "baroaltitude": r["altitude"] + 30_000.0} for r in rows(100)]
    columns = ("timestamp", "latitude", "longitude", "baroaltitude")
    with pytest.raises(
        ValueError, match=r"track\.csv flies at 4\d{4} m, .* call their column altitude_f"
    ):
        load_track(write_csv(file, high, columns))


def test_a_parked_aircraft_is_no_leader(file: Path) -> None:
    parked = [{**r, "latitude": 49.0 + n * 1e-6} for n, r in enumerate(rows(100))]
    for r in parked:
        r["longitude"], r["groundspeed"], r["track"] = 2.0, "", ""
    with pytest.raises(ValueError, match="never flies 30 s faster"):
        load_track(write_csv(file, parked))


def test_what_was_taken_and_left_out_is_said(file: Path) -> None:
    assert load_track(write_csv(file, rows(100))).taken == (
        "Flown: 2021-10-07 12:00:00 to 12:01:39 UTC, 99 s from FL100 to FL120; all that was heard."
    )
    some = [r for n, r in enumerate(rows()) if not 100 <= n < 150]
    for r in some[50:100]:
        r["onground"] = "True"
    some[300]["latitude"] = 12.0
    track = load_track(write_csv(file, some, (*COLUMNS, "onground")))
    assert track.taken == (
        "Flown: 2021-10-07 12:02:30 to 12:09:59 UTC, 449 s from FL130 to FL220; left out: 49 s on "
        "the ground, 50 positions before it, 1 silence of more than 30 s, 51 s in all, 1 position "
        "that cannot be right."
    )
    assert track.start == 1633608150.0


def test_only_on_the_ground_is_no_flight(file: Path) -> None:
    parked = [{**r, "altitude": "ground"} for r in rows(100)]
    with pytest.raises(ValueError, match=r"has no positions in the air\."):
        load_track(write_csv(file, parked))


@pytest.mark.parametrize("lon", [179.9, -179.95, 20.0])
def test_the_antimeridian_is_no_edge(file: Path, lon: float) -> None:
    plane = LocalPlane(52.0, lon)
    some = []
    for n in range(200):
        lat, east = plane.to_geodetic(200.0 * n, 0.0)
        true_north = plane.meridian(lat, east)
        some.append(
            {**row(float(n)), "latitude": lat, "longitude": east, "groundspeed": 200.0 / KT}
            | {"track": (90.0 - true_north / DEG) % 360.0}
        )
    track = load_track(write_csv(file, some))
    assert track.duration == 199.0
    assert abs(track.origin.to_local(52.0, lon)[0]) < 40_000.0
    assert track.ground_speed == pytest.approx(200.0, rel=1e-3)
    assert track.track == pytest.approx(track.track[0], abs=1e-3)
