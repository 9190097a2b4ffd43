"""The pictures of docs/planner.md: pure functions of what was measured."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patches import Circle
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from benchmarks.sweep import Sweep, from_leader
from relguide import Situation, Trajectory
from relguide.units import NM

BLUE, ORANGE, GREEN, PURPLE = "#0072b2", "#d55e00", "#009e73", "#aa5a8c"
"""Told apart by colour-blind eyes too (Okabe and Ito)."""
INK, PALE = "#222222", "#8a8a8a"
STYLE: Any = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": PALE,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.grid": True,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "relguide",  # the same picture, the same file
}
WIDTH, HEIGHT = 9.0, 4.1
"""Of a figure [in]."""
QUANTILES = np.linspace(0.0, 1.0, 201)
"""A distribution is drawn through these."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Spread:
    """What answers of one kind take."""

    name: str
    ours: bool
    median: float
    late: float
    """99 % take no longer; CPU time, as the median [s]."""


@contextmanager
def figure(file: Path) -> Iterator[tuple[Figure, Sequence[Axes]]]:
    """Two pictures side by side, saved at the end."""
    matplotlib.use("Agg")
    with plt.rc_context(STYLE):
        layout = ConstrainedLayoutEngine(wspace=0.08)
        drawn, axes = plt.subplots(1, 2, figsize=(WIDTH, HEIGHT), layout=layout)
        yield drawn, axes
        metadata = {"Date": None} if file.suffix == ".svg" else None
        drawn.savefig(file, metadata=metadata, dpi=110)
        plt.close(drawn)


def seen_from_leader(axes: Axes, drawn: Sweep) -> None:
    """A case in the leader's frame: the unlimited optimum, the plan, and the circle d = d_min."""
    situation, plan = drawn.case.situation, drawn.chosen
    limit = situation.min_separation / NM
    axes.set_title("Seen from the leader")
    axes.add_patch(Circle((0.0, 0.0), limit, facecolor="#f3ddd2", edgecolor=ORANGE, lw=1.0))
    axes.annotate("d < d_min", (-1.1 * limit, 0.0), ha="right", va="center", color=ORANGE)
    free = drawn.unlimited
    axes.plot(*_places_from_slot(situation, free), color=ORANGE, dashes=(4, 2))
    axes.plot(*_places_from_slot(situation, plan.trajectory), color=BLUE)
    angle = radians(drawn.contact)
    axes.plot(limit * sin(angle), limit * cos(angle), "o", color=INK, ms=6, zorder=5)
    _aircraft(axes, 0.0, 0.0, 0.0, "leader", (7, -3))
    start = situation.pursuer
    x, y = (value / NM for value in from_leader(situation, plan.trajectory, 0.0))
    _aircraft(axes, x, y, start.heading - situation.leader.heading, "pursuer", (8, 4))
    axes.plot(0.0, -situation.slot_distance / NM, "D", color=GREEN, ms=6, zorder=5)
    axes.annotate(
        "slot", (0.0, -situation.slot_distance / NM), (8, -3), textcoords="offset points",
        color=GREEN,
    )  # fmt: skip
    later = plan.time_to_converge - free.duration
    axes.plot(
        [], [], color=ORANGE, dashes=(4, 2), label=f"without the limit, {free.duration:.0f} s"
    )
    axes.plot([], [], color=BLUE, label=f"the plan, {later:.0f} s later")
    axes.plot([], [], "o", color=INK, ms=6, label="contact with d = d_min")
    axes.legend(loc="best", frameon=True, framealpha=0.9, edgecolor="none", fontsize=8)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("right of the leader [NM]")
    axes.set_ylabel("ahead of it [NM]")


def arrival_by_bearing(axes: Axes, drawn: Sweep) -> None:
    """What the search minimises: the cost of a contact by where it is."""
    fastest = drawn.unlimited.duration
    axes.set_title("What it costs to touch it elsewhere")
    for side, colour, label in (
        (-1.0, BLUE, "passing clockwise round the leader"),
        (1.0, PURPLE, "passing counter-clockwise"),
    ):
        cost = drawn.arrivals[side] - fastest
        # a line across a jump would show ways that do not exist
        jumps = np.flatnonzero(np.abs(np.diff(cost)) > 0.04 * np.nanmax(cost))
        bearings = np.insert(drawn.bearings, jumps + 1, np.nan)
        axes.plot(bearings, np.insert(cost, jumps + 1, np.nan), color=colour, label=label)
    at = drawn.contact, drawn.chosen.time_to_converge - fastest
    axes.plot(*at, "o", color=INK, ms=6, zorder=5)
    axes.annotate(
        f"the plan: {drawn.contact:.0f}°, +{at[1]:.0f} s", at, (10, -4),
        textcoords="offset points", fontsize=8,
    )  # fmt: skip
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks(range(-180, 181, 60))
    axes.set_ylim(0.0, 1.25 * float(np.nanmax([*drawn.arrivals.values()]) - fastest))
    axes.set_xlabel("bearing of the contact from the leader's nose [°]")
    axes.set_ylabel("arrival later than without the limit [s]")
    axes.legend(loc="upper left", frameon=True, framealpha=0.9, edgecolor="none", fontsize=8)


