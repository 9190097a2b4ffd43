"""`POST /plans`: what is refused, what is counted, and bodies that come in pieces."""

import json
import logging
import socket
import time
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.plans import EXAMPLE, Answer
from relguide_server.planning.tasks import plan_body

from benchmarks.service.situations import HEAD_ON
from relguide.contract.refusal import parse
from tests.bodies import AMID, changed
from tests.bodies import BODY as PLAIN
from tests.server.serving import TestClient, ideal_app, serve
from tests.server.test_api import is_problem

PATH = "/api/v1/plans"

UNLIMITED = {**EXAMPLE, "min_separation_m": 0.0}
"""Planned at once, however busy the machine is."""
BODY = json.dumps(UNLIMITED).encode()
KIND = {"Content-Type": "application/json"}
HARMLESS: tuple[dict[str, str], ...] = (
    {"X-Request-ID": "mine"},
    {"Origin": "http://localhost"},
    {"Cookie": "a=b"},
    {"Authorization": "Bearer x"},
    {"X-Forwarded-For": "10.0.0.1"},
    {"X-Whatever": "1"},
)
WRONG: tuple[tuple[dict[str, Any], int], ...] = (
    ({"content": b"{", "headers": KIND}, 400),
    ({"content": b'{"a": 1}', "headers": KIND}, 422),
    ({"content": b"", "headers": KIND}, 400),
    ({"content": BODY, "headers": {"Content-Type": "text/plain"}}, 415),
    ({"content": b" " * 70_000 + BODY, "headers": KIND}, 413),
    ({"content": BODY, "headers": {**KIND, "Host": "evil.example"}}, 421),
    ({"content": BODY, "headers": {**KIND, "Origin": "http://evil.example"}}, 403),
)


@pytest.mark.parametrize("sent", HARMLESS)
def test_headers_that_say_nothing_of_plans_change_nothing(sent: dict[str, str]) -> None:
    with TestClient(ideal_app()) as client:
        plain, other = (
            client.post(PATH, json=UNLIMITED),
            client.post(PATH, json=UNLIMITED, headers=sent),
        )
    assert {**other.json(), "compute_ms": 0} == {**plain.json(), "compute_ms": 0}
    assert set(other.headers) == set(plain.headers)


@pytest.mark.parametrize(("sent", "status"), WRONG)
def test_what_is_wrong_is_refused_with_a_problem(sent: dict[str, Any], status: int) -> None:
    with TestClient(ideal_app()) as client:
        is_problem(client.post(PATH, **sent), status, PATH)


def test_whom_a_lost_separation_leaves_no_plan_is_told_the_soonest_way_out() -> None:
    lost = {**EXAMPLE, "pursuer": {**EXAMPLE["pursuer"], "x_m": -3_000, "y_m": 0}}
    # by the first, what it needs has been compiled
    plan_body(json.dumps(lost).encode(), "exact", (), time.monotonic() + 60.0, 60.0)
    with TestClient(ideal_app()) as client:
        answer = client.post(PATH, json=lost, params={"max_ms": 5_000}).json()
    assert answer["reason"] == "separation_already_lost"
    assert "Soonest out: " in answer["message"]


def test_a_body_that_is_no_object_is_refused_in_a_sentence() -> None:
    with TestClient(ideal_app()) as client:
        refused = client.post(PATH, json=[])
    assert refused.json()["detail"] == "The body must be an object with fields: a situation."


def test_each_request_is_counted_once() -> None:
    app = ideal_app()
    with TestClient(app) as client:
        for body in (UNLIMITED, HEAD_ON, {}):
            client.post(PATH, json=body)
    route = {"route": PATH, "method": "POST"}
    metrics = app.state.metrics
    assert metrics.value("relguide_requests_total", **route, status="200") == 2.0
    assert metrics.value("relguide_requests_total", **route, status="422") == 1.0
    counted = [metrics.value("relguide_plans_total", status=s) for s in ("planned", "no_plan")]
    assert sum(counted) == 2.0


