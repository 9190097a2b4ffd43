"""The writer's side of the database: saves rows, notices killed runs, and forgets what is old."""

import os
import socket
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import sqlalchemy as sa
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.engine import URL, Connection, Engine

from relguide_server.records import database
from relguide_server.records.clock import date
from relguide_server.records.entries import Unavailable
from relguide_server.records.noted_clearances import KILLED, ended
from relguide_server.records.recording import Row, Rows
from relguide_server.records.schema import chunks, clearances, commands, flights, plans, runs

AT_A_TIME = 20
"""Most flights that are forgotten in one transaction."""


class Store:
    """An open database, for one run of the service."""

    def __init__(self, url: URL, *, run: str, version: str, started_at: float) -> None:
        """Open it.

        Raises:
            Unavailable: if it cannot be opened now.
        """
        self.engine: Engine = database.connect(url)
        self._url = url
        self._file = _identity(url)
        self._run: Row = {
            "id": run,
            "host": socket.gethostname()[:255],
            "version": version,
            "started_at": started_at,
            "seen_at": started_at,
            "beat": 0,
        }

    def close(self) -> None:
        """Close all connections."""
        self.engine.dispose()

    def save(self, rows: Rows, *, now: float) -> None:
        """Save rows, all or none; those saved before under the same key are replaced.

        Args:
            rows: what to save; may be empty, to say that this run is alive.
            now: Unix time [s].

        Raises:
            Unavailable: if they cannot be saved.
        """
        if _identity(self._url) != self._file:
            raise Unavailable(f"{self._url.database} has been removed or replaced.")
        with database.sentences(self._url), self.engine.begin() as connection:
            self._run |= {"seen_at": now, "beat": self._run["beat"] + 1}
            _upsert(connection, runs, [self._run], replace=True)
            _upsert(connection, flights, rows.flights, replace=True)
            _upsert(connection, chunks, rows.chunks, replace=True)
            _upsert(connection, commands, rows.commands, replace=False)
            _upsert(connection, plans, rows.plans, replace=False)
            _upsert(connection, clearances, rows.clearances, replace=True)

    def beats(self) -> dict[str, int]:
        """Other runs whose flights or clearances live, and how far each of them has counted."""
        flying = sa.select(flights.c.run).where(flights.c.outcome == "flying")
        cleared = sa.select(clearances.c.run).where(clearances.c.over.is_(False))
        query = (
            sa.select(runs.c.id, runs.c.beat)
            .where(runs.c.id.in_(flying) | runs.c.id.in_(cleared))
            .where(runs.c.id != self._run["id"])
        )
        with database.reading(self.engine) as connection:
            return {run: beat for run, beat in connection.execute(query)}

    def interrupt(self, still: Mapping[str, int]) -> int:
        """Note that the flights of killed runs were interrupted, and end their clearances.

        Args:
            still: runs whose count stands still, and where.

        Returns:
            How many flights that were.
        """
        done = 0
        with database.sentences(self._url), self.engine.begin() as connection:
            for run, beat in still.items():
                killed = sa.select(runs.c.id).where(runs.c.id == run, runs.c.beat == beat)
                last = sa.select(runs.c.seen_at).where(runs.c.id == run).scalar_subquery()
                done += connection.execute(
                    sa.update(flights)
                    .where(flights.c.run.in_(killed), flights.c.outcome == "flying")
                    .values(outcome="interrupted", ended_at=last)
                ).rowcount
                _end_clearances(connection, run, beat)
        return done

    def forget(self, *, before: float, most_bytes: float, most_plans: int) -> int:
        """Forget flights and plans, the oldest first; a few flights at a time.

        Args:
            before: flights that ended and plans that were made before are too old [Unix time, s].
            most_bytes: how much the documents of all flights may take.
            most_plans: how many plans may stay.

        Returns:
            How many flights were forgotten.
        """
        with database.sentences(self._url), self.engine.begin() as connection:
            old = connection.scalars(
                sa.select(flights.c.id)
                .where(flights.c.outcome != "flying", flights.c.ended_at < before)
                .limit(AT_A_TIME)
            ).all()
            too_many = _oldest_beyond(connection, most_bytes)
            gone = list(dict.fromkeys([*old, *too_many]))
            connection.execute(sa.delete(flights).where(flights.c.id.in_(gone)))
            connection.execute(sa.delete(plans).where(plans.c.at < before))
            forgotten = clearances.c.over.is_(True), clearances.c.changed_at < before
            connection.execute(sa.delete(clearances).where(*forgotten))
            oldest_kept = connection.scalar(
                sa.select(plans.c.at).order_by(plans.c.at.desc()).offset(most_plans).limit(1)
            )
            if oldest_kept is not None:
                connection.execute(sa.delete(plans).where(plans.c.at <= oldest_kept))
        if gone and self.engine.dialect.name == "sqlite":
            with database.reading(self.engine) as connection:
                connection.exec_driver_sql("PRAGMA incremental_vacuum")
        return len(gone)


def _oldest_beyond(connection: Connection, most_bytes: float) -> Sequence[str]:
    """The oldest flights that are over, as many as there are too many bytes."""
    excess = float(connection.scalar(sa.select(sa.func.sum(flights.c.size))) or 0) - most_bytes
    found: list[str] = []
    if excess <= 0.0:
        return found
    over = (
        sa.select(flights.c.id, flights.c.size)
        .where(flights.c.outcome != "flying")
        .order_by(flights.c.started_at)
        .limit(AT_A_TIME)
    )
    for flight_id, size in connection.execute(over):
        found.append(flight_id)
        excess -= size
        if excess <= 0.0:
            break
    return found


def _end_clearances(connection: Connection, run: str, beat: int) -> None:
    """End what a killed run left open."""
    seen = connection.scalar(sa.select(runs.c.seen_at).where(runs.c.id == run, runs.c.beat == beat))
    if seen is None:
        return  # it lives
    left = sa.select(clearances.c.id, clearances.c.card).where(
        clearances.c.run == run, clearances.c.over.is_(False)
    )
    for one, card in connection.execute(left).all():
        state, now = ended(card, at=date(seen), message=KILLED)
        values = {"state": state, "card": now, "over": True, "changed_at": seen}
        connection.execute(sa.update(clearances).where(clearances.c.id == one).values(values))


def _upsert(connection: Connection, table: sa.Table, rows: Iterable[Row], *, replace: bool) -> None:
    given = list(rows)
    if not given:
        return
    keys = [column.name for column in table.primary_key]
    make: Any = sqlite.insert if connection.dialect.name == "sqlite" else postgresql.insert
    statement = make(table)
    if replace:
        others = {c.name: statement.excluded[c.name] for c in table.c if c.name not in keys}
        statement = statement.on_conflict_do_update(index_elements=keys, set_=others)
    else:
        statement = statement.on_conflict_do_nothing(index_elements=keys)
    connection.execute(statement, given)


def _identity(url: URL) -> tuple[int, int]:
    """Which file a database is; zeros if it is none, or gone."""
    if url.drivername != "sqlite" or url.database in (None, "", ":memory:"):
        return (0, 0)
    try:
        found = os.stat(Path(str(url.database)))
    except OSError:
        return (0, 0)
    return (found.st_dev, found.st_ino)
