"""What is given to the writer is saved, in order, within a second, and whatever happens to it."""

import asyncio
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import sqlalchemy as sa
from relguide_server.records import database
from relguide_server.records.clock import Clock
from relguide_server.records.entries import (
    Began,
    Commanded,
    Ended,
    PlanAsked,
    Unavailable,
)
from relguide_server.records.recorder import FlightRecorder
from relguide_server.records.recording import lines_of
from relguide_server.records.schema import chunks, commands, flights, plans
from relguide_server.records.store import Store
from relguide_server.records.writer import RetentionLimits, Writer

from relguide.contract.wire import dumps
from relguide.flying.documents import Document, Sample
from tests.server.flown import ideal_flight
from tests.server.records.flown_cards import card
from tests.server.records.places import Home


def wait_for(condition: Callable[[], object], patience: float = 10.0) -> None:
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def documents_of(store: Store, flight_id: str) -> list[tuple[int, bytes]]:
    query = (
        sa.select(chunks.c.first, chunks.c.body)
        .where(chunks.c.flight_id == flight_id)
        .order_by(chunks.c.first)
    )
    with database.reading(store.engine) as connection:
        return [
            (first + k, line)
            for first, body in connection.execute(query)
            for k, line in enumerate(lines_of(body))
        ]


def row_of(store: Store, flight_id: str) -> sa.RowMapping:
    with database.reading(store.engine) as connection:
        found = connection.execute(sa.select(flights).where(flights.c.id == flight_id))
        return found.mappings().one()


def begin(writer: Writer, flight_id: str = "one") -> FlightRecorder:
    writer.put(Began(card(flight_id), 1e9))
    return FlightRecorder(flight_id, writer, Clock(), started_at=0.0)


def thinned(documents: list[Document]) -> list[Document]:
    """Each document, and of samples one a second."""
    return [d for d in documents if not isinstance(d, Sample) or abs(d.t - round(d.t)) < 1e-3]


def test_a_flight_is_saved_as_it_was_flown(home: Home) -> None:
    writer = home.writer()
    recorder = begin(writer)
    documents = list(ideal_flight(duration=300.0))
    for document in documents:
        recorder.add(document)
    recorder.end("removed")
    writer.stop()
    store = home.store()
    kept = documents_of(store, "one")
    assert [line for _, line in kept] == [dumps(d) + b"\n" for d in thinned(documents)]
    assert [number for number, _ in kept] == list(range(len(kept)))
    row = row_of(store, "one")
    assert (row["outcome"], row["lost"], row["documents"]) == ("joined", 0, len(kept))
    assert row["size"] == sum(len(body) for body in bodies(store))


def bodies(store: Store) -> list[bytes]:
    with database.reading(store.engine) as connection:
        return list(connection.scalars(sa.select(chunks.c.body)))


def test_it_is_saved_within_a_second_and_before_it_is_acknowledged(home: Home) -> None:
    writer = home.writer()
    recorder = begin(writer)
    assert asyncio.run(writer.saved(5.0))
    store = home.store()
    assert row_of(store, "one")["outcome"] == "flying"
    writer.put(Commanded(flight_id="one", at=1.0, t=2.0, body="{}", sent_by=""))
    writer.put(
        PlanAsked(at=1.0, body="{}", planner="", status="planned", seconds=1e-4, asked_by="")
    )
    assert asyncio.run(writer.saved(5.0))
    with database.reading(store.engine) as connection:
        assert connection.execute(sa.select(commands.c.t)).all() == [(2.0,)]
        assert connection.execute(sa.select(plans.c.status)).all() == [("planned",)]
    documents = list(ideal_flight(duration=1.0))
    for document in documents[:10]:
        recorder.add(document)
    wait_for(lambda: documents_of(store, "one"), 2.0)
    writer.stop()


def test_a_database_that_is_gone_lets_nobody_wait_and_catches_up(home: Home) -> None:
    gone = True

    def opening() -> Store:
        if gone:
            raise Unavailable("It is gone.")
        return home.store(run="this run")

    writer = home.writer(opening=opening)
    recorder = begin(writer)
    wait_for(lambda: writer.trouble == "It is gone.")
    documents = list(ideal_flight(duration=60.0))
    started = time.monotonic()
    for document in documents:
        recorder.add(document)
    assert asyncio.run(writer.saved(60.0)) is False
    assert time.monotonic() - started < 30.0
    gone = False
    wait_for(lambda: not writer.trouble)
    writer.stop()
    assert len(documents_of(home.store(), "one")) == len(thinned(documents))
    assert writer.counts.documents_lost == 0


