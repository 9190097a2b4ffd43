"""How much better is the search with the limit when it looks a hundred times harder?

    python -m tests.bench.limit --count 200 --effort 100

draws situations in which the separation limit is active, half of them with R < d_min.
It searches each as the library does and again with the disc scanned that many times as finely, and
prints what is worse by more than 0.1 s, and the times it took.
"""

import argparse
import sys
from math import inf
from time import thread_time

import numpy as np
from rich.console import Console
from rich.progress import track

from relguide import Situation, certify
from relguide.planning.words import candidates
from tests.relguide.planning.test_detour import drawn, searched


def active(rng: np.random.Generator, *, tight: bool) -> Situation:
    """A situation whose fastest way without the limit breaks it."""
    while True:
        situation = drawn(rng, tight=tight)
        first = next(iter(candidates(situation)), None)
        if first is not None and not certify(first.trajectory, situation).holds:
            return situation


def main() -> None:
    """Run the comparison and print it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--effort", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    losses, times, worst = [], [], []
    rounds = range(arguments.count)
    for i in track(rounds, "Looking harder", console=Console(file=sys.stderr)):
        situation = active(rng, tight=i % 2 == 0)
        started = thread_time()
        ours = searched(situation)
        times.append(thread_time() - started)
        harder = searched(situation, arguments.effort)
        loss = 0.0 if ours == harder else ours - harder
        losses.append(loss)
        if loss > 0.1:
            worst.append((loss, situation))
    none = sum(loss == inf for loss in losses)
    print(f"{arguments.count} active situations, half of them with R < d_min")
    print(f"worse by more than 0.1 s than {arguments.effort} times the effort: {len(worst)}")
    print(f"found nothing where the harder look did: {none}")
    median, high = np.percentile(np.array(times) * 1e3, [50, 99])
    print(f"CPU time of one search: median {median:.1f} ms, 99 % {high:.1f} ms")
    for loss, situation in sorted(worst, key=lambda pair: -pair[0]):
        print(f"{loss:8.2f} s  {situation}")


if __name__ == "__main__":
    main()
