"""A stream of ten: each joins the one before, behind one leader that turns."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.flights import Flown, in_columns
from relguide.figures.style import INK, LOOKS, aircraft, as_map, empty_figure
from relguide.flying.documents import Document
from relguide.flying.flight import Scenario, fly
from relguide.flying.followers import Follower
from relguide.flying.scenarios import scenario
from relguide.planning.aircraft import Pursuer
from relguide.planning.plan import plan
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
TEN = 10
LASTS = 880.0
"""About how long it is flown [s]."""


def ten(count: int = TEN) -> Scenario:
    """The stream of five, made longer: from both sides, each 13 km farther behind."""
    five = scenario("stream_of_five")
    all_of_them = [
        Pursuer(
            x=-20_000.0 - 13_000.0 * k,
            y=(16_000.0 + 2_000.0 * k) * side,
            heading=(90.0 + 20.0 * side) * DEG,
            tas=235.0,
            max_bank=25.0 * DEG,
        )
        for k, side in enumerate([-1.0, 1.0] * (count // 2))
    ]
    return replace(
        five,
        name="stream_of_ten",
        title="A stream of ten",
        pursuer_ident="1",
        situation=replace(five.situation, pursuer=all_of_them[0]),
        followers=tuple(
            Follower(ident=f"{k}", pursuer=one) for k, one in enumerate(all_of_them[1:], start=2)
        ),
    )


def draw(step: Step, asked: Scenario | None = None) -> Drawn:
    """Paths over the ground, and each separation over time."""
    asked = asked or ten()
    told: list[Document] = []
    reached = 0.0
    for one in fly(asked, plan, sample_period=1.0):
        told.append(one)
        if one.t > reached:
            step(0.95 * (min(one.t, LASTS) - min(reached, LASTS)) / LASTS)
            reached = one.t
    flight = in_columns(told)
    figure = empty_figure(11.0, 4.6)
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.4, 1.0]})
    _paths(left, asked, flight)
    for k, (ident, separation) in enumerate(flight.separation.items()):
        look = LOOKS[k % 2]
        right.plot(flight.t, separation / NM, color=look.colour, ls=look.dashes, lw=1.2)
        joined = flight.results[k].join_time
        at = float(np.interp(joined, flight.t, separation / NM))
        right.plot(joined, at, look.mark, color=look.colour, ms=5, mec="white", zorder=5)
        right.annotate(ident, (joined, at), (2, 6), textcoords="offset points", fontsize=8)
    limit, slot = asked.situation.min_separation / NM, asked.situation.slot_distance / NM
    for height, name in ((limit, "$d_{min}$"), (slot, "$D$")):
        right.axhline(height, color=INK, lw=0.8)
        right.text(4.0, height - 0.25, name, va="top")
    right.set_ylim(0.0, None)
    right.set_title("separation from the one before [NM]")
    right.set_xlabel("time [s]; marks: joined")
    results = flight.results
    return Drawn(
        figure,
        f"{sum(one.joined for one in results)} of {len(results)} join, after "
        f"{min(one.join_time for one in results):.0f} … "
        f"{max(one.join_time for one in results):.0f} s, each {asked.spacing:.0f} s behind the one "
        f"before; least separation {min(one.least_separation for one in results) / NM:.2f} NM, "
        f"losses {sum(len(one.losses) for one in results)}. Numbers: place in the stream.",
    )


def _paths(axes: "Axes", asked: Scenario, flight: Flown) -> None:
    as_map(axes)
    axes.set_title("over the ground; marks: joined")
    leader = flight.courses[asked.leader_ident]
    axes.plot(leader.x / KM, leader.y / KM, color=INK, lw=1.2, ls=(0, (8, 3, 2, 3)), label="leader")
    aircraft(axes, 0.0, 0.0, 90.0)
    for k, result in enumerate(flight.results):
        course, look = flight.courses[result.ident], LOOKS[k % 2]
        until = int(np.searchsorted(flight.t, result.join_time))
        x, y = course.x / KM, course.y / KM
        axes.plot(x[: until + 1], y[: until + 1], color=look.colour, ls=look.dashes, lw=1.2)
        axes.plot(x[until], y[until], look.mark, color=look.colour, ms=5, mec="white", zorder=5)
        aircraft(axes, x[0], y[0], course.heading[0] / DEG, look.colour)
        axes.annotate(
            result.ident, (x[0], y[0]), (-4, 9), textcoords="offset points", fontsize=8, ha="center"
        )


FIGURE = NamedFigure(name="stream_of_ten", title="A stream of ten", seconds=16.0, draw=draw)
