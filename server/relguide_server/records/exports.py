"""Recorded flights in other forms: a recording of the library, CSV, Parquet, GeoJSON, CZML.

Each says which flight it is, when that began by the wall clock, and which relguide flew it.
"""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from datetime import datetime, timedelta
from typing import Any, get_origin

import orjson

from relguide.contract.geojson import line_geometry
from relguide.contract.recorder import header_line
from relguide.contract.wire import wire_fields
from relguide.flying.aircraft_documents import AircraftSample, GuidanceSample
from relguide.planning.extras import need
from relguide.planning.frames import LocalPlane

Lines = list[bytes]
"""Documents as JSON lines."""
_PLAIN: dict[Any, str] = {float: "float64", bool: "bool", str: "string"}
"""Fields of these types are columns; words of a few are texts."""


def _columns(card: type[Any]) -> dict[str, str]:
    kinds: dict[str, str] = {}
    for field in wire_fields(card):
        plain = "string" if str(get_origin(field.annotation)) == "typing.Literal" else None
        kind = _PLAIN.get(field.annotation, plain)
        if kind is not None:
            kinds[field.wire_name] = kind
    return kinds


@dataclass(frozen=True, slots=True, kw_only=True)
class Origin:
    """Which flight it is."""

    flight_id: str
    started_at: str
    """When it began by the wall clock, as RFC 3339 has it."""
    relguide_version: str
    """Of the service that flew it."""


LEVELS = ("altitude_m", "to_altitude_m", "leader_level_m")
"""Fields that give an aircraft a level."""


def gives_level(said: object) -> bool:
    """Whether a request, or what was ordered later, gives any aircraft a level."""
    match said:
        case dict():
            return any(
                (name in LEVELS and value is not None) or gives_level(value)
                for name, value in said.items()
                if name not in ("air", "believed_air")
            )
        case list():
            return any(map(gives_level, said))
        case _:
            return False


COLUMNS = {
    "t_s": "float64",
    **_columns(AircraftSample),
    **_columns(GuidanceSample),
    **dict.fromkeys(("flight_id", "started_at", "relguide_version"), "string"),
}
"""Columns of the table of samples, and what they hold: a row for each aircraft and sample. Those of
guidance are empty for an aircraft that has no leader; those of `Origin` are the same in each row,
since few readers of CSV stand a line of comment."""


def as_recording(origin: Origin, form: int, chunks: Iterable[Lines]) -> Iterator[bytes]:
    """What `relguide replay` reads; the origin is in its first line.

    Args:
        origin: which flight it is.
        form: version of the documents' form.
        chunks: the documents as JSON lines.
    """
    yield header_line(form, **asdict(origin))
    for lines in chunks:
        yield b"".join(lines)


def as_csv(origin: Origin, chunks: Iterable[Lines], *, levels: bool = True) -> Iterator[bytes]:
    """The table of samples as CSV.

    Args:
        origin: which flight it is.
        chunks: the documents as JSON lines.
        levels: whether a level was given to any aircraft; else altitudes are left out, which are
            what the aircraft were flown at for want of one.
    """
    yield _csv_rows([list(COLUMNS)])
    for lines in chunks:
        yield _csv_rows([list(row.values()) for row in _rows(lines, origin, levels=levels)])


def as_parquet(origin: Origin, chunks: Iterable[Lines], *, levels: bool = True) -> bytes:
    """The table of samples as Parquet; arguments as in `as_csv`.

    Raises:
        MissingExtra: if pyarrow is not installed.
    """
    need("pyarrow")
    import pyarrow as pa
    import pyarrow.parquet as pq

    schema = pa.schema([(name, getattr(pa, kind, pa.string)()) for name, kind in _ARROW.items()])
    out = io.BytesIO()
    with pq.ParquetWriter(out, schema) as writer:
        for lines in chunks:
            if rows := list(_rows(lines, origin, levels=levels)):
                writer.write_table(pa.Table.from_pylist(rows, schema=schema))
    return out.getvalue()


_ARROW = {name: "bool_" if kind == "bool" else kind for name, kind in COLUMNS.items()}


