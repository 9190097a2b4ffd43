"""The page that Prometheus reads."""

import asyncio
import re
import socket
import time
from importlib.metadata import version

import httpx2 as httpx
import pytest
from prometheus_client.openmetrics.parser import text_string_to_metric_families
from relguide_server.http.metrics import PLAN_BUCKETS, Metrics
from relguide_server.jobs.worker_pool import KINDS
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.bodies import BODY
from tests.server.flown import ideal_flight
from tests.server.serving import TestClient, ideal_app, serve

OPEN_METRICS = "application/openmetrics-text; version=1.0.0"


def test_an_upper_end_belongs_to_its_bucket() -> None:
    metrics = Metrics()
    for seconds in (0.00005, 0.0001, 0.0002, 5.0):
        metrics.count_plan("planned", "", seconds)
    metrics.count_plan("no_plan", "slot_unreachable", 0.02)
    first, last = (
        metrics.value("relguide_plan_seconds_bucket", le=end)
        for end in (str(PLAN_BUCKETS[0]), "+Inf")
    )
    assert (first, last) == (2, 5)
    assert metrics.value("relguide_plans_total", status="planned") == 4
    assert metrics.value("relguide_no_plans_total", reason="slot_unreachable") == 1


def test_requests_plans_queues_and_errors_are_counted() -> None:
    far = {**BODY, "leader": {**BODY["leader"], "tas_mps": 300.0}, "slot_distance_m": 9260.0}
    with TestClient(ideal_app()) as client:
        client.post("/api/v1/plans?max_ms=10000", json=BODY)
        assert client.post("/api/v1/plans?max_ms=10000", json=far).json()["status"] == "no_plan"
        client.get("/api/v1/flights/none")
        client.request("BREW", "/api/v1/flights")
        client.get("/no/such/page")
        metrics = client.app.state.metrics
        text = client.get("/metrics").text
        open_text = client.get("/metrics", headers={"Accept": OPEN_METRICS})

    def count(route: str, method: str, status: str) -> float:
        return metrics.value("relguide_requests_total", route=route, method=method, status=status)

    assert count("/api/v1/plans", "POST", "200") == 2
    assert count("/api/v1/flights/{flight_id}", "GET", "404") == 1
    assert count("none", "GET", "404") == 1
    assert sum(v for v in [count("/api/v1/flights", "other", "405"), count("none", "other", "405")])
    seconds = {"route": "/api/v1/plans", "method": "POST"}
    assert 0.0 < metrics.value("relguide_request_seconds_sum", **seconds) < 20.0
    assert metrics.value("relguide_plans_total", status="no_plan") == 1
    assert re.search(r'^relguide_no_plans_total\{reason="\w+"\} 1\.0$', text, re.MULTILINE)
    for kind in KINDS:
        assert f'relguide_jobs_waiting{{kind="{kind}"}} 0.0' in text
        assert f'relguide_jobs_refused_total{{kind="{kind}"}} 0.0' in text
    assert open_text.headers["content-type"].startswith("application/openmetrics-text")
    described = {f.name: f.documentation for f in text_string_to_metric_families(open_text.text)}
    assert described["relguide_flights_running"] == "Flights in the air."
    assert all(text.endswith(".") for text in described.values())


def test_doors_streams_flights_and_workers_are_measured() -> None:
    async def send_nonsense(url: str) -> None:
        async with connect(url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None) as stream:
            await stream.send("nonsense")
            await stream.wait_closed()

    app = ideal_app()
    with serve(app) as address, httpx.Client(base_url=f"http://{address}") as client:
        flight = client.post("/api/v1/flights", json={"scenario": "ideal"}).json()
        asyncio.run(send_nonsense(f"ws://{address}{flight['stream_url']}"))
        client.delete(f"/api/v1/flights/{flight['id']}")
        client.post("/api/v1/plans?include=alternatives&max_ms=10000", json=BODY)
        host, _, port = address.partition(":")
        with socket.create_connection((host, int(port))) as hurried:
            hurried.sendall(b"GET /healthz")
            time.sleep(0.1)
        time.sleep(0.1)
        text = client.get("/metrics", headers={"Accept": OPEN_METRICS}).text
    found = {
        sample.name + "".join(str(value) for value in sample.labels.values()): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }
    assert found[f"relguide_build_info{version('relguide')}"] == 1
    assert found["relguide_connections"] == 1
    assert found["relguide_hang_ups_total"] == 1
    for what in ("share", "full", "hang_ups"):
        assert found[f"relguide_connections_refused_total{what}"] == 0
    assert found["relguide_connections_shed_total"] == 0
    assert found["relguide_sockets_cut_off_total"] == 0
    assert found["relguide_frames_refused_totalnot_understood"] == 1
    assert found["relguide_flights_ended_totalremoved"] == 1
    assert found["relguide_job_wait_seconds_counttrials"] == 1
    assert found["relguide_worker_cpu_seconds_total"] == 0  # threads of the service do the work


@pytest.mark.slow
def test_the_rate_that_flights_achieve_is_measured() -> None:
    app = ideal_app(lambda commands: ideal_flight(commands, duration=3600.0))
    with TestClient(app) as client:
        client.post("/api/v1/flights", json={"scenario": "ideal", "rate": 4.0})
        client.portal.call(asyncio.sleep, 3.5)
        metrics = app.state.metrics
        flown = metrics.value("relguide_flight_seconds_total")
        asked = metrics.value("relguide_flight_seconds_asked_total")
        assert 3.0 < asked < 13.0
        assert flown == pytest.approx(asked, rel=0.2)
        assert 0.5 < metrics.value("relguide_flights_least_rate") <= 1.0
