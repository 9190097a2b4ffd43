"""What `relguide dataset --method exact`, `train` and `audit` do: files, bars and tables."""

import argparse
import os
import sys
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter
from typing import Any, TypeVar

import numpy as np
import orjson

from relguide import __version__
from relguide.kernels.strategies import STRATEGIES
from relguide.learn.audit import (
    Audit,
    Group,
    Share,
    audit_as_json,
    audit_of,
    audit_request,
    judged,
    latencies,
)
from relguide.learn.labels import (
    SOURCES,
    LabelRequest,
    held_out,
    joined,
    make_labels,
    save_labels,
)
from relguide.learn.network import load_network
from relguide.learn.train import run, told
from relguide.progress import progress_bar, watched

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
    with _workers(threads, scheduler) as pool:
        labels = joined(_collected(make_labels(request, pool), request, "labelling"))
    seconds = perf_counter() - started
    provenance = {
        "program": f"relguide {__version__}",
        "method": "exact",
        "command": command,
        "made": datetime.now(UTC).isoformat(timespec="seconds"),
        "numpy": np.__version__,
    }
    save_labels(labels, request, provenance, file)
    counts = np.bincount(labels.best, minlength=len(STRATEGIES)).tolist()
    figures = {
        "file": str(file),
        "labels": len(labels),
        "sources": dict(
            zip(SOURCES, np.bincount(labels.sources, minlength=3).tolist(), strict=True)
        ),
        "fastest": dict(zip(STRATEGIES, counts, strict=True)),
        "held_out": {
            name: int(inside.sum()) for name, inside in held_out(labels.situations).items()
        },
        "made_s": seconds,
        "file_bytes": file.stat().st_size,
    }
    if as_json:
        _print_json(figures)
        return
    shares = ", ".join(
        f"{name} {100.0 * count / len(labels):.1f} %"
        for name, count in zip(STRATEGIES, counts, strict=True)
    )
    _write(
        f"{file}: {len(labels):,} situations with the exact time of each strategy, made in "
        f"{seconds:.1f} s; {file.stat().st_size / 1e6:.0f} MB.\nFastest: {shares}.\n"
    )


def train_network(chosen: argparse.Namespace) -> None:
    """Train a network, write it and print how good it is.

    Args:
        chosen: the options of `options.add_options`.
    """
    started = perf_counter()
    epochs = watched(
        run(chosen, f"relguide {__version__}"),
        title="training",
        total=chosen.epochs,
        done=lambda epoch: epoch.number,
        state=told,
    )
    trained = deque(epochs, maxlen=1)
    if not trained:  # resumed after its last epoch
        _write(f"{chosen.weights} is complete.\n")
        return
    last = trained[0]
    about = last.network.about
    _write(
        f"{chosen.weights}: the best of {last.number} epochs is the {last.best}., with "
        f"{100.0 * about['validation_accuracy']:.3f} % of the fastest strategies right in labels "
        f"not trained on,\nmost of them rare or next to a switching surface. "
        f"{perf_counter() - started:.0f} s on {about['device']}, "
        f"{chosen.weights.stat().st_size / 1e3:.0f} kB. relguide audit "
        f"{chosen.weights} says more.\n"
    )


def audit_network(
    file: Path | None,
    *,
    count: int,
    seed: int,
    threads: int | None,
    scheduler: str | None,
    as_json: bool,
) -> None:
    """Audit a network and print what is found.

    Args:
        file: its weights; those that come with the program if none is given.
        count: how many fresh situations to judge it in.
        seed: of them; not the training's.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to judge them on, as an address; this machine if none.
        as_json: one JSON object; a table otherwise.
    """
    network = load_network() if file is None else load_network(file)
    request = audit_request(network, count, seed)
    with _workers(threads, scheduler) as pool:
        audit = audit_of(_collected(judged(network, request, pool), request, "auditing"))
    asked = latencies(network, request)
    if as_json:
        about = {
            "situations": count,
            "seed": seed,
            "least_share": network.least_share,
            "network": network.about,
        }
        latency = {name: {"p50_us": low, "p99_us": high} for name, (low, high) in asked.items()}
        _print_json(about | audit_as_json(audit) | {"latency": latency})
        return
    _print_audit(audit)
    _write(
        "One query, median and 99th percentile: "
        + ", ".join(f"{name} {low:.1f} / {high:.1f} µs" for name, (low, high) in asked.items())
        + ".\n"
    )


@contextmanager
def _workers(threads: int | None, scheduler: str | None) -> Iterator[Executor]:
    """Where parts are made: this process's threads, or a Dask cluster."""
    if scheduler is None:
        with ThreadPoolExecutor(threads or os.cpu_count() or 1) as pool:
            yield pool
        return
    from relguide.cluster import cluster

    with cluster(scheduler, _note) as machines:
        yield machines


def _collected(chunks: Iterator[tuple[int, T]], request: LabelRequest, title: str) -> dict[int, T]:
    """Chunks by their number, with a bar."""
    found: dict[int, T] = {}
    with progress_bar(title, total=request.chunks) as count:
        for number, chunk in chunks:
            found[number] = chunk
            count(1.0)
    return found


def _print_audit(audit: Audit) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("situations", no_wrap=True)
    headings = ("number", "right, % (95 %)", "in 2", "set", "passed", "gap p99.9", "max, %")
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for group in audit.groups:
        table.add_row(*_row(group))
    table.add_section()
    for group in audit.classes:
        table.add_row(*_row(group))
    Console(width=100).print(table)


def _row(group: Group) -> tuple[str, ...]:
    first, second, _ = group.tops
    low, high = first.interval
    return (
        group.name,
        f"{group.size:,}",
        f"{_percent(first)} ({100.0 * low:.2f}–{100.0 * high:.2f})",
        _percent(second),
        f"{group.mean_set:.2f}",
        _percent(group.fallbacks),
        f"{100.0 * group.gaps[-2]:.2g}",
        f"{100.0 * group.gaps[-1]:.2g}",
    )


def _percent(share: Share) -> str:
    return f"{100.0 * share.hits / share.of:.2f}" if share.of else "–"


def _print_json(content: dict[str, Any]) -> None:
    _write(orjson.dumps(content, option=orjson.OPT_INDENT_2).decode() + "\n")


def _note(sentence: str) -> None:
    sys.stderr.write(f"relguide: {sentence}\n")
    sys.stderr.flush()


def _write(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()
