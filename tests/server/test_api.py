"""REST: plans, flights, problem documents; garbage in, sentences out."""

import json
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from relguide_server.app import create_app
from relguide_server.http.security_headers import VERSION
from relguide_server.jobs.worker_pool import KINDS
from relguide_server.planning.plans import EXAMPLE, MAX_BATCH
from relguide_server.settings import ServiceSettings

from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from tests.server.flown import LEADER, OWN, ideal_flight
from tests.server.serving import TestClient, ideal_app, ideal_catalogue

HARD = {
    **EXAMPLE,
    "pursuer": {**EXAMPLE["pursuer"], "x_m": 0.0, "y_m": 30e3, "heading_deg": 180.0},
    "leader": {"x_m": 0.0, "y_m": 0.0, "heading_deg": 0.0, "tas_mps": 200.0},
    "slot_distance_m": 12e3,
}  # fmt: skip
"""A head-on encounter: the limit binds."""
PROBLEM = {"type", "title", "status", "detail", "instance", "errors"}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def is_problem(answer, status: int, path: str) -> dict:
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    document = answer.json()
    assert set(document) == PROBLEM
    assert (document["status"], document["instance"]) == (status, path)
    assert document["detail"]
    assert "Traceback" not in answer.text
    return document


def test_a_situation_is_planned(client: TestClient) -> None:
    answer = client.post("/api/v1/plans", json=EXAMPLE)
    assert answer.status_code == 200
    plan = answer.json()
    assert plan["status"] == "planned"
    assert plan["separation"]["proved_above_m"] >= EXAMPLE["min_separation_m"] - 1.0
    assert plan["segments"][0]["start"]["x_m"] == EXAMPLE["pursuer"]["x_m"]


def test_a_plan_is_drawn_on_the_earth_on_request(client: TestClient) -> None:
    aircraft = {
        name: {k: v for k, v in EXAMPLE[name].items() if k not in ("x_m", "y_m")}
        | {"lat_deg": 50.0 + 0.3 * (name == "pursuer"), "lon_deg": 8.0}
        for name in ("pursuer", "leader")
    }
    answer = client.post("/api/v1/plans?format=geojson&max_ms=10000", json={**EXAMPLE, **aircraft})
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "application/geo+json"
    assert [f["id"] for f in answer.json()["features"]] == ["path", "leader", "slot"]
    assert answer.json()["word"]
    hard = {**HARD, **aircraft, "slot_distance_m": 9260.0}
    late = client.post("/api/v1/plans?format=geojson&max_ms=1", json=hard).json()
    assert late["type"] == "FeatureCollection"
    nowhere = client.post("/api/v1/plans?format=geojson", json=EXAMPLE)
    document = is_problem(nowhere, 422, "/api/v1/plans")
    assert [error["path"] for error in document["errors"]] == ["pursuer", "leader"]


def test_a_parameter_given_twice_is_refused(client: TestClient) -> None:
    asked = "/api/v1/plans?max_ms=5&max_ms=500"
    document = is_problem(client.post(asked, json=EXAMPLE), 422, "/api/v1/plans")
    assert document["detail"] == "max_ms is given more than once: give it once."
    situation = json.dumps({**EXAMPLE, "leader": {**EXAMPLE["leader"], "intent": []}})
    grid = {"columns": 3, "rows": 3, "level_s": [500.0, 600.0]}
    levels = client.get("/api/v1/areas", params={"situation": situation, **grid})
    assert levels.json()["levels_s"] == [500.0, 600.0]


def test_every_answer_names_its_version_and_a_flight_its_seed(client: TestClient) -> None:
    for answer in (
        client.post("/api/v1/plans", json=EXAMPLE),
        client.post("/api/v1/plans/batch", json=[EXAMPLE]),
        client.post("/api/v1/plans", json={}),
        client.get("/api/v1/flights/none"),
    ):
        assert answer.headers["relguide-version"] == VERSION
    flight = client.post("/api/v1/flights", json={"scenario": "ideal", "seed": 7}).json()
    assert (flight["seed"], flight["version"]) == (7, VERSION)
    assert client.get(f"/api/v1/flights/{flight['id']}").json()["seed"] == 7


