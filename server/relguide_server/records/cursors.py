"""Cursors: where a list of records goes on, as a text that is sent and comes back.

A list is ordered by time, then by what is unique, so what is newer changes nothing behind a cursor.
"""

import re
from base64 import urlsafe_b64decode, urlsafe_b64encode

import orjson

from relguide_server.records.entries import Place

_NAME = re.compile(r"[\w-]{1,64}", re.ASCII)


def cursor_of(place: Place) -> str:
    """The text that names a place in a list."""
    written = orjson.dumps([place.at, place.name, place.number])
    return urlsafe_b64encode(written).decode().rstrip("=")


def place_of(cursor: str) -> Place:
    """The place that a text names.

    Raises:
        ValueError: if it is none that `cursor_of` gave.
    """
    try:
        content = orjson.loads(urlsafe_b64decode(cursor + "=" * (-len(cursor) % 4)))
    except ValueError:
        content = None
    match content:
        case [float(at), str(name), int(number)] if _NAME.fullmatch(name) and number < 2**63:
            return Place(at=at, name=name, number=number)
        case _:
            raise ValueError(f"must be the `next` of an answer before, not {cursor[:40]}.")
