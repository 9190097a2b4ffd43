"""Our planner against its peers: what an answer takes, and how often it is late."""

from typing import TYPE_CHECKING, NamedTuple

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.results import read_results
from relguide.figures.style import BLUE, ORANGE, PALE, empty_figure

if TYPE_CHECKING:
    pass

WITHOUT, WITH, MAKER = "without_limit.csv", "with_limit.csv", "make planner-figures"
OURS = ("kernel", "plan()")
"""How the names of our own rows begin."""


class Row(NamedTuple):
    """Answers of one kind."""

    name: str
    median: float
    late: float
    """99 % take no longer; CPU time, as the median [s]."""
    wrong: float
    """Not within a tenth of a second (without the limit) or a second (with it) of the best [%]."""


def draw(step: Step) -> Drawn:
    """A line for each planner, in two parts: without the limit and where it binds."""
    del step
    parts = (
        [
            Row(
                row["name"], 1e-6 * float(row["median µs"]), 1e-6 * float(row["99 % µs"]),
                100.0 * int(row["off by > 0.1 s"]) / int(row["cases"]),
            )
            for row in read_results(WITHOUT)
        ],
        [
            Row(
                row["name"], 1e-3 * float(row["median ms"]), 1e-3 * float(row["99 % ms"]),
                100.0 - float(row["to 1 s"].rstrip("%")),
            )
            for row in read_results(WITH)
        ],
    )  # fmt: skip
    heights = {
        row: -float(i + k) for k, part in enumerate(parts) for i, row in _numbered(part, parts, k)
    }
    figure = empty_figure(11.0, 4.6)
    left, right = figure.subplots(1, 2, sharey=True, gridspec_kw={"width_ratios": [1.5, 1.0]})
    for row, y in heights.items():
        ours = row.name.startswith(OURS)
        colour, face = (BLUE, BLUE) if ours else (ORANGE, "white")
        left.plot((row.median, row.late), (y, y), color=colour, lw=2.2, ls="-" if ours else "--")
        left.plot(row.median, y, "o" if ours else "s", color=colour, mfc=face, ms=6, zorder=5)
        left.annotate(
            time_in_words(row.median), (row.median, y), (-7, -3), textcoords="offset points",
            ha="right", color=colour, fontsize=8,
        )  # fmt: skip
        right.barh(
            y, row.wrong, height=0.55, color=face, edgecolor=colour, hatch="" if ours else "////",
            lw=0.8,
        )  # fmt: skip
        right.text(row.wrong + 0.8, y, f"{row.wrong:.0f} %", va="center", fontsize=8)
    left.set_yticks(list(heights.values()), [row.name for row in heights], fontsize=8)
    left.set_xscale("log")
    left.set_xlim(4e-7, 60.0)
    ticks = {1e-6: "1 µs", 1e-4: "100 µs", 1e-2: "10 ms", 1.0: "1 s"}
    left.set_xticks(list(ticks), list(ticks.values()))
    left.set_xlabel("CPU time of an answer, median to 99 %")
    left.set_title("filled: ours")
    right.set_title("answers later than the best known")
    right.set_xlabel("[%]")
    right.set_xlim(0.0, 48.0)
    split = -float(len(parts[0])) + 0.0
    for axes in (left, right):
        axes.axhline(split, color=PALE, lw=0.8)
        axes.grid(visible=False, axis="y")
    for y, words in (
        (0.75, "without the limit: by over 0.1 s"),
        (split - 0.42, "where d_min binds: by over 1 s"),
    ):
        right.text(47.5, y, words, ha="right", va="center", fontsize=8, style="italic")
    right.set_ylim(min(heights.values()) - 0.7, 1.2)
    counts = {row["name"]: row["cases"] for row in read_results(WITH)}
    return Drawn(
        figure,
        f"Without the limit {read_results(WITHOUT)[0]['cases']} cases, where it binds "
        f"{sum(int(n) for name, n in counts.items() if name.startswith(OURS))}; CPU seconds of one "
        f"machine. `{WITHOUT}` and `{WITH}`, made by `{MAKER}`.",
    )


def time_in_words(seconds: float) -> str:
    """A time with its unit, to two digits or so."""
    size, unit = (1.0, "s") if seconds >= 1.0 else (1e-3, "ms") if seconds >= 1e-3 else (1e-6, "µs")
    value = seconds / size
    return f"{value:.0f} {unit}" if value >= 10.0 else f"{value:.1f} {unit}"


def _numbered(part: list[Row], parts: tuple[list[Row], ...], k: int) -> "list[tuple[int, Row]]":
    """Rows with their number among all parts."""
    first = sum(len(one) for one in parts[:k])
    return list(enumerate(part, start=first))


FIGURE = NamedFigure(name="planners", title="Our planner against its peers", seconds=1.0, draw=draw)
