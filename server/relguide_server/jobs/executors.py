"""Executors do jobs one at a time: a process, or a thread where there are no processes."""

import asyncio
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from relguide.units import Second
from relguide_server.http.errors import log
from relguide_server.jobs.outcomes import Outcome, outcome_of
from relguide_server.jobs.worker import LENGTH

Job = tuple[Callable[..., Any], tuple[Any, ...]]
"""A function of a module and its arguments; for a process, all of them can be pickled."""
END_PATIENCE = 1.0
"""How long a killed process may take to be gone [s]."""


class ExecutorLostError(ConnectionError):
    """A hand ended in the middle of a job."""


class Executor(Protocol):
    """Does a job at a time."""

    def do(self, job: Job) -> "asyncio.Future[Outcome]":
        """Begin a job.

        Returns:
            What comes of it; `ExecutorLostError`, if the hand ends before the job does.
        """
        ...

    async def drop(self) -> None:
        """End it, with the job it is doing; the next job starts it anew."""
        ...


class _Outcomes(asyncio.Protocol):
    """What a process writes: the one outcome that is awaited."""

    def __init__(self) -> None:
        self.outcome: asyncio.Future[Outcome] = asyncio.get_running_loop().create_future()
        self._came = bytearray()
        self.ended = False
        """Whether no more will come."""

    def expect(self) -> "asyncio.Future[Outcome]":
        """The next outcome, once it comes."""
        if not self.ended:
            self.outcome = asyncio.get_running_loop().create_future()
        return self.outcome

    def data_received(self, data: bytes) -> None:
        """A part of an outcome."""
        self._came += data
        size = LENGTH + int.from_bytes(self._came[:LENGTH], "big")
        if len(self._came) >= size > LENGTH:
            outcome: Outcome = pickle.loads(self._came[LENGTH:size])
            self._came.clear()
            if not self.outcome.done():
                self.outcome.set_result(outcome)

    def connection_lost(self, exc: Exception | None) -> None:
        """It writes no more."""
        del exc
        self.ended = True
        if not self.outcome.done():
            self.outcome.set_exception(ExecutorLostError("A worker ended in the middle of a job."))


@dataclass(frozen=True, slots=True)
class _Process:
    """A process that does jobs, with both its pipes."""

    process: "subprocess.Popen[bytes]"
    jobs: asyncio.WriteTransport
    outcomes: _Outcomes
    reading: asyncio.ReadTransport

    def do(self, job: Job) -> "asyncio.Future[Outcome]":
        """As in `Executor`."""
        text = pickle.dumps(job, pickle.HIGHEST_PROTOCOL)
        outcome = self.outcomes.expect()
        self.jobs.write(len(text).to_bytes(LENGTH, "big") + text)
        return outcome


class ProcessExecutor:
    """A process, started with its first job and killed when it is stuck."""

    def __init__(self, *, idle: bool) -> None:
        """One to be started.

        Args:
            idle: whether it runs only where a processor would be idle without it.
        """
        self._idle = idle
        self._started: asyncio.Task[_Process] | None = None
        self._spent: Second = 0.0

    @property
    def processor_time(self) -> Second:
        """What its processes spent of a processor, those that have ended included [s]."""
        return self._spent + (processor_time(self.pid) if self.pid else 0.0)

    @property
    def pid(self) -> int:
        """Of its process; 0 while there is none, or none that lives."""
        if self._started is None or not self._started.done():
            return 0
        started = self._started.result()
        return 0 if started.outcomes.ended else started.process.pid

    def do(self, job: Job) -> "asyncio.Future[Outcome]":
        """As in `Executor`."""
        if self._started is None:
            self._started = asyncio.create_task(_start_process(idle=self._idle))
        if self._started.done():
            return self._started.result().do(job)
        return asyncio.ensure_future(self._do_once_started(job, self._started))

    @staticmethod
    async def _do_once_started(job: Job, starting: "asyncio.Task[_Process]") -> Outcome:
        # one that is cancelled meanwhile is ended by `drop`
        started = await asyncio.shield(starting)
        return await started.do(job)

    async def drop(self) -> None:
        """As in `Executor`."""
        started, self._started = self._started, None
        if started is None:
            return
        ended = await started
        self._spent += processor_time(ended.process.pid)
        ended.process.kill()
        if not ended.jobs.is_closing():  # it is, once the process has died
            ended.jobs.abort()
        ended.reading.close()
        try:
            await asyncio.to_thread(ended.process.wait, END_PATIENCE)
        except subprocess.TimeoutExpired:  # held by the kernel: Python reaps it some time later
            log.warning("A worker that was killed is not gone yet (process %d).", ended.process.pid)


async def _start_process(*, idle: bool) -> _Process:
    # Not by the loop: uvloop forks, and to copy a large process takes it tens of milliseconds.
    process = await asyncio.to_thread(
        subprocess.Popen,
        [sys.executable, "-m", "relguide_server.jobs.worker", *(["--idle"] if idle else [])],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
    )
    loop = asyncio.get_running_loop()
    jobs, _ = await loop.connect_write_pipe(asyncio.BaseProtocol, process.stdin)
    reading, outcomes = await loop.connect_read_pipe(_Outcomes, process.stdout)
    return _Process(process, jobs, outcomes, reading)


def processor_time(pid: int) -> Second:
    """What a process has spent of a processor [s]; 0 where the system does not say so."""
    try:
        with open(f"/proc/{pid}/stat") as file:
            fields = file.read().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")  # in and for it


class ThreadExecutor:
    """A thread for each job: for planners that no other process can be given."""

    def do(self, job: Job) -> "asyncio.Future[Outcome]":
        """As in `Executor`; without `ExecutorLostError`."""
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
        return answer

    async def drop(self) -> None:
        """A thread cannot be ended: its outcome goes nowhere."""
