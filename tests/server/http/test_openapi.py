"""The OpenAPI document, held to what the service really does: by schemathesis, and by hand."""

import re
from collections.abc import Iterator
from typing import Any

import jsonschema_rs
import pytest
import schemathesis
from hypothesis import HealthCheck, settings
from relguide_server.http.idempotency import HEADER
from relguide_server.http.kept_answers import REPLAYED
from relguide_server.http.openapi import HEADERS
from relguide_server.http.security_headers import SECURITY_HEADERS
from relguide_server.planning.plans import EXAMPLE
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from tests.server.serving import TestClient, ideal_app
from tools import api_examples

app = ideal_app(max_flights=2, spare_after=1e-6, hosts="testserver")
client = TestClient(app)
schema = schemathesis.openapi.from_asgi("/openapi.json", app)
DOCUMENT: dict[str, Any] = app.openapi()


@schemathesis.check
def nothing_broke(
    context: schemathesis.CheckContext,
    response: schemathesis.Response,
    case: schemathesis.Case,
) -> None:
    """A machine that does other things may make the service refuse (503), never break (500)."""
    assert response.status_code < 500 or response.status_code == 503
    assert response.status_code != 503 or "retry-after" in response.headers


CHECKS = (
    nothing_broke,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
)


@schemathesis.serializer("application/x-ndjson")
def write_lines(context: schemathesis.SerializationContext, value: object) -> bytes:
    return b"\n".join(
        line if isinstance(line, bytes) else str(line).encode()
        for line in (value if isinstance(value, list) else [value])
    )


@schema.parametrize()
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
def test_the_service_does_what_its_document_says(case: schemathesis.Case) -> None:
    case.call_and_validate(checks=CHECKS, timeout=120)


class Walk(schema.as_state_machine()):  # type: ignore[misc]
    """Requests one after another, each with what the answers before it gave: ids of flights."""

    def validate_response(
        self, response: schemathesis.Response, case: schemathesis.Case, *_: Any, **__: Any
    ) -> None:
        case.validate_response(response, checks=CHECKS)


Walk.TestCase.settings = settings(
    max_examples=10, stateful_step_count=8, deadline=None,
    suppress_health_check=list(HealthCheck),
)  # fmt: skip
TestWalk = pytest.mark.slow(Walk.TestCase)


def test_every_reference_leads_somewhere() -> None:
    known = DOCUMENT["components"]

    def walk(node: object) -> None:
        match node:
            case {"$ref": str() as reference}:
                kind, name = reference.removeprefix("#/components/").split("/")
                assert name in known[kind]
            case dict():
                for child in node.values():
                    walk(child)
            case list():
                for child in node:
                    walk(child)

    walk(DOCUMENT)
    assert {"SituationBody", "Answer", "FlightStatus", "Problem"} <= set(known["schemas"])


def test_no_shape_is_another_name_of_one() -> None:
    """Generators of clients name classes by shapes, and leave out what they have made already."""
    assert not [n for n, s in DOCUMENT["components"]["schemas"].items() if "$ref" in s]


def operations() -> Iterator[tuple[str, str, dict[str, Any]]]:
    for path, methods in DOCUMENT["paths"].items():
        for method, operation in methods.items():
            yield path, method, operation


def test_everything_is_described() -> None:
    ids = [operation["operationId"] for _, _, operation in operations()]
    assert len(set(ids)) == len(ids)
    tags = {tag["name"] for tag in DOCUMENT["tags"] if tag["description"]}
    missing = []
    for path, method, operation in operations():
        where = f"{method} {path}"
        assert re.fullmatch(r"[a-z]+(_[a-z]+)+", operation["operationId"])
        assert set(operation["tags"]) <= tags
        missing += [where for name in ("summary", "description") if not operation.get(name)]
        missing += [
            f"{where} {p['name']}"
            for p in operation.get("parameters", [])
            if not p.get("description")
        ]
        for status, answer in operation["responses"].items():
            if not answer["description"] or answer["description"] == "Successful Response":
                missing.append(f"{where} {status}")
        bodies = operation.get("requestBody", {}).get("content", {})
        missing += [f"{where} {m}" for m, c in bodies.items() if "example" not in c]
    for name, shape in DOCUMENT["components"]["schemas"].items():
        missing += [] if shape.get("description") else [name]
        for field, said in shape.get("properties", {}).items():
            missing += [] if said.get("description") else [f"{name}.{field}"]
    assert not missing


def test_no_words_of_the_framework_are_promised() -> None:
    assert "HTTPValidationError" not in DOCUMENT["components"]["schemas"]
    for _, _, operation in operations():
        for status, answer in operation["responses"].items():
            if status.startswith("4"):
                assert set(answer["content"]) == {"application/problem+json"}


def test_examples_are_what_is_sent() -> None:
    shown = {
        operation["operationId"]: media["example"]
        for _, _, operation in operations()
        for status, answer in operation["responses"].items()
        for media in answer.get("content", {}).values()
        if status.startswith("2") and "example" in media
    }
    sent = api_examples.answers()
    assert shown.keys() == sent.keys()
    for name, answer in sent.items():
        same = sorted(set(api_examples.names_in(shown[name])))
        assert same == sorted(set(api_examples.names_in(answer))), (
            f"The example of {name} is not what is sent. Run: {api_examples.COMMAND}"
        )


def test_every_example_fits_its_schema() -> None:
    fitting = 0
    for path, method, operation in operations():
        bodies = [operation.get("requestBody", {}), *operation["responses"].values()]
        for media in (m for body in bodies for m in body.get("content", {}).values()):
            shown = [v["value"] for v in media.get("examples", {}).values()]
            for example in [*shown, *([media["example"]] if "example" in media else [])]:
                shape = {**media["schema"], "components": DOCUMENT["components"]}
                wrong = [error.message for error in jsonschema_rs.iter_errors(shape, example)]
                assert not wrong, (method, path)
                fitting += 1
    assert fitting > 100


