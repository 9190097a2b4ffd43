"""Reports: all that a recording says of where its aircraft were, in one unit each."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from relguide.flying.spline import Array


class Report(NamedTuple):
    """One row of a recording; what it does not say is NaN."""

    address: str
    """The aircraft's 24-bit address in lower-case hex, or empty."""
    callsign: str
    aircraft_type: str
    """ICAO type designator, or empty."""
    t: float
    """Since 1970 UTC [s]."""
    lat_deg: float
    lon_deg: float
    altitude: float
    """[m]."""
    ground_speed: float
    """[m/s]."""
    track_deg: float
    """Direction of the ground velocity, clockwise from true north [°]."""
    on_ground: float
    """1 on the ground, 0 in the air."""


NUMBERS = Report._fields[3:]
"""Those that are numbers, in order."""


@dataclass(frozen=True, slots=True, eq=False)
class Reports:
    """Reports of one recording, in its order."""

    address: list[str]
    callsign: list[str]
    aircraft_type: list[str]
    numbers: Array
    """A column for each of `NUMBERS`. shape (n, 7)"""

    def __len__(self) -> int:
        return len(self.address)


def reports_of(rows: list[Report]) -> Reports:
    """Rows as columns."""
    return Reports(
        [row.address for row in rows],
        [row.callsign for row in rows],
        [row.aircraft_type for row in rows],
        np.array([row[3:] for row in rows], dtype=np.float64).reshape(-1, len(NUMBERS)),
    )
