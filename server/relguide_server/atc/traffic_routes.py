"""Routes of the picture: others say what flies and what is closed, and all may read it."""

import asyncio
from time import time
from typing import Annotated, Any, TypeVar

from fastapi import APIRouter, Query, Request
from pydantic import BaseModel
from starlette.responses import Response

from relguide.contract.airspace_bodies import AirspaceReport, airspace_feature, airspaces_from_body
from relguide.contract.moments import moment
from relguide.contract.other_bodies import Ident
from relguide.contract.refusal import ContractError, parse
from relguide.contract.traffic_bodies import (
    OLDEST,
    TrafficPicture,
    TrafficReport,
    TrafficTaken,
    aircraft_card,
    reported_from_body,
)
from relguide_server.atc.reports import MOST_SOURCES, Reports, ReportsOf, Source
from relguide_server.http.access import owner_of
from relguide_server.http.bodies import GEOJSON, JSON, json_answer, parse_json, read_body
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.openapi import BODY, problem_responses, request_body, response, schema_of
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY

LONGEST = 4 * 1024 * 1024
"""5,000 aircraft with four points of intent each take 2 MB [bytes]."""
PLACE = {"lat_deg": 50.03, "lon_deg": 8.56}
TRAFFIC_EXAMPLE = {
    "as_of": "2026-11-23T06:30:00Z",
    "aircraft": [
        {
            "ident": "BAW12",
            **PLACE,
            "altitude_m": 9449,
            "track_deg": 90,
            "ground_speed_mps": 230,
            "intent": [{"t_s": 120, "lat_deg": 50.03, "lon_deg": 8.945}],
        }
    ],
}
AIRSPACE_EXAMPLE = {
    "type": "FeatureCollection",
    "features": [
        {
            "type": "Feature",
            "properties": {"ident": "D112", "from_altitude_m": 6096, "to_altitude_m": 9449},
            "geometry": {
                "type": "Polygon",
                "coordinates": [[[8.0, 50.0], [8.4, 50.0], [8.4, 50.3], [8.0, 50.0]]],
            },
        }
    ],
}

M = TypeVar("M", bound=BaseModel)
router = APIRouter(prefix="/api/v1", tags=["picture"], dependencies=[KNOWN_PARAMETERS_ONLY])

Name = Annotated[
    Ident, Query(description="Who reports: each source replaces what it said itself before.")
]
TAKEN_BACK: dict[int | str, dict[str, Any]] = {
    204: {"description": "What that source said is forgotten."}
}


@router.put(
    "/traffic",
    summary="Say what flies",
    responses={
        **response(200, "It is in the picture.", schema_of(TrafficTaken)),
        **problem_responses(*BODY, "not-allowed", "too-many-sources"),
    },
    openapi_extra=request_body(schema_of(TrafficReport), TRAFFIC_EXAMPLE),
)
async def put_traffic(request: Request, reports: ReportsOf, source: Name = "traffic") -> Response:
    """All aircraft that a source sees take the place of those that it reported before.

    Where several sources report an aircraft of one ident, the newest report counts. An aircraft
    that is not reported for a minute is forgotten.
    """
    body = await read_body(request, JSON, most=LONGEST)
    who = _source(request, reports, source)
    now = time()

    def take() -> TrafficTaken:
        taken = reported_from_body(_shape(TrafficReport, body), now)
        reports.replace_aircraft(who, taken)
        heard = reports.heard(now)
        new = [one for one in taken if one.t >= now - OLDEST]
        return TrafficTaken(
            source=source,
            aircraft=len(new),
            too_old=[one.ident for one in taken if one.t < now - OLDEST],
            known_later=[
                one.ident for one in new if one.ident in heard and heard[one.ident].source != who
            ],
        )

    try:
        answer = await asyncio.to_thread(take)
    except ContractError as error:
        raise refusal_of(error) from None
    return json_answer(answer.model_dump())


