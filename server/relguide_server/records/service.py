"""What the service asks of the records."""

import asyncio
import secrets
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

from fastapi import Depends
from platformdirs import user_data_path
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from pydantic import BaseModel, Field
from starlette.requests import HTTPConnection

from relguide.units import Second
from relguide_server.http.errors import Refusal
from relguide_server.records.clock import Clock
from relguide_server.records.entries import (
    Began,
    ClearanceNoted,
    Commanded,
    FlightCard,
    PlanAsked,
    Unavailable,
)
from relguide_server.records.recorder import FlightRecorder, Recorder
from relguide_server.records.writer import RetentionLimits, Writer

if TYPE_CHECKING:  # with SQLAlchemy, which takes 0.3 s to import: the writer's thread does that
    from relguide_server.records.store import Store

T = TypeVar("T")
SOON: Second = 1.0
"""How long an answer waits at most until what it acknowledges is saved."""
TO_THE_END: Second = 10.0
"""The same of an answer after which the whole record is read."""
READERS = 2
"""Requests that read records at a time."""
DAY: Second = 86_400.0
OFF = "Nothing is recorded, as RELGUIDE_RECORDS is off."


class RecordsReport(BaseModel):
    """Whether flights are recorded."""

    status: Literal["on", "off", "waiting"] = Field(
        description="waiting: the database cannot be written now; what fits is kept until it can."
    )
    message: str = Field(description="Why nothing is saved now; empty if everything is.")


class RecordsService:
    """The records of a service; lives on the event loop. Without a writer nothing is kept."""

    def __init__(self, writer: Writer | None = None, *, plans: int = 0, clock: Clock) -> None:
        """Make it.

        Args:
            writer: saves.
            plans: plans a second that are kept.
            clock: tells the time.
        """
        self._writer, self._clock = writer, clock
        self._plans = plans
        self._second, self._planned = 0.0, 0
        self._readers: ThreadPoolExecutor | None = None

    def start(self) -> None:
        """Begin to save."""
        if self._writer is not None:
            self._readers = ThreadPoolExecutor(READERS, thread_name_prefix="records read")
            self._writer.start()

    def stop(self) -> None:
        """Save what there is, and end."""
        if self._writer is not None:
            self._writer.stop()
        if self._readers is not None:
            self._readers.shutdown(wait=False, cancel_futures=True)

    def begin(self, card: FlightCard) -> Recorder:
        """Record a flight from now on."""
        now = self._clock.now()
        if self._writer is None:
            return Recorder(now)
        self._writer.put(Began(card, now))
        return FlightRecorder(card.id, self._writer, self._clock, started_at=now)

    async def saved(self, *, to_the_end: bool = False) -> bool:
        """Wait until all that was begun, flown and commanded so far is saved.

        Args:
            to_the_end: whether a flight has ended, whose record is read next: that is waited for
                longer.

        Returns:
            Whether it is; false if it cannot be, or not so soon.
        """
        patience = TO_THE_END if to_the_end else SOON
        return self._writer is not None and await self._writer.saved(patience)

    def note_command(self, flight_id: str, *, t: Second, body: str, sent_by: str) -> None:
        """Record a command."""
        if self._writer is not None:
            self._writer.put(
                Commanded(
                    flight_id=flight_id, at=self._clock.now(), t=t, body=body, sent_by=sent_by
                )
            )

    def note_clearance(self, noted: ClearanceNoted) -> None:
        """Record what is new of a clearance."""
        if self._writer is not None:
            self._writer.put(noted)

    def note_plan(
        self, body: bytes, *, planner: str, status: str, seconds: Second, asked_by: str
    ) -> None:
        """Record a plan asked for; those beyond so many a second are counted only."""
        if self._writer is None or not self._plans:
            return
        elapsed = self._clock.elapsed()
        if elapsed - self._second >= 1.0:
            self._second, self._planned = elapsed, 0
        self._planned += 1
        if self._planned > self._plans:
            self._writer.counts.plans_lost += 1
            return
        self._writer.put(
            PlanAsked(
                at=self._clock.now(), body=body.decode(), planner=planner, status=status,
                seconds=seconds, asked_by=asked_by,
            )
        )  # fmt: skip

    async def read(self, work: "Callable[[Store], T]") -> T:
        """Do some reading, on a thread of its own.

        Raises:
            Refusal: 404, if nothing is recorded; 503, if the database cannot be read now.
        """
        job = partial(work, self.reading())
        try:
            return await asyncio.get_running_loop().run_in_executor(self._readers, job)
        except Unavailable as error:
            raise Refusal(
                503, str(error), kind="records-unavailable", headers={"Retry-After": "5"}
            ) from None

    def opened(self) -> bool:
        """Whether the records can be read."""
        return self._writer is not None and self._writer.store is not None

    def reading(self) -> "Store":
        """The open database.

        Raises:
            Refusal: 404, if nothing is recorded; 503, if the database cannot be read now.
        """
        if self._writer is None:
            raise Refusal(404, OFF)
        if self._writer.store is None:
            trouble = self._writer.trouble or "The database is being opened."
            raise Refusal(503, trouble, kind="records-unavailable", headers={"Retry-After": "5"})
        return self._writer.store

    def report(self) -> RecordsReport:
        """Whether flights are recorded."""
        if self._writer is None:
            return RecordsReport(status="off", message=OFF)
        trouble = self._writer.trouble
        if not self._writer.lives():
            trouble = "Recording stopped by a mistake of the server: its log has the details."
        return RecordsReport(status="waiting" if trouble else "on", message=trouble)

    def measure(self) -> Iterator[Metric]:
        """What is counted, for Prometheus."""
        if self._writer is None:
            return
        counts = self._writer.counts
        yield GaugeMetricFamily(
            "relguide_records_up",
            "Whether the database can be written.",
            value=not self._writer.trouble,
        )
        for name, value, said in (
            ("batches", counts.saved, "Batches saved."),
            ("failures", counts.failed, "Attempts to save that failed."),
            ("documents_lost", counts.documents_lost, "Documents not kept."),
            ("commands_lost", counts.commands_lost, "Commands not kept."),
            ("plans_lost", counts.plans_lost, "Plans not kept, too many a second."),
            ("clearances_lost", counts.clearances_lost, "Changes of clearances not kept."),
        ):
            yield CounterMetricFamily(f"relguide_records_{name}", said, value=value)