def test_no_plan_is_an_answer(client: TestClient) -> None:
    leader = {"x_m": 0.0, "y_m": 0.0, "heading_deg": 90.0, "tas_mps": 390.0}
    answer = client.post("/api/v1/plans", json={**EXAMPLE, "leader": leader})
    assert answer.status_code == 200
    assert answer.json()["status"] == "no_plan"
    assert answer.json()["message"]


def test_a_batch_is_answered_in_order_with_its_ids(client: TestClient) -> None:
    batch = [{**EXAMPLE, "id": f"case {k}"} for k in range(3)] + [EXAMPLE]
    answer = client.post("/api/v1/plans/batch", json=batch)
    assert answer.status_code == 200
    assert [plan.get("id") for plan in answer.json()] == ["case 0", "case 1", "case 2", None]
    assert all(plan["status"] == "planned" for plan in answer.json())


def test_optimality_comes_on_request(client: TestClient) -> None:
    asked = client.post("/api/v1/plans?include=optimality&max_ms=10000", json=EXAMPLE).json()[
        "optimality"
    ]
    assert asked["stationary"] is True
    assert asked["hamiltonian_residual"] < 1e-8
    assert len(asked["costates"]["t_s"]) == len(asked["costates"]["switching_s_per_deg"]) > 100
    plain = client.post("/api/v1/plans", json=EXAMPLE).json()["optimality"]
    assert set(plain) == {"proof", "lower_bound_s"}
    (batch,) = client.post(
        "/api/v1/plans/batch?include=optimality&max_ms=9999", json=[EXAMPLE]
    ).json()
    assert batch["optimality"] == asked


def test_alternatives_come_on_request(client: TestClient) -> None:
    plain = client.post("/api/v1/plans", json=EXAMPLE).json()
    assert "alternatives" not in plain
    asked = client.post(
        "/api/v1/plans?include=alternatives,optimality&max_ms=9999", json=EXAMPLE
    ).json()
    assert {other["word"] for other in asked["alternatives"]} >= {"LSL", "RSR"} - {asked["word"]}
    assert "costates" in asked["optimality"]
    (batch,) = client.post(
        "/api/v1/plans/batch?include=alternatives&max_ms=9999", json=[EXAMPLE]
    ).json()
    assert batch["alternatives"] == asked["alternatives"]


def test_a_batch_of_lines_is_answered_by_lines_and_a_wrong_one_spoils_itself_only(
    client: TestClient,
) -> None:
    lines = [json.dumps({**EXAMPLE, "id": "one"}), "{", '{"id": 2}', "", json.dumps(EXAMPLE)]
    answer = client.post(
        "/api/v1/plans/batch",
        content="\n".join(lines).encode(),
        headers={"Content-Type": "application/x-ndjson"},
    )
    assert answer.headers["content-type"] == "application/x-ndjson"
    answers = [json.loads(line) for line in answer.text.splitlines()]
    assert [a["status"] for a in answers] == ["planned", "invalid", "invalid", "planned"]
    assert [a.get("id") for a in answers] == ["one", None, 2, None]
    assert "pursuer: is missing: it must be an object with x_m, " in answers[2]["message"]


def test_a_body_full_of_mistakes_is_answered_by_twenty(client: TestClient) -> None:
    body = {f"x{k}": k for k in range(3000)}
    document = is_problem(client.post("/api/v1/plans", json=body), 422, "/api/v1/plans")
    assert len(document["errors"]) == 20
    assert "and 3003 more" in document["detail"]


