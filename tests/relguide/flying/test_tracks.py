"""Recorded tracks: cleaned, smooth, and refused in a sentence when they cannot be read."""

import csv
import gzip
import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.flying import tracks
from relguide.flying.tracks import DEFAULT_LEADER, RecordedTrack, load_sample, load_track
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, FT, KT

COLUMNS = (
    "timestamp",
    "icao24",
    "callsign",
    "latitude",
    "longitude",
    "altitude",
    "groundspeed",
    "track",
    "vertical_rate",
)
PLANE = LocalPlane(49.0, 2.0)
SPEED = 150.0


def truth(t: float) -> tuple[float, float, float]:
    """A truth to record: 200 s straight, a right turn of 90° at 1.5°/s, straight: x, y, track."""
    rate = 1.5 * DEG
    turned = min(max(t - 200.0, 0.0), 60.0) * rate
    radius = SPEED / rate
    x, y = radius * (1.0 - math.cos(turned)), radius * math.sin(turned)
    y += SPEED * min(t, 200.0)
    after = max(t - 260.0, 0.0) * SPEED
    return x + after * math.sin(turned), y + after * math.cos(turned), turned


Row = dict[str, Any]


def row(t: float) -> Row:
    x, y, track = truth(t)
    lat, lon = PLANE.to_geodetic(x, y)
    return {
        "timestamp": f"2021-10-07 12:{int(t) // 60:02d}:{t % 60:06.3f}+00:00",
        "icao24": "39bd20",
        "callsign": "TEST12",
        "latitude": lat,
        "longitude": lon,
        "altitude": 10000.0 + 20.0 * t,
        "groundspeed": round(SPEED / KT),
        "track": round(track / DEG, 1),
        "vertical_rate": 1200,
    }


def rows(until: int = 600) -> list[Row]:
    return [row(float(t)) for t in range(until)]


def write_csv(file: Path, content: Iterable[Row], columns: tuple[str, ...] = COLUMNS) -> Path:
    with file.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(content)
    return file


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "track.csv"


def worst(track: RecordedTrack, *, start: float = 0.0) -> float:
    """Largest distance from the truth [m]; `start` is when the track begins."""
    distance = 0.0
    for t in np.arange(0.0, track.duration, 0.7):
        state = track.state_at(float(t))
        x, y = PLANE.to_local(*track.origin.to_geodetic(state.x, state.y))
        true_x, true_y, _ = truth(start + float(t))
        distance = max(distance, math.hypot(x - true_x, y - true_y))
    return distance


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


def test_position_and_velocity_are_continuous_and_agree(file: Path) -> None:
    track = load_track(write_csv(file, rows()))
    dt = 1e-3
    for t in np.arange(190.0, 275.0, 0.31):
        before, after = track.state_at(float(t)), track.state_at(float(t) + dt)
        vx, vy = (after.x - before.x) / dt, (after.y - before.y) / dt
        assert math.hypot(vx, vy) == pytest.approx(before.ground_speed, rel=1e-3)
        assert math.remainder(math.atan2(vx, vy) - before.track, 2 * math.pi) == pytest.approx(
            0.0, abs=1e-3
        )
        assert abs(math.remainder(after.track - before.track, 2 * math.pi)) < 3.0 * DEG * dt


def test_beyond_its_ends_it_flies_straight_on(file: Path) -> None:
    track = load_track(write_csv(file, rows()))
    end, later = track.state_at(track.duration), track.state_at(track.duration + 10.0)
    assert later.track == end.track
    assert math.hypot(later.x - end.x, later.y - end.y) == pytest.approx(10.0 * end.ground_speed)
    start, earlier = track.state_at(0.0), track.state_at(-10.0)
    assert math.hypot(start.x - earlier.x, start.y - earlier.y) == pytest.approx(
        10.0 * start.ground_speed
    )


# --- dirt ---------------------------------------------------------------------------------------


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
    assert min(track.ground_speed) >= tracks.AIRBORNE


# --- files that are none ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("column", "text", "sentence"),
    [
        ("latitude", "north", r"line 4, column latitude: 'north' is not a number\."),
        ("latitude", "91", r"line 4, column latitude: must lie in -90 … 90, not 91\."),
        ("longitude", "inf", r"line 4, column longitude: must lie in -180 … 360, not inf\."),
        ("vertical_rate", "up", r"line 4, column vertical_rate: 'up' is not a number\."),
        ("groundspeed", "-1", r"line 4, column groundspeed: must lie in 0 … 10000, not -1\."),
        ("timestamp", "noon", r"line 4, column timestamp: 'noon' is neither a time"),
        ("timestamp", "", r"line 4, column timestamp: '' is neither a time"),
        ("timestamp", "inf", r"line 4, column timestamp: 'inf' is not a time\."),
    ],
)
def test_a_bad_cell_is_named(file: Path, column: str, text: str, sentence: str) -> None:
    bad = rows(100)
    bad[2][column] = text
    with pytest.raises(ValueError, match=sentence):
        load_track(write_csv(file, bad))


