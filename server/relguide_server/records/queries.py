"""What is on record: flights to find and read, and plans asked for."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import orjson
import sqlalchemy as sa
from sqlalchemy.engine import Connection

from relguide_server.records import database
from relguide_server.records.clock import date
from relguide_server.records.cursors import cursor_of
from relguide_server.records.entries import Place, RecordSearch
from relguide_server.records.recording import lines_of
from relguide_server.records.schema import chunks, clearances, commands, flights, plans
from relguide_server.records.store import Store


@dataclass(frozen=True, slots=True)
class Found:
    """A part of a list."""

    rows: list[dict[str, Any]]
    next: str | None
    """Cursor of what follows; `None` at its end."""
    total: int
    """Of the whole list."""


def find_flights(store: Store, search: RecordSearch) -> Found:
    """Flights in short."""
    query = sa.select(flights)
    if search.scenario is not None:
        query = query.where(flights.c.scenario == search.scenario)
    if search.outcome is not None:
        query = query.where(flights.c.outcome == search.outcome)
    return _find(store, search, query, (flights.c.started_at, flights.c.id), _summary)


def read_flight(store: Store, flight_id: str) -> dict[str, Any] | None:
    """All about a flight but its documents; `None` if there is no such flight."""
    with database.reading(store.engine) as connection:
        row = _row_of(connection, flight_id)
        if row is None:
            return None
        given = sa.select(commands).where(commands.c.flight_id == flight_id)
        return _summary(row) | {
            "request": orjson.loads(row["request"]),
            "settings": orjson.loads(row["settings"]),
            "form": row["form"],
            "commands": [
                {
                    "number": order["number"],
                    "at": date(order["at"]),
                    "t_s": order["t"],
                    "command": orjson.loads(order["body"]),
                    "sent_by": order["sent_by"],
                }
                for order in connection.execute(given.order_by(commands.c.number)).mappings()
            ],
        }


def read_documents(store: Store, flight_id: str, first: int, most: int) -> list[tuple[int, bytes]]:
    """Documents of a flight, with their numbers, as JSON lines.

    Args:
        store: where.
        flight_id: whose.
        first: from this number on.
        most: so many at most, but whole chunks where those are longer.
    """
    found: list[tuple[int, bytes]] = []
    while len(found) < most:
        number = found[-1][0] + 1 if found else first
        chunk = _chunk_from(store, flight_id, number)
        if not chunk:
            break
        found += chunk
    return found[:most]


def each_chunk(store: Store, flight_id: str) -> Iterator[list[bytes]]:
    """The documents of a flight as JSON lines, some dozens at a time.

    All are read now, packed as they are (0.7 MB for an hour): a flight that is being replayed or
    exported is whole, whether or not it is forgotten or removed meanwhile.
    """
    query = sa.select(chunks.c.body).where(chunks.c.flight_id == flight_id).order_by(chunks.c.first)
    with database.reading(store.engine) as connection:
        bodies = connection.scalars(query).all()
    return map(lines_of, bodies)


def find_plans(store: Store, search: RecordSearch) -> Found:
    """Plans asked for."""
    query = sa.select(plans)
    if search.outcome is not None:
        query = query.where(plans.c.status == search.outcome)
    return _find(store, search, query, (plans.c.at, plans.c.run, plans.c.number), _plan_of)


def find_clearances(store: Store, state: str | None, most: int) -> list[dict[str, Any]]:
    """Clearances as the API shows them, the newest first.

    Args:
        store: where.
        state: of each; any if left out.
        most: how many at most.
    """
    query = sa.select(clearances.c.card).order_by(clearances.c.at.desc(), clearances.c.id)
    if state is not None:
        query = query.where(clearances.c.state == state)
    with database.reading(store.engine) as connection:
        return [orjson.loads(card) for card in connection.scalars(query.limit(most))]


def read_clearance(store: Store, clearance_id: str) -> dict[str, Any] | None:
    """A clearance as the API shows it; `None` if there is none."""
    query = sa.select(clearances.c.card).where(clearances.c.id == clearance_id)
    with database.reading(store.engine) as connection:
        card = connection.scalar(query)
    return None if card is None else orjson.loads(card)


def remove_flight(store: Store, flight_id: str) -> str | None:
    """Remove a flight that is over.

    Returns:
        What became of it, which is "flying" if it is not removed; `None` if there is none.
    """
    with database.sentences(store.engine.url), store.engine.begin() as connection:
        row = _row_of(connection, flight_id)
        if row is None or row["outcome"] == "flying":
            return None if row is None else "flying"
        connection.execute(sa.delete(flights).where(flights.c.id == flight_id))
        return str(row["outcome"])


def _find(
    store: Store,
    search: RecordSearch,
    query: sa.Select[Any],
    keys: tuple[sa.Column[Any], ...],
    read: Callable[[sa.RowMapping], dict[str, Any]],
) -> Found:
    """A part of a list.

    Args:
        store: where.
        search: which part.
        query: the whole list, of any time.
        keys: what it is ordered by, the highest first: the time, and what is unique then.
        read: makes an answer of a row.
    """
    if search.since is not None:
        query = query.where(keys[0] >= search.since)
    if search.until is not None:
        query = query.where(keys[0] < search.until)
    part = query.order_by(*(key.desc() for key in keys)).limit(search.limit + 1)
    if (after := search.after) is not None:
        last = (after.at, after.name, after.number)[: len(keys)]
        part = part.where(sa.tuple_(*keys) < sa.tuple_(*map(sa.literal, last)))
    with database.reading(store.engine) as connection:
        total = (
            connection.scalar(query.with_only_columns(sa.func.count(), maintain_column_froms=True))
            or 0
        )
        rows = connection.execute(part).mappings().all()
    shown = rows[: search.limit]
    following = None
    if len(rows) > len(shown):
        at, name, *number = (shown[-1][key.name] for key in keys)
        following = cursor_of(Place(at=at, name=name, number=number[0] if number else 0))
    return Found(list(map(read, shown)), following, total)


def _row_of(connection: Connection, flight_id: str) -> sa.RowMapping | None:
    return (
        connection.execute(sa.select(flights).where(flights.c.id == flight_id))
        .mappings()
        .one_or_none()
    )


def _chunk_from(store: Store, flight_id: str, number: int) -> list[tuple[int, bytes]]:
    """Documents from a number on, up to the end of a chunk; nothing if there are no more."""
    query = (
        sa.select(chunks.c.first, chunks.c.body)
        .where(chunks.c.flight_id == flight_id, chunks.c.first + chunks.c.count > number)
        .order_by(chunks.c.first)
        .limit(1)
    )
    with database.reading(store.engine) as connection:
        row = connection.execute(query).one_or_none()
    if row is None:
        return []
    numbered = ((row.first + k, line) for k, line in enumerate(lines_of(row.body)))
    return [(n, line) for n, line in numbered if n >= number]


def _plan_of(row: sa.RowMapping) -> dict[str, Any]:
    return {
        "at": date(row["at"]),
        "situation": orjson.loads(row["body"]),
        "planner": row["planner"],
        "status": row["status"],
        "compute_ms": 1e3 * row["seconds"],
        "asked_by": row["asked_by"],
    }


def _summary(row: sa.RowMapping) -> dict[str, Any]:
    ended = row["ended_at"]
    return {
        "id": row["id"],
        "scenario": row["scenario"],
        "title": row["title"],
        "outcome": row["outcome"],
        "started_at": date(row["started_at"]),
        "ended_at": None if ended is None else date(ended),
        "seed": row["seed"],
        "version": row["version"],
        "requested_by": row["requested_by"],
        "documents": row["documents"],
        "lost": row["lost"],
        "bytes": row["size"],
        "figures": orjson.loads(row["figures"]),
    }
