"""A flight is drawn from its number alone; what is swept is all that differs."""

from dataclasses import replace
from math import hypot
from typing import Any

import pytest

from relguide.campaign.campaign_file import read_campaign
from relguide.campaign.draw import draw_flight
from relguide.campaign.families import draw
from relguide.campaign.keys import KEYS
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.pilot_model import PilotModel
from relguide.units import DEG

PILOTED = {"campaign": {"flights": 40, "family": "flight_director", "seed": 3}}


def campaign(family: str = "declared", **tables: Any) -> Any:
    return read_campaign({"campaign": {"flights": 5, "family": family, "seed": 3}, **tables})


def test_points_of_a_sweep_are_pairs() -> None:
    swept = campaign(
        vary={"leader_tas_share": {"uniform": [0.6, 0.9]}},
        sweep={"wind_error_mps": [0.0, 5.0, 10.0], "max_bank_deg": [20.0, 25.0]},
    )
    first, *others = (draw_flight(swept, 6 + at) for at in range(6))
    assert first.case.number == 1
    for other in others:
        assert other.case.number == 1
        assert other.values["leader_tas_share"] == first.values["leader_tas_share"]
        ours, theirs = (one.case.scenario.situation for one in (first, other))
        assert ours.leader == theirs.leader
        assert other.case.noise_seed == first.case.noise_seed
        assert (ours.pursuer.x, ours.pursuer.y) == (theirs.pursuer.x, theirs.pursuer.y)
    five, ten = (draw_flight(swept, 6 + at).case.wind_error for at in (2, 4))
    assert (five.speed, ten.speed) == (pytest.approx(5.0), pytest.approx(10.0))
    assert ten.east == pytest.approx(2.0 * five.east)  # the same side


def test_what_is_varied_besides_changes_no_other_draw() -> None:
    one = campaign(vary={"wind_error_mps": {"normal": [0, 3]}})
    more = campaign(
        vary={"wind_error_mps": {"normal": [0, 3]}, "wind_mps": {"uniform": [0, 30]}},
    )
    alone, beside = (draw_flight(asked, 4) for asked in (one, more))
    assert alone.values["wind_error_mps"] == beside.values["wind_error_mps"]
    assert alone.case.wind_error == beside.case.wind_error


def test_a_baseline_flies_what_is_drawn_for_relguide() -> None:
    asked = {"flights": 5, "family": "declared", "seed": 3}
    by_trail = read_campaign({"campaign": asked | {"guidance": "trail"}})
    assert read_campaign(by_trail.as_tables()) == by_trail
    ours, theirs = (draw_flight(one, 4).case for one in (campaign(), by_trail))
    assert (ours.guidance, theirs.guidance) == ("relguide", "trail")
    assert ours.scenario.situation == theirs.scenario.situation
    with pytest.raises(ValueError, match="guidance must be one of relguide, slot_pursuit"):
        read_campaign({"campaign": asked | {"guidance": "carrot"}})


def test_a_derived_family_begins_as_its_base() -> None:
    base = draw("declared", 2, seed=3)
    derived = draw_flight(campaign("wind_error"), 2)
    assert derived.case.scenario.situation == base.scenario.situation
    assert derived.case.wind_error.speed == pytest.approx(abs(derived.values["wind_error_mps"]))
    assert draw_flight(campaign("exact"), 2).case.scenario.situation == base.scenario.situation


def test_drawn_pilots_fly_declared_and_undeclared_leaders_by_turns() -> None:
    drawn = []
    for number in range(40):
        case = draw_flight(read_campaign(PILOTED), number).case
        base = draw(("declared", "undeclared")[number % 2], number, seed=3)
        assert case.scenario.situation == base.scenario.situation
        assert case.scenario.intent_known == (number % 2 == 0)
        assert case.scenario.by_hand is not None
        drawn.append(case.scenario.by_hand)
    usual = PilotModel()
    for name in ("bandwidth", "delay", "remnant", "threshold", "reaction"):
        shares = [getattr(one, name) / getattr(usual, name) for one in drawn]
        assert 0.5 <= min(shares) < 0.75
        assert 1.25 < max(shares) <= 1.5
    assert {one.lead for one in drawn} == {0.0}


def test_keys_of_a_pilot_have_any_family_flown_by_hand() -> None:
    keys = {"pilot_delay_s": {"fixed": 0.4}, "by_hand_margin_m": {"fixed": 60.0}}
    case = draw_flight(campaign("near_limit", vary=keys), 1).case
    assert case.scenario.by_hand == PilotModel(delay=0.4)
    assert case.world().settings == replace(DEFAULT, by_hand_margin=60.0)
    assert draw_flight(campaign("near_limit"), 1).case.scenario.by_hand is None


