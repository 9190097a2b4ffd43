"""Attackers hold up neither the event loop nor who asks for little; docs/service.md has figures.

The bounds here are wide: other tests run beside these. `benchmarks.service.attacks` measures.
"""

import asyncio
import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic, perf_counter, thread_time

import httpx2 as httpx
import pytest
from relguide_server.app import create_app
from relguide_server.planning.tasks import load
from relguide_server.settings import ServiceSettings

from benchmarks.service.attackers import KINDS, attack
from benchmarks.service.situations import STRAIGHT
from tests.server.serving import ideal_catalogue, serve
from tests.server.test_service_life import wait_until

LOOK = 0.005
"""How often the loop is looked at [s]."""
HELD = 0.15
"""CPU time for which the loop may be held up at a time [s]: three times what is promised."""
ANSWERED = 5.0
"""Within so long everybody else is answered [s]; a job of an attacker takes up to ten."""


@contextmanager
def attackers(port: int, kind: str) -> Iterator[None]:
    """Three of them, in a thread."""
    loop = asyncio.new_event_loop()
    task = loop.create_task(attack(port, kind, 3))

    def run() -> None:
        loop.run_until_complete(asyncio.wait([task]))
        loop.close()

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        loop.call_soon_threadsafe(task.cancel)
        thread.join(20.0)
        assert not thread.is_alive()


@pytest.fixture
def small_heap() -> Iterator[None]:
    """A collection of garbage looks at what this test makes, not at what all others left."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.mark.slow
@pytest.mark.usefixtures("small_heap")
@pytest.mark.parametrize("kind", ["heavy_plans", "hang_ups", "frames"])
def test_attackers_hold_up_nobody(kind: str) -> None:
    assert kind in KINDS
    app = create_app(ServiceSettings(workers=2), catalogue=ideal_catalogue())
    held: list[float] = []

    async def watch() -> None:
        while True:
            spent = thread_time()
            await asyncio.sleep(LOOK)
            held.append(thread_time() - spent)

    @app.get("/watch")
    async def begin() -> None:
        app.state.watching = asyncio.create_task(watch())

    load("exact")  # as the rehearsal of a flight does
    with serve(app) as address:
        wait_until(lambda: app.state.workers.ready)
        with httpx.Client(base_url=f"http://{address}", timeout=30.0) as client:
            client.post("/api/v1/plans", json=STRAIGHT)
            client.get("/watch")
            client.post("/api/v1/flights", json={"scenario": "ideal", "paused": True})
            with attackers(int(address.rpartition(":")[2]), kind):
                end, worst = monotonic() + 2.0, 0.0
                while monotonic() < end:
                    began = perf_counter()
                    answer = client.post("/api/v1/plans", json=STRAIGHT)
                    worst = max(worst, perf_counter() - began)
                    assert answer.json()["status"] == "planned"
    assert worst < ANSWERED
    assert max(held) < HELD
