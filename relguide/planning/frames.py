"""Latitude and longitude ↔ the local plane: the world frame of a situation on the earth."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from relguide.planning.extras import need


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

    def to_geodetic(self, x: float, y: float) -> tuple[float, float]:
        """x, y [m] → latitude, longitude [°]."""
        lon, lat = self._projection(x, y, inverse=True)
        return float(lat), float(lon)
