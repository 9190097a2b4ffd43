"""The controllers' stream: numbered, resumed where it broke, or a snapshot."""

import asyncio
import json
from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any

import httpx2 as httpx
import pytest
from relguide_server.atc.journal import A_SECOND, Journal, frame, written
from relguide_server.atc.routes import ONLY_LISTEN
from relguide_server.flights.frames import NOT_UNDERSTOOD
from relguide_server.flights.stream import TOO_MANY, WRONG_PROTOCOL
from relguide_server.http.metrics import Metrics
from websockets.exceptions import ConnectionClosedError, InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from relguide.atc.documents import Expired, SkyCard, TrafficSeen
from relguide.contract.clearance_bodies import AtcFrame
from relguide.contract.protocol import ATC_STREAM
from tests.server.atc.asking import CLEARANCES, report, request
from tests.server.http.test_access import SETTING, TOKENS
from tests.server.serving import ideal_app, serve

TRAFFIC = TrafficSeen(t=1.0, sky=SkyCard(id="", title="All", airspaces=()), aircraft=())


def expired(name: str) -> Expired:
    return Expired(t=1.0, id=name, message="Late.")


class Told:
    """A journal, and what a client of it is told."""

    def __init__(self) -> None:
        self.journal = Journal(self.snapshot, Metrics(), clock=lambda: 7.0)

    def snapshot(self) -> list[bytes]:
        return [written(expired("all that stands"), None)]

    def add(self, *names: str) -> None:
        for name in names:
            document = expired(name)
            self.journal.add(document, written(document, None))
        self.journal.flush()

    async def hear(self, first: int | None, frames: int = 1) -> list[dict[str, Any]]:
        client = self.journal.join(first)
        found = []
        for _ in range(frames):
            text = await client._next()
            assert isinstance(text, str)
            found.append(json.loads(text))
        self.journal.leave(client)
        return found


def ids(frames: list[dict[str, Any]]) -> list[list[str]]:
    return [[document["id"] for document in one["documents"]] for one in frames]


def test_a_client_that_comes_back_gets_what_it_missed() -> None:
    told = Told()
    told.add("a", "b")
    told.add("c")
    (all_of_it,) = asyncio.run(told.hear(None))
    assert (all_of_it["snapshot"], all_of_it["number"]) == (True, 7 * A_SECOND + 3)
    (missed,) = asyncio.run(told.hear(7 * A_SECOND + 2))
    assert (missed["snapshot"], missed["number"]) == (False, 7 * A_SECOND + 3)
    assert ids([missed]) == [["b", "c"]]
    (nothing,) = asyncio.run(told.hear(all_of_it["number"] + 1))
    assert (nothing["snapshot"], nothing["documents"]) == (False, [])


@pytest.mark.parametrize("first", [0, 7 * A_SECOND, 7 * A_SECOND + 9])
def test_what_is_not_known_any_more_or_not_yet_is_a_snapshot(first: int) -> None:
    """Numbers of the run before are lower, and those of another service's may be higher."""
    told = Told()
    told.add("a")
    (found,) = asyncio.run(told.hear(first))
    assert found["snapshot"]
    assert ids([found]) == [["all that stands"]]


def test_so_much_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.atc.journal.KEPT", 100)
    told = Told()
    told.add(*(f"{k}" for k in range(9)))
    (found,) = asyncio.run(told.hear(7 * A_SECOND + 1))
    assert found["snapshot"]
    (last,) = asyncio.run(told.hear(7 * A_SECOND + 9))
    assert ids([last]) == [["8"]]


def test_traffic_is_sent_and_not_kept() -> None:
    async def run() -> None:
        told = Told()
        client = told.journal.join(None)
        await client._next()
        told.journal.add(TRAFFIC, written(TRAFFIC, None))
        told.journal.flush()
        text = await client._next()
        assert isinstance(text, str)
        assert json.loads(text)["documents"][0]["kind"] == "traffic"
        told.add("a")
        (missed,) = await told.hear(7 * A_SECOND + 1)
        assert ids([missed]) == [["a"]]
        assert missed["number"] == 7 * A_SECOND + 2

    asyncio.run(run())


def test_a_slow_client_gets_a_snapshot_and_is_never_wrong() -> None:
    async def run() -> None:
        told = Told()
        client = told.journal.join(None)
        await client._next()
        told.add("a")
        told.add("b")
        frames = [json.loads(str(await client._next())) for _ in range(2)]
        assert ids(frames) == [["a"], ["b"]]
        for k in range(9):
            told.add(f"{k}")
        late = json.loads(str(await client._next()))
        assert (late["snapshot"], late["number"]) == (True, 7 * A_SECOND + 11)

    asyncio.run(run())


def test_a_frame_is_of_the_contract() -> None:
    text = frame(9, [written(expired("a"), None), written(TRAFFIC, None)], snapshot=True)
    read = AtcFrame.model_validate_json(text)
    assert (read.number, read.snapshot, len(read.documents)) == (9, True, 2)


