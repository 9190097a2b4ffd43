"""What `dataset --method templates` and `train --method templates` do: files, bars and tables."""

import argparse
from pathlib import Path
from time import perf_counter

import numpy as np

from relguide.cli.branch_training import last_epoch, workers
from relguide.cli.output import PROGRAM, provenance, write, write_json
from relguide.kernels.networks.templates import NONE, TEMPLATES
from relguide.learn.boundary.template_label_file import grown_labels, save_limit_labels
from relguide.learn.boundary.template_labels import SOURCES, LimitLabels, LimitRequest, joined
from relguide.learn.boundary.train_templates import run, taught
from relguide.planning.progress import progress_bar


def make_limit_label_file(
    request: LimitRequest,
    file: Path,
    *,
    resume: bool,
    threads: int | None,
    scheduler: str | None,
    command: str,
    as_json: bool,
) -> None:
    """Make labels where the limit binds, write them and print what they are.

    Args:
        request: what to make.
        file: where to; beside it, until all is made, `.part`.
        resume: go on from the `.part` that a stopped run left.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to make them on, as an address; this machine if none.
        command: what was typed, for the file's provenance.
        as_json: one JSON object; sentences otherwise.
    """
    file.parent.stat()  # nothing is made that could not be written
    part = file.with_name(f"{file.name}.part")
    started = perf_counter()
    chunks: dict[int, LimitLabels] = {}
    with (
        workers(threads, scheduler) as pool,
        progress_bar("labelling", total=request.chunks) as count,
    ):
        for number, chunk in grown_labels(request, part, pool, resume=resume):
            chunks[number] = chunk
            count(1.0)
    labels = joined(chunks)
    seconds = perf_counter() - started
    save_limit_labels(labels, request, provenance("templates", command=command), file)
    part.unlink()
    kinds, _ = taught(labels.ways)
    counts = np.bincount(kinds, minlength=len(TEMPLATES)).tolist()
    sources = np.bincount(labels.sources, minlength=len(SOURCES)).tolist()
    if as_json:
        figures = {
            "file": str(file),
            "labels": len(labels),
            "sources": dict(zip(SOURCES, sources, strict=True)),
            "fastest": dict(zip(TEMPLATES, counts, strict=True)),
            "made_s": seconds,
            "file_bytes": file.stat().st_size,
        }
        write_json(figures)
        return
    there = len(labels) - counts[NONE]
    order = np.argsort(counts)[::-1].tolist()
    commonest = [kind for kind in order if kind != NONE][:6]
    shares = ", ".join(
        f"{TEMPLATES[kind]} {100.0 * counts[kind] / there:.1f} %" for kind in commonest
    )
    write(
        f"{file}: {len(labels):,} situations in which the limit binds, {there:,} of them with a "
        f"way, made in {seconds:.0f} s; {file.stat().st_size / 1e6:.0f} MB.\n"
        f"Fastest: {shares}; {sum(n > 0 for n in counts)} kinds in all.\n"
    )


def train_template_network(chosen: argparse.Namespace) -> None:
    """Train a network of ways round the limit, write it and print how good it is.

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
        f"{100.0 * about['validation_accuracy']:.2f} % of the kinds of ways right in labels not "
        f"trained on. {perf_counter() - started:.0f} s on {about['device']}, "
        f"{chosen.weights.stat().st_size / 1e3:.0f} kB.\n"
    )
