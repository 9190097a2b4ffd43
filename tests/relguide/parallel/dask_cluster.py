"""A Dask cluster of this machine for the tests: a scheduler and workers, each a process."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

from distributed import Client

ROOT = Path(__file__).parents[3]
STARTED_WITHIN = 120.0
"""How long a process may take to start [s]: it imports numba, on cores that others keep busy."""


class LocalCluster:
    """A scheduler and its workers, that may be killed."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self._folder = folder
        self._about = folder / "scheduler.json"
        self._workers: list[subprocess.Popen[bytes]] = []
        self.scheduler = self._begin("dask_scheduler", "--port", "0", "--no-show", **environment)
        deadline = monotonic() + STARTED_WITHIN
        while not self._about.exists() or not self._about.read_text():
            assert self.scheduler.poll() is None, self.log()
            assert monotonic() < deadline, self.log()
            sleep(0.05)
        self.address: str = json.loads(self._about.read_text())["address"]

    def add_worker(self) -> None:
        """Start a worker of one thread, and wait for it."""
        worker = self._begin(
            "dask_worker", "--no-nanny", "--nthreads", "1", "--memory-limit", "0",
            "--local-directory", str(self._folder),
        )  # fmt: skip
        self._workers.append(worker)
        with Client(self.address, timeout=STARTED_WITHIN, set_as_default=False) as client:
            alive = sum(other.poll() is None for other in self._workers)
            client.wait_for_workers(alive, timeout=STARTED_WITHIN)
        assert worker.poll() is None, self.log()

    def kill_worker(self, pid: int) -> None:
        """As a machine ends that loses its power."""
        (worker,) = (worker for worker in self._workers if worker.pid == pid)
        worker.kill()
        worker.wait()

    def log(self) -> str:
        """What its processes have said."""
        return (self._folder / "log.txt").read_text()

    def end(self) -> None:
        """Kill what is left of it."""
        for process in (*self._workers, self.scheduler):
            process.kill()
            process.wait()

    def _begin(self, program: str, *options: str, **environment: str) -> "subprocess.Popen[bytes]":
        with (self._folder / "log.txt").open("ab") as log:
            return subprocess.Popen(
                [
                    sys.executable, "-m", f"distributed.cli.{program}",
                    "--host", "127.0.0.1", "--scheduler-file", str(self._about),
                    "--no-dashboard", "--dashboard-address", "127.0.0.1:0", *options,
                ],
                cwd=ROOT,  # parts may be functions of the tests
                env=os.environ | environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )  # fmt: skip


@contextmanager
def local_cluster(folder: Path, **environment: str) -> Iterator[LocalCluster]:
    """A cluster without workers yet, whose scheduler runs in this environment."""
    found = LocalCluster(folder, environment)
    try:
        yield found
    finally:
        found.end()
