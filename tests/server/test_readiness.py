"""What a first start has yet to compile is refused or waited for, and said."""

import threading
from collections.abc import Callable, Iterator, Sequence
from queue import Queue

import numpy as np
import pytest
from relguide_server import readiness as module
from relguide_server.app import create_app
from relguide_server.flights.catalogue import library_catalogue
from relguide_server.http.errors import Refusal, run_logged
from relguide_server.planning.plans import EXAMPLE
from relguide_server.readiness import ON_DEMAND, Preparation, steps_for
from relguide_server.settings import ServiceSettings

from benchmarks.deadline import draw
from relguide.contract.bodies import situation_from_json
from relguide.planning.outcome import NoPlan, Plan, Reason
from relguide.planning.plan import plan, plan_at_once
from relguide.warm_up import STEPS, Preparing, WarmUpError
from tests.bodies import AMID
from tests.server.serving import TestClient
from tests.situations import golden

STEPS_SERVED = steps_for(ServiceSettings())
LIMITED = {
    **EXAMPLE,
    "pursuer": {**EXAMPLE["pursuer"], "x_m": 0.0, "y_m": 30e3, "heading_deg": 180.0},
    "leader": {"x_m": 0.0, "y_m": 0.0, "heading_deg": 0.0, "tas_mps": 200.0},
    "slot_distance_m": 12e3,
}  # fmt: skip
"""A head-on encounter: the limit binds."""


class Compiling:
    """Nothing is compiled; the test says what is, by the names of steps."""

    def __init__(self) -> None:
        self.asked: list[list[str]] = []
        """Steps that were to be compiled together."""
        self._said: Queue[Preparing | None] = Queue()

    def __call__(
        self, *steps: str, title: str = STEPS["limited"].title, share: float = 0.4
    ) -> None:
        self._said.put(Preparing(title, share, 10, steps))

    def end(self) -> None:
        self._said.put(None)

    def prepare(self, wanted: Sequence[str], **_: object) -> Iterator[Preparing]:
        self.asked.append([*wanted])
        yield from iter(self._said.get, None)


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> Iterator[Compiling]:
    compiling = Compiling()
    monkeypatch.setattr(module, "missing", tuple)
    monkeypatch.setattr(module, "prepare", compiling.prepare)
    yield compiling
    compiling.end()


def _until(happened: Callable[[], bool]) -> None:
    for _ in range(500):
        if happened():
            return
        threading.Event().wait(0.01)
    raise AssertionError("It did not happen.")


def test_a_plan_at_once_is_the_plan_where_the_limit_costs_nothing() -> None:
    relaxed = 0
    for situation, _ in golden("reference")[:150]:
        planned, at_once = plan(situation), plan_at_once(situation)
        if at_once is not None:
            assert isinstance(planned, Plan)
            assert isinstance(at_once, Plan)
            assert planned.optimality.proof == "relaxation"
            assert planned.trajectory == at_once.trajectory
            relaxed += 1
    assert relaxed > 50


def test_what_is_out_of_reach_is_said_at_once_in_the_words_of_the_plan() -> None:
    reasons = set()
    for case in range(200):
        situation = draw(np.random.default_rng([5, case]))
        at_once = plan_at_once(situation)
        if isinstance(at_once, NoPlan):
            assert plan(situation, deadline=1e-3) == at_once
            reasons.add(at_once.reason)
    assert reasons == {Reason.SLOT_UNREACHABLE, Reason.BEYOND_HORIZON}


