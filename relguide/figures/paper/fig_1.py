"""Fig. 1: the geometry of relative positions, eqs. (1)–(3) and (7)."""

from math import atan2, cos, degrees, hypot, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PALE,
    aircraft,
    empty_figure,
    without_frame,
)
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
SITUATION = Situation(
    pursuer=Pursuer(x=0.0, y=0.0, heading=20.0 * DEG, tas=240.0, max_bank=25.0 * DEG),
    leader=Leader(x=26_000.0, y=14_000.0, heading=75.0 * DEG, tas=200.0),
    slot_distance=12_000.0,
    min_separation=5.0 * NM,
)
NORTH = 9.0
"""Length of the arrows to the north [km]."""


def draw(step: Step) -> Drawn:
    """Two aircraft, the line of sight, three angles from north, D and the slot."""
    del step
    figure = empty_figure(7.2, 4.6)
    axes = figure.subplots()
    without_frame(axes)
    p, l = SITUATION.pursuer, SITUATION.leader
    lx, ly = l.x / KM, l.y / KM
    ux, uy = sin(l.heading), cos(l.heading)
    far, behind = SITUATION.slot_distance / KM, 19.0
    bearing, d = atan2(l.x - p.x, l.y - p.y), hypot(l.x - p.x, l.y - p.y)
    axes.plot(
        [lx - behind * ux, lx + 13.0 * ux], [ly - behind * uy, ly + 13.0 * uy],
        color=PALE, ls=(0, (8, 3, 2, 3)), lw=1.2,
    )  # fmt: skip
    axes.text(
        lx - behind * ux,
        ly - behind * uy - 1.0,
        "the leader's route",
        color=PALE,
        ha="center",
        va="top",
    )
    axes.plot([0.0, lx], [0.0, ly], color=INK, lw=1.4)
    axes.text(0.5 * lx + 0.6, 0.5 * ly - 1.9, "$d$", fontsize=14)
    for x, y, heading, colour, name in (
        (0.0, 0.0, p.heading, BLUE, "P"),
        (lx, ly, l.heading, ORANGE, "L"),
    ):
        _north(axes, x, y)
        length = 11.0
        _arrow(axes, (x, y), (x + length * sin(heading), y + length * cos(heading)), colour)
        axes.text(
            x + length * sin(heading) + 1.3, y + length * cos(heading) + 1.0,
            f"$V_{name}$", color=colour, fontsize=13, ha="center", va="center",
        )  # fmt: skip
        aircraft(axes, x, y, degrees(heading), colour)
    _angle(axes, (0.0, 0.0), p.heading, 6.4, r"$\psi_P$", BLUE)
    _angle(axes, (0.0, 0.0), bearing, 4.0, r"$\theta$", INK)
    _angle(axes, (lx, ly), l.heading, 5.2, r"$\psi_L$", ORANGE)
    axes.text(-1.0, -2.0, "pursuer $P$", color=BLUE, fontsize=10, ha="center")
    axes.text(lx + 1.2, ly - 2.6, "leader $L$", color=ORANGE, fontsize=10)
    sx, sy = lx - far * ux, ly - far * uy
    off = 2.2
    axes.annotate(
        "", (lx - off * uy, ly + off * ux), (sx - off * uy, sy + off * ux),
        arrowprops={"arrowstyle": "<->", "color": GREEN, "lw": 1.1, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip
    axes.text(
        0.5 * (lx + sx) - 1.5 * off * uy, 0.5 * (ly + sy) + 1.5 * off * ux, "$D$",
        color=GREEN, fontsize=13, ha="center", va="center",
    )  # fmt: skip
    axes.plot(sx, sy, "D", color=GREEN, mfc="white", ms=8, mew=1.6, zorder=6)
    for x, y in ((sx, sy), (lx, ly)):
        axes.plot([x, x - 1.3 * off * uy], [y, y + 1.3 * off * ux], color=GREEN, lw=0.7)
    axes.text(sx + 0.3, sy - 2.4, "slot", color=GREEN, fontsize=10, ha="center")
    axes.plot([0.0, 5.0], [-4.2, -4.2], color=INK, lw=1.6)
    axes.text(2.5, -5.6, "5 km", ha="center")
    axes.set_xlim(-6.0, 41.0)
    axes.set_ylim(-6.4, 24.0)
    return Drawn(
        figure,
        f"d = {d / KM:.1f} km, θ = {degrees(bearing):.0f}°, ψ_P = {degrees(p.heading):.0f}°, "
        f"ψ_L = {degrees(l.heading):.0f}°, D = {far:.0f} km, to scale. All angles are clockwise "
        "from north; the pursuer joins where ψ_P = θ = ψ_L and d = D, eq. (7).",
    )


def _north(axes: "Axes", x: float, y: float) -> None:
    _arrow(axes, (x, y), (x, y + NORTH), PALE)
    axes.text(x, y + NORTH + 0.9, "N", color=PALE, ha="center", va="center")


def _arrow(axes: "Axes", start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
    axes.annotate(
        "", end, start,
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip


def _angle(
    axes: "Axes", at: tuple[float, float], to: float, radius: float, name: str, colour: str
) -> None:
    """An arc clockwise from north, and its name beside the middle."""
    swept = np.linspace(0.0, to, 60)
    axes.plot(at[0] + radius * np.sin(swept), at[1] + radius * np.cos(swept), color=colour, lw=1.2)
    tangent = to + 0.5 * pi
    end = at[0] + radius * sin(to), at[1] + radius * cos(to)
    axes.annotate(
        "", end, (end[0] - 0.1 * sin(tangent), end[1] - 0.1 * cos(tangent)),
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.0, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip
    middle, out = 0.55 * to, radius + 1.3
    axes.text(
        at[0] + out * sin(middle), at[1] + out * cos(middle), name,
        color=colour, fontsize=13, ha="center", va="center",
    )  # fmt: skip


FIGURE = NamedFigure(name="fig_1", title="Fig. 1: relative positions", seconds=0.5, draw=draw)
