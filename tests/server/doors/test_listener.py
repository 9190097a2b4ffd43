"""Who knocks is let in in turn, however many connections another client opens."""

import asyncio
import socket
from collections.abc import Awaitable, Callable
from contextlib import ExitStack
from errno import EADDRINUSE

import pytest
from relguide_server.doors.connection_shares import ConnectionShares
from relguide_server.doors.listener import BEGUN, Listener, bound

Scene = Callable[[int, ConnectionShares, list[str]], Awaitable[None]]


def play(scene: Scene) -> None:
    """Play a scene at a port, given it, its shares, and who was let in so far."""
    let_in: list[str] = []

    class Guest(asyncio.Protocol):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            let_in.append(transport.get_extra_info("peername")[0])

    async def run() -> None:
        shares = ConnectionShares(300, lambda host: False)
        ports = bound("127.0.0.1", 0)
        listener = Listener(ports, shares, Guest)
        await scene(ports[0].getsockname()[1], shares, let_in)
        listener.close()
        await listener.wait_closed()

    asyncio.run(run())


def knock(port: int, host: str) -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), 5.0, source_address=(host, 0))


def test_clients_take_turns() -> None:
    async def scene(port: int, shares: ConnectionShares, let_in: list[str]) -> None:
        with ExitStack() as stack:
            for _ in range(100):
                stack.enter_context(knock(port, "127.0.0.2"))
            stack.enter_context(knock(port, "127.0.0.3"))
            while len(let_in) < 101:
                await asyncio.sleep(0.01)
        assert let_in.index("127.0.0.3") < BEGUN

    play(scene)


def test_who_has_left_meanwhile_is_not_begun_and_is_counted() -> None:
    async def scene(port: int, shares: ConnectionShares, let_in: list[str]) -> None:
        for _ in range(5):
            knock(port, "127.0.0.2").close()
        with knock(port, "127.0.0.3"):
            while not let_in:
                await asyncio.sleep(0.01)
        assert let_in == ["127.0.0.3"]
        assert shares.hang_ups == 5

    play(scene)


def test_a_client_may_let_no_more_wait_than_are_served() -> None:
    async def scene(port: int, shares: ConnectionShares, let_in: list[str]) -> None:
        with ExitStack() as stack:
            for _ in range(2 * shares.most):
                stack.enter_context(knock(port, "127.0.0.2"))
            await asyncio.sleep(0.5)
        assert shares.most <= len(let_in) < 2 * shares.most

    play(scene)


def test_a_port_that_is_taken_is_an_error() -> None:
    (taken,) = bound("127.0.0.1", 0)
    taken.listen()
    with taken, pytest.raises(OSError, match="in use") as refused:
        bound("127.0.0.1", taken.getsockname()[1])
    assert refused.value.errno == EADDRINUSE