def test_a_mistake_is_counted_and_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    def break_off(*arguments: Any, **options: Any) -> Any:
        raise ArithmeticError("a mistake")

    monkeypatch.setattr(PlanService, "answer_at_once", break_off)
    app = ideal_app()
    with TestClient(app, raise_server_exceptions=False) as client:
        answer = client.post(PATH, json=UNLIMITED)
    assert answer.status_code == 500
    assert answer.json()["type"] == "/docs/problems#mistake"
    counted = {"route": PATH, "method": "POST", "status": "500"}
    assert app.state.metrics.value("relguide_requests_total", **counted) == 1.0


def test_a_log_of_every_request_has_these_as_well(caplog: pytest.LogCaptureFixture) -> None:
    with (
        caplog.at_level(logging.DEBUG, logger="relguide.server"),
        TestClient(ideal_app()) as client,
    ):
        client.post(PATH, json=UNLIMITED)
    assert f"POST {PATH}: 200" in caplog.text


def test_a_body_that_comes_later_is_answered_all_the_same() -> None:
    head = f"POST {PATH} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    sized = f"{head}Content-Length: {len(BODY)}\r\nConnection: close\r\n\r\n".encode()
    for pieces, pause in ((2, 0.02), (2, 0.2), (7, 0.01)):
        with serve(ideal_app()) as address:
            host, _, port = address.partition(":")
            with socket.create_connection((host, int(port)), timeout=10.0) as sent:
                sent.sendall(sized)
                cut = len(BODY) // pieces + 1
                for k in range(pieces):
                    time.sleep(pause)
                    sent.sendall(BODY[k * cut : (k + 1) * cut])
                came = b""
                while part := sent.recv(65536):
                    came += part
        assert came.startswith(b"HTTP/1.1 200"), (pieces, pause)


def test_the_flight_of_a_plan_comes_on_request_quickly() -> None:
    with TestClient(ideal_app()) as client:
        plain = client.post(PATH, json=EXAMPLE).json()
        client.post(f"{PATH}?include=flown", json=EXAMPLE)  # kernels are loaded
        began = time.perf_counter()
        asked = client.post(f"{PATH}?include=flown", json=EXAMPLE).json()
        assert time.perf_counter() - began < 0.5
    flown = asked.pop("flown")
    assert flown["join_s"] > plain["time_to_converge_s"]
    assert {**asked, "compute_ms": 0} == {**plain, "compute_ms": 0}


def test_planners_are_compared_side_by_side() -> None:
    with TestClient(ideal_app()) as client:
        reply = client.post(f"{PATH}/compare", json=UNLIMITED)
        assert reply.status_code == 200
        planners = reply.json()["planners"]
        is_problem(client.post(f"{PATH}/compare", json={"a": 1}), 422, f"{PATH}/compare")
        is_problem(client.post(f"{PATH}/compare?max_ms=0", json=UNLIMITED), 422, f"{PATH}/compare")
        plan = client.post(PATH, json=UNLIMITED).json()
    assert [each["planner"] for each in planners] == [
        "exact", "network", "regular_dp", "printed_network",
    ]  # fmt: skip
    exact, *_, printed = planners
    assert (exact["status"], exact["word"]) == ("planned", plan["word"])
    assert exact["time_to_converge_s"] == plan["time_to_converge_s"]
    assert exact["segments"] == plan["segments"]
    assert printed["status"] == "refused"
    assert printed["message"].startswith("Not flown: it ends ")


# --- amid others --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def test_a_plan_amid_others_says_how_near_it_comes(client: TestClient) -> None:
    plain, amid = (client.post(f"{PATH}?max_ms=10000", json=body).json() for body in (PLAIN, AMID))
    others = amid["separation"].pop("others")
    assert {other["ident"] for other in others} == {"BAW12", "AFR7", "CB1", "CB2"}
    assert {**amid, "compute_ms": 0} == {**plain, "compute_ms": 0}
    parse(Answer, amid)


