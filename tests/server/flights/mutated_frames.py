"""Frames that no client should send, up the stream of a flight that is flown by hand meanwhile.

`python -m tests.server.flights.mutated_frames 100000` sends so many through the whole service, in
one process, and says what became of the sockets; some minutes.
"""

import asyncio
import json
import logging
import sys
from collections import Counter
from random import Random
from typing import Any

import httpx2 as httpx
from relguide_server.app import create_app
from relguide_server.flights.control import GIVEN_BACK, TAKEN
from relguide_server.flights.stream import CLOSE_CODES
from relguide_server.settings import ServiceSettings

from relguide.contract.protocol import STREAM

FRAMES: list[dict[str, Any]] = [
    {"kind": "take_control"},
    {"kind": "take_control", "director": False, "ident": "PURSUER"},
    {"kind": "stick", "roll": 0.5},
    {"kind": "stick", "roll": -1.0, "pitch": 1},
    {"kind": "give_back"},
]
VALUES = [
    "1e400", "-1e400", "NaN", "-Infinity", "9" * 150, "1e-400", "-0.0", "null", "true", "{}", "[]",
    '"\\ud800"', '"\\udfff\\ud800"', '"\\u0000"', '"😀é\\u202e"', '""', '"PURSUER"', '"LEADER"',
    "[" * 90, "[" * 60 + "]" * 60, '{"a":' * 25 + "1" + "}" * 25, '"' + "x" * 120 + '"', "0x10",
    "1_0", "+1", ".5", "1.", "\ufeff1", "'a'", "0.9999999999999999999", "1.0000000000000002",
]  # fmt: skip
"""What a field may be given, as it is written."""
REASON = 123
"""Longest reason of a close frame [bytes]."""


def mutated(rng: Random) -> dict[str, Any]:
    """What ASGI says of a frame: half of them right, all others wrong in some way."""
    frame = rng.choice(FRAMES)
    text = json.dumps(frame)
    match rng.randrange(14):
        case 0:
            members = {name: json.dumps(value) for name, value in frame.items()}
            members[rng.choice([*members, "ident", "roll", "yaw", "\\ud800"])] = rng.choice(VALUES)
            text = "{" + ",".join(f'"{name}":{value}' for name, value in members.items()) + "}"
        case 1:
            text = rng.choice(VALUES)
        case 2 | 3:
            for _ in range(rng.randint(1, 4)):
                at, drawn = rng.randrange(len(text)), chr(rng.choice([*range(128), 0xE9, 0x1F600]))
                text = text[:at] + rng.choice(["", drawn, text[at] * 2]) + text[at + 1 :]
                text = text or "x"
        case 4:
            text = text[: rng.randrange(len(text))]
        case 5:
            text = text[:-1] + "," + text[1:]
        case 6:
            blob = rng.randbytes(rng.randrange(300))
            return {"type": "websocket.receive", "bytes": blob, "text": None}
        case 7:
            text = text + " " * rng.randrange(400)
        case _:
            pass
    return {"type": "websocket.receive", "text": text}


async def send_all(count: int, seed: int = 0) -> Counter[str]:
    """Send so many frames over as many sockets as it takes; what became of each socket.

    Raises:
        AssertionError: if a socket is closed without a sentence, or the flight is disturbed.
    """
    app, rng, found = create_app(ServiceSettings(workers=0)), Random(seed), Counter[str]()
    async with app.router.lifespan_context(app):
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            wanted = {"scenario": "fig_6b", "rate": 5.0}
            path = (await client.post("/api/v1/flights", json=wanted)).headers["location"]
            while count > 0:
                frames = [mutated(rng) for _ in range(min(count, 45))]
                ends, sent = await connect(app, path, frames)
                count -= sent
                found[ends] += 1
            assert (await client.get(path)).json()["outcome"] == ""
            well = [{"type": "websocket.receive", "text": json.dumps(FRAMES[k])} for k in (0, 2, 4)]
            assert (await connect(app, path, well, answers=[TAKEN, GIVEN_BACK]))[0] == "left"
    return found


async def connect(
    app: Any, path: str, frames: list[dict[str, Any]], answers: list[str] | None = None
) -> tuple[str, int]:
    """One socket: how it ended, and how many frames of it were read."""
    scope = {
        "type": "websocket", "path": f"{path}/stream", "raw_path": b"", "query_string": b"",
        "root_path": "", "scheme": "ws", "headers": [(b"host", b"localhost")],
        "subprotocols": [STREAM], "client": ("127.0.0.1", 1), "server": ("localhost", 80),
        "extensions": {},
    }  # fmt: skip
    coming = iter([{"type": "websocket.connect"}, *frames])
    read, closed, heard = -1, asyncio.Event(), []
    ends = "left"

    async def receive() -> dict[str, Any]:
        nonlocal read
        await asyncio.sleep(0.0)  # as a socket would, it lets others work
        for message in coming:
            read += 1
            return message
        if answers is not None:
            async with asyncio.timeout(30.0):
                while len(heard) < len(answers):
                    await asyncio.sleep(0.05)
        return {"type": "websocket.disconnect", "code": 1000}

    async def send(message: dict[str, Any]) -> None:
        nonlocal ends
        assert not closed.is_set()
        match message:
            case {"type": "websocket.close", "code": int(code), "reason": str(reason)}:
                assert code in CLOSE_CODES, code
                assert 0 < len(reason.encode()) <= REASON
                ends = f"{code}"
                closed.set()
            case {"type": "websocket.send", "text": str(text)}:
                content = json.loads(text)
                assert content["kind"] in ("tick", "control")
                if content["kind"] == "control":
                    heard.append(content["message"])
            case _:
                assert message["type"] == "websocket.accept"

    await app(scope, receive, send)
    assert answers is None or heard == answers
    return ends, read


class Mistakes(logging.Handler):
    """Counts what is logged as an error."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.found: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Note it."""
        self.found.append(record.getMessage())


if __name__ == "__main__":
    logging.getLogger().addHandler(mistakes := Mistakes())
    ends = asyncio.run(send_all(int(sys.argv[1]), int(sys.argv[2]) if sys.argv[2:] else 0))
    sys.stdout.write(f"{ends}\n{len(mistakes.found)} mistakes in the log\n")