def test_a_first_start_answers_what_it_can(compiled: Compiling) -> None:
    preparation = Preparation(STEPS_SERVED)
    with TestClient(create_app(ServiceSettings(workers=0), preparation=preparation)) as client:
        refused = client.post("/api/v1/plans", json=EXAMPLE)
        assert refused.status_code == 503
        assert int(refused.headers["Retry-After"]) >= 1
        assert client.post("/api/v1/flights", json={"scenario": "fig_6b"}).status_code == 503

        compiled("flying")
        _until(lambda: preparation.has("flying"))
        assert client.post("/api/v1/plans", json=EXAMPLE).json()["status"] == "planned"
        started = client.post("/api/v1/flights", json={"scenario": "fig_6b", "rate": 60.0})
        assert started.status_code == 201
        refused = client.post("/api/v1/plans", json=LIMITED)
        assert refused.status_code == 503
        assert "the limited search, 40%" in refused.json()["detail"]
        own = client.post("/api/v1/flights", json={"situation": LIMITED})
        assert own.status_code == 503
        assert client.post("/api/v1/plans?include=optimality", json=EXAMPLE).status_code == 503
        flight = {"flight": started.json()["id"]}
        assert client.get("/api/v1/areas", params=flight).status_code == 503
        report = client.get("/readyz")
        assert report.status_code == 503
        assert report.json()["preparing"] == {"name": "the limited search", "share": 0.4}
        warm = {name: name == "flying" for name in (*STEPS_SERVED, *ON_DEMAND)}
        assert report.json()["warm"] == warm

        compiled("flying", "limited", title=STEPS["areas"].title)
        _until(lambda: preparation.ready)
        _until(lambda: client.get("/readyz").json()["status"] == "ready")
        assert client.get("/readyz").json()["preparing"]["name"] == "areas"
        patient = client.post("/api/v1/plans?max_ms=10000", json=LIMITED)
        assert patient.json()["status"] == "planned"
        assert client.get("/api/v1/areas", params=flight).status_code == 503


def test_only_who_plans_amid_others_waits_for_what_that_needs(compiled: Compiling) -> None:
    preparation = Preparation(STEPS_SERVED)
    with TestClient(create_app(ServiceSettings(workers=0), preparation=preparation)) as client:
        compiled("flying", "limited", title=STEPS["amid"].title)
        _until(lambda: preparation.ready)
        assert client.post("/api/v1/plans", json=LIMITED).json()["status"] == "planned"
        refused = client.post("/api/v1/plans", json=AMID)
        assert refused.status_code == 503
        assert STEPS["amid"].title in refused.json()["detail"]
        situation = situation_from_json(AMID)[0]
        with pytest.raises(Refusal):
            preparation.guard(plan, "exact", waiting=False)(situation)
        compiled("flying", "limited", "amid")
        _until(lambda: preparation.has("amid"))
        assert client.post("/api/v1/plans", json=AMID).json()["status"] == "planned"


def test_proofs_are_compiled_once_a_request_asks_for_one(compiled: Compiling) -> None:
    preparation = Preparation(STEPS_SERVED)
    with TestClient(create_app(ServiceSettings(workers=0), preparation=preparation)) as client:
        compiled(*STEPS_SERVED)
        compiled.end()
        _until(lambda: client.get("/readyz").json()["preparing"] is None)
        assert compiled.asked == [[*STEPS_SERVED]]
        proof = "/api/v1/plans?include=optimality&max_ms=10000"
        refused = client.post(proof, json=EXAMPLE)
        assert refused.status_code == 503
        assert "proofs of optimality" in refused.json()["detail"]
        compiled(title=STEPS["proofs"].title)
        _until(lambda: client.get("/readyz").json()["preparing"] is not None)
        _until(lambda: client.get("/readyz").status_code == 200)  # its workers are, too
        again = client.post(proof, json=EXAMPLE).json()["detail"]
        assert again.startswith(
            "Compiled at the first request: preparing proofs of optimality, 40%."
        )
        compiled("proofs")
        compiled.end()
        _until(lambda: preparation.has("proofs"))
        assert compiled.asked[1:] == [["proofs"]]
        assert "hamiltonian_residual" in str(client.post(proof, json=EXAMPLE).json())


