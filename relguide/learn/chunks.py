"""gathered(task, count, executor): the parts of a large work, made anywhere, each given once.

A part is a function of its number alone, so any executor may make it, as often as need be: this
process's threads, its machine's cores, a Dask cluster's `Client.get_executor()`.
"""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from typing import TypeVar

T = TypeVar("T")
ATTEMPTS = 5
"""How often a part is begun before its failure is everybody's."""
AHEAD = 4
"""Parts under way for each of this machine's cores: what keeps workers busy, and no more is held
in memory."""


def gathered(task: Callable[[int], T], count: int, executor: Executor) -> Iterator[tuple[int, T]]:
    """Do a work in parts, and give them as they are ready.

    A part whose worker is lost is made again, up to `ATTEMPTS` times in all.

    Args:
        task: makes the part of a number; called in the executor's workers.
        count: how many parts there are.
        executor: where they are made.

    Yields:
        number and result of each part, once; not in order.

    Raises:
        OSError: if the workers of one part were lost too often.
        BrokenExecutor: if no more can be made there at all.
    """
    waiting = list(range(count - 1, -1, -1))
    running: dict[Future[T], int] = {}
    attempts = [0] * count
    try:
        while waiting or running:
            while waiting and len(running) < AHEAD * (os.cpu_count() or 1):
                number = waiting.pop()
                attempts[number] += 1
                running[executor.submit(task, number)] = number
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                number = running.pop(future)
                try:
                    result = future.result()
                except BrokenExecutor:
                    raise
                except (OSError, EOFError) as error:  # what the end of a worker's connection raises
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
