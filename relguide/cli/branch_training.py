"""What `relguide dataset --method exact` and `train` do: files, bars and tables."""

import argparse
import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import TypeVar

import numpy as np

from relguide.cli.output import PROGRAM, provenance, say, write, write_json
from relguide.kernels.words.branches import BRANCHES
from relguide.learn.training.fitting import Epoch, told
from relguide.learn.training.options import command_of, options_of
from relguide.learn.tree.regular_network import save_regular
from relguide.learn.tree.train_regular import train_regular
from relguide.learn.tree.tree_file import load_tree
from relguide.learn.words.branch_labels import (
    SOURCES,
    LabelRequest,
    held_out,
    joined,
    make_labels,
    save_labels,
)
from relguide.learn.words.train_branches import run
from relguide.planning.progress import progress_bar, watched

T = TypeVar("T")


def make_label_file(
    request: LabelRequest,
    file: Path,
    *,
    threads: int | None,
    scheduler: str | None,
    command: str,
    as_json: bool,
) -> None:
    """Make labels, write them and print what they are.

    Args:
        request: what to make.
        file: where to.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to make them on, as an address; this machine if none.
        command: what was typed, for the file's provenance.
        as_json: one JSON object; sentences otherwise.
    """
    file.parent.stat()  # nothing is made that could not be written
    started = perf_counter()
    with workers(threads, scheduler) as pool:
        labels = joined(collected(make_labels(request, pool), request, "labelling"))
    seconds = perf_counter() - started
    save_labels(labels, request, provenance("exact", command=command), file)
    counts = np.bincount(labels.best, minlength=len(BRANCHES)).tolist()
    figures = {
        "file": str(file),
        "labels": len(labels),
        "sources": dict(
            zip(SOURCES, np.bincount(labels.sources, minlength=len(SOURCES)).tolist(), strict=True)
        ),
        "fastest": dict(zip(BRANCHES, counts, strict=True)),
        "held_out": {
            name: int(inside.sum()) for name, inside in held_out(labels.situations).items()
        },
        "made_s": seconds,
        "file_bytes": file.stat().st_size,
    }
    if as_json:
        write_json(figures)
        return
    shares = ", ".join(
        f"{name} {100.0 * count / len(labels):.1f} %"
        for name, count in zip(BRANCHES, counts, strict=True)
    )
    write(
        f"{file}: {len(labels):,} situations with the exact time of each branch, made in "
        f"{seconds:.1f} s; {file.stat().st_size / 1e6:.0f} MB.\nFastest: {shares}.\n"
    )


def train_network(chosen: argparse.Namespace) -> None:
    """Train a network, write it and print how good it is.

    Args:
        chosen: the options of `options.add_options`.
    """
    started = perf_counter()
    last = last_epoch(chosen, run(chosen, PROGRAM))
    if last is None:
        return
    about = last.network.about
    write(
        f"{chosen.weights}: the best of {last.number} epochs is the {last.best}., with "
        f"{100.0 * about['validation_accuracy']:.3f} % of the fastest branches right in labels "
        f"not trained on,\nmost of them rare or next to a switching surface. "
        f"{perf_counter() - started:.0f} s on {about['device']}, "
        f"{chosen.weights.stat().st_size / 1e3:.0f} kB. relguide audit "
        f"{chosen.weights} says more.\n"
    )


def train_regular_network(chosen: argparse.Namespace) -> None:
    """Train the paper's network, or the one of exact answers, on a tree, and write it.

    Args:
        chosen: the options of `options.add_options`, a tree's file for the labels', and the method.
    """
    if chosen.resume:
        raise ValueError("Such a network is trained in a minute, and nothing is left to resume.")
    tree = load_tree(chosen.labels)
    chosen.weights.parent.stat()  # nothing is trained that could not be written
    started = perf_counter()
    about = {
        "program": PROGRAM,
        "command": f"{command_of(chosen)} --method {chosen.method}",
        "tree": dict(tree.provenance),
    }
    epochs = watched(
        train_regular(tree, options_of(chosen), method=chosen.method, about=about),
        title="training",
        total=chosen.epochs,
        done=lambda epoch: epoch.number,
        state=lambda epoch: f"misses {100.0 * epoch.loss:.1f} % of the variance",
    )
    last = deque(epochs, maxlen=1)[0]
    save_regular(last.network, chosen.weights)
    write(
        f"{chosen.weights}: after {last.number} epochs it misses {100.0 * last.loss:.1f} % of the "
        f"variance of (ε, θ, l) in states not trained on.\n"
        f"{perf_counter() - started:.0f} s on {last.network.about['device']}, "
        f"{chosen.weights.stat().st_size / 1e3:.0f} kB. relguide audit says what it is worth.\n"
    )


@contextmanager
def workers(threads: int | None, scheduler: str | None) -> Iterator[Executor]:
    """Where parts are made: this process's threads, or a Dask cluster.

    Args:
        threads: how many; all cores if none is given.
        scheduler: of the cluster, as an address.
    """
    if scheduler is None:
        with ThreadPoolExecutor(threads or os.cpu_count() or 1) as pool:
            yield pool
        return
    from relguide.cli.cluster import cluster

    with cluster(scheduler, say) as machines:
        yield machines


def last_epoch(chosen: argparse.Namespace, epochs: Iterator[Epoch[T]]) -> Epoch[T] | None:
    """Train to the end, with a bar; `None`, and a word, if it was resumed after its last epoch.

    Args:
        chosen: the options of `options.add_options`.
        epochs: as they come.
    """
    shown = watched(
        epochs,
        title="training",
        total=chosen.epochs,
        done=lambda epoch: epoch.number,
        state=told,
    )
    trained = deque(shown, maxlen=1)
    if not trained:
        write(f"{chosen.weights} is complete.\n")
        return None
    return trained[0]


def collected(chunks: Iterator[tuple[int, T]], request: LabelRequest, title: str) -> dict[int, T]:
    """Chunks by their number, with a bar."""
    found: dict[int, T] = {}
    with progress_bar(title, total=request.chunks) as count:
        for number, chunk in chunks:
            found[number] = chunk
            count(1.0)
    return found
