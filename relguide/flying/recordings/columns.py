"""Tables as text, with the columns that OpenSky, traffic and Flightradar24 name in their own ways.

Commas, semicolons, tabs or bars part the columns. Capitals, spaces and underscores in their names
do not matter. A comma within a number is a decimal comma where commas do not part the columns.
"""

import csv
from collections.abc import Iterator, Sequence
from io import StringIO
from math import inf, nan
from typing import NamedTuple

from relguide.flying.recordings.cells import GROUND, moment, number, truth
from relguide.flying.recordings.reports import Report, Reports, reports_of
from relguide.units import FT, KT

SEPARATORS = ",;\t|"
MOST_SHOWN = 12
"""How many columns of a wrong file are listed."""


class Column(NamedTuple):
    """How a column may be called, and what it counts in."""

    name: str
    """In small letters, without spaces and underscores."""
    unit: float = 1.0
    """One of it in our unit."""


TIMES = ("timestamp", "time", "datetime", "utc", "timeposition")
"""Names of times; of several columns the first is read, here and below."""
LATITUDES = ("latitude", "lat", "latdeg")
LONGITUDES = ("longitude", "lon", "long", "lng", "londeg")
PLACES = ("position",)
"""Latitude and longitude in one cell."""
ALTITUDES = (
    Column("altitude", FT),
    Column("altitudeft", FT),
    Column("altitudem"),
    Column("baroaltitude"),
    Column("altbaro", FT),
)
SPEEDS = (
    Column("groundspeed", KT),
    Column("groundspeedkt", KT),
    Column("groundspeedmps"),
    Column("velocity"),
    Column("speed", KT),
    Column("gs", KT),
)
TRACKS = ("track", "trackdeg", "truetrack", "direction", "heading")
CLIMBS = ("verticalrate", "vertrate")
"""Read only to see that the file is sound."""
GROUNDS = ("onground",)
ADDRESSES = ("icao24", "icao", "hex", "modes")
CALLSIGNS = ("callsign", "flight", "ident")
TYPES = ("typecode", "aircrafttype")
RANGES = {"latitude": (-90.0, 90.0), "longitude": (-180.0, 360.0), "groundspeed": (0.0, 1e4)}
"""Accepted ranges [°, °, of the column]."""
READ = (
    "a time (timestamp, time), latitude and longitude (or lat and lon, or a Position of both), an "
    "altitude (altitude in feet, baroaltitude in metres), and where known groundspeed or Speed in "
    "knots or velocity in m/s, track, heading or Direction, callsign, icao24 and onground"
)
"""Columns that are read, for people."""


def read_table(text: str, source: str) -> Reports:
    """The reports of a table.

    Args:
        text: of the file.
        source: its name, for people.

    Raises:
        ValueError: naming the line and the column that is wrong.
    """
    separator = _separator(next(iter(text.splitlines()), ""))
    reader = csv.reader(StringIO(text, newline=""), delimiter=separator)
    try:
        table = _Table(next(reader, []), separator, source)
        rows = list(table.rows(reader))
    except csv.Error as error:
        raise ValueError(f"{source}, line {reader.line_num}: {error}.") from None
    if not rows:
        raise ValueError(f"{source} has no rows below its header.")
    return reports_of(rows)


