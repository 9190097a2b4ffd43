"""The drift check: a bad network is reported, a good one is not, and nobody waits for it."""

import time
from collections.abc import Callable
from dataclasses import replace
from threading import Event

import pytest
from relguide_server.app import create_app
from relguide_server.http.metrics import Metrics
from relguide_server.planning.drift import WAITING, DriftCheck
from relguide_server.planning.plans import EXAMPLE
from relguide_server.settings import ServiceSettings

from relguide import NoPlan, Plan, Planner, Situation, plan
from tests.bodies import change
from tests.server.flown import SITUATION
from tests.server.serving import TestClient

PATIENCE = 60.0
"""How long an audit may take [s]: kernels may have to be compiled first."""


def slow_network(situation: Situation) -> Plan | NoPlan:
    """Plans that turn at half of the bank, and say that a network made them."""
    gentle = replace(situation.pursuer, max_bank=0.5 * situation.pursuer.max_bank)
    answer = as_network(replace(situation, pursuer=gentle))
    return replace(answer, situation=situation) if isinstance(answer, Plan) else answer


def as_network(situation: Situation) -> Plan | NoPlan:
    """The exact planner, which says it is a network."""
    answer = plan(situation)
    return replace(answer, planner="network") if isinstance(answer, Plan) else answer


def until(holds: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def value(metrics: Metrics, name: str) -> float:
    return metrics.value(f"relguide_{name}")


def audited(metrics: Metrics, *answers: str) -> float:
    """Audits with these answers; all if none is named."""
    named = answers or ("same", "different")
    return sum(metrics.value("relguide_drift_audits_total", answer=answer) for answer in named)


def metrics_after(planner: Planner, *, audits: int) -> dict[str, float]:
    """What `/metrics` shows after so many audits of eight answers."""
    app = create_app(ServiceSettings(drift_check=2), planner=planner)
    metrics: Metrics = app.state.metrics
    bodies = [change("pursuer.heading_deg", 45.0 * k) for k in range(8)]
    for body in bodies:
        body["leader"] = {**body["leader"], "intent": []}
    with TestClient(app) as client:
        answers = client.post("/api/v1/plans/batch", json=bodies).json()
        assert [answer["status"] for answer in answers] == ["planned"] * 8
        until(lambda: audited(metrics) >= audits)
        lines = client.get("/metrics").text.splitlines()
    return {
        line.split()[0].removeprefix("relguide_"): float(line.split()[1])
        for line in lines
        if line[0] != "#"
    }


@pytest.mark.slow
def test_a_bad_network_is_reported() -> None:
    found = metrics_after(slow_network, audits=1)
    asked = found["network_plans_total"] + found["network_fallbacks_total"]
    assert asked >= 8.0  # the first flight of the rehearsal asks too
    assert found['drift_audits_total{answer="different"}'] >= 1.0
    assert 1.0 < found["drift_largest_loss_seconds"] <= found["drift_loss_seconds_total"]


def test_a_good_network_is_not() -> None:
    found = metrics_after(as_network, audits=4)
    assert found["network_plans_total"] >= 8.0
    assert found['drift_audits_total{answer="same"}'] >= 4.0
    assert found['drift_audits_total{answer="different"}'] == 0.0
    assert found["drift_loss_seconds_total"] == found["drift_largest_loss_seconds"] == 0.0


def test_what_is_not_the_networks_is_not_audited() -> None:
    metrics = Metrics()
    exact = DriftCheck(metrics, every=1).watch(plan)
    assert isinstance(exact(SITUATION), Plan)
    fallen = DriftCheck(metrics, every=1).watch(lambda s: replace(plan(s), fell_back=True))
    assert isinstance(fallen(SITUATION), Plan)
    assert value(metrics, "network_plans_total") == 0
    assert value(metrics, "network_fallbacks_total") == 1
    for every, waiting in ((0, 0), (1, 3), (3, 1)):
        check = DriftCheck(Metrics(), every=every)
        for _ in range(3):
            check.watch(as_network)(SITUATION)
        assert check._waiting.qsize() == waiting


def test_with_too_much_to_do_answers_are_left_out_and_nobody_waits() -> None:
    begun, free = Event(), Event()

    def slow(situation: Situation) -> Plan | NoPlan:
        begun.set()
        assert free.wait(PATIENCE)
        return plan(situation)

    metrics = Metrics()
    check = DriftCheck(metrics, every=1, exact=slow)
    planner = check.watch(as_network)
    check.start()
    planner(SITUATION)
    assert begun.wait(PATIENCE)
    for _ in range(WAITING + 5):
        planner(SITUATION)  # would never return if it waited
    assert value(metrics, "drift_dropped_total") == 5
    free.set()
    until(lambda: audited(metrics, "same") == WAITING + 1)
    check.stop()


def test_a_mistake_in_an_audit_is_logged_and_the_next_is_made(
    caplog: pytest.LogCaptureFixture,
) -> None:
    asked = iter((ZeroDivisionError("ours"), None))

    def broken(situation: Situation) -> Plan | NoPlan:
        mistake = next(asked)
        if mistake is not None:
            raise mistake
        return plan(situation)

    metrics = Metrics()
    check = DriftCheck(metrics, every=1, exact=broken)
    check.start()
    for _ in range(2):
        check.watch(as_network)(SITUATION)
    until(lambda: audited(metrics, "same") == 1)
    check.stop()
    assert "An audit of the drift check stopped by a mistake of ours" in caplog.text


def test_where_the_exact_planner_has_none_the_answers_differ() -> None:
    metrics = Metrics()
    none = plan(replace(SITUATION, leader=replace(SITUATION.leader, tas=390.0)))
    assert isinstance(none, NoPlan)
    check = DriftCheck(metrics, every=1, exact=lambda _: none)
    check.start()
    check.watch(as_network)(SITUATION)
    until(lambda: audited(metrics, "different") == 1)
    check.stop()
    assert value(metrics, "drift_loss_seconds_total") == 0.0
    assert value(metrics, "drift_largest_loss_seconds") == 0.0


@pytest.mark.slow
def test_the_settings_choose_who_plans() -> None:
    app = create_app(ServiceSettings(planner="network", drift_check=0))
    with TestClient(app) as client:
        body = {**EXAMPLE, "leader": {**EXAMPLE["leader"], "intent": []}}  # type: ignore[dict-item]
        assert client.post("/api/v1/plans", json=body).json()["planner"] == "network"
        assert value(app.state.metrics, "network_plans_total") >= 1
