"""A request that is sent again with its key is done once, whatever happens on the way."""

import asyncio
from collections.abc import Awaitable, Callable
from itertools import count
from typing import Any

import pytest
from fastapi import APIRouter, FastAPI, Request
from relguide_server.http.bodies import Bodies, json_answer, parse_json, read_body, unless_left
from relguide_server.http.errors import Refusal, install_handlers
from relguide_server.http.idempotency import HEADER, Idempotency, IdempotentRoute
from relguide_server.http.kept_answers import AN_ANSWER, KEPT_FOR, Answer, Asked, KeptAnswers
from starlette.responses import Response
from starlette.types import Message

from tests.server.serving import TestClient, ideal_app

KEY = {HEADER: "7e3c-1"}


class Desk:
    """A service with one route, whose answers the test chooses; counts what it does."""

    def __init__(self, work: Callable[[Request, int], Awaitable[Response]]) -> None:
        self.done = 0
        router = APIRouter(route_class=IdempotentRoute)

        async def order(request: Request) -> Response:
            self.done += 1
            return await work(request, self.done)

        router.post("/orders")(order)
        router.post("/others")(order)
        self.app = FastAPI()
        self.app.state.bodies, self.app.state.idempotency = Bodies(), Idempotency()
        self.app.include_router(router)
        install_handlers(self.app)

    async def send(
        self, body: bytes = b"{}", *, key: str = "k", path: str = "/orders",
        client: str = "10.0.0.1", left: asyncio.Event | None = None,
    ) -> tuple[int, dict[str, str], bytes]:  # fmt: skip
        """Ask it as a client does, which leaves at some time."""
        sent: list[Message] = []
        bodies = iter([{"type": "http.request", "body": body, "more_body": False}])

        async def receive() -> Message:
            for message in bodies:
                return message
            await (left or asyncio.Event()).wait()
            return {"type": "http.disconnect"}

        async def send(message: Message) -> None:
            sent.append(message)

        named = [(HEADER.lower().encode(), key.encode("latin-1"))] if key else []
        headers = [(b"content-type", b"application/json"), *named]
        scope = {
            "type": "http", "method": "POST", "path": path, "raw_path": path.encode(),
            "query_string": b"", "root_path": "", "scheme": "http", "headers": headers,
            "client": (client, 1), "server": ("test", 80), "http_version": "1.1",
        }  # fmt: skip
        await self.app(scope, receive, send)
        fields = {name.decode(): value.decode() for name, value in sent[0]["headers"]}
        return sent[0]["status"], fields, b"".join(m.get("body", b"") for m in sent[1:])


async def number(request: Request, done: int) -> Response:
    content: Any = parse_json(await read_body(request, "application/json"))
    return json_answer({"number": done, "asked": content}, 201, headers={"Location": f"/{done}"})


def play(scene: Awaitable[None]) -> None:
    async def run() -> None:
        await scene
        await asyncio.sleep(0.0)  # tasks that are cancelled end
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(run())


def test_a_request_sent_again_gets_the_first_answer() -> None:
    async def scene() -> None:
        desk = Desk(number)
        first = await desk.send(b'{"a": 1}')
        again = await desk.send(b'{"a": 1}')
        assert desk.done == 1
        assert (first[0], first[2]) == (again[0], again[2])
        assert first[1] | {"idempotent-replayed": "true"} == again[1]
        assert "idempotent-replayed" not in first[1]
        for others in ({"key": "other"}, {"key": ""}, {"client": "10.0.0.2"}):
            _, fields, _ = await desk.send(b'{"a": 1}', **others)
            assert "idempotent-replayed" not in fields
        assert desk.done == 4

    play(scene())


def test_a_key_that_came_with_another_request_is_refused() -> None:
    async def scene() -> None:
        desk = Desk(number)
        await desk.send(b'{"a": 1}')
        for other in ({"body": b'{"a": 2}'}, {"body": b'{"a": 1}', "path": "/others"}):
            status, _, body = await desk.send(**other)
            assert status == 422
            assert b"POST /orders" in body
            assert b"a key of its own" in body
        assert desk.done == 1

    play(scene())


def test_one_that_comes_while_the_first_is_worked_on_waits_for_it() -> None:
    async def slow(request: Request, done: int) -> Response:
        await asyncio.sleep(0.02)
        return await number(request, done)

    async def scene() -> None:
        desk = Desk(slow)
        answers = await asyncio.gather(*(desk.send() for _ in range(20)))
        assert desk.done == 1
        assert len({body for _, _, body in answers}) == 1
        assert sum("idempotent-replayed" in fields for _, fields, _ in answers) == 19

    play(scene())