class _Table:
    """Which column holds what."""

    def __init__(self, header: Sequence[str], separator: str, source: str) -> None:
        self.source, self.separator = source, separator
        self.header = [name.strip() for name in header]
        self.places: dict[str, int] = {}
        for place, name in enumerate(map(_plain, header)):
            if name and name in self.places:
                raise ValueError(
                    f"{source}, line 1: column {self.header[place]} is given twice: keep one."
                )
            self.places[name] = place
        self.time = self._need("timestamp", TIMES)
        self.place = self._first(PLACES)
        if self._first(LATITUDES) is not None or self.place is None:
            self.lat = self._need("latitude", LATITUDES)
            self.lon, self.place = self._need("longitude", LONGITUDES), None
        self.altitude, self.altitude_unit = self._measured(ALTITUDES)
        if self.altitude is None:
            self._need("altitude", ())
        self.speed, self.speed_unit = self._measured(SPEEDS)
        self.track, self.climb = self._first(TRACKS), self._first(CLIMBS)
        self.ground = self._first(GROUNDS)
        self.address, self.callsign = self._first(ADDRESSES), self._first(CALLSIGNS)
        self.type = self._first(TYPES)

    def rows(self, reader: Iterator[list[str]]) -> Iterator[Report]:
        """The reports, as they are read."""
        for line, row in enumerate(reader, 2):
            if not row:
                continue
            where = f"{self.source}, line {getattr(reader, 'line_num', line)}"
            if len(row) != len(self.header):
                raise ValueError(f"{where}: it has not as many columns as the header.")
            yield self._report(row, where)

    def _report(self, row: list[str], where: str) -> Report:
        def value(place: int | None, name: str) -> float:
            if place is None:
                return nan
            cell = row[place]
            if self.separator != "," and "." not in cell:
                cell = cell.replace(",", ".")
            low, high = RANGES.get(name, (-inf, inf))
            called = f"{where}, column {self.header[place]}"
            return number(cell, called, low=low, high=high)

        t = moment(row[self.time], f"{where}, column {self.header[self.time]}")
        if self.place is None:
            lat, lon = value(self.lat, "latitude"), value(self.lon, "longitude")
        else:
            lat, lon = _both(row[self.place], f"{where}, column {self.header[self.place]}")
        on_ground = (
            nan
            if self.ground is None
            else truth(row[self.ground], f"{where}, column {self.header[self.ground]}")
        )
        assert self.altitude is not None
        altitude = nan
        if row[self.altitude].strip().lower() == GROUND:
            on_ground = 1.0
        else:
            altitude = value(self.altitude, "altitude") * self.altitude_unit
        value(self.climb, "vertical_rate")
        return Report(
            address=self._text(row, self.address).lower(),
            callsign=self._text(row, self.callsign),
            aircraft_type=self._text(row, self.type),
            t=t,
            lat_deg=lat,
            lon_deg=lon,
            altitude=altitude,
            ground_speed=value(self.speed, "groundspeed") * self.speed_unit,
            track_deg=value(self.track, "track"),
            on_ground=on_ground,
        )

    def _text(self, row: list[str], place: int | None) -> str:
        text = "" if place is None else row[place].strip()
        return "" if text.lower() in ("nan", "none", "null") else text

    def _first(self, names: Sequence[str]) -> int | None:
        return next((self.places[name] for name in names if name in self.places), None)

    def _measured(self, columns: Sequence[Column]) -> tuple[int | None, float]:
        for column in columns:
            if column.name in self.places:
                return self.places[column.name], column.unit
        return None, nan

    def _need(self, name: str, names: Sequence[str]) -> int:
        place = self._first(names)
        if place is None:
            found = ", ".join(self.header[:MOST_SHOWN]) or "nothing"
            if self.header and self.header[0].replace(".", "").isdigit():
                raise ValueError(
                    f"{self.source}, line 1 must name the columns, and holds values: {found}. Read "
                    f"are {READ}."
                )
            raise ValueError(
                f"{self.source}, line 1: column {name} is missing. Found: {found}. Read are {READ}."
            )
        return place


def _both(cell: str, where: str) -> tuple[float, float]:
    """Latitude and longitude of one cell, `48.1,2.3`."""
    parts = cell.split(",")
    if len(parts) != 2:
        raise ValueError(f"{where}: {cell[:40]!r} is not a latitude, a comma and a longitude.")
    low, high = RANGES["latitude"]
    lat = number(parts[0], where, low=low, high=high)
    low, high = RANGES["longitude"]
    return lat, number(parts[1], where, low=low, high=high)


def _separator(header: str) -> str:
    """What parts the columns: what makes most known names of the first line."""

    def known(separator: str) -> int:
        names = next(csv.reader([header], delimiter=separator), [])
        return sum(_plain(name) in KNOWN for name in names)

    return max(SEPARATORS, key=known)


def _plain(name: str) -> str:
    return name.strip().lower().replace(" ", "").replace("_", "")


KNOWN = frozenset[str]().union(
    *(TIMES, LATITUDES, LONGITUDES, PLACES, TRACKS, CLIMBS, GROUNDS, ADDRESSES, CALLSIGNS, TYPES),
    (column.name for column in (*ALTITUDES, *SPEEDS)),
)
"""All names that are read."""
