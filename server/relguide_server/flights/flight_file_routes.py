"""The route that gives a flight on record as a file."""

from collections.abc import AsyncIterator, Iterator
from typing import TYPE_CHECKING, Annotated, Any, Literal

import orjson
from fastapi import APIRouter, Depends, Query, Request
from starlette.responses import Response, StreamingResponse

from relguide.planning.extras import MissingExtra
from relguide.planning.frames import LocalPlane
from relguide_server.flights.recorded import (
    READING,
    RecordedId,
    anchor_of,
    expect_open,
    find_recorded,
)
from relguide_server.http.errors import Refusal
from relguide_server.http.etags import has, headers_of, tag_of
from relguide_server.http.idempotency import IdempotentRoute
from relguide_server.http.openapi import (
    NOT_MODIFIED,
    TAGGED,
    header_references,
    problem_responses,
)
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.http.security_headers import VERSION as SOFTWARE
from relguide_server.records import exports
from relguide_server.records.service import RecordsOf, RecordsService

if TYPE_CHECKING:  # with SQLAlchemy: a service that records nothing does not load it
    from relguide_server.records.store import Store

MEDIA = {
    "jsonl": "application/x-ndjson",
    "csv": "text/csv",
    "geojson": "application/geo+json",
    "czml": "application/json",
    "parquet": "application/vnd.apache.parquet",
}
"""Media types of the forms of an export."""

router = APIRouter(
    prefix="/api/v1/records",
    tags=["records"],
    dependencies=[KNOWN_PARAMETERS_ONLY, Depends(expect_open)],
    route_class=IdempotentRoute,
)


@router.get(
    "/flights/{flight_id}/export",
    summary="A flight as a file",
    responses={
        200: {
            "description": "The file.",
            "content": {media: {"schema": {"type": "string"}} for media in MEDIA.values()},
            "headers": header_references(["Content-Disposition", *TAGGED]),
        },
        **NOT_MODIFIED,
        **problem_responses(*READING, "invalid", "not-installed"),
    },
)
async def export_flight(
    flight_id: RecordedId,
    request: Request,
    records: RecordsOf,
    form: Annotated[
        Literal["jsonl", "csv", "geojson", "czml", "parquet"],
        Query(
            alias="format",
            description="`jsonl`: all documents, as `relguide replay` reads them. `csv`, "
            "`parquet`: samples, a row for each aircraft and second. `geojson`: the tracks. "
            "`czml`: the aircraft as they move, for Cesium.",
        ),
    ] = "jsonl",
    lat_deg: Annotated[
        float | None,
        Query(ge=-90.0, le=90.0, allow_inf_nan=False, description="Where x = y = 0 is, for "
              "`geojson` and `czml` of a flight whose situation had no latitudes."),
    ] = None,
    lon_deg: Annotated[
        float | None,
        Query(ge=-180.0, le=180.0, allow_inf_nan=False, description="Longitude of the same."),
    ] = None,
) -> Response:  # fmt: skip
    """What is on record of it now, and when it began, its id, and the version that flew it.

    It has an `ETag` once the flight is over.
    """
    from relguide_server.records import queries

    about = await find_recorded(flight_id, records)
    origin, asked = _origin(about), about["request"]
    levels = "situation" not in asked or exports.gives_level([asked, about["commands"]])
    if form not in ("geojson", "czml") and (lat_deg, lon_deg) != (None, None):
        raise Refusal(422, f"lat_deg and lon_deg have no meaning for {form}: leave them out.")
    headers = {"Content-Disposition": f'attachment; filename="flight-{about["id"]}.{form}"'}
    if about["outcome"] != "flying":  # nothing of it changes any more
        tag = tag_of(orjson.dumps([about, form, lat_deg, lon_deg, SOFTWARE]))
        headers |= headers_of(tag)
        if has(request.headers, tag):
            return Response(status_code=304, headers=headers)
    match form:
        case "jsonl" | "csv":
            lines = _parts(records, origin, about["form"], form, levels=levels)
            return StreamingResponse(lines, media_type=MEDIA[form], headers=headers)
        case "geojson":
            plane = _plane(about["request"], lat_deg, lon_deg)
            body = await records.read(
                lambda s: exports.as_geojson(
                    origin, plane, queries.each_chunk(s, flight_id), levels=levels
                )
            )
        case "czml":
            plane, title = _plane(about["request"], lat_deg, lon_deg), about["title"]
            body = await records.read(
                lambda s: exports.as_czml(origin, title, plane, queries.each_chunk(s, flight_id))
            )
        case "parquet":
            try:
                body = await records.read(
                    lambda s: exports.as_parquet(
                        origin, queries.each_chunk(s, flight_id), levels=levels
                    )
                )
            except MissingExtra as error:
                raise Refusal(501, str(error)) from None
    return Response(body, media_type=MEDIA[form], headers=headers)


def _origin(about: dict[str, Any]) -> exports.Origin:
    return exports.Origin(
        flight_id=about["id"], started_at=about["started_at"], relguide_version=about["version"]
    )


async def _parts(
    records: RecordsService, origin: exports.Origin, form: int, kind: str, *, levels: bool = True
) -> AsyncIterator[bytes]:
    """A file, a chunk at a time."""
    from relguide_server.records import queries

    def begin(store: "Store") -> Iterator[bytes]:
        chunks = queries.each_chunk(store, origin.flight_id)
        if kind == "csv":
            return exports.as_csv(origin, chunks, levels=levels)
        return exports.as_recording(origin, form, chunks)

    parts = await records.read(begin)
    while (part := await records.read(lambda _: next(parts, None))) is not None:
        yield part


def _plane(request: dict[str, Any], lat_deg: float | None, lon_deg: float | None) -> LocalPlane:
    """How a flight lies on the earth: as its situation says, or as is asked."""
    anchor = anchor_of(request)
    if isinstance(anchor, LocalPlane):
        if (lat_deg, lon_deg) != (None, None):
            raise Refusal(
                422, "This flight has latitudes of its own: leave lat_deg and lon_deg out."
            )
        return anchor
    if lat_deg is None or lon_deg is None:
        raise Refusal(
            422, "This flight has no latitudes: say by lat_deg and lon_deg where its x = y = 0 is."
        )
    return LocalPlane(lat_deg=lat_deg, lon_deg=lon_deg)
