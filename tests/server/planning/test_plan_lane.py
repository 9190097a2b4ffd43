"""The lane of plans: it answers what the route would, and is counted as the route."""

import pytest
from relguide_server.planning.plan_lane import wish_of
from relguide_server.planning.plans import EXAMPLE, PATH

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


def by_route(query: str) -> str:
    """A query that says the same, but not plainly: the route answers."""
    name, _, value = query.partition("=")
    written = f"{name}=%{ord(value[0]):02X}{value[1:]}"
    assert wish_of(written.encode()) is None
    return f"{PATH}?{written}"


@pytest.mark.parametrize(
    "query",
    [
        "max_ms=250",
        "max_ms=99.5&include=alternatives,paths",
        "include=alternatives%2Coptimality",
        "planner=exact&max_ms=1000",
        "format=geojson",
    ],
)
def test_it_answers_as_the_route(query: str) -> None:
    body = {**UNLIMITED}
    for name, lon_deg in (("pursuer", 7.0), ("leader", 8.0)):
        flown = {k: v for k, v in UNLIMITED[name].items() if k not in ("x_m", "y_m")}
        body[name] = {**flown, "lat_deg": 50.0, "lon_deg": lon_deg}
    assert wish_of(query.encode()) is not None
    with TestClient(ideal_app()) as client:
        short = client.post(f"{PATH}?{query}", json=body)
        usual = client.post(by_route(query), json=body)
    assert short.status_code == 200
    assert {**short.json(), "compute_ms": 0} == {**usual.json(), "compute_ms": 0}
    assert set(short.headers) == set(usual.headers)
    assert short.headers["content-type"] == usual.headers["content-type"]


@pytest.mark.parametrize(
    "query",
    [
        "max_ms=0",
        "max_ms=10001",
        "max_ms=1e3",
        "max_ms=",
        "max_ms=5&max_ms=6",
        "include=all",
        "include=",
        "planner=fast",
        "planner=",
        "format=xml",
        "deadline=5",
        "max_ms",
        "&",
        "max_ms=5&",
        "include=" + 30 * "paths,",
    ],
)
def test_what_is_not_plain_goes_to_the_route(query: str) -> None:
    assert wish_of(query.encode()) is None


def test_without_parameters_it_answers_as_the_route() -> None:
    with TestClient(ideal_app()) as client:
        short = client.post(PATH, json=UNLIMITED)
        usual = client.post(by_route("max_ms=250"), json=UNLIMITED)
    assert short.json().pop("compute_ms") > 0.0
    assert {**short.json(), "compute_ms": 0} == {**usual.json(), "compute_ms": 0}
    assert set(short.headers) == set(usual.headers)


@pytest.mark.parametrize("sent", WRONG)
def test_it_refuses_as_the_route(sent) -> None:
    with TestClient(ideal_app()) as client:
        short, usual = client.post(PATH, **sent), client.post(by_route("max_ms=250"), **sent)
    assert short.status_code == usual.status_code >= 400
    assert short.json() == usual.json()


def test_it_is_counted_as_the_route() -> None:
    app = ideal_app()
    with TestClient(app) as client:
        client.post(PATH, json=UNLIMITED)
    counted = {"route": PATH, "method": "POST", "status": "200"}
    assert app.state.metrics.value("relguide_requests_total", **counted) == 1.0
