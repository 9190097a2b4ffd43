"""Simulations: flown to their end by workers, with the figures of `relguide fly --json`."""

import asyncio
import json
from collections.abc import Iterator
from functools import partial
from importlib.metadata import version

import pytest
from relguide_server.http.errors import Refusal
from relguide_server.planning.simulations import AT_A_TIME, EXAMPLE

from relguide import plan
from relguide.contract.flight_summary import figures, summarize
from relguide.contract.orders import CrewOrderBody, OrderBody, commands_of, crew_order, order_of
from relguide.contract.refusal import parse
from relguide.contract.simulation_bodies import MAX_SIMULATIONS, SimulationAnswer
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.flying.scripted_crew import with_crew
from tests.bodies import AMID, BODY, changed
from tests.server.serving import TestClient, ideal_app

PATH = "/api/v1/simulations"
GALE = {"from_deg": 0, "speed_mps": 60}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


@pytest.mark.slow
def test_flights_are_flown_to_their_end_as_by_the_command(client: TestClient) -> None:
    answer = client.post(PATH, json=EXAMPLE)
    assert answer.status_code == 200
    first, other = answer.json()
    expected = figures(summarize(fly(scenario("fig_6b"), plan, seed=0, sample_period=1.0)))
    assert {name: first[name] for name in expected} == expected
    assert first["version"] == version("relguide")
    assert (first["scenario"], first["seed"], other["seed"]) == ("fig_6b", 0, 7)
    assert first["joined"]
    assert other["track_nm"] != first["track_nm"]
    for one in (first, other):
        SimulationAnswer.model_validate(one)


@pytest.mark.slow
def test_a_flight_of_several_pursuers_has_the_figures_of_each(client: TestClient) -> None:
    ((flown,), (alone,)) = (
        client.post(PATH, json=[{"scenario": name}]).json()
        for name in ("overtaking_queue", "fig_6b")
    )
    answer = SimulationAnswer.model_validate(flown)
    assert [(one.pursuer, one.leader, one.joined) for one in answer.links] == [
        ("PURSUER", "THIRD", True),
        ("FIRST", "LEADER", True),
        ("SECOND", "FIRST", True),
        ("THIRD", "SECOND", True),
    ]
    assert answer.join_time_s == answer.links[0].join_time_s
    assert "links" not in alone


@pytest.mark.parametrize(
    ("body", "path"),
    [
        ({}, ""),
        ([], ""),
        ([{"scenario": "fig_6b"}] * (MAX_SIMULATIONS + 1), ""),
        ([{"scenario": "fig_6b"}, {"scenario": "unknown"}], "[1].scenario"),
        ([{"scenario": "fig_6b", "rate": 10.0}], "[0].rate"),
        ([{"situation": {**BODY, "slot_distance_m": 1.0}}], "[0].situation.slot_distance_m"),
        ([{"situation": {**BODY, "air": {"wind": GALE}}}], "[0].situation.air.wind"),
        ([{"situation": {**AMID, "cells": [{"ident": "A"}]}}], "[0].situation.cells[0].disc"),
        (
            [{"situation": changed(AMID, "traffic.1.ident", "LEADER")}],
            "[0].situation.traffic[1].ident",
        ),
        ([{"situation": changed(AMID, "pursuer.altitude_m", 20_000)}], "[0].situation.pursuer"),
    ],
)
def test_what_cannot_be_flown_is_refused_by_its_path(
    client: TestClient, body: object, path: str
) -> None:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["path"] == path


