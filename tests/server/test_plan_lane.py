"""The lane of plans: it answers what the route would, and is counted as the route."""

import pytest
from relguide_server.plans import EXAMPLE, PATH

from tests.server.serving import TestClient, ideal_app

UNLIMITED = {**EXAMPLE, "min_separation_m": 0.0}
"""Planned at once, however busy the machine is."""
WRONG = (
    {"json": {**EXAMPLE, "slot": 1}},
    {"json": [EXAMPLE]},
    {"content": b"{", "headers": {"Content-Type": "application/json"}},
    {"content": b"{}", "headers": {"Content-Type": "text/plain"}},
    {"content": b"x" * 70_000, "headers": {"Content-Type": "application/json"}},
)


def test_it_answers_as_the_route() -> None:
    with TestClient(ideal_app()) as client:
        short = client.post(PATH, json=UNLIMITED)
        usual = client.post(f"{PATH}?max_ms=250", json=UNLIMITED)
    assert short.json().pop("compute_ms") > 0.0
    assert {**short.json(), "compute_ms": 0} == {**usual.json(), "compute_ms": 0}
    assert set(short.headers) == set(usual.headers)


@pytest.mark.parametrize("sent", WRONG)
def test_it_refuses_as_the_route(sent) -> None:
    with TestClient(ideal_app()) as client:
        short, usual = client.post(PATH, **sent), client.post(f"{PATH}?max_ms=250", **sent)
    assert short.status_code == usual.status_code >= 400
    assert short.json() == usual.json()


def test_it_is_counted_as_the_route() -> None:
    app = ideal_app()
    with TestClient(app) as client:
        client.post(PATH, json=UNLIMITED)
    counted = {"route": PATH, "method": "POST", "status": "200"}
    assert app.state.metrics.value("relguide_requests_total", **counted) == 1.0
