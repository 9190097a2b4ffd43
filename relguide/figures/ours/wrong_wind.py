"""The promise kept under a wrong wind: guidance believes calm air, and a wind blows."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.flights import Flown, flown
from relguide.figures.style import INK, LOOKS, PALE, aircraft, as_map, empty_figure
from relguide.flying.air import Air
from relguide.flying.flight import Scenario
from relguide.flying.scenarios import fig_6
from relguide.planning.wind import CALM, wind_from
from relguide.units import DEG, NM, MetrePerSecond, Radian

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
FROM = (0.0, 90.0, 180.0, 270.0)
"""Where the wind comes from [°]."""
NAMES = ("north", "east", "south", "west")
SPEEDS = (10.0, 20.0, 30.0)
"""How wrong the wind is that guidance begins with [m/s]."""


def draw(step: Step) -> Drawn:
    """Paths over the ground in the strongest wind; promise and join for all of them."""
    work = 0.95 / (1 + len(FROM) * len(SPEEDS))
    calm = flown(_in_wind(0.0, 0.0))
    step(work)
    flights: dict[float, list[Flown]] = {}
    for direction in FROM:
        flights[direction] = [calm]
        for speed in SPEEDS:
            flights[direction].append(flown(_in_wind(direction * DEG, speed)))
            step(work)
    figure = empty_figure(11.0, 4.6)
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.5, 1.0]})
    _paths(left, calm, {direction: own[-1] for direction, own in flights.items()})
    blown = 0.0, *SPEEDS
    for (_, own), name, look in zip(flights.items(), NAMES, LOOKS, strict=False):
        late = [flight.result.join_time - flight.result.promised for flight in own]
        right.plot(
            blown, late, look.mark, color=look.colour, ls=look.dashes, label=f"from the {name}"
        )
    right.axhline(0.0, color=INK, lw=0.8)
    right.set_ylim(-10.0, 10.0)
    right.set_title("joined after the first promise by [s]")
    right.set_xlabel("wind that guidance does not know at first [m/s]")
    right.legend(loc="upper left", ncols=2)
    every = [flight for own in flights.values() for flight in own[1:]]
    missed = [abs(flight.result.join_time - flight.result.promised) for flight in every]
    joined = [flight.result.join_time for flight in every]
    least = min(flight.result.least_separation for flight in every)
    return Drawn(
        figure,
        f"Fig. 6b in {len(every)} winds, believed to be calm at first: joined after "
        f"{min(joined):.0f} … {max(joined):.0f} s, within {max(missed):.1f} s of what was promised "
        f"at the start; least separation {least / NM:.1f} NM, losses "
        f"{sum(len(flight.result.losses) for flight in every)}.",
    )


def _in_wind(direction: Radian, speed: MetrePerSecond) -> Scenario:
    scenario = fig_6(intent_known=True)
    wind = wind_from(direction, speed)
    return replace(
        scenario,
        situation=replace(scenario.situation, wind=wind),
        believed_air=Air(wind=CALM),
    )


def _paths(axes: "Axes", calm: Flown, strongest: dict[float, Flown]) -> None:
    as_map(axes)
    axes.set_title(f"over the ground, {SPEEDS[-1]:.0f} m/s; thin: the leader, dots: joined")
    for flight, colour, dashes, width in (
        (calm, PALE, "-", 3.0),
        *(
            (own, look.colour, look.dashes, 1.4)
            for own, look in zip(strongest.values(), LOOKS, strict=False)
        ),
    ):
        until = int(np.searchsorted(flight.t, flight.result.join_time))
        course, leader = flight.courses["PURSUER"], flight.courses["LEADER"]
        axes.plot(course.x[:until] / KM, course.y[:until] / KM, color=colour, ls=dashes, lw=width)
        axes.plot(
            leader.x[: until + 60] / KM,
            leader.y[: until + 60] / KM,
            color=colour,
            lw=0.7,
            ls=dashes,
        )
        axes.plot(course.x[until] / KM, course.y[until] / KM, "o", color=colour, ms=5)
    start = calm.courses["PURSUER"]
    aircraft(axes, start.x[0] / KM, start.y[0] / KM, start.heading[0] / DEG)
    aircraft(axes, 0.0, 0.0, 90.0)
    axes.annotate("leader", (0.0, 0.0), (-4, -16), textcoords="offset points")
    axes.annotate(
        "pursuer; grey: in calm air",
        (start.x[0] / KM, start.y[0] / KM),
        (0, 26),
        textcoords="offset points",
    )


FIGURE = NamedFigure(
    name="wrong_wind", title="The promise kept under a wrong wind", seconds=9.0, draw=draw
)
