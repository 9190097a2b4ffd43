"""The id of a request, and the lines of the log that carry it."""

import asyncio
import json
import logging
from collections.abc import Iterator
from io import StringIO

import httpx2 as httpx
import pytest
from relguide_server.app import create_app
from relguide_server.http import logs
from relguide_server.settings import ServiceSettings

from tests.bodies import BODY
from tests.server.serving import TestClient, ideal_app, ideal_catalogue, serve


@pytest.fixture
def lines(monkeypatch: pytest.MonkeyPatch) -> Iterator[StringIO]:
    """The log as it is written, in JSON and of level debug."""
    root, ours = logging.getLogger(), logging.getLogger(logs.LOG)
    before = root.handlers[:], root.level, ours.level
    written = StringIO()
    monkeypatch.setattr("sys.stderr", written)
    logs.configure("json", "debug")
    yield written
    root.handlers[:], root.level, ours.level = before
    ours.setLevel(before[2])


def test_an_id_is_taken_or_made_and_given_back() -> None:
    with TestClient(ideal_app()) as client:

        def given(**headers: str) -> str:
            return str(client.get("/healthz", headers=headers).headers["x-request-id"])

        assert given(**{"X-Request-ID": "from-the-proxy.1"}) == "from-the-proxy.1"
        made = given()
        assert len(made) == 32
        assert given() != made
        for wrong in ("a b", "x" * 129, "", "<b>"):
            assert len(given(**{"X-Request-ID": wrong})) == 32
        refused = client.get("/none", headers={"X-Request-ID": "refused"})
        assert refused.headers["x-request-id"] == "refused"


def test_each_line_of_a_request_has_its_id(lines: StringIO) -> None:
    with TestClient(ideal_app()) as client:
        client.get("/api/v1/flights/none", headers={"X-Request-ID": "abc"})
    (line,) = [json.loads(line) for line in lines.getvalue().splitlines() if "abc" in line]
    assert line["level"] == "debug"
    assert line["message"] == "GET /api/v1/flights/none: 404"
    assert (line["request_id"], line["route"]) == ("abc", "/api/v1/flights/{flight_id}")
    assert line["status"] == 404
    assert line["ms"] > 0.0


def test_a_mistake_is_one_line_with_its_traceback_and_the_id_of_its_answer(
    lines: StringIO,
) -> None:
    def broken(situation: object) -> None:
        raise RuntimeError("on purpose")

    app = create_app(ServiceSettings(workers=0), planner=broken, catalogue=ideal_catalogue())
    with serve(app) as address:
        answer = httpx.post(f"http://{address}/api/v1/plans?max_ms=10000", json=BODY, timeout=30.0)
    assert answer.status_code == 500
    found = [json.loads(line) for line in lines.getvalue().splitlines()]
    name = answer.headers["x-request-id"]
    # others may be of what earlier tests left to be collected
    (mistake,) = [
        line for line in found if line["level"] == "error" and line.get("request_id") == name
    ]
    assert "RuntimeError: on purpose" in mistake["message"]


def test_a_client_that_left_is_one_line(lines: StringIO) -> None:
    async def leave(address: str) -> None:
        host, _, port = address.partition(":")
        reader, writer = await asyncio.open_connection(host, int(port))
        body = json.dumps(BODY)
        head = (
            f"POST /api/v1/plans?max_ms=10000 HTTP/1.1\r\nHost: {address}\r\nX-Request-ID: left\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body) + 9}\r\n\r\n"
        )
        writer.write((head + body).encode())
        await writer.drain()
        await asyncio.sleep(0.2)
        writer.close()
        await writer.wait_closed()
        await asyncio.sleep(0.3)
        del reader

    with serve(ideal_app()) as address:
        asyncio.run(leave(address))
    found = [json.loads(line) for line in lines.getvalue().splitlines()]
    said = [line for line in found if line["level"] != "debug"]
    assert [line["message"] for line in said] == [
        "A client left before POST /api/v1/plans was answered.",
        "The service is stopping.",
    ]
    assert said[0]["request_id"] == "left"


def test_a_traceback_is_within_its_line(lines: StringIO) -> None:
    try:
        raise RuntimeError("on purpose")
    except RuntimeError:
        logging.getLogger("relguide.server").exception("It broke")
    line = json.loads(lines.getvalue())
    assert line["message"] == "It broke"
    assert line["exception"].endswith("RuntimeError: on purpose\n")


def test_text_lines_are_for_people() -> None:
    record = logging.LogRecord("relguide.server", logging.INFO, "", 1, "Said %s.", ("so",), None)
    record.fields = {"status": 200}
    assert logs.TextLines().format(record).endswith("INFO    Said so.  [status=200]")
