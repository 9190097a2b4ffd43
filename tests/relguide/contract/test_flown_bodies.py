"""Situations to fly: the air, what is believed of it, and how well the leader is seen."""

from math import radians
from pathlib import Path
from typing import Any

import pytest

from relguide.contract.bodies import SituationBody, situation_from_json
from relguide.contract.flown_bodies import FlownSituationBody, scenario_from_body
from relguide.contract.refusal import ContractError, parse
from relguide.flying.air import Air
from relguide.flying.flight import Scenario, world_of
from relguide.flying.scenarios import own_scenario
from relguide.flying.surveillance import EXACT, Surveillance
from relguide.flying.wind_profile import WindLevel, WindProfile
from relguide.planning.wind import wind_from
from tests.bodies import AMID, BODY

ROOT = Path(__file__).parents[3]
CALM_BODY = {name: value for name, value in BODY.items() if name != "wind"}
WEST = {"from_deg": 270, "speed_mps": 15}
HIGH = {"altitude_m": 9_000, "from_deg": 270, "speed_mps": 30}
LOW = {"altitude_m": 0, "from_deg": 270, "speed_mps": 10}


def read(**more: Any) -> Scenario:
    return scenario_from_body(parse(FlownSituationBody, {**CALM_BODY, **more}))[0]


def test_without_the_new_fields_it_is_flown_as_before() -> None:
    situation, anchor = situation_from_json(BODY)
    assert scenario_from_body(parse(FlownSituationBody, BODY)) == (own_scenario(situation), anchor)


def test_the_air_has_wind_gusts_and_a_temperature() -> None:
    own = read(air={"wind": WEST, "gusts_mps": 1.5, "isa_deviation_k": 10})
    wind = wind_from(radians(270.0), 15.0)
    assert own.situation.wind == wind
    assert own.air == Air(wind=wind, gusts=1.5, isa_deviation=10.0)
    assert read(wind=WEST, air={"gusts_mps": 1.5}).situation.wind == wind


def test_a_profile_blows_in_place_of_one_wind() -> None:
    own = read(air={"profile": [HIGH, LOW]})
    levels = tuple(
        WindLevel(float(level["altitude_m"]), wind_from(radians(270.0), float(level["speed_mps"])))
        for level in (LOW, HIGH)
    )
    assert own.profile == WindProfile(levels=levels)
    assert own.situation.wind == own.profile.at(own.altitude)
    assert world_of(own).air.profile == own.profile


def test_what_is_believed_is_the_truth_but_for_what_is_told() -> None:
    assert read(wind=WEST).believed_air is None
    air = {"profile": [HIGH, LOW], "isa_deviation_k": 10}
    own = read(air=air, believed_air={"wind": WEST})
    assert own.believed_air == Air(wind=wind_from(radians(270.0), 15.0), isa_deviation=10.0)
    colder = read(air=air, believed_air={"isa_deviation_k": -5})
    assert colder.believed_air == Air(profile=own.profile, isa_deviation=-5.0)
    other = read(wind=WEST, believed_air={"profile": [HIGH]}).believed_air
    assert other is not None
    assert other.wind_at(0.0, 0.0, 0.0, 0.0).speed == pytest.approx(30.0)
    assert world_of(own).believed_air == own.believed_air


def test_the_leader_is_seen_exactly_or_by_reports() -> None:
    assert read().surveillance == EXACT
    assert read(surveillance={"kind": "exact"}).surveillance == EXACT
    reports = {
        "kind": "adsb", "nacp": 8, "nacv": 1, "latency_s": 1.0, "interval_s": 2.0,
        "loss_share": 0.1, "burst_s": 8.0,
    }  # fmt: skip
    seen = Surveillance(
        kind="adsb", nacp=8, nacv=1, latency=1.0, interval=2.0, loss_share=0.1, burst=8.0
    )
    assert world_of(read(surveillance=reports)).surveillance == seen


