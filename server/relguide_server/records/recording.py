"""The recording of a flight: its documents as chunks of deflated JSON lines, and its figures.

The newest chunk is written again, longer, at each flush until it is full. So a database holds a
row for some dozens of documents, which deflates to a seventh, and yet misses at most the last
half second.
"""

import zlib
from dataclasses import dataclass, field
from typing import Any

import orjson

from relguide.contract.recorder import VERSION
from relguide.contract.wire import dumps
from relguide.flying.documents import (
    Alert,
    Document,
    FlightEnded,
    PlanChanged,
    Sample,
    SeparationLost,
)
from relguide_server.records.entries import Began, Commanded, Ended, FlownDocument, Outcome

Row = dict[str, Any]
"""Values by column."""
CHUNK = 64 * 1024
"""A chunk is full when its lines have so many bytes."""


@dataclass(slots=True)
class DocumentChunk:
    """Documents of a flight that follow one another."""

    first: int
    """Number of the first one."""
    t: float
    """Flight time of the first one [s]."""
    lines: list[bytes] = field(default_factory=list)
    size: int = 0
    """Of the lines [bytes]."""

    def pack(self) -> bytes:
        """Its lines, deflated."""
        return zlib.compress(b"".join(self.lines), 6)


@dataclass(slots=True)
class Rows:
    """What is to be saved together, by table."""

    flights: list[Row] = field(default_factory=list)
    chunks: list[Row] = field(default_factory=list)
    commands: list[Row] = field(default_factory=list)
    plans: list[Row] = field(default_factory=list)
    clearances: list[Row] = field(default_factory=list)

    def __bool__(self) -> bool:
        return bool(self.flights or self.chunks or self.commands or self.plans or self.clearances)

    def add(self, other: "Rows") -> None:
        """Save the others too."""
        self.flights += other.flights
        self.chunks += other.chunks
        self.commands += other.commands
        self.plans += other.plans
        self.clearances += other.clearances


def lines_of(body: bytes) -> list[bytes]:
    """The documents of a packed chunk as JSON lines."""
    return zlib.decompress(body).splitlines(keepends=True)


class Recording:
    """A flight that is recorded: what of it is not yet saved."""

    def __init__(self, began: Began) -> None:
        self.card = began.card
        self.started_at = began.at
        self.ended_at: float | None = None
        self.outcome: Outcome = "flying"
        self.lost = 0
        self.held = 0
        """Bytes of JSON that are not saved yet, at most."""
        self._documents = 0
        self._saved_size = 0
        self._figures: dict[str, Any] = {
            "simulated_s": 0.0,
            "joined": False,
            "join_time_s": None,
            "least_separation_m": None,
            "plans": 0,
            "alerts": 0,
            "losses": 0,
        }
        self._chunks: list[DocumentChunk] = []
        """The one that is being filled, if there is one."""
        self._packed: list[dict[str, Any]] = []
        """Full ones that are not saved yet."""
        self._commands: list[dict[str, Any]] = []
        self._numbered = 0
        self._changed = True

    @property
    def over(self) -> bool:
        """Whether nothing follows."""
        return self.ended_at is not None

    def add(self, flown: FlownDocument) -> None:
        """Add a document, which is newer than all before.

        Raises:
            ValueError: if a number in it is not finite.
        """
        line = dumps(flown.document) + b"\n"
        self._note(flown.document)
        if (
            not self._chunks
            or self._chunks[-1].size >= CHUNK
            or flown.number != self._chunks[-1].first + len(self._chunks[-1].lines)
        ):
            self._close_chunk()
            self._chunks.append(DocumentChunk(flown.number, flown.document.t))
        chunk = self._chunks[-1]
        chunk.lines.append(line)
        chunk.size += len(line)
        self.held += len(line)
        self._documents = flown.number + 1
        self._changed = True

    def skip(self, number: int) -> None:
        """Leave a document out, as too much waits."""
        self.lost += 1
        self._documents = number + 1
        self._changed = True

    def command(self, commanded: Commanded) -> None:
        """Add a command."""
        self._commands.append(
            {
                "flight_id": self.card.id,
                "number": self._numbered,
                "at": commanded.at,
                "t": commanded.t,
                "body": commanded.body,
                "sent_by": commanded.sent_by,
            }
        )
        self._numbered += 1
        self.held += len(commanded.body)

    def end(self, ended: Ended) -> None:
        """Nothing follows; a flight that said itself why it ended keeps that reason."""
        self.ended_at = ended.at
        if self.outcome == "flying":
            self.outcome = ended.outcome
        self.lost += ended.lost
        self._changed = True

    # -- to be saved ------------------------------------------------------------------------------

    def rows(self, run: str, version: str) -> Rows:
        """What is to be saved of it now: everything since the last time it was saved."""
        if not (self._changed or self._commands):
            return Rows()
        fresh = [*self._packed, *(self._row(chunk) for chunk in self._chunks)]
        flight = {
            "id": self.card.id,
            "run": run,
            "scenario": self.card.scenario,
            "title": self.card.title,
            "request": self.card.request,
            "settings": self.card.settings,
            "seed": self.card.seed,
            "version": version,
            "form": VERSION,
            "requested_by": self.card.requested_by,
            "started_at": self.started_at,
            "ended_at": self.ended_at,
            "outcome": self.outcome,
            "documents": self._documents,
            "lost": self.lost,
            "size": self._saved_size + sum(len(row["body"]) for row in fresh),
            "figures": orjson.dumps(self._figures).decode(),
        }
        return Rows(flights=[flight], chunks=fresh, commands=[*self._commands])

    def note_saved(self) -> None:
        """All that `rows` gave is saved."""
        self._saved_size += sum(len(row["body"]) for row in self._packed)
        self._packed, self._commands = [], []
        self.held = self._chunks[-1].size if self._chunks else 0
        self._changed = False

    def note_replaced(self) -> None:
        """The database has been replaced by an empty one: what is known is to be saved again."""
        self._changed = True

    def _close_chunk(self) -> None:
        for chunk in self._chunks:
            self._packed.append(self._row(chunk))
        self._chunks = []

    def _row(self, chunk: DocumentChunk) -> dict[str, Any]:
        return {
            "flight_id": self.card.id,
            "first": chunk.first,
            "count": len(chunk.lines),
            "t": chunk.t,
            "body": chunk.pack(),
        }

    def _note(self, document: Document) -> None:
        figures = self._figures
        figures["simulated_s"] = document.t
        match document:
            case Sample(guidance=guidance) if guidance:
                figures["least_separation_m"] = guidance[0].least_separation
                if guidance[0].joined and not figures["joined"]:
                    figures["joined"], figures["join_time_s"] = True, document.t
            case PlanChanged():
                figures["plans"] += 1
            case Alert(cleared=False):
                figures["alerts"] += 1
            case SeparationLost():
                figures["losses"] += 1
            case FlightEnded(reason=reason):
                self.outcome = reason
            case _:
                pass
