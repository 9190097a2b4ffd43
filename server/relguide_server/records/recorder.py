"""The recorder of a flight: passes its documents to the writer."""

from relguide.flying.documents import Document, Sample
from relguide.units import Second
from relguide_server.records.clock import Clock
from relguide_server.records.entries import Ended, FlownDocument, Outcome
from relguide_server.records.writer import Writer

SAMPLE_PERIOD: Second = 1.0
"""Flight time between two samples that are kept; of all other documents each is kept."""


class Recorder:
    """Takes the documents of one flight. This one keeps nothing."""

    keeps = False
    """Whether what it takes can be asked for."""

    def __init__(self, started_at: float) -> None:
        """Begin.

        Args:
            started_at: when the flight began [Unix time, s].
        """
        self.started_at = started_at

    def add(self, document: Document) -> None:
        """Record a document, which is newer than all before."""

    def end(self, outcome: Outcome) -> None:
        """Nothing follows."""


class FlightRecorder(Recorder):
    """Passes the documents of one flight to the writer; of samples, one a second."""

    keeps = True

    def __init__(self, flight_id: str, writer: Writer, clock: Clock, *, started_at: float) -> None:
        super().__init__(started_at)
        self._flight_id, self._writer, self._clock = flight_id, writer, clock
        self._number = self._lost = 0
        self._due = 0.0
        self._over = False

    def add(self, document: Document) -> None:
        """Record a document; called by the flight's own thread."""
        if isinstance(document, Sample):
            if document.t < self._due:
                return
            # 20 steps of 0.05 s are less than a second by a rounding error
            self._due = document.t + SAMPLE_PERIOD - 1e-6
        if not self._writer.put(FlownDocument(self._flight_id, self._number, document)):
            self._lost += 1
        self._number += 1

    def end(self, outcome: Outcome) -> None:
        """Nothing follows; said once more, it changes nothing."""
        if self._over:
            return
        self._over = True
        self._writer.put(
            Ended(flight_id=self._flight_id, at=self._clock.now(), outcome=outcome, lost=self._lost)
        )
