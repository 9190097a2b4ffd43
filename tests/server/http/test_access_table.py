"""Every route and every role; and what comes in to harm: paths that climb, bodies that swell."""

import asyncio
import gzip
import json
import socket
from collections.abc import Iterator

import httpx2 as httpx
import pytest
import viser
from relguide_server.app import create_app
from relguide_server.doors.connections import LONGEST_HEAD
from relguide_server.http.access import NO_TOKEN, ROLES, UNKNOWN_TOKEN
from relguide_server.planning.plans import EXAMPLE
from relguide_server.scene.guarded_port import HEADER, SECRET
from relguide_server.settings import ServiceSettings
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus
from websockets.typing import Subprotocol

from relguide.contract.protocol import STREAM
from tests.server.http.test_access import FLIGHT, SETTING, TOKENS
from tests.server.serving import TestClient, ideal_app, serve
from tests.server.test_api import is_problem

FLOOD = 32 * 1024 * 1024
"""More than the system's own buffers hold [bytes]."""
WHO = {
    "open": ("", *ROLES),
    "view": ROLES,
    "fly": ("fly", "control"),
    "answer": ("atc", "control"),
    "control": ("control",),
}
"""Whom each word of the table lets pass; nobody needs a token for "open"."""
BESIDES = {
    ("POST", "/api/v1/clearances?dry_run=true"): "view",
    ("POST", "/api/v1/clearances?dry_run=true&dry_run=false"): "fly",
    ("POST", "/api/v1/feeds"): "answer",
    ("DELETE", "/api/v1/feeds/none"): "answer",
}
"""What depends on more than the route, or has none here."""
TABLE = {
    ("GET", "/healthz"): "open",
    ("GET", "/readyz"): "open",
    ("GET", "/metrics"): "view",
    ("GET", "/"): "view",
    ("GET", "/atc"): "view",
    ("GET", "/docs"): "view",
    ("GET", "/docs/stream"): "view",
    ("GET", "/guide"): "view",
    ("GET", "/guide/{name}"): "view",
    ("GET", "/docs/swagger-ui.css"): "view",
    ("GET", "/openapi.json"): "view",
    ("GET", "/asyncapi.json"): "view",
    ("GET", "/scene/{flight_id}"): "view",
    ("GET", "/scene/{flight_id}/"): "view",
    ("GET", "/no/such/page"): "view",
    ("POST", "/no/such/page"): "fly",
    ("POST", "/api/v1/plans"): "view",
    ("POST", "/api/v1/plans/batch"): "view",
    ("POST", "/api/v1/plans/compare"): "view",
    ("GET", "/api/v1/areas"): "view",
    ("POST", "/api/v1/areas"): "view",
    ("POST", "/api/v1/simulations"): "view",
    ("GET", "/api/v1/scenarios"): "view",
    ("GET", "/api/v1/scenarios/{name}/flight"): "view",
    ("GET", "/api/v1/flights"): "view",
    ("POST", "/api/v1/flights"): "fly",
    ("GET", "/api/v1/flights/{flight_id}"): "view",
    ("DELETE", "/api/v1/flights/{flight_id}"): "fly",
    ("POST", "/api/v1/flights/{flight_id}/commands"): "fly",
    ("GET", "/api/v1/records/flights"): "view",
    ("GET", "/api/v1/records/plans"): "view",
    ("GET", "/api/v1/records/flights/{flight_id}"): "view",
    ("DELETE", "/api/v1/records/flights/{flight_id}"): "control",
    ("GET", "/api/v1/records/flights/{flight_id}/documents"): "view",
    ("POST", "/api/v1/records/flights/{flight_id}/replay"): "fly",
    ("GET", "/api/v1/records/flights/{flight_id}/export"): "view",
    ("GET", "/api/v1/clearances"): "view",
    ("POST", "/api/v1/clearances"): "fly",
    ("GET", "/api/v1/clearances/{clearance_id}"): "view",
    ("GET", "/api/v1/clearances/{clearance_id}/export"): "view",
    ("POST", "/api/v1/clearances/{clearance_id}/answers"): "answer",
    ("POST", "/api/v1/clearances/{clearance_id}/replies"): "fly",
    ("GET", "/api/v1/atc/traffic"): "view",
    ("GET", "/api/v1/traffic"): "view",
    ("PUT", "/api/v1/traffic"): "answer",
    ("DELETE", "/api/v1/traffic"): "answer",
    ("GET", "/api/v1/airspaces"): "view",
    ("PUT", "/api/v1/airspaces"): "answer",
    ("DELETE", "/api/v1/airspaces"): "answer",
}


