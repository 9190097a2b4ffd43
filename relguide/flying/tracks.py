"""Recorded ADS-B tracks as leaders: from the samples of the `traffic` package, or from a CSV file.

The samples are read as data from the installed package, which is never imported itself; it can be
installed without its dependencies by `pip install --no-deps traffic==2.13`.
"""

import csv
import gzip
import json
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, distribution
from math import atan2, hypot, inf, isfinite, isnan, nan
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.flying.smoothing import MIN_POINTS, smooth_motion
from relguide.flying.spline import Array
from relguide.kernels.base.angles import wrap
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, FT, KT, Metre, MetrePerSecond, Radian, Second

INSTALL = "pip install --no-deps traffic==2.13"
"""How to install the samples."""
QUICKSTART = "collections/quickstart"
"""Arrivals and departures around Paris, one position a second."""
DEFAULT_LEADER = "TVF22LK"
"""Of QUICKSTART: 12 minutes near 310 kt at 11,000 ft and above, with one clear turn, 35° to 84°."""
STEP = 1.0
"""Grid of a `RecordedTrack` [s]."""
AIRBORNE = 55.0
"""Slower than this over the ground it is taking off, landing or taxiing [m/s], 107 kt."""
NEEDED = ("timestamp", "latitude", "longitude", "altitude")
"""What a CSV file must have."""
ROW = (*NEEDED, "groundspeed", "track")
"""What a track is made of."""
NUMBERS = (*ROW[1:], "vertical_rate")
"""Columns of numbers; cells may be empty."""
RANGES = {"latitude": (-90.0, 90.0), "longitude": (-180.0, 360.0), "groundspeed": (0.0, 1e4)}
"""Accepted ranges [°, °, kt]."""


