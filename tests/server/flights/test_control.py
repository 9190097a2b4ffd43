"""A flight flown by hand over its stream: real sockets, a real flight, one client at a time."""

import asyncio
import json
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx2 as httpx
import pytest
from relguide_server.app import create_app
from relguide_server.flights.control import (
    GIVEN_BACK,
    HELD,
    LOST,
    MODELLED,
    MOST_RATE,
    NOT_HELD,
    OVER,
    RECORDING,
    REMOVED,
    TAKEN,
    Standing,
)
from relguide_server.flights.frames import LONGEST, MOST, NOT_UNDERSTOOD, TOO_FAST
from relguide_server.flights.stream import FLIGHT_GONE
from relguide_server.http.access import NOT_YOURS
from relguide_server.records.service import records_service
from relguide_server.settings import ServiceSettings
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from relguide.contract.document_models import from_wire
from relguide.contract.messages import Tick
from relguide.contract.protocol import STREAM
from relguide.contract.refusal import parse
from relguide.contract.upstream import ControlAnswer
from relguide.flying.documents import CommandGiven, Document, FlightStarted, Sample
from relguide.flying.flight import fly
from relguide.flying.orders import Command, SetAutopilot
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from tests.server.http.test_access import SETTING, TOKENS
from tests.server.serving import ideal_app, ideal_catalogue, serve

TAKE = {"kind": "take_control", "director": True}


