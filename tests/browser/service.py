"""What the browser tests stand on: the real service in its own process, and a Chromium."""

import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

from playwright.sync_api import Browser, Page, WebSocket, sync_playwright
from playwright.sync_api import Request as HttpRequest

CHROMIUMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
"""Names it goes by; without any of them Playwright's own is taken, if it is installed."""
# No sandbox: containers run as root. WebGL is drawn by the processor. Nothing calls home.
ARGUMENTS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
ROOT = Path(__file__).parents[2]
PATIENCE = 120.0
"""The service may have to compile its kernels first [s]."""


@dataclass(frozen=True, slots=True)
class Service:
    """A running service."""

    url: str
    process: subprocess.Popen[bytes]
    log: Path

    def stop(self, *, at_once: bool = False) -> None:
        """End it as Ctrl-C does, or as a power cut."""
        if at_once:
            self.process.kill()
        else:
            self.process.terminate()
        self.process.wait(20)


@contextmanager
def running_service(folder: Path, port: int | None = None) -> Iterator[Service]:
    """`relguide serve` on a free port, from a folder where nothing else is."""
    port = port or free_port()
    log = folder / f"serve-{port}-{time.monotonic_ns()}.log"
    with log.open("wb") as output:
        process = subprocess.Popen(
            [sys.executable, "-m", "relguide", "serve", "--port", str(port)],
            cwd=folder,
            stdout=output,
            stderr=subprocess.STDOUT,
            env={
                **os.environ,
                "RELGUIDE_DATA": str(folder),
                "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "server"))),
            },
        )
    service = Service(f"http://127.0.0.1:{port}", process, log)
    try:
        await_ready(service)
        yield service
    finally:
        if process.poll() is None:
            service.stop()


def await_ready(service: Service) -> None:
    """Wait until plans are quick."""
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up and service.process.poll() is None:
        try:
            with urlopen(f"{service.url}/readyz", timeout=2):
                return
        except (URLError, TimeoutError, ConnectionError):  # a 503 is a URLError too
            time.sleep(0.1)
    raise AssertionError(f"The service did not become ready:\n{service.log.read_text()}")


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def running_chromium() -> Iterator[Browser]:
    found = next(filter(None, map(shutil.which, CHROMIUMS)), None)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found, args=list(ARGUMENTS))
        yield browser
        browser.close()


@dataclass(frozen=True, slots=True)
class Watch:
    """What a page complained about, and what came over its WebSockets."""

    complaints: list[str]
    frames: dict[str, int]
    """Frames received, by the kind of socket: "stream" or "scene"."""


def watch(page: Page) -> Watch:
    """Note every error of a page, of its frames and of its requests from now on."""
    noted = Watch([], {"stream": 0, "scene": 0})

    def count(kind: str) -> None:
        noted.frames[kind] += 1

    def failed(request: HttpRequest) -> None:
        # aborted: the page itself called it off, by moving on to another flight or page
        if request.failure != "net::ERR_ABORTED":
            noted.complaints.append(f"{request.url}: {request.failure}")

    def opened(socket: WebSocket) -> None:
        kind = "scene" if "/scene/" in socket.url else "stream"
        socket.on("framereceived", lambda _: count(kind))

    page.on("console", lambda m: noted.complaints.append(m.text) if m.type == "error" else None)
    page.on("pageerror", lambda error: noted.complaints.append(str(error)))
    page.on("requestfailed", failed)
    page.on(
        "response",
        lambda r: noted.complaints.append(f"{r.url}: {r.status}") if r.status >= 400 else None,
    )
    page.on("websocket", opened)
    return noted