def records_service(
    *,
    records: str,
    database_url: str,
    data: str,
    record_plans: int,
    keep_days: float,
    keep_mb: float,
) -> RecordsService:
    """The records that an operator's settings ask for.

    Args:
        records: `on` or `off`.
        database_url: where; a file of its own if empty.
        data: the folder of the records' file; the user's folder for data if empty.
        record_plans: plans a second that are kept.
        keep_days: how long records are kept.
        keep_mb: how much the documents of flights may take.
    """
    clock = Clock()
    if records == "off":
        return RecordsService(clock=clock)
    run, started_at, software = secrets.token_hex(8), time.time(), version("relguide")

    def open_store() -> "Store":
        from relguide_server.records.database import url_of
        from relguide_server.records.store import Store

        url = url_of(database_url, _folder(data))
        return Store(url, run=run, version=software, started_at=started_at)

    writer = Writer(
        open_store,
        run=run,
        version=software,
        limits=RetentionLimits(age=keep_days * DAY, size=keep_mb * 1e6),
        clock=clock,
    )
    return RecordsService(writer, plans=record_plans, clock=clock)


def records_outlook(*, records: str, database_url: str, data: str) -> str:
    """What a start with these settings would do to the records, in a sentence.

    Raises:
        Unavailable: if they could not be kept.
    """
    if records == "off":
        return OFF
    from relguide_server.records.database import outlook, url_of

    return outlook(url_of(database_url, _folder(data)))


def _folder(data: str) -> Path:
    return Path(data) if data else user_data_path("relguide", appauthor=False)


async def records_of(connection: HTTPConnection) -> RecordsService:
    """The records of the app that serves this connection."""
    records: RecordsService = connection.app.state.records
    return records


RecordsOf = Annotated[RecordsService, Depends(records_of)]
"""How a route asks for it."""
