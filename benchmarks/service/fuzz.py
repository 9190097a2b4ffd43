"""Does every valid situation get its answer from the service in time, and never below d_min?

    python -m benchmarks.service.fuzz --count 100000 --seed 1

draws situations as `benchmarks.deadline` does, from all that is accepted, the slowest kinds most
often, and posts them with the default budget of 250 ms. Each answer must come within 300 ms; on a
machine with other work what is late is asked up to five times, alone, and the quickest counts. Each
plan must keep the minimum separation, to a millionth of the turn radius as plans are certified: it
is flown again here, by sampling its segments as they came over the wire, beside the leader as it
was declared. The ten that took longest are listed as JSON.
"""

import argparse
import asyncio
import json
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians, sin
from time import perf_counter
from typing import Any

import numpy as np
import uvloop
from rich.console import Console

from benchmarks.deadline import draw
from benchmarks.options import positive
from benchmarks.service.load import request
from benchmarks.service.service import running
from benchmarks.service.situations import body_of
from relguide.contract.bodies import situation_from_json
from relguide.kernels.separation.clearance import SLACK

LATEST = 0.3
"""An answer later than this is late [s]."""
ASKED = 5
"""How often what is late is asked."""
LISTED = 10
ROUNDED = 0.01
"""By so much more than is certified may a sample be below d_min [m]: degrees are radians again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """What came back for one situation."""

    seconds: float
    status: int
    outcome: str
    below: float
    """How far below d_min its plan comes at most; 0 if it keeps it, or there is none [m]."""
    body: dict[str, Any]


Reply = tuple[bytes, int, float, dict[str, Any]]
"""What came, its status, how long it took [s], and what was asked."""


def main(arguments: list[str] | None = None) -> int:
    """Draw, post and report; 1 if an answer was late, wrong or no answer."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--count", type=positive, default=2000, help="how many situations")
    parser.add_argument("--seed", type=positive, default=1)
    parser.add_argument("--connections", type=positive, default=4)
    given = parser.parse_args(arguments)
    bodies = (body_of(draw(np.random.default_rng([given.seed, k]))) for k in range(given.count))
    with running(record_plans=0) as service:
        replies = uvloop.run(_ask_all(service.port, bodies, given.connections))
        late = [reply for reply in replies if reply[2] > LATEST]
        for reply in late:
            again = [reply[3]] * (ASKED - 1)
            found = uvloop.run(_ask_all(service.port, iter(again), 1))
            replies[replies.index(reply)] = min(reply, *found, key=lambda one: one[2])
    sys.stdout.write(f"{len(late)} of them were late at first.\n")
    return report([_judge(*reply) for reply in replies])


async def _ask_all(port: int, bodies: Iterator[dict[str, Any]], connections: int) -> list[Reply]:
    replies: list[Reply] = []

    async def ask() -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        for body in bodies:
            wanted = request("POST", "/api/v1/plans", json.dumps(body).encode())
            began = perf_counter()
            writer.write(wanted)
            head = (await reader.readuntil(b"\r\n\r\n")).lower()
            size = int(head.partition(b"content-length:")[2].partition(b"\r\n")[0])
            came = await reader.readexactly(size)
            replies.append((came, int(head[9:12]), perf_counter() - began, body))
        writer.close()

    await asyncio.gather(*(ask() for _ in range(connections)))
    return replies


def _judge(came: bytes, status: int, seconds: float, body: dict[str, Any]) -> Answer:
    reply = json.loads(came)
    outcome = reply.get("reason") or reply.get("optimality", {}).get("proof", "problem")
    below = below_limit(reply, body) if reply.get("status") == "planned" else 0.0
    return Answer(seconds=seconds, status=status, outcome=outcome, below=below, body=body)


def below_limit(reply: dict[str, Any], body: dict[str, Any]) -> float:
    """How far below d_min the turns and straights of a plan come, sampled at most a second apart.

    Boundary arcs slide along d_min by definition; of them the points that draw them are taken.
    """
    situation, _ = situation_from_json(json.dumps(body))
    leading = situation.leader.trajectory
    wind = situation.wind
    least = np.inf
    for segment in reply["segments"]:
        start = segment["start"]
        if segment["kind"] == "boundary":
            points = [start, *segment["via"], segment["end"]]
            times = np.array([point["t_s"] for point in points])
            x = np.array([point["x_m"] for point in points]) - wind.east * times
            y = np.array([point["y_m"] for point in points]) - wind.north * times
        else:
            count = min(int(segment["duration_s"]) + 2, 2000)
            flown = np.linspace(0.0, segment["duration_s"], count)
            times = start["t_s"] + flown
            x, y = _fly(segment, flown, situation.pursuer.tas)
            x += start["x_m"] - wind.east * start["t_s"]
            y += start["y_m"] - wind.north * start["t_s"]
        there = leading.sample(times)
        least = min(least, float(np.hypot(x - there.x, y - there.y).min()))
    slack = SLACK * situation.pursuer.turn_radius + ROUNDED
    return max(situation.min_separation - slack - least, 0.0)


def _fly(
    segment: dict[str, Any], flown: np.ndarray[Any, Any], tas: float
) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Where a turn or a straight leads in the air mass, from its start [m]."""
    heading = radians(segment["start"]["heading_deg"])
    if segment["kind"] == "straight":
        return tas * flown * sin(heading), tas * flown * cos(heading)
    rate = tas / segment["radius_m"] * (1.0 if segment["direction"] == "right" else -1.0)
    radius = tas / rate
    turned = heading + rate * flown
    return radius * (cos(heading) - np.cos(turned)), radius * (np.sin(turned) - sin(heading))


def report(answers: list[Answer]) -> int:
    """Print how long they took, and the slowest; 1 if one was late, wrong or no answer."""
    console = Console(width=118)
    times = np.array([answer.seconds for answer in answers]) * 1e3
    late = int(np.count_nonzero(times > 1e3 * LATEST))
    wrong = [answer for answer in answers if answer.below > 0.0]
    refused = [answer for answer in answers if answer.status != 200]
    console.print(
        f"{len(answers):,} situations: median {np.median(times):.2f} ms, 99 % "
        f"{np.percentile(times, 99):.1f} ms, worst {times.max():.1f} ms; {late} later than "
        f"{1e3 * LATEST:.0f} ms; {len(wrong)} below d_min; {len(refused)} not answered by 200"
    )
    outcomes = Counter(answer.outcome for answer in answers)
    console.print(", ".join(f"{count} {name}" for name, count in outcomes.most_common()))
    slowest = sorted(answers, key=lambda one: -one.seconds)[:LISTED]
    for answer in [*wrong[:LISTED], *refused[:LISTED], *slowest]:
        console.print(
            f"{1e3 * answer.seconds:8.1f} ms {answer.status} {answer.outcome} "
            f"{answer.below:.2f} m below  {json.dumps(answer.body)}",
            soft_wrap=True,
        )
    return int(bool(late or wrong or refused))


if __name__ == "__main__":
    sys.exit(main())