def test_networks_are_compiled_once_a_request_asks_for_them(compiled: Compiling) -> None:
    """A comparison meanwhile says of each planner whether it is there."""
    preparation = Preparation(STEPS_SERVED)
    with TestClient(create_app(ServiceSettings(workers=0), preparation=preparation)) as client:
        compiled(*STEPS_SERVED)
        compiled.end()
        _until(lambda: client.get("/readyz").status_code == 200)
        asked = "/api/v1/plans?planner=network&max_ms=10000"
        refused = client.post(asked, json=EXAMPLE)
        assert refused.status_code == 503
        assert refused.json()["detail"].startswith("Compiled at the first request: ")
        _until(lambda: len(compiled.asked) == 2)  # before the comparison asks for the tree, too
        compared = client.post("/api/v1/plans/compare", json=EXAMPLE).json()["planners"]
        assert [each["status"] for each in compared] == [
            "planned", "preparing", "preparing", "refused",
        ]  # fmt: skip
        assert "networks" in compared[1]["message"]
        compiled("networks")
        compiled.end()
        _until(lambda: preparation.has("networks"))
        assert compiled.asked[1] == ["networks"]
        assert client.post(asked, json=EXAMPLE).json()["status"] == "planned"


def test_a_flight_waits_and_a_request_does_not(compiled: Compiling) -> None:
    preparation = Preparation(STEPS_SERVED)
    preparation.start(lambda: None)
    compiled("flying")
    _until(lambda: preparation.has("flying"))
    situation = next(s for s, _ in golden("reference") if plan_at_once(s) is None)
    with pytest.raises(Refusal) as refused:
        preparation.guard(plan, "exact", waiting=False)(situation)
    assert refused.value.status_code == 503
    answers: list[object] = []
    patient = preparation.guard(plan, "exact", waiting=True)
    flight = threading.Thread(target=lambda: answers.append(patient(situation)))
    flight.start()
    flight.join(0.2)
    assert not answers
    compiled("flying", "limited")
    flight.join(20.0)
    assert answers == [plan(situation)]
    preparation.stop()


def test_what_waits_as_the_service_stops_ends_quietly(
    compiled: Compiling, caplog: pytest.LogCaptureFixture
) -> None:
    preparation = Preparation(STEPS_SERVED)
    preparation.start(lambda: None)
    compiled("flying")
    _until(lambda: preparation.has("flying"))
    situation = next(s for s, _ in golden("reference") if plan_at_once(s) is None)
    patient = preparation.guard(plan, "exact", waiting=True)
    ends: list[bool] = []
    flight = threading.Thread(
        target=lambda: ends.append(run_logged("A flight", lambda: patient(situation) and None))
    )
    flight.start()
    preparation.dismiss()
    flight.join(20.0)
    preparation.stop()
    assert ends == [True]
    assert not caplog.records


def test_kernels_that_cannot_be_compiled_ahead_hold_nobody_up(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def broken(wanted: object, **_: object) -> Iterator[Preparing]:
        raise WarmUpError("The disk is full.")
        yield

    monkeypatch.setattr(module, "missing", tuple)
    monkeypatch.setattr(module, "prepare", broken)
    preparation = Preparation(STEPS_SERVED)
    preparation.start(lambda: None)
    _until(lambda: preparation.ready)
    assert "The disk is full." in caplog.text
    preparation.stop()


def test_the_first_scenario_never_needs_the_search() -> None:
    """So a first start can fly it to its end while the rest is compiled."""
    asked = []

    def planner(situation: object) -> object:
        found = plan_at_once(situation)  # type: ignore[arg-type]
        asked.append(found)
        return found

    library_catalogue(planner).rehearse()  # type: ignore[arg-type]
    assert asked
    assert None not in asked


@pytest.mark.parametrize("steps", [STEPS_SERVED, ()])
def test_what_a_service_has_loaded_is_not_looked_through_again(
    steps: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A full collection of it holds the event loop for 0.1 s; who embeds the app decides."""
    frozen = []
    monkeypatch.setattr(module.gc, "freeze", lambda: frozen.append(True))
    Preparation(steps)._rehearse(lambda: None)
    assert frozen == [True] * bool(steps)
