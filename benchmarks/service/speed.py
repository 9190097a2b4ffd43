"""How many plans a second does the service answer, beside `/healthz`, which answers a constant?

    python -m benchmarks.service.speed --seconds 3 --rounds 5
    python -m benchmarks.service.speed --flights 10 --watchers 50

Each is asked on 16 connections, in turn, so that other work on the machine falls on all alike; what
is printed is the median of the rounds. `processor` is the time that the service's own process took
for an answer. `constant` is a route of the framework that reads a body and answers 1.5 kB.
"""

import argparse
import asyncio
import json
import sys
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass
from statistics import median
from time import perf_counter

import uvloop
from relguide_server.planning.plans import EXAMPLE
from rich.console import Console
from rich.table import Table
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from benchmarks.options import positive
from benchmarks.service.load import Load, put_load, request
from benchmarks.service.service import Service, running
from benchmarks.service.situations import STRAIGHT
from relguide.contract.protocol import PROTOCOL

PLANS = "/api/v1/plans"
ASKED = {
    "GET /healthz": request("GET", "/healthz"),
    "POST constant": request("POST", "/constant", json.dumps(EXAMPLE).encode()),
    "POST /plans, straight leader": request("POST", PLANS, json.dumps(STRAIGHT).encode()),
    "POST /plans, turning leader": request("POST", PLANS, json.dumps(EXAMPLE).encode()),
}
"""What is asked, in turn; the first is what the others are compared with."""


@dataclass(frozen=True, slots=True)
class Round:
    """What was measured of one route once."""

    load: Load
    processor: float
    """CPU time of the service for an answer [s]."""


def main(arguments: list[str] | None = None) -> int:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=positive, default=3, help="of each measurement")
    parser.add_argument("--rounds", type=positive, default=5)
    parser.add_argument("--flights", type=int, default=0, help="in the air meanwhile")
    parser.add_argument("--watchers", type=int, default=0, help="of their streams, in all")
    given = parser.parse_args(arguments)
    with running() as service:
        uvloop.run(_measure(service, given))
    return 0


async def _measure(service: Service, given: argparse.Namespace) -> None:
    console = Console(width=110)
    rounds: dict[str, list[Round]] = {name: [] for name in ASKED}
    async with watching(service, flights=given.flights, watchers=given.watchers) as ticks:
        counted, began = sum(ticks), perf_counter()
        for _ in range(given.rounds):
            for name, asked in ASKED.items():
                before = service.processor_time()
                load = await put_load(service.port, [asked], seconds=given.seconds)
                spent = service.processor_time() - before
                rounds[name].append(Round(load, spent / max(len(load.latencies), 1)))
        if ticks:
            spent = perf_counter() - began
            console.print(say_ticks(given.flights, ticks, sum(ticks) - counted, spent))
    console.print(table(rounds))


def say_ticks(flights: int, ticks: list[int], got: int, seconds: float) -> str:
    """How many ticks a second each watcher got, of all that came in a time [s]."""
    rate = got / seconds / len(ticks)
    return f"{flights} flights, {len(ticks)} watchers: {rate:.1f} ticks a second each"


@asynccontextmanager
async def watching(service: Service, *, flights: int, watchers: int) -> AsyncIterator[list[int]]:
    """Let flights fly, and watch them: how many ticks each watcher has got so far."""
    wanted = {"scenario": "fig_6b", "engagement": "engaged"}
    ids = [
        (await asyncio.to_thread(service.get, "/api/v1/flights", "POST", wanted))["id"]
        for _ in range(flights)
    ]
    ticks = [0] * watchers
    tasks = [
        asyncio.create_task(_watch(service.port, ids[k % len(ids)], ticks, k))
        for k in range(watchers)
    ]
    await asyncio.sleep(1.0)
    for task in tasks:
        if task.done():
            task.result()
    yield ticks
    for task in tasks:
        task.cancel()


def table(rounds: dict[str, Sequence[Round]]) -> Table:
    """What was measured, for people."""
    drawn = Table()
    for heading in ("", "a second", "of /healthz", "p50", "p99", "processor"):
        drawn.add_column(heading, justify="right" if heading else "left")
    first = next(iter(rounds.values()))
    for name, runs in rounds.items():
        ratios = [run.load.rate / base.load.rate for run, base in zip(runs, first, strict=True)]
        drawn.add_row(
            name,
            f"{median(run.load.rate for run in runs):,.0f}",
            f"{median(ratios):.2f}",
            f"{median(run.load.percentile(50) for run in runs):.1f} ms",
            f"{median(run.load.percentile(99) for run in runs):.1f} ms",
            f"{median(run.processor for run in runs) * 1e6:.0f} µs",
        )
    return drawn


async def _watch(port: int, flight: str, ticks: list[int], which: int) -> None:
    url = f"ws://127.0.0.1:{port}/api/v1/flights/{flight}/stream"
    async with connect(url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None) as stream:
        async for _ in stream:
            ticks[which] += 1


if __name__ == "__main__":
    sys.exit(main())
