"""The commands that learn from many plans: `relguide dataset`, `train`, `audit`, `area`.

What a command needs is loaded when it runs, so that `--help` answers at once.
"""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.learn.training.options import add_options

if TYPE_CHECKING:
    from relguide.learn.tree.tree import TreeParameters

METHODS = ("reverse-dp", "exact", "templates")
"""How a data set is made."""
TAUGHT = ("branches", "templates", "paper", "direct")
"""What a network is taught."""
LABELS, LIMIT_LABELS = 1_200_000, 400_000
"""How many labels are made: one to two minutes, and half an hour to an hour."""
AUDITED, LIMIT_AUDITED, BESIDE = 100_000, 20_000, 20_000
"""How many situations an audit looks at: half a minute, and one to two."""
AddCommand = Callable[[str, Callable[[argparse.Namespace], int], str, str], argparse.ArgumentParser]
"""Name, what runs it, its purpose, examples → its parser, for the options."""


def add_learning(add_command: AddCommand) -> None:
    """Add these commands to the command line."""
    dataset = add_command(
        "dataset",
        _dataset,
        "make a data set to learn from",
        """
        relguide dataset --method reverse-dp --out tree.npz             the paper's tree
        relguide dataset --method reverse-dp --order 5 --out tree.npz   with four pairs
        relguide dataset --method reverse-dp --out tree.npz --resume    go on after a stop
        relguide dataset --method exact --count 1200000 --out labels.npz    for relguide train
        relguide dataset --method exact --out labels.npz --dask tcp://host:8786   many machines
        relguide dataset --method templates --count 400000 --out templates.npz
        """,
    )
    dataset.add_argument(
        "--method",
        choices=METHODS,
        required=True,
        help="reverse-dp: the tree of Fig. 3; exact: situations with the exact time of each word; "
        "templates: situations in which the limit binds, with the fastest path",
    )
    dataset.add_argument("--out", metavar="FILE.npz", type=_npz, required=True)
    dataset.add_argument(
        "--resume",
        action="store_true",
        help="reverse-dp, templates: go on from FILE.npz.part, which a stopped run leaves",
    )
    _add_workers(dataset)
    dataset.add_argument(
        "--audit",
        metavar="N",
        type=_count,
        default=2000,
        help="reverse-dp: compare N of its states with the exact planner; 0: none; "
        "default: %(default)s",
    )
    dataset.add_argument(
        "--count",
        metavar="N",
        type=_count,
        help=f"exact: how many situations, default: {LABELS}; templates: {LIMIT_LABELS}",
    )
    dataset.add_argument(
        "--seed", metavar="N", type=_count, default=7, help="exact, templates: default: %(default)s"
    )
    dataset.add_argument(
        "--loops",
        metavar="SHARE",
        type=float,
        default=0.0,
        help="exact: so many more that closed loops meet, e.g. 0.02; default: none",
    )
    dataset.add_argument("--json", action="store_true", help="print one JSON object")
    _add_tree(dataset)
    _add_network(add_command)

    area = add_command(
        "area",
        _area,
        "draw the convergence area, from a tree and exactly",
        """
        relguide area --figure fig_4.svg                    the paper's Fig. 4
        relguide area --figure fig_4.png --tree tree.npz    from a tree made before
        relguide area --figure fig_4.svg --headings-deg 0 90 180
        """,
    )
    area.add_argument(
        "--figure", metavar="FILE", type=Path, required=True, help="an .svg, .png or .pdf file"
    )
    area.add_argument(
        "--tree",
        metavar="FILE.npz",
        type=Path,
        help="made by relguide dataset; else one is grown by the options below",
    )
    area.add_argument(
        "--headings-deg",
        metavar="DEG",
        type=float,
        nargs="+",
        default=[0.0, 60.0, 120.0, 180.0],
        help="left of the leader's, whole numbers of Δθ; default: 0 60 120 180",
    )
    _add_tree(area)


