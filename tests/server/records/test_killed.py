"""What was acknowledged survives `kill -9`; two processes share a database; disks fill up."""

import asyncio
import subprocess
import sys
import time
from pathlib import Path

import pytest
from relguide_server.records.clock import Clock
from relguide_server.records.entries import Began
from relguide_server.records.queries import each_chunk
from relguide_server.records.recorder import FlightRecorder

from tests.server.flown import ideal_flight
from tests.server.records.flown_cards import card
from tests.server.records.killed import FORKS, kill_once, record
from tests.server.records.places import HAS_POSTGRES, NO_POSTGRES, Home, Postgres
from tests.server.records.test_writer import row_of, wait_for


@pytest.mark.slow
@pytest.mark.parametrize("after", [0.05, 0.4])
def test_what_was_acknowledged_survives_a_kill(url: str, after: float) -> None:
    lost = kill_once(url, "killed", after)
    assert (lost.flights, lost.commands, lost.documents, lost.clearances) == (0, 0, 0, 0)
    assert lost.acknowledged >= 4


@pytest.mark.slow
def test_two_processes_share_a_database(url: str) -> None:
    """Both make its tables at once, and both record."""
    pipes = [FORKS.Pipe(duplex=False) for _ in range(2)]
    both = [
        FORKS.Process(target=record, args=(url, run, writer))
        for run, (_, writer) in zip(("one", "two"), pipes, strict=True)
    ]
    for process in both:
        process.start()
    firsts = [reader.recv()[0] for reader, _ in pipes]
    time.sleep(0.5)
    for process in both:
        process.kill()
        process.join()
    home = Home(url)
    store = home.store()
    for (reader, writer), first in zip(pipes, firsts, strict=True):
        names = {first, *(reader.recv()[0] for _ in iter(reader.poll, False))}
        assert all(row_of(store, name)["scenario"] == "ideal" for name in names)
        reader.close()
        writer.close()
    home.close()


FULL = """
import resource, signal, sys, time
from relguide_server.records.clock import Clock
from relguide_server.records.entries import Began
from relguide_server.records.recorder import FlightRecorder
from tests.server.flown import ideal_flight
from tests.server.records.flown_cards import card
from tests.server.records.places import Home
writer = Home(sys.argv[1]).writer()
writer.put(Began(card("one"), 1e9))
recorder = FlightRecorder("one", writer, Clock(), started_at=0.0)
documents = list(ideal_flight(duration=900.0))
half = len(documents) // 2
def wait_for(condition):
    end = time.monotonic() + 20.0
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)
for document in documents[:half]:
    recorder.add(document)
wait_for(lambda: writer.counts.documents)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
limits = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))
for document in documents[half:]:
    recorder.add(document)
wait_for(lambda: writer.trouble)
print(writer.trouble, flush=True)
resource.setrlimit(resource.RLIMIT_FSIZE, limits)
wait_for(lambda: not writer.trouble)
recorder.end("removed")
writer.stop()
print(writer.counts.documents_lost, flush=True)
"""


def test_a_full_disk_is_said_and_what_was_flown_meanwhile_is_saved_later(tmp_path: Path) -> None:
    """No file of the process may grow, which is what a full disk is to it."""
    home = Home(f"sqlite:///{tmp_path}/records.sqlite3")
    done = subprocess.run(
        [sys.executable, "-c", FULL, home.url], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    trouble, lost = done.stdout.splitlines()
    assert "full" in trouble or "disk I/O" in trouble
    assert lost == "0"
    store = home.store()
    count = sum(len(lines) for lines in each_chunk(store, "one"))
    row = row_of(store, "one")
    assert (row["documents"], row["lost"], row["outcome"]) == (count, 0, "joined")
    assert count > 900
    home.close()


@pytest.mark.skipif(not HAS_POSTGRES, reason=NO_POSTGRES)
def test_a_server_that_stops_and_starts_again_is_caught_up_with(server: Postgres) -> None:
    home = Home(server.empty_database())
    writer = home.writer()
    writer.put(Began(card("one"), 1e9))
    recorder = FlightRecorder("one", writer, Clock(), started_at=0.0)
    documents = list(ideal_flight(duration=60.0))
    for document in documents[:400]:
        recorder.add(document)
    assert asyncio.run(writer.saved(5.0))
    server.stop()
    for document in documents[400:]:
        recorder.add(document)
    wait_for(lambda: writer.trouble)
    started = time.monotonic()
    assert asyncio.run(writer.saved(60.0)) is False
    assert time.monotonic() - started < 30.0
    server.start()
    wait_for(lambda: not writer.trouble, 20.0)
    recorder.end("removed")
    writer.stop()
    store = home.store()
    count = sum(len(lines) for lines in each_chunk(store, "one"))
    assert row_of(store, "one")["documents"] == count > 60
    assert writer.counts.documents_lost == 0
    home.close()
