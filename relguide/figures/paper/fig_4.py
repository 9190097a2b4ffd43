"""Fig. 4: the convergence area, from the tree of reverse dynamic programming and exactly."""

import numpy as np

from relguide.figures.area_figure import TWO_A300, areas_figure, column_of
from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.learn.tree.reverse_dp import grow_order, plant, tree_from
from relguide.learn.tree.tree import TreeParameters
from relguide.maps.area import Floats, exact_times
from relguide.units import DEG

PARAMETERS = TreeParameters(
    encounter=TWO_A300,
    order=4,
    delta_theta=10.0 * DEG,
    delta_l=1000.0,
    cell=2000.0,
    horizon=600.0,
)
"""As `relguide area` has it: two A300 over 10 minutes."""
HEADINGS = (0, 6, 12, 18)
"""Shown, in Δθ left of the leader's."""
NEAR = 1.0
"""A path that loses no more is as good as the exact one [s]."""
GROWING = 0.1
"""Share of the work that is the tree; exact plans are the rest."""


def draw(step: Step, parameters: TreeParameters = PARAMETERS) -> Drawn:
    """A column for each heading: the tree's times, the exact ones, and what the tree loses."""
    growth = plant(parameters)
    while not growth.finished:
        *_, growth = grow_order(growth)
        step(GROWING / (parameters.order - 1))
    tree = tree_from(growth, {})
    each = (1.0 - GROWING) / (2 * len(HEADINGS))

    def exact_from(x: Floats, y: Floats, heading: Floats, title: str) -> Floats:
        del title
        times = exact_times(
            parameters.encounter, x, y, heading, progress=lambda n: step(each * n / len(x))
        )
        return times.time_to_converge

    columns = [column_of(tree, number % parameters.headings, exact_from) for number in HEADINGS]
    lost = np.concatenate([column.loss.time[np.isfinite(column.loss.time)] for column in columns])
    fastest = float(np.mean(lost <= NEAR))
    return Drawn(
        areas_figure(columns, tree),
        f"{tree.laid / 1e6:.1f} million regular trajectories of order ≤ {parameters.order} laid "
        f"back leave {len(tree.minima):,} states. Of those shown {100.0 * fastest:.0f} % are "
        f"within {NEAR:g} s of the exact time; the median loses "
        f"{np.median(lost):.1f} s, one in twenty more than {np.quantile(lost, 0.95):.0f} s.",
    )


FIGURE = NamedFigure(name="fig_4", title="Fig. 4: the convergence area", seconds=6.0, draw=draw)
