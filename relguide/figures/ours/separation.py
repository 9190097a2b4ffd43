"""The price of separation: how much later a plan joins for keeping d_min."""

from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.results import read_results
from relguide.figures.style import (
    BLUE,
    GREEN,
    INK,
    LIMIT_FILL,
    LOOKS,
    ORANGE,
    aircraft,
    as_map,
    empty_figure,
)
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import candidates
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLE, MAKER = "cost_of_limit.csv", "make planner-figures"
EXAMPLE = Situation(
    pursuer=Pursuer(x=14_000.0, y=28_000.0, heading=180.0 * DEG, tas=235.0, max_bank=25.0 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
    slot_distance=12_000.0,
    min_separation=5.0 * NM,
)
"""Ahead of its leader, whose circle lies on the way to the slot."""


def draw(step: Step) -> Drawn:
    """One situation as its leader sees it, and the distribution of what d_min costs."""
    del step
    planned = plan(EXAMPLE)
    assert isinstance(planned, Plan)
    free = next(candidates(EXAMPLE).later).trajectory
    figure = empty_figure(9.5, 4.4)
    left, right = figure.subplots(1, 2)
    _seen_from_leader(left, planned, free)
    rows = read_results(TABLE)
    shares = np.array([float(row["name"]) for row in rows])
    medians = []
    for kind, look in zip(list(rows[0])[1:], LOOKS, strict=False):
        cost = np.array([float(row[kind]) for row in rows])
        right.plot(cost, shares, color=look.colour, ls=look.dashes, label=kind)
        middle = float(np.interp(50.0, shares, cost))
        right.plot(middle, 50.0, look.mark, color=look.colour, ms=6)
        medians.append(f"{middle:.0f} s where {kind}")
    right.set_title("where d_min binds: what it costs")
    right.set_xscale("log")
    right.set_xlim(0.1, 2000.0)
    ticks = (0.1, 1.0, 10.0, 100.0, 1000.0)
    right.set_xticks(ticks, [f"{tick:,g}" for tick in ticks])
    right.set_ylim(0.0, 100.0)
    right.set_xlabel("joins later than without the limit [s]")
    right.set_ylabel("situations, up to so much [%]")
    right.legend(loc="upper left", frameon=False)
    later = planned.time_to_converge - free.duration
    return Drawn(
        figure,
        f"Left: a plan that keeps {EXAMPLE.min_separation / NM:.0f} NM joins {later:.0f} s later "
        f"than the path without the limit ({planned.word}, "
        f"{planned.time_to_converge:.0f} s; least separation "
        f"{planned.certificate.least_separation / NM:.2f} NM, proved). Right: the median costs "
        f"{' and '.join(medians)}. `{TABLE}`, made by `{MAKER}`.",
    )


def _seen_from_leader(axes: "Axes", planned: Plan, free: Trajectory) -> None:
    from matplotlib.patches import Circle

    as_map(axes, "NM")
    axes.set_title("one situation, seen from the leader")
    axes.set_xlabel("right of the leader [NM]")
    axes.set_ylabel("ahead of it [NM]")
    limit = EXAMPLE.min_separation / NM
    axes.add_patch(Circle((0.0, 0.0), limit, fc=LIMIT_FILL, ec=ORANGE, lw=1.0))
    axes.text(0.0, 0.42 * limit, "d < d_min", ha="center", color=ORANGE)
    for path, look, name in (
        (free, LOOKS[1], f"without the limit: {free.duration:.0f} s"),
        (planned.trajectory, LOOKS[0], f"the plan: {planned.time_to_converge:.0f} s"),
    ):
        times = np.linspace(0.0, path.duration, 240)
        poses = [path.pose_at(float(t)) for t in times]
        x = np.array([p.x for p in poses]) / NM
        y = (np.array([p.y for p in poses]) - EXAMPLE.leader.tas * times) / NM
        axes.plot(x, y, color=look.colour, ls=look.dashes, label=name)
    own = EXAMPLE.pursuer
    aircraft(axes, own.x / NM, own.y / NM, own.heading / DEG, BLUE)
    aircraft(axes, 0.0, 0.0, 0.0, INK)
    axes.plot(0.0, -EXAMPLE.slot_distance / NM, "D", color=GREEN, mfc="white", ms=7, mew=1.5)
    axes.annotate(
        "slot", (0.0, -EXAMPLE.slot_distance / NM), (9, -3), textcoords="offset points", color=GREEN
    )
    axes.legend(loc="upper left")


FIGURE = NamedFigure(
    name="separation", title="What keeping the separation costs", seconds=1.0, draw=draw
)
