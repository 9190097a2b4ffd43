"""Many requests of a client keep nobody waiting."""

import asyncio
from collections.abc import Callable

import pytest
from relguide_server.jobs.admission import Admission
from starlette.types import Message, Receive, Scope, Send


async def receive() -> Message:
    return {"type": "http.disconnect"}


async def send(message: Message) -> None:
    del message


def play(clients: str) -> tuple[list[str], dict[str, int]]:
    """Requests of clients, all there in one pass.

    Returns:
        Who began, in turn; and in which pass the last of each did.
    """
    begun: list[str] = []
    last: dict[str, int] = {}
    now = 0

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        begun.append(scope["client"][0])
        last[scope["client"][0]] = now

    async def run() -> None:
        nonlocal now
        passes = Admission(app)
        requests = [
            asyncio.create_task(passes({"type": "http", "client": (name, 1)}, receive, send))
            for name in clients
        ]
        while not all(request.done() for request in requests):
            await asyncio.sleep(0.0)
            now += 1

    asyncio.run(run())
    return begun, last


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every pass is long."""
    monkeypatch.setattr("relguide_server.jobs.admission.LONG", -1.0)


@pytest.mark.usefixtures("slow")
def test_once_a_pass_is_long_requests_begin_one_by_one_and_clients_take_turns() -> None:
    begun, last = play("a" * 20 + "b" + "c" * 3)
    assert begun[:3] == ["a", "b", "c"]
    assert sorted(begun) == sorted("a" * 20 + "b" + "c" * 3)
    assert last["b"] <= 3
    assert last["c"] <= 8
    assert last["a"] >= 22


def test_in_a_short_pass_all_begin() -> None:
    begun, last = play("aaaab")
    assert begun == list("aaaab")
    assert set(last.values()) == {0}


@pytest.mark.usefixtures("slow")
def test_who_gives_up_keeps_nobody_waiting() -> None:
    begun: list[int] = []

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        begun.append(scope["client"][1])

    async def run() -> None:
        passes = Admission(app)
        ask: Callable[[int], asyncio.Task[None]] = lambda number: asyncio.create_task(  # noqa: E731
            passes({"type": "http", "client": ("a", number)}, receive, send)
        )
        first, second, third = ask(1), ask(2), ask(3)
        await asyncio.sleep(0.0)
        second.cancel()
        await asyncio.gather(first, second, third, return_exceptions=True)

    asyncio.run(run())
    assert begun == [1, 3]


def test_who_asks_in_a_short_pass_does_not_wait_for_those_of_a_long_one(
    slow: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[str] = []

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        begun.append(scope["client"][0])

    async def run() -> None:
        passes = Admission(app)

        def ask(name: str) -> asyncio.Task[None]:
            return asyncio.create_task(passes({"type": "http", "client": (name, 1)}, receive, send))

        many = [ask("a") for _ in range(5)]
        await asyncio.sleep(0.0)
        monkeypatch.setattr("relguide_server.jobs.admission.LONG", 10.0)
        await asyncio.gather(ask("b"), *many)

    asyncio.run(run())
    assert begun.index("b") <= 1
