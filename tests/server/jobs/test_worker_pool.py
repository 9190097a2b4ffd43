"""Workers: jobs in processes, bounded queues, and nobody who starves another."""

import asyncio
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager

import pytest
from relguide_server.http.errors import Refusal
from relguide_server.jobs.worker import LENGTH
from relguide_server.jobs.worker_pool import WorkerPool

ANY = 20.0


def with_workers(
    count: int, scene: Callable[[WorkerPool], Awaitable[None]], *, queue: int = 8
) -> None:
    """Play a scene with workers that begin at once."""

    async def play() -> None:
        workers = WorkerPool(count, queue=queue)
        workers.start(lambda: True, os.getpid)
        try:
            await scene(workers)
        finally:
            await workers.stop()

    asyncio.run(play())


def exists(pid: int) -> bool:
    return os.path.exists(f"/proc/{pid}")


def test_processes_do_jobs_and_leave_with_the_service() -> None:
    processes = []

    async def scene(workers: WorkerPool) -> None:
        ids = {await workers.do("plans", os.getpid, patience=ANY) for _ in range(4)}
        assert os.getpid() not in ids
        assert ids <= set(workers.processes)
        processes.extend(workers.processes)
        assert all(map(exists, processes))

    with_workers(2, scene)
    assert not any(map(exists, processes))


def test_a_job_that_is_stuck_is_killed_and_its_process_replaced() -> None:
    async def scene(workers: WorkerPool) -> None:
        before = await workers.do("plans", os.getpid, patience=ANY)
        with pytest.raises(Refusal, match="was ended"):
            await workers.do("plans", time.sleep, 3600.0, patience=0.2)
        after = await workers.do("plans", os.getpid, patience=ANY)
        assert after != before
        assert not exists(before)
        assert workers.killed == 1

    with_workers(1, scene)


def crash(how: int) -> None:
    os.kill(os.getpid(), how)
    time.sleep(60.0)


@pytest.mark.parametrize("how", [signal.SIGSEGV, signal.SIGKILL, signal.SIGABRT])
def test_a_process_that_dies_in_a_job_is_replaced_and_the_others_go_on(how: int) -> None:
    async def scene(workers: WorkerPool) -> None:
        going_on = asyncio.create_task(workers.do("areas", nap, 0.5, patience=ANY))
        dying = workers.do("plans", crash, how, patience=ANY)
        waiting = [workers.do("plans", os.getpid, patience=ANY) for _ in range(3)]
        died, *others = await asyncio.gather(dying, *waiting, return_exceptions=True)
        assert isinstance(died, Refusal)
        assert (died.status_code, died.headers) == (503, {"Retry-After": "1"})
        assert died.detail == "The process that worked on this ended before its time: try again."
        assert all(isinstance(pid, int) and exists(pid) for pid in others)
        assert await going_on > 0
        assert len(workers.processes) == 2

    with_workers(2, scene)


@pytest.mark.parametrize("how", [signal.SIGSEGV, signal.SIGKILL])
def test_a_process_that_dies_while_it_waits_costs_nobody_an_answer(how: int) -> None:
    async def scene(workers: WorkerPool) -> None:
        before = await workers.do("plans", os.getpid, patience=ANY)
        os.kill(before, how)
        while workers.processes:
            await asyncio.sleep(0.01)
        assert await workers.do("plans", os.getpid, patience=ANY) != before

    with_workers(1, scene)


def test_what_workers_spent_is_kept_when_they_end() -> None:
    async def scene(workers: WorkerPool) -> None:
        await workers.do("plans", sum, range(20_000_000), patience=ANY)
        spent = workers.processor_time
        assert spent > 0.05
        os.kill(workers.processes[0], signal.SIGKILL)
        while workers.processes:
            await asyncio.sleep(0.01)
        await workers.do("plans", os.getpid, patience=ANY)
        assert workers.processor_time >= spent

    with_workers(1, scene)


