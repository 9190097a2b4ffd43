"""Answers to situations: their names, and optimality on demand."""

import json
from dataclasses import replace
from typing import Any

import pytest
from pydantic import TypeAdapter

from relguide import LEFT, RIGHT, Arc, NoPlan, Situation, check, plan
from relguide.contract.answers import answer, read_include
from relguide.contract.bodies import situation_from_json
from relguide.contract.document_models import PlanAnswer, plan_from_wire
from relguide.flying.plan_documents import NoPlanCard
from relguide.planning.outcome import Plan
from relguide.units import DEG
from tests.bodies import BODY, change, on_earth
from tests.liars import LIARS, LIED_ABOUT, Liar


def test_a_plan_has_the_contracts_names() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan, include=["alternatives"])
    assert list(reply) == [
        "status",
        "planner",
        "word",
        "time_to_converge_s",
        "length_m",
        "segments",
        "separation",
        "arrival",
        "optimality",
        "alternatives",
        "compute_ms",
    ]
    assert set(reply["separation"]) == {"least_m", "at_s", "proved_above_m"}
    assert set(reply["arrival"]) == {"slot_error_m", "heading_error_deg", "early_s"}
    assert set(reply["optimality"]) == {"proof", "lower_bound_s"}
    for segment in reply["segments"]:
        names = {
            "turn": {"kind", "direction", "angle_deg", "bank_deg", "radius_m", "duration_s"},
            "straight": {"kind", "length_m", "duration_s"},
        }[segment["kind"]]
        assert set(segment) == names | {"start", "end"}
        assert set(segment["start"]) == {"t_s", "x_m", "y_m", "heading_deg"}
    way = {"time_to_converge_s", "turning_deg", "passes", "side"}
    names_of = {
        "slower": way,
        "separation": way | {"least_separation_m", "at_s"},
        "not_open": {"time_to_converge_s", "release_time_s"},
        "no_root": set(),
    }
    for other in reply["alternatives"]:
        assert set(other) == names_of[other["rejected"]] | {"word", "why", "rejected"}
    assert {other["rejected"] for other in reply["alternatives"]} == {"slower", "no_root"}
    TypeAdapter(PlanAnswer).validate_python(reply)


def test_alternatives_come_only_if_asked_for() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan)
    assert "alternatives" not in reply
    TypeAdapter(PlanAnswer).validate_python(reply)
    assert answer(situation, anchor, plan, include=["alternatives"])["alternatives"]


def test_the_other_paths_come_with_their_segments_on_request() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan, include=["paths"])
    assert "alternatives" not in reply
    TypeAdapter(PlanAnswer).validate_python(reply)
    times = [other["time_to_converge_s"] for other in reply["others"]]
    assert times == sorted(times)
    for other in reply["others"]:
        (start, end) = (other["segments"][0]["start"], other["segments"][-1]["end"])
        assert (start["x_m"], start["y_m"]) == (BODY["pursuer"]["x_m"], BODY["pursuer"]["y_m"])
        assert end["t_s"] == pytest.approx(other["time_to_converge_s"])
    assert "others" not in answer(situation, anchor, plan)


def test_what_to_include_is_read_from_words_with_commas() -> None:
    assert read_include("") == ()
    assert read_include("alternatives, optimality") == ("alternatives", "optimality")
    with pytest.raises(ValueError, match="alternatives, paths, optimality or flown"):
        read_include("alternatives,proof")


def test_no_plan_has_the_contracts_names() -> None:
    situation, anchor = situation_from_json(change("leader.tas_mps", 300))
    reply = answer(situation, anchor, plan)
    assert set(reply) == {"status", "reason", "message", "lower_bound_s"}
    assert reply["status"] == "no_plan"
    TypeAdapter(PlanAnswer).validate_python(reply)


# --- optimality on demand -----------------------------------------------------------------------


def test_without_the_demand_nothing_is_added() -> None:
    situation, anchor = situation_from_json(BODY)
    asked = answer(situation, anchor, plan, include=["optimality"])
    reply = answer(situation, anchor, plan)
    assert set(reply["optimality"]) == {"proof", "lower_bound_s"}
    assert list(asked) == list(reply)
    asked["optimality"] = {name: asked["optimality"][name] for name in reply["optimality"]}
    asked["compute_ms"] = reply["compute_ms"]
    assert json.dumps(asked) == json.dumps(reply)


