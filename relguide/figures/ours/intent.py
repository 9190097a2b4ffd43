"""What knowing the leader's intent is worth: Fig. 6 flown for many times of its turn."""

from statistics import mean
from typing import TYPE_CHECKING

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.results import read_results
from relguide.figures.style import LOOKS, ORANGE, Look, empty_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLE, MAKER = "intent.csv", "python -m benchmarks.intent"
KNOWN, UNKNOWN = "intent known", "intent unknown"
Row = dict[str, str]


def draw(step: Step) -> Drawn:
    """When each way joins, and how much it turns, by when the leader turns."""
    del step
    rows = read_results(TABLE)
    ways = list(dict.fromkeys(row["guidance"] for row in rows))
    figure = empty_figure(9.5, 4.2)
    left, right = figure.subplots(1, 2)
    left.set_title("joins after [s]")
    right.set_title("heading swing until joined [°]")
    for way, look in zip(ways, LOOKS, strict=True):
        flown = [row for row in rows if row["guidance"] == way and row["joined, s"]]
        _line(left, flown, "joined, s", way, look)
        _line(right, flown, "swing, °", way, look)
    left.annotate(
        "hollow: joined\nbefore the turn", (890.0, 795.0), ha="right", fontsize=8, color=ORANGE
    )
    for axes in (left, right):
        axes.set_xlabel("the leader turns at [s]")
        axes.set_xlim(0.0, 900.0)
    right.set_ylim(0.0, 290.0)  # the names of the ways stand on top
    right.legend(loc="upper left", frameon=False)
    return Drawn(figure, f"{_told(rows)} `{TABLE}`, made by `{MAKER}`.")


def _line(axes: "Axes", flown: list[Row], column: str, name: str, look: Look) -> None:
    """A line for those joined after the turn, hollow marks for those before."""
    for before in (False, True):
        points = [
            (float(row["leader turns, s"]), float(row[column]))
            for row in flown
            if (row["before the turn"] == "yes") == before
        ]
        axes.plot(
            [x for x, _ in points], [y for _, y in points], look.mark,
            ls="none" if before else look.dashes, color=look.colour,
            mfc="white" if before else look.colour, ms=4, lw=1.2,
            label=None if before else name,
        )  # fmt: skip


def _told(rows: list[Row]) -> str:
    """Over the turns that come before any of the ways has joined."""
    early = {row["leader turns, s"] for row in rows if row["before the turn"] == "yes"}
    times = {
        way: {
            row["leader turns, s"]: float(row["joined, s"])
            for row in rows
            if row["guidance"] == way and row["leader turns, s"] not in early
        }
        for way in (KNOWN, UNKNOWN)
    }
    later = [100.0 * (times[UNKNOWN][t] / known - 1.0) for t, known in times[KNOWN].items()]
    losses = sum(int(row["losses"]) for row in rows)
    return (
        f"{len(rows)} flights. Without the intent ours joins {mean(later):.1f} % later on average, "
        f"{max(later):.1f} % at most, over {len(later)} turns; losses of separation in all: "
        f"{losses}."
    )


FIGURE = NamedFigure(
    name="intent", title="What the leader's intent is worth", seconds=1.0, draw=draw
)