def as_geojson(
    origin: Origin, plane: LocalPlane, chunks: Iterable[Lines], *, levels: bool = True
) -> bytes:
    """The tracks of all aircraft, a line each, with the time of each point.

    Args:
        origin: which flight it is; a member of the collection.
        plane: how the flight lies on the earth.
        chunks: the documents as JSON lines.
        levels: as in `as_csv`.
    """
    most = 3 if levels else 2
    features = [
        {
            "type": "Feature",
            "id": ident,
            "properties": {"ident": ident, "t_s": times},
            "geometry": line_geometry([point[:most] for point in points]),
        }
        for ident, (times, points) in _tracks(plane, chunks).items()
    ]
    return orjson.dumps({"type": "FeatureCollection", **asdict(origin), "features": features})


WIDTH = 2
"""Of a path [px]."""
TRAIL = 600.0
"""How much of it is seen behind an aircraft [s]."""
COLOURS = ([100, 190, 255, 255], [255, 255, 255, 255])
"""Of the first aircraft, which joins, and of all others: red, green, blue, opacity."""


def as_czml(origin: Origin, title: str, plane: LocalPlane, chunks: Iterable[Lines]) -> bytes:
    """All aircraft as they move, for Cesium: positions by the time since the flight began.

    Cesium needs a height: where nobody gave a level, that at which they were flown all the same.

    Args:
        origin: which flight it is; properties of the document.
        title: what the flight is called.
        plane: how the flight lies on the earth.
        chunks: the documents as JSON lines.
    """
    begun, tracks = origin.started_at, _tracks(plane, chunks)
    last = max((times[-1] for times, _ in tracks.values()), default=0.0)
    span = f"{begun}/{_later(begun, last)}"
    document = {
        "id": "document",
        "name": title,
        "version": "1.0",
        "clock": {"interval": span, "currentTime": begun, "multiplier": 10},
        "properties": asdict(origin),
    }
    moving = []
    for number, (ident, (times, points)) in enumerate(tracks.items()):
        colour = {"rgba": COLOURS[min(number, 1)]}
        moving.append(
            {
                "id": ident,
                "name": ident,
                "availability": span,
                "position": {
                    "epoch": begun,
                    # between two seconds of a turn a chord strays by some metres
                    "interpolationAlgorithm": "LAGRANGE",
                    "interpolationDegree": 2,
                    "cartographicDegrees": [
                        value
                        for t, point in zip(times, points, strict=True)
                        for value in (t, *point)
                    ],
                },
                "orientation": {"velocityReference": "#position"},
                "point": {"pixelSize": 8, "color": colour},
                "label": {"text": ident, "pixelOffset": {"cartesian2": [12, -12]}},
                "path": {
                    "leadTime": 0,
                    "trailTime": TRAIL,
                    "width": WIDTH,
                    "material": {"solidColor": {"color": colour}},
                },
            }
        )
    return orjson.dumps([document, *moving])


def _later(begun: str, seconds: float) -> str:
    end = datetime.fromisoformat(begun) + timedelta(seconds=seconds)
    return end.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def _tracks(
    plane: LocalPlane, chunks: Iterable[Lines]
) -> dict[str, tuple[list[float], list[list[float]]]]:
    """Of each aircraft the times [s], and its longitudes, latitudes [°] and altitudes [m] then."""
    tracks: dict[str, tuple[list[float], list[list[float]]]] = {}
    for lines in chunks:
        for row in _rows(lines):
            times, points = tracks.setdefault(row["ident"], ([], []))
            lat, lon = plane.to_geodetic(row["x_m"], row["y_m"])
            times.append(row["t_s"])
            points.append([round(lon, 7), round(lat, 7), round(row["altitude_m"], 1)])
    return tracks


def _rows(
    lines: Lines, origin: Origin | None = None, *, levels: bool = True
) -> Iterator[dict[str, Any]]:
    about = {} if origin is None else asdict(origin)
    if not levels:
        about["altitude_m"] = None
    for line in lines:
        document = orjson.loads(line)
        if document["kind"] != "sample":
            continue
        guided = {guidance["ident"]: guidance for guidance in document["guidance"]}
        for aircraft in document["aircraft"]:
            row = {"t_s": document["t_s"], **aircraft, **guided.get(aircraft["ident"], {}), **about}
            yield {name: row.get(name) for name in COLUMNS}


def _csv_rows(rows: Iterable[list[Any]]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode()
