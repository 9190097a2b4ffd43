"""One flight in the air: its worker thread, its documents so far, and its watchers."""

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from relguide.contract.messages import FlightOutcome
from relguide.contract.places import UNANCHORED, Anchor
from relguide.contract.upstream import Upstream
from relguide.contract.wire import tick
from relguide.flying.documents import CommandGiven, Document, FlightEnded, FlightStarted, Sample
from relguide.flying.orders import Command
from relguide.planning.frames import LocalPlane
from relguide.units import Second
from relguide_server.flights.control import Control, Standing
from relguide_server.flights.hands import Hands
from relguide_server.flights.history import History
from relguide_server.flights.pace import Pace
from relguide_server.flights.stream import FLIGHT_BROKEN, FLIGHT_GONE, StreamClient
from relguide_server.flights.watchers import Watchers
from relguide_server.http.errors import run_logged
from relguide_server.http.metrics import Metrics
from relguide_server.http.security_headers import VERSION
from relguide_server.records.clock import date
from relguide_server.records.entries import Outcome
from relguide_server.records.recorder import Recorder
from relguide_server.scene.inbox import Inbox
from relguide_server.scene.stage import SceneStage

LANDING = 1.0
"""How long the thread of a flight may take to end [s]: it looks at each step, and when it plans it
comes to its deadline."""
CLOSEST = 0.03
"""Between two ticks of a flight that is flown by hand: such a one is shown at once [s]."""
SILENT = 0.1
"""After so long it ticks all the same, e.g. while it is paused [s]."""
Source = Callable[[Callable[[float], Iterable[Command]]], Iterator[Document]]
"""A flight to be flown: takes a function that is polled for commands at each step, and gives the
flight's documents in order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightLabel:
    """What identifies a flight from its start to its end."""

    id: str
    scenario: str
    title: str
    replay: bool = False
    """Whether it is a recording, which takes no orders."""
    modelled: bool = False
    """Whether a modelled pilot flies while the autopilot does not: no client then moves a stick."""
    anchor: Anchor = UNANCHORED
    """How its world lies on the earth."""
    reported_leader: str = ""
    """The aircraft of the picture of air traffic that its leader flies as; empty: it is simulated.
    """
    owner: str = ""
    """Who started it, as `access.owner_of` says it."""
    client: str = ""
    """The client in whose share it counts, as `clients.client_of` says it."""
    seed: int = 0
    """Of its random numbers."""

    @property
    def plane(self) -> LocalPlane | None:
        """Where on the earth it is flown; `None` where nobody has said so."""
        return self.anchor if isinstance(self.anchor, LocalPlane) else None


class LiveFlight:
    """A flight and all that belongs to it. Lives on the event loop; `_fly` is another thread."""

    def __init__(
        self,
        label: FlightLabel,
        source: Source,
        *,
        rate: float,
        paused: bool,
        metrics: Metrics,
        recording: Recorder,
    ) -> None:
        self.label = label
        self.pace = Pace(rate=rate, paused=paused)
        self.history = History()
        self.last_seen = asyncio.get_running_loop().time()
        self.broken = False
        self._flown = self._shown = self._counted = False
        self._recording = recording
        self.scene_viewers = 0
        self.watchers, self.viewers = Watchers(label.client), Watchers(label.client)
        self.clients: set[StreamClient] = set()
        self._metrics = metrics
        self._source = source
        self._commands: deque[Callable[[Second], Command]] = deque()
        self._hands = Hands()
        self.control = Control(self._hands)
        self._inbox = Inbox()
        self._saying = threading.Lock()
        self._said: Second = 0.0
        self._shown_at = self.last_seen
        self._showing = False
        self._stage: SceneStage | None = None
        self._flying = asyncio.Event()
        self._measured: tuple[float, float, bool] | None = None
        self._thread = threading.Thread(target=self._run, name=f"flight {label.id}", daemon=True)
        self._loop = asyncio.get_running_loop()
        self._thread.start()

    # -- from outside -----------------------------------------------------------------------------

    @property
    def over(self) -> bool:
        """Whether it has ended, or was stopped by a mistake of ours."""
        return bool(self.history.ended) or self.broken or self._shown

    @property
    def outcome(self) -> FlightOutcome:
        """Why it is over; empty while it flies."""
        if self.broken:
            return "broken"
        for ended in self.history.ended:
            return ended.reason
        return "stopped" if self._shown else ""

    @property
    def started_at(self) -> str:
        """When it began by the wall clock, as RFC 3339 has it; a recording, when it was flown."""
        return date(self._recording.started_at)

    @property
    def recorded(self) -> bool:
        """Whether it is on record."""
        return self._recording.keeps

    @property
    def watched(self) -> bool:
        """Whether a stream or a scene is open on it."""
        return bool(self.clients) or self.scene_viewers > 0

    @property
    def t(self) -> float:
        """Flight time of the newest sample [s]."""
        last = self.history.ended or self.history.newest
        return last[0].t if last else 0.0

    def progress(self, seconds: float) -> tuple[float, float]:
        """How far it flew since it was asked this before, and how far its rate would have it fly.

        Args:
            seconds: how long ago that was [s].

        Returns:
            Both in flight time [s]; zeros where it paused, ended or changed its rate meanwhile.
        """
        now = (self.t, self.pace.rate, self.pace.paused)
        before, self._measured = self._measured, now
        if before is None or before[1:] != now[1:] or self.pace.paused or self.over:
            return 0.0, 0.0
        return now[0] - before[0], seconds * self.pace.rate

    def note_seen(self) -> None:
        """Note that somebody has just asked for it."""
        self.last_seen = self._loop.time()

    def command(self, command: Command) -> None:
        """Pass a command to the flight, which polls for it at its next step."""
        self.command_then(lambda _: command)

    def command_then(self, make: Callable[[Second], Command]) -> None:
        """Pass a command that depends on when the flight polls for it.

        Args:
            make: makes it, in the flight's thread, given that flight time [s].
        """
        self._commands.append(make)

    def say(self, make: Callable[[Second], Document]) -> None:
        """Add a document that the flight does not give by itself; not once it is over.

        Args:
            make: makes it, given its flight time [s].
        """
        with self._saying:
            if not self._flown:
                self._keep(make(self._said))

    async def wait_for_first_sample(self) -> bool:
        """Wait until it flies. False if it broke before its first sample."""
        await self._flying.wait()
        self.collect()
        return bool(self.history.newest)

    def collect(self) -> list[Document]:
        """Take the worker's documents since the last time, and remember them."""
        flown = self._flown  # before the last documents are taken: a flight is over after them
        documents = self._inbox.drain()
        self._shown = flown
        for document in documents:
            self.history.add(document)
            if isinstance(document, FlightEnded):
                self._count_end(document.reason)
        return documents

    def beat(self) -> None:
        """Tick, unless it does so by itself; called `stream_rate` times a second."""
        if not self._hands.flown or self._loop.time() - self._shown_at > SILENT:
            self.tick()

    def tick(self) -> None:
        """Pass the new documents to all watchers."""
        documents = self.collect()
        if self.watched:
            self.note_seen()
        if self._stage is not None:
            self._stage.offer(documents)
        if self.clients:
            text = self._text(documents)  # encoded once for all watchers
            # a snapshot has no orders: what they change is said by others
            essential = any(not isinstance(d, Sample | CommandGiven) for d in documents)
            for client in self.clients:
                client.offer(text, essential=essential)
        self.control.look(over=self.over)
        if self.broken:
            self._count_end("broken")
            self.dismiss(FLIGHT_BROKEN, "This flight was stopped by a mistake of the server.")

    def join(self) -> StreamClient:
        """A new client of the stream."""
        client = StreamClient(lambda: self._text(self.history.documents()), self._metrics)
        self.clients.add(client)
        return client

    def leave(self, client: StreamClient) -> None:
        """A client of the stream is gone."""
        self.clients.discard(client)
        self.control.release(client)
        self.note_seen()

    def hear(self, client: StreamClient, frame: Upstream, *, may_command: bool) -> None:
        """A client of the stream has sent a frame.

        Args:
            client: it.
            frame: what it sent.
            may_command: whether it may command this flight.
        """
        for started in self.history.started:
            standing = Standing(
                started=started,
                over=self.over,
                replay=self.label.replay,
                modelled=self.label.modelled,
                rate=self.pace.rate,
                may_command=may_command,
            )
            self.control.hear(client, frame, standing)

    async def enter_scene(self) -> str:
        """Count one more viewer of the scene, which is set up for the first.

        Returns:
            Host and port of the scene's own server; empty if it could not be set up.
        """
        self.scene_viewers += 1
        if self._stage is None:
            self._stage = SceneStage(self.label.id, self.history.documents(), self.label.plane)
        return await self._stage.address()

    async def leave_scene(self) -> None:
        """Count one viewer less; the scene is closed after the last."""
        self.scene_viewers -= 1
        self.note_seen()
        if self.scene_viewers == 0 and self._stage is not None:
            stage, self._stage = self._stage, None
            await stage.close()

    def dismiss(self, code: int, reason: str) -> None:
        """End all streams with a sentence."""
        for client in self.clients:
            client.close(code, reason)

    async def land(self, outcome: Outcome) -> None:
        """End it now: close its streams and its scene, and wait for its thread.

        Args:
            outcome: what is recorded of it, if it has not ended by itself.
        """
        self.pace.stop()
        self._count_end("broken" if self.broken else outcome)
        self.control.end()
        self.dismiss(FLIGHT_GONE, "This flight is over and has been removed.")
        if self._stage is not None:
            stage, self._stage = self._stage, None
            await stage.close()
        await asyncio.to_thread(self._thread.join, LANDING)
        self._recording.end(outcome)

    # -- inside -----------------------------------------------------------------------------------

    def _count_end(self, outcome: str) -> None:
        """Count how it ended, the first time that it is known."""
        if not self._counted:
            self._counted = True
            self._metrics.flights_ended.labels(outcome).inc()

    def _text(self, documents: Sequence[Document]) -> str:
        plane = self.label.plane
        begins = any(isinstance(document, FlightStarted) for document in documents)
        return tick(
            self.label.id,
            t=self.t,
            rate=self.pace.rate,
            paused=self.pace.paused,
            ended=self.over,
            documents=documents,
            place=None if plane is None else plane.to_geodetic,
            origin={"started_at": self.started_at, "version": VERSION} if begins else {},
        ).decode()

    def _run(self) -> None:
        self.broken = not run_logged(f"Flight {self.label.id}", self._fly)
        if self.broken:
            self._recording.end("broken")
        self._note_flying()

    def _fly(self) -> None:
        for document in self._source(self._take_commands):
            self._hands.note(document)
            if not self.pace.wait_until(document.t - self._hands.ahead):
                return
            with self._saying:
                self._keep(document)
                self._flown = isinstance(document, FlightEnded)
            if isinstance(document, Sample):
                if not self._flying.is_set():
                    self._note_flying()
                elif self._hands.flown:
                    self._call(self._show_soon)
        self._flown = True
        self._recording.end("stopped")

    def _keep(self, document: Document) -> None:
        self._said = document.t
        self._inbox.put(document)
        self._recording.add(document)

    def _take_commands(self, t: float) -> Iterator[Command]:
        if self._hands.flown and not t.is_integer():
            # a stick is read when it acts; that of a full second sooner, as guidance plans first
            self.pace.wait_until(t)
        while self._commands:
            yield self._commands.popleft()(t)
        yield from self._hands.orders(t)

    def _note_flying(self) -> None:
        self._call(self._flying.set)

    def _call(self, function: Callable[[], None]) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(function)

    def _show_soon(self) -> None:
        if not self._showing:
            self._showing = True
            self._loop.call_at(max(self._shown_at + CLOSEST, self._loop.time()), self._show)

    def _show(self) -> None:
        self._showing, self._shown_at = False, self._loop.time()
        self.tick()
