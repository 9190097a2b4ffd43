"""Recorded flights in other forms: a recording of the library, CSV, Parquet, GeoJSON."""

import csv
import io
from collections.abc import Iterable, Iterator
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


COLUMNS = {"t_s": "float64", **_columns(AircraftSample), **_columns(GuidanceSample)}
"""Columns of the table of samples, and what they hold: a row for each aircraft and sample. Those of
guidance are empty for an aircraft that joins nobody."""


def as_recording(form: int, chunks: Iterable[Lines]) -> Iterator[bytes]:
    """What `relguide replay` reads.

    Args:
        form: version of the documents' form.
        chunks: the documents as JSON lines.
    """
    yield header_line(form)
    for lines in chunks:
        yield b"".join(lines)


def as_csv(chunks: Iterable[Lines]) -> Iterator[bytes]:
    """The table of samples as CSV."""
    yield _csv_rows([list(COLUMNS)])
    for lines in chunks:
        yield _csv_rows([[row.get(name) for name in COLUMNS] for row in _rows(lines)])


def as_parquet(chunks: Iterable[Lines]) -> bytes:
    """The table of samples as Parquet.

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
            if rows := list(_rows(lines)):
                writer.write_table(pa.Table.from_pylist(rows, schema=schema))
    return out.getvalue()


_ARROW = {name: "bool_" if kind == "bool" else kind for name, kind in COLUMNS.items()}


def as_geojson(plane: LocalPlane, chunks: Iterable[Lines]) -> bytes:
    """The tracks of all aircraft, a line each, with the time of each point.

    Args:
        plane: how the flight lies on the earth.
        chunks: the documents as JSON lines.
    """
    tracks: dict[str, dict[str, list[Any]]] = {}
    for lines in chunks:
        for row in _rows(lines):
            track = tracks.setdefault(row["ident"], {"points": [], "times": []})
            lat, lon = plane.to_geodetic(row["x_m"], row["y_m"])
            track["points"].append([round(lon, 7), round(lat, 7), round(row["altitude_m"], 1)])
            track["times"].append(row["t_s"])
    features = [
        {
            "type": "Feature",
            "id": ident,
            "properties": {"ident": ident, "t_s": track["times"]},
            "geometry": line_geometry(track["points"]),
        }
        for ident, track in tracks.items()
    ]
    return orjson.dumps({"type": "FeatureCollection", "features": features})


def _rows(lines: Lines) -> Iterator[dict[str, Any]]:
    for line in lines:
        document = orjson.loads(line)
        if document["kind"] != "sample":
            continue
        guided = {guidance["ident"]: guidance for guidance in document["guidance"]}
        for aircraft in document["aircraft"]:
            row = {"t_s": document["t_s"], **aircraft, **guided.get(aircraft["ident"], {})}
            yield {name: row.get(name) for name in COLUMNS}


def _csv_rows(rows: Iterable[list[Any]]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode()
