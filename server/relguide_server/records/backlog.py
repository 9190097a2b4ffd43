"""What waits to be saved: reels of flights, and plans; bounded, and what is lost is counted."""

from dataclasses import asdict, dataclass
from typing import Any

from relguide.flying.documents import Sample
from relguide_server.records.entries import (
    Began,
    ClearanceNoted,
    Commanded,
    Ended,
    Entry,
    FlownDocument,
    PlanAsked,
)
from relguide_server.records.noted_clearances import NotedClearances
from relguide_server.records.recording import Recording, Rows

HELD = 32 * 1024 * 1024
"""Most bytes of JSON that wait to be saved: samples are refused from half of it on."""
PLANS_HELD = 10_000
"""Most plans that wait to be saved."""


@dataclass(slots=True)
class Counts:
    """What the writer has done, and what was lost."""

    saved: int = 0
    """Batches."""
    failed: int = 0
    """Attempts to save that failed."""
    documents: int = 0
    documents_lost: int = 0
    commands_lost: int = 0
    plans_lost: int = 0
    clearances_lost: int = 0


class Backlog:
    """Rows to be: lives on the writer's thread, but for `count_lost`."""

    def __init__(self, *, run: str, version: str) -> None:
        """Make an empty one.

        Args:
            run: of the service, that rows belong to.
            version: of relguide.
        """
        self.counts = Counts()
        self._run_id, self._version = run, version
        self._reels: dict[str, Recording] = {}
        self._plans: list[dict[str, Any]] = []
        self._planned = 0
        self._clearances = NotedClearances(run)

    @property
    def flying(self) -> bool:
        """Whether flights are in the air, or clearances live."""
        return bool(self._reels) or self._clearances.live

    def rows(self) -> Rows:
        """What is to be saved now."""
        rows = Rows(plans=[*self._plans], clearances=self._clearances.rows())
        for recording in self._reels.values():
            rows.add(recording.rows(self._run_id, self._version))
        return rows

    def note_saved(self, rows: Rows) -> None:
        """These rows are saved; flights that are over need nothing more."""
        self.counts.saved += bool(rows) or self.flying
        self.counts.documents += sum(row["count"] for row in rows.chunks)
        self._plans = []
        self._clearances.note_saved()
        for recording in list(self._reels.values()):
            recording.note_saved()
            if recording.over:
                del self._reels[recording.card.id]

    def note_replaced(self) -> None:
        """The database may be another one: all of the flights in the air is to be saved again."""
        self._clearances.note_replaced()
        for recording in self._reels.values():
            recording.note_replaced()

    def take(self, entry: Entry, *, trouble: bool) -> None:
        """Keep something until it is saved.

        Args:
            entry: what.
            trouble: whether nothing can be saved now, so that what waits is bounded.
        """
        match entry:
            case Began(card=card):
                self._reels[card.id] = Recording(entry)
            case FlownDocument(flight_id=flight_id) if flight_id in self._reels:
                self._add(self._reels[flight_id], entry, trouble)
            case Commanded(flight_id=flight_id) if flight_id in self._reels:
                self._reels[flight_id].command(entry)
            case Ended(flight_id=flight_id) if flight_id in self._reels:
                self._reels[flight_id].end(entry)
            case PlanAsked():
                self._add_plan(entry)
            case ClearanceNoted():
                self.counts.clearances_lost += not self._clearances.add(entry)
            case _:
                pass  # of a flight that is over

    def _add(self, recording: Recording, flown: FlownDocument, trouble: bool) -> None:
        most = HELD // 2 if isinstance(flown.document, Sample) else HELD
        if trouble and sum(other.held for other in self._reels.values()) > most:
            recording.skip(flown.number)
            self.counts.documents_lost += 1
            return
        try:
            recording.add(flown)
        except ValueError:  # a number in it is not finite: the stream says so as well
            recording.skip(flown.number)
            self.counts.documents_lost += 1

    def _add_plan(self, asked: PlanAsked) -> None:
        if len(self._plans) >= PLANS_HELD:
            self.counts.plans_lost += 1
            return
        self._plans.append({"run": self._run_id, "number": self._planned, **asdict(asked)})
        self._planned += 1

    def count_lost(self, entry: Entry) -> None:
        """Count what is not even taken."""
        match entry:
            case FlownDocument():
                self.counts.documents_lost += 1
            case Commanded():
                self.counts.commands_lost += 1
            case PlanAsked():
                self.counts.plans_lost += 1
            case ClearanceNoted():
                self.counts.clearances_lost += 1
            case Began() | Ended():
                pass
