"""How many questions a second the network of branches answers, alone, and how near the bound.

python -m benchmarks.inference --count 200000

The bound is what matrices of 2,048 rows and columns reach on the same device in the same run, in
multiplications and additions a second: nothing made of such layers is faster. Words are not solved.
"""

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from time import perf_counter

import numpy as np
import torch
from rich.console import Console
from rich.table import Table

from benchmarks.options import positive
from relguide.kernels.networks.branch_scores import judge_branches
from relguide.kernels.words.branches import SIZE
from relguide.learn.words import inference
from relguide.learn.words.branch_network import BranchNetwork, features_of, load_network
from relguide.learn.words.inference import branch_shares
from relguide.planning.progress import progress_bar

REPEATS = 3
SQUARE = 2048
CHUNKS = (1024, 4096, 65_536)
HEADINGS = ("", "threads", "questions a second", "µs each", "of the bound")


@dataclass(frozen=True, slots=True, kw_only=True)
class Rate:
    """One way to ask, measured."""

    name: str
    threads: str
    seconds: float
    """Wall time of a question [s]."""
    bound: float | None
    """Share of what the device can multiply and add; `None` where that says nothing."""


def draw_situations(count: int) -> np.ndarray:
    """Situations even in the box, left of the route."""
    rng = np.random.default_rng(30)
    low, high = (-40.0, 0.0, 0.0, 0.3), (40.0, 40.0, 2.0 * pi, 0.97)
    return rng.uniform(low, high, (count, 4))


def measure(count: int) -> list[Rate]:
    """Ask so many questions in each way; with a bar."""
    network, situations = load_network(), draw_situations(count)
    ways = [("cpu", 1), ("cpu", torch.get_num_threads())]
    if torch.cuda.is_available():
        ways.append(("cuda", 1))
    rates: list[Rate] = []
    with progress_bar("Asking the network", total=2 + len(CHUNKS) * len(ways)) as done:
        few = situations[: max(count // 20, 1)]
        rates.append(_rate("fused kernel, words solved", "1", few, _kernel(network, few)))
        done(1)
        rates.append(_rate("features alone", "1", situations, lambda: features_of(situations)))
        done(1)
        for device, threads in ways:
            least = _operations(network) / _peak_rate(device, threads)
            for chunk in CHUNKS:
                ask = _torch(network, situations, device, threads, chunk)
                name = f"torch, {device}, {chunk:,} at once"
                rates.append(_rate(name, str(threads), situations, ask, least))
                done(1)
    return rates


def _operations(network: BranchNetwork) -> float:
    """Multiplications and additions of one question."""
    return 2.0 * sum(
        float(np.prod(weights.shape))
        for name, weights in network.layers._asdict().items()
        if not name.endswith("bias")
    )


def _peak_rate(device: str, threads: int) -> float:
    """Multiplications and additions a second of large matrices, float32."""
    before = torch.get_num_threads()
    torch.set_num_threads(threads)
    a = torch.randn(SQUARE, SQUARE, device=device)
    (a @ a).sum().item()
    best = min(_wall(lambda: (a @ a).sum().item()) for _ in range(REPEATS))
    torch.set_num_threads(before)
    return 2.0 * SQUARE**3 / best


def _kernel(network: BranchNetwork, situations: np.ndarray) -> Callable[[], object]:
    n = len(situations)
    scores, decoded = np.empty((n, 3, SIZE)), np.empty((n, 3))
    return lambda: judge_branches(
        situations, network.layers, network.least_share, network.most, scores, decoded
    )


def _torch(
    network: BranchNetwork, situations: np.ndarray, device: str, threads: int, chunk: int
) -> Callable[[], object]:
    def ask() -> None:
        name = "CUDA_CHUNK" if device == "cuda" else "CHUNK"
        before = getattr(inference, name)
        setattr(inference, name, chunk)
        try:
            branch_shares(network, situations, device=device, threads=threads)
        finally:
            setattr(inference, name, before)

    return ask


def _rate(
    name: str, threads: str, situations: np.ndarray, ask: Callable[[], object],
    least: float | None = None,
) -> Rate:  # fmt: skip
    ask()
    seconds = min(_wall(ask) for _ in range(REPEATS)) / len(situations)
    return Rate(
        name=name, threads=threads, seconds=seconds,
        bound=None if least is None else least / seconds,
    )  # fmt: skip


def _wall(call: Callable[[], object]) -> float:
    started = perf_counter()
    call()
    return perf_counter() - started


def table(rates: list[Rate]) -> Table:
    """What was measured, for people."""
    told = Table(title="The network of branches alone; wall time, the least of three")
    for heading in HEADINGS:
        told.add_column(heading, justify="right" if heading else "left")
    for rate in rates:
        told.add_row(
            rate.name, rate.threads, f"{1.0 / rate.seconds:,.0f}", f"{1e6 * rate.seconds:.2f}",
            "" if rate.bound is None else f"{rate.bound:.0%}",
        )  # fmt: skip
    return told


def main(arguments: list[str] | None = None) -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.inference", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--count", metavar="N", type=positive, default=200_000)
    Console(width=118).print(table(measure(parser.parse_args(arguments).count)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
