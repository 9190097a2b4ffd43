"""The paper's tree, grown and compared with exact plans under a bar."""

from math import pi
from pathlib import Path
from time import perf_counter

import numpy as np

from relguide.learn.tree.reverse_dp import Growth, grow_order, plant, reverse_tree, tree_from
from relguide.learn.tree.tree import (
    LEAST_HORIZON,
    Losses,
    RegularTree,
    TreeParameters,
    losses,
    parameters_as_json,
)
from relguide.learn.tree.tree_file import load_growth, save_growth
from relguide.maps.area import Floats, exact_times
from relguide.planning.progress import progress_bar, show_progress

SAVE_EVERY = 5.0
"""Between two savings of a tree still growing [s]: what a stop may cost."""


def grow_tree(parameters: TreeParameters) -> RegularTree:
    """Grow a tree from its root; it is not saved on the way."""
    return tree_from(grow_on(plant(parameters)), {})


def grow_on(growth: Growth, *, threads: int | None = None, part: Path | None = None) -> Growth:
    """Grow a tree to its end, saving it every few seconds if there is a file for it."""
    saved = perf_counter()
    while not growth.finished:
        blocks = show_progress(
            grow_order(growth, threads=threads),
            title=f"growing order {growth.order + 1}",
            total=len(growth.latest),
            done=lambda block: block.next,
        )
        for growth in blocks:
            if part is not None and perf_counter() - saved > SAVE_EVERY:
                save_growth(growth, part)
                saved = perf_counter()
    return growth


def load_part(parameters: TreeParameters, part: Path) -> Growth:
    """Read what a stopped run has left.

    Raises:
        ValueError: if that was growing another tree.
    """
    growth = load_growth(part)
    asked, begun = parameters_as_json(parameters), parameters_as_json(growth.parameters)
    for name, value in asked.items():
        if value != begun[name]:
            raise ValueError(
                f"{part} was begun with {name} {begun[name]:g}, not {value:g}: ask for the same, "
                "or delete it to begin anew."
            )
    return growth


def load_kernels(parameters: TreeParameters) -> None:
    """Grow a tiny tree: that loads the compiled kernels, which is no part of the time measured."""
    radius = parameters.encounter.turn_radius
    reverse_tree(
        TreeParameters(
            encounter=parameters.encounter,
            order=2,
            delta_theta=0.5 * pi,
            delta_l=radius,
            cell=radius,
            horizon=LEAST_HORIZON,
        )
    )


def compare_states(tree: RegularTree, states: int, *, threads: int | None) -> Losses | None:
    """Compare a fixed choice of a tree's states with exact plans; `None` if there are none.

    Args:
        tree: the tree.
        states: how many.
        threads: how many; all cores if none is given.
    """
    minima = tree.minima
    if states == 0 or len(minima) == 0:
        return None
    choice = np.random.default_rng(0).permutation(minima)[:states]
    exact = plan_places(
        tree.parameters,
        tree.x[choice],
        tree.y[choice],
        tree.heading[choice],
        title="auditing",
        threads=threads,
    )
    return losses(tree, choice, exact)


def plan_places(
    parameters: TreeParameters,
    x: Floats,
    y: Floats,
    heading: Floats,
    *,
    title: str,
    threads: int | None = None,
) -> Floats:
    """Exact times from many places relative to the slot [s]; infinite where there is no path."""
    with progress_bar(title, total=len(x)) as count:
        times = exact_times(parameters.encounter, x, y, heading, threads=threads, progress=count)
    return times.time_to_converge
