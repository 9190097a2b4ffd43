"""The workers of the service: a bounded queue for each kind of job, and the executors that do them.

Kinds take turns, and so do the clients of a kind, so that none starves another; and of several
hands one is kept for quick plans, so that these never wait for an area. The others run where a
processor would be idle without them. A job that takes longer than it may is killed with its hand,
which is replaced. A client that leaves takes its job with it.
"""

import asyncio
import os
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf
from time import monotonic
from typing import Any, Literal, get_args

from relguide.units import Second
from relguide_server.http.errors import Refusal, log
from relguide_server.http.logs import SeldomLine
from relguide_server.jobs.executors import Executor, ProcessExecutor, ThreadExecutor
from relguide_server.jobs.outcomes import JobDone, Outcome, value_of
from relguide_server.shares.fair_queue import FairQueue

Kind = Literal["plans", "trials", "long_plans", "simulations", "areas", "batches"]
"""What waits in one queue. `plans` take some hundredths of a second; `trials` are plans of clients
of whom it is not known yet that theirs do; what takes longer is begun anew as `long_plans`."""
KINDS: tuple[Kind, ...] = get_args(Kind)
QUICK: tuple[Kind, ...] = ("plans", "trials")
"""What one hand is kept for."""
ABANDONED = 0.5
"""How long a job goes on whose client has left, before its hand is killed [s]: a new hand costs a
second of a processor."""
LOOK = 0.2
"""How often it is looked whether processes may start [s]."""
LOADING = 60.0
"""How long a process may take to get ready [s]: a second, on a machine that does nothing else."""
LOADING_AGAIN = 5.0
"""After so long a process that did not get ready is started again [s]."""
WAITING = 30.0
"""How long a job may wait [s]."""
STILL_WAITING = f"This waited for more than {WAITING:.0f} s: try again in a moment."
STOPPING = "The service is stopping: it may be back in a moment."
INTERRUPTED = "The process that worked on this ended before its time: try again."
THREADS = 4
"""Hands where jobs are done by threads."""
PULSE = 0.1
"""A hand that answered so short a time ago is not asked again whether it does [s]."""
TO_ANSWER = 3.0
"""How long a hand that has nothing else to do may take to answer [s]."""


@dataclass(slots=True, eq=False)
class _Job:
    work: tuple[Callable[..., Any], tuple[Any, ...]]
    patience: float
    heard: Callable[[Any], None] | None = None
    put_at: Second = field(default_factory=monotonic)
    outcome: asyncio.Future[Outcome] = field(
        default_factory=lambda: asyncio.get_running_loop().create_future()
    )

    def end(self, outcome: Outcome | Refusal) -> None:
        """Hand the outcome to who waits for it, if anybody does."""
        if self.outcome.done():
            return
        if isinstance(outcome, Refusal):
            self.outcome.set_exception(outcome)
        else:
            self.outcome.set_result(outcome)

    def settle(self, doing: "asyncio.Future[Outcome]") -> None:
        """Hand over what a hand made of it, if it has come to its end."""
        if doing.cancelled() or doing.exception() is not None:
            return
        outcome = doing.result()
        if self.heard is not None and isinstance(outcome, JobDone):
            self.heard(outcome.value)
        self.end(outcome)