def test_what_does_not_fit_is_counted_samples_first(
    home: Home, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = True

    def opening() -> Store:
        if gone:
            raise Unavailable("It is gone.")
        return home.store(run="this run")

    monkeypatch.setattr("relguide_server.records.backlog.HELD", 60_000)
    writer = home.writer(opening=opening)
    recorder = begin(writer)
    wait_for(lambda: writer.trouble)
    documents = list(ideal_flight(duration=200.0))
    for document in documents:
        recorder.add(document)
    recorder.end("removed")
    wait_for(lambda: writer.counts.documents_lost)
    gone = False
    wait_for(lambda: not writer.trouble)
    writer.stop()
    store = home.store()
    kept, row = documents_of(store, "one"), row_of(store, "one")
    assert row["lost"] == writer.counts.documents_lost > 100
    assert row["documents"] == len(kept) + row["lost"] == len(thinned(documents))
    assert kept[-1][0] == row["documents"] - 1  # the last one says how it ended
    assert row["outcome"] == "joined"


def test_a_killed_run_is_interrupted_and_a_running_one_is_not(
    home: Home, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide_server.records.writer.WATCH", 3.0)
    killed = home.writer(run="killed")
    begin(killed, "of the killed")
    assert asyncio.run(killed.saved(5.0))
    monkeypatch.setattr(killed, "_save", lambda ticket: None)  # from now on it does nothing
    other = home.writer(run="other")
    begin(other, "of the other")
    assert asyncio.run(other.saved(5.0))
    restarted = home.writer(run="restarted")
    store = home.store()
    wait_for(lambda: row_of(store, "of the killed")["outcome"] == "interrupted")
    assert row_of(store, "of the killed")["ended_at"] is not None
    assert row_of(store, "of the other")["outcome"] == "flying"
    for writer in (restarted, other, killed):
        writer.stop()


def test_old_and_too_many_records_are_forgotten_but_none_in_the_air(home: Home) -> None:
    now = 1e9

    writer = home.writer(clock=Clock(now=lambda: now))
    for name in ("old", "newer", "flying"):
        recorder = begin(writer, name)
        for document in list(ideal_flight(duration=30.0))[:-1]:
            recorder.add(document)
        if name != "flying":
            writer.put(Ended(flight_id=name, at=now, outcome="removed", lost=0))
        assert asyncio.run(writer.saved(5.0))
        now += 100.0
    store = home.store()
    assert store.forget(before=1e9 + 50.0, most_bytes=1e12, most_plans=10) == 1
    with database.reading(store.engine) as connection:
        assert set(connection.scalars(sa.select(flights.c.id))) == {"newer", "flying"}
    assert store.forget(before=0.0, most_bytes=10.0, most_plans=10) == 1
    with database.reading(store.engine) as connection:
        assert set(connection.scalars(sa.select(flights.c.id))) == {"flying"}
        assert set(connection.scalars(sa.select(chunks.c.flight_id))) == {"flying"}
    writer.stop()


def test_a_clock_that_jumps_forgets_nothing(home: Home, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.records.writer.WATCH", 0.0)
    monkeypatch.setattr("relguide_server.records.writer.SWEEP", 0.1)
    now = 1e9
    writer = home.writer(
        clock=Clock(now=lambda: now), limits=RetentionLimits(age=3600.0, size=1e12)
    )
    recorder = begin(writer)
    for document in ideal_flight(duration=5.0):
        recorder.add(document)
    recorder.end("removed")
    assert asyncio.run(writer.saved(5.0))
    now += 100 * 365 * 86_400.0  # past the day of the test, at which the flight ended
    saved = writer.counts.saved
    begin(writer, "later")
    wait_for(lambda: writer.counts.saved > saved + 2)
    assert row_of(home.store(), "one")["outcome"] == "joined"
    writer.stop()


def test_a_removed_file_is_made_again_and_flights_go_on_in_it(tmp_path: Path) -> None:
    home = Home(f"sqlite:///{tmp_path}/records.sqlite3")
    writer = home.writer()
    recorder = begin(writer)
    documents = list(ideal_flight(duration=60.0))
    for document in documents[:200]:
        recorder.add(document)
    assert asyncio.run(writer.saved(5.0))
    for file in tmp_path.iterdir():
        file.unlink()
    for document in documents[200:]:
        recorder.add(document)
    wait_for(lambda: (tmp_path / "records.sqlite3").exists())
    wait_for(lambda: not writer.trouble)
    recorder.end("removed")
    writer.stop()
    kept = documents_of(home.store(), "one")
    home.close()
    assert [number for number, _ in kept][-1] == len(thinned(documents)) - 1
