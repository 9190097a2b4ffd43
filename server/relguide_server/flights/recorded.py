"""What the routes of records share: a flight on record, found or refused."""

from typing import Annotated, Any

from fastapi import Path
from pydantic import AfterValidator

from relguide.contract.bodies import situation_from_body
from relguide.contract.flown_bodies import FlownSituationBody
from relguide.contract.places import UNANCHORED, Anchor
from relguide_server.http.errors import Refusal
from relguide_server.records.service import RecordsOf, RecordsService

READING = ("not-found", "records-unavailable")
"""Problems of every route of records."""


async def expect_open(records: RecordsOf) -> None:
    """Refuse first where nothing is recorded, or cannot be read: routes load what reads records."""
    records.reading()


def expect_no_null(text: str) -> str:
    """PostgreSQL refuses texts with a null character, so no record has one."""
    if "\0" in text:
        raise ValueError("must not contain a null character.")
    return text


RecordedId = Annotated[
    str,
    Path(description="As `GET /records/flights` lists it.", examples=["3f2a9c0d71be"]),
    AfterValidator(expect_no_null),
]


async def find_recorded(flight_id: str, records: RecordsService) -> dict[str, Any]:
    """All that is on record of a flight but its documents.

    Raises:
        Refusal: 404, if it is not on record.
    """
    from relguide_server.records import queries

    found = await records.read(lambda s: queries.read_flight(s, flight_id))
    if found is None:
        raise not_on_record(flight_id)
    return found


def not_on_record(flight_id: str) -> Refusal:
    """What to say of a flight that is not on record."""
    return Refusal(
        404,
        f"There is no flight {flight_id[:100]!r} on record. GET /api/v1/records/flights lists all.",
    )


def anchor_of(request: dict[str, Any]) -> Anchor:
    """Where a flight lies on the earth, by the request for it."""
    if "situation" not in request:
        return UNANCHORED
    return situation_from_body(FlownSituationBody.model_validate(request["situation"]))[1]
