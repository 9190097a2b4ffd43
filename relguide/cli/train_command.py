"""`relguide train`: the branch network or of templates, or the paper's own."""

import argparse
from collections import deque
from collections.abc import Callable, Iterator
from time import perf_counter
from typing import TYPE_CHECKING, Any

from relguide.cli.output import DONE, add_form, for_people, program_name, write, write_json
from relguide.learn.training.options import add_options as add_training
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.learn.training.fitting import Epoch

PURPOSE = "train the network that says which words to solve, or the paper's own"
EXAMPLES = """
    relguide train labels.npz weights.safetensors               on the device there is
    relguide train labels.npz weights.safetensors --resume      go on after a stop
    relguide train labels.npz small.safetensors --width 32 --epochs 10
    relguide train templates.npz w.safetensors --method templates    where d_min binds
    relguide train tree.npz paper.safetensors --method paper    Fig. 5, from the paper's tree
    """
METHODS = ("branches", "templates", "paper", "direct")
"""What a network learns."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide train`."""
    add_training(parser)
    add_form(parser)
    parser.add_argument(
        "--method",
        choices=METHODS,
        default=METHODS[0],
        help="branches, templates: from LABELS.npz of dataset --method exact, templates; paper: "
        "the tree's (ε, θ, l), from a TREE.npz in its place; direct: the exact ones from the "
        "tree's states; default: %(default)s",
    )


def run(chosen: argparse.Namespace) -> int:
    """Train a network, write it and print how good it is."""
    need("torch", extra="learn")
    if chosen.method == "branches":
        _train_branches(chosen)
    elif chosen.method == "templates":
        _train_templates(chosen)
    else:
        _train_regular(chosen)
    return DONE


def _train_branches(chosen: argparse.Namespace) -> None:
    from relguide.learn.words.train_branches import run

    _train(
        chosen,
        run(chosen, program_name()),
        lambda right: (
            f"{100.0 * right:.3f} % of the fastest branches right in labels not trained "
            "on,\nmost of them rare or next to a switching surface"
        ),
    )


def _train_templates(chosen: argparse.Namespace) -> None:
    from relguide.learn.boundary.train_templates import run

    _train(
        chosen,
        run(chosen, program_name()),
        lambda right: f"{100.0 * right:.2f} % of the templates right in labels not trained on",
    )


def _train(
    chosen: argparse.Namespace, epochs: "Iterator[Epoch[Any]]", right: Callable[[float], str]
) -> None:
    """Train to the end, with a bar, and print what came of it."""
    from relguide.learn.training.fitting import summary_of
    from relguide.planning.progress import show_progress

    started = perf_counter()
    shown = show_progress(
        epochs,
        title="training",
        total=chosen.epochs,
        done=lambda epoch: epoch.number,
        state=summary_of,
    )
    last = deque(shown, maxlen=1)
    table, file = for_people(chosen), {"file": str(chosen.weights)}
    if not last:  # resumed after its last epoch
        if table:
            write(f"{chosen.weights} is complete.\n")
        else:
            write_json(file | {"complete": True})
        return
    about = last[0].network.about
    if not table:
        write_json(
            file
            | {
                "complete": True,
                "epochs": last[0].number,
                "best_epoch": last[0].best,
                "validation_accuracy": about["validation_accuracy"],
                "trained_s": perf_counter() - started,
                "device": about["device"],
                "file_bytes": chosen.weights.stat().st_size,
            }
        )
        return
    write(
        f"{chosen.weights}: the best of {last[0].number} epochs is the {last[0].best}., with "
        f"{right(about['validation_accuracy'])}. {perf_counter() - started:.0f} s on "
        f"{about['device']}, {chosen.weights.stat().st_size / 1e3:.0f} kB.\n"
        f"relguide audit {chosen.weights} --method {chosen.method} says more.\n"
    )


def _train_regular(chosen: argparse.Namespace) -> None:
    """Train the paper's network, or the one of exact answers, on a tree."""
    from relguide.learn.training.options import command_of, options_of
    from relguide.learn.tree.regular_network import save_regular
    from relguide.learn.tree.train_regular import train_regular
    from relguide.learn.tree.tree_file import load_tree
    from relguide.planning.progress import show_progress

    if chosen.resume:
        raise ValueError("Such a network is trained in a minute, and nothing is left to resume.")
    tree = load_tree(chosen.labels)
    chosen.weights.parent.stat()  # nothing is trained that could not be written
    started = perf_counter()
    about = {
        "program": program_name(),
        "command": f"{command_of(chosen)} --method {chosen.method}",
        "tree": dict(tree.provenance),
    }
    epochs = show_progress(
        train_regular(tree, options_of(chosen), method=chosen.method, about=about),
        title="training",
        total=chosen.epochs,
        done=lambda epoch: epoch.number,
        state=lambda epoch: f"misses {100.0 * epoch.loss:.1f} % of the variance",
    )
    last = deque(epochs, maxlen=1)[0]
    save_regular(last.network, chosen.weights)
    if not for_people(chosen):
        write_json(
            {
                "file": str(chosen.weights),
                "complete": True,
                "epochs": last.number,
                "missed_share_of_variance": last.loss,
                "trained_s": perf_counter() - started,
                "device": last.network.about["device"],
                "file_bytes": chosen.weights.stat().st_size,
            }
        )
        return
    write(
        f"{chosen.weights}: after {last.number} epochs it misses {100.0 * last.loss:.1f} % of the "
        f"variance of (ε, θ, l) in states not trained on.\n"
        f"{perf_counter() - started:.0f} s on {last.network.about['device']}, "
        f"{chosen.weights.stat().st_size / 1e3:.0f} kB. relguide audit says what it is worth.\n"
    )
