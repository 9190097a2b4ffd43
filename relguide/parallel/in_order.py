"""in_order(task, chunks): chunks of a work, done by many, each given in its order."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, wait
from typing import Protocol, TypeVar

from relguide.learn.training.chunks import AHEAD, ATTEMPTS, LOOK, LOST, Cluster


class Chunk(Protocol):
    """What is done at once."""

    @property
    def name(self) -> str:
        """As a sentence begins that is about it."""


C = TypeVar("C", bound=Chunk)
D = TypeVar("D")


def in_order(
    task: Callable[[C], D], chunks: Iterable[C | None], executor: Executor, cores: int
) -> Iterator[tuple[C, D]]:
    """Have chunks done, and give each with what was made of it, in their order.

    What is under way is a few chunks for each core, so that memory does not grow with the work.
    Where no more can be had for now, all that was is done first.

    Args:
        task: what makes something of a chunk, anywhere.
        chunks: to be done; `None` where the next would have to be waited for.
        executor: where. A `Cluster` is looked at while it is waited for.
        cores: how many it has, if it is no cluster.

    Raises:
        OSError: if the workers of one chunk were lost too often, or a cluster is.
        ValueError: if a process of this machine was lost.
    """
    cluster = executor if isinstance(executor, Cluster) else None
    waiting: deque[tuple[C, Future[D]]] = deque()
    try:
        for chunk in chunks:
            if chunk is not None:
                waiting.append((chunk, executor.submit(task, chunk)))
            ahead = AHEAD * max(cores if cluster is None else cluster.cores, 1)
            while waiting and (chunk is None or len(waiting) >= ahead or waiting[0][1].done()):
                yield _first(waiting, task, executor)
        while waiting:
            yield _first(waiting, task, executor)
    finally:
        for _, future in waiting:
            future.cancel()


def _first(
    waiting: deque[tuple[C, Future[D]]], task: Callable[[C], D], executor: Executor
) -> tuple[C, D]:
    """The first chunk under way, once it is done; it is sent again if its worker is lost."""
    chunk, future = waiting.popleft()
    cluster = executor if isinstance(executor, Cluster) else None
    lost = LOST + cluster.losses if cluster else LOST
    for attempt in range(1, ATTEMPTS + 1):
        while cluster is not None and not wait([future], LOOK).done:
            cluster.check()
        try:
            return chunk, future.result()
        except BrokenExecutor:
            raise ValueError(
                "A worker process was ended from outside, maybe for lack of memory."
            ) from None
        except lost as error:
            if attempt == ATTEMPTS:
                raise OSError(
                    f"{chunk.name} were lost {ATTEMPTS} times, at last by: {error}"
                ) from error
            future = executor.submit(task, chunk)
    raise AssertionError