# -- on a real port -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serve(ideal_app(proxies="")) as address:
        yield address


@contextmanager
def listening(
    address: str, query: str = "", protocol: str = ATC_STREAM, token: str = ""
) -> Iterator[ClientConnection]:
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    url = f"ws://{address}/api/v1/atc/stream{query}"
    with connect(
        url, subprotocols=[Subprotocol(protocol)], additional_headers=headers, proxy=None
    ) as socket:
        yield socket


def read(socket: ClientConnection) -> AtcFrame:
    return AtcFrame.model_validate_json(socket.recv(5.0))


def ask(address: str, ident: str, behind: float) -> dict[str, Any]:
    with httpx.Client(base_url=f"http://{address}") as client:
        report(client)  # type: ignore[arg-type]
        answer = client.post(CLEARANCES, json=request(ident, behind=behind))
        assert answer.status_code == 201, answer.text
        found: dict[str, Any] = answer.json()
        return found


def clearances(socket: ClientConnection, until: str) -> tuple[list[tuple[str, str]], int]:
    """Ids and states that are heard until one of that state, and the number of the last frame."""
    heard: list[tuple[str, str]] = []
    while True:
        found = read(socket)
        for document in found.documents:
            if document.kind == "clearance_changed":
                heard.append((document.clearance.id, document.clearance.state))
        if any(state == until for _, state in heard):
            return heard, found.number


def test_a_stream_that_broke_is_resumed(address: str) -> None:
    with listening(address, "?answers=false") as socket:
        assert read(socket).snapshot
        first = ask(address, "RG 06", 12e3)
        heard, number = clearances(socket, "accepted")
        assert (first["id"], "accepted") in heard
    second = ask(address, "RG 07", 40e3)
    with listening(address, f"?answers=false&from={number + 1}") as socket:
        found = read(socket)
        assert not found.snapshot
        known = {d.clearance.id for d in found.documents if d.kind == "clearance_changed"}
        assert known == {second["id"]}
    with listening(address, "?answers=false") as socket:
        found = read(socket)
        known = {d.clearance.id for d in found.documents if d.kind == "clearance_changed"}
        assert found.snapshot
        assert known >= {first["id"], second["id"]}


def test_traffic_comes_once_a_second(address: str) -> None:
    with httpx.Client(base_url=f"http://{address}") as client:
        report(client)  # type: ignore[arg-type]
    with listening(address) as socket:
        seen: list[Any] = []
        while len(seen) < 3:
            seen += [one for one in read(socket).documents if one.kind == "traffic"]
        (leader,) = [one for one in seen[-1].aircraft if one.ident == "LDR 1"]
        assert abs(leader.lat_deg - 50.0) < 1e-6
        assert (leader.source, leader.intends) == ("traffic", False)
        assert 0.5 < seen[-1].t_s - seen[-2].t_s < 1.5


def test_a_controller_who_listens_answers_for_itself(address: str) -> None:
    with listening(address) as socket:
        read(socket)
        asked = ask(address, "RG 08", 60e3)
        assert not asked["auto_answer"]
        path = f"http://{address}{CLEARANCES}/{asked['id']}/answers"
        assert httpx.post(path, json={"answer": "standby"}).status_code == 200
        heard, _ = clearances(socket, "standby")
        assert (asked["id"], "standby") in heard
    assert ask(address, "RG 09", 80e3)["auto_answer"]


def test_clients_only_listen(address: str) -> None:
    with listening(address) as socket:
        socket.send('{"kind":"give_back"}')
        with pytest.raises(ConnectionClosedError) as closed:
            deque(iter(partial(socket.recv, 5.0), None))
    assert closed.value.rcvd is not None
    assert (closed.value.rcvd.code, closed.value.rcvd.reason) == (NOT_UNDERSTOOD, ONLY_LISTEN)


def test_one_client_has_a_share_of_the_stream(address: str) -> None:
    with ExitStack() as stack:
        sockets = [stack.enter_context(listening(address, "?answers=false")) for _ in range(16)]
        assert all(read(socket).snapshot for socket in sockets)
        one_more = stack.enter_context(listening(address, "?answers=false"))
        with pytest.raises(ConnectionClosedError) as closed:
            one_more.recv(5.0)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == TOO_MANY
    assert "the controllers' stream 16 times" in closed.value.rcvd.reason


def test_another_protocol_is_told_what_is_spoken(address: str) -> None:
    with listening(address, protocol="relguide-atc-0") as socket:
        with pytest.raises(ConnectionClosedError) as closed:
            socket.recv(5.0)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == WRONG_PROTOCOL
    assert ATC_STREAM in closed.value.rcvd.reason


def test_a_stream_needs_a_token() -> None:
    with serve(ideal_app(tokens=SETTING)) as address:
        with pytest.raises(InvalidStatus), listening(address):
            pass
        with listening(address, token=TOKENS["view"]) as socket:
            assert read(socket).snapshot
