"""`relguide area`: the convergence area of the paper's Fig. 4, from a tree and exactly."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, add_form, for_people, write, write_json
from relguide.cli.shared_options import add_tree, tree_parameters

if TYPE_CHECKING:
    from relguide.learn.tree.tree import TreeParameters
    from relguide.maps.area import Floats

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
    from relguide.cli.tree_growth import grow_tree, plan_places
    from relguide.figures.area_figure import check_figure, column_of, draw_areas
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

    def exact_from(x: "Floats", y: "Floats", heading: "Floats", title: str) -> "Floats":
        return plan_places(tree.parameters, x, y, heading, title=title)

    columns = [column_of(tree, number, exact_from) for number in numbers]
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