JSON = {"Content-Type": "application/json"}
FLIGHT = "/api/v1/flights/{flight_id}"
ASKED: tuple[tuple[str, str, int, dict[str, Any]], ...] = (
    ("GET", "/healthz", 200, {}),
    ("GET", "/readyz", 200, {}),
    ("GET", "/metrics", 200, {}),
    ("GET", "/metrics", 200, {"headers": {"Accept": "application/openmetrics-text"}}),
    ("GET", "/healthz", 421, {"headers": {"Host": "else.example"}}),
    ("POST", "/api/v1/plans", 200, {"json": EXAMPLE}),
    ("POST", "/api/v1/plans", 200, {"json": EXAMPLE, "params": {"max_ms": "1000"}}),
    ("POST", "/api/v1/plans", 400, {"content": b"{", "headers": JSON}),
    ("POST", "/api/v1/plans", 403, {"json": EXAMPLE, "headers": {"Origin": "https://x.example"}}),
    ("POST", "/api/v1/plans", 413, {"content": b" " * 70_000, "headers": JSON}),
    ("POST", "/api/v1/plans", 415, {"content": b"{}"}),
    ("POST", "/api/v1/plans", 422, {"json": {}}),
    ("POST", "/api/v1/plans", 422, {"json": EXAMPLE, "params": {"max": "1"}}),
    ("POST", "/api/v1/plans", 422, {"json": EXAMPLE, "params": {"max_ms": "x"}}),
    ("POST", "/api/v1/plans/batch", 200, {"json": [EXAMPLE]}),
    ("GET", "/api/v1/flights", 200, {}),
    ("GET", "/api/v1/flights", 422, {"params": {"all": "1"}}),
    ("GET", FLIGHT, 404, {}),
    ("GET", FLIGHT, 422, {"params": {"all": "1"}}),
    ("DELETE", FLIGHT, 404, {}),
    ("POST", "/api/v1/flights", 201, {"json": {"scenario": "ideal"}}),
    ("GET", "/api/v1/records/flights", 404, {}),
)
ITS_OWN = {"content-type", "content-length", "connection", "date", "vary"}
"""Headers of HTTP itself."""


@pytest.mark.parametrize(("method", "path", "status", "sent"), ASKED)
def test_what_is_sent_is_what_is_declared(
    method: str, path: str, status: int, sent: dict[str, Any]
) -> None:
    with TestClient(ideal_app()) as asking:
        answer = asking.request(method, path.format(flight_id="none"), **sent)
    assert answer.status_code == status
    _expect_declared(DOCUMENT, method, path, answer)


def test_an_answer_that_is_sent_again_says_so() -> None:
    asked = {"json": {"scenario": "ideal"}, "headers": {HEADER: "7e3c"}}
    with TestClient(ideal_app()) as asking:
        first, again = (asking.post("/api/v1/flights", **asked) for _ in range(2))
    _expect_declared(DOCUMENT, "POST", "/api/v1/flights", first)
    _expect_declared(DOCUMENT, "POST", "/api/v1/flights", again, replayed=True)
    takes = {
        f"{method} {path}"
        for path, method, operation in operations()
        if HEADER in [parameter["name"] for parameter in operation.get("parameters", ())]
    }
    assert takes >= {
        "post /api/v1/flights",
        "post /api/v1/flights/{flight_id}/commands",
        "post /api/v1/simulations",
        "post /api/v1/records/flights/{flight_id}/replay",
        "post /api/v1/clearances",
        "post /api/v1/clearances/{clearance_id}/answers",
        "post /api/v1/clearances/{clearance_id}/replies",
    }


def test_refusals_for_a_while_say_when_to_try_again() -> None:
    with TestClient(ideal_app(max_flights=1)) as asking:
        asking.post("/api/v1/flights", json={"scenario": "ideal"})
        answer = asking.post("/api/v1/flights", json={"scenario": "ideal"})
        assert answer.status_code == 429
        _expect_declared(DOCUMENT, "POST", "/api/v1/flights", answer)


def test_who_shows_no_token_is_told_how() -> None:
    with TestClient(ideal_app(tokens="view:" + "v" * 16)) as asking:
        answer = asking.get("/api/v1/flights")
        assert answer.status_code == 401
        _expect_declared(DOCUMENT, "GET", "/api/v1/flights", answer)


def _expect_declared(
    document: dict[str, Any], method: str, path: str, answer: Any, *, replayed: bool = False
) -> None:
    declared = document["paths"][path][method.lower()]["responses"][str(answer.status_code)]
    assert answer.headers["content-type"].partition(";")[0] in declared["content"]
    promised = {name.lower() for name in declared["headers"] if replayed or name != REPLAYED}
    ours = {name.lower() for name in answer.headers} - ITS_OWN
    assert (
        ours - {name.decode() for name in SECURITY_HEADERS if b"relguide" not in name} == promised
    )
    assert set(declared["headers"]) <= set(HEADERS)


def test_what_starts_a_flight_leads_to_what_takes_its_id() -> None:
    ids = {operation["operationId"]: path for path, _, operation in operations()}
    started = DOCUMENT["paths"]["/api/v1/flights"]["post"]["responses"]["201"]["links"]
    assert {"show_flight", "command_flight", "end_flight"} < set(started)
    for name, link in started.items():
        assert link == {
            "operationId": name,
            "parameters": {"flight_id": "$response.body#/id"},
        }
        assert "{flight_id}" in ids[name]