@pytest.fixture(scope="module")
def guarded() -> Iterator[TestClient]:
    with TestClient(ideal_app(tokens=SETTING)) as client:
        yield client


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


def test_the_table_has_every_route() -> None:
    paths = create_app(ServiceSettings(workers=0)).openapi()["paths"]
    described = {(method.upper(), path) for path, methods in paths.items() for method in methods}
    assert described <= set(TABLE)


@pytest.mark.parametrize(("route", "needed"), (TABLE | BESIDES).items())
def test_who_may(guarded: TestClient, route: tuple[str, str], needed: str) -> None:
    method, path = route
    path = path.format(flight_id="none", clearance_id="none", name="none")
    for who in ("", *ROLES):
        headers = {"Authorization": f"Bearer {TOKENS[who]}"} if who else {}
        status = guarded.request(method, path, headers=headers, follow_redirects=False).status_code
        if who in WHO[needed]:
            assert status not in (401, 403), who
        else:
            assert status == (403 if who else 401), who


def test_sockets_need_a_token() -> None:
    async def listen(address: str, path: str, token: str) -> tuple[int, str]:
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        try:
            async with connect(
                f"ws://{address}{path}", subprotocols=[Subprotocol(STREAM)],
                additional_headers=headers, proxy=None,
            ):  # fmt: skip
                return 101, ""
        except InvalidStatus as refused:
            said = json.loads(refused.response.body)
            return refused.response.status_code, said["detail"]

    with serve(ideal_app(tokens=SETTING)) as address:
        started = httpx.post(
            f"http://{address}/api/v1/flights",
            json=FLIGHT, headers={"Authorization": f"Bearer {TOKENS['fly']}"},
        ).json()  # fmt: skip
        for path in (started["stream_url"], started["scene_url"]):
            assert asyncio.run(listen(address, path, "")) == (401, NO_TOKEN)
            assert asyncio.run(listen(address, path, "x" * 16)) == (401, UNKNOWN_TOKEN)
        assert asyncio.run(listen(address, started["stream_url"], TOKENS["view"])) == (101, "")


def test_the_port_of_a_scene_is_for_the_service_alone() -> None:
    """Viser itself takes commands from all that connect."""
    app = ideal_app()

    async def find() -> str:
        (flight,) = app.state.fleet
        address: str = await flight.enter_scene()
        return address

    async def dial(address: str, headers: dict[str, str]) -> int:
        protocols = [Subprotocol(f"viser-v{viser.__version__}")]
        url = f"ws://{address}"
        try:
            async with connect(
                url, subprotocols=protocols, additional_headers=headers, proxy=None, max_size=None
            ) as scene:
                await scene.recv()
        except InvalidStatus as refused:
            return refused.response.status_code
        return 101

    with TestClient(app) as client:
        client.post("/api/v1/flights", json=FLIGHT)
        address = client.portal.call(find)
        assert address.startswith("127.0.0.1:")
        for headers in ({}, {HEADER: ""}, {HEADER: SECRET[:-1]}, {"Origin": f"http://{address}"}):
            assert asyncio.run(dial(address, headers)) == 403
        assert asyncio.run(dial(address, {HEADER: SECRET})) == 101
        assert httpx.get(f"http://{address}/").status_code == 403


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml",
        "/../../pyproject.toml",
        "/%2e%2e/%2e%2e/pyproject.toml",
        "/%2e%2e/pyproject.toml",
        "/assets/..%2f..%2fpackage.json",
        "/docs/..%2fapp.py",
        "/docs/%2e%2e%2f%2e%2e%2fapp.py",
        "/scene/..%2f..%2fetc%2fpasswd/",
        "/scene/x/../../../etc/passwd",
        "/api/v1/records/flights/..%2f..%2f..%2fetc%2fpasswd/export",
        "//etc/passwd",
        "/\\..\\..\\etc\\passwd",
        "/%00",
    ],
)
def test_no_path_climbs_out(path: str) -> None:
    with serve(ideal_app()) as address:
        host, _, port = address.partition(":")
        with socket.create_connection((host, int(port)), 5.0) as raw:  # as no client would send it
            raw.sendall(
                f"GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n".encode()
            )
            answer = b"".join(iter(lambda: raw.recv(65536), b""))
    status = int(answer.split()[1])
    assert status in (400, 404)
    assert b"root:" not in answer
    assert b"create_app" not in answer


