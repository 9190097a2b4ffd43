"""Is every body that is posted answered below 500, whatever it holds?

    python -m benchmarks.service.mutated_bodies --count 100000 --seed 1

takes each route that takes a body, with the example that the service's own document gives, changes
a few things in it, and posts it. Values become others of all kinds, numbers too large and lone
surrogates among them; fields go, come, or change their names; and bytes are changed, lost or put
in. What is answered by 500 or more is listed with its body, but for 503, which says that the
service is busy. A body comes of the seed, its number and its route.
"""

import argparse
import asyncio
import json
import random
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from time import monotonic
from typing import Any

import uvloop
from rich.console import Console

from benchmarks.options import positive
from benchmarks.service.load import request
from benchmarks.service.service import Service, running

JSON = "application/json"
VALUES = (
    "null", "true", "[]", "{}", '""', "0", "-0", "-1", "1e400", "-1e400", "1e-320", "NaN",
    "Infinity", "9007199254740993", "1" * 400, '"\\ud800"', '"\\udc00x"', '"\\u0000"', '"nan"',
    '"' + "x" * 5000 + '"', "[" * 300 + "]" * 300, '{"a":' * 120 + "1" + "}" * 120, "[[null]]",
    "1000000", "-1000000", "360", "90.5", '"left"', '"exact"', "[1,2]", '{"__class__":1}',
)  # fmt: skip
"""What a value becomes."""
NAMES = (
    "\\ud800", "", "__proto__", "id", "ident", "tas_kt", "x" * 300, "\\u0000", "pursuer", "intent",
)  # fmt: skip
"""What a field's name becomes."""
SEVERAL = 3
"""At most so many changes of a body."""
SLOW = ("/api/v1/simulations", "/api/v1/areas", "/api/v1/plans/compare")
"""Routes whose answers take long: they are asked on a connection of their own."""
LISTED = 10


@dataclass(slots=True)
class Found:
    """What came of them."""

    answers: Counter[tuple[str, int]] = field(default_factory=Counter)
    """By route and status; 0 where the connection ended without an answer."""
    broken: list[tuple[str, int, bytes]] = field(default_factory=list)
    slowest: float = 0.0
    """[s]."""


@dataclass(frozen=True, slots=True)
class Route:
    """Takes a body."""

    method: str
    path: str
    example: str


class _Hole:
    """Where a text goes that need not be JSON."""

    def __init__(self, text: str) -> None:
        self.text = text


