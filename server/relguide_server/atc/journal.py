"""The controllers' stream: documents numbered through all runs of the service, and who listens."""

import time
from collections import deque
from collections.abc import Callable
from itertools import islice

from pydantic_core import to_json

from relguide.atc.documents import AtcDocument, TrafficSeen
from relguide.contract.wire import Place, placed_to_wire
from relguide_server.flights.stream import RESTART, StreamClient
from relguide_server.http.metrics import Metrics

KEPT = 8 * 1024 * 1024
"""So much of what was sent is kept for who comes back [bytes]."""
A_SECOND = 1000
"""Numbers begin at as many as this for each second since 1970: a service that is started again goes
on with higher ones."""


def written(document: AtcDocument, place: Place | None) -> bytes:
    """A document as JSON text.

    Args:
        document: it.
        place: x, y [m] → latitude, longitude [°]; `None` where that is not known.
    """
    return to_json(placed_to_wire(document, place))


def frame(number: int, texts: list[bytes], *, snapshot: bool) -> str:
    """An `AtcFrame`, of documents already written."""
    head = f'{{"kind":"atc","number":{number},"snapshot":{"true" if snapshot else "false"},'
    return f'{head}"documents":[{b",".join(texts).decode()}]}}'


class Journal:
    """What happened, in order. Lives on the event loop."""

    def __init__(
        self,
        snapshot: Callable[[], list[bytes]],
        metrics: Metrics,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Make an empty one.

        Args:
            snapshot: all that stands now, as documents already written.
            metrics: count what is sent.
            clock: tells UTC.
        """
        self._snapshot, self._metrics = snapshot, metrics
        self._number = int(A_SECOND * clock())
        """Of the last document."""
        self._kept: deque[tuple[int, bytes]] = deque()
        self._size = 0
        self._since = self._number
        """All after this number are kept, but for traffic."""
        self._new: list[tuple[bytes, bool]] = []
        """Those that are not sent yet; whether each is more than traffic."""
        self.clients: set[StreamClient] = set()

    def add(self, document: AtcDocument, text: bytes) -> None:
        """A document is new; it is sent with the next `flush`.

        Args:
            document: it.
            text: the same as it is written.
        """
        self._number += 1
        essential = not isinstance(document, TrafficSeen)
        self._new.append((text, essential))
        if essential:
            self._kept.append((self._number, text))
            self._size += len(text)
        while self._size > KEPT:
            self._since, gone = self._kept.popleft()
            self._size -= len(gone)

    def flush(self) -> None:
        """Send what is new to all who listen; nothing is sent where nothing is new."""
        new, self._new = self._new, []
        if not new:
            return
        text = frame(self._number, [text for text, _ in new], snapshot=False)
        for client in self.clients:
            client.offer(text, essential=any(essential for _, essential in new))

    def join(self, first: int | None) -> StreamClient:
        """A new client.

        Args:
            first: number of the first document that it has not had; it gets all from there on, or a
                snapshot where that is too long ago.
        """
        self.flush()
        client = StreamClient(self._beginning(first), self._metrics)
        self.clients.add(client)
        return client

    def leave(self, client: StreamClient) -> None:
        """A client is gone."""
        self.clients.discard(client)

    def dismiss(self) -> None:
        """Tell all who listen that the service stops."""
        for client in self.clients:
            client.close(RESTART, "The service is stopping: it may be back in a moment.")

    def _beginning(self, first: int | None) -> Callable[[], str]:
        """What a client gets first, and whenever it has missed something."""
        missed = first

        def begin() -> str:
            nonlocal missed
            wanted, missed = missed, None
            if wanted is None or not self._since < wanted <= self._number + 1:
                return frame(self._number, self._snapshot(), snapshot=True)
            before = sum(number < wanted for number, _ in self._kept)
            texts = [text for _, text in islice(self._kept, before, None)]
            return frame(self._number, texts, snapshot=False)

        return begin