def _add_network(add_command: AddCommand) -> None:
    train = add_command(
        "train",
        _train,
        "train the network that says which words to solve, or the paper's own",
        """
        relguide train labels.npz weights.safetensors               on what device there is
        relguide train labels.npz weights.safetensors --resume      go on after a stop
        relguide train labels.npz small.safetensors --width 32 --epochs 10
        relguide train templates.npz w.safetensors --method templates   where the limit binds
        relguide train tree.npz paper.safetensors --method paper    Fig. 5, from the paper's tree
        """,
    )
    add_options(train)
    train.add_argument(
        "--method",
        choices=TAUGHT,
        default=TAUGHT[0],
        help="branches, templates: from LABELS.npz of --method exact, templates; paper: the tree's "
        "(ε, θ, l), from a TREE.npz in its place; direct: the exact ones from the tree's states; "
        "default: %(default)s",
    )

    audit = add_command(
        "audit",
        _audit,
        "say how good a network is, against exact answers",
        """
        relguide audit                               of the weights that come with the program
        relguide audit weights.safetensors --json    of your own; the figures as JSON
        relguide audit --count 1000000 --seed 2
        relguide audit --method templates            of the template network, where the limit binds
        relguide audit --figures docs/figures        its pictures
        relguide audit --count 100000000 --dask tcp://host:8786     on many machines
        """,
    )
    audit.add_argument("weights", metavar="WEIGHTS.safetensors", type=Path, nargs="?")
    audit.add_argument(
        "--method",
        choices=TAUGHT[:2],
        default=TAUGHT[0],
        help="what it was taught; default: %(default)s",
    )
    audit.add_argument(
        "--count",
        metavar="N",
        type=_count,
        help="fresh situations to judge it in; default: "
        f"{AUDITED}; templates: {LIMIT_AUDITED}, and as many whether the limit binds or not",
    )
    audit.add_argument(
        "--seed", metavar="N", type=_count, default=1, help="of them; default: %(default)s"
    )
    audit.add_argument(
        "--beside",
        metavar="N",
        type=_count,
        help="branches: situations to judge it in beside the paper's network, the nearest way "
        f"of its tree and direct regression; 0: none; default: {BESIDE}",
    )
    audit.add_argument("--figures", metavar="FOLDER", type=Path, help="draw what is found, as .svg")
    _add_workers(audit)
    audit.add_argument("--json", action="store_true", help="print one JSON object")


def _add_workers(parser: argparse.ArgumentParser) -> None:
    workers = parser.add_mutually_exclusive_group()
    workers.add_argument("--threads", metavar="N", type=_count, help="default: all cores")
    workers.add_argument(
        "--dask",
        metavar="tcp://HOST:PORT",
        help="work on the Dask cluster of this scheduler: the same result, from many machines",
    )


def _add_tree(parser: argparse.ArgumentParser) -> None:
    options = parser.add_argument_group("the tree", "its defaults are two A300 at 10 min")
    for name, value, purpose in (
        ("--delta-theta-deg", 10.0, "Δθ, a whole part of 360°"),
        ("--delta-l-m", 1000.0, "Δl"),
        ("--cell-m", 2000.0, "edge of a cell; of the ways from one cell the fastest stays"),
        ("--horizon-min", 10.0, "longest time-to-converge"),
        ("--pursuer-tas-mps", 240.0, "V_P"),
        ("--leader-tas-mps", 200.0, "V_L"),
        ("--max-bank-deg", 25.0, "φ_max"),
        ("--slot-distance-m", 12_000.0, "D"),
        ("--min-separation-m", 9_260.0, "d_min"),
    ):
        metavar = name.rsplit("-", 1)[1].upper()
        options.add_argument(
            name, metavar=metavar, type=float, default=value, help=f"{purpose}; default: {value:g}"
        )
    options.add_argument(
        "--order", metavar="N", type=int, default=4, help="n: n − 1 pairs; default: 4"
    )


def _tree_parameters(chosen: argparse.Namespace) -> "TreeParameters":
    from relguide.learn.tree.tree import TreeParameters
    from relguide.maps.area import Encounter
    from relguide.units import DEG

    return TreeParameters(
        encounter=Encounter(
            pursuer_tas=chosen.pursuer_tas_mps,
            max_bank=chosen.max_bank_deg * DEG,
            leader_tas=chosen.leader_tas_mps,
            slot_distance=chosen.slot_distance_m,
            min_separation=chosen.min_separation_m,
        ),
        order=chosen.order,
        delta_theta=chosen.delta_theta_deg * DEG,
        delta_l=chosen.delta_l_m,
        cell=chosen.cell_m,
        horizon=chosen.horizon_min * 60.0,
    )