def test_a_plan_keeps_its_budget(client: TestClient) -> None:
    started = time.monotonic()
    hard = client.post("/api/v1/plans?max_ms=1", json=HARD).json()
    assert time.monotonic() - started < 2.0
    assert hard.get("reason", "deadline") == "deadline"
    assert (hard["lower_bound_s"] if "reason" in hard else hard["optimality"]["lower_bound_s"]) > 0
    assert client.post("/api/v1/plans?max_ms=5000", json=HARD).json()["status"] == "planned"
    for wrong in ("0", "10001", "nan", "soon"):
        answer = client.post(f"/api/v1/plans?max_ms={wrong}", json=EXAMPLE)
        assert "max_ms" in is_problem(answer, 422, "/api/v1/plans")["detail"]


def test_a_planner_may_be_asked_for(client: TestClient) -> None:
    asked = client.post("/api/v1/plans?planner=network&max_ms=9999", json=EXAMPLE)
    assert asked.json()["planner"] in ("network", "exact")
    (batch,) = client.post("/api/v1/plans/batch?planner=network&max_ms=9999", json=[EXAMPLE]).json()
    assert batch["word"] == asked.json()["word"]
    wrong = client.post("/api/v1/plans?planner=regular_dp", json=EXAMPLE)
    assert "planner" in is_problem(wrong, 422, "/api/v1/plans")["detail"]


@pytest.mark.parametrize("path", ["/api/v1/plans", "/api/v1/plans/batch"])
def test_what_cannot_be_included_is_refused(client: TestClient, path: str) -> None:
    wrong = is_problem(client.post(f"{path}?include=wings", json=EXAMPLE), 422, path)
    assert "include must be alternatives, paths, optimality or flown" in wrong["detail"]
    unknown = is_problem(client.post(f"{path}?optimality=true", json=EXAMPLE), 422, path)
    assert "include, max_ms, planner." in unknown["detail"]


def test_parameters_that_a_route_does_not_have_are_refused(client: TestClient) -> None:
    answer = client.get("/api/v1/flights?page=2")
    assert "It has none" in is_problem(answer, 422, "/api/v1/flights")["detail"]


def test_a_batch_says_which_situation_is_wrong(client: TestClient) -> None:
    wrong = {**EXAMPLE, "pursuer": {**EXAMPLE["pursuer"], "max_bank_deg": 90.0}}
    answer = client.post("/api/v1/plans/batch", json=[EXAMPLE, wrong])
    document = is_problem(answer, 422, "/api/v1/plans/batch")
    assert document["errors"][0]["path"] == "[1].pursuer.max_bank_deg"


def test_a_batch_has_an_end(client: TestClient) -> None:
    answer = client.post("/api/v1/plans/batch", json=[{}] * (MAX_BATCH + 1))
    is_problem(answer, 422, "/api/v1/plans/batch")


@pytest.mark.parametrize(
    ("body", "status", "said"),
    [
        (b"{", 400, "not JSON"),
        (b"\xff\xfe", 400, "UTF-8"),
        (b"", 400, "not JSON"),
        (b"null", 422, "must be an object"),
        (b"[]", 422, "must be an object"),
        (b"{}", 422, "is missing"),
        (b'{"slot_distance_m": NaN}', 400, "NaN"),
        (b'{"pursuer": 5, "pursuer": 6}', 400, "more than once"),
        (b"[" * 60_000, 400, "nested too deeply"),
    ],
)
def test_garbage_is_refused_with_a_sentence(
    client: TestClient, body: bytes, status: int, said: str
) -> None:
    answer = client.post(
        "/api/v1/plans", content=body, headers={"Content-Type": "application/json"}
    )
    assert said in is_problem(answer, status, "/api/v1/plans")["detail"]


def test_a_wrong_field_is_named_by_its_path(client: TestClient) -> None:
    leader = {**EXAMPLE["leader"], "intent": [{"straight_s": "long"}]}
    answer = client.post("/api/v1/plans", json={**EXAMPLE, "leader": leader, "colour": "red"})
    errors = is_problem(answer, 422, "/api/v1/plans")["errors"]
    assert {error["path"] for error in errors} == {"leader.intent[0].straight_s", "colour"}