@pytest.mark.slow
def test_a_crew_that_reacts_and_a_pilot_model_fly_as_by_the_command(client: TestClient) -> None:
    crew = [
        {"t_s": 5, "engagement": "designated"},
        {"on": "proposed", "after_s": 5, "engagement": "armed"},
        {"on": "armed", "after_s": 10, "engagement": "engaged"},
    ]
    orders = [{"t_s": 100, "leader_tas_mps": 195}, {"t_s": 120, "pursuer_max_bank_deg": 20}]
    late, by_hand, steady, clumsy = client.post(
        PATH,
        json=[
            {"scenario": "fig_6b", "crew": crew, "orders": orders},
            {"scenario": "fig_6b", "by_hand": True},
            {"scenario": "fig_6b", "by_hand": {"remnant_share": 0.0}},
            {"scenario": "fig_6b", "by_hand": {"bandwidth_radps": 0.6, "delay_s": 0.6}},
        ],
    ).json()
    script = [crew_order(parse(CrewOrderBody, line).root) for line in crew]
    given = [order_of(parse(OrderBody, line).root) for line in orders]
    flight = partial(fly, scenario("fig_6b"), plan, engagement="off", sample_period=1.0)
    expected = figures(summarize(with_crew(script, flight, commands_of(given))))
    assert {name: late[name] for name in expected} == expected
    assert late["joined"]
    assert "by_hand" not in late
    for one in (by_hand, steady, clumsy):
        assert SimulationAnswer.model_validate(one).by_hand is not None
    inside = [one["by_hand"]["within_bar_s"] for one in (clumsy, by_hand, steady)]
    assert inside[0] < min(inside[1:])
    assert inside[1] != inside[2]


@pytest.mark.parametrize(
    ("wanted", "path"),
    [
        ({"by_hand": 1}, "by_hand"),
        ({"by_hand": {"delay_s": 2.0}}, "by_hand.delay_s"),
        ({"by_hand": {"delay": 0.3}}, "by_hand.delay"),
        ({"crew": []}, "crew"),
        ({"crew": [{"t_s": 9, "director": True}, {"t_s": 8, "director": True}]}, "crew[1].t_s"),
        ({"crew": [{"engagement": "armed"}]}, "crew[0]"),
        ({"crew": [{"t_s": 1, "intent_known": True}]}, "crew[0]"),
        ({"crew": [{"t_s": 1, "engagement": "on"}]}, "crew[0].engagement"),
        ({"crew": [{"t_s": 1, "autopilot": False, "ident": "LEADER"}]}, "crew[0].ident"),
        ({"orders": [{"on": "armed", "autopilot": False}]}, "orders[0].on"),
        ({"orders": [{"t_s": 1, "leader_tas_mps": 20}]}, "orders[0].leader_tas_mps"),
        ({"orders": [{"t_s": 9, "director": True}, {"t_s": 8, "director": True}]}, "orders[1].t_s"),
        ({"orders": [7]}, "orders[0]"),
    ],
)
def test_what_cannot_be_ordered_is_refused_by_its_path(
    client: TestClient, wanted: dict[str, object], path: str
) -> None:
    answer = client.post(PATH, json=[{"scenario": "fig_6b", **wanted}])
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["path"] == f"[0].{path}"


@pytest.mark.slow
def test_a_situation_amid_others_is_flown(client: TestClient) -> None:
    (flown,) = client.post(PATH, json=[{"situation": AMID}]).json()
    assert flown["joined"]
    assert flown["losses"] == []


def test_where_one_is_refused_the_others_are_not_flown(monkeypatch: pytest.MonkeyPatch) -> None:
    begun: set[int] = set()
    left: set[int] = set()

    async def do(kind: str, work: object, wanted: str, *_: object, **__: object):
        seed = json.loads(wanted)["seed"]
        begun.add(seed)
        if len(begun) == AT_A_TIME:
            raise Refusal(503, "Too many wait: try again in a moment.")
        try:
            await asyncio.Event().wait()
        finally:
            left.add(seed)

    app = ideal_app()
    monkeypatch.setattr(app.state.workers, "do", do)
    with TestClient(app) as client:
        flights = [{"scenario": "fig_6b", "seed": seed} for seed in range(MAX_SIMULATIONS)]
        assert client.post(PATH, json=flights).status_code == 503
        assert client.get("/healthz").status_code == 200
        assert left == begun - {AT_A_TIME - 1}