@router.get(
    "/traffic",
    summary="What is reported to fly",
    responses=response(200, "The newest report of each aircraft.", schema_of(TrafficPicture)),
)
async def show_traffic(reports: ReportsOf) -> Response:
    """What sources and feeds report; the flights of this service are not among it."""
    now = time()

    def gather() -> dict[str, object]:
        heard = sorted(reports.heard(now).items())
        aircraft = [
            aircraft_card(one.report, now, one.source.name, [other.name for other in one.also])
            for _, one in heard
        ]
        return {"as_of": moment(now), "aircraft": aircraft}

    return json_answer(await asyncio.to_thread(gather))


@router.delete(
    "/traffic",
    status_code=204,
    summary="Take back what one said to fly",
    responses=TAKEN_BACK | problem_responses("not-allowed", "not-found"),
)
async def forget_traffic(
    request: Request, reports: ReportsOf, source: Name = "traffic"
) -> Response:
    """What other sources report remains."""
    _expect_known(reports.forget_aircraft(Source(owner_of(request), source)), source)
    return Response(status_code=204)


@router.put(
    "/airspaces",
    summary="Say what is closed",
    responses={
        **response(200, "They are in the picture.", schema_of(AirspaceReport), media=GEOJSON),
        **problem_responses(*BODY, "not-allowed", "too-many-sources"),
    },
    openapi_extra=request_body(schema_of(AirspaceReport), AIRSPACE_EXAMPLE),
)
async def put_airspaces(request: Request, reports: ReportsOf, source: Name = "traffic") -> Response:
    """All closed airspaces of a source take the place of those that it reported before.

    They are GeoJSON: a collection of polygons, with edges along geodesics. They stay until they are
    replaced, taken back, or the service stops.
    """
    body = await read_body(request, JSON, GEOJSON, most=LONGEST)
    who = _source(request, reports, source)

    def take() -> dict[str, object]:
        taken = airspaces_from_body(_shape(AirspaceReport, body))
        reports.replace_airspaces(who, taken)
        return _collection([airspace_feature(one, source) for one in taken])

    try:
        answer = await asyncio.to_thread(take)
    except ContractError as error:
        raise refusal_of(error) from None
    return json_answer(answer, media_type=GEOJSON)


@router.get(
    "/airspaces",
    summary="What is closed",
    responses=response(200, "All airspaces.", schema_of(AirspaceReport), media=GEOJSON),
)
async def show_airspaces(reports: ReportsOf) -> Response:
    """Those whose time has not come yet, or is over, as well."""
    found = reports.airspaces_reported()
    features = [airspace_feature(one, source.name) for source, one in found]
    return json_answer(_collection(features), media_type=GEOJSON)


@router.delete(
    "/airspaces",
    status_code=204,
    summary="Take back what one said to be closed",
    responses=TAKEN_BACK | problem_responses("not-allowed", "not-found"),
)
async def forget_airspaces(
    request: Request, reports: ReportsOf, source: Name = "traffic"
) -> Response:
    """What other sources report remains."""
    _expect_known(reports.forget_airspaces(Source(owner_of(request), source)), source)
    return Response(status_code=204)


def _collection(features: list[dict[str, object]]) -> dict[str, object]:
    return {"type": "FeatureCollection", "features": features}


def _shape(model: type[M], body: bytes) -> M:
    content: Any = parse_json(body)
    return parse(model, content)


def _source(request: Request, reports: Reports, name: str) -> Source:
    """Who reports, if one more may.

    Raises:
        Refusal: 429.
    """
    source = Source(owner_of(request), name)
    if reports.has_room(source):
        return source
    full = f"{MOST_SOURCES} sources report already: take one back first (DELETE, with its name)."
    raise Refusal(429, full, kind="too-many-sources", headers={"Retry-After": f"{OLDEST:.0f}"})


def _expect_known(known: bool, name: str) -> None:
    if not known:
        raise Refusal(404, f"{name!r} has reported nothing: GET lists who has.")