def test_a_field_without_its_unit_is_told_the_name_that_is_meant(client: TestClient) -> None:
    pursuer = {**EXAMPLE["pursuer"], "heading": 90.0, "colour": "red"}
    del pursuer["heading_deg"]
    answer = client.post("/api/v1/plans", json={**EXAMPLE, "pursuer": pursuer})
    errors = is_problem(answer, 422, "/api/v1/plans")["errors"]
    assert {error["path"]: error["message"] for error in errors} == {
        "pursuer.heading_deg": "is missing: it must lie in -720 … 720 °.",
        "pursuer.heading": "is not a field of the contract: did you mean heading_deg?",
        "pursuer.colour": "is not a field of the contract: leave it out.",
    }


def test_a_flight_of_nothing_is_told_of_what_it_may_be(client: TestClient) -> None:
    answer = client.post("/api/v1/flights", json={"rate": 1.0})
    said = is_problem(answer, 422, "/api/v1/flights")["detail"]
    assert said == "This must have a scenario, by its name, or a situation of your own."


def test_only_json_is_taken(client: TestClient) -> None:
    answer = client.post("/api/v1/plans", content="{}", headers={"Content-Type": "text/plain"})
    is_problem(answer, 415, "/api/v1/plans")


def test_a_large_body_is_refused_whether_it_says_so_or_not() -> None:
    with TestClient(ideal_app(max_body=2000)) as client:
        headers = {"Content-Type": "application/json"}
        declared = client.post("/api/v1/plans", content=b" " * 5000, headers=headers)
        is_problem(declared, 413, "/api/v1/plans")
        chunks = (b" " * 500 for _ in range(10))
        streamed = client.post("/api/v1/plans", content=chunks, headers=headers)
        is_problem(streamed, 413, "/api/v1/plans")
        assert client.post("/api/v1/plans", json=EXAMPLE).status_code == 200


def test_unknown_paths_and_methods(client: TestClient) -> None:
    is_problem(client.get("/api/v1/nothing"), 404, "/api/v1/nothing")
    is_problem(client.get("/api/v1/plans"), 405, "/api/v1/plans")
    is_problem(client.get("/api/v1/flights/none"), 404, "/api/v1/flights/none")
    is_problem(client.delete("/api/v1/flights/none"), 404, "/api/v1/flights/none")
    is_problem(client.get("/scene/none/"), 404, "/scene/none/")
    is_problem(client.get("/docs/passwords"), 404, "/docs/passwords")
    command = client.post("/api/v1/flights/none/commands", json={"command": "play"})
    is_problem(command, 404, "/api/v1/flights/none/commands")


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("GET", "/api/v1/plans", "POST"),
        ("HEAD", "/api/v1/plans", "POST"),
        ("OPTIONS", "/api/v1/areas", "GET, HEAD, POST"),
        ("DELETE", "/api/v1/flights", "GET, HEAD, POST"),
        ("PATCH", "/api/v1/flights/none", "DELETE, GET, HEAD"),
        ("POST", "/healthz", "GET, HEAD"),
    ],
)
@pytest.mark.parametrize("root", ["", "/below"])
def test_a_wrong_method_is_told_all_right_ones(
    method: str, path: str, allowed: str, root: str
) -> None:
    client = TestClient(ideal_app(root_path=root))
    answer = client.request(method, root + path)
    assert (answer.status_code, answer.headers["allow"]) == (405, allowed)


def test_every_method_that_is_allowed_is_answered(client: TestClient) -> None:
    for path in ("/api/v1/plans", "/api/v1/areas", "/api/v1/flights", "/healthz", "/docs"):
        for method in client.patch(path).headers["allow"].split(", "):
            assert client.request(method, path).status_code != 405


