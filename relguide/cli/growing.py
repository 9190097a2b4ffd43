"""What `relguide dataset` and `area` do: files, bars and figures around `learn/`."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf, pi
from pathlib import Path
from time import perf_counter

import numpy as np

from relguide.cli.output import provenance, write, write_json
from relguide.figures.area_figure import Column, check_figure, draw_areas
from relguide.learn.training.files import expect_part
from relguide.learn.tree.reverse_dp import Growth, grow_order, planted, reverse_tree, tree_from
from relguide.learn.tree.tree import (
    LEAST_HORIZON,
    Losses,
    Tree,
    TreeParameters,
    losses,
    nodes_at,
    parameters_as_json,
    tree_area,
)
from relguide.learn.tree.tree_file import load_growth, load_tree, save_growth, save_tree
from relguide.maps.area import Floats, exact_times, middles
from relguide.planning.progress import progress_bar, watched
from relguide.units import DEG, Radian

SAVE_EVERY = 5.0
"""Between two savings of a tree still growing [s]: what a stop may cost."""
WITHIN = (0.0, 0.001, 0.01, 0.05)
"""Losses that the audit counts the states within."""
ROUNDING = 1e-9
"""A loss up to this is none."""


def make_tree(
    parameters: TreeParameters,
    file: Path,
    *,
    resume: bool,
    threads: int | None,
    audit: int,
    as_json: bool,
) -> None:
    """Grow a tree, write it and print what it is.

    Args:
        parameters: what to grow.
        file: where to.
        resume: go on from the file that a stopped run has left.
        threads: how many; all cores if none is given.
        audit: how many of its states to compare with the exact planner.
        as_json: one JSON object; sentences otherwise.
    """
    part = file.with_name(f"{file.name}.part")
    expect_part(part, resume=resume)
    growth = _resumed(parameters, part) if resume else planted(parameters)
    save_growth(growth, part)  # also tells at once if the file cannot be written
    reverse_tree(_tiny(parameters))  # loads the compiled kernels, which is no part of the time
    laid_before, started = growth.laid, perf_counter()
    growth = _grown(growth, threads, part)
    seconds, laid = perf_counter() - started, growth.laid - laid_before
    tree = tree_from(growth, provenance("reverse-dp"))
    save_tree(tree, file)
    part.unlink()
    found = _audited(tree, audit, threads)
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
            "missed_by_exact": int(np.sum(found.exact == inf)),
        }
    if as_json:
        write_json(figures)
        return
    write(
        f"{file}: the best ways from {len(tree.minima):,} cells, of {tree.laid:,} trajectories "
        f"of order {parameters.order} or less,\n"
        f"laid back in {seconds:.1f} s ({laid / seconds / 1e6:.0f} million a second); "
        f"{file.stat().st_size / 1e6:.0f} MB.\n"
    )
    if found is not None:
        write(_told(found))


def _told(found: Losses) -> str:
    none, *some = (f"{100.0 * found.share_within(w or ROUNDING):.1f} %" for w in WITHIN)
    within = ", ".join(
        f"{share} lose at most {100.0 * loss:g} %"
        for share, loss in zip(some, WITHIN[1:], strict=True)
    )
    missed = int(np.sum(found.exact == inf))
    exact = f" The exact planner found no way from {missed} of them." if missed else ""
    return (
        f"They are ways, not the fastest ones: of {len(found.nodes):,} of them, compared with "
        f"exact plans from the same\nstates, {none} are optimal, {within};\nthe worst loses "
        f"{100.0 * float(found.loss.max()):.0f} %.{exact}\n"
    )


def _resumed(parameters: TreeParameters, part: Path) -> Growth:
    growth = load_growth(part)
    asked, begun = parameters_as_json(parameters), parameters_as_json(growth.parameters)
    for name, value in asked.items():
        if value != begun[name]:
            raise ValueError(
                f"{part} was begun with {name} {begun[name]:g}, not {value:g}: ask for the same, "
                "or delete it to begin anew."
            )
    return growth


def _tiny(parameters: TreeParameters) -> TreeParameters:
    return TreeParameters(
        encounter=parameters.encounter,
        order=2,
        delta_theta=0.5 * pi,
        delta_l=parameters.encounter.turn_radius,
        cell=parameters.encounter.turn_radius,
        horizon=LEAST_HORIZON,
    )


def _audited(tree: Tree, audit: int, threads: int | None) -> Losses | None:
    """Compare a fixed choice of states with the exact planner."""
    minima = tree.minima
    if audit == 0 or len(minima) == 0:
        return None
    choice = np.random.default_rng(0).permutation(minima)[:audit]
    exact = _planned(
        tree.parameters,
        tree.x[choice],
        tree.y[choice],
        tree.heading[choice],
        title="auditing",
        threads=threads,
    )
    return losses(tree, choice, exact)


def draw_area(figure: Path, headings: Sequence[Radian], of: Path | TreeParameters) -> None:
    """Draw the convergence area.

    Args:
        figure: the file to draw into.
        headings: of the pursuer, counter-clockwise from the leader's, a column each [rad].
        of: a tree's file, or what to grow one from.
    """
    check_figure(figure)
    if isinstance(of, Path):
        tree = load_tree(of)
        numbers = [_number(heading, tree.parameters) for heading in headings]
    else:
        numbers = [_number(heading, of) for heading in headings]
        tree = tree_from(_grown(planted(of), None, None), {})
    columns = [_column(tree, number) for number in numbers]
    draw_areas(columns, tree, figure)
    write(f"{figure}: the convergence area on {len(columns)} headings.\n")


def _number(heading: Radian, parameters: TreeParameters) -> int:
    number = heading / parameters.delta_theta
    if abs(number - round(number)) > 1e-6:
        raise ValueError(
            f"The tree has headings every {parameters.delta_theta / DEG:g}°; "
            f"{heading / DEG:g}° is none of them."
        )
    return round(number) % parameters.headings


def _column(tree: Tree, number: int) -> Column:
    """The tree's area for one heading, the exact one, and what each cell's own way loses."""
    shown = tree_area(tree, number)
    places = middles(shown)
    headings = np.full(places[0].shape, shown.heading)
    exact = _planned(tree.parameters, *places, headings, title="planning each cell")
    exact[exact > tree.parameters.horizon] = inf
    cells = nodes_at(tree, number)
    nodes = np.unique(cells[cells >= 0])
    own = _planned(
        tree.parameters, tree.x[nodes], tree.y[nodes], tree.heading[nodes], title="judging the tree"
    )
    lost = np.full(len(tree) + 1, inf)  # what has no node, −1, is the last
    lost[nodes] = tree.time[nodes] - own
    return Column(
        tree=shown,
        exact=replace(shown, time=exact.reshape(shown.time.shape)),
        loss=replace(shown, time=lost[cells]),
    )


def _grown(growth: Growth, threads: int | None, part: Path | None) -> Growth:
    """Grow a tree to its end, saving it every few seconds if there is a file for it."""
    saved = perf_counter()
    while not growth.finished:
        blocks = watched(
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


def _planned(
    parameters: TreeParameters,
    x: Floats,
    y: Floats,
    heading: Floats,
    *,
    title: str,
    threads: int | None = None,
) -> Floats:
    """Exact times from many places relative to the slot [s]."""
    with progress_bar(title, total=len(x)) as count:
        times = exact_times(parameters.encounter, x, y, heading, threads=threads, progress=count)
    return times.time_to_converge
