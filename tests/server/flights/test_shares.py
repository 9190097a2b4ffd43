"""No client keeps others from flying and watching, and an owner always sees its own flight."""

import asyncio
from contextlib import AsyncExitStack
from typing import Any

import httpx2 as httpx
from websockets.asyncio.client import ClientConnection, connect
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.server.flown import ideal_flight
from tests.server.serving import TestClient, ideal_app, serve

FLIGHT = {"scenario": "ideal", "paused": True}
TOKENS = ("a" * 16, "b" * 16)


def from_address(app: Any, host: str) -> TestClient:
    return TestClient(app, client=(host, 50000))


def start(client: TestClient) -> str:
    answer = client.post("/api/v1/flights", json=FLIGHT)
    assert answer.status_code == 201, answer.text
    return answer.json()["id"]


def flying(client: TestClient) -> set[str]:
    return {flight["id"] for flight in client.get("/api/v1/flights").json()["flights"]}


def test_a_client_has_half_of_the_flights_and_is_told_so() -> None:
    app = ideal_app(max_flights=4, spare_after=3600.0)
    with from_address(app, "192.0.2.1") as one:
        own = [start(one) for _ in range(2)]
        refused = one.post("/api/v1/flights", json=FLIGHT)
        assert refused.status_code == 429
        assert "You have 2 flights in the air, the most of one client's" in refused.json()["detail"]
        other, third = from_address(app, "192.0.2.2"), from_address(app, "192.0.2.3")
        theirs = [start(other) for _ in range(2)]
        full = third.post("/api/v1/flights", json=FLIGHT)
        assert full.status_code == 429
        assert "4 flights are in the air, the most that this server" in full.json()["detail"]
        assert flying(third) == {*own, *theirs}


def test_tokens_have_shares_of_their_own_wherever_they_are_shown() -> None:
    app = ideal_app(
        max_flights=4, spare_after=3600.0, tokens=",".join(f"fly:{token}" for token in TOKENS)
    )
    with from_address(app, "192.0.2.1") as one:
        for token in TOKENS:
            one.headers["Authorization"] = f"Bearer {token}"
            start(one)
            start(one)
            assert one.post("/api/v1/flights", json=FLIGHT).status_code == 429


def test_an_own_flight_that_nobody_looks_at_makes_room_before_that_of_another() -> None:
    app = ideal_app(max_flights=4, spare_after=1e-6)
    with from_address(app, "192.0.2.1") as one:
        other = from_address(app, "192.0.2.2")
        first = start(other)
        own = [start(one) for _ in range(3)]
        assert flying(one) == {first, *own[1:]}


def test_who_has_one_flight_loses_it_to_nobody_who_has_as_many() -> None:
    app = ideal_app(max_flights=4, spare_after=1e-6)
    with from_address(app, "192.0.2.1") as one:
        only = start(one)
        other, third = from_address(app, "192.0.2.2"), from_address(app, "192.0.2.3")
        theirs = [start(other) for _ in range(2)]
        first = start(third)
        second = start(third)  # it is full: who has two makes room
        assert flying(one) == {only, theirs[1], first, second}


async def dial(stack: AsyncExitStack, url: str, host: str) -> ClientConnection:
    return await stack.enter_async_context(
        connect(url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None, local_addr=(host, 0))
    )


def test_an_owner_sees_its_flight_however_many_watch_it() -> None:
    async def watch(address: str) -> None:
        async with httpx.AsyncClient(
            transport=httpx.AsyncHTTPTransport(local_address="127.0.0.2")
        ) as owner:
            flight = (await owner.post(f"http://{address}/api/v1/flights", json=FLIGHT)).json()
        url = f"ws://{address}{flight['stream_url']}"
        async with AsyncExitStack() as stack:
            for host in ("127.0.0.3", "127.0.0.4"):
                watching = [await dial(stack, url, host) for _ in range(3)]
                for each in watching[:2]:
                    await each.recv()
                await watching[2].wait_closed()
                assert watching[2].close_code == 4429
                assert "You watch this flight 2 times" in watching[2].close_reason
            full = await dial(stack, url, "127.0.0.5")
            await full.wait_closed()
            assert (full.close_code, full.close_reason[:10]) == (4429, "As many wa")
            own = await dial(stack, url, "127.0.0.2")
            assert await own.recv()

    with serve(ideal_app(ideal_flight, max_watchers=4)) as address:
        asyncio.run(watch(address))


def test_streams_make_room_for_who_is_new_but_never_an_owners() -> None:
    async def get(address: str, path: str, host: str, **body: Any) -> httpx.Response:
        transport = httpx.AsyncHTTPTransport(local_address=host)
        async with httpx.AsyncClient(transport=transport, base_url=f"http://{address}") as client:
            return await (client.post(path, **body) if body else client.get(path))

    async def watch(address: str) -> None:
        flight = (await get(address, "/api/v1/flights", "127.0.0.2", json=FLIGHT)).json()
        url = f"ws://{address}{flight['stream_url']}"
        async with AsyncExitStack() as stack:
            own = await dial(stack, url, "127.0.0.2")
            await own.recv()
            hosts = ("127.0.0.3", "127.0.0.3", "127.0.0.4", "127.0.0.4")
            strangers = [await dial(stack, url, host) for host in hosts]
            for each in strangers:
                await each.recv()
            assert (await get(address, "/api/v1/flights", "127.0.0.5")).status_code == 200
            await strangers[0].wait_closed()
            assert (strangers[0].close_code, strangers[0].close_reason[:19]) == (
                1013, "This server is full",
            )  # fmt: skip
            for each in (own, *strangers[1:]):
                assert await each.recv()

    with serve(ideal_app(), most=4) as address:
        asyncio.run(watch(address))