@pytest.mark.parametrize(
    ("query", "path", "said"),
    [
        ("max_ms=soon", "max_ms", "must be a number, not soon."),
        ("max_ms=20000", "max_ms", "must be at most 10000, not 20000."),
        ("max_ms=nan", "max_ms", "must be a finite number, not nan."),
        ("max_ms=", "max_ms", 'must be a number, not the text "".'),
        ("planner=fast", "planner", "must be 'exact' or 'network', not fast."),
        ("format=xml", "format", "must be 'json' or 'geojson', not xml."),
        ("include=all", "include", "include must be alternatives, paths, optimality or flown, or "
         "some of them with commas, not all."),
    ],
)  # fmt: skip
def test_a_wrong_parameter_is_told_what_would_be_right(
    client: TestClient, query: str, path: str, said: str
) -> None:
    answer = client.post(f"/api/v1/plans?{query}", json=EXAMPLE)
    problem = is_problem(answer, 422, "/api/v1/plans")
    assert problem["errors"] == [{"path": path, "message": said}]
    assert problem["detail"] == (said if said.startswith(path) else f"{path}: {said}")


def test_wrong_parameters_are_told_in_the_words_of_bodies(client: TestClient) -> None:
    query = "exact=maybe&columns=1.5&rows=1&level_s=5&level_s=late"
    errors = is_problem(client.get(f"/api/v1/areas?{query}"), 422, "/api/v1/areas")["errors"]
    assert {error["path"]: error["message"] for error in errors} == {
        "columns": "must be a whole number, not 1.5.",
        "rows": "must be at least 2, not 1.",
        "level_s[1]": "must be a number, not late.",
        "exact": "must be true or false, not maybe.",
    }


def test_a_mistake_of_ours_is_a_sentence_without_traceback() -> None:
    def broken(situation: Situation) -> Plan | NoPlan:
        raise ZeroDivisionError(f"secret of {situation.slot_distance}")

    app = create_app(ServiceSettings(), planner=broken, catalogue=ideal_catalogue())
    with TestClient(app, raise_server_exceptions=False) as client:
        answer = client.post("/api/v1/plans", json=EXAMPLE)
        is_problem(answer, 500, "/api/v1/plans")
        assert "secret" not in answer.text


def test_a_flight_is_started_found_commanded_and_ended(client: TestClient) -> None:
    started = client.post("/api/v1/flights", json={"scenario": "ideal", "rate": 10.0})
    assert started.status_code == 201
    status = started.json()
    where = started.headers["location"]
    assert where == f"/api/v1/flights/{status['id']}"
    assert status["stream_url"] == f"{where}/stream"
    assert client.get(where).json()["id"] == status["id"]
    assert status["id"] in [f["id"] for f in client.get("/api/v1/flights").json()["flights"]]

    commands = f"{where}/commands"
    paused = client.post(commands, json={"command": "pause"})
    assert (paused.status_code, paused.json()["paused"]) == (202, True)
    faster = client.post(commands, json={"command": "set_rate", "rate": 60.0})
    assert faster.json()["rate"] == 60.0
    assert client.post(commands, json={"command": "play"}).json()["paused"] is False
    for wrong in ({"command": "explode"}, {"command": "set_rate", "rate": 61}, {}, []):
        is_problem(client.post(commands, json=wrong), 422, commands)

    assert client.delete(where).status_code == 204
    is_problem(client.get(where), 404, where)


def test_a_situation_of_ones_own_can_be_flown(client: TestClient) -> None:
    started = client.post("/api/v1/flights", json={"situation": EXAMPLE, "paused": True})
    assert started.status_code == 201
    assert (started.json()["t_s"], started.json()["paused"]) == (0.0, True)
    client.delete(started.headers["location"])


def test_the_air_and_what_is_seen_belong_to_flights(client: TestClient) -> None:
    rough = {
        **EXAMPLE,
        "air": {"gusts_mps": 1.5},
        "believed_air": {"wind": {"from_deg": 200, "speed_mps": 5}},
        "surveillance": {"kind": "adsb", "nacp": 8},
    }
    started = client.post("/api/v1/flights", json={"situation": rough, "paused": True})
    assert started.status_code == 201
    client.delete(started.headers["location"])
    told = is_problem(client.post("/api/v1/plans", json=rough), 422, "/api/v1/plans")
    assert [error["path"] for error in told["errors"]] == ["air", "believed_air", "surveillance"]
    assert "belongs in the situation of a flight" in told["errors"][0]["message"]