class WorkerPool:
    """Hands and queues. Lives on the event loop, from `start` to `stop`."""

    def __init__(
        self,
        count: int,
        *,
        queue: int,
        note_wait: Callable[[str, Second], None] = lambda kind, waited: None,
    ) -> None:
        """Prepare them.

        Args:
            count: processes; with 0, threads of this process do the jobs.
            queue: most jobs of a kind that wait.
            note_wait: told of each job that is begun its kind, and how long it waited [s].
        """
        self._note_wait = note_wait
        self._hands: Sequence[Executor] = (
            [ProcessExecutor(idle=k > 0) for k in range(count)]
            or [ThreadExecutor() for _ in range(THREADS)]
        )  # fmt: skip
        self._kept = self._hands[0] if len(self._hands) > 1 else None
        self._free: dict[Executor, asyncio.Future[tuple[Kind, _Job]]] = {}
        """Hands that wait for a job."""
        self._waiting: dict[Kind, FairQueue[_Job]] = {kind: FairQueue(queue) for kind in KINDS}
        self._turn, self._quick_turn = deque(KINDS), deque(QUICK)
        self._open: set[_Job] = set()
        self._stopped = False
        self._abandoned = SeldomLine()
        self._ready: set[Executor] = set()
        self._answered = -inf
        """When a hand was last asked whether it answers, and did."""
        self._tasks: list[asyncio.Task[None]] = []
        self.done: dict[Kind, int] = dict.fromkeys(KINDS, 0)
        """Jobs done."""
        self.full: dict[Kind, int] = dict.fromkeys(KINDS, 0)
        """Jobs refused since too many waited."""
        self.killed = 0
        """Hands killed and replaced."""

    @property
    def ready(self) -> bool:
        """Whether a hand has done its first job, so that jobs are answered."""
        return bool(self._ready)

    async def answers(self) -> bool:
        """Whether a hand answers now.

        The first that is ready is asked, if it has nothing to do. One that is busy counts as if it
        answered: it is killed once its job takes too long, as is one that is asked in vain.
        """
        now = asyncio.get_running_loop().time()
        asked = next((hand for hand in self._hands if hand in self._ready), None)
        if asked not in self._free or now - self._answered < PULSE:
            return self.ready
        try:
            await self.do("plans", os.getpid, patience=TO_ANSWER)
        except Refusal:
            return False
        self._answered = now
        return True

    @property
    def waiting(self) -> dict[Kind, int]:
        """Jobs that wait, by kind."""
        return {kind: len(jobs) for kind, jobs in self._waiting.items()}

    @property
    def processes(self) -> list[int]:
        """The ids of the processes that run."""
        executors = [executor for executor in self._hands if isinstance(executor, ProcessExecutor)]
        return [executor.pid for executor in executors if executor.pid]

    @property
    def processor_time(self) -> Second:
        """What all processes spent of a processor until now, those that have ended included [s]."""
        executors = [executor for executor in self._hands if isinstance(executor, ProcessExecutor)]
        return sum(executor.processor_time for executor in executors)

    def has_room(self, kind: Kind, client: str) -> bool:
        """Whether one more job of a client may wait."""
        return self._waiting[kind].has_room(client)

    def start(self, is_warm: Callable[[], bool], load: Callable[[], None]) -> None:
        """Begin to do jobs.

        Args:
            is_warm: whether what jobs need is compiled: until then no process is started, which
                would compile it a second time.
            load: the first job of each process.
        """
        self._stopped = False
        self._tasks = [
            asyncio.create_task(self._serve(executor, is_warm, load)) for executor in self._hands
        ]

    async def stop(self) -> None:
        """End all hands at once, whatever they do, and refuse all jobs."""
        self._stopped = True
        for job in self._open:
            job.end(Refusal(503, STOPPING, kind="stopping", headers={"Retry-After": "5"}))
        for task in self._tasks:
            task.cancel()
        for task in self._tasks:
            with suppress(asyncio.CancelledError):
                await task
        await asyncio.gather(*(executor.drop() for executor in self._hands))
        self._tasks.clear()
        self._ready.clear()

    async def do(
        self,
        kind: Kind,
        work: Callable[..., Any],
        *arguments: Any,
        patience: float,
        client: str = "",
        heard: Callable[[Any], None] | None = None,
    ) -> Any:
        """Do a job, and give what it returns.

        Args:
            kind: whose queue it waits in.
            work: a function of a module.
            arguments: that can be pickled.
            patience: how long it may take once it is begun [s].
            client: whose it is.
            heard: told what it returns, even if the client has left meanwhile.

        Raises:
            Refusal: 503, if too many wait, or it took too long; or what the job refuses.
        """
        queue = self._waiting[kind]
        if self._stopped:
            raise Refusal(503, STOPPING, kind="stopping", headers={"Retry-After": "5"})
        if not self.has_room(kind, client):
            self.full[kind] += 1
            name = kind.replace("_", " ")
            said = f"{len(queue)} {name} wait already, the most that may"
            if not queue.is_full():
                said = (
                    f"{queue.count_of(client)} {name} of yours wait already, the most of a client's"
                )
            raise Refusal(503, f"{said}: try again in a moment.", headers={"Retry-After": "1"})
        job = _Job((work, arguments), patience, heard)
        queue.put(job, client)
        self._open.add(job)
        self._call_hand()
        try:
            async with asyncio.timeout(WAITING + patience):
                return value_of(await job.outcome)
        except TimeoutError:
            raise Refusal(503, STILL_WAITING, headers={"Retry-After": "5"}) from None
        finally:
            self._open.discard(job)
            job.outcome.cancel()  # has no effect on one that is done
            queue.drop(job, client)

    async def _serve(
        self, executor: Executor, is_warm: Callable[[], bool], load: Callable[[], None]
    ) -> None:
        while not is_warm():
            await asyncio.sleep(LOOK)
        while True:
            await self._load(executor, load)
            self._ready.add(executor)
            kind, job = await self._next(executor)
            await self._load(executor, load)  # its process may have ended while it waited
            self._note_wait(kind, monotonic() - job.put_at)
            if not job.outcome.done():  # its client may have left before this hand came to it
                await self._finish(executor, job)
                self.done[kind] += 1

    async def _load(self, executor: Executor, load: Callable[[], None]) -> None:
        """Start the process of a hand that has none, and get it ready; again until it is."""
        while isinstance(executor, ProcessExecutor) and not executor.pid:
            await executor.drop()
            loading = _Job((load, ()), LOADING)
            await self._finish(executor, loading)
            if loading.outcome.exception() is not None:
                await asyncio.sleep(LOADING_AGAIN)

    async def _finish(self, executor: Executor, job: _Job) -> None:
        doing = executor.do(job.work)
        # the hand is free before who waits for the job goes on, and asks for another
        is_over = _first_of(doing, job.outcome)
        doing.add_done_callback(job.settle)
        try:
            with suppress(TimeoutError):
                async with asyncio.timeout(job.patience):
                    await is_over
            if abandoned := not doing.done() and job.outcome.done():
                await asyncio.wait((doing,), timeout=ABANDONED)
            if not doing.done():
                self.killed += 1
                if abandoned:
                    self._abandoned.write("A job whose client had left was ended.")
                else:
                    log.warning("A job took longer than %.1f s and was ended.", job.patience)
                job.end(_too_long(job.patience))
                await self._replace(executor, doing)
            elif (error := doing.exception()) is not None:
                log.error("A job was interrupted", exc_info=error)
                job.end(Refusal(503, INTERRUPTED, headers={"Retry-After": "1"}))
                await self._replace(executor, doing)
        finally:
            doing.cancel()

    async def _replace(self, executor: Executor, doing: "asyncio.Future[Outcome]") -> None:
        self._ready.discard(executor)
        doing.cancel()
        await asyncio.wait((doing,))
        await executor.drop()

    def _call_hand(self) -> None:
        """Give the job that has just been put in to a hand that waits, if one does it."""
        for executor in self._hands:  # the kept one is the first
            waiting = self._free.get(executor)
            if waiting is not None and (kind := self._kind_for(executor)) is not None:
                del self._free[executor]
                waiting.set_result((kind, self._waiting[kind].take()))
                return

    async def _next(self, executor: Executor) -> tuple[Kind, _Job]:
        """What a hand does next, once there is something for it."""
        kind = self._kind_for(executor)
        if kind is not None:
            return kind, self._waiting[kind].take()
        waiting: asyncio.Future[tuple[Kind, _Job]] = asyncio.get_running_loop().create_future()
        self._free[executor] = waiting
        try:
            return await waiting
        finally:
            self._free.pop(executor, None)

    def _kind_for(self, executor: Executor) -> Kind | None:
        """The kind whose turn it is, of those that a hand does; `None` if none waits."""
        turn = self._quick_turn if executor is self._kept else self._turn
        for _ in range(len(turn)):
            kind = turn[0]
            turn.rotate(-1)
            if self._waiting[kind]:
                return kind
        return None


def _first_of(*futures: "asyncio.Future[Any]") -> "asyncio.Future[None]":
    """What is done as soon as one of several is."""
    first: asyncio.Future[None] = asyncio.get_running_loop().create_future()

    def note(_: "asyncio.Future[Any]") -> None:
        if not first.done():
            first.set_result(None)

    for future in futures:
        future.add_done_callback(note)
    return first


def _too_long(seconds: float) -> Refusal:
    return Refusal(
        503,
        f"This took longer than {seconds:.0f} s and was ended: ask for less, or try again.",
        headers={"Retry-After": "5"},
    )
