"""The recorded flights of the package traffic, by collection and name."""

import gzip
import json
import math
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import pytest

from relguide.flying.flight import fly
from relguide.flying.recordings import samples
from relguide.flying.recordings.flights import choose
from relguide.flying.recordings.samples import DEFAULT_LEADER, collection_flights, load_sample
from relguide.flying.scenarios import scenario_behind
from relguide.planning.plan import plan
from relguide.units import DEG, FT, KT


def sample_rows() -> list[dict[str, Any]]:
    """The collection as it is in the package."""
    package = distribution("traffic")
    path = str(package.locate_file("traffic/data/samples/collections/quickstart.json.gz"))
    with gzip.open(path) as file:
        return list(json.load(file))


@pytest.mark.slow
def test_the_default_leader_is_a_good_one() -> None:
    track = load_sample(DEFAULT_LEADER)
    first = track.t <= 720.0
    assert track.duration >= 720.0
    assert np.all(track.altitude[first] > 10_000.0 * FT)
    assert np.ptp(track.track[first]) > 45.0 * DEG
    assert np.ptp(track.ground_speed[first]) < 60.0 * KT
    # as smooth as an airliner flies: 3°/s and 0.1 g
    assert np.max(np.abs(np.diff(track.track))) < 3.0 * DEG
    assert np.max(np.abs(np.diff(track.ground_speed))) < 1.0


@pytest.mark.slow
def test_a_sample_agrees_with_what_was_broadcast() -> None:
    track = load_sample("SVA127")
    raw = [r for r in sample_rows() if r["callsign"] == "SVA127"]
    start = track.start
    speeds, directions = [], []
    for r in raw:
        t = r["timestamp"] / 1000.0 - start
        if r["groundspeed"] is not None and 0.0 <= t < track.duration:
            state = track.state_at(t)
            speeds.append(state.ground_speed / KT - r["groundspeed"])
            directions.append(math.remainder(state.track / DEG - r["track"], 360.0))
    assert len(speeds) > 1000
    assert np.sqrt(np.mean(np.square(speeds))) < 1.0
    assert np.sqrt(np.mean(np.square(directions))) < 1.0


@pytest.mark.slow
def test_an_unknown_callsign_is_answered_with_others() -> None:
    with pytest.raises(ValueError, match=r"no flight 'NONE'\. It has \d+, for example ABR471, "):
        load_sample("NONE")


@pytest.mark.slow
def test_all_airborne_flights_of_the_collection_lead_by_their_names() -> None:
    flights = collection_flights()
    names = sorted({flight.name for flight in flights})
    assert len(names) == 236
    refused = {}
    for number, name in enumerate(names):
        try:
            track = choose(flights, name, "quickstart")
        except ValueError as refusal:
            refused[name] = str(refusal)
            continue
        assert track.taken
        scenario = scenario_behind(track)
        assert scenario.leader_ident == name
        if number % 40 == 0:
            *_, last = fly(replace(scenario, duration_limit=60.0), plan, sample_period=1.0)
            assert last.kind == "flight_ended"
    # the one that never flies so fast
    assert refused == {"FHMAC": "FHMAC of quickstart never flies 30 s faster than 55 m/s."}


@pytest.mark.slow
def test_of_two_legs_the_longer_is_flown_and_both_can_be_named() -> None:
    flights = collection_flights()
    track = choose(flights, "FMY8055", "quickstart")
    assert track.taken.startswith("FMY8055 is 2 flights: 1 (3aabfc 13:11:06 to 13:35:00), 2 (")
    assert "Flight 2 is flown, the longest" in track.taken
    first = choose(flights, "fmy8055/1", "quickstart")
    assert first.end < track.start - 1800.0
    assert "Flight 1 is flown;" in first.taken


def test_an_unknown_collection_gives_a_sentence() -> None:
    with pytest.raises(
        ValueError, match=r"traffic 2\.13 has no samples 'collections/none'; it has"
    ):
        load_sample("NONE", "collections/none")


def test_without_the_package_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> object:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(samples, "distribution", missing)
    with pytest.raises(ValueError, match=r"pip install --no-deps traffic==2\.13"):
        load_sample(DEFAULT_LEADER)


@dataclass
class Package:
    """An installed package whose samples we write."""

    folder: Path
    version: str = "0"

    def locate_file(self, path: str) -> Path:
        return self.folder / path


def test_a_damaged_package_gives_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(samples, "distribution", lambda name: Package(tmp_path))
    file = tmp_path / "traffic/data/samples/a.json.gz"
    file.parent.mkdir(parents=True)
    whole = gzip.compress(orjson.dumps([{"callsign": "A"}] * 1000))
    for content in (b"", b"no gzip", whole[:-20], gzip.compress(b"{"), gzip.compress(b"{}")):
        file.write_bytes(content)
        with pytest.raises(ValueError, match="is damaged; install it again"):
            load_sample("A", "a")
