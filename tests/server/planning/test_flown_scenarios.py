"""Scenarios flown to their end at once: the recording of the command, kept and packed."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from relguide_server.planning.flown_scenarios import KeptRecordings

from relguide.contract.flight_summary import figures, summarize
from relguide.contract.recorder import replay
from relguide.flying.flight import fly
from relguide.flying.scenarios import SCENARIOS, scenario
from relguide.planning.plan import plan
from tests.server.serving import TestClient, ideal_app

PATH = "/api/v1/scenarios/fig_6a/flight"
PLAIN = {"Accept-Encoding": "identity"}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


@pytest.mark.slow
def test_a_scenario_is_flown_as_by_the_command(client: TestClient, tmp_path: Path) -> None:
    answer = client.get(PATH, headers=PLAIN)
    assert answer.status_code == 200
    assert answer.headers["Content-Type"].startswith("application/x-ndjson")
    file = tmp_path / "flight.jsonl"
    file.write_bytes(answer.content)
    expected = figures(summarize(fly(scenario("fig_6a"), plan, seed=0, sample_period=1.0)))
    assert figures(summarize(replay(file))) == expected


@pytest.mark.slow
def test_it_is_flown_once_and_sent_once(client: TestClient) -> None:
    first = client.get(PATH)
    again = client.get(PATH, headers=PLAIN)
    assert first.headers["Content-Encoding"] == "gzip"
    assert "Content-Encoding" not in again.headers
    assert again.content == first.content  # that of another flight tells other times of computing
    known = {"If-None-Match": first.headers["ETag"]}
    assert client.get(PATH, headers=known).status_code == 304
    other = client.get(PATH, params={"seed": 7}, headers=known)
    assert other.status_code == 200
    assert other.content != first.content


def test_what_cannot_be_flown_is_refused_in_a_sentence(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    unknown = client.get("/api/v1/scenarios/fig_6c/flight")
    assert unknown.status_code == 404
    assert "did you mean fig_6" in unknown.json()["detail"]
    for query in ({"seed": -1}, {"seed": 2**32}, {"planner": "tree"}, {"rate": 2}):
        assert client.get(PATH, params=query).status_code == 422
    named = SCENARIOS["recorded_leader"]
    monkeypatch.setattr(type(named), "missing", property(lambda _: lambda: "Install traffic."))
    missing = client.get("/api/v1/scenarios/recorded_leader/flight")
    assert (missing.status_code, missing.json()["detail"]) == (501, "Install traffic.")


def test_those_asked_for_last_are_kept() -> None:
    kept = KeptRecordings(most=10)
    for seed, size in ((1, 4), (2, 4)):
        kept.put(("fig_6b", seed, "exact"), bytes(size))
    assert kept.get(("fig_6b", 1, "exact")) is not None
    kept.put(("fig_6b", 3, "exact"), bytes(4))
    assert [kept.get(("fig_6b", seed, "exact")) is not None for seed in (1, 2, 3)] == [
        True, False, True,
    ]  # fmt: skip
    kept.put(("fig_6b", 4, "exact"), bytes(11))
    assert kept.get(("fig_6b", 3, "exact")) is None
