"""`relguide area`: the convergence area of the paper's Fig. 4, from a tree and exactly."""

import argparse
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, add_form, for_people, write, write_json
from relguide.cli.shared_options import add_tree, tree_parameters

if TYPE_CHECKING:
    from relguide.figures.area_figure import Column
    from relguide.learn.tree.tree import RegularTree, TreeParameters

PURPOSE = "draw the convergence area, from a tree and exactly"
EXAMPLES = """
    relguide area --figure fig_4.svg                    the paper's Fig. 4
    relguide area --figure fig_4.png --tree tree.npz    from a tree made before
    relguide area --figure fig_4.svg --headings-deg 0 90 180
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide area`."""
    parser.add_argument(
        "--figure", metavar="FILE", type=Path, required=True, help="an .svg, .png or .pdf file"
    )
    parser.add_argument(
        "--tree",
        metavar="FILE.npz",
        type=Path,
        help="made by relguide dataset; else one is grown by the options below",
    )
    parser.add_argument(
        "--headings-deg",
        metavar="DEG",
        type=float,
        nargs="+",
        default=[0.0, 60.0, 120.0, 180.0],
        help="left of the leader's, whole numbers of Δθ; default: 0 60 120 180",
    )
    add_form(parser)
    add_tree(parser)


def run(chosen: argparse.Namespace) -> int:
    """Draw a column for each heading."""
    from relguide.cli.tree_growth import grow_tree
    from relguide.figures.area_figure import check_figure, draw_areas
    from relguide.learn.tree.tree_file import load_tree
    from relguide.units import DEG

    check_figure(chosen.figure)
    headings = [degrees * DEG for degrees in chosen.headings_deg]
    if chosen.tree is not None:
        tree = load_tree(chosen.tree)
        numbers = [_number(heading, tree.parameters) for heading in headings]
    else:
        parameters = tree_parameters(chosen)
        numbers = [_number(heading, parameters) for heading in headings]
        tree = grow_tree(parameters)
    columns = [column_of(tree, number) for number in numbers]
    draw_areas(columns, tree, chosen.figure)
    if for_people(chosen):
        write(f"{chosen.figure}: the convergence area on {len(columns)} headings.\n")
    else:
        write_json({"file": str(chosen.figure), "headings_deg": chosen.headings_deg})
    return DONE


def _number(heading: float, parameters: "TreeParameters") -> int:
    """The number of a heading [rad] among those of a tree."""
    from relguide.units import DEG

    number = heading / parameters.delta_theta
    if abs(number - round(number)) > 1e-6:
        raise ValueError(
            f"The tree has headings every {parameters.delta_theta / DEG:g}°; "
            f"{heading / DEG:g}° is not one of them."
        )
    return round(number) % parameters.headings


def column_of(tree: "RegularTree", number: int) -> "Column":
    """The tree's area for one heading, the exact one, and what the tree's path of each cell loses.

    Args:
        tree: the tree.
        number: of the heading among the tree's.
    """
    import numpy as np

    from relguide.cli.tree_growth import plan_places
    from relguide.figures.area_figure import Column
    from relguide.learn.tree.tree import nodes_at, tree_area
    from relguide.maps.area import middles

    shown = tree_area(tree, number)
    places = middles(shown)
    headings = np.full(places[0].shape, shown.heading)
    exact = plan_places(tree.parameters, *places, headings, title="planning each cell")
    exact[exact > tree.parameters.horizon] = inf
    cells = nodes_at(tree, number)
    nodes = np.unique(cells[cells >= 0])
    own = plan_places(
        tree.parameters, tree.x[nodes], tree.y[nodes], tree.heading[nodes], title="judging the tree"
    )
    lost = np.full(len(tree) + 1, inf)  # what has no node, −1, is the last
    lost[nodes] = tree.time[nodes] - own
    return Column(
        tree=shown,
        exact=replace(shown, time=exact.reshape(shown.time.shape)),
        loss=replace(shown, time=lost[cells]),
    )
