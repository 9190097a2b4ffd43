"""Plans amid other traffic and weather: the two named flights, and what keeping clear costs."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.flights import Flown, flown
from relguide.figures.style import (
    BLUE,
    INK,
    LIMIT_FILL,
    ORANGE,
    PALE,
    PURPLE,
    aircraft,
    as_map,
    empty_figure,
)
from relguide.flying.flight import Scenario
from relguide.flying.scenarios import scenario
from relguide.planning.aircraft import Traffic
from relguide.planning.cells import Cell, Disc
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.units import DEG, NM, Second

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
STREAM, STORMS = "crossing_stream", "thunderstorm_line"


def draw(step: Step) -> Drawn:
    """Each flight, with all others where they are as it comes nearest to one of them."""
    figure = empty_figure(11.0, 4.4)
    told = []
    for axes, name in zip(figure.subplots(1, 2), (STREAM, STORMS), strict=True):
        asked = scenario(name)
        flight = flown(asked)
        alone = plan(replace(asked.situation, others=()))
        amid = plan(asked.situation)
        assert isinstance(alone, Plan)
        assert isinstance(amid, Plan)
        _show(axes, asked, flight, alone)
        (near,) = flight.result.least_other
        told.append(
            f"{asked.title}: joined after {flight.result.join_time:.0f} s; keeping clear costs "
            f"{amid.time_to_converge - alone.time_to_converge:.0f} s of the plan; nearest to "
            f"{near.ident} with {near.separation / NM:.2f} NM at {near.t:.0f} s, to be kept "
            f"{near.min_separation / NM:.0f}."
        )
        step(0.45)
    return Drawn(figure, " ".join(told))


def _show(axes: "Axes", asked: Scenario, flight: Flown, alone: Plan) -> None:
    as_map(axes)
    (near,) = flight.result.least_other
    axes.set_title(f"{asked.title.lower()}, at {near.t:.0f} s")
    row = int(np.searchsorted(flight.t, near.t))
    until = int(np.searchsorted(flight.t, flight.result.join_time))
    for other in asked.situation.others:
        match other:
            case Traffic():
                course = flight.courses[other.ident]
                x, y = course.x / KM, course.y / KM
                axes.plot(x[: row + 1], y[: row + 1], color=PURPLE, lw=0.9, ls=":")
                aircraft(axes, x[row], y[row], course.heading[row] / DEG, PURPLE)
                nearest = other.ident == near.ident
                _disc(axes, x[row], y[row], other.min_separation / KM, filled=nearest)
            case Cell():
                _cell(axes, other, 0.0, filled=False)
                _cell(axes, other, near.t, filled=True)
    poses = [
        alone.trajectory.pose_at(float(t)) for t in np.linspace(0.0, alone.time_to_converge, 240)
    ]
    axes.plot(
        [p.x / KM for p in poses], [p.y / KM for p in poses],
        color=PALE, ls="--", label="the plan without others",
    )  # fmt: skip
    leader, own = flight.courses["LEADER"], flight.courses["PURSUER"]
    axes.plot(
        leader.x[:until] / KM,
        leader.y[:until] / KM,
        color=INK,
        lw=1.0,
        ls=(0, (8, 3, 2, 3)),
        label="leader",
    )
    axes.plot(own.x[:until] / KM, own.y[:until] / KM, color=BLUE, lw=2.0, label="flown")
    for course, colour in ((leader, INK), (own, BLUE)):
        aircraft(axes, course.x[row] / KM, course.y[row] / KM, course.heading[row] / DEG, colour)
    axes.legend(loc="upper right")


def _disc(axes: "Axes", x: float, y: float, radius: float, **look: Any) -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((x, y), radius, **_look(**look)))


def _cell(axes: "Axes", cell: Cell, t: Second, *, filled: bool) -> None:
    """All places no farther than its grown radius from its corners' hull."""
    from matplotlib.patches import Polygon as Patch

    if isinstance(cell.shape, Disc):
        corners, radius = [(cell.shape.x, cell.shape.y)], cell.shape.radius
    else:
        corners, radius = list(cell.shape.corners), 0.0
    radius += cell.growth * t
    around = np.linspace(0.0, 360.0 * DEG, 73)
    points = np.concatenate(
        [
            np.column_stack((x + radius * np.cos(around), y + radius * np.sin(around)))
            for x, y in corners
        ]
    )
    points += np.array([cell.east, cell.north]) * t
    axes.add_patch(Patch(_hull(points) / KM, closed=True, **_look(filled=filled)))


def _look(*, filled: bool) -> dict[str, Any]:
    if filled:
        return {"fc": LIMIT_FILL, "ec": ORANGE, "lw": 1.0}
    return {"fc": "none", "ec": ORANGE, "lw": 0.8, "ls": ":"}


def _hull(points: Any) -> Any:
    """Convex hull of points, counter-clockwise. shape (n, 2)."""
    ordered = sorted(set(map(tuple, points.tolist())))

    def half(there: list[tuple[float, float]]) -> list[tuple[float, float]]:
        kept: list[tuple[float, float]] = []
        for p in there:
            while len(kept) > 1 and (
                (kept[-1][0] - kept[-2][0]) * (p[1] - kept[-2][1])
                <= (kept[-1][1] - kept[-2][1]) * (p[0] - kept[-2][0])
            ):
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


FIGURE = NamedFigure(
    name="amid_others", title="Plans amid other traffic and weather", seconds=5.0, draw=draw
)
