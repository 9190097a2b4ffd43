"""One flight in the air: its worker thread, what it said so far, and who watches it."""

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from relguide.contract.wire import tick
from relguide.flying.documents import Document, Sample
from relguide.flying.orders import Command
from relguide_server.errors import run_logged
from relguide_server.history import History
from relguide_server.inbox import Inbox
from relguide_server.metrics import Metrics
from relguide_server.pace import Pace
from relguide_server.scene_stage import SceneStage
from relguide_server.stream import FLIGHT_BROKEN, FLIGHT_GONE, StreamClient

Source = Callable[[Callable[[float], Iterable[Command]]], Iterator[Document]]
"""A flight to be flown: given what is polled for commands at each step, its documents in order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightLabel:
    """What is written on a flight from its start to its end."""

    id: str
    scenario: str
    title: str


class LiveFlight:
    """A flight and all that hangs on it. Lives on the event loop; only `_fly` is another thread."""

    def __init__(
        self, label: FlightLabel, source: Source, *, rate: float, paused: bool, metrics: Metrics
    ) -> None:
        self.label = label
        self.pace = Pace(rate=rate, paused=paused)
        self.history = History()
        self.last_seen = asyncio.get_running_loop().time()
        self.broken = False
        self.scene_viewers = 0
        self.clients: set[StreamClient] = set()
        self._metrics = metrics
        self._source = source
        self._commands: deque[Command] = deque()
        self._inbox = Inbox()
        self._stage: SceneStage | None = None
        self._airborne = asyncio.Event()
        self._thread = threading.Thread(target=self._run, name=f"flight {label.id}", daemon=True)
        self._loop = asyncio.get_running_loop()
        self._thread.start()

    # -- from outside -----------------------------------------------------------------------------

    @property
    def over(self) -> bool:
        """Whether it has landed, for good or by a mistake of ours."""
        return bool(self.history.ended) or self.broken

    @property
    def watched(self) -> bool:
        """Whether a stream or a scene is open on it."""
        return bool(self.clients) or self.scene_viewers > 0

    @property
    def t(self) -> float:
        """Flight time of the newest sample [s]."""
        last = self.history.ended or self.history.newest
        return last[0].t if last else 0.0

    def seen(self) -> None:
        """Somebody has asked for it just now."""
        self.last_seen = self._loop.time()

    def command(self, command: Command) -> None:
        """Pass a command to the flight; it is polled at the next step."""
        self._commands.append(command)

    async def begun(self) -> bool:
        """Wait for its first sample. False if it broke before it had one."""
        await self._airborne.wait()
        self.collect()
        return bool(self.history.newest)

    def collect(self) -> list[Document]:
        """Take over what the worker has said since the last time."""
        documents = self._inbox.drain()
        for document in documents:
            self.history.add(document)
        return documents

    def tick(self) -> None:
        """A twentieth of a second has passed: tell everybody who watches."""
        documents = self.collect()
        if self.watched:
            self.seen()
        if self._stage is not None:
            self._stage.offer(documents)
        if self.clients:
            text = self._text(documents)  # encoded once, however many watch
            essential = any(not isinstance(d, Sample) for d in documents)
            for client in self.clients:
                client.offer(text, essential=essential)
        if self.broken:
            self._dismiss(FLIGHT_BROKEN, "This flight was stopped by a mistake of the server.")

    def join(self) -> StreamClient:
        """A new client of the stream."""
        client = StreamClient(lambda: self._text(self.history.documents()), self._metrics)
        self.clients.add(client)
        return client

    def leave(self, client: StreamClient) -> None:
        """A client of the stream is gone."""
        self.clients.discard(client)
        self.seen()

    async def enter_scene(self) -> int:
        """One more looks at the scene, which is set up for the first one.

        Returns:
            The port of the scene's own server; 0 if it could not be set up.
        """
        self.scene_viewers += 1
        if self._stage is None:
            self._stage = SceneStage(self.label.id, self.history.documents())
        return await self._stage.port()

    async def leave_scene(self) -> None:
        """One less looks; with the last one the scene is taken down."""
        self.scene_viewers -= 1
        self.seen()
        if self.scene_viewers == 0 and self._stage is not None:
            stage, self._stage = self._stage, None
            await stage.close()

    async def land(self) -> None:
        """End it now: streams are closed, the scene is taken down, the thread is gone."""
        self.pace.stop()
        self._dismiss(FLIGHT_GONE, "This flight is over and has been removed.")
        if self._stage is not None:
            stage, self._stage = self._stage, None
            await stage.close()
        await asyncio.to_thread(self._thread.join, 5.0)

    # -- inside -----------------------------------------------------------------------------------

    def _text(self, documents: Sequence[Document]) -> str:
        return tick(
            self.label.id,
            t=self.t,
            rate=self.pace.rate,
            paused=self.pace.paused,
            ended=self.over,
            documents=documents,
        ).decode()

    def _dismiss(self, code: int, reason: str) -> None:
        for client in self.clients:
            client.close(code, reason)

    def _run(self) -> None:
        self.broken = not run_logged(f"Flight {self.label.id}", self._fly)
        self._tell_airborne()

    def _fly(self) -> None:
        for document in self._source(self._take_commands):
            if not self.pace.hold(document.t):
                return
            self._inbox.put(document)
            if isinstance(document, Sample) and not self._airborne.is_set():
                self._tell_airborne()

    def _take_commands(self, t: float) -> Iterator[Command]:
        del t
        while self._commands:
            yield self._commands.popleft()

    def _tell_airborne(self) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._airborne.set)
