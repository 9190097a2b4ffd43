"""The desk: what takes long is begun anew behind what does not, and everybody gets an answer."""

import asyncio
import json
import threading
from collections.abc import Awaitable, Callable
from time import monotonic, sleep

import pytest
from relguide_server.http.errors import Refusal
from relguide_server.http.metrics import Metrics
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.planning.client_budgets import SHORT, TRIAL
from relguide_server.planning.plan_service import PlanService, Wish
from relguide_server.planning.plans import EXAMPLE
from relguide_server.readiness import Preparation

from relguide import NoPlan, Plan, Situation, plan
from relguide.planning.outcome import Reason
from relguide.units import Second

BODY = json.dumps(EXAMPLE).encode()
WISH = Wish(planner=None, include=(), budget=5.0)


@pytest.fixture(autouse=True)
def _sleep_is_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.planning.tasks.thread_time", monotonic)


def at_desk(
    planner: Callable[..., Plan | NoPlan],
    scene: Callable[[PlanService, WorkerPool], Awaitable[None]],
) -> None:
    """Play a scene at a desk whose planner is given, with threads that do the jobs."""

    async def play() -> None:
        workers = WorkerPool(0, queue=4)
        workers.start(lambda: True, int)
        plan_service = PlanService(
            "",
            planner,
            quick=True,
            preparation=Preparation(),
            workers=workers,
            metrics=Metrics(),
        )
        try:
            await scene(plan_service, workers)
        finally:
            await workers.stop()

    asyncio.run(play())


def dawdle(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
    """Takes all the time it has, up to half a second, and plans if it was that much."""
    sleep(min(deadline or 0.0, 0.5))
    if deadline is None or deadline < 0.5:
        return NoPlan(reason=Reason.DEADLINE, message="Not yet.", lower_bound=1.0)
    return plan(situation)


def hesitate(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
    """Takes less than is given to a client of which nothing is known."""
    del deadline
    sleep(TRIAL / 2)
    return plan(situation)


def test_what_takes_long_is_begun_anew_and_gets_its_time() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        answered = await plan_service.answer_by_worker(BODY, WISH, monotonic() + 5.0, client="a")
        assert answered.status == "planned"
        # 0.015 s, 0.25 s, and what it wants of 1 s
        assert (workers.done["trials"], workers.done["long_plans"]) == (1, 2)

    at_desk(dawdle, scene)


def test_who_asked_for_what_takes_long_is_not_tried_quickly_for_a_while() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        for client in ("a", "a", "b"):
            await plan_service.answer_by_worker(BODY, WISH, monotonic() + 0.2, client=client)
        assert (workers.done["trials"], workers.done["long_plans"]) == (2, 3)

    at_desk(dawdle, scene)


def test_of_who_leaves_it_is_known_as_well_how_long_its_plan_took() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        end = monotonic() + 5.0
        leaving = asyncio.create_task(plan_service.answer_by_worker(BODY, WISH, end, client="a"))
        await asyncio.sleep(TRIAL / 4)
        leaving.cancel()
        while not workers.done["trials"]:
            await asyncio.sleep(0.01)
        await plan_service.answer_by_worker(BODY, WISH, monotonic() + 0.2, client="a")
        assert (workers.done["trials"], workers.done["long_plans"]) == (1, 1)

    at_desk(dawdle, scene)


@pytest.fixture
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plans may take ten times as long, so that a busy machine changes nothing."""
    for name, time in (("TRIAL", TRIAL), ("SHORT", SHORT)):
        monkeypatch.setattr(f"relguide_server.planning.client_budgets.{name}", 10.0 * time)


@pytest.mark.usefixtures("_patient")
def test_who_leaves_a_quick_plan_is_not_taken_to_ask_for_what_takes_long() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        end = monotonic() + 5.0
        leaving = asyncio.create_task(plan_service.answer_by_worker(BODY, WISH, end, client="a"))
        await asyncio.sleep(TRIAL / 4)
        leaving.cancel()
        while not workers.done["trials"]:
            await asyncio.sleep(0.01)
        answered = await plan_service.answer_by_worker(BODY, WISH, monotonic() + 5.0, client="a")
        assert answered.status == "planned"
        assert (workers.done["trials"], workers.done["long_plans"]) == (2, 0)

    at_desk(hesitate, scene)


@pytest.mark.usefixtures("_patient")
def test_what_is_refused_is_not_taken_to_take_long() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        with pytest.raises(Refusal):
            await plan_service.answer_by_worker(b"{}", WISH, monotonic() + 5.0, client="a")
        await plan_service.answer_by_worker(BODY, WISH, monotonic() + 5.0, client="a")
        assert (workers.done["trials"], workers.done["long_plans"]) == (2, 0)

    at_desk(hesitate, scene)


def test_who_leaves_soon_costs_no_worker() -> None:
    """What is begun for long is begun for a short while first."""

    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        for client in "abcd":
            end = monotonic() + 10.0
            leaving = asyncio.create_task(
                plan_service.answer_by_worker(BODY, WISH, end, client=client)
            )
            await asyncio.sleep(2.0 * SHORT)  # it is being planned at length
            leaving.cancel()
        await asyncio.sleep(0.6)
        assert workers.done["long_plans"] == 4
        assert workers.killed == 0

    at_desk(dawdle, scene)


def test_what_waits_for_a_processor_is_not_taken_to_take_long(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("relguide_server.planning.tasks.thread_time", lambda: 0.0)

    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        for _ in range(2):
            await plan_service.answer_by_worker(BODY, WISH, monotonic() + 0.3, client="a")
        assert workers.done["trials"] == 6  # 0.015, 0.03 and 0.06 s, then among the others
        assert workers.done["long_plans"] == 2

    at_desk(dawdle, scene)


def test_with_no_time_left_the_first_answer_is_given() -> None:
    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        end = monotonic() + SHORT
        answered = await plan_service.answer_by_worker(BODY, WISH, end, client="a")
        assert answered.status == "no_plan"
        assert workers.done["long_plans"] == 0

    at_desk(dawdle, scene)


def test_with_no_room_for_what_takes_long_the_short_answer_is_given() -> None:
    gate = threading.Event()

    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        held = []
        # of four threads one is kept for what is short, and two jobs of a client may wait
        for client in ("b", "c", "d", "a", "a"):
            job = workers.do("long_plans", gate.wait, patience=60.0, client=client)
            held.append(asyncio.create_task(job))
            await asyncio.sleep(0.05)
        answered = await plan_service.answer_by_worker(BODY, WISH, monotonic() + 5.0, client="a")
        assert answered.status == "no_plan"
        gate.set()
        await asyncio.gather(*held)

    try:
        at_desk(dawdle, scene)
    finally:
        gate.set()


def test_what_no_worker_answers_in_time_is_answered_by_what_is_found_in_no_time() -> None:
    gate = threading.Event()

    async def scene(plan_service: PlanService, workers: WorkerPool) -> None:
        held = [
            asyncio.create_task(workers.do("plans", gate.wait, patience=60.0, client=str(k)))
            for k in range(4)
        ]
        await asyncio.sleep(0.05)
        began = monotonic()
        answered = await plan_service.answer_by_worker(BODY, WISH, began + 0.1, client="a")
        assert answered.status == "no_plan"
        assert workers.waiting["plans"] == 0
        assert 0.1 <= monotonic() - began < 2.0
        gate.set()
        await asyncio.gather(*held)

    try:
        at_desk(dawdle, scene)
    finally:
        gate.set()
