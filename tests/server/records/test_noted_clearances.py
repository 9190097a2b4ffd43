"""Clearances on record: the newest of each, those of a killed run ended, old ones forgotten."""

import asyncio
import json

import pytest
import sqlalchemy as sa
from relguide_server.records import database
from relguide_server.records.clock import Clock
from relguide_server.records.noted_clearances import HELD, KILLED, NotedClearances, ended
from relguide_server.records.queries import find_clearances, read_clearance
from relguide_server.records.schema import clearances
from relguide_server.records.writer import SWEEP, WATCH

from tests.server.records.flown_cards import noted
from tests.server.records.places import Home
from tests.server.records.test_writer import wait_for


def test_the_newest_of_each_is_kept(home: Home) -> None:
    writer = home.writer()
    for entry in (noted("a", "validating"), noted("b", "standby"), noted("a", "accepted", 2)):
        assert writer.put(entry)
    assert asyncio.run(writer.saved(5.0))
    assert writer.put(noted("b", "unable", 3, over=True))
    assert asyncio.run(writer.saved(5.0))
    store = home.store()
    kept = {
        one["id"]: (one["state"], len(one["history"])) for one in find_clearances(store, None, 9)
    }
    assert kept == {"a": ("accepted", 2), "b": ("unable", 3)}
    assert [one["id"] for one in find_clearances(store, "unable", 9)] == ["b"]
    assert len(find_clearances(store, None, 1)) == 1
    assert read_clearance(store, "c") is None
    found = read_clearance(store, "a")
    assert found is not None
    assert found["state"] == "accepted"


@pytest.mark.parametrize(
    ("state", "becomes"),
    [
        ("validating", "expired"),
        ("standby", "expired"),
        ("accepted", "expired"),
        ("wilco", "expired"),
        ("flying", "terminated"),
        ("deviated", "terminated"),
    ],
)
def test_what_nobody_watches_is_ended_with_a_sentence(state: str, becomes: str) -> None:
    found, card = ended(noted("a", state).card, at="2026-11-22T09:31:00Z", message=KILLED)
    content = json.loads(card)
    assert found == content["state"] == becomes
    assert (content["due_s"], content["deviations"]) == (0.0, [])
    assert content["history"][-1] == {
        "state": becomes, "t_s": 7.0, "at": "2026-11-22T09:31:00Z", "by": "service",
        "message": KILLED,
    }  # fmt: skip


def test_those_of_a_killed_run_are_ended_and_those_of_a_running_one_are_not(home: Home) -> None:
    killed, runs = home.writer(run="killed"), home.writer(run="runs")
    killed.put(noted("left", "flying"))
    killed.put(noted("done", "unable", over=True))
    runs.put(noted("alive", "flying"))
    assert asyncio.run(killed.saved(5.0))
    assert asyncio.run(runs.saved(5.0))
    killed._thread = None  # it is never heard of again
    killed._stopping = True
    now = [0.0]
    census = home.writer(run="census", clock=Clock(elapsed=lambda: now[0]))
    store = home.store()

    def state_of(one: str) -> str:
        found = read_clearance(store, one)
        assert found is not None
        return str(found["state"])

    def ended_at_last() -> bool:
        now[0] += WATCH
        asyncio.run(census.saved(5.0))
        asyncio.run(asyncio.sleep(0.6))  # the running one counts on
        return state_of("left") == "terminated"

    wait_for(ended_at_last, SWEEP)
    assert (state_of("alive"), state_of("done")) == ("flying", "unable")


def test_old_ones_that_are_over_are_forgotten(home: Home) -> None:
    writer = home.writer()
    writer.put(noted("old", "unable", over=True))
    writer.put(noted("open", "accepted"))
    assert asyncio.run(writer.saved(5.0))
    store = home.store()
    store.forget(before=2e9, most_bytes=1e12, most_plans=9)
    with database.reading(store.engine) as connection:
        assert connection.scalars(sa.select(clearances.c.id)).all() == ["open"]


def test_so_many_wait_at_most() -> None:
    known = NotedClearances("run")
    assert all(known.add(noted(f"{k}", "validating")) for k in range(HELD))
    assert not known.add(noted("one more", "validating"))
    assert known.add(noted("7", "accepted"))
    assert len(known.rows()) == HELD
