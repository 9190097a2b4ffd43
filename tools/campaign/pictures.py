"""The pictures of docs/flight.md: step responses, and what became of the campaign."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from matplotlib.axes import Axes

from benchmarks.drawings import figure
from relguide.figures.style import BLUE, INK, ORANGE, PALE
from relguide.units import DEG
from tests.aloft import A306
from tools.campaign import responses

MARKS = {"o": "median", "|": "95 %", "d": "99 %", "x": "worst"}
"""So many flights are no worse; told apart in grey."""
TICKS = (0, 1, 10, 100, 1000)
"""Of how much later than promised flights join [%]."""
THIN = 10
"""One step in so many is drawn."""
SLUGGISH = replace(
    A306,
    max_roll_rate=0.7 * A306.max_roll_rate,
    roll_time_constant=1.3 * A306.roll_time_constant,
)
NIMBLE = replace(
    A306,
    max_roll_rate=1.3 * A306.max_roll_rate,
    roll_time_constant=0.7 * A306.roll_time_constant,
)


def draw_autopilot(file: Path) -> None:
    """Bank and heading."""
    with figure(file) as (_, (left, right)):
        _bank_steps(left)
        _heading_steps(right)


def draw_path(file: Path) -> None:
    """Back onto a path."""
    with figure(file) as (_, (left, right)):
        _path_steps(left, 25.0 * DEG, "Back onto a path, 25° of bank in hand")
        _path_steps(right, 2.5 * DEG, "2.5° in hand, in a turn")


def draw_campaign(figures: Sequence[Sequence[str]], file: Path) -> None:
    """What joining takes, and what is kept of d_min: from the median to the worst flight.

    Args:
        figures: lines of a table of `tables.DISTRIBUTION`, with the family before.
        file: where to.
    """
    families = list(dict.fromkeys(family for family, *_ in figures))
    with figure(file) as (_, (left, right)):
        _ranges(left, figures, families, "join over promise, %")
        left.set_title("Joins later than promised")
        left.set_xscale("symlog", linthresh=1.0, linscale=0.5)
        left.set_xlim(-0.5, 4000.0)
        left.set_xticks(TICKS, [f"{tick:,}" for tick in TICKS])
        left.set_xlabel("time over the promise [%]")
        _ranges(right, figures, families, "least separation, d_min")
        right.set_title("Least separation")
        right.axvline(1.0, ymax=0.9, color=INK, lw=0.8)
        right.set_xlabel("of a flight [d_min]")
        right.legend(loc="upper center", ncols=len(MARKS), frameon=False, fontsize=8)


def _ranges(
    axes: Axes, figures: Sequence[Sequence[str]], families: Sequence[str], name: str
) -> None:
    """A line a family, with a mark for each share of its flights."""
    for family, told, *numbers in figures:
        if told != name:
            continue
        height = -families.index(family)
        shares = [float(number) for number in numbers[2:6]]
        axes.plot((shares[0], shares[-1]), (height, height), color=PALE, lw=1.0)
        for share, (mark, label) in zip(shares, MARKS.items(), strict=True):
            named = label if height == 0 else None
            axes.plot(share, height, mark, color=BLUE, mfc="white", ms=6, ls="none", label=named)
    axes.set_yticks([-i for i in range(len(families))], families)
    axes.set_ylim(-len(families) + 0.5, 1.2)  # the names of the marks stand on top
    axes.grid(visible=False, axis="y")


def _bank_steps(axes: Axes) -> None:
    axes.set_title("To a bank")
    for before, colour, dashes in ((0.0, BLUE, "-"), (-25.0, ORANGE, "--")):
        low, high, plain = (
            responses.bank_step(before * DEG, 25.0 * DEG, model=model)
            for model in (SLUGGISH, NIMBLE, A306)
        )
        axes.fill_between(
            plain.t[::THIN],
            low.bank[::THIN] / DEG,
            high.bank[::THIN] / DEG,
            color=colour,
            alpha=0.2,
            linewidth=0.0,
        )
        name = f"{before:.0f}° to 25°".replace("-", "−")
        axes.plot(plain.t, plain.bank / DEG, color=colour, ls=dashes, label=name)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("bank [°]")
    axes.legend(frameon=False)


def _heading_steps(axes: Axes) -> None:
    axes.set_title("To a heading")
    for tas, colour, dashes in ((240.0, BLUE, "-"), (120.0, ORANGE, "--")):
        for change in (5.0, 30.0, 90.0):
            response = responses.heading_step(change * DEG, tas=tas)
            t, heading = response.t[::THIN], response.heading[::THIN] / DEG
            name = f"{tas:.0f} m/s" if change == 5.0 else None
            axes.plot(t, heading, color=colour, ls=dashes, label=name)
    axes.set_xlim(0.0, 120.0)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("heading [°]")
    axes.legend(frameon=False)


def _path_steps(axes: Axes, in_hand: float, title: str) -> None:
    axes.set_title(title)
    for tas, colour in ((240.0, BLUE), (120.0, ORANGE)):
        for across in (100.0, 300.0, 1000.0):
            response = responses.path_step(across, tas=tas, in_hand=in_hand)
            name = f"{tas:.0f} m/s (both coincide)" if across == 100.0 else None
            dashes = (None, None) if tas == 240.0 else (4.0, 3.0)
            axes.plot(
                response.t[::THIN],
                response.across[::THIN],
                color=colour,
                dashes=dashes,
                label=name,
            )
    axes.set_xlabel("time [s]")
    axes.set_ylabel("cross-track [m]")
    axes.legend(frameon=False)
