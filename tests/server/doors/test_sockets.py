"""A WebSocket that floods is cut off, also one that ignores that it was closed."""

import asyncio
import socket
import time
from collections.abc import Iterator

import httpx2 as httpx
import pytest
from relguide_server.doors.sockets import Socket
from uvicorn.protocols.utils import ClientDisconnected

from relguide.contract.protocol import STREAM
from tests.server.http.test_access import FLIGHT
from tests.server.serving import ideal_app, serve

TEXT, BINARY, MORE, PING, PONG = 0x81, 0x82, 0x00, 0x89, 0x8A
"""First bytes of frames."""
PATIENCE = 5.0


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serve(ideal_app(), proxies="127.0.0.1") as address:  # which may dial again at once
        yield address


def frame(first: int, payload: bytes = b"") -> bytes:
    """A frame of a client, masked with zeros."""
    return bytes((first, 0x80 | len(payload))) + bytes(4) + payload


def dial(address: str) -> socket.socket:
    path = httpx.post(f"http://{address}/api/v1/flights", json=FLIGHT).json()["stream_url"]
    host, _, port = address.partition(":")
    dialled = socket.create_connection((host, int(port)), timeout=PATIENCE)
    head = (
        f"GET {path} HTTP/1.1", f"Host: {address}", "Upgrade: websocket", "Connection: Upgrade",
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==", "Sec-WebSocket-Version: 13",
        f"Sec-WebSocket-Protocol: {STREAM}", "", "",
    )  # fmt: skip
    dialled.sendall("\r\n".join(head).encode())
    assert b" 101 " in dialled.recv(4096)
    return dialled


def is_cut_off(dialled: socket.socket, sent: bytes, pause: float = 0.0) -> bool:
    """Whether the server cuts off who sends the same for a while and never reads."""
    end = time.monotonic() + PATIENCE
    try:
        while time.monotonic() < end:
            dialled.sendall(sent)
            time.sleep(pause)
    except (ConnectionError, TimeoutError):
        return time.monotonic() < end
    return False


@pytest.mark.parametrize(
    "first", [frame(TEXT, b'{"kind":"stick","roll":0}'), frame(BINARY), frame(PING), frame(PONG)]
)
def test_a_flood_is_cut_off(address: str, first: bytes) -> None:
    with dial(address) as flooding:
        assert is_cut_off(flooding, first * 1000)


def test_a_message_without_end_is_cut_off(address: str) -> None:
    with dial(address) as flooding:
        flooding.sendall(frame(TEXT & 0x0F, b"{"))
        assert is_cut_off(flooding, frame(MORE, b" ") * 1000)


def test_the_others_go_on_meanwhile(address: str) -> None:
    with dial(address) as watching, dial(address) as flooding:
        is_cut_off(flooding, frame(PING) * 1000)
        began, read = time.monotonic(), 0
        while time.monotonic() < began + 1.0:
            read += watching.recv(65536).count(b'"kind":"tick"')
        assert read >= 10


@pytest.mark.slow
def test_one_that_pings_twice_a_second_stays(address: str) -> None:
    with dial(address) as polite:
        assert not is_cut_off(polite, frame(PING), pause=0.5)


def test_one_that_was_cut_off_is_not_heard_for_a_while() -> None:
    with serve(ideal_app()) as address:
        with dial(address) as flooding:
            assert is_cut_off(flooding, frame(PING) * 1000)
        with pytest.raises((httpx.ConnectError, httpx.ReadError, httpx.RemoteProtocolError)):
            httpx.get(f"http://{address}/api/v1/flights")
        time.sleep(2.0)
        assert httpx.get(f"http://{address}/api/v1/flights").is_success


def test_what_is_sent_after_it_was_closed_here_is_sent_to_nobody() -> None:
    """As when a client answers no pings: the app had not heard of it yet."""
    closed = Socket.__new__(Socket)
    closed.close_sent = True
    with pytest.raises(ClientDisconnected):
        asyncio.run(closed.send({"type": "websocket.send", "text": "x"}))
