"""What does `wrk` say of plans beside `/healthz`? It is Debian's package of that name.

    python -m benchmarks.service.wrk --seconds 5 --rounds 3
    python -m benchmarks.service.wrk --flights 10 --watchers 50

Each is asked on 16 connections of one thread, in turn; what is printed is the median of the rounds.
Where wrk is not installed, `benchmarks.service.speed` does the same with a program of its own.
"""

import argparse
import asyncio
import json
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from relguide_server.planning.plans import EXAMPLE
from rich.console import Console
from rich.table import Table

from benchmarks.options import positive
from benchmarks.service.service import Service, running
from benchmarks.service.situations import STRAIGHT
from benchmarks.service.speed import PLANS, say_ticks, watching

MISSING = "wrk is not installed: apt-get install wrk, or run python -m benchmarks.service.speed."
BODIES = {"straight leader": STRAIGHT, "turning leader": EXAMPLE}
SCRIPT = """wrk.method = "POST"
wrk.body = [==[{body}]==]
wrk.headers["Content-Type"] = "application/json"
"""
UNITS = {"us": 1e-3, "ms": 1.0, "s": 1e3}
"""Milliseconds of each unit that wrk writes."""


@dataclass(frozen=True, slots=True)
class Measured:
    """What wrk printed."""

    rate: float
    """Answers a second [1/s]."""
    p50: float
    """[ms]."""
    p99: float
    """[ms]."""
    wrong: str
    """What it says of answers that were not what was asked for; empty if all were."""


def main(arguments: list[str] | None = None) -> int:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--seconds", type=positive, default=5, help="of each measurement")
    parser.add_argument("--rounds", type=positive, default=3)
    parser.add_argument("--flights", type=int, default=0, help="in the air meanwhile")
    parser.add_argument("--watchers", type=int, default=0, help="of their streams, in all")
    given = parser.parse_args(arguments)
    if shutil.which("wrk") is None:
        parser.error(MISSING)
    with running() as service, TemporaryDirectory() as folder:
        return asyncio.run(_measure(service, given, Path(folder)))


async def _measure(service: Service, given: argparse.Namespace, folder: Path) -> int:
    asked: dict[str, list[str]] = {"GET /healthz": ["/healthz"]}
    for name, body in BODIES.items():
        script = folder / f"{name}.lua"
        script.write_text(SCRIPT.format(body=json.dumps(body)))
        asked[f"POST /plans, {name}"] = [PLANS, "-s", str(script)]
    console = Console(width=110)
    rounds: dict[str, list[Measured]] = {name: [] for name in asked}
    async with watching(service, flights=given.flights, watchers=given.watchers) as ticks:
        counted, began = sum(ticks), perf_counter()
        for _ in range(given.rounds):
            for name, (path, *options) in asked.items():
                found = await asyncio.to_thread(ask, service.port, path, options, given.seconds)
                rounds[name].append(found)
        if ticks:
            spent = perf_counter() - began
            console.print(say_ticks(given.flights, ticks, sum(ticks) - counted, spent))
    console.print(table(rounds))
    return 1 if any(run.wrong for runs in rounds.values() for run in runs) else 0


def ask(port: int, path: str, options: list[str], seconds: int) -> Measured:
    """Let wrk ask for a while."""
    command = ["wrk", "-t", "1", "-c", "16", "-d", f"{seconds}s", "--latency", *options]
    done = subprocess.run(
        [*command, f"http://127.0.0.1:{port}{path}"], check=True, capture_output=True, text=True
    )
    return read(done.stdout)


def read(text: str) -> Measured:
    """What wrk printed, as numbers.

    Raises:
        ValueError: if something is missing.
    """
    rate = re.search(r"^Requests/sec:\s+([\d.]+)", text, re.MULTILINE)
    shares = {
        share: float(value) * UNITS[unit]
        for share, value, unit in re.findall(
            r"^\s+(50|99)%\s+([\d.]+)(us|ms|s)$", text, re.MULTILINE
        )
    }
    if rate is None or len(shares) < 2:
        raise ValueError(f"This is not what wrk prints:\n{text}")
    wrong = re.search(r"^\s+(Non-2xx.*|Socket errors.*)$", text, re.MULTILINE)
    return Measured(float(rate[1]), shares["50"], shares["99"], wrong[1] if wrong else "")


def table(rounds: dict[str, list[Measured]]) -> Table:
    """What was measured, for people."""
    drawn = Table()
    for heading in ("", "a second", "of /healthz", "p50", "p99", "wrong"):
        drawn.add_column(heading, justify="right" if heading else "left")
    first = next(iter(rounds.values()))
    for name, runs in rounds.items():
        ratios = [run.rate / base.rate for run, base in zip(runs, first, strict=True)]
        drawn.add_row(
            name,
            f"{median(run.rate for run in runs):,.0f}",
            f"{median(ratios):.2f}",
            f"{median(run.p50 for run in runs):.1f} ms",
            f"{median(run.p99 for run in runs):.1f} ms",
            "; ".join({run.wrong for run in runs if run.wrong}),
        )
    return drawn


if __name__ == "__main__":
    sys.exit(main())
