"""How long a convergence area of 160 × 120 nodes takes: `python -m benchmarks.areas`.

Times at the nodes, lines, regions, their wire form, and the whole, exactly and by network, on one
thread and on two; the least of some runs, since a machine is never quiet. CPU time counts all
threads. On two the whole takes less than its parts: lines and regions are drawn side by side.
"""

import argparse
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter, process_time

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from benchmarks.options import positive
from relguide import RIGHT, FlyStraight, Leader, Pursuer, Situation, TurnTo, Wind
from relguide.contract.area_bodies import area_to_wire
from relguide.contract.places import Unanchored
from relguide.learn.words.area_words import area_words
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.maps.contours import contours, regions
from relguide.maps.isochrones import (
    NAMES,
    Isochrones,
    grid_around,
    isochrones,
    round_levels,
    times_around,
)
from relguide.units import DEG

STRAIGHT = Situation(
    pursuer=Pursuer(x=-40e3, y=40e3, heading=100 * DEG, tas=240.0, max_bank=25 * DEG),
    leader=Leader(x=3e3, y=-2e3, heading=60 * DEG, tas=200.0),
    slot_distance=12e3,
    min_separation=9260.0,
    wind=Wind(east=20.0, north=-8.0),
)
INTENT = (FlyStraight(duration=60.0), TurnTo(heading=150 * DEG, turn=RIGHT, bank=20 * DEG))
SITUATIONS = {
    "straight": STRAIGHT,
    "turning": replace(STRAIGHT, leader=replace(STRAIGHT.leader, intent=INTENT)),
}
"""By what the leader does. The limit binds at 1,177 and 1,623 of the 19,200 nodes."""
Parts = dict[str, Callable[[], object]]


def main(arguments: list[str] | None = None) -> int:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.areas", description=__doc__)
    parser.add_argument("--runs", type=positive, default=15, metavar="N", help="of each (15)")
    runs = parser.parse_args(arguments).runs
    network = load_network()
    cases = [
        (name, planner, threads, part, call)
        for name, situation in SITUATIONS.items()
        for planner in ("exact", "network")
        for threads in (1, 2)
        for part, call in parts(situation, network if planner == "network" else None, threads)
        .items()
    ]  # fmt: skip
    table = Table(title="An area of 160 × 120 nodes")
    for heading in ("leader", "planner", "threads", "part"):
        table.add_column(heading)
    for heading in ("wall [ms]", "CPU [ms]"):
        table.add_column(heading, justify="right")
    console = Console()
    for *names, call in track(cases, "Areas", console=Console(stderr=True), transient=True):
        wall, cpu = least(call, runs)
        table.add_row(*map(str, names), f"{wall:.1f}", f"{cpu:.1f}")
    console.print(table)
    return 0


def parts(situation: Situation, network: BranchNetwork | None, threads: int) -> Parts:
    """What is measured of a situation, by name."""
    grid = grid_around(situation)
    x, y = grid.axes
    places = [axis.ravel() for axis in np.meshgrid(x, y)]

    def times() -> Callable:
        words = None if network is None else area_words(network, situation, grid)
        return times_around(situation, threads=threads, words=words)

    evaluate = times()
    field = evaluate(*places)
    levels = round_levels(field)
    area = isochrones(situation, grid, evaluate=evaluate)

    def wire(made: Isochrones) -> object:
        return area_to_wire(made, situation, Unanchored(), exact=False, times=False)

    return {
        "times": lambda: times()(*places),
        "lines": partial(contours, field, x, y, levels, evaluate),
        "regions": partial(regions, field, x, y, NAMES, evaluate),
        "as JSON objects": partial(wire, area),
        "whole": lambda: wire(isochrones(situation, grid, evaluate=times(), threads=threads)),
    }


def least(call: Callable[[], object], runs: int) -> tuple[float, float]:
    """Wall and CPU time of a call, each the least of some runs [ms]."""
    walls, cpus = [], []
    for _ in range(runs):
        wall, cpu = perf_counter(), process_time()
        call()
        walls.append(perf_counter() - wall)
        cpus.append(process_time() - cpu)
    return 1e3 * min(walls), 1e3 * min(cpus)


if __name__ == "__main__":
    sys.exit(main())
