"""Options that several commands have, and what they stand for."""

import argparse
from math import nan
from typing import TYPE_CHECKING

from relguide.learn.planners import PLANNERS

if TYPE_CHECKING:
    from relguide.learn.tree.tree import TreeParameters


def count(text: str) -> int:
    """An option's value as a whole number from 0 to 10⁹."""
    if not (text.isascii() and text.isdigit() and int(text[:12]) <= 10**9):
        raise argparse.ArgumentTypeError(f"must be a whole number of 0 or more, not {text}")
    return int(text)


def seconds(text: str, low: float, high: float) -> float:
    """An option's value as a time in [low, high] [s]."""
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not low <= value <= high:
        bounds = f"{low:g} to {high:g}"
        raise argparse.ArgumentTypeError(f"must be a number of seconds from {bounds}, not {text}")
    return value


def add_planner(parser: argparse.ArgumentParser) -> None:
    """Let the planner be chosen."""
    parser.add_argument(
        "--planner",
        choices=PLANNERS,
        default="exact",
        help="; ".join(f"{name}: {known.description}" for name, known in PLANNERS.items())
        + "; default: exact",
    )


def add_workers(parser: "argparse._ActionsContainer", kind: str = "threads") -> None:
    """Let it be chosen where parts are made: `workers.start_workers` takes what is chosen.

    Args:
        parser: of the command, or a group of its options.
        kind: what is counted on this machine: threads or processes.
    """
    workers = parser.add_mutually_exclusive_group()
    workers.add_argument(f"--{kind}", metavar="N", type=count, help="how many; default: all cores")
    workers.add_argument(
        "--dask",
        metavar="tcp://HOST:PORT",
        help="work on the Dask cluster of this scheduler: the same result, from many machines",
    )


def add_tree(parser: argparse.ArgumentParser) -> None:
    """Let it be chosen which tree is grown."""
    options = parser.add_argument_group("the tree", "its defaults are two A300 at 10 min")
    for name, value, purpose in (
        ("--delta-theta-deg", 10.0, "Δθ, a whole part of 360°"),
        ("--delta-l-m", 1000.0, "Δl"),
        ("--cell-m", 2000.0, "edge of a cell; of the paths from one cell the fastest stays"),
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


def tree_parameters(chosen: argparse.Namespace) -> "TreeParameters":
    """The tree that the options of `add_tree` ask for."""
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
