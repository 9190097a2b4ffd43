"""A file whose latitude and longitude are exchanged is refused, and no other is."""

import math
from pathlib import Path

import pytest

from relguide.flying.recordings.files import load_track
from relguide.planning.frames import LocalPlane
from relguide.units import DEG

HEADER = "time,icao24,lat,lon,velocity,heading,callsign,onground,baroaltitude"
PARIS, SYDNEY, GULF = LocalPlane(48.0, 2.0), LocalPlane(-33.5, 151.0), LocalPlane(27.0, 51.0)


def written(
    file: Path,
    plane: LocalPlane,
    track_deg: float,
    *,
    exchanged: bool,
    step: int = 10,
    drift_deg: float = 0.0,
    told: bool = True,
) -> Path:
    """A straight flight as OpenSky writes state vectors, its places exchanged or not."""
    lines = [HEADER if told else HEADER.replace("velocity,heading", "a,b")]
    for t in range(0, 600, step):
        way = 205.0 * (t - 300.0)
        lat, lon = plane.to_geodetic(
            way * math.sin(track_deg * DEG), way * math.cos(track_deg * DEG)
        )
        places = (lon, lat) if exchanged else (lat, lon)
        lines.append(
            f"{1_700_000_000 + t},3c6444,{places[0]:.5f},{places[1]:.5f},205,"
            f"{(track_deg + drift_deg) % 360},DLH9CK,false,9450"
        )
    file.write_text("\n".join(lines))
    return file


@pytest.mark.parametrize("track_deg", [0, 45, 90, 170, 225, 300])
@pytest.mark.parametrize("step", [1, 10, 25])
def test_exchanged_places_are_refused_in_a_sentence(
    tmp_path: Path, track_deg: float, step: int
) -> None:
    file = written(tmp_path / "a.csv", PARIS, track_deg, exchanged=True, step=step)
    with pytest.raises(ValueError, match=r"latitude and longitude are exchanged\. As written"):
        load_track(file)


@pytest.mark.parametrize("plane", [PARIS, SYDNEY, GULF])
@pytest.mark.parametrize("track_deg", range(0, 360, 45))
@pytest.mark.parametrize("drift_deg", [-12.0, 0.0, 12.0])
def test_places_as_they_are_do_no_harm(
    tmp_path: Path, plane: LocalPlane, track_deg: float, drift_deg: float
) -> None:
    file = written(tmp_path / "a.csv", plane, track_deg, exchanged=False, drift_deg=drift_deg)
    assert load_track(file).duration == 590.0


def test_nothing_is_said_where_nothing_shows_it(tmp_path: Path) -> None:
    file = written(tmp_path / "a.csv", PARIS, 90.0, exchanged=True, told=False)
    assert load_track(file).duration == 590.0
