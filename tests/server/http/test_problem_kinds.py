"""Every problem's `type` leads to an anchor of a page that the service serves."""

import re

import pytest
from relguide_server.http.errors import problem
from relguide_server.http.problem_kinds import BY_STATUS, KINDS, PAGE
from relguide_server.planning.plans import EXAMPLE

from tests.server.serving import TestClient, ideal_app

JSON = {"Content-Type": "application/json"}
ASKED = (
    ("not-json", "POST", "/api/v1/plans", {"content": b"{", "headers": JSON}),
    ("invalid", "POST", "/api/v1/plans", {"json": {**EXAMPLE, "slot_distance_m": 1.0}}),
    ("invalid", "POST", "/api/v1/plans?max_ms=0", {"json": EXAMPLE}),
    ("unknown-parameter", "POST", "/api/v1/plans?max=5", {"json": EXAMPLE}),
    ("wrong-media-type", "POST", "/api/v1/plans", {"content": b"{}"}),
    ("body-too-long", "POST", "/api/v1/plans", {"content": b" " * 70_000, "headers": JSON}),
    ("not-found", "GET", "/api/v1/flights/none", {}),
    ("stream", "GET", "/api/v1/flights/none/stream", {}),
    ("wrong-method", "PUT", "/api/v1/plans", {}),
    ("foreign-page", "POST", "/api/v1/plans", {"headers": {"Origin": "https://else.example"}}),
    ("unknown-host", "GET", "/healthz", {"headers": {"Host": "else.example"}}),
)


@pytest.mark.parametrize(("kind", "method", "path", "sent"), ASKED)
def test_a_problem_leads_to_its_kind(kind: str, method: str, path: str, sent: dict) -> None:
    with TestClient(ideal_app()) as client:
        answer = client.request(method, path, **sent)
        page = client.get(answer.json()["type"].partition("#")[0])
    assert answer.json()["type"] == f"{PAGE}#{kind}"
    assert answer.json()["title"] == KINDS[kind].title
    assert answer.status_code == answer.json()["status"] == KINDS[kind].status
    assert page.headers["content-type"].startswith("text/html")
    assert f'id="{kind}"' in page.text


def test_the_page_has_every_kind_once() -> None:
    with TestClient(ideal_app()) as client:
        assert re.findall(r'<tr id="([\w-]+)"', client.get(PAGE).text) == list(KINDS)


def test_a_problem_without_a_kind_is_of_the_first_of_its_status() -> None:
    assert BY_STATUS[503] == "busy"
    assert BY_STATUS[422] == "invalid"
    assert b'"about:blank"' in problem("/", 418, "I am a teapot.").body


def test_below_a_path_the_type_is_below_it() -> None:
    with TestClient(ideal_app(root_path="/air")) as client:
        answer = client.get("/air/api/v1/flights/none")
        assert answer.json()["type"] == f"/air{PAGE}#not-found"
        assert client.get(answer.json()["type"]).status_code == 200
