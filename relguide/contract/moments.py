"""Times with their zone, as outsiders send them and are told."""

from datetime import UTC, datetime
from typing import Annotated

from pydantic import AfterValidator, Field, WithJsonSchema

from relguide.units import Second

_EXAMPLE = "2026-11-23T06:30:00Z"


def _expect_time(text: str) -> str:
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        moment = None
    if moment is None or moment.tzinfo is None or not 1970 < moment.year < 2200:
        raise ValueError(f"must be a time with its zone, as {_EXAMPLE}, not {text[:40]!r}.")
    return text


Moment = Annotated[
    str,
    Field(max_length=40),
    AfterValidator(_expect_time),
    WithJsonSchema({"type": "string", "format": "date-time", "maxLength": 40}),
]
"""A time with its zone, ISO 8601."""


def utc(text: str) -> Second:
    """A `Moment` as UTC [s]."""
    return datetime.fromisoformat(text).timestamp()


def moment(t: Second) -> str:
    """UTC [s] as a `Moment`, to the millisecond."""
    said = datetime.fromtimestamp(round(t, 3), UTC).isoformat(timespec="milliseconds")
    return said.replace("+00:00", "Z")
