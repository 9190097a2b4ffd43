"""Connections are bounded: in number, of a client's, and in what they may be made to wait for."""

import asyncio
import json
import socket
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress

import httpx2 as httpx
import pytest
from relguide_server.doors.connection_shares import HANG_UPS, TOLD
from starlette.responses import Response

from tests.server.serving import ideal_app, serve

HEALTH = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
ASK = b"GET /api/v1/flights HTTP/1.1\r\nHost: localhost\r\nX-Request-ID: %s\r\n\r\n"
UPGRADE = (
    b"GET /api/v1/flights/x/stream HTTP/1.1\r\nHost: localhost\r\nConnection: upgrade\r\n"
    b"Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
MOST = 8


@contextmanager
def connected(address: str, source: str = "127.0.0.1") -> Iterator[socket.socket]:
    host, _, port = address.partition(":")
    with socket.create_connection((host, int(port)), 10.0, source_address=(source, 0)) as sent:
        yield sent


def ask(sent: socket.socket, wanted: bytes = ASK % b"a") -> tuple[int, dict[str, str], bytes]:
    """Status, headers and body of an answer."""
    sent.sendall(wanted)
    came = b""
    while b"\r\n\r\n" not in came:
        part = sent.recv(65536)
        if not part:
            raise ConnectionError("It hung up.")
        came += part
    head, _, body = came.partition(b"\r\n\r\n")
    lines = head.decode().split("\r\n")
    headers = dict(line.lower().split(": ", 1) for line in lines[1:])
    while len(body) < int(headers.get("content-length", 0)):
        body += sent.recv(65536)
    return int(lines[0].split()[1]), headers, body


@pytest.fixture
def address() -> Iterator[str]:
    with serve(ideal_app(), most=MOST) as at:
        yield at


def fill(stack: ExitStack, address: str, count: int, source: str) -> list[socket.socket]:
    opened = [stack.enter_context(connected(address, source)) for _ in range(count)]
    for each in opened:
        assert ask(each)[0] == 200
    return opened


@pytest.mark.parametrize("wanted", [ASK % b"a", UPGRADE], ids=["request", "socket"])
def test_a_client_has_half_of_them_and_is_told_so(address: str, wanted: bytes) -> None:
    with ExitStack() as stack:
        first = fill(stack, address, MOST // 2, "127.0.0.2")
        with connected(address, "127.0.0.2") as one_more:
            status, headers, body = ask(one_more, wanted)
        assert status == 503
        assert headers["content-type"] == "application/problem+json"
        assert headers["retry-after"] == "1"
        assert headers["connection"] == "close"
        assert "relguide-version" in headers
        assert json.loads(body)["type"] == "/docs/problems#busy"
        assert "You have 4 connections already" in json.loads(body)["detail"]
        with connected(address, "127.0.0.3") as other:
            assert ask(other)[0] == 200
        assert all(ask(each)[0] == 200 for each in first)


def test_who_is_new_gets_in_and_the_idlest_of_who_has_most_goes(address: str) -> None:
    with ExitStack() as stack:
        first = fill(stack, address, MOST // 2, "127.0.0.2")
        few = fill(stack, address, MOST // 2 - 1, "127.0.0.3")
        last = fill(stack, address, 1, "127.0.0.4")
        assert ask(first[0])[0] == 200
        with connected(address, "127.0.0.5") as new:
            assert ask(new)[0] == 200
            assert all(ask(each)[0] == 200 for each in (first[0], *first[2:], *few, *last, new))
            with pytest.raises(ConnectionError):
                ask(first[1])


def test_who_only_asks_for_health_is_idle(address: str) -> None:
    with ExitStack() as stack:
        first = fill(stack, address, MOST // 2, "127.0.0.2")
        fill(stack, address, MOST // 2 - 1, "127.0.0.3")
        fill(stack, address, 1, "127.0.0.4")
        for each in first[1:]:
            assert ask(each)[0] == 200
        assert ask(first[0], HEALTH)[0] == 200
        with connected(address, "127.0.0.5") as new:
            assert ask(new)[0] == 200
            with pytest.raises(ConnectionError):
                ask(first[0])


def test_health_is_answered_whoever_asks(address: str) -> None:
    with ExitStack() as stack:
        fill(stack, address, MOST // 2, "127.0.0.2")
        with connected(address, "127.0.0.2") as one_more:
            status, headers, _ = ask(one_more, HEALTH)
            assert (status, headers["connection"]) == (200, "close")


def test_nobody_is_shed_while_answered() -> None:
    app = ideal_app()
    going = threading.Event()

    @app.get("/slow")
    async def answer() -> str:
        await asyncio.to_thread(going.wait, 10.0)
        return "done"

    with serve(app, most=4) as address, ExitStack() as stack:
        opened = [
            stack.enter_context(connected(address, source))
            for source in ("127.0.0.2", "127.0.0.2", "127.0.0.3", "127.0.0.3")
        ]
        for each in opened:
            each.sendall(ASK.replace(b"/api/v1/flights", b"/slow") % b"a")
        time.sleep(0.2)
        with connected(address, "127.0.0.4") as late:
            status, _, body = ask(late)
        assert status == 503
        assert "This server has 4 connections" in json.loads(body)["detail"]
        going.set()
        assert all(b" 200 " in each.recv(65536) for each in opened)


def test_a_body_that_does_not_come_keeps_no_place(address: str) -> None:
    begun = b"POST /api/v1/plans HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n"
    with ExitStack() as stack:
        for source in ("127.0.0.2", "127.0.0.3"):
            for _ in range(MOST // 2):
                slow = stack.enter_context(connected(address, source))
                slow.sendall(begun + b"Content-Type: application/json\r\n\r\n{")
        time.sleep(0.2)
        with connected(address, "127.0.0.4") as new:
            assert ask(new)[0] == 200


def test_hundreds_of_idle_connections_shut_nobody_out() -> None:
    with serve(ideal_app(), most=512) as address, ExitStack() as stack:
        for source in ("127.0.0.11", "127.0.0.12"):
            for _ in range(256):
                idle = stack.enter_context(connected(address, source))
                assert ask(idle, HEALTH)[0] == 200
        for _ in range(50):
            with connected(address, "127.0.0.13") as new:
                assert ask(new)[0] == 200


def hang_up(address: str, source: str) -> None:
    with suppress(ConnectionError), connected(address, source) as hurried:
        hurried.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        hurried.sendall(ASK % b"a")


def test_who_hangs_up_again_and_again_is_not_heard_for_a_while(address: str) -> None:
    for _ in range(int(HANG_UPS) // 2):
        hang_up(address, "127.0.0.2")
    with connected(address, "127.0.0.2") as patient:
        assert ask(patient)[0] == 200
    for _ in range(4 * int(HANG_UPS)):
        hang_up(address, "127.0.0.2")
    time.sleep(0.2)
    with pytest.raises(ConnectionError), connected(address, "127.0.0.2") as one_more:
        ask(one_more)
    with connected(address, "127.0.0.3") as other:
        assert ask(other)[0] == 200
    time.sleep(1.5)
    with connected(address, "127.0.0.2") as patient:
        assert ask(patient)[0] == 200


def test_far_too_many_are_closed_unheard_and_keep_nobody_out(address: str) -> None:
    with ExitStack() as stack:
        fill(stack, address, MOST // 2, "127.0.0.2")
        for _ in range(TOLD):  # which say nothing
            stack.enter_context(connected(address, "127.0.0.2"))
        time.sleep(0.2)
        with pytest.raises(ConnectionError), connected(address, "127.0.0.2") as late:
            ask(late)  # if it was not closed while it connected
        with connected(address, "127.0.0.3") as other:
            assert ask(other)[0] == 200
    assert httpx.get(f"http://{address}/healthz").is_success


@pytest.mark.parametrize("path", ["/healthz", "/api/v1/flights/x/stream"])
def test_a_request_has_one_host(address: str, path: str) -> None:
    wanted = UPGRADE.replace(b"/api/v1/flights/x/stream", path.encode())
    wanted = wanted.replace(b"Host: localhost\r\n", b"Host: localhost\r\nHost: evil.example\r\n")
    with connected(address) as sent:
        status, _, body = ask(sent, wanted)
    assert status == 400
    assert json.loads(body)["detail"] == "A request has one Host, not more."


def test_a_proxy_speaks_for_many() -> None:
    with serve(ideal_app(), most=MOST, proxies="127.0.0.2") as address, ExitStack() as stack:
        fill(stack, address, MOST, "127.0.0.2")
        with connected(address, "127.0.0.2") as one_more:
            assert ask(one_more)[0] == 503


def test_who_does_not_read_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.doors.connections.READ_PATIENCE", 0.3)
    app = ideal_app()

    @app.get("/large")
    async def answer() -> Response:
        return Response(b"x" * 20_000_000)

    with serve(app) as address, connected(address) as deaf:
        deaf.sendall(b"GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n")
        deaf.settimeout(5.0)
        time.sleep(1.0)
        came = 0
        with suppress(ConnectionError):
            while part := deaf.recv(65536):
                came += len(part)
    assert came < 20_000_000


@pytest.mark.parametrize(
    "wrong", [b"HELO there\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01"]
)
def test_what_is_no_request_gets_a_problem_too(address: str, wrong: bytes) -> None:
    with connected(address) as sent:
        status, headers, body = ask(sent, wrong)
    assert status == 400
    assert headers["content-type"] == "application/problem+json"
    assert json.loads(body)["type"] == "/docs/problems#not-http"
