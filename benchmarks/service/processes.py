"""How many flights does a process fly in time, and how many do two?

    python -m benchmarks.service.processes --seconds 30 1x100 1x200 2x400

For each pair, of processes and flights in all: the flights fly `fig_6b` at a rate of 1, engaged and
on record. `rate` is the flight time flown of that asked for, `ticks` what each of ten watchers a
process gets a second, `processor` what each process takes of one core.
"""

import argparse
import asyncio
import re
import sys
from contextlib import AsyncExitStack
from statistics import mean, median
from time import perf_counter
from urllib.request import urlopen

import uvloop
from rich.console import Console

from benchmarks.options import positive
from benchmarks.service.service import Service, running
from benchmarks.service.speed import watching

WATCHERS = 10
"""Streams that are watched in each process."""
SETTLING = 10.0
"""Before it is measured [s]: flights that have just begun plan more."""


def main(arguments: list[str] | None = None) -> int:
    """Measure and print lines of CSV."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=positive, default=30, help="of each measurement")
    parser.add_argument("pairs", nargs="+", metavar="PROCESSESxFLIGHTS")
    given = parser.parse_args(arguments)
    console = Console(width=110)
    console.print("processes,flights,rate,ticks a second,processor each,memory each")
    for pair in given.pairs:
        processes, flights = (positive(count) for count in pair.split("x"))
        figures = uvloop.run(measure(processes, flights, given.seconds))
        console.print(",".join((str(processes), str(flights), *figures)))
    return 0


async def measure(processes: int, flights: int, lasting: int) -> list[str]:
    """The figures of a row."""
    each = flights // processes
    async with AsyncExitStack() as stack:
        services = [
            stack.enter_context(running(process="abcdef"[k], max_flights=4 * each, workers=0))
            for k in range(processes)
        ]
        ticks = [
            await stack.enter_async_context(watching(one, flights=each, watchers=WATCHERS))
            for one in services
        ]
        await asyncio.sleep(SETTLING)
        began, before = perf_counter(), [_figures(one) for one in services]
        counted = [[*heard] for heard in ticks]
        await asyncio.sleep(lasting)
        seconds, after = perf_counter() - began, [_figures(one) for one in services]
        passed = [new - old for all_new, all_old in zip(ticks, counted, strict=True)
                  for new, old in zip(all_new, all_old, strict=True)]  # fmt: skip
    spent, flown, asked = (
        [new[k] - old[k] for new, old in zip(after, before, strict=True)] for k in range(3)
    )
    return [
        f"{sum(flown) / sum(asked):.2f}",
        f"{median(passed) / seconds:.1f}",
        f"{mean(spent) / seconds:.2f}",
        f"{mean(figures[3] for figures in after):.0f} MB",
    ]


def _figures(service: Service) -> tuple[float, float, float, float]:
    """Processor time [s], flight time flown and asked for [s], and memory [MB]."""
    with urlopen(f"http://127.0.0.1:{service.port}/metrics", timeout=60.0) as answer:
        text = answer.read().decode()
    flown, asked = (
        float(re.findall(rf"^{name}_total (\S+)$", text, re.MULTILINE)[0])
        for name in ("relguide_flight_seconds", "relguide_flight_seconds_asked")
    )
    with open(f"/proc/{service.process.pid}/status") as file:
        (kilobytes,) = re.findall(r"^VmRSS:\s+(\d+) kB$", file.read(), re.MULTILINE)
    return service.processor_time(), flown, asked, int(kilobytes) / 1e3


if __name__ == "__main__":
    sys.exit(main())
