"""The wind by altitude at a place, from a forecast in GRIB; needs the extra `winds`."""

from pathlib import Path
from typing import Any

from relguide.flying.air import pressure_altitude
from relguide.flying.wind_profile import WindLevel, WindProfile
from relguide.planning.extras import is_installed, need
from relguide.planning.inputs import expect_within
from relguide.planning.wind import Wind

HECTOPASCAL = 100.0
"""[Pa]."""


def load_grib(path: Path | str, lat: float, lon: float) -> WindProfile:
    """The winds of all pressure levels of a GRIB file, at the point of its grid nearest to a place.

    Each level stands at its pressure altitude, as altimeters show it. Read are the components u and
    v on levels `isobaricInhPa`, of one time.

    Examples:
        >>> winds = rg.load_grib("gfs.grib2", lat=48.7, lon=2.4)  # doctest: +SKIP
        >>> air = rg.Air(profile=winds)  # doctest: +SKIP

    Args:
        path: the file.
        lat: latitude [°].
        lon: longitude [°], −180 … 360.

    Raises:
        MissingExtra: without xarray and cfgrib.
        ValueError: if it is no GRIB file, or has no such winds, none there, or several times.
        OSError: if the file cannot be opened.
    """
    lat = expect_within("lat", lat, -90.0, 90.0, "°")
    lon = expect_within("lon", lon, -180.0, 360.0, "°")
    need("xarray", "cfgrib", "eccodes")
    with Path(path).open("rb") as file:
        if b"GRIB" not in file.read(4096):
            raise ValueError(f"{path} is not a GRIB file.")
    field = _nearest(_opened(path), path, lat, lon)
    levels = field["isobaricInhPa"].values.reshape(-1).tolist()
    east, north = (field[name].values.reshape(-1).tolist() for name in ("u", "v"))
    return WindProfile(
        levels=tuple(
            WindLevel(pressure_altitude(level * HECTOPASCAL), Wind(east=u, north=v))
            for level, u, v in zip(levels, east, north, strict=True)
        )
    )


def _opened(path: Path | str) -> Any:
    """The winds on pressure levels of a file."""
    if is_installed("pyproj"):  # imported after eccodes, it crashes the process at its end
        import pyproj  # noqa: F401
    import xarray

    keys = {"typeOfLevel": "isobaricInhPa", "shortName": ["u", "v"]}
    # no index file is written beside what may be read-only
    options: dict[str, Any] = {"filter_by_keys": keys, "indexpath": ""}
    winds = xarray.open_dataset(path, engine="cfgrib", backend_kwargs=options)
    if not {"u", "v", "isobaricInhPa"} <= set(winds.variables):
        raise ValueError(f"{path} has no winds u and v on pressure levels (isobaricInhPa).")
    for name in ("time", "step", "number"):
        if name in winds.sizes:
            raise ValueError(
                f"{path} has {winds.sizes[name]} values of {name}: take one out, as grib_copy -w "
                "does, since a flight has one wind."
            )
    return winds


def _nearest(winds: Any, path: Path | str, lat: float, lon: float) -> Any:
    """The column of winds nearest to a place; no further than a step of the grid from it."""
    for name in ("latitude", "longitude"):
        if name not in winds.dims:
            raise ValueError(f"{path} has no regular grid of latitudes and longitudes.")
    lats, lons = winds["latitude"].values, winds["longitude"].values
    off_lon = abs((lons - lon + 180.0) % 360.0 - 180.0)
    off_lat = abs(lats - lat)
    for off, values, name in ((off_lat, lats, "latitude"), (off_lon, lons, "longitude")):
        step = abs(values[1] - values[0]) if len(values) > 1 else 1.0
        if off.min() > step:
            raise ValueError(
                f"{path} has no {name} near {lat if name == 'latitude' else lon:g}°: it has "
                f"{values.min():g} … {values.max():g}°."
            )
    return winds.isel(latitude=int(off_lat.argmin()), longitude=int(off_lon.argmin()))