@pytest.mark.parametrize(
    ("more", "path", "said"),
    [
        ({"wind": WEST, "air": {"wind": {**WEST, "speed_mps": 16}}}, "air.wind", "another than"),
        ({"wind": WEST, "air": {"profile": [HIGH]}}, "air.profile", "leave out the situation's"),
        ({"air": {"wind": WEST, "profile": [HIGH]}}, "air.wind", "must be left out"),
        ({"believed_air": {"wind": WEST, "profile": [HIGH]}}, "believed_air.wind", "left out"),
        ({"air": {"profile": [HIGH, HIGH]}}, "air.profile", "one wind at 9000 m"),
        ({"air": {"profile": []}}, "air.profile", "at least 1"),
        ({"air": {"gusts_mps": 11}}, "air.gusts_mps", "0 … 10 m/s"),
        ({"air": {"isa_deviation_k": -61}}, "air.isa_deviation_k", "-60 … 60 K"),
        ({"air": {"temperature_k": 5}}, "air.temperature_k", "is not a field"),
        (
            {"surveillance": {"nacp": 8}},
            "surveillance.kind",
            "is missing: it must be 'exact' or 'adsb'.",
        ),
        ({"surveillance": {"kind": "radar"}}, "surveillance.kind", "must be"),
        ({"surveillance": {"kind": "adsb", "nacp": 12}}, "surveillance.nacp", "at most 11"),
        ({"surveillance": {"kind": "adsb", "nacp": 8.5}}, "surveillance.nacp", "whole number"),
        ({"surveillance": {"kind": "adsb", "burst_s": 61}}, "surveillance.burst_s", "60 s"),
    ],
)
def test_what_is_wrong_is_refused_by_its_path(more: dict[str, Any], path: str, said: str) -> None:
    with pytest.raises(ContractError) as refused:
        read(**more)
    ((found, sentence),) = refused.value.problems
    assert found == path
    assert said in sentence


def test_the_same_wind_may_be_given_twice() -> None:
    twice = read(wind=WEST, air={"wind": {**WEST, "from_deg": -90}})
    assert twice == read(wind=WEST)


def test_the_two_aircraft_are_called_as_the_request_says() -> None:
    own = read(pursuer_ident="DLH1", leader_ident="AFR2")
    assert (own.pursuer_ident, own.leader_ident) == ("DLH1", "AFR2")
    with pytest.raises(ContractError, match="leader_ident: is what the pursuer is called"):
        read(pursuer_ident="AFR2", leader_ident="AFR2")
    with pytest.raises(ContractError, match="is what the leader of a flight is called"):
        read(leader_ident="BAW12", traffic=AMID["traffic"])


@pytest.mark.parametrize("name", ["air", "believed_air", "surveillance"])
def test_plans_say_that_flights_read_it(name: str) -> None:
    with pytest.raises(ContractError, match=f"{name}: belongs in the situation of a flight"):
        parse(SituationBody, {**BODY, name: {}})


def test_the_example_has_all_of_it() -> None:
    body = parse(FlownSituationBody, (ROOT / "examples" / "rough.json").read_text("utf-8"))
    own, _ = scenario_from_body(body)
    assert own.profile is not None
    assert own.believed_air is not None
    assert (own.gusts, own.isa_deviation, own.surveillance.kind) == (1.5, 5.0, "adsb")


def test_others_fly() -> None:
    own = read(traffic=AMID["traffic"], cells=AMID["cells"])
    world = world_of(own)
    assert [aircraft.ident for aircraft in world.aircraft] == ["PURSUER", "LEADER", "BAW12", "AFR7"]
    assert [cell.ident for cell in world.cells] == ["CB1", "CB2"]


@pytest.mark.parametrize(
    ("name", "ident", "said"),
    [
        ("traffic", "LEADER", "is what the leader of a flight is called: choose another."),
        ("cells", "PURSUER", "is what the pursuer of a flight is called: choose another."),
    ],
)
def test_others_are_not_called_as_the_two_aircraft(name: str, ident: str, said: str) -> None:
    first, second = AMID[name]
    with pytest.raises(ContractError) as caught:
        read(**{name: [first, {**second, "ident": ident}]})
    assert caught.value.problems == ((f"{name}[1].ident", said),)


def test_a_pursuer_above_its_ceiling_is_refused() -> None:
    with pytest.raises(ValueError, match=r"cannot fly at FL656: choose FL\d+, its ceiling"):
        read(pursuer={**BODY["pursuer"], "altitude_m": 20_000})