def _dataset(chosen: argparse.Namespace) -> int:
    if chosen.method == "exact":
        return _labels(chosen)
    if chosen.method == "templates":
        return _limit_labels(chosen)
    from relguide.cli.growing import make_tree

    if chosen.dask is not None:
        raise ValueError(
            "A tree is grown on one machine: --dask is for --method exact and templates."
        )
    make_tree(
        _tree_parameters(chosen),
        chosen.out,
        resume=chosen.resume,
        threads=chosen.threads or None,
        audit=chosen.audit,
        as_json=chosen.json,
    )
    return 0


def _labels(chosen: argparse.Namespace) -> int:
    from relguide.cli.branch_training import make_label_file
    from relguide.learn.words.branch_labels import LabelRequest

    if chosen.resume:
        raise ValueError("Labels are made in a minute or two, and nothing is left to resume.")
    count = LABELS if chosen.count is None else chosen.count
    loops = f"--loops {chosen.loops:g} " if chosen.loops else ""
    make_label_file(
        LabelRequest(count=count, seed=chosen.seed, loops=chosen.loops),
        chosen.out,
        threads=chosen.threads or None,
        scheduler=chosen.dask,
        command=f"relguide dataset --method exact --count {count} --seed {chosen.seed} "
        f"{loops}--out {chosen.out.name}",
        as_json=chosen.json,
    )
    return 0


def _limit_labels(chosen: argparse.Namespace) -> int:
    from relguide.cli.template_training import make_limit_label_file
    from relguide.learn.boundary.template_labels import LimitRequest

    count = LIMIT_LABELS if chosen.count is None else chosen.count
    make_limit_label_file(
        LimitRequest(count=count, seed=chosen.seed),
        chosen.out,
        resume=chosen.resume,
        threads=chosen.threads or None,
        scheduler=chosen.dask,
        command=f"relguide dataset --method templates --count {count} --seed {chosen.seed} "
        f"--out {chosen.out.name}",
        as_json=chosen.json,
    )
    return 0


def _train(chosen: argparse.Namespace) -> int:
    if chosen.method == "templates":
        from relguide.cli.template_training import train_template_network

        train_template_network(chosen)
        return 0
    from relguide.cli.branch_training import train_network, train_regular_network

    if chosen.method == TAUGHT[0]:
        train_network(chosen)
    else:
        train_regular_network(chosen)
    return 0


def _audit(chosen: argparse.Namespace) -> int:
    if chosen.method == "templates":
        return _audit_templates(chosen)
    from relguide.cli.branch_auditing import audit_network

    audit_network(
        chosen.weights,
        count=AUDITED if chosen.count is None else chosen.count,
        seed=chosen.seed,
        beside=BESIDE if chosen.beside is None else chosen.beside,
        figures=chosen.figures,
        threads=chosen.threads or None,
        scheduler=chosen.dask,
        as_json=chosen.json,
    )
    return 0


def _audit_templates(chosen: argparse.Namespace) -> int:
    from relguide.cli.template_auditing import audit_template_network

    if chosen.beside is not None:
        raise ValueError(
            "No other network has learnt templates: --beside is for --method branches."
        )
    audit_template_network(
        chosen.weights,
        count=LIMIT_AUDITED if chosen.count is None else chosen.count,
        seed=chosen.seed,
        figures=chosen.figures,
        threads=chosen.threads or None,
        scheduler=chosen.dask,
        as_json=chosen.json,
    )
    return 0


def _area(chosen: argparse.Namespace) -> int:
    from relguide.cli.growing import draw_area
    from relguide.units import DEG

    draw_area(
        chosen.figure,
        [degrees * DEG for degrees in chosen.headings_deg],
        chosen.tree if chosen.tree is not None else _tree_parameters(chosen),
    )
    return 0


def _npz(text: str) -> Path:
    if not text.endswith(".npz"):
        raise argparse.ArgumentTypeError(f"must end in .npz, not {text}")
    return Path(text)


def _count(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text[:12]) <= 10**9):
        raise argparse.ArgumentTypeError(f"must be a whole number of 0 or more, not {text}")
    return int(text)
