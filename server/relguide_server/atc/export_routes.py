"""The route of clearances as files."""

import asyncio
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from starlette.responses import Response

from relguide.atc.cards import card_of
from relguide.atc.documents import ClearanceCard
from relguide.contract.clearance_exports import export_clearance, plane_of
from relguide.contract.document_models import card_from_wire
from relguide.planning.extras import MissingExtra
from relguide.planning.frames import LocalPlane
from relguide_server.atc.asterix_export import as_asterix
from relguide_server.atc.desk import Desk, DeskOf
from relguide_server.atc.routes import ClearanceId
from relguide_server.http.errors import Refusal
from relguide_server.http.openapi import header_references, problem_responses
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.http.security_headers import VERSION
from relguide_server.records.service import RecordsOf, RecordsService

MEDIA = {
    "geojson": "application/geo+json",
    "czml": "application/json",
    "kml": "application/vnd.google-earth.kml+xml",
    "csv": "text/csv",
    "asterix": "application/octet-stream",
}
"""Media types of the forms of an export."""
ENDINGS = {"asterix": "ast"}
"""Of the names of files, where they are not the names of the forms."""

router = APIRouter(prefix="/api/v1", tags=["clearances"], dependencies=[KNOWN_PARAMETERS_ONLY])


@router.get(
    "/clearances/{clearance_id}/export",
    summary="A clearance as a file",
    responses={
        200: {
            "description": "The file.",
            "content": {media: {"schema": {"type": "string"}} for media in MEDIA.values()},
            "headers": header_references(["Content-Disposition"]),
        },
        **problem_responses("not-found", "conflict", "invalid", "not-installed"),
    },
)
async def export_one_clearance(
    clearance_id: ClearanceId,
    desk: DeskOf,
    records: RecordsOf,
    form: Annotated[
        Literal["geojson", "czml", "kml", "csv", "asterix"],
        Query(
            alias="format",
            description="`geojson`: both routes, and where others come closest. `czml`, `kml`: "
            "both routes by time, for Cesium and Google Earth. `csv`: a row for each point. "
            "`asterix`: both as simulated tracks of category 062, every 4 s.",
        ),
    ] = "geojson",
) -> Response:
    """What it asks for, with its id, its state, times by the wall clock, and the version."""
    card, plane = await _find(clearance_id, desk, records)
    try:
        body = await asyncio.to_thread(_written, card, plane, form)
    except ValueError as error:
        raise Refusal(409, str(error)) from None
    except MissingExtra as error:
        raise Refusal(501, str(error)) from None
    name = f"clearance-{card.id}.{ENDINGS.get(form, form)}"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(body, media_type=MEDIA[form], headers=headers)


def _written(card: ClearanceCard, plane: LocalPlane | None, form: Any) -> bytes:
    if form != "asterix":
        return export_clearance(card, plane, form, version=VERSION)
    if plane is None:
        raise ValueError("This clearance lies nowhere on the earth: asterix needs latitudes.")
    return as_asterix(card, plane)


async def _find(
    clearance_id: str, desk: Desk, records: RecordsService
) -> tuple[ClearanceCard, LocalPlane | None]:
    """A clearance, of this run of the service or of another, and how it lies on the earth.

    Raises:
        Refusal: 404, if there is none.
    """
    case = desk.cases.get(clearance_id)
    if case is None and records.opened():
        from relguide_server.records import queries

        found = await records.read(lambda s: queries.read_clearance(s, clearance_id))
        if found is not None:
            card = card_from_wire(ClearanceCard, found, extra="ignore")
            return card, plane_of(card)
    case = desk.find(clearance_id)
    return card_of(case.clearance), case.plane