@pytest.mark.parametrize(
    "body",
    [{"scenario": "fig_99"}, {"scenario": "ideal", "rate": 0.5}, {"rate": 1}, {"scenario": 6}],
)
def test_what_cannot_be_flown_is_refused(client: TestClient, body: dict) -> None:
    is_problem(client.post("/api/v1/flights", json=body), 422, "/api/v1/flights")


def test_scenarios_are_listed(client: TestClient) -> None:
    (scenario,) = client.get("/api/v1/scenarios").json()["scenarios"]
    assert scenario["name"] == "ideal"


def test_the_sky_has_room_for_so_many_and_the_unwatched_make_room() -> None:
    with TestClient(ideal_app(max_flights=2, spare_after=3600.0)) as client:
        body = {"scenario": "ideal", "paused": True}
        ids = [client.post("/api/v1/flights", json=body).json()["id"] for _ in range(2)]
        full = client.post("/api/v1/flights", json=body)
        assert "2 flights" in is_problem(full, 429, "/api/v1/flights")["detail"]
        assert full.headers["retry-after"] == "3600"
        client.delete(f"/api/v1/flights/{ids[0]}")
        assert client.post("/api/v1/flights", json=body).status_code == 201
    with TestClient(ideal_app(max_flights=2, spare_after=1e-6)) as client:
        ids = [client.post("/api/v1/flights", json=body).json()["id"] for _ in range(3)]
        left = [flight["id"] for flight in client.get("/api/v1/flights").json()["flights"]]
        assert left == ids[1:]


def test_a_flight_that_breaks_at_once_is_a_sentence() -> None:
    def breaks(commands: object):
        yield next(ideal_flight())
        raise RuntimeError("secret")

    with TestClient(ideal_app(breaks)) as client:
        answer = client.post("/api/v1/flights", json={"scenario": "ideal"})
        is_problem(answer, 500, "/api/v1/flights")
        assert client.get("/api/v1/flights").json() == {"flights": []}


def test_health_readiness_and_numbers(client: TestClient) -> None:
    assert client.get("/healthz").json() == {"status": "ok"}
    while not client.app.state.preparation.ready:  # type: ignore[attr-defined]
        time.sleep(0.01)
    report = client.get("/readyz").json()
    assert (report["status"], report["warm"], report["preparing"]) == ("ready", {}, None)
    waiting = dict.fromkeys(KINDS, 0)
    assert report["planning"] == {"answers": True, "processes": 0, "waiting": waiting}
    client.post("/api/v1/plans", json=EXAMPLE)
    page = client.get("/metrics")
    assert page.headers["content-type"].startswith("text/plain; version=0.0.4")
    assert "relguide_plan_seconds_count" in page.text


def test_it_is_not_ready_before_a_flight_was_rehearsed() -> None:
    client = TestClient(ideal_app())  # not started
    answer = client.get("/readyz")
    assert (answer.status_code, answer.json()["status"]) == (503, "preparing")


def test_answers_keep_browsers_strict(client: TestClient) -> None:
    headers = client.get("/healthz").headers
    assert headers["x-content-type-options"] == "nosniff"
    assert "frame-ancestors 'self'" in headers["content-security-policy"]


def test_the_docs_need_no_other_machine(client: TestClient) -> None:
    page = client.get("/docs").text
    assert "https://" not in page
    assert client.get("/docs/swagger-ui-bundle.js").status_code == 200
    assert client.get("/docs/swagger-ui.css").headers["content-type"].startswith("text/css")