def test_on_demand_optimality_has_its_names_and_columns_of_one_length() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan, include=["optimality"])
    told = reply["optimality"]
    assert list(told) == [
        "proof",
        "lower_bound_s",
        "arrival",
        "hamiltonian_residual",
        "switching_residual_s_per_deg",
        "stationary",
        "contacts",
        "boundary_arcs",
        "costates",
    ]
    assert (told["stationary"], told["arrival"]) == (True, "free")
    assert told["hamiltonian_residual"] < 1e-8
    assert list(told["costates"]) == [
        "t_s",
        "hamiltonian",
        "switching_s_per_deg",
        "separation_costate_s_per_m",
        "bearing_costate_s_per_deg",
    ]
    assert {len(column) for column in told["costates"].values()} == {len(told["costates"]["t_s"])}
    # every end of a segment is there twice
    for segment in reply["segments"][1:]:
        start = segment["start"]["t_s"]
        assert sum(t == pytest.approx(start, abs=1e-6) for t in told["costates"]["t_s"]) == 2
    # a card read by its model is the card that was written
    read = TypeAdapter(PlanAnswer).validate_python(reply)
    assert json.loads(read.model_dump_json(exclude_unset=True)) == json.loads(json.dumps(reply))


def test_the_switching_function_is_per_degree_and_turns_as_eq_16_asks() -> None:
    situation, anchor = situation_from_json(BODY)
    planned = plan(situation)
    assert isinstance(planned, Plan)
    history = check(planned, situation).history
    costates = answer(situation, anchor, plan, include=["optimality"])["optimality"]["costates"]
    assert costates["switching_s_per_deg"] == pytest.approx([s * DEG for s in history.switching])
    assert costates["t_s"] == pytest.approx(history.times)
    # the word is RSR: right turns where λ_ψ < 0, and 0 on the straight
    middle = len(costates["t_s"]) // 2
    first, straight = costates["switching_s_per_deg"][0], costates["switching_s_per_deg"][middle]
    assert first < -1e-3
    assert abs(straight) < 1e-9


def test_a_plan_that_is_not_stationary_says_so() -> None:
    """One that begins with a weave, and is the fastest after it."""
    situation, anchor = situation_from_json(change("leader.intent", []))
    first = planned_for(situation)
    radius = situation.pursuer.turn_radius
    weave = tuple(Arc(turn=turn, turn_angle=0.3, radius=radius) for turn in (LEFT, RIGHT))
    woven = replace(first.trajectory, segments=weave)
    ours = woven.pose_at(woven.duration)
    theirs = situation.leader.trajectory.pose_at(woven.duration)
    onward = planned_for(
        replace(
            situation,
            pursuer=replace(situation.pursuer, x=ours.x, y=ours.y, heading=ours.heading),
            leader=replace(situation.leader, x=theirs.x, y=theirs.y),
        )
    )
    whole = replace(woven, segments=(*weave, *onward.trajectory.segments))

    def weaving(_: Situation) -> Plan | NoPlan:
        return replace(first, trajectory=whole)

    told = answer(situation, anchor, weaving, include=["optimality"])["optimality"]
    assert told["stationary"] is False
    assert told["switching_residual_s_per_deg"] > 0.01


def planned_for(situation: Situation) -> Plan:
    planned = plan(situation)
    assert isinstance(planned, Plan)
    return planned


@pytest.mark.parametrize("liar", LIARS, ids=lambda liar: liar.__name__)
def test_what_may_not_be_flown_is_not_answered(liar: Liar) -> None:
    _, anchor = situation_from_json(BODY)
    reply, exact = (answer(LIED_ABOUT, anchor, planner) for planner in (liar, plan))
    assert reply | {"compute_ms": 0.0} == exact | {"compute_ms": 0.0}
    assert reply["planner"] == "exact"


# --- what is flown ------------------------------------------------------------------------------


