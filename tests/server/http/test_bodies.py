"""Work for a client goes on while it waits for the answer, and no longer."""

import asyncio
from collections.abc import Awaitable, Callable

import pytest
from relguide_server.http.bodies import unless_left
from relguide_server.http.errors import Refusal
from starlette.requests import ClientDisconnect, Request
from starlette.types import Message


def ask(left: asyncio.Event) -> Request:
    """A request that has been read, whose client leaves at some time."""

    async def receive() -> Message:
        await left.wait()
        return {"type": "http.disconnect"}

    return Request({"type": "http", "method": "POST", "path": "/", "headers": []}, receive)


def play(scene: Callable[[asyncio.Event], Awaitable[None]]) -> None:
    async def run() -> None:
        await scene(asyncio.Event())
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(run())


async def give(value: int) -> int:
    await asyncio.sleep(0.0)
    return value


def test_what_the_work_gives_is_given() -> None:
    async def scene(left: asyncio.Event) -> None:
        assert await unless_left(ask(left), give(7)) == 7
        await asyncio.sleep(0.0)

    play(scene)


def test_what_the_work_refuses_is_refused() -> None:
    async def refuse() -> None:
        raise Refusal(503, "No.")

    async def scene(left: asyncio.Event) -> None:
        with pytest.raises(Refusal, match="No"):
            await unless_left(ask(left), refuse())
        await asyncio.sleep(0.0)

    play(scene)


def test_a_client_that_leaves_ends_the_work() -> None:
    ended: list[str] = []

    async def work() -> None:
        try:
            await asyncio.sleep(60.0)
        except asyncio.CancelledError:
            ended.append("work")
            raise

    async def scene(left: asyncio.Event) -> None:
        serving = asyncio.create_task(unless_left(ask(left), work()))
        asyncio.get_running_loop().call_later(0.01, left.set)
        await asyncio.wait((serving,), timeout=10.0)
        assert serving.done()
        assert isinstance(serving.exception(), ClientDisconnect)
        assert serving.cancelling() == 0  # it is not on its way out for that
        assert ended == ["work"]

    play(scene)


def test_a_client_that_leaves_as_the_work_ends_disturbs_nothing_after_it() -> None:
    async def scene(left: asyncio.Event) -> None:
        for passes in range(6):
            left.clear()

            async def work(count: int = passes) -> int:
                left.set()
                for _ in range(count):
                    await asyncio.sleep(0.0)
                return count

            try:
                assert await unless_left(ask(left), work()) == passes
            except ClientDisconnect:
                pass
            await asyncio.sleep(0.01)

    play(scene)


def test_a_request_that_the_server_ends_has_not_left() -> None:
    async def scene(left: asyncio.Event) -> None:
        serving = asyncio.create_task(unless_left(ask(left), asyncio.sleep(60.0)))
        await asyncio.sleep(0.01)
        serving.cancel()
        with pytest.raises(asyncio.CancelledError):
            await serving

    play(scene)
