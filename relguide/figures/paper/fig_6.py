"""Figs. 6a and 6b: paths, heading, separation and bank, without and with the leader's intent."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.flights import Flown, flown
from relguide.figures.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    Look,
    aircraft,
    as_map,
    empty_figure,
)
from relguide.flying.guidances import Guidance
from relguide.flying.scenarios import LEADER_TURNS_AT, fig_6
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
LEADER = Look(INK, (0, (8, 3, 2, 3)), "")  # type: ignore[arg-type]
DOT_EVERY = 120
"""Both aircraft are marked at the same instants [s]."""
Way = tuple[str, bool, Guidance, Look]
UNKNOWN: Way = "intent unknown", False, "relguide", Look(ORANGE, "--", "s")
KNOWN: Way = "intent known", True, "relguide", Look(BLUE, "-", "o")
CHASE: Way = "chasing the slot", False, "slot_pursuit", Look(GREEN, "-.", "^")
PRONAV: Way = "proportional navigation", False, "pronav", Look(PURPLE, ":", "d")


def draw(ways: tuple[Way, ...], step: Step) -> Drawn:
    """The first way is the figure's own; the others are flown beside it."""
    flights: list[tuple[Way, Flown]] = []
    for way in ways:
        _, known, guidance, _ = way
        flights.append((way, flown(fig_6(intent_known=known), guidance=guidance)))
        step(0.9 / len(ways))
    figure = empty_figure(11.0, 7.0)
    cells = figure.add_gridspec(2, 3, height_ratios=[1.5, 1.0])
    _paths(figure.add_subplot(cells[0, :]), flights)
    heading, separation, bank = (figure.add_subplot(cells[1, k]) for k in range(3))
    for (_, _, _, look), flight in reversed(flights):
        course, until = flight.courses["PURSUER"], flight.result.join_time
        shown = flight.t <= until + 60.0
        t = flight.t[shown]
        for axes, values in (
            (heading, course.heading / DEG),
            (separation, flight.separation["PURSUER"] / NM),
            (bank, course.bank / DEG),
        ):
            axes.plot(t, values[shown], color=look.colour, ls=look.dashes, lw=_width(look, flights))
        heading.plot(
            until, np.interp(until, flight.t, course.heading / DEG), look.mark,
            color=look.colour, mec="white", ms=7, zorder=5,
        )  # fmt: skip
    leader = flights[0][1].courses["LEADER"]
    heading.plot(
        flights[0][1].t, leader.heading / DEG, color=LEADER.colour, ls=LEADER.dashes, lw=1.0
    )
    limit = fig_6(intent_known=True).situation.min_separation / NM
    separation.axhline(limit, color=INK, lw=0.9)
    separation.text(10.0, limit - 0.4, "$d_{min}$", va="top")
    separation.set_ylim(0.0, None)
    for axes, name in (
        (heading, "heading [°]"),
        (separation, "separation [NM]"),
        (bank, "bank, right positive [°]"),
    ):
        axes.set_title(name)
        axes.set_xlabel("time [s]")
        axes.axvline(LEADER_TURNS_AT, color=PALE, lw=0.9, ls=(0, (2, 2)))
    bank.annotate(
        "the leader\nturns", (LEADER_TURNS_AT, 0.0), (-8, 40), textcoords="offset points",
        ha="right", fontsize=8, color=INK,
        arrowprops={"arrowstyle": "-", "color": PALE, "lw": 0.8},
    )  # fmt: skip
    return Drawn(figure, f"{_told(flights)} The leader turns at {LEADER_TURNS_AT:.0f} s.")


def _width(look: Look, flights: list[tuple[Way, Flown]]) -> float:
    return 2.0 if look == flights[0][0][3] else 1.1


def _paths(axes: "Axes", flights: list[tuple[Way, Flown]]) -> None:
    as_map(axes)
    first = flights[0][1]
    leader = first.courses["LEADER"]
    axes.plot(
        leader.x / KM, leader.y / KM, color=LEADER.colour, ls=LEADER.dashes, lw=1.2, label="leader"
    )
    for (name, _, _, look), flight in reversed(flights):
        course = flight.courses["PURSUER"]
        shown = flight.t <= flight.result.join_time + 60.0
        axes.plot(
            course.x[shown] / KM, course.y[shown] / KM,
            color=look.colour, ls=look.dashes, lw=_width(look, flights), label=name,
        )  # fmt: skip
        at = int(np.searchsorted(flight.t, flight.result.join_time))
        axes.plot(
            course.x[at] / KM, course.y[at] / KM, look.mark, color=look.colour, mec="white", ms=8,
            zorder=5,
        )  # fmt: skip
    own = first.courses["PURSUER"]
    every = slice(0, int(first.result.join_time), DOT_EVERY)
    for course, colour in ((own, flights[0][0][3].colour), (leader, INK)):
        axes.plot(course.x[every] / KM, course.y[every] / KM, ".", color=colour, ms=5)
        aircraft(axes, course.x[0] / KM, course.y[0] / KM, course.heading[0] / DEG, colour)
    axes.legend(
        loc="upper right",
        title=f"dots every {DOT_EVERY // 60} min, marks: joined",
        title_fontsize=8,
    )


def _told(flights: list[tuple[Way, Flown]]) -> str:
    return " ".join(
        f"{name[0].upper()}{name[1:]}: joined after {flight.result.join_time:.0f} s, heading swing "
        f"{flight.result.heading_swing / DEG:.0f}°, least separation "
        f"{flight.result.least_separation / NM:.1f} NM."
        for (name, _, _, _), flight in flights
    )


FIG_6A = NamedFigure(
    name="fig_6a",
    title="Fig. 6a: without the leader's intent",
    seconds=2.0,
    draw=partial(draw, (UNKNOWN, CHASE, PRONAV)),
)
FIG_6B = NamedFigure(
    name="fig_6b",
    title="Fig. 6b: with the leader's intent",
    seconds=2.0,
    draw=partial(draw, (KNOWN, UNKNOWN, CHASE)),
)
