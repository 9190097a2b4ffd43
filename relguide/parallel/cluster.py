"""cluster(address) → Executor: a Dask cluster's workers, which make the parts of a large work.

A part is the same wherever it is made if the program is the same, so every machine must have this
one: that is checked on connecting, and again with every part, as workers may join later. Needs the
extra `cluster`, which is loaded on connecting.
"""

import errno
import logging
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from time import monotonic
from typing import Any, TypeVar

from relguide.parallel.program import PACKAGES, program
from relguide.planning.extras import need
from relguide.units import Second

T = TypeVar("T")
Client = Any
"""A `distributed.Client`, which is but partly typed."""
REACHED_WITHIN: Second = 10.0
"""How long a scheduler is waited for, at first and once its connection is lost."""
NO_WORKERS: Second = 120.0
"""How long a cluster without workers is waited for: a machine takes about a minute to start."""
COUNTED_EVERY: Second = 2.0
"""Between two looks at how many workers there are."""


@contextmanager
def cluster(address: str, say: Callable[[str], None]) -> Iterator["ClusterExecutor"]:
    """Connect to a Dask cluster.

    Args:
        address: of its scheduler, e.g. tcp://192.0.2.1:8786.
        say: called with a sentence while the cluster has no workers.

    Raises:
        MissingExtra: if Dask is not installed here.
        ValueError: if there is no scheduler at the address, or a machine of the cluster has
            another program.
        OSError: if nobody answers there.
    """
    need("distributed")
    import distributed

    # what it logs of a lost connection, we say in a sentence
    for name in ("distributed", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        connect: Any = distributed.Client
        client = connect(address, timeout=REACHED_WITHIN, set_as_default=False)
    except OSError:
        raise TimeoutError(
            errno.ETIMEDOUT, f"no Dask scheduler answered within {REACHED_WITHIN:g} s", address
        ) from None
    except ValueError as error:
        raise ValueError(f"{address} is no address of a Dask scheduler: {error}.") from None
    try:
        _check_machines(client)
        yield ClusterExecutor(client, address, say)
    except ImportError as missing:  # of a worker that joined later
        raise ValueError(
            f"A machine of the Dask cluster cannot make parts: {missing}."
        ) from missing
    finally:
        client.close()  # which also makes the cluster forget what it has not done yet


class ClusterExecutor(Executor):
    """The workers of a cluster; a `Cluster` of `learn/training/chunks`."""

    def __init__(self, client: Client, address: str, say: Callable[[str], None]) -> None:
        from distributed.scheduler import KilledWorker

        self.losses: tuple[type[Exception], ...] = (KilledWorker, CancelledError)
        self._client = client
        self._address = address
        self._say = say
        # a part asked for again is not the same task, lest its loss be remembered
        self._executor = client.get_executor(pure=False)
        self._cores = 0
        self._counted_at = -COUNTED_EVERY
        self._seen_at = monotonic()
        self._said = False

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """Have one part made."""
        future: Future[T] = self._executor.submit(make_alike, program(), fn, *args, **kwargs)
        return future

    @property
    def cores(self) -> int:
        """How many threads its workers have."""
        now = monotonic()
        if self._client.status == "running" and now - self._counted_at >= COUNTED_EVERY:
            self._counted_at = now
            try:
                self._cores = sum(self._client.nthreads().values())
            except OSError:
                self._cores = 0  # the connection is being lost: `check` says whether for good
        if self._cores:
            self._seen_at, self._said = now, False
        return self._cores

    def check(self) -> None:
        """Raise once the scheduler is gone, or there have been no workers for `NO_WORKERS`."""
        if self._client.status not in ("running", "connecting"):
            raise ConnectionError(
                errno.ECONNRESET,
                f"the Dask scheduler is gone, and did not come back within {REACHED_WITHIN:g} s",
                self._address,
            )
        if self.cores:
            return
        missed = monotonic() - self._seen_at
        if missed > NO_WORKERS:
            raise TimeoutError(
                errno.ETIMEDOUT,
                f"the Dask cluster has had no workers for {NO_WORKERS:g} s",
                self._address,
            )
        if missed > COUNTED_EVERY and not self._said:
            self._said = True
            self._say(f"{self._address} has no workers: waiting up to {NO_WORKERS:g} s for one.")


def make_alike(
    expected: tuple[tuple[str, str], ...], task: Callable[..., T], /, *args: Any, **kwargs: Any
) -> T:
    """Make a part in a worker, if its program is the same as the one that asks.

    Raises:
        ValueError: if its program is another.
    """
    ours = dict(program())
    for name, asked in expected:
        if ours.get(name) != asked:
            from distributed import get_worker

            raise ValueError(
                _differs(f"worker {get_worker().address}", name, ours.get(name), asked)
            )
    return task(*args, **kwargs)


def _check_machines(client: Client) -> None:
    """Refuse machines whose packages are not ours; they could not even read what is sent."""
    seen = client.get_versions(packages=list(PACKAGES))
    machines = {"scheduler": seen["scheduler"]}
    machines |= {f"worker {address}": found for address, found in seen["workers"].items()}
    ours = seen["client"]["packages"]
    for machine, found in machines.items():
        for name in PACKAGES:
            if found["packages"][name] != ours[name]:
                raise ValueError(_differs(machine, name, found["packages"][name], ours[name]))


def _differs(machine: str, name: str, theirs: str | None, ours: str) -> str:
    has = f"has {name} {theirs}" if theirs else f"does not have {name}"
    return (
        f"The Dask {machine} {has}, and here is {ours}: its parts would not be the same. "
        "Install the same relguide on all machines."
    )