def test_the_mixed_family_has_all_that_is_not_exact_over_three_families() -> None:
    for number, base in enumerate(("declared", "undeclared", "commands")):
        case = draw_flight(campaign("mixed"), number).case
        drawn = draw(base, number, seed=3)
        assert (case.family, case.scenario.situation) == ("mixed", drawn.scenario.situation)
        assert case.orders == drawn.orders
        world = case.world()
        seen = world.surveillance
        assert (seen.kind, seen.nacp, seen.nacv, seen.latency) == ("adsb", 8, 2, 1.0)
        assert world.air.gusts == 1.5
        assert world.believed_air is not None
        assert case.wind_error.speed == pytest.approx(5.0)


VALUES = {
    "altitude_m": 7000.0, "isa_deviation_k": 5.0, "pursuer_tas_mps": 210.0, "max_bank_deg": 20.0,
    "leader_tas_mps": 160.0, "leader_tas_share": 0.7, "min_separation_m": 6000.0,
    "slot_beyond_m": 500.0, "spacing_s": 60.0, "start_distance_m": 30_000.0,
    "start_bearing_deg": 90.0, "wind_mps": 12.0, "wind_from_deg": 45.0, "wind_error_mps": 4.0,
    "isa_error_k": -3.0, "roll_rate_factor": 0.8, "roll_lag_factor": 1.2, "speed_lag_factor": 1.1,
    "thrust_factor": 0.9, "drag_factor": 1.1, "speed_brake_factor": 0.5, "weight_kg": 120_000.0,
    "gusts_mps": 1.0, "nacp": 8.0, "nacv": 2.0, "latency_s": 1.2, "loss_share": 0.1,
    "pilot_bandwidth_radps": 0.7, "pilot_delay_s": 0.2, "pilot_remnant_share": 0.015,
    "pilot_threshold_deg": 0.8, "pilot_reaction_s": 1.1, "by_hand_margin_m": 70.0,
}  # fmt: skip


@pytest.mark.parametrize("key", KEYS)
def test_each_key_changes_what_it_says(key: str) -> None:
    case = draw_flight(campaign(vary={key: VALUES[key]}), 1).case
    scenario, world = case.scenario, case.world()
    situation = scenario.situation
    pursuer, leader = situation.pursuer, situation.leader
    east, north = pursuer.x - leader.x, pursuer.y - leader.y
    true, believed = world.aircraft[0].airframe, world.aircraft[0].known_airframe
    air = world.believed_air or world.air
    pilot = scenario.by_hand or PilotModel()
    found = {
        "altitude_m": world.aircraft[0].altitude,
        "isa_deviation_k": world.air.isa_deviation,
        "pursuer_tas_mps": pursuer.tas,
        "max_bank_deg": pursuer.max_bank / DEG,
        "leader_tas_mps": leader.tas,
        "leader_tas_share": leader.tas / pursuer.tas,
        "min_separation_m": situation.min_separation,
        "slot_beyond_m": situation.slot_distance - situation.min_separation,
        "spacing_s": world.links[0].spacing,
        "start_distance_m": hypot(east, north),
        "start_bearing_deg": 90.0 if east > 0.0 and abs(north) < 1e-6 else None,
        "wind_mps": world.air.wind.speed,
        "wind_from_deg": 45.0 if world.air.wind.east == pytest.approx(world.air.wind.north) else 0,
        "wind_error_mps": hypot(
            air.wind.east - world.air.wind.east, air.wind.north - world.air.wind.north
        ),
        "isa_error_k": air.isa_deviation - world.air.isa_deviation,
        "pilot_bandwidth_radps": pilot.bandwidth,
        "pilot_delay_s": pilot.delay,
        "pilot_remnant_share": pilot.remnant,
        "pilot_threshold_deg": pilot.threshold / DEG,
        "pilot_reaction_s": pilot.reaction,
        "by_hand_margin_m": world.settings.by_hand_margin,
        "roll_rate_factor": true.max_roll_rate / believed.max_roll_rate,
        "roll_lag_factor": true.roll_time_constant / believed.roll_time_constant,
        "speed_lag_factor": true.speed_time_constant / believed.speed_time_constant,
        "thrust_factor": true.thrust_share / believed.thrust_share,
        "drag_factor": true.zero_lift_drag / believed.zero_lift_drag,
        "speed_brake_factor": true.speed_brake_drag / believed.speed_brake_drag,
        "weight_kg": world.aircraft[0].weight,
        "gusts_mps": world.air.gusts,
        **{
            name: getattr(world.surveillance, name.removesuffix("_s"))
            if world.surveillance.kind == "adsb"
            else None
            for name in ("nacp", "nacv", "latency_s", "loss_share")
        },
    }
    assert found[key] == pytest.approx(VALUES[key])


def test_there_is_no_flight_beyond_the_last() -> None:
    with pytest.raises(ValueError, match="has the flights 0 to 4, and no 5"):
        draw_flight(campaign(), 5)
