"""The writer: a thread that saves what it is given, in batches, and lets nobody wait.

What is given to it waits in a bounded queue. While the database cannot be written it keeps what
fits, and counts what does not; it tries again, and saves all that it has kept once it can.
"""

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from relguide.flying.documents import Sample
from relguide.units import Second
from relguide_server.http.errors import log, run_logged
from relguide_server.records.backlog import Backlog
from relguide_server.records.clock import Clock
from relguide_server.records.entries import (
    Began,
    Ended,
    Entry,
    FlownDocument,
    PlanAsked,
    Unavailable,
)

if TYPE_CHECKING:  # with SQLAlchemy: loaded when the database is opened
    from relguide_server.records.store import Store

FLUSH: Second = 0.5
"""How long something waits at most until it is saved."""
QUEUE = 20_000
"""Most entries that wait to be looked at: samples are refused from half of it on."""
RETRY, RETRY_MOST = 0.5, 5.0
"""How long until a database that failed is tried again at first, and at most [s]."""
LAST: Second = 2.0
"""How long the end of the service waits for what is still to be saved."""
WATCH: Second = 3.0
"""How long the count of another run is watched before it is taken to be killed."""
SWEEP: Second = 60.0
"""How often killed runs and old records are looked for."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RetentionLimits:
    """How much is kept."""

    age: Second
    """Records older than this are forgotten."""
    size: float
    """Documents of flights beyond this are forgotten [bytes]."""
    plans: int = 100_000
    """Plans beyond this are forgotten."""


class Writer:
    """Saves entries. `put` is for any thread, `saved` for the event loop."""

    def __init__(
        self,
        open_store: "Callable[[], Store]",
        *,
        run: str,
        version: str,
        limits: RetentionLimits,
        clock: Clock,
    ) -> None:
        self._backlog = Backlog(run=run, version=version)
        self.counts = self._backlog.counts
        self.trouble = ""
        """Why nothing can be saved now; empty if it can, or has not been tried yet."""
        self.store: Store | None = None
        self._open_store = open_store
        self._limits, self._clock = limits, clock
        self._changed = threading.Condition()
        self._queue: deque[Entry] = deque()
        self._hurry = self._stopping = False
        self._ticket = 0
        """Number of the newest entry."""
        self._waiting: list[tuple[int, asyncio.Future[bool]]] = []
        self._retry_at = 0.0
        self._backoff = RETRY
        self._census_at = 0.0
        self._beats: dict[str, int] | None = None
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Begin to save."""
        self._stopping = False
        self._thread = threading.Thread(
            target=run_logged, args=("Recording", self._run), name="records", daemon=True
        )
        self._thread.start()

    def stop(self) -> None:
        """Save what there is, and end."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        if self._thread is not None:
            self._thread.join(LAST)
        if self.store is not None:
            self.store.close()
            self.store = None

    def lives(self) -> bool:
        """Whether its thread runs."""
        return self._thread is not None and self._thread.is_alive()

    def put(self, entry: Entry) -> bool:
        """Give it something to save; never waits.

        Returns:
            False if too much waits already, so that it is lost.
        """
        with self._changed:
            full = QUEUE // 2 if isinstance(entry, FlownDocument | PlanAsked) else QUEUE
            if isinstance(entry, FlownDocument) and not isinstance(entry.document, Sample):
                full = QUEUE
            if len(self._queue) >= full and not isinstance(entry, Began | Ended):
                self._backlog.count_lost(entry)
                return False
            self._queue.append(entry)
            self._ticket += 1
            return True

    async def saved(self, patience: Second) -> bool:
        """Wait until all that it was given so far is saved.

        Args:
            patience: how long to wait [s].

        Returns:
            Whether it is; false at once while the database cannot be written.
        """
        if self.trouble or not self.lives():
            return False
        future: asyncio.Future[bool] = asyncio.get_running_loop().create_future()
        with self._changed:
            self._waiting.append((self._ticket, future))
            self._hurry = True
            self._changed.notify()
        try:
            return await asyncio.wait_for(future, patience)
        except TimeoutError:
            return False

    # -- its thread -------------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            self._write()
        finally:  # whatever ended it, nothing more is saved
            self._tell(inf, saved=False)

    def _write(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._hurry or self._stopping, FLUSH)
                entries, self._queue = self._queue, deque()
                self._hurry = False
                ticket, stopping = self._ticket, self._stopping
            for entry in entries:
                self._backlog.take(entry, trouble=bool(self.trouble))
            if stopping or self._clock.elapsed() >= self._retry_at:
                self._try(ticket)
            if self.trouble:
                self._tell(inf, saved=False)
            if stopping:
                break

    def _try(self, ticket: int) -> None:
        try:
            self._save(ticket)
        except Unavailable as error:
            self.counts.failed += 1
            self._retry_at = self._clock.elapsed() + self._backoff
            self._backoff = min(2.0 * self._backoff, RETRY_MOST)
            if str(error) != self.trouble:
                log.warning("Nothing is recorded for now: %s", error)
            self.trouble = str(error)
            if self.store is not None:
                self.store.close()
                self.store = None

    def _save(self, ticket: int) -> None:
        if self.store is None:
            self.store = self._open_store()
            self._backlog.note_replaced()
        rows = self._backlog.rows()
        if rows or self._backlog.flying:
            self.store.save(rows, now=self._clock.now())
        self._backlog.note_saved(rows)
        if self.trouble:
            log.warning("Flights are recorded again.")
            self.trouble, self._backoff = "", RETRY
        self._tell(ticket, saved=True)
        self._look_around(self.store)

    def _tell(self, last: float, *, saved: bool) -> None:
        """Tell those who wait for entries up to a number whether these are saved."""
        with self._changed:
            told = [future for number, future in self._waiting if number <= last]
            self._waiting = [(number, f) for number, f in self._waiting if number > last]
        for future in told:
            with suppress(RuntimeError):  # the loop is closed: nobody waits any more
                future.get_loop().call_soon_threadsafe(_resolve, future, saved)

    def _look_around(self, store: "Store") -> None:
        """Notice killed runs, a while after the start and now and then, and forget what is old."""
        elapsed = self._clock.elapsed()
        if elapsed < self._census_at:
            return
        if self._beats is None:
            self._beats = store.beats()
            self._census_at = elapsed + WATCH
            return
        now = store.beats()
        still = {run: beat for run, beat in self._beats.items() if now.get(run) == beat}
        if still and (count := store.interrupt(still)):
            log.warning("%d flights were interrupted, as the service was killed.", count)
        self._beats = None
        self._census_at = elapsed + SWEEP - WATCH
        before = self._clock.now() - self._limits.age if self._clock.steady() else 0.0
        if store.forget(before=before, most_bytes=self._limits.size, most_plans=self._limits.plans):
            self._census_at = elapsed  # there may be more


def _resolve(future: asyncio.Future[bool], saved: bool) -> None:
    if not future.done():
        future.set_result(saved)