def test_a_client_that_leaves_takes_its_job_along(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level("INFO")

    async def scene(workers: WorkerPool) -> None:
        before = await workers.do("plans", os.getpid, patience=ANY)
        running = asyncio.create_task(workers.do("plans", time.sleep, 3600.0, patience=ANY))
        waiting = asyncio.create_task(workers.do("plans", time.sleep, 3600.0, patience=ANY))
        await asyncio.sleep(0.1)
        assert workers.waiting["plans"] == 1
        waiting.cancel()
        running.cancel()
        assert await workers.do("plans", os.getpid, patience=ANY) != before

    with_workers(1, scene)
    assert caplog.messages == ["A job whose client had left was ended."]


@contextmanager
def held(gate: threading.Event) -> Iterator[None]:
    try:
        yield
    finally:
        gate.set()


def test_a_full_queue_refuses_and_says_when_to_come_again() -> None:
    gate = threading.Event()

    async def scene(workers: WorkerPool) -> None:
        jobs = []
        for count in (3, 8):  # of four threads one is kept from areas
            for _ in range(count):
                job = workers.do("areas", gate.wait, patience=ANY, client=str(len(jobs)))
                jobs.append(asyncio.create_task(job))
            await asyncio.sleep(0.05)
        with pytest.raises(Refusal) as refused:
            await workers.do("areas", gate.wait, patience=ANY, client="another")
        assert refused.value.status_code == 503
        assert refused.value.headers == {"Retry-After": "1"}
        said = "8 areas wait already, the most that may: try again in a moment."
        assert str(refused.value.detail) == said
        assert workers.full["areas"] == 1
        # others have a queue of their own, and a hand
        assert await workers.do("plans", int, "7", patience=ANY) == 7
        gate.set()
        assert await asyncio.gather(*jobs) == [True] * len(jobs)

    with held(gate):
        with_workers(0, scene)


def test_a_client_is_told_that_its_own_jobs_are_too_many() -> None:
    gate = threading.Event()

    async def scene(workers: WorkerPool) -> None:
        jobs = []
        for _ in range(3 + 4):  # three areas at once; of a queue of eight a client has half
            jobs.append(asyncio.create_task(workers.do("areas", gate.wait, patience=ANY)))
            await asyncio.sleep(0.02)
        with pytest.raises(Refusal, match="4 areas of yours wait already, the most of a client's"):
            await workers.do("areas", gate.wait, patience=ANY)
        gate.set()
        assert await asyncio.gather(*jobs) == [True] * len(jobs)

    with held(gate):
        with_workers(0, scene)


def test_what_a_job_returns_is_heard_even_if_its_client_has_left() -> None:
    async def scene(workers: WorkerPool) -> None:
        heard: list[int] = []
        job = workers.do("plans", nap, 0.1, patience=ANY, heard=heard.append)
        leaving = asyncio.create_task(job)
        await asyncio.sleep(0.05)
        leaving.cancel()
        while not heard:
            await asyncio.sleep(0.01)
        assert heard == [os.getpid()]

    with_workers(0, scene)


def test_plans_and_trials_take_turns() -> None:
    """However many trials wait, a plan waits for one of them."""
    done = []

    async def scene(workers: WorkerPool) -> None:
        kinds = ["trials"] * 6 + ["plans"] * 2
        held = [asyncio.create_task(workers.do("areas", nap, 0.5, patience=ANY)) for _ in "abc"]
        await asyncio.sleep(0.05)
        jobs = []
        for number, kind in enumerate(kinds):
            job = workers.do(
                kind,  # type: ignore[arg-type]
                nap,
                0.01,
                patience=ANY,
                client=str(number),
                heard=lambda _, kind=kind: done.append(kind),
            )
            jobs.append(asyncio.create_task(job))
        await asyncio.gather(*jobs, *held)

    with_workers(0, scene)
    assert done[:4].count("plans") == 2


def test_quick_plans_have_a_hand_that_does_nothing_else() -> None:
    """It is the one asked if it is free; the others are nicer, and help where it is not."""

    async def scene(workers: WorkerPool) -> None:
        await asyncio.gather(*(workers.do("areas", time.sleep, 0.05, patience=ANY) for _ in "abcd"))
        kept = {await workers.do("plans", os.getpid, patience=ANY) for _ in range(8)}
        others = {await workers.do("areas", os.getpid, patience=ANY) for _ in range(8)}
        assert len(kept) == 1
        assert kept | others == set(workers.processes)
        assert not kept & others
        assert await workers.do("plans", os.nice, 0, patience=ANY) == os.nice(0)
        assert await workers.do("areas", os.nice, 0, patience=ANY) == 19
        assert await workers.do("plans", os.sched_getscheduler, 0, patience=ANY) == os.SCHED_OTHER
        assert await workers.do("areas", os.sched_getscheduler, 0, patience=ANY) == os.SCHED_IDLE
        both = [workers.do("plans", nap, 0.3, patience=ANY) for _ in "ab"]
        assert set(await asyncio.gather(*both)) == set(workers.processes)

    with_workers(2, scene)


def test_a_killed_process_that_does_not_go_costs_no_hand(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    kill, killed = subprocess.Popen.kill, list[subprocess.Popen[bytes]]()

    def note(process: subprocess.Popen[bytes]) -> None:
        killed.append(process)

    monkeypatch.setattr(subprocess.Popen, "kill", note)  # it stays, as if the kernel held it
    monkeypatch.setattr("relguide_server.jobs.executors.END_PATIENCE", 0.1)

    async def scene(workers: WorkerPool) -> None:
        before = await workers.do("plans", os.getpid, patience=ANY)
        with pytest.raises(Refusal, match="was ended"):
            await workers.do("plans", time.sleep, 3600.0, patience=0.2)
        assert await workers.do("plans", os.getpid, patience=ANY) != before

    with_workers(1, scene)
    for process in killed:
        kill(process)
        process.wait(20.0)
    assert "not gone yet" in caplog.text


def nap(seconds: float) -> int:
    time.sleep(seconds)
    return os.getpid()


def test_a_worker_whose_service_was_killed_leaves_without_a_word() -> None:
    command = [sys.executable, "-m", "relguide_server.jobs.worker"]
    job = pickle.dumps((time.sleep, (0.5,)))
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as worker:
        assert worker.stdin
        assert worker.stdout
        assert worker.stderr
        worker.stdin.write(len(job).to_bytes(LENGTH, "big") + job)
        worker.stdin.flush()
        worker.stdout.close()
        assert worker.wait(20.0) == 1
        assert worker.stderr.read() == b""


def test_kinds_take_turns() -> None:
    done: list[str] = []

    async def scene(workers: WorkerPool) -> None:
        gate = asyncio.create_task(workers.do("plans", time.sleep, 0.2, patience=ANY))
        await asyncio.sleep(0.05)

        async def ask(kind: str) -> None:
            await workers.do(kind, int, patience=ANY)  # type: ignore[arg-type]
            done.append(kind)

        async with asyncio.TaskGroup() as group:
            for kind in ("batches",) * 4 + ("plans",) * 2:
                group.create_task(ask(kind))
        await gate

    with_workers(1, scene)
    assert done.index("plans") <= 1
    assert sorted(done[:4]) == ["batches"] * 2 + ["plans"] * 2


def test_a_mistake_of_ours_in_a_job_is_a_sentence() -> None:
    async def scene(workers: WorkerPool) -> None:
        with pytest.raises(Refusal, match="The server made a mistake") as refused:
            await workers.do("plans", int, "seven", patience=ANY)
        assert refused.value.status_code == 500

    with_workers(0, scene)


def test_clients_of_a_kind_take_turns() -> None:
    done: list[str] = []

    async def scene(workers: WorkerPool) -> None:
        gate = asyncio.create_task(workers.do("plans", time.sleep, 0.2, patience=ANY))
        await asyncio.sleep(0.05)

        async def ask(client: str) -> None:
            await workers.do("plans", int, patience=ANY, client=client)
            done.append(client)

        async with asyncio.TaskGroup() as group:
            for client in ("greedy",) * 4 + ("modest",):
                group.create_task(ask(client))
        await gate

    with_workers(1, scene)
    assert done.index("modest") <= 1


def test_workers_that_are_frozen_do_not_answer_until_they_are_replaced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("relguide_server.jobs.worker_pool.TO_ANSWER", 0.3)
    monkeypatch.setattr("relguide_server.jobs.worker_pool.PULSE", 0.0)

    async def scene(workers: WorkerPool) -> None:
        await until(workers.answers)
        await asyncio.gather(*(workers.do("plans", nap, 0.3, patience=ANY) for _ in range(2)))
        frozen = list(workers.processes)
        for process in frozen:
            os.kill(process, signal.SIGSTOP)
        assert not await workers.answers()
        await until(workers.answers)
        assert set(workers.processes) != set(frozen)

    with_workers(2, scene)


def test_a_worker_that_is_busy_counts_as_if_it_answered() -> None:
    async def scene(workers: WorkerPool) -> None:
        await until(workers.answers)
        busy = asyncio.create_task(workers.do("plans", nap, 2.0, patience=ANY))
        await asyncio.sleep(0.1)
        assert await asyncio.wait_for(workers.answers(), 1.0)
        assert not busy.done()
        await busy

    with_workers(1, scene)


async def until(happens: Callable[[], Awaitable[bool]]) -> None:
    async with asyncio.timeout(ANY):
        while not await happens():
            await asyncio.sleep(0.05)