def test_the_flight_of_a_plan_has_the_contracts_names_and_changes_nothing_else() -> None:
    situation, anchor = situation_from_json(BODY)
    asked = answer(situation, anchor, plan, include=["flown"])
    TypeAdapter(PlanAnswer).validate_python(asked)
    flown = asked.pop("flown")
    assert list(flown) == [
        "status",
        "join_s",
        "least_m",
        "at_s",
        "word",
        "reason",
        "segments",
        "points",
    ]
    assert flown["join_s"] > asked["time_to_converge_s"]
    assert {tuple(point) for point in flown["points"]} == {
        ("t_s", "x_m", "y_m", "heading_deg", "tas_mps")
    }
    reply = answer(situation, anchor, plan)
    asked["compute_ms"] = reply["compute_ms"]
    assert json.dumps(asked) == json.dumps(reply)


def test_a_plan_that_no_aircraft_flies_says_why() -> None:
    slow = change("pursuer.tas_mps", 60.0)
    slow["leader"]["tas_mps"] = 50.0
    situation, anchor = situation_from_json(slow)
    reply = answer(situation, anchor, plan, include=["flown"])
    TypeAdapter(PlanAnswer).validate_python(reply)
    assert set(reply["flown"]) == {"status", "reason"}
    unplanned = situation_from_json(change("leader.tas_mps", 300))
    assert "flown" not in answer(*unplanned, plan, include=["flown"])


def test_the_points_of_a_flight_lie_on_the_earth_if_the_situation_does() -> None:
    situation, anchor = situation_from_json(on_earth((49.4, 1.4), (49.0, 2.0)))
    reply = answer(situation, anchor, plan, include=["flown"])
    TypeAdapter(PlanAnswer).validate_python(reply)
    first = reply["flown"]["points"][0]
    assert (first["lat_deg"], first["lon_deg"]) == pytest.approx((49.4, 1.4), abs=1e-9)
    assert first["heading_deg"] == pytest.approx(90.0, abs=1e-6)


# --- amid others --------------------------------------------------------------------------------


def in_the_slot() -> dict[str, Any]:
    """Another aircraft flies 2 km ahead of the slot, with the leader's intent."""
    flying = {**BODY["leader"], "ident": "EZY7", "x_m": -10_000}
    return {**BODY, "traffic": [flying]}


def test_no_plan_says_who_is_in_the_way_and_what_helps() -> None:
    situation, anchor = situation_from_json(in_the_slot())
    reply = answer(situation, anchor, plan)
    assert (reply["status"], reply["reason"]) == ("no_plan", "traffic")
    conflict = reply["conflict"]
    assert conflict["ident"] == "EZY7"
    assert conflict["least_m"] < conflict["min_separation_m"] == 9_260.0
    assert "EZY7" in reply["message"]
    card = plan_from_wire(reply)
    assert isinstance(card, NoPlanCard)
    assert card.conflict is not None
    assert card.conflict.ident == "EZY7"
    for remedy in reply["remedies"]:
        assert remedy["kind"] == "slot_distance"
        other = {**in_the_slot(), "slot_distance_m": remedy["slot_distance_m"]}
        helped = answer(*situation_from_json(other), plan)
        assert helped["time_to_converge_s"] == pytest.approx(remedy["time_to_converge_s"])


def test_an_alternative_names_whom_it_comes_too_close_to() -> None:
    free = answer(*situation_from_json(BODY), plan)
    straight = free["segments"][1]
    x, y = ((straight["start"][axis] + straight["end"][axis]) / 2.0 for axis in ("x_m", "y_m"))
    cell = {"ident": "CB9", "disc": {"x_m": x, "y_m": y, "radius_m": 15_000}}
    amid = answer(*situation_from_json({**BODY, "cells": [cell]}), plan, include=["alternatives"])
    assert amid["time_to_converge_s"] > free["time_to_converge_s"]
    lost = [other for other in amid["alternatives"] if other["rejected"] == "separation"]
    assert free["word"] in [other["word"] for other in lost]
    assert {other["ident"] for other in lost} == {"CB9"}
    assert all("into CB9 at " in other["why"] for other in lost)
