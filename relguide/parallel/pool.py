"""start_processes(n), start_threads(n): executors that end at once, whatever ends them.

A thread of this process serves each hand: it takes a task, has it done and keeps the outcome. A
hand is that thread itself, or a process at the other end of a pipe. Each process has a pipe of its
own: one that is killed halfway through an answer ends its pipe and blocks no other.
"""

import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from queue import SimpleQueue
from threading import Thread
from traceback import format_exception
from typing import Any, NamedTuple, TypeVar

T = TypeVar("T")


class Call(NamedTuple):
    """What is to be done."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    named: dict[str, Any]

    def do(self) -> Any:
        """Do it here."""
        return self.function(*self.arguments, **self.named)


Hand = Callable[[Call], Any]
"""Has a call done, and returns or raises what comes of it."""


class Pool(Executor):
    """An executor with a daemon thread for each hand: nothing waits for what they do at the end."""

    def __init__(self) -> None:
        self._tasks = SimpleQueue[tuple[Future[Any], Call] | None]()
        self._threads: list[Thread] = []

    def add(self, hand: Hand) -> None:
        """Let one more hand work."""
        self._threads.append(Thread(target=self._serve, args=(hand,), daemon=True))
        self._threads[-1].start()

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """Have a function called by the next hand that is free."""
        future = Future[T]()
        self._tasks.put((future, Call(fn, args, kwargs)))
        return future

    def finish(self) -> None:
        """Once all that was submitted is done, end the threads."""
        for _ in self._threads:
            self._tasks.put(None)
        for thread in self._threads:
            thread.join()

    def _serve(self, hand: Hand) -> None:
        while (task := self._tasks.get()) is not None:
            future, call = task
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(hand(call))
            except BaseException as error:
                future.set_exception(error)


def count_cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):  # in a container it knows better
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def start_threads(count: int) -> Iterator[Executor]:
    """Threads of this process; what they are at is left undone if an exception ends the work."""
    pool = Pool()
    for _ in range(count):
        pool.add(Call.do)
    yield pool
    pool.finish()


@contextmanager
def start_processes(count: int) -> Iterator[Executor]:
    """Processes of this machine that end with this one, whatever ends it.

    On Linux they begin as copies of this process, with all that it has loaded. An exception, as
    Ctrl-C is, kills them; what they were at is lost.
    """
    context: Any = get_context("fork" if sys.platform == "linux" else "spawn")
    children: list[BaseProcess] = []
    pool = Pool()
    try:
        with _no_interrupt():
            pipes = []
            for _ in range(count):
                ours, theirs = context.Pipe()
                child = context.Process(target=_work, args=(theirs,), daemon=True)
                child.start()
                theirs.close()  # before the next copy is made: the pipe ends with its process
                children.append(child)
                pipes.append(ours)
            # a copy of a process with threads could begin with a lock that is never opened
            for pipe in pipes:
                pool.add(_hand_of(pipe))
        yield pool
        pool.finish()
    finally:
        for child in children:
            child.kill()
        for child in children:
            child.join()


@contextmanager
def _no_interrupt() -> Iterator[None]:
    """Hold Ctrl-C back, and from processes and threads that begin meanwhile keep it away."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _hand_of(pipe: "Connection[Any, Any]") -> Hand:
    """The process at the other end of a pipe."""

    def hand(call: Call) -> Any:
        try:
            pipe.send(call)
            error, result = pipe.recv()
        except (EOFError, OSError) as lost:
            raise BrokenProcessPool("The process that had this ended.") from lost
        if error is not None:
            raise error
        return result

    return hand


def _work(pipe: "Connection[Any, Any]") -> None:
    """What a process does: call after call, until it is killed."""
    gc.freeze()  # what came with the copy is not searched for garbage, which would copy its pages
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_follow_parent, daemon=True).start()
    while True:
        call: Call = pipe.recv()
        answer: tuple[Exception | None, Any]
        try:
            answer = None, call.do()
        except Exception as error:
            error.add_note("".join(format_exception(error)))
            answer = error, None
        pipe.send(answer)


def _follow_parent() -> None:
    """End as soon as the parent has."""
    parent = parent_process()
    assert parent is not None
    parent.join()
    os._exit(1)
