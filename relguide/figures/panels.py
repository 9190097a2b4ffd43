"""Two panels side by side, as the pictures of audits have them: shares with their intervals."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.area_figure import FAINT, INK
from relguide.figures.drawn import Drawn, as_svg
from relguide.figures.style import house_style
from relguide.learn.training.shares import Share
from relguide.learn.words.branch_labels import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#1a6fb4", "#8a6d3b", "#c2185b", "#5b8c2a")
"""Of the methods side by side, ours first."""
MARKS = ("o", "s", "^", "D")
DASHES = ("-", "--", "-.", ":")
"""Lines told apart in grey as well."""
PERCENT = 100.0


def write_figures(draw: Mapping[str, "Callable[[], Figure]"], folder: Path) -> list[Path]:
    """Draw figures into files, and give these.

    Args:
        draw: what draws each, by the name of its file.
        folder: where to; it must exist.
    """
    with house_style():
        for name, figure in draw.items():
            (folder / name).write_bytes(as_svg(Drawn(figure(), "")))
    return [folder / name for name in draw]


def two_panels(title: str) -> tuple["Figure", "tuple[Axes, Axes]"]:
    """A figure, and its two halves."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 4.8), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(title, color=INK, fontsize=13)
    left, right = figure.subplots(1, 2)
    for axes in (left, right):
        axes.grid(color=FAINT, alpha=0.3, lw=0.5)
        axes.tick_params(colors=INK)
        for spine in axes.spines.values():
            spine.set_color(FAINT)
    return figure, (left, right)


def shares_across(
    axes: "Axes", shares: Sequence[Share], at: Sequence[float], colour: str, mark: str,
    name: str = "",
) -> None:  # fmt: skip
    """Shares [%] along x with their intervals, a line each; a share of nothing has no line."""
    there = [(share, y) for share, y in zip(shares, at, strict=True) if share.of]
    middle = np.array([share.value for share, _ in there])
    axes.errorbar(
        PERCENT * middle, [y for _, y in there], xerr=_bars([share for share, _ in there]),
        fmt=mark, ms=4, color=colour, elinewidth=1.0, capsize=2.0, label=name,
    )  # fmt: skip


def rates_over(axes: "Axes", x: Sequence[float], shares: Sequence[Share], name: str) -> None:
    """Small shares [%] over x, with intervals; the upper bound where nothing was met."""
    across, middle, bars = np.array(x), np.array([share.value for share in shares]), _bars(shares)
    met = middle > 0.0
    axes.errorbar(
        across[met], PERCENT * middle[met], yerr=bars[:, met], fmt="o", ms=4, color=COLOURS[0],
        elinewidth=1.0, capsize=2.0, label=name,
    )  # fmt: skip
    if not met.all():
        axes.plot(
            across[~met], (PERCENT * middle + bars[1])[~met], "v", mfc="none", ms=5,
            color=COLOURS[0], label="none met: at most so often",
        )  # fmt: skip


def _bars(shares: Sequence[Share]) -> Floats:
    """How far intervals reach below and above their shares [%], shape (2, n)."""
    reach = [(share.value - share.interval[0], share.interval[1] - share.value) for share in shares]
    bars: Floats = PERCENT * np.maximum(np.array(reach).reshape(-1, 2).T, 0.0)
    return bars


def logarithmic(axes: "Axes", x: str, y: str) -> None:
    """Both axes by powers of ten, and what they are called."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(x, color=INK)
    axes.set_ylabel(y, color=INK)
