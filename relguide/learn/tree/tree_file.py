"""Trees, and trees still growing, as .npz files."""

from pathlib import Path

import numpy as np

from relguide.learn.training.files import load_columns, save_columns
from relguide.learn.tree.reverse_dp import CELL_COLUMNS, Growth
from relguide.learn.tree.tree import RegularTree, parameters_as_json, parameters_from_json

TREE, GROWTH = "relguide reverse-dp tree 1", "relguide reverse-dp growth 1"
"""What a file says it is, with the version of its columns."""
NONE = "is no file of relguide dataset, or it is cut short."
"""What is said of a file that is not one."""
TREE_COLUMNS = {
    "x_m": "x",
    "y_m": "y",
    "heading_number": "heading_number",
    "time_s": "time",
    "parent": "parent",
    "length_number": "length_number",
    "angle_number": "angle_number",
    "turn": "turn",
    "mirrored": "mirrored",
    "best": "best",
}
"""Columns of a tree's file and the fields they are."""
GROWTH_COLUMNS = ("states", "headings", "parents", "pairs", "latest", *CELL_COLUMNS)
"""Fields of a growing tree that are arrays."""


def save_tree(tree: RegularTree, file: Path) -> None:
    """Write a tree.

    Columns: x_m, y_m, heading_number (in Δθ), time_s of each node, the parent and the pair it
    begins with, and for each cell the node of least time.
    """
    columns = {column: getattr(tree, field) for column, field in TREE_COLUMNS.items()}
    about = {
        "file": TREE,
        "parameters": parameters_as_json(tree.parameters),
        "laid": tree.laid,
        "close": tree.close,
        "provenance": dict(tree.provenance),
    }
    save_columns(file, about, columns)


def load_tree(file: Path) -> RegularTree:
    """Read a tree.

    Raises:
        ValueError: if the file is not one.
    """
    about, columns = load_columns(file, TREE, tuple(TREE_COLUMNS), NONE)
    tree = RegularTree(
        parameters=parameters_from_json(about["parameters"]),
        laid=int(about["laid"]),
        close=int(about["close"]),
        provenance=about["provenance"],
        **{field: columns[column] for column, field in TREE_COLUMNS.items()},
    )
    nodes = len(tree)
    same = all(len(columns[c]) == nodes for c in TREE_COLUMNS if c != "best")
    if (
        not same
        or nodes == 0
        or tree.best.shape != tree.parameters.shape
        or not np.array_equal(tree.parent < np.arange(nodes), np.ones(nodes, bool))
        or not -1 <= tree.best.min() <= tree.best.max() < nodes
    ):
        raise ValueError(f"{file}: its columns do not fit together; grow the tree again.")
    return tree


def save_growth(growth: Growth, file: Path) -> None:
    """Write a tree still growing, to be grown on later."""
    about = {
        "file": GROWTH,
        "parameters": parameters_as_json(growth.parameters),
        "order": growth.order,
        "next": growth.next,
        "laid": growth.laid,
        "close": growth.close,
    }
    save_columns(file, about, {name: getattr(growth, name) for name in GROWTH_COLUMNS})


def load_growth(file: Path) -> Growth:
    """Read a tree still growing.

    Raises:
        ValueError: if the file is not one.
    """
    about, columns = load_columns(file, GROWTH, GROWTH_COLUMNS, NONE)
    return Growth(
        parameters=parameters_from_json(about["parameters"]),
        order=int(about["order"]),
        next=int(about["next"]),
        laid=int(about["laid"]),
        close=int(about["close"]),
        **columns,
    )