class TrackState(NamedTuple):
    """Where a recorded aircraft is, over the ground."""

    x: Metre
    """East of the origin [m]."""
    y: Metre
    """North of the origin [m]."""
    track: Radian
    """Direction of the ground velocity, clockwise from north [rad], in [0, 2π)."""
    ground_speed: MetrePerSecond
    altitude: Metre


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedTrack:
    """The airborne part of a recorded track, smooth, in a plane that touches the earth near it."""

    ident: str
    """Callsign, or the 24-bit address where there is none."""
    aircraft_type: str
    """ICAO type designator, empty when not recorded."""
    origin: LocalPlane
    """Where x = y = 0 is: the median of the positions."""
    t: Array
    """Even steps from 0 [s]."""
    x: Array
    """East [m]."""
    y: Array
    """North [m]."""
    track: Array
    """Direction of the ground velocity, clockwise from north [rad]; continuous, not wrapped."""
    ground_speed: Array
    """[m/s]."""
    altitude: Array
    """[m]."""
    _knots: list[tuple[float, float, float, float, float]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse arrays that do not make a track."""
        columns = (self.t, self.x, self.y, self.track, self.ground_speed, self.altitude)
        if len(self.t) < 2 or any(column.shape != self.t.shape for column in columns):
            raise ValueError("A track needs two points or more, and all arrays of one length.")
        if not all(np.all(np.isfinite(column)) for column in columns):
            raise ValueError("A track must hold finite numbers only.")
        if not np.allclose(np.diff(self.t, prepend=-self.t[1]), self.t[1]):
            raise ValueError("A track's times must begin at 0 and rise in even steps.")
        east, north = self.ground_speed * np.sin(self.track), self.ground_speed * np.cos(self.track)
        knots = np.column_stack([self.x, self.y, east, north, self.altitude])
        # plain floats: the closed loop asks 20 times a second of flight
        object.__setattr__(self, "_knots", list(map(tuple, knots.tolist())))

    @property
    def duration(self) -> Second:
        """How long it lasts [s]."""
        return float(self.t[-1])

    def sample(self, t: Array) -> tuple[Array, Array, Array, Array, Array]:
        """As `state_at`, at many times of the recording at once.

        Args:
            t: times from 0 to `duration` [s]. shape (n,)

        Returns:
            east, north [m], ground velocity east, north [m/s], and altitude [m]. shape (n,) each
        """
        knots, step = np.array(self._knots), float(self.t[1])
        i = np.minimum((t / step).astype(np.intp), len(knots) - 2)
        u = t / step - i
        x0, y0, east0, north0, altitude0 = knots[i].T
        x1, y1, east1, north1, altitude1 = knots[i + 1].T
        a, b, c = (1.0 - u) ** 2 * (1.0 + 2.0 * u), u * (1.0 - u) ** 2, u * u * (u - 1.0)
        da, db, dc = 6.0 * u * (u - 1.0), (3.0 * u - 1.0) * (u - 1.0), u * (3.0 * u - 2.0)
        return (
            a * x0 + (1.0 - a) * x1 + step * (b * east0 + c * east1),
            a * y0 + (1.0 - a) * y1 + step * (b * north0 + c * north1),
            da * (x0 - x1) / step + db * east0 + dc * east1,
            da * (y0 - y1) / step + db * north0 + dc * north1,
            altitude0 + u * (altitude1 - altitude0),
        )

    def state_at(self, t: float) -> TrackState:
        """Where it is at time t [s]; before its start and after its end it flies straight on.

        Cubic Hermite between the points: position and velocity are continuous.
        """
        knots, step = self._knots, float(self.t[1])
        inside = min(max(t, 0.0), self.duration)
        i = min(int(inside / step), len(knots) - 2)
        x0, y0, east0, north0, altitude0 = knots[i]
        x1, y1, east1, north1, altitude1 = knots[i + 1]
        u = inside / step - i
        # values of the Hermite basis at u, then their slopes
        a, b, c = (1.0 - u) ** 2 * (1.0 + 2.0 * u), u * (1.0 - u) ** 2, u * u * (u - 1.0)
        da, db, dc = 6.0 * u * (u - 1.0), (3.0 * u - 1.0) * (u - 1.0), u * (3.0 * u - 2.0)
        east = da * (x0 - x1) / step + db * east0 + dc * east1
        north = da * (y0 - y1) / step + db * north0 + dc * north1
        beyond = t - inside
        return TrackState(
            x=a * x0 + (1.0 - a) * x1 + step * (b * east0 + c * east1) + east * beyond,
            y=a * y0 + (1.0 - a) * y1 + step * (b * north0 + c * north1) + north * beyond,
            track=wrap(atan2(east, north)),
            ground_speed=hypot(east, north),
            altitude=altitude0 + u * (altitude1 - altitude0),
        )


def load_sample(callsign: str, collection: str = QUICKSTART) -> RecordedTrack:
    """A track of the samples that the `traffic` package brings.

    Args:
        callsign: of the flight.
        collection: file below `traffic/data/samples`, without its ending.

    Raises:
        ValueError: if the package, the collection or the callsign is not there, in a sentence.
    """
    everything = _sample(collection)
    rows = [row for row in everything if row.get("callsign") == callsign]
    if not rows:
        known = sorted({str(row["callsign"]) for row in everything if row.get("callsign")})
        raise ValueError(
            f"{collection} has no flight {callsign!r}. It has {len(known)}, "
            f"for example {', '.join(known[:8])}."
        )
    # as floats, a missing value (None) becomes NaN
    numbers = np.array([[row.get(name) for name in ROW] for row in rows], dtype=np.float64)
    numbers[:, 0] /= 1000.0  # from milliseconds
    aircraft_type = str(rows[0].get("typecode") or "")
    return _track(callsign, aircraft_type, numbers, f"{callsign} of {collection}")


def load_track(path: Path | str, callsign: str = "") -> RecordedTrack:
    """A track from a CSV file as OpenSky and traffic write it.

    Columns: timestamp (UTC: ISO 8601, or seconds since 1970), icao24, callsign, latitude, longitude
    [°], altitude [ft], groundspeed [kt], track [°], vertical_rate [ft/min]; others are not read.

    Args:
        path: the file.
        callsign: which flight of it; may be left out if there is only one.

    Raises:
        ValueError: naming the line and the column that is wrong.
        OSError: if the file cannot be opened.
    """
    flights: dict[str, list[list[float]]] = {}
    types: dict[str, str] = {}
    for name, aircraft_type, numbers in _csv_rows(Path(path)):
        flights.setdefault(name, []).append(numbers)
        types[name] = aircraft_type
    if not flights:
        raise ValueError(f"{path} has no rows below its header.")
    if not callsign and len(flights) == 1:
        (callsign,) = flights
    if callsign not in flights:
        names = ", ".join(sorted(flights)[:8])
        wanted = f"has no flight {callsign!r}" if callsign else "has several flights: choose one"
        raise ValueError(f"{path} {wanted}. It has {len(flights)}, for example {names}.")
    return _track(callsign, types[callsign], np.array(flights[callsign]), str(path))


def _sample(collection: str) -> list[dict[str, Any]]:
    """All rows of a collection."""
    try:
        package = distribution("traffic")
    except PackageNotFoundError:
        raise ValueError(
            f"Recorded tracks come with the package traffic, which is not installed: {INSTALL}"
        ) from None
    path = Path(str(package.locate_file(f"traffic/data/samples/{collection}.json.gz")))
    try:
        rows = json.loads(gzip.decompress(path.read_bytes()))
    except FileNotFoundError:
        raise ValueError(f"traffic {package.version} has no samples {collection!r}.") from None
    except (OSError, EOFError, zlib.error, ValueError):
        rows = None
    if not (isinstance(rows, list) and rows and all(isinstance(row, dict) for row in rows)):
        raise ValueError(f"{path} is damaged; install it again: {INSTALL}")
    return rows


def _csv_rows(path: Path) -> Iterator[tuple[str, str, list[float]]]:
    """Callsign, type designator, and the numbers of `ROW`, of each row."""
    with path.open(encoding="utf-8-sig", newline="") as file:
        reader = csv.DictReader(file)
        try:
            missing = [name for name in NEEDED if name not in (reader.fieldnames or ())]
            if missing:
                raise ValueError(f"{path}, line 1: column {missing[0]} is missing.")
            for row in reader:
                where = f"{path}, line {reader.line_num}"
                if None in row or None in row.values():
                    raise ValueError(f"{where}: it has not as many columns as the header.")
                # all numbers are checked, also those that are not used
                cells = {name: _number(row.get(name, ""), name, where) for name in NUMBERS}
                cells["timestamp"] = _timestamp(row["timestamp"], where)
                ident = row.get("callsign", "").strip() or row.get("icao24", "").strip()
                yield ident, row.get("typecode", "").strip(), [cells[name] for name in ROW]
        except UnicodeDecodeError:
            raise ValueError(f"{path} is not UTF-8 text.") from None
        except csv.Error as error:
            raise ValueError(f"{path}, line {reader.line_num}: {error}.") from None


def _number(cell: str, name: str, where: str) -> float:
    """A cell as a number; NaN if it is empty."""
    if not (text := cell.strip()):
        return nan
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{where}, column {name}: {text[:40]!r} is not a number.") from None
    low, high = RANGES.get(name, (-inf, inf))
    if not low <= value <= high and not isnan(value):
        raise ValueError(
            f"{where}, column {name}: must lie in {low:g} … {high:g}, not {text[:40]}."
        )
    return value


def _timestamp(cell: str, where: str) -> float:
    """A cell as seconds since 1970."""
    text = cell.strip()
    try:
        seconds = float(text)
    except ValueError:
        try:
            moment = datetime.fromisoformat(text)
        except ValueError:
            raise ValueError(
                f"{where}, column timestamp: {text[:40]!r} is neither a time like "
                "2021-10-07T12:00:00Z nor seconds since 1970."
            ) from None
        # times without a zone are UTC, as in all of aviation
        return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()
    if not isfinite(seconds):
        raise ValueError(f"{where}, column timestamp: {text[:40]!r} is not a time.")
    return seconds


def _track(ident: str, aircraft_type: str, numbers: Array, source: str) -> RecordedTrack:
    """Rows of `ROW` (time in seconds) as a track."""
    located = np.all(np.isfinite(numbers[:, 1:3]), axis=1)
    if not np.any(located):
        raise ValueError(f"{source} has no positions.")
    t, lat, lon, altitude, speed, track = numbers.T
    # the median, which a few wrong positions do not move
    plane = LocalPlane(float(np.median(lat[located])), float(np.median(lon[located])))
    place = np.full((len(t), 2), nan)
    place[located] = [plane.to_local(a, b) for a, b in zip(lat[located], lon[located], strict=True)]
    velocity = (speed * KT)[:, None] * np.column_stack([np.sin(track * DEG), np.cos(track * DEG)])
    try:
        motion = smooth_motion(t, place, velocity, altitude * FT, step=STEP)
    except ValueError as error:
        raise ValueError(f"{source} {error}") from None
    airborne = _longest_run(np.hypot(motion.east, motion.north) >= AIRBORNE)
    if airborne.stop - airborne.start < MIN_POINTS:
        raise ValueError(f"{source} never flies {MIN_POINTS} s faster than {AIRBORNE:g} m/s.")
    east, north = motion.east[airborne], motion.north[airborne]
    return RecordedTrack(
        ident=ident,
        aircraft_type=aircraft_type,
        origin=plane,
        t=motion.t[airborne] - motion.t[airborne.start],
        x=motion.x[airborne],
        y=motion.y[airborne],
        track=np.unwrap(np.arctan2(east, north)),
        ground_speed=np.hypot(east, north),
        altitude=motion.altitude[airborne],
    )


def _longest_run(holds: NDArray[np.bool_]) -> slice:
    """Where a condition holds longest without a break."""
    edges = np.diff(holds.astype(np.int8), prepend=0, append=0)
    starts, stops = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    if not starts.size:
        return slice(0, 0)
    longest = int(np.argmax(stops - starts))
    return slice(int(starts[longest]), int(stops[longest]))
