"""Two aircraft that fly straight on in BlueSky or minisky, and how fast they are simulated.

    python benchmarks/two_aircraft.py bluesky 0.05 60 5

A script of its own, as the peers need other versions of numpy: `simulators.py` runs it with their
Python. It prints simulated seconds per second of CPU time, one for each run, as a JSON list on the
last line: the peers print too.
"""

import json
import sys
from collections.abc import Callable
from pathlib import Path
from time import process_time

CREATE = ("CRE A1 A320 52.0 4.0 000 FL310 M0.72", "CRE A2 A320 52.5 4.0 045 FL310 M0.72")
"""An A320 each, level, on headings of their own."""
WARM_UP = 20
"""Steps before the clock starts."""


def bluesky(step: float) -> tuple[Callable[[], object], Callable[[], float]]:
    """BlueSky without network and displays, conflict detection off.

    Returns:
        what makes one step, and what says how many seconds are simulated.
    """
    import bluesky as bs
    from bluesky.core import simtime

    files = Path(sys.prefix, "bluesky-files")
    files.mkdir(exist_ok=True)
    bs.init(mode="sim", detached=True, workdir=files)
    for command in ("CDMETHOD OFF", *CREATE):
        bs.stack.stack(command)
    bs.sim.step()  # obeys
    simtime.setdt(step)
    bs.sim.op()
    bs.sim.step()
    check(bs.traf.ntraf, bs.sim.simdt, step)
    return bs.sim.step, lambda: bs.sim.simt


def minisky(step: float) -> tuple[Callable[[], object], Callable[[], float]]:
    """The same in minisky."""
    from minisky import MiniSky, MiniSkyConfig

    runtime = MiniSky(MiniSkyConfig())
    for command in ("CDMETHOD OFF", *CREATE):
        runtime.commands.stack(command)
    simulation = runtime.simulation
    simulation.step()
    simulation.simdt = step
    simulation.op()
    check(runtime.traffic.ntraf, simulation.simdt, step)
    return simulation.step, lambda: simulation.simt


def check(count: int, found: float, step: float) -> None:
    """Stop if it is not two aircraft that fly, or not by this step [s]."""
    if count != 2 or found != step:
        sys.exit(f"There are {count} aircraft with a step of {found} s, not 2 with {step} s.")


def main() -> None:
    """Simulate so many seconds, so many times."""
    name, step, seconds, runs = sys.argv[1:]
    advance, now = {"bluesky": bluesky, "minisky": minisky}[name](float(step))
    for _ in range(WARM_UP):
        advance()
    rates = []
    for _ in range(int(runs)):
        since, started = now(), process_time()
        for _ in range(round(float(seconds) / float(step))):
            advance()
        spent = process_time() - started
        rates.append((now() - since) / spent)
    sys.stdout.write(f"\n{json.dumps(rates)}\n")


if __name__ == "__main__":
    main()
