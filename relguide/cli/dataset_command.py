"""`relguide dataset`: a tree of regular trajectories, or situations with their exact answers."""

import argparse
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, add_form, for_people, provenance, write, write_json
from relguide.cli.shared_options import add_tree, add_workers, count, tree_parameters

if TYPE_CHECKING:
    from relguide.learn.tree.tree import Losses

PURPOSE = "make a data set to learn from"
EXAMPLES = """
    relguide dataset --method reverse-dp --out tree.npz             the paper's tree
    relguide dataset --method reverse-dp --order 5 --out tree.npz   with four pairs
    relguide dataset --method reverse-dp --out tree.npz --resume    go on after a stop
    relguide dataset --method exact --count 1200000 --out labels.npz    for relguide train
    relguide dataset --method exact --out labels.npz --dask tcp://host:8786   many machines
    relguide dataset --method templates --count 400000 --out templates.npz
                                                       for relguide train --method templates
    """
METHODS = ("reverse-dp", "exact", "templates")
"""How a data set is made."""
LABELS, PATH_LABELS = 1_200_000, 400_000
"""How many labels are made: one to two minutes, and half an hour to an hour."""
WITHIN = (0.0, 0.001, 0.01, 0.05)
"""Losses that the audit of a tree counts the states within."""
ROUNDING = 1e-9
"""Smaller losses are rounding."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide dataset`."""
    parser.add_argument(
        "--method",
        choices=METHODS,
        required=True,
        help="reverse-dp: the tree of Fig. 3; exact: situations with the exact time of each word; "
        "templates: situations in which d_min binds, each with the fastest constrained path",
    )
    parser.add_argument(
        "--out", metavar="FILE.npz", type=_npz, required=True, help="where to write it"
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="reverse-dp, templates: go on from FILE.npz.part, which a stopped run leaves; the "
        "result is the same",
    )
    add_workers(parser)
    parser.add_argument(
        "--audit",
        metavar="N",
        type=count,
        default=2000,
        help="reverse-dp: how many of its states to compare with the exact planner; "
        "default: %(default)s",
    )
    parser.add_argument(
        "--count",
        metavar="N",
        type=count,
        help=f"exact: how many situations, default: {LABELS}; templates: {PATH_LABELS}",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=count,
        default=7,
        help="exact, templates: of the situations; default: %(default)s",
    )
    parser.add_argument(
        "--loops",
        metavar="SHARE",
        type=float,
        default=0.0,
        help="exact: this share more, of situations that closed loops meet, e.g. 0.02; "
        "default: none",
    )
    add_form(parser)
    add_tree(parser)


def run(chosen: argparse.Namespace) -> int:
    """Make the data set, write it and print what it is."""
    if chosen.method == "exact":
        _make_labels(chosen)
    elif chosen.method == "templates":
        _make_path_labels(chosen)
    else:
        _make_tree(chosen)
    return DONE


def _make_tree(chosen: argparse.Namespace) -> None:
    import numpy as np

    from relguide.cli.tree_growth import compare_states, grow_on, load_kernels, load_part
    from relguide.learn.training.files import expect_part
    from relguide.learn.tree.reverse_dp import plant, tree_from
    from relguide.learn.tree.tree import parameters_as_json
    from relguide.learn.tree.tree_file import save_growth, save_tree

    if chosen.dask is not None:
        raise ValueError(
            "A tree is grown on one machine: --dask is for --method exact and templates."
        )
    parameters, file, threads = tree_parameters(chosen), chosen.out, chosen.threads or None
    part = file.with_name(f"{file.name}.part")
    expect_part(part, resume=chosen.resume)
    growth = load_part(parameters, part) if chosen.resume else plant(parameters)
    save_growth(growth, part)  # also shows at once if the file cannot be written
    load_kernels(parameters)
    laid_before, started = growth.laid, perf_counter()
    growth = grow_on(growth, threads=threads, part=part)
    seconds, laid = perf_counter() - started, growth.laid - laid_before
    tree = tree_from(growth, provenance("reverse-dp"))
    save_tree(tree, file)
    part.unlink()
    found = compare_states(tree, chosen.audit, threads=threads)
    figures = {
        "file": str(file),
        "parameters": parameters_as_json(parameters),
        "states": len(tree.minima),
        "trajectories": tree.laid,
        "too_close": tree.close,
        "grown_s": seconds,
        "trajectories_per_s": laid / seconds,
        "file_bytes": file.stat().st_size,
        "memory_bound_bytes": int(parameters.memory_bound),
    }
    if found is not None:
        figures["audit"] = {
            "states": len(found.nodes),
            **{
                f"share_within_{w * 100:g}_percent": found.share_within(w or ROUNDING)
                for w in WITHIN
            },
            "worst_loss_percent": 100.0 * float(found.loss.max()),
            "missed_by_exact": int(np.sum(np.isinf(found.exact))),
        }
    if not for_people(chosen):
        write_json(figures)
        return
    write(
        f"{file}: the best paths from {len(tree.minima):,} cells, of {tree.laid:,} trajectories "
        f"of order {parameters.order} or less,\n"
        f"laid back in {seconds:.1f} s ({laid / seconds / 1e6:.0f} million a second); "
        f"{file.stat().st_size / 1e6:.0f} MB.\n"
    )
    if found is not None:
        write(_losses_in_words(found))


