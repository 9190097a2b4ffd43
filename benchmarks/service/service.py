"""A service in a process of its own, begun and ended here."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from http.client import HTTPConnection
from tempfile import TemporaryDirectory
from typing import Any

READY = 300.0
"""How long it may take to be ready [s]: kernels may have to be compiled."""


@dataclass(frozen=True, slots=True)
class Service:
    """A running service."""

    port: int
    process: subprocess.Popen[bytes]

    def get(
        self, path: str, method: str = "GET", body: object = None, address: str = "127.0.0.1"
    ) -> Any:
        """What it answers to who asks from an address, as JSON.

        Raises:
            OSError: if it does not, or answers with a problem.
        """
        data = None if body is None else json.dumps(body).encode()
        asking = HTTPConnection("127.0.0.1", self.port, 30.0, source_address=(address, 0))
        with closing(asking):
            asking.request(method, path, data, {"Content-Type": "application/json"})
            answer = asking.getresponse()
            text = answer.read()
        if answer.status >= 400:
            raise OSError(f"{method} {path}: {answer.status} {text.decode()}")
        return json.loads(text) if text else None

    def processor_time(self) -> float:
        """Of its own process, without workers [s]."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def stop(self) -> float:
        """End it by a signal.

        Returns:
            how long that took [s].
        """
        began = time.monotonic()
        self.process.terminate()
        self.process.wait()
        return time.monotonic() - began


@contextmanager
def running(**settings: object) -> Iterator[Service]:
    """A service that is ready, with settings of its own."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with TemporaryDirectory() as data:
        given = {f"RELGUIDE_{name.upper()}": str(value) for name, value in settings.items()}
        process = subprocess.Popen(
            [sys.executable, "-m", "benchmarks.service.served", str(port)],
            env={**os.environ, "RELGUIDE_DATA": data, **given},
        )
        service = Service(port, process)
        try:
            _wait_until_ready(service)
            yield service
        finally:
            process.kill()
            process.wait()


def _wait_until_ready(service: Service) -> None:
    end = time.monotonic() + READY
    while True:
        try:
            service.get("/readyz")
            return
        except OSError:
            if time.monotonic() > end or service.process.poll() is not None:
                raise
            time.sleep(0.2)
