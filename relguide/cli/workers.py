"""Who makes the parts of a data set or an audit, and what comes of them."""

import os
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import TypeVar

from relguide.cli.output import say
from relguide.parallel.pool import start_threads
from relguide.planning.progress import progress_bar

T = TypeVar("T")


@contextmanager
def start_workers(threads: int | None, scheduler: str | None) -> Iterator[Executor]:
    """This process's threads, or a Dask cluster.

    Args:
        threads: how many; 0 or `None` for all cores.
        scheduler: of the cluster, as an address; `None` for this machine.
    """
    if scheduler is None:
        with start_threads(threads or os.cpu_count() or 1) as pool:
            yield pool
        return
    from relguide.parallel.cluster import cluster

    with cluster(scheduler, say) as machines:
        yield machines


def collect(chunks: Iterator[tuple[int, T]], title: str, total: int) -> dict[int, T]:
    """Chunks by their number, with a bar.

    Args:
        chunks: each with its number, in any order.
        title: what the bar is called.
        total: how many there are.
    """
    found: dict[int, T] = {}
    with progress_bar(title, total=total) as advance:
        for number, chunk in chunks:
            found[number] = chunk
            advance(1.0)
    return found