def cost_of_the_limit(axes: Axes, shares: Floats, costs: dict[str, Floats]) -> None:
    """How much later a plan arrives for keeping d_min: at most so much [s] in a share [%]."""
    axes.set_title("What the limit costs")
    looks = (BLUE, "-", (-7, 4), "right"), (ORANGE, "--", (7, -10), "left")
    for (name, cost), (colour, line, offset, side) in zip(costs.items(), looks, strict=True):
        axes.plot(cost, shares, color=colour, ls=line, label=name)
        middle = float(np.interp(50.0, shares, cost))
        axes.plot(middle, 50.0, "o", color=colour, ms=5)
        axes.annotate(
            f"{middle:.0f} s", (middle, 50.0), offset, textcoords="offset points", ha=side,
            color=colour,
        )  # fmt: skip
    axes.set_xscale("log")
    axes.set_xlim(0.1, 2000.0)
    axes.set_ylim(0.0, 100.0)
    _ticks(axes, {0.1: "0.1", 1.0: "1", 10.0: "10", 100.0: "100", 1000.0: "1,000"})
    axes.set_xlabel("arrival later than without the limit [s]")
    axes.set_ylabel("situations [%]")
    axes.legend(loc="upper left", frameon=False, fontsize=8)


def times(axes: Axes, spreads: Sequence[Spread]) -> None:
    """CPU times of an answer, from the median to the 99th percentile; ours are filled."""
    axes.set_title("What an answer takes: median to 99 %")
    ordered = sorted(spreads, key=lambda spread: -spread.median)
    for height, spread in enumerate(ordered):
        colour = BLUE if spread.ours else PALE
        axes.plot((spread.median, spread.late), (height, height), color=colour, lw=2.5)
        face = colour if spread.ours else "white"
        axes.plot(spread.median, height, "o", color=colour, mfc=face, ms=6, zorder=5)
        axes.annotate(
            time_in_words(spread.median), (spread.median, height), (-7, -3),
            textcoords="offset points", ha="right", color=colour, fontsize=8,
        )  # fmt: skip
    axes.set_yticks(range(len(ordered)), [spread.name for spread in ordered], fontsize=8)
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.grid(visible=False, axis="y")
    axes.set_ylim(-0.5, len(ordered) - 0.3)
    axes.set_xscale("log")
    axes.set_xlim(2e-7, 40.0)
    _ticks(axes, {1e-6: "1 µs", 1e-4: "100 µs", 1e-2: "10 ms", 1: "1 s"})
    axes.set_xlabel("CPU time")


def time_in_words(seconds: float) -> str:
    """A time with its unit, to two digits or so."""
    size, unit = (1.0, "s") if seconds >= 1.0 else (1e-3, "ms") if seconds >= 1e-3 else (1e-6, "µs")
    value = seconds / size
    return f"{value:.0f} {unit}" if value >= 10.0 else f"{value:.1f} {unit}"


def _ticks(axes: Axes, ticks: dict[float, str]) -> None:
    axes.set_xticks(list(ticks), list(ticks.values()))
    axes.xaxis.set_minor_locator(NullLocator())


def _places_from_slot(
    situation: Situation, trajectory: Trajectory
) -> tuple[list[float], list[float]]:
    times = np.linspace(0.0, trajectory.duration, 200)
    points = [from_leader(situation, trajectory, float(t)) for t in times]
    return [x / NM for x, _ in points], [y / NM for _, y in points]


def _aircraft(
    axes: Axes, x: float, y: float, heading: float, name: str, offset: tuple[int, int]
) -> None:
    marker = (3, 0, -np.degrees(heading))  # a triangle, its tip where the nose points
    axes.plot(x, y, marker=marker, color=INK, ms=10, zorder=5)
    axes.annotate(name, (x, y), offset, textcoords="offset points")