def test_a_plan_that_takes_long_keeps_nobody_waiting() -> None:
    """Where the limit binds a plan takes tens of ms: the loop, and so the streams, go on."""
    asked, go_on = threading.Event(), threading.Event()

    def slow(situation: Situation) -> Plan | NoPlan:
        asked.set()
        assert go_on.wait(10.0)
        return plan(situation)

    app = create_app(ServiceSettings(), planner=slow, catalogue=ideal_catalogue())
    with TestClient(app) as client, ThreadPoolExecutor(1) as other:
        planned = other.submit(client.post, "/api/v1/plans", json=EXAMPLE)
        assert asked.wait(10.0)
        assert client.get("/healthz").status_code == 200
        go_on.set()
        assert planned.result().json()["status"] == "planned"


def test_an_order_names_an_aircraft_of_the_flight_or_is_refused(client: TestClient) -> None:
    started = client.post("/api/v1/flights", json={"scenario": "ideal"})
    where = f"{started.headers['location']}/commands"
    fast = {"command": "leader_speed", "tas_mps": 210.0}
    assert client.post(where, json=fast | {"ident": LEADER}).status_code == 202
    refused = client.post(where, json=fast | {"ident": "BAW12"})
    is_problem(refused, 422, where)
    assert f"there are {OWN}, {LEADER}" in refused.text
    for command in (
        {"command": "set_engagement", "engagement": "off"},
        {"command": "leader_data", "received": False},
    ):
        assert client.post(where, json=command | {"ident": LEADER}).status_code == 422
        assert client.post(where, json=command | {"ident": OWN}).status_code == 202
    client.delete(started.headers["location"])


def test_a_crew_engages_step_by_step_and_what_may_not_follow_is_refused(
    client: TestClient,
) -> None:
    started = client.post("/api/v1/flights", json={"scenario": "ideal"})
    where = f"{started.headers['location']}/commands"
    assert started.json()["engagement"] == "engaged"

    def order(**command: object) -> Any:
        return client.post(where, json=command)

    for wrong in ("armed", "engaged"):
        is_problem(order(command="set_engagement", engagement=wrong), 409, where)
    is_problem(order(command="pursuer_heading", heading_deg=90.0), 409, where)
    is_problem(order(command="set_engagement", engagement="on"), 422, where)
    assert order(command="set_engagement", engagement="off").status_code == 202
    assert order(command="leader_data", received=False).status_code == 202
    client.delete(started.headers["location"])


def test_a_crew_takes_control_and_selects_and_what_it_cannot_is_refused(
    client: TestClient,
) -> None:
    started = client.post("/api/v1/flights", json={"scenario": "ideal"})
    where = f"{started.headers['location']}/commands"

    def order(**command: object) -> Any:
        return client.post(where, json=command)

    flies = order(command="set_autopilot", on=True)
    is_problem(flies, 409, where)
    assert flies.json()["detail"] == "The autopilot flies already."
    moved = order(command="stick", roll=0.5)
    is_problem(moved, 409, where)
    assert "take control to fly by hand" in moved.json()["detail"]
    for command in (
        {"command": "set_autopilot", "on": False},
        {"command": "set_director", "on": True},
        {"command": "pursuer_bank", "bank_deg": 20.0},
        {"command": "pursuer_speed", "tas_mps": 230.0},
        {"command": "pursuer_speed", "tas_mps": None},
        {"command": "set_spacing", "slot_distance_m": 12_000.0},
    ):
        assert client.post(where, json=command | {"ident": OWN}).status_code == 202
        is_problem(client.post(where, json=command | {"ident": LEADER}), 422, where)
    for wrong in (
        {"command": "stick", "roll": 1.5},
        {"command": "pursuer_bank", "bank_deg": 0.5},
        {"command": "pursuer_speed"},
        {"command": "set_spacing"},
        {"command": "set_spacing", "min_separation_m": 0.0},
        {"command": "set_autopilot", "on": 1},
    ):
        is_problem(client.post(where, json=wrong), 422, where)
    client.delete(started.headers["location"])