def fig_6b(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
    return fly(scenario("fig_6b"), plan, commands=commands)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serve(ideal_app(fig_6b)) as address:
        yield address


def start(address: str, token: str = "", **body: object) -> str:
    answer = httpx.post(
        f"http://{address}/api/v1/flights",
        json={"scenario": "ideal", **body},
        headers={"Authorization": f"Bearer {token}"} if token else {},
        timeout=60.0,
    )
    assert answer.status_code == 201, answer.text
    flight_id: str = answer.json()["id"]
    return flight_id


class Socket:
    """A stream, what came over it, and the answers to this client alone."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self.documents: list[dict[str, Any]] = []
        self.answers: list[tuple[bool, str]] = []

    async def send(self, **frame: object) -> None:
        await self._socket.send(json.dumps(frame))

    async def send_raw(self, frame: str | bytes) -> None:
        await self._socket.send(frame)

    async def hear(self) -> None:
        """The next frame."""
        frame = json.loads(await asyncio.wait_for(self._socket.recv(), 5.0))
        if frame["kind"] == "control":
            answer = parse(ControlAnswer, frame)
            self.answers.append((answer.yours, answer.message))
        else:
            parse(Tick, frame)
            self.documents += frame["documents"]

    async def until(self, condition: Callable[[], object], patience: float = 10.0) -> None:
        async with asyncio.timeout(patience):
            while not condition():
                await self.hear()

    async def ask(self, **frame: object) -> tuple[bool, str]:
        """Send a frame, and wait for the answer to it."""
        count = len(self.answers)
        await self.send(**frame)
        await self.until(lambda: len(self.answers) > count)
        return self.answers[-1]

    async def closed(self) -> tuple[int | None, str | None]:
        with pytest.raises(ConnectionClosed):
            await self.until(lambda: False)
        return self._socket.close_code, self._socket.close_reason

    async def leave(self) -> None:
        await self._socket.close()

    def of(self, kind: str) -> list[dict[str, Any]]:
        return [document for document in self.documents if document["kind"] == kind]

    def orders(self, kind: str) -> list[dict[str, Any]]:
        return [d["command"] for d in self.of("command_given") if d["command"]["kind"] == kind]

    @property
    def autopilot(self) -> bool:
        """Whether it flies, as the newest sample says."""
        flies: bool = self.of("sample")[-1]["guidance"][0].get("autopilot", True)
        return flies


class Dial:
    """`async with Dial(address, flight_id) as socket`."""

    def __init__(self, address: str, flight_id: str, token: str = "", cookie: str = "") -> None:
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        if cookie:
            headers["Cookie"] = f"relguide_token={cookie}"
        self._connecting = connect(
            f"ws://{address}/api/v1/flights/{flight_id}/stream",
            subprotocols=[Subprotocol(STREAM)],
            additional_headers=headers,
            proxy=None,
            max_size=None,
        )

    async def __aenter__(self) -> Socket:
        socket = Socket(await self._connecting.__aenter__())
        await socket.hear()
        return socket

    async def __aexit__(self, *error: Any) -> None:
        await self._connecting.__aexit__(*error)


def test_control_is_taken_the_stick_moves_and_control_is_given_back(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew, Dial(address, flight_id) as watcher:
            assert await crew.ask(**TAKE) == (True, TAKEN)
            await crew.until(lambda: not crew.autopilot)
            bank = crew.of("sample")[-1]["aircraft"][0]["bank_deg"]
            for _ in range(5):
                await crew.send(kind="stick", roll=1.0)
                await asyncio.sleep(0.1)
            await crew.until(lambda: crew.orders("stick"))
            assert crew.orders("stick")[0]["roll"] == 1.0
            await crew.until(lambda: crew.of("sample")[-1]["aircraft"][0]["bank_deg"] > bank + 2.0)
            assert await crew.ask(kind="give_back") == (False, GIVEN_BACK)
            await crew.until(lambda: crew.autopilot)
            await watcher.until(lambda: watcher.of("control_changed")[-1:] and watcher.autopilot)
            assert watcher.answers == []
            said = [d["message"] for d in crew.of("control_changed")]
            assert said == ["You have control.", "The flight director is on.",
                            "The autopilot flies."]  # fmt: skip

    flight_id = start(address)
    asyncio.run(scene())


def test_one_client_at_a_time_has_control(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as one, Dial(address, flight_id) as other:
            assert (await one.ask(**TAKE))[0]
            assert await other.ask(**TAKE) == (False, HELD)
            await one.until(lambda: not one.autopilot)
            for _ in range(10):
                await other.send(kind="stick", roll=-1.0)
            assert await other.ask(kind="give_back") == (False, NOT_HELD)
            await asyncio.sleep(0.3)
            assert await one.ask(**TAKE) == (True, TAKEN)
            assert one.orders("stick") == []
            await one.ask(kind="give_back")
            assert await other.ask(**TAKE) == (True, TAKEN)

    flight_id = start(address)
    asyncio.run(scene())


def test_a_stick_without_control_is_told_so_once(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as socket:
            assert await socket.ask(kind="stick", roll=0.1) == (False, NOT_HELD)
            for _ in range(5):
                await socket.send(kind="stick", roll=0.2)
            assert await socket.ask(kind="give_back") == (False, NOT_HELD)
            assert len(socket.answers) == 2

    flight_id = start(address)
    asyncio.run(scene())


def test_silence_makes_the_stick_neutral(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: not crew.autopilot)
            await crew.send(kind="stick", roll=0.4, pitch=0.1)
            began = time.monotonic()
            await crew.until(lambda: len(crew.orders("stick")) == 2)
            assert 0.45 < time.monotonic() - began < 2.0
            last = crew.orders("stick")[-1]
            assert (last["roll"], last["pitch"]) == (0.0, 0.0)
            assert not crew.autopilot  # it is still this client's

    flight_id = start(address)
    asyncio.run(scene())


def test_a_socket_that_closes_gives_control_back(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as watcher:
            async with Dial(address, flight_id) as crew:
                await crew.ask(**TAKE)
                await crew.until(lambda: not crew.autopilot)
                await crew.send(kind="stick", roll=0.5)
                await crew.until(lambda: crew.orders("stick"))
            await watcher.until(lambda: len(watcher.of("control_changed")) == 3)
            await watcher.until(lambda: watcher.autopilot)
            assert [d["roll"] for d in watcher.orders("stick")] == [0.5, 0.0]
            assert watcher.of("control_changed")[-1]["message"] == "The autopilot flies."
            assert (await watcher.ask(**TAKE))[0]

    flight_id = start(address)
    asyncio.run(scene())


def test_who_joins_late_is_told_who_flies(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: not crew.autopilot)
            async with Dial(address, flight_id) as late:
                (changed,) = late.of("control_changed")
                assert (changed["autopilot"], changed["director"]) == (False, True)
                assert not late.autopilot

    flight_id = start(address)
    asyncio.run(scene())


def test_a_rate_above_5_and_hands_exclude_each_other(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew:
            yours, said = await crew.ask(**TAKE)
            assert not yours
            assert "at a rate of 5 at most, not 10" in said
            assert (await asyncio.to_thread(set_rate, MOST_RATE)).status_code == 202
            assert (await crew.ask(**TAKE))[0]
            answer = await asyncio.to_thread(set_rate, 6.0)
            assert answer.status_code == 409
            assert "at a rate of 5 at most, not 6" in answer.json()["detail"]
            await crew.ask(kind="give_back")
            assert (await asyncio.to_thread(set_rate, 6.0)).status_code == 202

    def set_rate(rate: float) -> httpx.Response:
        command = {"command": "set_rate", "rate": rate}
        return httpx.post(f"http://{address}/api/v1/flights/{flight_id}/commands", json=command)

    flight_id = start(address, rate=10.0)
    asyncio.run(scene())


def test_a_stick_over_rest_is_refused_while_a_client_has_control(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: not crew.autopilot)
            answer = await asyncio.to_thread(move)
            assert (answer.status_code, answer.json()["detail"]) == (409, HELD)

    def move() -> httpx.Response:
        command = {"command": "stick", "roll": 0.5}
        return httpx.post(f"http://{address}/api/v1/flights/{flight_id}/commands", json=command)

    flight_id = start(address)
    asyncio.run(scene())


def test_an_aircraft_without_a_crew_is_refused(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as socket:
            yours, said = await socket.ask(**TAKE, ident="LEADER")
            assert (yours, "LEADER is no pursuer" in said) == (False, True)

    flight_id = start(address)
    asyncio.run(scene())


def test_control_of_a_paused_flight_is_taken_and_it_ticks_on(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as crew:
            assert (await crew.ask(**TAKE))[0]
            play = {"command": "play"}
            url = f"http://{address}/api/v1/flights/{flight_id}/commands"
            await asyncio.to_thread(httpx.post, url, json=play)
            await crew.until(lambda: not crew.autopilot)
            await asyncio.to_thread(httpx.post, url, json={"command": "pause"})
            for _ in range(5):
                await crew.hear()

    flight_id = start(address, paused=True)
    asyncio.run(scene())


def test_who_is_the_autopilots_by_another_way_hears_that_control_is_lost() -> None:
    def given_back(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
        def also(t: float) -> Iterator[Command]:
            yield from commands(t)
            if t == 6.0:
                yield SetAutopilot(on=True)

        return fig_6b(also)

    async def scene(address: str, flight_id: str) -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: len(crew.answers) == 2)
            assert crew.answers[-1] == (False, LOST)
            assert (await crew.ask(**TAKE))[0]

    with serve(ideal_app(given_back)) as address:
        asyncio.run(scene(address, start(address, rate=5.0)))


def test_the_end_of_a_flight_is_the_end_of_control() -> None:
    def short(commands: Callable[[float], Iterable[Command]]) -> Iterator[Document]:
        return fly(replace(scenario("fig_6b"), duration_limit=8.0), plan, commands=commands)

    async def scene(address: str, flight_id: str) -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: len(crew.answers) == 2)
            assert crew.answers[-1] == (False, OVER)
            yours, said = await crew.ask(**TAKE)
            assert (yours, said.startswith(OVER)) == (False, True)

    with serve(ideal_app(short)) as address:
        asyncio.run(scene(address, start(address, rate=5.0)))


def test_who_flies_a_flight_that_is_removed_hears_that_it_was_ended(address: str) -> None:
    async def scene(flight_id: str) -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await asyncio.to_thread(httpx.delete, f"http://{address}/api/v1/flights/{flight_id}")
            assert await crew.closed() == (FLIGHT_GONE, "This flight is over and has been removed.")
            assert crew.answers[1:] == [(False, REMOVED)]

    asyncio.run(scene(start(address)))


def test_a_recording_is_not_flown_by_hand() -> None:
    started = next(document for document in fig_6b(lambda t: ()))
    assert isinstance(started, FlightStarted)
    standing = Standing(
        started=started, over=False, replay=True, modelled=False, rate=1.0, may_command=True
    )
    assert standing.refusal("PURSUER") == RECORDING
    assert replace(standing, replay=False).refusal("PURSUER") == ""


def test_what_a_modelled_pilot_flies_no_client_flies(address: str) -> None:
    async def scene(flight_id: str) -> None:
        async with Dial(address, flight_id) as crew:
            assert await crew.ask(**TAKE) == (False, MODELLED)

    flight_id = start(address, by_hand={"delay_s": 0.4})
    asyncio.run(scene(flight_id))
    commands = f"http://{address}/api/v1/flights/{flight_id}/commands"
    answer = httpx.post(commands, json={"command": "stick", "roll": 0.5})
    assert (answer.status_code, answer.json()["detail"]) == (409, MODELLED)


@pytest.mark.parametrize("shown", ["token", "cookie"])
def test_only_who_may_command_a_flight_may_fly_it(shown: str) -> None:
    async def scene(address: str, flight_id: str) -> None:
        for who, may in {"view": False, "other": False, "fly": True, "control": True}.items():
            async with Dial(address, flight_id, **{shown: TOKENS[who]}) as socket:
                yours, said = await socket.ask(**TAKE)
                assert (yours, said == NOT_YOURS) == (may, not may), who

    with serve(ideal_app(fig_6b, tokens=SETTING)) as address:
        asyncio.run(scene(address, start(address, TOKENS["fly"])))


@pytest.mark.parametrize(
    ("frame", "said"),
    [
        ("hello", "not JSON"),
        (b"\x00", "must be text"),
        ('{"kind":"stick","roll":7}', "-1 … 1"),
        ('{"kind":"stick","roll":1e308}', "-1 … 1"),
        ('{"kind":"stick","roll":NaN}', "NaN is not a number"),
        ('{"kind":"stick","roll":1e999}', "must be a finite number"),
        ("x" * (LONGEST + 1), f"at most {LONGEST} bytes"),
    ],
)
def test_what_is_no_frame_closes_the_socket_with_a_sentence(
    address: str, frame: str | bytes, said: str
) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as watcher, Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: not crew.autopilot)
            await crew.send_raw(frame)
            code, reason = await crew.closed()
            assert (code, said in (reason or "")) == (NOT_UNDERSTOOD, True), reason
            await watcher.until(lambda: len(watcher.of("control_changed")) == 3)  # given back

    flight_id = start(address)
    asyncio.run(scene())


def test_a_flood_closes_its_socket_and_nobody_elses(address: str) -> None:
    async def scene() -> None:
        async with Dial(address, flight_id) as watcher, Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            for _ in range(3 * MOST):
                await crew.send(kind="stick", roll=0.1)
            code, reason = await crew.closed()
            assert (code, f"{MOST} frames a second" in (reason or "")) == (TOO_FAST, True)
            count = len(watcher.of("sample"))
            await watcher.until(lambda: len(watcher.of("sample")) > count + 5)

    flight_id = start(address)
    asyncio.run(scene())


@pytest.mark.slow
def test_a_record_of_hands_is_flown_again(tmp_path: Path) -> None:
    async def scene(address: str, flight_id: str) -> None:
        async with Dial(address, flight_id) as crew:
            await crew.ask(**TAKE)
            await crew.until(lambda: not crew.autopilot)
            for k in range(40):
                await crew.send(kind="stick", roll=round(0.9 - 0.03 * k, 2), pitch=0.1 * (k % 3))
                await asyncio.sleep(0.05)
            await crew.ask(kind="give_back")
            await crew.until(lambda: crew.autopilot)
            end = crew.of("sample")[-1]["t_s"] + 5.0
            await crew.until(lambda: crew.of("sample")[-1]["t_s"] > end)

    records = records_service(
        records="on", database_url="", data=str(tmp_path), record_plans=0, keep_days=1.0,
        keep_mb=100.0,
    )  # fmt: skip
    app = create_app(ServiceSettings(workers=0), catalogue=ideal_catalogue(fig_6b), records=records)
    with serve(app) as address:
        flight_id = start(address, rate=3.0)
        asyncio.run(scene(address, flight_id))
        httpx.delete(f"http://{address}/api/v1/flights/{flight_id}")
        base = f"http://{address}/api/v1/records/flights/{flight_id}"
        end = time.monotonic() + 10.0
        while httpx.get(base).json()["outcome"] == "flying" and time.monotonic() < end:
            time.sleep(0.05)
        assert httpx.get(base).json()["lost"] == 0
        kept = _kept(base)
    given = [(d.t, d.command) for d in kept if isinstance(d, CommandGiven)]
    assert len(given) > 30

    def commands(t: float) -> Iterator[Command]:
        while given and given[0][0] <= t + 1e-9:
            yield given.pop(0)[1]

    seen = {round(d.t, 2): d for d in kept if isinstance(d, Sample)}
    compared = 0
    for document in fly(scenario("fig_6b"), plan, commands=commands):
        if document.t > max(seen):
            break
        if isinstance(document, Sample) and round(document.t, 2) in seen:
            for now, before in zip(
                document.aircraft, seen[round(document.t, 2)].aircraft, strict=True
            ):
                assert (now.x, now.y, now.bank) == pytest.approx(
                    (before.x, before.y, before.bank), abs=1e-6
                )
            compared += 1
    assert compared == len(seen) > 10


def _kept(base: str) -> list[Document]:
    documents, first = [], 0
    while True:
        page = httpx.get(f"{base}/documents", params={"first": first}).json()
        if not page["documents"]:
            return documents
        documents += [from_wire(one["document"]) for one in page["documents"]]
        first = page["next"]