def main(arguments: list[str] | None = None) -> int:
    """Post them and report; 1 if one was answered by a mistake."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--count", type=positive, default=2000, help="how many bodies")
    parser.add_argument("--seconds", type=positive, default=600, help="for so long at most")
    parser.add_argument("--seed", type=positive, default=1)
    parser.add_argument("--workers", type=int, default=2, help="of the service")
    given = parser.parse_args(arguments)
    found = Found()
    with running(record_plans=0, spare_after=0.001, workers=given.workers) as service:
        routes = routes_of(service)
        uvloop.run(_post_all(service.port, routes, given, found))
    return report(found)


def routes_of(service: Service) -> list[Route]:
    """All that take a body, with an example of it each; those of flights are for one in the air."""
    flight = service.get("/api/v1/flights", "POST", {"scenario": "fig_6b", "paused": True})["id"]
    routes = []
    for path, methods in service.get("/openapi.json")["paths"].items():
        for method, about in methods.items():
            content = about.get("requestBody", {}).get("content", {})
            if "example" in content.get(JSON, {}):
                example = json.dumps(content[JSON]["example"])
                routes.append(Route(method.upper(), path.replace("{flight_id}", flight), example))
    return routes


def mutated(example: str, rng: random.Random) -> bytes:
    """An example with a few things changed."""
    if rng.random() < 0.2:
        return _change_bytes(example.encode(), rng)
    content = json.loads(example)
    for _ in range(rng.randint(1, SEVERAL)):
        content = _change_one(content, rng)
    return _write(content).encode()


def _change_one(content: Any, rng: random.Random) -> Any:
    """The content with a change at a random place, which may be the whole."""
    if isinstance(content, dict) and content and rng.random() < 0.85:
        names = list(content)
        name = rng.choice(names)
        how = rng.random()
        if how < 0.7:
            return content | {name: _change_one(content[name], rng)}
        if how < 0.8:
            return {other: content[other] for other in names if other != name}
        if how < 0.9:
            return content | {rng.choice(NAMES): content[name]}
        renamed = rng.choice(NAMES)
        return {renamed if other == name else other: content[other] for other in names}
    if isinstance(content, list) and content and rng.random() < 0.85:
        place = rng.randrange(len(content))
        if rng.random() < 0.2:
            return content[:place] + [content[place]] * rng.randint(0, 40) + content[place:]
        return [*content[:place], _change_one(content[place], rng), *content[place + 1 :]]
    if isinstance(content, int | float) and rng.random() < 0.6:
        return content * rng.choice((-1.0, 0.0, 0.5, 1.001, 3.0, 10.0, 1e3, 1e9))
    return _Hole(rng.choice(VALUES))


def _write(content: Any) -> str:
    """JSON, but for what is in holes and names."""
    match content:
        case _Hole():
            return content.text
        case dict():
            fields = (f'"{name}":{_write(value)}' for name, value in content.items())
            return f"{{{','.join(fields)}}}"
        case list():
            return f"[{','.join(map(_write, content))}]"
        case _:
            return json.dumps(content)


def _change_bytes(text: bytes, rng: random.Random) -> bytes:
    """The bytes with some changed, lost or put in."""
    changed = bytearray(text)
    for _ in range(rng.randint(1, SEVERAL)):
        place = rng.randrange(len(changed) + 1)
        match rng.randrange(4):
            case 0:
                changed[place : place + 1] = bytes([rng.randrange(256)])
            case 1:
                del changed[place : place + rng.randint(1, 20)]
            case 2:
                changed[place:place] = rng.randbytes(rng.randint(1, 8))
            case _:
                del changed[place:]
    return bytes(changed)


async def _post_all(
    port: int, routes: Sequence[Route], given: argparse.Namespace, found: Found
) -> None:
    numbers, end = iter(range(given.count)), monotonic() + given.seconds
    quick = [route for route in routes if route.path not in SLOW]
    slow = [route for route in routes if route.path in SLOW]

    async def ask(routes: Sequence[Route]) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        for number in numbers:
            if monotonic() > end:
                return
            rng = random.Random(f"{given.seed} {number}")
            route = rng.choice(routes)
            body, began = mutated(route.example, rng), monotonic()
            try:
                writer.write(request(route.method, route.path, body))
                status, closes = await _read(reader)
            except (OSError, EOFError):
                status, closes = 0, True
            found.slowest = max(found.slowest, monotonic() - began)
            found.answers[f"{route.method} {route.path}", status] += 1
            if status == 0 or (status >= 500 and status != 503):
                found.broken.append((f"{route.method} {route.path}", status, body))
            if closes:
                writer.close()
                reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.close()

    await asyncio.gather(ask(slow), *(ask(quick) for _ in range(4)))


async def _read(reader: asyncio.StreamReader) -> tuple[int, bool]:
    """The status of an answer, which is read to its end, and whether it is the last."""
    head = (await reader.readuntil(b"\r\n\r\n")).lower()
    _, sized, rest = head.partition(b"content-length:")
    if sized:
        await reader.readexactly(int(rest.partition(b"\r\n")[0]))
    elif b"chunked" in head:
        await reader.readuntil(b"\r\n0\r\n\r\n")
    return int(head[9:12]), b"connection: close" in head


def report(found: Found) -> int:
    """Print what was answered, and what was broken; 1 if something was."""
    console = Console(width=118)
    by_status: Counter[int] = Counter()
    for (_, status), count in found.answers.items():
        by_status[status] += count
    console.print(
        f"{found.answers.total():,} bodies, slowest {found.slowest:.1f} s; "
        + ", ".join(f"{count:,} × {status}" for status, count in sorted(by_status.items()))
        + f"; {len(found.broken)} mistakes"
    )
    for (route, status), count in sorted(found.answers.items()):
        console.print(f"{count:8,} {status} {route}")
    for route, status, body in found.broken[:LISTED]:
        console.print(f"{status} {route} {body[:2000]!r}", soft_wrap=True)
    return int(bool(found.broken))


if __name__ == "__main__":
    sys.exit(main())
