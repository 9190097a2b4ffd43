"""Fig. 3: the reverse generation as it grows, and the structure of the algorithm."""

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.area_figure import TWO_A300
from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.flights import Floats
from relguide.figures.style import (
    BLUE,
    GREEN,
    INK,
    LIMIT_FILL,
    ORANGE,
    PALE,
    empty_figure,
)
from relguide.learn.tree.reverse_dp import grow_order, plant, tree_from
from relguide.learn.tree.tree import RegularTree, TreeParameters, pairs_of
from relguide.units import DEG

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
PARAMETERS = TreeParameters(
    encounter=TWO_A300,
    order=4,
    delta_theta=60.0 * DEG,
    delta_l=20_000.0,
    cell=10_000.0,
    horizon=600.0,
)
"""So coarse that branches can be told apart; the database of Fig. 4 is finer."""
STEPS = (
    "order 1: the root, the slot $(-D, 0, \\psi_L)$, T = 0",
    "from each state kept at the last order",
    "lay back each pair: ε = ±1,\n$\\theta_k = (k-1)\\,\\Delta\\theta$,  $l_h = (h-1)\\,\\Delta l$",
    "T within the horizon, $d \\geq d_{min}$ on the way?",
    "sooner than all before in its cell of (x, y, ψ)?",
    "keep the state and its pair: a node of the tree",
)
FINENESS = 20.0 * DEG
"""Of a turn, as it is drawn."""


def draw(step: Step) -> Drawn:
    """A panel for each order: what it adds in colour, what was there before in grey."""
    growth = plant(PARAMETERS)
    sizes, told = [1], [growth.laid]
    while not growth.finished:
        *_, growth = grow_order(growth)
        sizes.append(len(growth.states))
        told.append(growth.laid)
        step(0.1)
    tree = tree_from(growth, {})
    branches = _branches(tree)
    figure = empty_figure(12.0, 3.9)
    structure, *panels = figure.subplots(
        1, len(sizes), gridspec_kw={"width_ratios": [1.15] + [1.0] * (len(sizes) - 1)}
    )
    _structure(structure)
    for order, axes in enumerate(panels, start=2):
        _grown(axes, branches, sizes[order - 2], sizes[order - 1])
        axes.set_title(f"order {order}: {sizes[order - 1] - 1:,} states")
        axes.set_xlim(-45.0, 205.0)
        axes.set_ylim(-125.0, 125.0)
        axes.tick_params(labelleft=order == 2)
    panels[0].set_ylabel("left of the leader's route [km]")
    shape = PARAMETERS
    return Drawn(
        figure,
        f"A coarse tree, so that its branches are seen: Δθ = {shape.delta_theta / DEG:.0f}°, "
        f"Δl = {shape.delta_l / KM:.0f} km, cells of {shape.cell / KM:.0f} km, "
        f"{shape.horizon / 60.0:.0f} min, seen from the slot. "
        f"{told[-1]:,} regular trajectories laid back leave {sizes[-1] - 1:,} states; with their "
        "mirror images they are drawn. The circle is d = d_min.",
    )


def _branches(tree: RegularTree) -> list[Floats]:
    """The first pair of each node, in the frame of the moving slot, in kilometres. (n, 2) each."""
    encounter = tree.parameters.encounter
    radius, ratio = encounter.turn_radius, encounter.speed_ratio
    pairs = pairs_of(tree, np.arange(len(tree), dtype=np.int32))[:, 0]
    drawn = []
    for x, y, heading, (turn, angle, length) in zip(
        tree.x, tree.y, tree.heading, pairs, strict=True
    ):
        swept = np.linspace(0.0, angle, 2 + int(angle / FINENESS)) if angle else np.zeros(1)
        # a turn to the left has its centre to the left, at heading + 90°
        centre = heading + turn * 0.5 * pi
        along = heading + turn * swept
        east = x + radius * (np.cos(centre) - np.cos(centre + turn * swept))
        north = y + radius * (np.sin(centre) - np.sin(centre + turn * swept))
        if length:
            east = np.append(east, east[-1] + length * np.cos(along[-1]))
            north = np.append(north, north[-1] + length * np.sin(along[-1]))
            swept = np.append(swept, swept[-1] + length / radius)
        drawn.append(np.column_stack((east - ratio * radius * swept, north)) / KM)
    return drawn


def _joined(lines: list[Floats]) -> Floats:
    """Many lines as one with gaps, its columns x and y."""
    gap = np.full((1, 2), np.nan)
    return np.concatenate([gap, *(part for line in lines for part in (line, gap))]).T


def _grown(axes: "Axes", branches: list[Floats], before: int, now: int) -> None:
    from matplotlib.patches import Circle

    encounter = PARAMETERS.encounter
    ahead = encounter.slot_distance / KM
    limit = encounter.min_separation / KM
    axes.add_patch(Circle((ahead, 0.0), limit, fc=LIMIT_FILL, ec=ORANGE, lw=0.9))
    axes.plot([ahead], [0.0], marker=">", color=ORANGE, ms=5)
    for own, colour, width in (
        (branches[1:before], PALE, 0.4),
        (branches[max(before, 1) : now], BLUE, 0.6),
    ):
        both = [line * (1.0, side) for line in own for side in (1.0, -1.0)]
        # one line for all: a fifth of the file
        axes.plot(*_joined(both), color=colour, lw=width)
    axes.plot([0.0], [0.0], "D", color=GREEN, mfc="white", ms=6, mew=1.4, zorder=6)
    axes.set_aspect("equal")
    axes.set_xlabel("ahead of the slot [km]")


def _structure(axes: "Axes") -> None:
    """The steps from top to bottom, and the loop over the orders beside them."""
    axes.set_axis_off()
    axes.set_title("the algorithm")
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(0.0, 1.0)
    heights = np.linspace(0.93, 0.1, len(STEPS))
    for k, (words, height) in enumerate(zip(STEPS, heights, strict=True)):
        axes.text(
            0.47, height, words, ha="center", va="center", fontsize=7.2,
            bbox={
                "boxstyle": "round,pad=0.45", "fc": "white",
                "ec": GREEN if k == 0 else INK if "?" in words else BLUE,
                "ls": "--" if "?" in words else "-",
            },
        )  # fmt: skip
        if k:
            axes.annotate(
                "", (0.47, height + 0.058), (0.47, heights[k - 1] - 0.058),
                arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.0},
            )  # fmt: skip
            if "?" in STEPS[k - 1]:
                axes.text(0.5, 0.5 * (height + heights[k - 1]), "yes", fontsize=7, va="center")
    right = 1.0
    axes.plot([0.86, right, right], [heights[-1]] * 2 + [heights[1]], color=PALE, lw=1.0)
    axes.annotate(
        "", (0.8, heights[1]), (right, heights[1]),
        arrowprops={"arrowstyle": "-|>", "color": PALE, "lw": 1.0, "shrinkA": 0},
    )  # fmt: skip
    axes.text(
        right + 0.02, 0.5 * (heights[1] + heights[-1]), "next order, up to n", rotation=90,
        va="center", fontsize=7.2, color=INK,
    )  # fmt: skip


FIGURE = NamedFigure(
    name="fig_3",
    title="Fig. 3: reverse generation of regular trajectories",
    seconds=2.0,
    draw=draw,
)
