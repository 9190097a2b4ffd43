"""The pictures of docs/planner.md: pure functions of what was measured."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import cos, radians, sin
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from benchmarks.sweep import Sweep, from_leader
from relguide import Situation, Trajectory
from relguide.figures.drawn import Drawn, as_png, as_svg
from relguide.figures.style import BLUE, GREEN, INK, ORANGE, PURPLE, empty_figure, house_style
from relguide.units import NM

WIDTH, HEIGHT = 9.0, 4.1
"""Of a figure [in]."""

Floats = NDArray[np.float64]


@contextmanager
def figure(file: Path) -> Iterator[tuple[Figure, Sequence[Axes]]]:
    """Two pictures side by side, saved at the end."""
    with house_style():
        drawn = empty_figure(WIDTH, HEIGHT)
        yield drawn, drawn.subplots(1, 2)
        file.write_bytes((as_png if file.suffix == ".png" else as_svg)(Drawn(drawn, "")))


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
    for side, colour, dashes, label in (
        (-1.0, BLUE, "-", "passing clockwise round the leader"),
        (1.0, PURPLE, (0, (4, 1)), "passing counter-clockwise"),
    ):
        cost = drawn.arrivals[side] - fastest
        # a line across a jump would show ways that do not exist
        jumps = np.flatnonzero(np.abs(np.diff(cost)) > 0.04 * np.nanmax(cost))
        bearings = np.insert(drawn.bearings, jumps + 1, np.nan)
        drawn_cost = np.insert(cost, jumps + 1, np.nan)
        axes.plot(bearings, drawn_cost, color=colour, ls=dashes, label=label)
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
