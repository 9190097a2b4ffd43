"""Who may ask: names, pages and tokens, each refusal red once."""

import asyncio
from collections.abc import Iterator

import httpx2 as httpx
import pytest
from relguide_server.flights.scene_relay import may_pass
from relguide_server.http.access import may_answer, read_tokens
from relguide_server.planning.plans import EXAMPLE
from starlette.requests import HTTPConnection
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus
from websockets.typing import Origin, Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.server.flights.test_scene_relay import message
from tests.server.flown import ideal_flight
from tests.server.serving import TestClient, ideal_app, serve
from tests.server.test_api import is_problem

TOKENS = {
    "view": "v" * 16,
    "fly": "f" * 16,
    "other": "o" * 16,
    "atc": "a" * 16,
    "control": "c" * 16,
}
SETTING = ",".join(f"{'fly' if who == 'other' else who}:{token}" for who, token in TOKENS.items())
FLIGHT = {"scenario": "ideal", "paused": True}


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app()) as client:
        yield client


@pytest.fixture(scope="module")
def guarded() -> Iterator[TestClient]:
    with TestClient(ideal_app(tokens=SETTING)) as client:
        yield client


@pytest.mark.parametrize("host", ["localhost", "localhost:8000", "127.0.0.1:8000", "[::1]:8000"])
def test_it_answers_to_itself_and_to_addresses(client: TestClient, host: str) -> None:
    assert client.get("/healthz", headers={"Host": host}).status_code == 200


@pytest.mark.parametrize("host", ["evil.example", "localhost.evil.example:8000", "", "127.0.0.1.x"])
def test_a_name_that_was_rebound_to_it_is_not_answered(client: TestClient, host: str) -> None:
    answer = client.get("/api/v1/flights", headers={"Host": host})
    is_problem(answer, 421, "/api/v1/flights")


def test_names_can_be_given() -> None:
    with TestClient(ideal_app(hosts="fly.example, other.example")) as client:
        assert client.get("/healthz", headers={"Host": "fly.example:80"}).status_code == 200
        assert client.get("/healthz", headers={"Host": "sly.example"}).status_code == 421


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://localhost:9", "x://["])
def test_a_foreign_page_changes_nothing(client: TestClient, origin: str) -> None:
    headers = {"Origin": origin}
    started = client.post("/api/v1/flights", json=FLIGHT, headers=headers)
    is_problem(started, 403, "/api/v1/flights")
    is_problem(client.delete("/api/v1/flights/x", headers=headers), 403, "/api/v1/flights/x")
    assert client.get("/api/v1/flights", headers=headers).status_code == 200


def test_its_own_page_may(client: TestClient) -> None:
    headers = {"Origin": "http://localhost"}
    started = client.post("/api/v1/flights", json=FLIGHT, headers=headers)
    assert started.status_code == 201
    assert client.delete(started.headers["location"], headers=headers).status_code == 204


def test_a_foreign_page_does_not_listen() -> None:
    async def listen(address: str, path: str, origin: str) -> int:
        protocols = [Subprotocol(PROTOCOL)]
        url = f"ws://{address}{path}"
        try:
            async with connect(url, subprotocols=protocols, origin=Origin(origin), proxy=None) as s:
                await s.recv()
        except InvalidStatus as refused:
            return refused.response.status_code
        return 101

    with serve(ideal_app(ideal_flight)) as address:
        flight = httpx.post(f"http://{address}/api/v1/flights", json=FLIGHT).json()
        for path in (flight["stream_url"], flight["scene_url"]):
            assert asyncio.run(listen(address, path, "http://evil.example")) == 403
        assert asyncio.run(listen(address, flight["stream_url"], f"http://{address}")) == 101


