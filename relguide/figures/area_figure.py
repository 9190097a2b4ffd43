"""The convergence area as the paper's Fig. 4 shows it: from the tree, and exactly, side by side.

A column for each heading of the pursuer; above, the time-to-converge of the tree, below it the
exact one on the same axes, and then what the tree's paths lose at the very states they begin from.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import cos, inf, pi, sin
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.figures.style import DOTS, house_style
from relguide.learn.tree.tree import RegularTree, TreeParameters, nodes_at, tree_area
from relguide.maps.area import Area, Encounter, Floats, middles
from relguide.planning.extras import need
from relguide.planning.phrases import whole_degrees
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

KM, MINUTE = 1000.0, 60.0
FORMATS = (".svg", ".png", ".pdf")
"""What a figure may be written as."""
INK, FAINT, LEADER = "#1c2733", "#8a95a3", "#c2185b"
TWO_A300 = Encounter(
    pursuer_tas=240.0,
    max_bank=25.0 * DEG,
    leader_tas=200.0,
    slot_distance=12_000.0,
    min_separation=5.0 * NM,
)
"""The encounter of the paper's Figs. 3 and 4, as `relguide area` has it."""
PANEL = 3.1
"""Width and height of a panel [inch]."""
MOST_LOSS = 60.0
"""What the scale of the losses ends at [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """What is shown of one heading, all on the same axes."""

    tree: Area
    exact: Area
    loss: Area
    """Of each cell's path, over the exact plan from the very state it begins at [s]."""


def check_figure(file: Path) -> None:
    """Refuse a figure that could not be drawn, before anything is computed.

    Raises:
        ValueError: if the file's format is unknown.
        MissingExtra: if matplotlib is missing.
        OSError: if its folder does not exist.
    """
    if file.suffix.lower() not in FORMATS:
        raise ValueError(f"A figure's name must end in {', '.join(FORMATS)}, not {file.name}.")
    file.parent.stat()
    need("matplotlib")


Exact = Callable[[Floats, Floats, Floats, str], Floats]
"""Exact times [s] from places and headings relative to the slot; last, what they are for."""


def column_of(tree: RegularTree, number: int, exact_from: Exact) -> Column:
    """The tree's area for one heading, the exact one, and what the tree's path of each cell loses.

    Args:
        tree: the tree.
        number: of the heading among the tree's.
        exact_from: plans exactly.
    """
    shown = tree_area(tree, number)
    places = middles(shown)
    headings = np.full(places[0].shape, shown.heading)
    exact = exact_from(*places, headings, "planning each cell")
    exact[exact > tree.parameters.horizon] = inf
    cells = nodes_at(tree, number)
    nodes = np.unique(cells[cells >= 0])
    own = exact_from(tree.x[nodes], tree.y[nodes], tree.heading[nodes], "judging the tree")
    lost = np.full(len(tree) + 1, inf)  # what has no node, −1, is the last
    lost[nodes] = tree.time[nodes] - own
    return Column(
        tree=shown,
        exact=replace(shown, time=exact.reshape(shown.time.shape)),
        loss=replace(shown, time=lost[cells]),
    )


def draw_areas(columns: Sequence[Column], tree: RegularTree, file: Path) -> None:
    """Draw the convergence area and write it.

    Args:
        columns: the headings shown, from left to right.
        tree: what they are of.
        file: where to; its suffix says as what.
    """
    # no date in it: the same data give the same file
    metadata = {"Date": None} if file.suffix.lower() == ".svg" else None
    with house_style():
        areas_figure(columns, tree).savefig(file, dpi=DOTS, metadata=metadata)


