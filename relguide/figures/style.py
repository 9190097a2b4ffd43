"""How all figures look: fonts, colours, dashes and marks that differ in grey as well."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BLUE, ORANGE, GREEN, PURPLE = "#0072b2", "#d55e00", "#009e73", "#aa5a8c"
"""Told apart by colour-blind eyes too (Okabe and Ito)."""
INK, PALE, FAINT = "#222222", "#8a8a8a", "#e6e6e6"
LIMIT_FILL = "#f3ddd2"
"""Inside d_min."""
DOTS = 150
"""Of a PNG [dots an inch]."""
RC: Any = {
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
    "axes.axisbelow": True,
    "grid.color": FAINT,
    "grid.linewidth": 0.6,
    "legend.fontsize": 8,
    "legend.frameon": True,
    "legend.framealpha": 0.9,
    "legend.edgecolor": "none",
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "relguide",  # the same picture, the same file
    "svg.fonttype": "none",  # letters stay letters
}


class Look(NamedTuple):
    """Of a line: its colour, and what tells it apart in grey."""

    colour: str
    dashes: str
    mark: str


LOOKS = (
    Look(BLUE, "-", "o"),
    Look(ORANGE, "--", "s"),
    Look(GREEN, "-.", "^"),
    Look(PURPLE, ":", "d"),
    Look(PALE, (0, (6, 2)), "v"),  # type: ignore[arg-type]
)
"""Ours first."""


@contextmanager
def house_style() -> Iterator[None]:
    """Within it matplotlib draws as all our figures look."""
    from matplotlib import rc_context

    with rc_context(RC):
        yield


def empty_figure(width: float, height: float) -> "Figure":
    """A figure without axes [inch]."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    figure = Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(wspace=0.05))
    FigureCanvasAgg(figure)
    return figure


def as_map(axes: "Axes", unit: str = "km") -> None:
    """To scale, north up."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"east [{unit}]")
    axes.set_ylabel(f"north [{unit}]")


def without_frame(axes: "Axes") -> None:
    """For diagrams: no ticks, no grid."""
    axes.set_axis_off()
    axes.set_aspect("equal", adjustable="box")


def aircraft(axes: "Axes", x: float, y: float, heading_deg: float, colour: str = INK) -> None:
    """A dart that points where the aircraft does.

    Args:
        axes: a map, north up.
        x: its place on them.
        y: the same, to the north.
        heading_deg: clockwise from north.
        colour: of it.
    """
    from matplotlib.markers import MarkerStyle
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    dart = Path([(0.0, 1.0), (0.62, -0.75), (0.0, -0.35), (-0.62, -0.75), (0.0, 1.0)], closed=True)
    marker = MarkerStyle(dart, transform=Affine2D().rotate_deg(-heading_deg))
    axes.plot([x], [y], marker=marker, color=colour, mec="white", mew=0.6, ms=18, zorder=6, ls="")
