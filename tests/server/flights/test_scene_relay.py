"""The 3D scene on the service's port: viser's page, its WebSocket, and what is not passed on."""

import asyncio
import gzip
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress

import httpx2 as httpx
import msgspec
import pytest
import viser
import zstandard
from relguide_server.flights.scene_relay import WRITTEN_ON, may_pass
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from relguide.flying.documents import Document
from relguide.flying.orders import Command
from tests.server.flown import ideal_flight
from tests.server.serving import ideal_app, serve

CAMERA: dict[str, object] = {
    "wxyz": [1.0, 0.0, 0.0, 0.0],
    "position": [0.0, 0.0, 9.0],
    "fov": 0.9,
    "near": 0.1,
    "far": 100.0,
    "image_height": 400,
    "image_width": 600,
    "look_at": [0.0, 0.0, 0.0],
    "up_direction": [0.0, 0.0, 1.0],
}
VISER = Subprotocol(f"viser-v{viser.__version__}")


def long_flight(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
    return ideal_flight(commands, duration=3600.0)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serve(ideal_app(long_flight)) as address:
        yield address


@pytest.fixture(scope="module")
def flight_id(address: str) -> str:
    body = {"scenario": "ideal", "rate": 10.0}
    found: str = httpx.post(f"http://{address}/api/v1/flights", json=body).json()["id"]
    return found


def message(kind: str, **fields: object) -> bytes:
    return msgspec.msgpack.encode({"type": kind, **fields})


def scene_of(address: str, path: str, protocol: Subprotocol = VISER) -> connect:
    return connect(f"ws://{address}{path}", subprotocols=[protocol], max_size=None, proxy=None)


def text_of(frame: bytes) -> str:
    """The messages in a frame of viser, as text enough to look for names in."""
    size, packed = (int.from_bytes(frame[k : k + 8], "little") for k in (0, 8))
    return repr(zstandard.ZstdDecompressor().decompress(frame[16 : 16 + packed], size))


def test_the_page_is_visers_own_packed_once(address: str, flight_id: str) -> None:
    url = f"http://{address}/scene/{flight_id}/"
    page = httpx.get(url)
    assert page.status_code == 200
    assert page.content.count(WRITTEN_ON) == 1
    assert page.content.index(WRITTEN_ON) < page.content.index(b"<script data-p")
    assert page.headers["content-encoding"] == "gzip"
    assert page.headers["content-type"].startswith("text/html")
    assert "viser" in page.text.lower()
    again = httpx.get(url, headers={"If-None-Match": page.headers["etag"]})
    assert again.status_code == 304
    plain = httpx.get(url, headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert gzip.compress(plain.content)
    assert httpx.get(url[:-1]).headers["location"] == f"/scene/{flight_id}/"


@pytest.mark.parametrize("slash", ["", "/"])
def test_the_scene_is_relayed_at_both_paths(address: str, flight_id: str, slash: str) -> None:
    async def look() -> str:
        async with scene_of(address, f"/scene/{flight_id}{slash}") as socket:
            assert socket.subprotocol == VISER
            text = ""
            while "/world/leader/min_separation" not in text or "/world/plan" not in text:
                text += text_of(await asyncio.wait_for(socket.recv(), 10.0))
            return text

    text = asyncio.run(look())
    for node in ("/world/grid", "/world/pursuer/body/mesh", "/world/slot/gate", "/world/route"):
        assert node in text


def test_the_picture_moves(address: str, flight_id: str) -> None:
    async def look() -> int:
        async with scene_of(address, f"/scene/{flight_id}") as socket:
            moves = 0
            while moves < 10:
                moves += "SetPositionMessage" in text_of(
                    await asyncio.wait_for(socket.recv(), 10.0)
                )
            return moves

    assert asyncio.run(look()) == 10


def test_an_unknown_flight_is_forbidden(address: str) -> None:
    async def dial() -> int:
        with pytest.raises(InvalidStatus) as refused:
            async with scene_of(address, "/scene/nothing"):
                pass
        return refused.value.response.status_code

    assert asyncio.run(dial()) == 403


def test_another_version_of_viser_is_refused(address: str, flight_id: str) -> None:
    async def dial() -> int | None:
        async with scene_of(address, f"/scene/{flight_id}", Subprotocol("viser-v0.0.1")) as socket:
            async with asyncio.timeout(10.0):
                await socket.wait_closed()
            return socket.close_code

    assert asyncio.run(dial()) == 1002


@pytest.mark.parametrize(
    "unwanted",
    [
        message("ShareUrlRequest"),
        message("ShareUrlDisconnect"),
        message("FileTransferStartUpload", source_component_uuid="x"),
        b"\xc1 not msgpack",
        b"",
        "text",
    ],
)
def test_no_tunnel_to_the_outside(address: str, flight_id: str, unwanted: bytes | str) -> None:
    async def ask() -> int | None:
        async with scene_of(address, f"/scene/{flight_id}") as socket:
            await socket.recv()
            await socket.send(unwanted)
            async with asyncio.timeout(10.0):
                try:
                    while True:
                        assert "ShareUrlUpdated" not in text_of(await socket.recv())
                except ConnectionClosed:
                    return socket.close_code

    assert asyncio.run(ask()) == 1008


def test_a_type_given_twice_is_judged_as_viser_reads_it() -> None:
    pack = msgspec.msgpack.encode
    kind, share, camera = pack("type"), pack("ShareUrlRequest"), pack("ViewerCameraMessage")
    assert not may_pass(b"\x82" + kind + camera + kind + share)
    assert may_pass(message("ViewerCameraMessage", **CAMERA))
    assert may_pass(message("GuiUpdateMessage", uuid="a", updates={"value": True}))


@pytest.mark.parametrize("updates", [{"sync_cb": "boom"}, {"__class__": 1}, {"value": 1.5}, {}, 3])
def test_of_a_button_nothing_passes_but_that_it_is_pressed(updates: object) -> None:
    assert not may_pass(message("GuiUpdateMessage", uuid="a", updates=updates))


@pytest.mark.parametrize(
    "wrong", [{"fov": "wide"}, {"position": [0.0, 1.0]}, {"near": float("nan")}, {"more": 1.0}]
)
def test_a_camera_is_passed_on_whole_or_not_at_all(wrong: dict[str, object]) -> None:
    assert not may_pass(message("ViewerCameraMessage", **CAMERA | wrong))


@pytest.mark.parametrize("name", list(CAMERA))
def test_a_camera_that_lacks_something_is_not_passed_on(name: str) -> None:
    rest = {key: value for key, value in CAMERA.items() if key != name}
    assert not may_pass(message("ViewerCameraMessage", **rest))


def test_a_viewer_that_floods_is_closed(address: str, flight_id: str) -> None:
    async def flood() -> int | None:
        async with scene_of(address, f"/scene/{flight_id}") as socket:
            await socket.recv()
            with suppress(ConnectionClosed):
                for _ in range(1000):
                    await socket.send(message("ViewerCameraMessage", **CAMERA))
                async with asyncio.timeout(10.0):
                    while True:
                        await socket.recv()
            return socket.close_code

    assert asyncio.run(flood()) == 1008


def test_the_scene_is_taken_down_with_its_last_viewer(address: str, flight_id: str) -> None:
    async def look() -> None:
        async with scene_of(address, f"/scene/{flight_id}") as socket:
            await socket.recv()
            assert f"scene {flight_id}" in _threads()

    asyncio.run(look())
    for _ in range(100):
        if f"scene {flight_id}" not in _threads():
            return
        threading.Event().wait(0.05)
    raise AssertionError("The scene's thread is still there.")


def _threads() -> set[str]:
    return {thread.name for thread in threading.enumerate()}