def areas_figure(columns: Sequence[Column], tree: RegularTree) -> "Figure":
    """The convergence area as a figure.

    Args:
        columns: the headings shown, from left to right.
        tree: what they are of.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    parameters = tree.parameters
    figure = Figure(figsize=(PANEL * len(columns) + 1.2, 3 * PANEL + 1.0), layout="constrained")
    FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.06, h_pad=0.06)  # type: ignore[union-attr, call-arg]
    figure.suptitle(
        f"Convergence area: every place from where the slot is joined within "
        f"{parameters.horizon / MINUTE:g} min\n\n",
        color=INK,
        fontsize=13,
    )
    figure.text(0.5, 0.965, _subtitle(tree), color=FAINT, ha="center", va="top")
    grid = figure.subplots(3, len(columns), sharex=True, sharey=True, squeeze=False)
    most = parameters.horizon / MINUTE
    for axes, column in zip(grid.T, columns, strict=True):
        axes[0].set_title(_heading(column.tree.heading), fontsize=9, fontweight="normal")
        times = [_times(a, area, most) for a, area in zip(axes, _two_areas(column), strict=False)]
        lost = _losses(axes[2], column.loss)
        for a in axes:
            _landmarks(a, parameters, column.tree.heading)
    _crop(grid[0, 0], columns)
    for a in grid[-1]:
        a.set_xlabel("ahead of the slot [km]", color=INK)
    for a, name in zip(
        grid[:, 0], ("reverse dynamic programming", "exact", "lost by the tree"), strict=True
    ):
        a.set_ylabel(f"{name}\n\nleft of the leader's route [km]", color=INK)
    bar = figure.colorbar(times[0], ax=list(grid[:2].flat), shrink=0.6, pad=0.015)
    bar.set_label("time to converge [min]", color=INK)
    bar = figure.colorbar(lost, ax=list(grid[2].flat), extend="max", shrink=0.9, pad=0.015)
    bar.set_label("over the exact time [s]", color=INK)
    return figure


def _subtitle(tree: RegularTree) -> str:
    parameters, encounter = tree.parameters, tree.parameters.encounter
    return (
        f"V_P {encounter.pursuer_tas:g} m/s at {encounter.max_bank / DEG:g}° of bank, V_L "
        f"{encounter.leader_tas:g} m/s, D {encounter.slot_distance / KM:g} km, d_min "
        f"{encounter.min_separation / KM:g} km (the circle)\n"
        f"the tree: {tree.laid / 1e6:,.1f} million regular trajectories of order ≤ "
        f"{parameters.order}, Δθ {parameters.delta_theta / DEG:g}°, Δl {parameters.delta_l:g} m, "
        f"the fastest from each cell of {parameters.cell:g} m"
    )


def _crop(axes: "Axes", columns: Sequence[Column]) -> None:
    """Leave out what no area reaches, for all panels."""
    areas = [area for column in columns for area in _two_areas(column)]
    shown = np.logical_or.reduce([np.isfinite(area.time) for area in areas])
    if shown.any():
        for edges, along, limit in (
            (areas[0].x, shown.any(axis=1), axes.set_xlim),
            (areas[0].y, shown.any(axis=0), axes.set_ylim),
        ):
            first, *_, last = (*np.flatnonzero(along), np.flatnonzero(along)[-1])
            low, high = edges[first] / KM, edges[last + 1] / KM
            margin = 0.05 * (high - low)
            limit(low - margin, high + margin)


def _two_areas(column: Column) -> tuple[Area, Area]:
    return column.tree, column.exact


def _times(axes: "Axes", area: Area, most: float) -> Any:
    """Time-to-converge in colour, with an isochrone a minute."""
    minutes = np.ma.masked_invalid(area.time.T / MINUTE)
    image = axes.pcolormesh(
        area.x / KM, area.y / KM, minutes, cmap="viridis_r", vmin=0.0, vmax=most, rasterized=True
    )
    middle = (0.5 * (edges[1:] + edges[:-1]) / KM for edges in (area.x, area.y))
    levels = np.arange(1.0, most, 1.0)
    lines = axes.contour(*middle, minutes, levels=levels, colors="white", linewidths=0.5)
    axes.clabel(lines, levels=levels[1::2].tolist(), fmt="%g", fontsize=6, inline_spacing=2)
    return image


def _losses(axes: "Axes", area: Area) -> Any:
    lost = np.ma.masked_invalid(area.time.T)
    return axes.pcolormesh(
        area.x / KM, area.y / KM, lost, cmap="magma_r", vmin=0.0, vmax=MOST_LOSS, rasterized=True
    )


def _landmarks(axes: "Axes", parameters: TreeParameters, heading: float) -> None:
    """The slot, the leader with its d_min, and which way the pursuer points."""
    encounter = parameters.encounter
    ahead, d_min = encounter.slot_distance / KM, encounter.min_separation / KM
    round_about = np.linspace(0.0, 2.0 * pi, 73)
    axes.plot(
        ahead + d_min * np.cos(round_about), d_min * np.sin(round_about), color=LEADER, lw=0.9
    )
    axes.plot([ahead], [0.0], marker=">", color=LEADER, ms=3.5, mec="white", mew=0.4)
    axes.plot([0.0], [0.0], marker="o", color="white", ms=3.5, mec=INK, mew=0.9)
    axes.set_aspect("equal")
    axes.set_facecolor("#f3f5f7")
    axes.tick_params(colors=INK, labelsize=8)
    for spine in axes.spines.values():
        spine.set_color(FAINT)
    at, length = (0.09, 0.09), 0.06
    axes.annotate(
        "",
        xy=(at[0] + length * cos(heading), at[1] + length * sin(heading)),
        xytext=(at[0] - length * cos(heading), at[1] - length * sin(heading)),
        xycoords="axes fraction",
        arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.2},
    )


def _heading(heading: float) -> str:
    degrees = whole_degrees(heading)
    if degrees == 0:
        return "on the leader's heading"
    if degrees == 180:
        return "on the opposite heading"
    side = "left" if degrees < 180 else "right"
    return f"{min(degrees, 360 - degrees)}° to the {side} of the leader's heading"
