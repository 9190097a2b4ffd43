"""What do attackers do to the others? Some of each kind against a service, with a table.

    python -m benchmarks.service.attacks --seconds 6
    python -m benchmarks.service.attacks --kind batches

The others plan what is planned at once, on connections that they keep and on new ones, plan what
takes a worker, and watch a flight of theirs. Their times
are measured before each attack and during it. The event loop is watched from inside: how long it
was held up at most by its own work (`loop`, of the processor). At last the service is ended by
SIGTERM, still under attack.
"""

import argparse
import asyncio
import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import uvloop
from rich.console import Console
from rich.table import Table
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from benchmarks.options import positive
from benchmarks.service.attackers import COUNTS, KINDS
from benchmarks.service.load import Load, put_load, put_new_load, request
from benchmarks.service.service import Service, running
from benchmarks.service.situations import HEAD_ON, STRAIGHT
from relguide.contract.protocol import PROTOCOL

PLANS = "/api/v1/plans"
AT_ONCE = request("POST", PLANS, json.dumps(STRAIGHT).encode())
BY_WORKER = request("POST", f"{PLANS}?include=alternatives", json.dumps(HEAD_ON).encode())
OWNER, OTHERS = "127.0.1.1", "127.0.1.2"
"""Where the others ask from: the flight is the first one's."""
BEGUN = 1.5
"""How long attackers have to begin [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Others:
    """How the others fared for a while."""

    at_once: Load
    new: Load
    """The same, on a new connection each."""
    by_worker: Load
    ticks: float
    """A second, of a stream."""
    loop: float
    """How long the loop was held up at most by its own work [ms]."""
    wall: float
    """The same by the wall: the whole machine's other work counts [ms]."""

    @property
    def refused(self) -> int:
        """Answers that were no plans."""
        asked = (self.at_once, self.new, self.by_worker)
        statuses: Counter[int] = sum((load.statuses for load in asked), Counter())
        return statuses.total() - statuses[200]


@dataclass(frozen=True, slots=True, kw_only=True)
class Attacked:
    """What an attack did."""

    kind: str
    before: Others
    during: Others
    stopped: float
    """How long the service took to end [s]."""


def main(arguments: list[str] | None = None) -> int:
    """Attack by each kind, and print a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--seconds", type=positive, default=6, help="of each measurement")
    parser.add_argument("--attackers", type=positive, help="of a kind, if not as usual")
    parser.add_argument("--kind", choices=KINDS, action="append")
    given = parser.parse_args(arguments)
    console = Console(width=130)
    console.print(
        table(
            [
                attack(kind, given.attackers or COUNTS.get(kind, 6), given.seconds)
                for kind in given.kind or KINDS
            ]
        )
    )
    return 0


def attack(kind: str, count: int, seconds: float) -> Attacked:
    """Measure the others before and during an attack, and end the service under it."""
    with running() as service:
        flight = service.get("/api/v1/flights", "POST", {"scenario": "fig_6b"}, OWNER)["id"]
        uvloop.run(measure(service, flight, 1.0))  # whose first requests load what they need
        before = uvloop.run(measure(service, flight, seconds))
        with attackers(service, kind, count):
            uvloop.run(asyncio.sleep(BEGUN))
            during = uvloop.run(measure(service, flight, seconds))
            return Attacked(kind=kind, before=before, during=during, stopped=service.stop())


@contextmanager
def attackers(service: Service, kind: str, count: int) -> Iterator[None]:
    """Attackers in a process of their own."""
    process = subprocess.Popen(
        [sys.executable, "-m", "benchmarks.service.attackers", str(service.port), kind, str(count)]
    )
    try:
        yield
    finally:
        process.kill()
        process.wait()


async def measure(service: Service, flight: str, seconds: float) -> Others:
    """How the others fare for a while."""
    await asyncio.to_thread(service.get, "/blocked")
    ticks = 0

    async def watch() -> None:
        nonlocal ticks
        url = f"ws://127.0.0.1:{service.port}/api/v1/flights/{flight}/stream"
        async with connect(
            url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None, local_addr=(OWNER, 0)
        ) as stream:
            async for _ in stream:
                ticks += 1

    watching = asyncio.create_task(watch())
    port, rest = service.port, {"seconds": seconds, "address": OTHERS}
    at_once, new, by_worker = await asyncio.gather(
        put_load(port, [AT_ONCE], connections=4, pause=0.02, **rest),
        put_new_load(port, AT_ONCE, pause=0.02, **rest),
        put_load(port, [BY_WORKER], connections=1, pause=0.1, **rest),
    )
    watching.cancel()
    held = await asyncio.to_thread(service.get, "/blocked")
    return Others(
        at_once=at_once,
        new=new,
        by_worker=by_worker,
        ticks=ticks / seconds,
        loop=held["processor_ms"],
        wall=held["wall_ms"],
    )


def table(found: Sequence[Attacked]) -> Table:
    """What was measured, for people; of each pair the first is before the attack."""
    drawn = Table()
    for heading in (
        "",
        "p99 at once",
        "on new ones",
        "p99 by worker",
        "ticks/s",
        "loop",
        "(wall)",
        "no plan",
        "end",
    ):
        drawn.add_column(heading, justify="right" if heading else "left")
    for one in found:
        before, during = one.before, one.during
        drawn.add_row(
            one.kind.replace("_", " "),
            f"{_p99(before.at_once)} → {_p99(during.at_once)} ms",
            f"{_p99(before.new)} → {_p99(during.new)} ms",
            f"{_p99(before.by_worker)} → {_p99(during.by_worker)} ms",
            f"{before.ticks:.1f} → {during.ticks:.1f}",
            f"{before.loop:.0f} → {during.loop:.0f} ms",
            f"{before.wall:.0f} → {during.wall:.0f} ms",
            f"{during.refused}",
            f"{one.stopped:.1f} s",
        )
    return drawn


def _p99(load: Load) -> str:
    return f"{load.percentile(99):.0f}" if load.latencies else "∞"


if __name__ == "__main__":
    sys.exit(main())
