"""Hands do jobs, one at a time: a process of its own, or a thread where there are no processes."""

import asyncio
import os
import pickle
import sys
import threading
from collections.abc import Callable
from typing import Any, Protocol, cast

from relguide_server.outcomes import Outcome, outcome_of
from relguide_server.worker import LENGTH

Job = tuple[Callable[..., Any], tuple[Any, ...]]
"""A function of a module and its arguments; for a process, all of them can be pickled."""
END_PATIENCE = 1.0
"""How long a killed process may take to be gone [s]."""


class HandLostError(ConnectionError):
    """A hand ended in the middle of a job."""


class Hand(Protocol):
    """Does a job at a time."""

    async def do(self, job: Job) -> Outcome:
        """Do a job.

        Raises:
            HandLostError: if the hand ends before the job does.
        """
        ...

    async def drop(self) -> None:
        """End it, with the job it is doing; the next job starts it anew."""
        ...


class _Pipes(asyncio.SubprocessProtocol):
    """The ends of a process's pipes, and the one outcome that is awaited."""

    def __init__(self) -> None:
        self.outcome: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        self.closed: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._came = bytearray()

    def expect(self) -> "asyncio.Future[bytes]":
        """The next outcome, once it comes."""
        if not self.closed.done():
            self.outcome = asyncio.get_running_loop().create_future()
        return self.outcome

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """A part of an outcome."""
        del fd
        self._came += data
        size = LENGTH + int.from_bytes(self._came[:LENGTH], "big")
        if len(self._came) >= size > LENGTH:
            text = bytes(self._came[LENGTH:size])
            self._came.clear()
            if not self.outcome.done():
                self.outcome.set_result(text)

    def pipe_connection_lost(self, fd: int, exc: Exception | None) -> None:
        """It writes or reads no more."""
        del fd, exc
        if not self.outcome.done():
            self.outcome.set_exception(HandLostError("A worker ended in the middle of a job."))

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone, and its pipes are closed."""
        del exc
        self.closed.set_result(None)


class ProcessHand:
    """A process, started with its first job and killed when it is stuck."""

    def __init__(self) -> None:
        self._started: asyncio.Task[tuple[asyncio.SubprocessTransport, _Pipes]] | None = None

    @property
    def pid(self) -> int:
        """Of its process; 0 while there is none."""
        if self._started is None or not self._started.done():
            return 0
        return self._started.result()[0].get_pid()

    async def do(self, job: Job) -> Outcome:
        """As in `Hand`."""
        if self._started is None:
            self._started = asyncio.create_task(_start_process())
        # one that is cancelled meanwhile is ended by `drop`
        transport, pipes = await asyncio.shield(self._started)
        # uvloop's is no subclass of asyncio's
        jobs = cast(asyncio.WriteTransport, transport.get_pipe_transport(0))
        text = pickle.dumps(job, pickle.HIGHEST_PROTOCOL)
        outcome = pipes.expect()
        jobs.write(len(text).to_bytes(LENGTH, "big") + text)
        done: Outcome = pickle.loads(await outcome)
        return done

    async def drop(self) -> None:
        """As in `Hand`."""
        started, self._started = self._started, None
        if started is None:
            return
        transport, pipes = await started
        transport.close()  # kills it
        async with asyncio.timeout(END_PATIENCE):
            await pipes.closed


async def _start_process() -> tuple[asyncio.SubprocessTransport, _Pipes]:
    return await asyncio.get_running_loop().subprocess_exec(
        _Pipes,
        sys.executable,
        "-m",
        "relguide_server.worker",
        stderr=None,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )


class ThreadHand:
    """A thread for each job: for planners that no other process can be given."""

    async def do(self, job: Job) -> Outcome:
        """As in `Hand`; without `HandLostError`."""
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Outcome] = loop.create_future()

        def settle(outcome: Outcome) -> None:
            if not answer.done():
                answer.set_result(outcome)

        def work() -> None:
            outcome = outcome_of(*job)
            if not loop.is_closed():
                loop.call_soon_threadsafe(settle, outcome)

        # it does not keep the service from ending
        threading.Thread(target=work, name="job", daemon=True).start()
        return await answer

    async def drop(self) -> None:
        """A thread cannot be ended: its outcome goes nowhere."""
