"""Below a path of a proxy, all addresses that the service gives lead back through it."""

import asyncio
import re

import httpx2 as httpx
import pytest
import viser
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.bodies import BODY
from tests.server.serving import TestClient, ideal_app, serve

TOKEN = "v" * 16
FLIGHT = {"scenario": "ideal", "paused": True}


@pytest.mark.parametrize("stripped", [True, False])
def test_everything_works_below_a_path(stripped: bool) -> None:
    """Whether the proxy strips its path or leaves it there."""
    below = "" if stripped else "/relguide"
    with TestClient(ideal_app(root_path="/relguide")) as client:
        page = client.get(f"{below}/")
        assert page.status_code in (200, 503)  # it may not have been built
        assert not re.search(r'(href|src)="/', page.text)
        for path in ("/healthz", "/metrics", "/api/v1/scenarios"):
            assert client.get(below + path).status_code == 200
        assert client.post(f"{below}/api/v1/plans", json=BODY).status_code == 200
        assert client.get(f"{below}/openapi.json").json()["servers"] == [{"url": "/relguide"}]
        docs = client.get(f"{below}/docs").text
        assert all(address.startswith("/relguide/") for address in re.findall(r'"(/[^"]+)"', docs))
        script = client.get(f"{below}/docs/swagger-ui-bundle.js")
        assert script.status_code == 200
        started = client.post(f"{below}/api/v1/flights", json=FLIGHT)
        flight = started.json()
        assert started.headers["location"] == f"/relguide/api/v1/flights/{flight['id']}"
        assert flight["scene_url"] == f"/relguide/scene/{flight['id']}/"
        scene = client.get(f"{below}/scene/{flight['id']}", follow_redirects=False)
        assert scene.headers["location"] == flight["scene_url"]
        missing = client.get(f"{below}/api/v1/none")
        assert missing.json()["instance"] == "/relguide/api/v1/none"


def test_streams_and_scenes_work_below_a_path() -> None:
    async def listen(url: str, protocol: str) -> object:
        async with connect(url, subprotocols=[Subprotocol(protocol)], proxy=None) as socket:
            return await socket.recv()

    with serve(ideal_app(root_path="/relguide")) as address:
        flight = httpx.post(f"http://{address}/relguide/api/v1/flights", json=FLIGHT).json()
        for path, protocol in (
            (flight["stream_url"], PROTOCOL),
            (flight["scene_url"], f"viser-v{viser.__version__}"),
        ):
            assert path.startswith("/relguide/")
            for given in (path, path.removeprefix("/relguide")):
                assert asyncio.run(listen(f"ws://{address}{given}", protocol))


def test_its_page_is_where_relative_addresses_are_right() -> None:
    with TestClient(ideal_app(root_path="/relguide/")) as client:
        for asked, page in (
            ("/relguide", "/relguide/"),
            ("/relguide?engaged", "/relguide/?engaged"),
        ):
            redirected = client.get(asked, follow_redirects=False)
            assert (redirected.status_code, redirected.headers["location"]) == (308, page)


def test_a_token_is_kept_for_its_path_alone() -> None:
    with TestClient(ideal_app(root_path="/relguide", tokens=f"view:{TOKEN}")) as client:
        opened = client.get(f"/relguide/?token={TOKEN}", follow_redirects=False)
        assert opened.headers["location"] == "/relguide/"
        assert "Path=/relguide/;" in opened.headers["set-cookie"]
        assert client.get("/relguide/api/v1/flights").status_code == 200
        refused = client.post("/relguide/api/v1/flights", json=FLIGHT)
        assert refused.status_code == 403
        assert refused.json()["instance"] == "/relguide/api/v1/flights"


def test_a_path_is_believed_from_a_proxy_alone() -> None:
    headers = {"X-Forwarded-Prefix": "/fly"}
    for proxies, path in (("127.0.0.1", "/fly"), ("10.0.0.0/8", ""), ("*", "/fly")):
        with serve(ideal_app(proxies=proxies)) as address:
            url = f"http://{address}/api/v1/flights"
            flight = httpx.post(url, json=FLIGHT, headers=headers).json()
            assert flight["stream_url"] == f"{path}/api/v1/flights/{flight['id']}/stream"
    with TestClient(ideal_app(proxies="*")) as client:
        for evil in ("//evil.example", "/a b", "https://evil.example", '/"><script>'):
            answer = client.get("/docs", headers={"X-Forwarded-Prefix": evil})
            assert "evil" not in answer.text
            assert "script>" not in answer.text.split("<script", 1)[0]


@pytest.mark.parametrize(
    ("proxies", "recorded"), [("127.0.0.1", "203.0.113.9"), ("10.0.0.0/8", "127.0.0.1")]
)
def test_a_proxy_that_is_believed_says_who_asks(proxies: str, recorded: str) -> None:
    app = ideal_app(proxies=proxies)
    noted: list[str] = []
    app.state.records.note_command = lambda *_, sent_by, **__: noted.append(sent_by)
    with serve(app) as address:
        asks = {"X-Forwarded-For": "203.0.113.9"}
        flights = f"http://{address}/api/v1/flights"
        flight = httpx.post(flights, json=FLIGHT, headers=asks).json()
        httpx.post(f"{flights}/{flight['id']}/commands", json={"command": "play"}, headers=asks)
    assert noted == [recorded]