@pytest.mark.parametrize(
    "form", ["{}", "{}.5", "2021-10-07T12:00:00Z", "2021-10-07 14:00:00+02:00"]
)
def test_times_may_be_written_in_several_ways(file: Path, form: str) -> None:
    good = rows(100)
    if "{}" in form:
        for n, r in enumerate(good):
            r["timestamp"] = form.format(1633608000 + n)
    else:
        good[0]["timestamp"] = form
    assert load_track(write_csv(file, good)).duration == 99.0


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "line 1: column timestamp is missing."),
        (b"timestamp,latitude,longitude\n", "line 1: column altitude is missing."),
        (b"timestamp,latitude,longitude,altitude\n", "has no rows below its header."),
        (b"timestamp,latitude,longitude,altitude\n1,2\n", "line 2: it has not as many columns"),
        (b"timestamp,latitude,longitude,altitude\n1,2,3,4,5\n", "line 2: it has not as many"),
        (b"timestamp,latitude,longitude,altitude\n1,2,3,4\n", "has no stretch of 30 positions"),
        (b"timestamp,latitude,longitude,altitude\n1,,,4\n", "has no positions."),
        (b"\x7fELF\xff\xfe\x00", "is not UTF-8 text."),
    ],
)
def test_a_file_that_is_no_track_is_refused(file: Path, content: bytes, sentence: str) -> None:
    file.write_bytes(content)
    with pytest.raises(ValueError, match=str(file)) as caught:
        load_track(file)
    assert sentence in str(caught.value)


def test_no_altitudes_no_track(file: Path) -> None:
    with pytest.raises(ValueError, match="has only 0 believable altitudes"):
        load_track(write_csv(file, [{**r, "altitude": ""} for r in rows(100)]))


def test_a_parked_aircraft_is_no_leader(file: Path) -> None:
    parked = [{**r, "latitude": 49.0 + n * 1e-6} for n, r in enumerate(rows(100))]
    for r in parked:
        r["longitude"], r["groundspeed"], r["track"] = 2.0, "", ""
    with pytest.raises(ValueError, match="never flies 30 s faster"):
        load_track(write_csv(file, parked))


def test_of_several_flights_one_must_be_chosen(file: Path) -> None:
    other = [{**r, "callsign": "OTHER"} for r in rows(100)]
    write_csv(file, rows(200) + other)
    with pytest.raises(ValueError, match=r"choose one\. It has 2, for example OTHER, TEST12\."):
        load_track(file)
    with pytest.raises(ValueError, match="has no flight 'NONE'"):
        load_track(file, "NONE")
    assert load_track(file, "OTHER").duration == 99.0


@given(noise=st.text(max_size=200))
@settings(max_examples=60)
def test_noise_is_refused_in_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, noise: str
) -> None:
    file = tmp_path_factory.mktemp("noise") / "a.csv"
    header = "timestamp,latitude,longitude,altitude\n"
    file.write_bytes((header + noise).encode("utf-8", "surrogatepass"))
    with pytest.raises(ValueError, match=r"a\.csv"):
        load_track(file)


def test_a_track_checks_itself(file: Path) -> None:
    track = load_track(write_csv(file, rows(100)))
    for bad in (
        {"x": track.x[:-1]},
        {"x": np.where(track.t == 3.0, math.nan, track.x)},
        {"t": track.t + 1.0},
        {"t": track.t**2},
    ):
        with pytest.raises(ValueError, match="track"):
            replace(track, **bad)  # type: ignore[arg-type]


# --- the samples of traffic ---------------------------------------------------------------------


@pytest.mark.slow
def test_the_default_leader_is_a_good_one() -> None:
    track = load_sample(DEFAULT_LEADER)
    first = track.t <= 720.0
    assert track.duration >= 720.0
    assert np.all(track.altitude[first] > 10_000.0 * FT)
    assert np.ptp(track.track[first]) > 45.0 * DEG
    assert np.ptp(track.ground_speed[first]) < 60.0 * KT
    # as smooth as an airliner flies: 3°/s and 0.1 g
    assert np.max(np.abs(np.diff(track.track))) < 3.0 * DEG
    assert np.max(np.abs(np.diff(track.ground_speed))) < 1.0


@pytest.mark.slow
def test_a_sample_agrees_with_what_was_broadcast() -> None:
    track = load_sample("SVA127")
    raw = [r for r in tracks._sample(tracks.QUICKSTART) if r["callsign"] == "SVA127"]
    start = raw[0]["timestamp"] / 1000.0
    speeds, directions = [], []
    for r in raw:
        t = r["timestamp"] / 1000.0 - start
        if r["groundspeed"] is not None and t < track.duration:
            state = track.state_at(t)
            speeds.append(state.ground_speed / KT - r["groundspeed"])
            directions.append(math.remainder(state.track / DEG - r["track"], 360.0))
    assert len(speeds) > 1000
    assert np.sqrt(np.mean(np.square(speeds))) < 1.0
    assert np.sqrt(np.mean(np.square(directions))) < 1.0


@pytest.mark.slow
def test_an_unknown_callsign_is_answered_with_others() -> None:
    with pytest.raises(ValueError, match=r"no flight 'NONE'\. It has \d+, for example ABR471, "):
        load_sample("NONE")


def test_an_unknown_collection_gives_a_sentence() -> None:
    with pytest.raises(ValueError, match=r"traffic 2\.13 has no samples 'collections/none'"):
        load_sample("NONE", "collections/none")


def test_without_the_package_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> object:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(tracks, "distribution", missing)
    with pytest.raises(ValueError, match=r"pip install --no-deps traffic==2\.13"):
        load_sample(DEFAULT_LEADER)


@dataclass
class Package:
    """An installed package whose samples we write."""

    folder: Path
    version: str = "0"

    def locate_file(self, path: str) -> Path:
        return self.folder / path


def test_a_damaged_package_gives_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tracks, "distribution", lambda name: Package(tmp_path))
    file = tmp_path / "traffic/data/samples/a.json.gz"
    file.parent.mkdir(parents=True)
    whole = gzip.compress(orjson.dumps([{"callsign": "A"}] * 1000))
    for content in (b"", b"no gzip", whole[:-20], gzip.compress(b"{"), gzip.compress(b"{}")):
        file.write_bytes(content)
        with pytest.raises(ValueError, match="is damaged; install it again"):
            load_sample("A", "a")
