"""The pictures of docs/flight.md: step responses, and the distributions of the campaign."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from benchmarks.drawings import BLUE, GREEN, ORANGE, PURPLE, figure
from relguide.units import DEG
from tests.aloft import A306
from tools.campaign import responses
from tools.campaign.row import FIGURES, Row
from tools.campaign.tables import by_family

COLOURS = (BLUE, ORANGE, GREEN, PURPLE)
DASHES = ("-", (0, (5, 2)))
"""Each colour is used solid and dashed: eight lines, and …"""
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
"""… each has a mark of its own, so that they are told apart in grey."""
TICKS = (-100, -10, -1, 0, 1, 10, 100, 1000)
"""Of how much later than promised flights join [%]: a half is within 1, some ten times as late."""
MARK_EVERY = 0.12
"""Of the length of a line."""
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


def draw_campaign(rows: Sequence[Row], file: Path) -> None:
    """What joining takes, and what is kept of d_min."""
    with figure(file) as (_, (left, right)):
        promised = any(row.join_over_promise is not None for row in rows)
        _shares(left, rows, "join_over_promise" if promised else "join_over_plan")
        left.set_xscale("symlog", linthresh=1.0, linscale=0.5)
        left.set_xlim(-100.0, 3000.0)
        left.set_xticks(TICKS, [f"{tick:,}".replace("-", "−") for tick in TICKS])
        left.set_title("Joining")
        _shares(right, rows, "least_share")
        right.set_xlim(0.0, 2.0)
        right.set_title("Separation")
        right.legend(frameon=False)


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


def _shares(axes: Axes, rows: Sequence[Row], name: str) -> None:
    """Share of flights with at most so much of a figure, a line a family."""
    (drawn,) = (one for one in FIGURES if one.name == name)
    for k, (family, own) in enumerate(by_family(rows)):
        values = np.sort([value for value, _ in drawn.values(own)])
        if len(values):
            share = np.arange(1, len(values) + 1) / len(values)
            # marks of two lines do not fall on each other
            first = MARK_EVERY * (k % len(MARKERS)) / len(MARKERS)
            axes.plot(
                values,
                100.0 * share,
                color=COLOURS[k % len(COLOURS)],
                ls=DASHES[k // len(COLOURS) % len(DASHES)],
                marker=MARKERS[k % len(MARKERS)],
                markevery=(first, MARK_EVERY),
                ms=4,
                label=family,
            )
    axes.set_xlabel(drawn.heading)
    axes.set_ylabel("flights, %")
