"""Latitude and longitude ↔ the local plane: the world frame of a situation on the earth."""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.planning.extras import need
from relguide.units import DEG, Radian

Floats = NDArray[np.float64]
STEP = 1e-4
"""How far away north is looked for [°]; 11 m."""


@dataclass(frozen=True)
class LocalPlane:
    """A plane that touches the WGS84 ellipsoid at a point: azimuthal equidistant, x east, y north.

    Distances and directions from the point itself are true; 500 km away scale is off by 0.1 %.
    """

    lat_deg: float
    """Latitude of the point [°]."""
    lon_deg: float
    """Longitude of the point [°]."""

    @cached_property
    def _projection(self) -> Any:
        need("pyproj")
        from pyproj import Proj  # 0.2 s to import, and only geographic input needs it

        return Proj(proj="aeqd", lat_0=self.lat_deg, lon_0=self.lon_deg, ellps="WGS84")

    def to_local(self, lat_deg: float, lon_deg: float) -> tuple[float, float]:
        """Latitude, longitude [°] → x, y [m]."""
        x, y = self._projection(lon_deg, lat_deg)
        return float(x), float(y)

    def to_local_each(self, lat_deg: Floats, lon_deg: Floats) -> tuple[Floats, Floats]:
        """As `to_local`, for arrays."""
        x, y = self._projection(lon_deg, lat_deg)
        return np.asarray(x), np.asarray(y)

    def to_geodetic(self, x: float, y: float) -> tuple[float, float]:
        """x, y [m] → latitude, longitude [°]."""
        lon, lat = self._projection(x, y, inverse=True)
        return float(lat), float(lon)

    def to_geodetic_each(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """As `to_geodetic`, for arrays."""
        lon, lat = self._projection(x, y, inverse=True)
        return np.asarray(lat), np.asarray(lon)

    def meridian(self, lat_deg: float, lon_deg: float) -> Radian:
        """Direction of true north at a place, clockwise from the plane's north [rad].

        A heading from true north becomes one of the plane when this is added.
        """
        step = STEP if lat_deg < 0.0 else -STEP  # there is no north of a pole
        x, y = self.to_local(lat_deg, lon_deg)
        x_step, y_step = self.to_local(lat_deg + step, lon_deg)
        return atan2((x_step - x) / step, (y_step - y) / step)

    def meridian_each(self, lat_deg: Floats, lon_deg: Floats) -> Floats:
        """As `meridian`, for arrays."""
        step = np.where(lat_deg < 0.0, STEP, -STEP)
        x, y = self.to_local_each(lat_deg, lon_deg)
        x_step, y_step = self.to_local_each(lat_deg + step, lon_deg)
        return np.arctan2((x_step - x) / step, (y_step - y) / step)


def middle_of(lat_deg: Floats, lon_deg: Floats) -> LocalPlane:
    """The plane that touches the earth amid some places; a few wrong ones do not move it.

    Medians are of the places' vectors, which know neither a seam at 180° nor a pole.
    """
    lat, lon = lat_deg * DEG, lon_deg * DEG
    x, y, z = np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)
    ahead, aside, up = float(np.median(x)), float(np.median(y)), float(np.median(z))
    return LocalPlane(atan2(up, hypot(ahead, aside)) / DEG, atan2(aside, ahead) / DEG)
