"""in_order(chunks): what is answered by many processes, in the order of the file."""

import gc
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from threading import Thread
from typing import NamedTuple

from relguide.cli.batch.order import BatchOrder
from relguide.cli.batch.source import LineChunk
from relguide.cli.batch.work import AnsweredChunk, answer_chunk
from relguide.learn.training.chunks import AHEAD, ATTEMPTS, LOOK, LOST, Cluster


class Sent(NamedTuple):
    """A chunk under way."""

    chunk: LineChunk
    answered: Future[AnsweredChunk]


def in_order(
    order: BatchOrder,
    chunks: Iterable[LineChunk | None],
    executor: Executor,
    cores: int,
) -> Iterator[tuple[LineChunk, AnsweredChunk]]:
    """Have chunks answered, and give the answers in the order of the file.

    What is under way is a few chunks for each core, so that memory does not grow with the file.
    Where no more can be read for now, all that was is answered first.

    Args:
        order: what is asked.
        chunks: to be answered; `None` where the next would have to be waited for.
        executor: where. A `Cluster` is looked at while it is waited for.
        cores: how many it has, if it is no cluster.

    Raises:
        OSError: if the workers of one chunk were lost too often, or a cluster is.
        ValueError: if a process of this machine was lost.
    """
    cluster = executor if isinstance(executor, Cluster) else None
    waiting: deque[Sent] = deque()

    def send(chunk: LineChunk) -> Future[AnsweredChunk]:
        return executor.submit(answer_chunk, order, chunk)

    try:
        for chunk in chunks:
            if chunk is not None:
                waiting.append(Sent(chunk, send(chunk)))
            ahead = AHEAD * max(cores if cluster is None else cluster.cores, 1)
            while waiting and (
                chunk is None or len(waiting) >= ahead or waiting[0].answered.done()
            ):
                yield _first(waiting, send, cluster)
        while waiting:
            yield _first(waiting, send, cluster)
    finally:
        if cluster is not None:
            for sent in waiting:
                sent.answered.cancel()


def _first(
    waiting: deque[Sent],
    send: Callable[[LineChunk], Future[AnsweredChunk]],
    cluster: Cluster | None,
) -> tuple[LineChunk, AnsweredChunk]:
    """The first chunk under way with its answers; it is sent again if its worker is lost."""
    chunk, answered = waiting.popleft()
    lost = LOST + cluster.losses if cluster else LOST
    for attempt in range(1, ATTEMPTS + 1):
        while cluster is not None and not wait([answered], LOOK).done:
            cluster.check()
        try:
            return chunk, answered.result()
        except BrokenExecutor:
            raise ValueError(
                "A process that plans was ended from outside, maybe for lack of memory."
            ) from None
        except lost as error:
            if attempt == ATTEMPTS:
                raise OSError(
                    f"The lines from {chunk.first} on were lost {ATTEMPTS} times, at last by: "
                    f"{error}"
                ) from error
            answered = send(chunk)
    raise AssertionError


@contextmanager
def start_processes(count: int) -> Iterator[Executor]:
    """Processes of this machine that end with this one, whatever ends it.

    On Linux they begin as copies of this process, with all that it has loaded.
    """
    context = get_context("fork" if sys.platform == "linux" else "spawn")
    others = set(active_children())
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_end_with_parent)
    try:
        yield pool
    except BaseException:
        for child in set(active_children()) - others:
            child.terminate()
        raise
    finally:
        pool.shutdown()


def _end_with_parent() -> None:
    """Leave Ctrl-C to the parent, and follow it if it is killed."""
    gc.freeze()  # what came with the copy is not searched for garbage, which would copy its pages
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = parent_process()
    assert parent is not None

    def follow() -> None:
        parent.join()
        os._exit(1)

    Thread(target=follow, daemon=True).start()
