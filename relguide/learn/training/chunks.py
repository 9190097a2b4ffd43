"""gather(task, count, executor): the parts of a large work, made anywhere, each given once.

A part is a function of its number alone, so any executor may make it, as often as need be: this
process's threads, its machine's cores, a cluster of machines.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from typing import Protocol, TypeVar, runtime_checkable

from relguide.units import Second

T = TypeVar("T")
ATTEMPTS = 5
"""How often a part is tried before the whole work fails."""
AHEAD = 4
"""Parts under way for each core: what keeps workers busy, and no more is held in memory."""
LOST: tuple[type[Exception], ...] = (OSError, EOFError)
"""What the end of a worker's connection raises."""
LOOK: Second = 1.0
"""How often a cluster that gives nothing is looked at."""


@runtime_checkable
class Cluster(Protocol):
    """What an executor whose workers come and go says of itself."""

    @property
    def cores(self) -> int:
        """How many there are now."""

    @property
    def losses(self) -> tuple[type[Exception], ...]:
        """What a part's result raises if its worker was lost, beside `LOST`."""

    def check(self) -> None:
        """Raise an OSError that says why, once waiting for more is in vain."""


def gather(task: Callable[[int], T], count: int, executor: Executor) -> Iterator[tuple[int, T]]:
    """Do a work in parts, and give them as they are ready.

    A part whose worker is lost is made again, up to `ATTEMPTS` times in all.

    Args:
        task: makes the part of a number; called in the executor's workers.
        count: how many parts there are.
        executor: where they are made. A `Cluster` is looked at while it is waited for.

    Yields:
        number and result of each part, once; not in order.

    Raises:
        OSError: if the workers of one part were lost too often, or a cluster is.
        BrokenExecutor: if no more can be made there at all.
    """
    cluster = executor if isinstance(executor, Cluster) else None
    lost = LOST + cluster.losses if cluster else LOST
    waiting = list(range(count - 1, -1, -1))
    running: dict[Future[T], int] = {}
    attempts = [0] * count
    try:
        while waiting or running:
            cores = (os.cpu_count() or 1) if cluster is None else cluster.cores
            # with no worker there yet one part is under way, so that there is one to wait for
            while waiting and len(running) < max(AHEAD * cores, 1):
                number = waiting.pop()
                attempts[number] += 1
                running[executor.submit(task, number)] = number
            ready = wait(running, LOOK if cluster else None, FIRST_COMPLETED).done
            if cluster:
                cluster.check()
            for future in ready:
                number = running.pop(future)
                try:
                    result = future.result()
                except BrokenExecutor:
                    raise
                except lost as error:
                    if attempts[number] == ATTEMPTS:
                        raise OSError(
                            f"Part {number} was lost {ATTEMPTS} times, at last by: {error}"
                        ) from error
                    waiting.append(number)
                    continue
                yield number, result
    finally:
        for future in running:
            future.cancel()