WIDE = json.dumps({**EXAMPLE, **{f"k{n}": 0 for n in range(4_000)}}).encode()


@pytest.mark.parametrize(
    ("body", "encoding", "status"),
    [
        (gzip.compress(b" " * 50_000_000), "gzip", 415),  # never unpacked
        (b"[" * 60_000, "", 400),
        (b'{"a":' * 10_000 + b"1" + b"}" * 10_000, "", 400),
        (b'{"slot_distance_m": ' + b"9" * 60_000 + b"}", "", 400),
        (b'{"slot_distance_m": 1e' + b"9" * 50_000 + b"}", "", 422),
        (WIDE, "", 422),
    ],
    ids=["gzip", "lists", "objects", "digits", "exponent", "keys"],
)
def test_a_bomb_is_refused_shortly(
    client: TestClient, body: bytes, encoding: str, status: int
) -> None:
    headers = {"Content-Type": "application/json"}
    if encoding:
        headers["Content-Encoding"] = encoding
    answer = client.post("/api/v1/plans", content=body, headers=headers)
    is_problem(answer, status, "/api/v1/plans")
    assert len(answer.content) < 8_000
    assert answer.elapsed.total_seconds() < 2.0


def test_headers_without_end_are_refused() -> None:
    with serve(ideal_app()) as address:
        host, _, port = address.partition(":")
        with socket.create_connection((host, int(port)), 5.0) as raw:
            raw.sendall(f"GET /healthz HTTP/1.1\r\nHost: {address}\r\n".encode())
            try:
                for _ in range(2_000):
                    raw.sendall(b"X-More: " + b"x" * 1_000 + b"\r\n")
                raw.sendall(b"\r\n")
                answer = raw.recv(65536)
            except OSError:
                answer = b""  # it has hung up
    assert not answer.startswith(b"HTTP/1.1 200")


@pytest.mark.parametrize(
    "begun",
    [
        "GET /",
        "GET /healthz HTTP/1.1\r\nX",
        "GET /healthz HTTP/1.1\r\nX: ",
        "POST /api/v1/plans HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        "Transfer-Encoding: chunked\r\n\r\n1\r\n{\r\n0\r\nX: ",
    ],
    ids=["address", "name", "value", "trailer"],
)
def test_a_line_without_end_is_not_collected(begun: str) -> None:
    with serve(ideal_app()) as address:
        host, _, port = address.partition(":")
        with socket.create_connection((host, int(port)), 10.0) as raw:
            raw.sendall(begun.encode())
            with pytest.raises(ConnectionError):
                raw.sendall(b"x" * FLOOD)
        assert httpx.get(f"http://{address}/healthz").is_success


def test_a_large_body_is_no_head() -> None:
    padded = b" " * 8 * LONGEST_HEAD + b"[]"
    with serve(ideal_app()) as address:
        answer = httpx.post(
            f"http://{address}/api/v1/plans/batch",
            content=padded,
            headers={"Content-Type": "application/json"},
        )
    assert (answer.status_code, answer.json()) == (200, [])


def test_a_head_that_never_comes_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.doors.connections.HEAD_PATIENCE", 0.3)
    with serve(ideal_app()) as address:
        host, _, port = address.partition(":")
        for begun in (b"", b"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Slow: "):
            with socket.create_connection((host, int(port)), 5.0) as raw:
                raw.sendall(begun)
                assert raw.recv(100) == b""