def _losses_in_words(found: "Losses") -> str:
    optimal, *some = (f"{100.0 * found.share_within(w or ROUNDING):.1f} %" for w in WITHIN)
    within = ", ".join(
        f"{share} lose at most {100.0 * loss:g} %"
        for share, loss in zip(some, WITHIN[1:], strict=True)
    )
    missed = sum(time == float("inf") for time in found.exact.tolist())
    exact = f" The exact planner found no path from {missed} of them." if missed else ""
    return (
        f"They are paths, not the fastest ones: of {len(found.nodes):,} of them, compared with "
        f"exact plans from the same\nstates, {optimal} are optimal, {within};\nthe worst loses "
        f"{100.0 * float(found.loss.max()):.0f} %.{exact}\n"
    )


def _make_labels(chosen: argparse.Namespace) -> None:
    """Situations with the exact time of each branch."""
    import numpy as np

    from relguide.cli.workers import collect, start_workers
    from relguide.learn.words.branch_labels import (
        BRANCHES,
        SOURCES,
        LabelRequest,
        held_out_regions,
        join_labels,
        make_labels,
        save_labels,
    )

    if chosen.resume:
        raise ValueError("Labels are made in a minute or two, and nothing is left to resume.")
    size, file = LABELS if chosen.count is None else chosen.count, chosen.out
    request = LabelRequest(count=size, seed=chosen.seed, loops=chosen.loops)
    loops = f"--loops {chosen.loops:g} " if chosen.loops else ""
    command = (
        f"relguide dataset --method exact --count {size} --seed {chosen.seed} "
        f"{loops}--out {file.name}"
    )
    file.parent.stat()  # nothing is made that could not be written
    started = perf_counter()
    with start_workers(chosen.threads, chosen.dask) as pool:
        labels = join_labels(collect(make_labels(request, pool), "labelling", request.chunks))
    seconds = perf_counter() - started
    save_labels(labels, request, provenance("exact", command=command), file)
    counts = np.bincount(labels.best, minlength=len(BRANCHES)).tolist()
    sources = np.bincount(labels.sources, minlength=len(SOURCES)).tolist()
    if not for_people(chosen):
        apart = {
            name: int(inside.sum()) for name, inside in held_out_regions(labels.situations).items()
        }
        _write_figures(
            file, seconds, sources=dict(zip(SOURCES, sources, strict=True)),
            fastest=dict(zip(BRANCHES, counts, strict=True)), held_out=apart,
        )  # fmt: skip
        return
    shares = ", ".join(
        f"{name} {100.0 * number / len(labels):.1f} %"
        for name, number in zip(BRANCHES, counts, strict=True)
    )
    write(
        f"{file}: {len(labels):,} situations with the exact time of each branch, made in "
        f"{seconds:.1f} s; {file.stat().st_size / 1e6:.0f} MB.\nFastest: {shares}.\n"
    )


def _make_path_labels(chosen: argparse.Namespace) -> None:
    """Situations in which d_min binds, each with the fastest constrained path."""
    import numpy as np

    from relguide.cli.workers import collect, start_workers
    from relguide.learn.boundary.template_label_file import (
        grow_template_labels,
        save_template_labels,
    )
    from relguide.learn.boundary.template_labels import SOURCES, TemplateLabelRequest, join_labels
    from relguide.learn.boundary.template_network import NONE, TEMPLATES
    from relguide.learn.boundary.train_templates import targets_of

    size, file = PATH_LABELS if chosen.count is None else chosen.count, chosen.out
    request = TemplateLabelRequest(count=size, seed=chosen.seed)
    command = (
        f"relguide dataset --method templates --count {size} --seed {chosen.seed} --out {file.name}"
    )
    file.parent.stat()  # nothing is made that could not be written
    part = file.with_name(f"{file.name}.part")
    started = perf_counter()
    with start_workers(chosen.threads, chosen.dask) as pool:
        chunks = grow_template_labels(request, part, pool, resume=chosen.resume)
        labels = join_labels(collect(chunks, "labelling", request.chunks))
    seconds = perf_counter() - started
    save_template_labels(labels, request, provenance("templates", command=command), file)
    part.unlink()
    templates, _ = targets_of(labels.paths)
    counts = np.bincount(templates, minlength=len(TEMPLATES)).tolist()
    sources = np.bincount(labels.sources, minlength=len(SOURCES)).tolist()
    if not for_people(chosen):
        _write_figures(
            file, seconds, sources=dict(zip(SOURCES, sources, strict=True)),
            fastest=dict(zip(TEMPLATES, counts, strict=True)),
        )  # fmt: skip
        return
    there = len(labels) - counts[NONE]
    commonest = [int(at) for at in np.argsort(counts)[::-1] if at != NONE][:6]
    shares = ", ".join(f"{TEMPLATES[at]} {100.0 * counts[at] / there:.1f} %" for at in commonest)
    write(
        f"{file}: {len(labels):,} situations in which d_min binds, {there:,} of them with a "
        f"path, made in {seconds:.0f} s; {file.stat().st_size / 1e6:.0f} MB.\n"
        f"Fastest: {shares}; {sum(number > 0 for number in counts)} templates in all.\n"
    )


def _write_figures(
    file: Path, seconds: float, *, sources: dict[str, int], **more: dict[str, int]
) -> None:
    """Labels by their source and whatever else there is to count, as one JSON object."""
    write_json(
        {
            "file": str(file),
            "labels": sum(sources.values()),
            "sources": sources,
            **more,
            "made_s": seconds,
            "file_bytes": file.stat().st_size,
        }
    )


def _npz(text: str) -> Path:
    if not text.endswith(".npz"):
        raise argparse.ArgumentTypeError(f"must end in .npz, not {text}")
    return Path(text)