@pytest.mark.parametrize(
    ("method", "path", "body", "statuses"),
    [
        # in the order of no token, view, fly, atc, control
        ("GET", "/healthz", None, (200, 200, 200, 200, 200)),
        ("GET", "/metrics", None, (401, 200, 200, 200, 200)),
        ("GET", "/openapi.json", None, (401, 200, 200, 200, 200)),
        ("GET", "/api/v1/flights", None, (401, 200, 200, 200, 200)),
        ("GET", "/scene/none/", None, (401, 404, 404, 404, 404)),
        ("POST", "/api/v1/plans", EXAMPLE, (401, 200, 200, 200, 200)),
        ("POST", "/api/v1/flights", FLIGHT, (401, 403, 201, 403, 201)),
        ("POST", "/api/v1/flights/none/commands", {"command": "play"}, (401, 403, 404, 403, 404)),
        ("DELETE", "/api/v1/flights/none", None, (401, 403, 404, 403, 404)),
        ("DELETE", "/api/v1/records/flights/none", None, (401, 403, 403, 403, 404)),
    ],
)
def test_what_each_token_may(
    guarded: TestClient, method: str, path: str, body: object, statuses: tuple[int, ...]
) -> None:
    for who, status in zip(("", "view", "fly", "atc", "control"), statuses, strict=True):
        headers = {"Authorization": f"Bearer {TOKENS[who]}"} if who else {}
        answer = guarded.request(method, path, json=body, headers=headers)
        assert answer.status_code == status, (who, answer.text)


def test_a_flight_is_commanded_by_its_owner_alone(guarded: TestClient) -> None:
    def ask(who: str, method: str, path: str, body: object = None) -> httpx.Response:
        headers = {"Authorization": f"Bearer {TOKENS[who]}"}
        return guarded.request(method, path, json=body, headers=headers)

    place = ask("fly", "POST", "/api/v1/flights", FLIGHT).headers["location"]
    for who, status in (("other", 403), ("fly", 202), ("control", 202)):
        answer = ask(who, "POST", f"{place}/commands", {"command": "pause"})
        assert answer.status_code == status
    assert ask("other", "GET", place).status_code == 200
    assert ask("other", "DELETE", place).status_code == 403
    assert ask("control", "DELETE", place).status_code == 204


def test_open_to_other_machines_without_tokens_a_client_has_its_own_flights_alone() -> None:
    with TestClient(ideal_app(exposed=True)) as app:
        first, second = (TestClient(app.app, client=(f"192.0.2.{k}", 1)) for k in (1, 2))
        place = first.post("/api/v1/flights", json=FLIGHT).headers["location"]
        for client, status in ((second, 403), (first, 202)):
            answer = client.post(f"{place}/commands", json={"command": "pause"})
            assert answer.status_code == status
        refused = second.delete(place)
        is_problem(refused, 403, place)
        assert "RELGUIDE_OPEN_CONTROL=on" in refused.json()["detail"]
        assert second.get(place).status_code == 200
        assert second.post("/api/v1/plans", json=EXAMPLE).status_code == 200
        assert first.delete(place).status_code == 204
        for client, method, path in (
            (app, "DELETE", "/api/v1/records/flights/none"),  # from this machine, or through a NAT
            (first, "DELETE", "/api/v1/records/flights/none"),
            (first, "PUT", "/api/v1/traffic"),
            (first, "PUT", "/api/v1/airspaces"),
        ):
            refused = client.request(method, path)
            is_problem(refused, 403, path)
            assert "RELGUIDE_OPEN_CONTROL=on" in refused.json()["detail"]


@pytest.mark.parametrize(
    ("address", "guest"),
    [
        ("127.0.0.1", False), ("127.9.9.9", False), ("::1", False), ("::ffff:127.0.0.1", False),
        ("192.0.2.1", True), ("2001:db8::1", True), ("unknown", True),
    ],
)  # fmt: skip
def test_who_asks_through_a_proxy_on_this_machine_is_a_guest_too(address: str, guest: bool) -> None:
    with TestClient(ideal_app(), client=(address, 1)) as client:
        answer = client.delete("/api/v1/records/flights/none")
    assert answer.status_code == (403 if guest else 404)


