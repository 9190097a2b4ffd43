"""A forecast in GRIB gives the winds above a place, each at its pressure altitude."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from relguide.flying.air import pressure_altitude
from relguide.flying.wind_grib import load_grib

LEVELS = (850, 500, 300, 200)
LATS, LONS = np.arange(50.0, 47.0, -1.0), np.arange(0.0, 4.0)


def east_of(level: int, lat: float, lon: float) -> float:
    return (1_000.0 - level) / 20.0 + lon + 0.1 * lat


def write(
    path: Path, parameters: tuple[int, ...] = (131, 132), steps: tuple[int, ...] = (6,)
) -> Path:
    """A forecast of u and v on a small grid, as ECMWF numbers them."""
    import pyproj  # noqa: F401  # before eccodes, as `load_grib` does

    # isort: split
    import eccodes

    with path.open("wb") as file:
        for step in steps:
            for parameter in parameters:
                for level in LEVELS:
                    message = eccodes.codes_grib_new_from_samples("regular_ll_pl_grib2")
                    grid = {
                        "Ni": len(LONS), "Nj": len(LATS),
                        "latitudeOfFirstGridPointInDegrees": LATS[0],
                        "latitudeOfLastGridPointInDegrees": LATS[-1],
                        "longitudeOfFirstGridPointInDegrees": LONS[0],
                        "longitudeOfLastGridPointInDegrees": LONS[-1],
                        "iDirectionIncrementInDegrees": 1.0, "jDirectionIncrementInDegrees": 1.0,
                        "dataDate": 20260101, "dataTime": 0, "stepRange": step,
                        "level": level, "paramId": parameter, "bitsPerValue": 24,
                    }  # fmt: skip
                    for key, value in grid.items():
                        eccodes.codes_set(message, key, value)
                    sign = 1.0 if parameter == 131 else -0.5
                    values = [sign * east_of(level, lat, lon) for lat in LATS for lon in LONS]
                    eccodes.codes_set_values(message, np.array(values))
                    eccodes.codes_write(message, file)
                    eccodes.codes_release(message)
    return path


@pytest.mark.parametrize(("lat", "lon"), [(48.9, 2.4), (50.4, -0.3), (48.0, 3.0)])
def test_the_winds_are_those_of_the_nearest_point(lat: float, lon: float, tmp_path: Path) -> None:
    profile = load_grib(write(tmp_path / "winds.grib"), lat, lon)
    assert [level.altitude for level in profile.levels] == [
        pressure_altitude(level * 100.0) for level in LEVELS
    ]
    near = float(LATS[abs(LATS - lat).argmin()]), float(LONS[abs(LONS - lon).argmin()])
    for level, (_, wind) in zip(LEVELS, profile.levels, strict=True):
        east = east_of(level, *near)
        assert (wind.east, wind.north) == pytest.approx((east, -0.5 * east), abs=1e-4)
    # 300 hPa is FL300 to 100 ft
    assert profile.levels[2].altitude == pytest.approx(9_164.0, abs=5.0)
    assert not list(tmp_path.glob("*.idx"))


@pytest.mark.parametrize(("lat", "lon"), [(40.0, 2.0), (49.0, 20.0)])
def test_places_off_the_grid_are_refused(lat: float, lon: float, tmp_path: Path) -> None:
    path = write(tmp_path / "winds.grib")
    with pytest.raises(ValueError, match=r"winds\.grib has no (latitude|longitude) near [24]0°"):
        load_grib(path, lat, lon)


def test_files_without_such_winds_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="has no winds u and v on pressure levels"):
        load_grib(write(tmp_path / "temperature.grib", (130,)), 49.0, 2.0)
    with pytest.raises(ValueError, match="has 2 values of step: take one out"):
        load_grib(write(tmp_path / "steps.grib", steps=(6, 12)), 49.0, 2.0)
    (tmp_path / "text.grib").write_text("altitude_m,u,v\n")
    with pytest.raises(ValueError, match="is not a GRIB file"):
        load_grib(tmp_path / "text.grib", 49.0, 2.0)
    with pytest.raises(ValueError, match="lat must lie in"):
        load_grib(tmp_path / "text.grib", 99.0, 2.0)
    with pytest.raises(FileNotFoundError):
        load_grib(tmp_path / "nothing.grib", 49.0, 2.0)


def test_where_winds_were_read_places_can_still_be_laid_in_a_plane(tmp_path: Path) -> None:
    """Eccodes and pyproj in one process: in the wrong order it warns, and crashes at its end."""
    path = write(tmp_path / "winds.grib")
    code = f"""if True:
        from relguide.flying.wind_grib import load_grib
        from relguide.planning.frames import LocalPlane
        load_grib({str(path)!r}, 48.9, 2.4)
        print(LocalPlane(48.9, 2.4).to_local(48.9, 2.4))
    """
    ran = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False
    )
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "(0.0, 0.0)\n", "")
