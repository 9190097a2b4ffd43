"""Streams over real WebSockets: order, latest wins, late joiners, and refusals that say why."""

import asyncio
import json
import time
from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise

import httpx2 as httpx
import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from relguide.contract.messages import Tick
from relguide.contract.protocol import PROTOCOL, STREAM
from relguide.contract.refusal import parse
from relguide.flying.documents import Document
from relguide.flying.orders import Command
from tests.server.flown import ideal_flight
from tests.server.serving import ideal_app, serve


def long_flight(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
    return ideal_flight(commands, duration=3600.0)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serve(ideal_app(long_flight)) as address:
        yield address


def start(address: str, **body: object) -> str:
    answer = httpx.post(f"http://{address}/api/v1/flights", json={"scenario": "ideal", **body})
    assert answer.status_code == 201, answer.text
    flight_id: str = answer.json()["id"]
    return flight_id


def send_command(address: str, flight_id: str, **command: object) -> None:
    url = f"http://{address}/api/v1/flights/{flight_id}/commands"
    assert httpx.post(url, json=command).status_code == 202


def stream_of(address: str, flight_id: str, protocol: str = PROTOCOL) -> connect:
    return connect(
        f"ws://{address}/api/v1/flights/{flight_id}/stream",
        subprotocols=[Subprotocol(protocol)],
        proxy=None,
    )


async def ticks(socket: ClientConnection, count: int) -> list[dict]:
    return [json.loads(await asyncio.wait_for(socket.recv(), 5.0)) for _ in range(count)]


def kinds(tick: dict) -> list[str]:
    return [document["kind"] for document in tick["documents"]]


def test_ticks_are_what_the_contract_says_and_come_in_order(address: str) -> None:
    flight_id = start(address, rate=10.0)
    found = asyncio.run(_ticks_of(address, flight_id, 12))
    for tick in found:
        parse(Tick, tick)
        assert tick["flight_id"] == flight_id
        assert kinds(tick).count("sample") <= 1 or tick is found[0]
    times = [tick["t_s"] for tick in found]
    assert times == sorted(times)
    assert times[-1] > times[0]
    samples = [d["t_s"] for tick in found for d in tick["documents"] if d["kind"] == "sample"]
    assert samples == sorted(set(samples))


def test_the_first_tick_draws_the_whole_picture(address: str) -> None:
    flight_id = start(address, rate=60.0)
    time.sleep(0.8)  # nearly a minute of flight
    first, *_ = asyncio.run(_ticks_of(address, flight_id, 1))
    found = kinds(first)
    assert found[:4] == ["flight_started", "leader_route", "plan_changed", "mode_changed"]
    trail = [d["t_s"] for d in first["documents"] if d["kind"] == "sample"]
    assert len(trail) >= 3
    assert all(later - earlier >= 9.0 for earlier, later in pairwise(trail[:-1]))
    assert trail[-1] == first["t_s"]


def test_a_command_changes_the_flight(address: str) -> None:
    async def command_and_wait() -> dict:
        async with stream_of(address, flight_id) as socket:
            await ticks(socket, 1)
            command = {"command": "leader_heading", "heading_deg": 135.0, "direction": "right"}
            await asyncio.to_thread(send_command, address, flight_id, **command)
            while True:
                (tick,) = await ticks(socket, 1)
                for document in tick["documents"]:
                    if document["kind"] == "leader_changed":
                        return document

    flight_id = start(address, rate=1.0)
    document = asyncio.run(asyncio.wait_for(command_and_wait(), 5.0))
    assert "LeaderHeading" in document["message"]
    assert "right" in document["message"]


def test_a_paused_flight_stands_and_still_ticks(address: str) -> None:
    flight_id = start(address, paused=True)
    standing = asyncio.run(_ticks_of(address, flight_id, 5))
    assert {tick["t_s"] for tick in standing} == {0.0}
    assert all(tick["paused"] for tick in standing)
    assert kinds(standing[0])[-1] == "sample"
    send_command(address, flight_id, command="set_rate", rate=60.0)
    send_command(address, flight_id, command="play")
    moving = asyncio.run(_ticks_of(address, flight_id, 10))
    assert moving[-1]["t_s"] > 5.0
    assert moving[-1]["rate"] == 60.0


def test_all_clients_get_the_same_ticks(address: str) -> None:
    async def both() -> tuple[list[dict], list[dict]]:
        async with (
            stream_of(address, flight_id) as one,
            stream_of(address, flight_id) as other,
        ):
            return tuple(await asyncio.gather(ticks(one, 15), ticks(other, 15)))

    flight_id = start(address, rate=5.0)
    one, other = asyncio.run(both())
    same = {tick["t_s"] for tick in one[1:]} & {tick["t_s"] for tick in other[1:]}
    assert len(same) >= 10


@pytest.mark.parametrize("protocol", ["relguide-000000000000", "viser-v1.1.1"])
def test_a_page_of_another_version_is_refused_with_a_reason(address: str, protocol: str) -> None:
    code, reason = asyncio.run(_answer_refusal(address, start(address), protocol))
    assert code == 4400
    assert PROTOCOL in reason


def test_no_protocol_at_all_is_refused_too(address: str) -> None:
    async def dial() -> tuple[int | None, str | None]:
        url = f"ws://{address}/api/v1/flights/{flight_id}/stream"
        async with connect(url, proxy=None) as socket:
            with pytest.raises(ConnectionClosed):
                await socket.recv()
            return socket.close_code, socket.close_reason

    flight_id = start(address)
    code, reason = asyncio.run(dial())
    assert code == 4400
    assert reason is not None
    assert reason.startswith(f"Name the sub-protocol {STREAM}. ")


def test_an_unknown_flight_is_refused_with_a_reason(address: str) -> None:
    code, reason = asyncio.run(_answer_refusal(address, "nothing", PROTOCOL))
    assert code == 4404
    assert reason


def test_streams_close_with_a_sentence_when_the_flight_is_ended(address: str) -> None:
    async def watch() -> tuple[int | None, str | None]:
        async with stream_of(address, flight_id) as socket:
            await ticks(socket, 2)
            url = f"http://{address}/api/v1/flights/{flight_id}"
            await asyncio.to_thread(httpx.delete, url)
            with pytest.raises(ConnectionClosed):
                await ticks(socket, 100)
            return socket.close_code, socket.close_reason

    flight_id = start(address)
    assert asyncio.run(watch()) == (4410, "This flight is over and has been removed.")


def test_an_ended_flight_is_still_sent_whole() -> None:
    def short(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
        return ideal_flight(commands, duration=1.0)

    with serve(ideal_app(short)) as address:
        flight_id = start(address, rate=60.0)
        url = f"http://{address}/api/v1/flights/{flight_id}"
        while not httpx.get(url).json()["ended"]:
            time.sleep(0.02)
        first, second = asyncio.run(_ticks_of(address, flight_id, 2))
        assert kinds(first)[-1] == "flight_ended"
        assert (first["ended"], first["t_s"]) == (True, 1.0)
        assert second["documents"] == []


def test_an_ended_flight_refuses_commands_with_a_sentence() -> None:
    def short(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
        return ideal_flight(commands, duration=1.0)

    with serve(ideal_app(short)) as address:
        url = f"http://{address}/api/v1/flights/{start(address, rate=60.0)}"
        while not httpx.get(url).json()["ended"]:
            time.sleep(0.02)
        command = {"command": "leader_heading", "heading_deg": 200.0}
        answer = httpx.post(f"{url}/commands", json=command)
        assert answer.status_code == 409
        assert "has ended" in answer.json()["detail"]


def test_a_flight_that_breaks_closes_its_streams_with_a_sentence() -> None:
    def breaks(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
        for document in ideal_flight(commands, duration=3600.0):
            if document.t > 10.0:
                raise RuntimeError("secret")
            yield document

    async def watch() -> tuple[int | None, str | None]:
        async with stream_of(address, flight_id) as socket:
            with pytest.raises(ConnectionClosed):
                await ticks(socket, 1000)
            return socket.close_code, socket.close_reason

    with serve(ideal_app(breaks)) as address:
        flight_id = start(address, rate=20.0)
        code, reason = asyncio.run(watch())
        assert code == 4500
        assert reason is not None
        assert "secret" not in reason


def test_who_is_watched_stays_and_who_is_not_is_removed() -> None:
    async def watch() -> None:
        async with stream_of(address, watched) as socket:
            for _ in range(60):
                await ticks(socket, 1)
                if forgotten not in await asyncio.to_thread(_ids, address):
                    return
            raise AssertionError("The forgotten flight was never removed.")

    with serve(ideal_app(long_flight, keep_unseen=0.5)) as address:
        watched, forgotten = start(address), start(address)
        asyncio.run(watch())


def _ids(address: str) -> list[str]:
    flights = httpx.get(f"http://{address}/api/v1/flights").json()["flights"]
    return [flight["id"] for flight in flights]


async def _ticks_of(address: str, flight_id: str, count: int) -> list[dict]:
    async with stream_of(address, flight_id) as socket:
        assert socket.subprotocol == PROTOCOL
        return await ticks(socket, count)


async def _answer_refusal(address: str, flight_id: str, protocol: str) -> tuple[int | None, str]:
    async with stream_of(address, flight_id, protocol) as socket:
        assert socket.subprotocol == protocol  # without one, a browser says 1006 and no reason
        with pytest.raises(ConnectionClosed):
            await socket.recv()
        return socket.close_code, socket.close_reason or ""