@pytest.mark.parametrize("settings", [{"open_control": "on"}, {"tokens": SETTING}])
def test_control_may_be_open_to_all_or_to_a_token(settings: dict[str, str]) -> None:
    headers = {"Authorization": f"Bearer {TOKENS['control']}"}
    app = ideal_app(exposed=True, **settings)
    with TestClient(app, client=("192.0.2.1", 1), headers=headers) as client:
        assert client.delete("/api/v1/records/flights/none").status_code == 404


def test_a_controller_answers_for_all_flights_and_a_guest_for_its_own() -> None:
    def asks(role: str, owner: str) -> HTTPConnection:
        return HTTPConnection({"type": "http", "state": {"role": role, "owner": owner}})

    for role, owner, may in (
        ("atc", "x", True), ("control", "", True), ("guest", "a", True), ("guest", "b", False),
        ("fly", "a", False), ("view", "a", False),
    ):  # fmt: skip
        assert may_answer(asks(role, owner), "a") == may


@pytest.mark.parametrize("page", ["/", "/atc"])
def test_a_browser_shows_its_token_once(guarded: TestClient, page: str) -> None:
    guarded.cookies.clear()
    assert guarded.get("/", follow_redirects=False).status_code == 401
    unknown = guarded.get("/api/v1/flights", headers={"Authorization": "Bearer " + 16 * "x"})
    assert unknown.status_code == 401
    assert "not one of the service's" in unknown.json()["detail"]
    assert "needs a token" in guarded.get("/api/v1/flights").json()["detail"]
    opened = guarded.get(f"{page}?token={TOKENS['view']}", follow_redirects=False)
    assert (opened.status_code, opened.headers["location"]) == (303, page)
    assert "HttpOnly; Path=/; SameSite=strict" in opened.headers["set-cookie"]
    assert guarded.get("/api/v1/flights").status_code == 200
    guarded.cookies.clear()


@pytest.mark.parametrize("scheme", ["http", "https"])
def test_a_token_kept_over_https_is_sent_over_https_alone(guarded: TestClient, scheme: str) -> None:
    address = f"{scheme}://localhost/?token={TOKENS['view']}"
    kept = guarded.get(address, follow_redirects=False).headers["set-cookie"]
    guarded.cookies.clear()
    assert ("Secure" in kept) == (scheme == "https")


@pytest.mark.parametrize("text", ["view", "view:short", "pilot:" + "x" * 16])
def test_tokens_that_are_none_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="tokens must be a list"):
        read_tokens(text)


def test_only_named_fields_pass_to_the_scene() -> None:
    assert may_pass(message("GuiUpdateMessage", uuid="a", updates={"value": True}))
    assert not may_pass(message("GuiUpdateMessage", uuid="a", updates={}, more=1))
    assert not may_pass(message("ShareUrlRequest"))


def test_only_so_many_watch_a_flight() -> None:
    async def watch(address: str, path: str) -> list[int | None]:
        protocols = [Subprotocol(PROTOCOL)]
        url = f"ws://{address}{path}"
        async with connect(url, subprotocols=protocols, proxy=None) as one:
            await one.recv()
            async with connect(url, subprotocols=protocols, proxy=None) as two:
                await two.wait_closed()
                return [one.close_code, two.close_code]

    with serve(ideal_app(ideal_flight, max_watchers=1)) as address:
        flight = httpx.post(f"http://{address}/api/v1/flights", json=FLIGHT).json()
        assert asyncio.run(watch(address, flight["stream_url"])) == [None, 4429]


def test_head_is_get_without_a_body(client: TestClient) -> None:
    for path in ("/healthz", "/api/v1/flights", "/api/v1/scenarios"):
        head, got = client.head(path), client.get(path)
        assert (head.status_code, head.content) == (200, b"")
        assert head.headers["content-length"] == got.headers["content-length"]


def test_pages_may_load_nothing_from_elsewhere(client: TestClient) -> None:
    policy = client.get("/docs").headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert "script-src 'self' 'sha256-" in policy
    plain = client.get("/healthz").headers
    assert "script-src 'self';" in plain["content-security-policy"]
    assert plain["relguide-version"]