def test_what_is_wrong_with_others_is_refused_by_its_path(client: TestClient) -> None:
    for path, value, where in (
        ("traffic.0.tas_mps", 1, "traffic[0].tas_mps"),
        ("cells.1.polygon", [[0, 0], [1, 1], [2, 2]], "cells[1].polygon"),
        ("cells.0.ident", "BAW12", "cells[0].ident"),
    ):
        problem = is_problem(client.post(PATH, json=changed(AMID, path, value)), 422, PATH)
        assert [error["path"] for error in problem["errors"]] == [where]
    body = {"situation": changed(AMID, "traffic.1.ident", "")}
    problem = is_problem(client.post("/api/v1/flights", json=body), 422, "/api/v1/flights")
    assert [error["path"] for error in problem["errors"]] == ["situation.traffic[1].ident"]


def test_a_batch_has_lines_with_and_without_others(client: TestClient) -> None:
    bodies = [{**PLAIN, "id": 0}, {**AMID, "id": 1}, {**PLAIN, "id": 2, "cells": AMID["cells"][:1]}]
    answers = client.post(f"{PATH}/batch", json=bodies).json()
    idents = [
        [other["ident"] for other in answer["separation"].get("others", [])] for answer in answers
    ]
    assert [answer["id"] for answer in answers] == [0, 1, 2]
    assert [len(found) for found in idents] == [0, 4, 1]
    wrong = [bodies[0], changed(bodies[1], "traffic.0.heading_deg", "north")]
    lines = "\n".join(json.dumps(body) for body in wrong)
    kind = {"Content-Type": "application/x-ndjson"}
    sent = client.post(f"{PATH}/batch", content=lines.encode(), headers=kind)
    fine, refused = (json.loads(line) for line in sent.text.splitlines())
    assert (fine["status"], refused["status"]) == ("planned", "invalid")
    assert refused["message"].startswith("traffic[0].heading_deg: must be a number")


def test_what_is_included_and_compared_comes_amid_others(client: TestClient) -> None:
    asked = "alternatives,paths,optimality,flown"
    reply = client.post(f"{PATH}?include={asked}&max_ms=10000", json=AMID)
    assert reply.status_code == 200
    assert reply.json()["separation"]["others"]
    for planner in ("exact", "network"):
        assert client.post(f"{PATH}?planner={planner}", json=AMID).json()["separation"]["others"]
    compared = client.post(f"{PATH}/compare", json=AMID).json()["planners"]
    assert compared[0]["status"] == "planned"


def test_an_area_says_that_others_are_not_counted(client: TestClient) -> None:
    grid = {"columns": 9, "rows": 7}
    plain, amid = (
        client.post("/api/v1/areas", json={"situation": body, **grid}).json()
        for body in (PLAIN, AMID)
    )
    added = [note for note in amid["notes"] if note not in plain["notes"]]
    assert len(added) == 1
    assert added[0].startswith("Other traffic, cells and heights are not counted.")
    assert amid["contours"] == plain["contours"]


json_values = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**20), 10**20) | st.floats(-1e9, 1e9) | st.text(),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from([*AMID["traffic"][0], *AMID["cells"][0]]), inner)
    ),
    max_leaves=6,
)
PATHS = [
    "traffic", "traffic.0", "cells", "cells.0", "cells.1", "cells.0.disc", "cells.1.polygon",
    "cells.1.polygon.0", "cells.0.velocity_mps", "pursuer.altitude_m", "traffic.0.intent.1",
    *(f"traffic.0.{name}" for name in AMID["traffic"][0]),
    *(f"cells.0.{name}" for name in AMID["cells"][0]),
]  # fmt: skip


@pytest.mark.slow
@given(path=st.sampled_from(PATHS), value=json_values)
@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_mutated_others_are_never_a_mistake(client: TestClient, path: str, value: Any) -> None:
    sent = client.post(f"{PATH}?max_ms=20", json=changed(AMID, path, value))
    assert sent.status_code in (200, 422)
    if sent.status_code == 422:
        assert sent.json()["errors"]
