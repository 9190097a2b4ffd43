"""A process that records flights, says what was acknowledged, and is killed at any moment.

`python -m tests.server.records.killed --rounds 100 [--url postgresql://…]` does it a hundred times.
"""

import argparse
import asyncio
import multiprocessing
import random
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection

from relguide_server.records.clock import Clock
from relguide_server.records.entries import Began, Commanded
from relguide_server.records.queries import each_chunk, read_clearance, read_flight
from relguide_server.records.recorder import FlightRecorder

from tests.server.flown import ideal_flight
from tests.server.records.flown_cards import card, noted
from tests.server.records.places import Home

TOGETHER = 4
"""Flights in the air at once."""


@dataclass(frozen=True, slots=True)
class Lost:
    """What one round lost of what was acknowledged."""

    flights: int
    commands: int
    documents: int
    """Gaps among those that are there."""
    clearances: int
    """Changes of clearances."""
    acknowledged: int


FORKS = multiprocessing.get_context("forkserver")
FORKS.set_forkserver_preload(["tests.server.records.places", "tests.server.flown"])


def record(url: str, run: str, said: Connection) -> None:
    """Record flights until killed; say each flight, its commands and clearance, once saved."""
    home = Home(url)
    writer = home.writer(run=run)
    documents = list(ideal_flight(duration=60.0))
    while True:
        names = [f"{run}-{time.monotonic_ns() % 10**10}-{k}" for k in range(TOGETHER)]
        recorders = []
        for name in names:
            writer.put(Began(card(name), time.time()))
            recorders.append(FlightRecorder(name, writer, Clock(), started_at=0.0))
        if asyncio.run(writer.saved(10.0)):
            for name in names:
                said.send((name, None))
        for k, document in enumerate(documents):
            for recorder in recorders:
                recorder.add(document)
            if k % 100 == 99:
                order = f'{{"command": "play", "k": {k}}}'
                writer.put(
                    Commanded(flight_id=names[0], at=0.0, t=document.t, body=order, sent_by="")
                )
                writer.put(noted(names[0], "flying", steps=k + 1))
                if asyncio.run(writer.saved(10.0)):
                    said.send((names[0], k))
        for recorder in recorders:
            recorder.end("removed")


def kill_once(url: str, run: str, after: float) -> Lost:
    """Record in a process of its own, kill it, and look for what it acknowledged.

    Args:
        url: of the database.
        run: name of the run.
        after: how long after its first line it is killed [s].
    """
    reader, writer = FORKS.Pipe(duplex=False)
    process = FORKS.Process(target=record, args=(url, run, writer))
    process.start()
    writer.close()
    whole: list[tuple[str, int | None]] = [reader.recv()]
    time.sleep(after)
    process.kill()
    process.join()
    with suppress(EOFError):
        while True:
            whole.append(reader.recv())
    reader.close()
    home = Home(url)
    store = home.store()
    flights = commands = changes = gaps = 0
    kept = {name: read_flight(store, name) for name, _ in whole}
    for name, order in whole:
        found = kept[name]
        if found is None:
            flights += 1
        elif order is not None:
            commands += order not in [c["command"]["k"] for c in found["commands"]]
            cleared = read_clearance(store, name)
            changes += cleared is None or len(cleared["history"]) <= order
    for name, found in kept.items():
        count = sum(len(lines) for lines in each_chunk(store, name))
        gaps += found is not None and found["documents"] != count + found["lost"]
    home.close()
    return Lost(flights, commands, gaps, changes, len(whole))


def main() -> int:
    """Kill it so many times; 0 if nothing acknowledged was lost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=100)
    parser.add_argument("--url", default="")
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args()
    rng = random.Random(chosen.seed)
    with tempfile.TemporaryDirectory() as folder:
        url = chosen.url or f"sqlite:///{folder}/records.sqlite3"
        rounds = [kill_once(url, f"run{k}", rng.uniform(0.0, 0.8)) for k in range(chosen.rounds)]
    lost = [
        one for one in rounds if any((one.flights, one.commands, one.documents, one.clearances))
    ]
    acknowledged = sum(one.acknowledged for one in rounds)
    sys.stdout.write(
        f"{len(rounds)} kills, {acknowledged} acknowledged, rounds that lost something: {lost}\n"
    )
    return bool(lost)


if __name__ == "__main__":
    sys.exit(main())
