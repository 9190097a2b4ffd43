"""The distributions of a campaign's figures: how many flights are no worse than a value."""

from collections.abc import Mapping, Sequence
from itertools import chain, cycle
from math import ceil
from pathlib import Path

import numpy as np

from relguide.figures.area_figure import INK
from relguide.figures.style import LOOKS, house_style

WIDTH, HEIGHT, COLUMNS = 4.2, 2.6, 3
"""Of a panel [inch], and panels in a row."""


def draw_distributions(figures: Mapping[str, Mapping[str, Sequence[float]]], file: Path) -> None:
    """Draw a panel for each figure, a line for each point of the sweep, and write it.

    Args:
        figures: values by the figure's heading and the point's name; what is always the same is
            left out.
        file: where to; its suffix says as what.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    shown = {heading: own for heading, own in figures.items() if len(set(chain(*own.values()))) > 1}
    rows = max(ceil(len(shown) / COLUMNS), 1)
    with house_style():
        figure = Figure(figsize=(WIDTH * COLUMNS, HEIGHT * rows + 0.4), layout="constrained")
        FigureCanvasAgg(figure)
        for i, (heading, own) in enumerate(shown.items(), 1):
            panel = figure.add_subplot(rows, COLUMNS, i)
            for (name, values), look in zip(own.items(), cycle(LOOKS)):
                ranked = np.sort(values)
                share = np.arange(1, len(ranked) + 1) / max(len(ranked), 1)
                panel.step(
                    ranked, 100.0 * share, where="post", label=name, lw=1.2,
                    color=look.colour, ls=look.dashes,
                )  # fmt: skip
            panel.set_title(heading, color=INK)
            panel.set_ylim(0.0, 100.0)
            panel.set_ylabel("flights, % up to")
        for panel in figure.axes[:1]:
            lines = panel.get_legend_handles_labels()
            figure.legend(*lines, loc="outside lower center", ncols=4, frameon=False)
        unmarked = {"metadata": {"Date": None}} if file.suffix.lower() == ".svg" else {}
        figure.savefig(file, **unmarked)  # type: ignore[arg-type]