def test_what_is_done_for_a_client_that_left_is_its_answer_when_it_comes_back() -> None:
    async def slow(request: Request, done: int) -> Response:
        await asyncio.sleep(0.02)
        return await number(request, done)

    async def scene() -> None:
        desk, left = Desk(slow), asyncio.Event()
        asyncio.get_running_loop().call_later(0.005, left.set)
        status, _, _ = await desk.send(left=left)
        assert status == 400  # which nobody reads
        status, fields, body = await desk.send()
        assert (status, body) == (201, b'{"number":1,"asked":{}}')
        assert fields["idempotent-replayed"] == "true"

    play(scene())


def test_work_that_ends_with_its_client_is_begun_anew_for_who_comes_back() -> None:
    async def cancelled(request: Request, done: int) -> Response:
        await read_body(request, "application/json")
        await unless_left(request, asyncio.sleep(0.02))
        return json_answer(done)

    async def scene() -> None:
        desk, left = Desk(cancelled), asyncio.Event()
        leaving = asyncio.create_task(desk.send(left=left))
        await asyncio.sleep(0.005)
        left.set()
        await leaving
        status, fields, body = await desk.send()
        assert (status, body, desk.done) == (200, b"2", 2)
        assert "idempotent-replayed" not in fields

    play(scene())


@pytest.mark.parametrize(
    ("status", "kept"), [(404, True), (409, True), (429, False), (503, False), (500, False)]
)
def test_what_may_succeed_next_time_is_tried_again(status: int, kept: bool) -> None:
    async def refuse(request: Request, done: int) -> Response:
        if status == 500:
            raise ZeroDivisionError
        raise Refusal(status, f"No. {done}.")

    async def scene() -> None:
        desk = Desk(refuse)
        for _ in range(2):
            if status == 500:
                with pytest.raises(ZeroDivisionError):
                    await desk.send()
            else:
                assert (await desk.send())[0] == status
        assert desk.done == (1 if kept else 2)

    play(scene())


@pytest.mark.parametrize("key", ["", " ", "x" * 256, "a\tb", "é", "a\x7f"])
def test_what_is_no_key_is_refused(key: str) -> None:
    with TestClient(ideal_app()) as client:
        sent = [(HEADER, key.encode("latin-1")), ("Content-Type", "application/json")]
        answer = client.post("/api/v1/flights", content=b'{"scenario":"ideal"}', headers=sent)
        assert answer.status_code == 422
        assert "1 to 255 printable characters" in answer.json()["detail"]
        twice = client.post("/api/v1/flights", json={}, headers=[(HEADER, "a"), (HEADER, "a")])
        assert "sent once" in twice.json()["detail"]


def test_a_flight_and_its_commands_are_begun_once() -> None:
    with TestClient(ideal_app()) as client:
        wanted = {"scenario": "ideal", "paused": True}
        first = client.post("/api/v1/flights", json=wanted, headers=KEY)
        again = client.post("/api/v1/flights", json=wanted, headers=KEY)
        assert first.json() == again.json()
        assert again.headers["idempotent-replayed"] == "true"
        assert again.headers["location"] == first.headers["location"]
        assert len(client.get("/api/v1/flights").json()["flights"]) == 1
        commands = f"{first.headers['location']}/commands"
        rated = {HEADER: "rate"}
        faster = client.post(commands, json={"command": "set_rate", "rate": 3.0}, headers=rated)
        client.post(commands, json={"command": "set_rate", "rate": 5.0})
        late = client.post(commands, json={"command": "set_rate", "rate": 3.0}, headers=rated)
        assert late.json() == faster.json()
        assert client.get(first.headers["location"]).json()["rate"] == 5.0
        unread = client.post("/api/v1/simulations", json=[], headers=KEY)
        assert unread.status_code == 422
        assert unread.json()["type"].endswith("#key-reused")


def test_answers_are_kept_for_a_day_and_bounded_for_each_client_and_for_all() -> None:
    clock = iter(count())
    now = [0.0]
    kept = KeptAnswers(lambda: now[0], answers=3, of_one=10 * AN_ANSWER, of_all=12 * AN_ANSWER)
    asked = Asked("POST /", b"")

    def put(client: str, size: int = 0) -> str:
        key = str(next(clock))
        kept.put(client, key, asked, Answer(200, [], bytes(size)))
        return key

    def known(client: str, keys: list[str]) -> list[str]:
        return [key for key in keys if kept.get(client, key)]

    mine = [put("me") for _ in range(5)]
    assert known("me", mine) == mine[2:]
    large = put("me", 8 * AN_ANSWER)
    assert known("me", [*mine, large]) == [mine[-1], large]
    assert known("me", [put("me", 10 * AN_ANSWER)]) == []
    others = [put(f"other {k}") for k in range(30)]
    assert kept.size <= 12 * AN_ANSWER
    assert [k for k in range(30) if kept.get(f"other {k}", others[k])] == list(range(18, 30))
    now[0] = KEPT_FOR + 1.0
    assert kept.get("other 29", others[29]) is None
    assert kept.size == 0
