"""The express way to a plan: the same answer, headers, refusals, counts and records."""

import json
import logging
import socket
import time
from typing import Any

import pytest
from fastapi import FastAPI
from relguide_server.planning.fast_path import SOON, FastPath
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.plans import EXAMPLE, PATH
from starlette.middleware import Middleware

from benchmarks.service.situations import HEAD_ON
from tests.server.serving import TestClient, ideal_app, serve

UNLIMITED = {**EXAMPLE, "min_separation_m": 0.0}
"""Planned at once, however busy the machine is."""
BODY = json.dumps(UNLIMITED).encode()
KIND = {"Content-Type": "application/json"}
NOT_PLAIN: tuple[dict[str, Any], ...] = (
    {"headers": {"X-Request-ID": "mine"}},
    {"headers": {"Origin": "http://localhost"}},
    {"headers": {"Cookie": "a=b"}},
    {"headers": {"Authorization": "Bearer x"}},
    {"headers": {"X-Forwarded-For": "10.0.0.1"}},
    {"headers": {"X-Whatever": "1"}},
    {"params": {"max_ms": "100"}},
)
"""What goes through all layers."""
WRONG: tuple[dict[str, Any], ...] = (
    {"content": b"{", "headers": KIND},
    {"content": b'{"a": 1}', "headers": KIND},
    {"content": b"", "headers": KIND},
    {"content": BODY, "headers": {"Content-Type": "text/plain"}},
    {"content": b" " * 70_000 + BODY, "headers": KIND},
    {"content": BODY, "headers": {**KIND, "Host": "evil.example"}},
    {"content": BODY, "headers": {**KIND, "Origin": "http://evil.example"}},
)


def looked_at(app: FastAPI, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The ways by which situations are looked at from now on."""
    ways: list[str] = []
    answer, look = FastPath._answer, PlanService.answer_at_once

    def by_express(self: FastPath, *arguments: Any) -> bytes | None:
        ways.append("express")
        return answer(self, *arguments)

    def by_desk(self: PlanService, *arguments: Any, **options: Any) -> Any:
        ways.append("look")
        return look(self, *arguments, **options)

    monkeypatch.setattr(FastPath, "_answer", by_express)
    monkeypatch.setattr(PlanService, "answer_at_once", by_desk)
    return ways


def without_express(app: FastAPI) -> FastAPI:
    app.user_middleware = [one for one in app.user_middleware if one.cls is not FastPath]
    return app


def test_it_is_the_first_that_is_passed() -> None:
    first: Middleware = ideal_app().user_middleware[0]
    assert first.cls is FastPath


def test_it_answers_as_all_layers_do() -> None:
    with TestClient(ideal_app()) as client, TestClient(without_express(ideal_app())) as other:
        short, usual = client.post(PATH, json=UNLIMITED), other.post(PATH, json=UNLIMITED)
    assert {**short.json(), "compute_ms": 0} == {**usual.json(), "compute_ms": 0}
    varying = ("x-request-id", "content-length")
    kept = [{k: v for k, v in r.headers.items() if k not in varying} for r in (short, usual)]
    assert kept[0] == kept[1]
    assert set(short.headers) == set(usual.headers)
    assert len(short.headers["x-request-id"]) == 32


@pytest.mark.parametrize("situation", [UNLIMITED, HEAD_ON], ids=["at once", "by a worker"])
def test_what_is_plain_is_looked_at_once(
    situation: dict[str, object], monkeypatch: pytest.MonkeyPatch
) -> None:
    app = ideal_app()
    ways = looked_at(app, monkeypatch)
    with TestClient(app) as client:
        assert client.post(PATH, json=situation).status_code == 200
    assert ways == ["express", "look"]


@pytest.mark.parametrize("sent", NOT_PLAIN)
def test_what_is_not_plain_goes_through_all_layers(
    sent: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    app = ideal_app()
    ways = looked_at(app, monkeypatch)
    with TestClient(app) as client:
        assert client.post(PATH, json=UNLIMITED, **sent).status_code == 200
    assert ways == ["look"]


def test_where_tokens_are_asked_for_nothing_is_plain() -> None:
    app = ideal_app(tokens="view:0123456789abcdef")
    with TestClient(app) as client:
        assert client.post(PATH, json=UNLIMITED).status_code == 401


@pytest.mark.parametrize("sent", WRONG)
def test_it_refuses_as_all_layers_do(sent: dict[str, Any]) -> None:
    with TestClient(ideal_app()) as client, TestClient(without_express(ideal_app())) as other:
        short, usual = client.post(PATH, **sent), other.post(PATH, **sent)
    assert short.status_code == usual.status_code >= 400
    assert short.json() == usual.json()
    assert set(short.headers) == set(usual.headers)


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
    for pieces, pause in ((2, 0.02), (2, 2.0 * SOON), (7, 0.01)):
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
