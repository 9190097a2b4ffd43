"""Convergence areas as outsiders get them: lines and regions in metres, each name with its unit."""

from math import degrees
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from relguide.contract.bodies import SituationBody
from relguide.contract.compass import compass
from relguide.contract.places import Anchor, Position
from relguide.contract.refusal import Strict
from relguide.maps.contours import Floats
from relguide.maps.isochrones import (
    COLUMNS,
    HEIGHT,
    MAX_EXTENT,
    MAX_LEVELS,
    MAX_NODES,
    MIN_EXTENT,
    ROWS,
    WIDTH,
    Grid,
    Isochrones,
)
from relguide.planning.frames import LocalPlane
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON

DECIMALS = 0
"""Decimals of positions in metres; a display shows 0.1 NM."""
EXACT = "Where the minimum separation does not matter the times are those of the optimum, proved."
BOUND = (
    "In limited regions the time is that of a plan that keeps the minimum separation, and no plan "
    "is faster than the lower bound. Paths that touch the minimum separation were not searched "
    "and may be faster than the time given."
)
SEARCHED = (
    "In limited regions the paths that touch the minimum separation were searched at each node of "
    "the grid as well; lines between nodes are interpolated. No plan is faster than the lower "
    "bound."
)
ASKED = (
    "Where a network of branches is sure of the word, only that word was solved, exactly: the time "
    "is that of a plan, and seldom not the least. Such nodes are counted as limited, and their "
    "lower bound is the time of a straight line. Elsewhere all words were solved."
)
INTENT = (
    "The leader is taken to have been on its final leg from the start, and the slot to open when "
    "the leader gets there; each plan keeps the minimum separation from the leader as it really "
    "flies."
)
AMID = (
    "Other traffic, cells and heights are not counted. Amid the others a plan may take longer than "
    "the time given; where height keeps the leader apart it may be faster."
)
DRAWN = (
    "Each vertex of a line is on its level to 0.1 s; lines are cut where the time jumps. Each "
    "vertex of a region lies on an edge of the grid, accurate to an eighth of that edge."
)


Extent = Annotated[float, Field(ge=MIN_EXTENT, le=MAX_EXTENT)]
Count = Annotated[int, Field(ge=2, le=MAX_NODES)]
Levels = Annotated[list[Annotated[float, Field(ge=0.0, le=HORIZON)]], Field(max_length=MAX_LEVELS)]


class AreaRequest(Strict):
    """Whose convergence area is asked for, and on which grid: either a flight or a situation."""

    flight: Annotated[str, Field(max_length=100)] | None = None
    """Id of a flight: the area for its situation now."""
    situation: SituationBody | None = None
    """Instead of a flight: a situation as `POST /plans` takes it."""
    x_m: Position | None = None
    """Centre of the grid, east; if left out, the leader."""
    y_m: Position | None = None
    """Centre of the grid, north; if left out, the leader."""
    width_m: Extent = WIDTH
    """From the first column to the last."""
    height_m: Extent = HEIGHT
    """From the first row to the last."""
    columns: Count = COLUMNS
    """Of the grid, from west to east."""
    rows: Count = ROWS
    """Of the grid, from south to north."""
    levels_s: Annotated[Levels, Field(default_factory=list)]
    """Times of the lines; if left out, some round ones."""
    exact: bool = False
    """Whether to search the paths that touch the minimum separation as well. Takes seconds; for few
    nodes, and a leader without turns to come."""
    planner: Literal["exact", "network"] = "exact"
    """`network`: a network of branches says where it is enough to solve one word; all words are
    solved where it is not sure, and where the word changes."""
    times: bool = False
    """Whether to give the times of all nodes."""


class AreaGrid(Strict):
    """Where the pursuer was put: the nodes of a rectangle with sides toward east and north."""

    x_m: float
    """Its centre, east."""
    y_m: float
    """Its centre, north."""
    width_m: float
    """From the first column to the last."""
    height_m: float
    """From the first row to the last."""
    columns: int
    """From west to east."""
    rows: int
    """From south to north."""


class AreaContour(Strict):
    """The places from which the time-to-converge is equal to a level."""

    level_s: float
    """The time."""
    lines: list[list[list[float]]]
    """Lines of [x_m, y_m], or of [x_m, y_m, lat_deg, lon_deg] if the situation came with latitudes;
    closed where the first vertex is also the last."""


class AreaRegion(Strict):
    """A region with one word as its answer."""

    word: str
    """Letters; or `delay`: a path made longer to arrive exactly when the slot opens; or
    `constrained`: a path that touches the minimum separation; or empty: no plan."""
    limited: bool
    """Whether the path that would be fastest without the minimum separation comes too close."""
    polygons: list[list[list[list[float]]]]
    """Each polygon is an outline followed by its holes, all closed, with points as in a contour.
    Fill them by the even-odd rule."""


class AreaCount(Strict):
    """How many nodes of the grid have each kind of answer."""

    proved: int
    """The time is proved to be the least."""
    limited: int
    """There is a plan, and a lower bound of the time."""
    no_plan: int
    """There is no plan."""


class AreaAnswer(Strict):
    """A convergence area: lines of equal time-to-converge, and regions of equal word."""

    grid: AreaGrid
    """Where the pursuer was put."""
    pursuer_heading_deg: float
    """Clockwise from true north; the same at all nodes."""
    levels_s: list[float]
    """Times of the lines."""
    contours: list[AreaContour]
    """One for each level, in the same order."""
    regions: list[AreaRegion]
    """Together they cover the grid."""
    count: AreaCount
    """How many nodes have which kind of answer."""
    notes: list[str]
    """What is exact here and what is a bound, in sentences."""
    compute_ms: float
    """How long it took."""
    times_s: list[list[float | None]] | None = None
    """Times of the nodes, if asked for: one list for each row, from the south; null where there is
    no plan."""
    lower_bounds_s: list[list[float | None]] | None = None
    """No plan from a node is faster than this; laid out as `times_s`."""


def area_to_wire(
    area: Isochrones, situation: Situation, anchor: Anchor, *, exact: bool, times: bool
) -> dict[str, Any]:
    """An area as a JSON object.

    Args:
        area: what to write.
        situation: whose area it is.
        anchor: how its world frame lies on the earth.
        exact: whether constrained paths were searched.
        times: whether to give the times of all nodes.
    """
    field, grid = area.field, area.grid
    planned = int((field.time < np.inf).sum())
    proved = int(field.proved.sum())
    answer = {
        "grid": _grid(grid),
        "pursuer_heading_deg": compass(degrees(situation.pursuer.heading)),
        "levels_s": [contour.level for contour in area.contours],
        "contours": [
            {"level_s": contour.level, "lines": [_points(line, anchor) for line in contour.lines]}
            for contour in area.contours
        ],
        "regions": [
            {
                "word": region.word,
                "limited": region.limited,
                "polygons": [
                    [_points(ring, anchor) for ring in polygon] for polygon in region.polygons
                ],
            }
            for region in area.regions
        ],
        "count": {
            "proved": proved,
            "limited": planned - proved,
            "no_plan": len(field.time) - planned,
        },
        "notes": _notes(area, situation, exact=exact),
        "compute_ms": round(area.compute_time, 3),
    }
    if times:
        answer["times_s"] = _rows(field.time, grid)
        answer["lower_bounds_s"] = _rows(field.lower_bound, grid)
    return answer


def _grid(grid: Grid) -> dict[str, Any]:
    return {
        "x_m": grid.x,
        "y_m": grid.y,
        "width_m": grid.width,
        "height_m": grid.height,
        "columns": grid.columns,
        "rows": grid.rows,
    }


def _points(line: Floats, anchor: Anchor) -> list[list[float]]:
    points: list[list[float]] = np.round(line, DECIMALS).tolist()
    match anchor:
        case LocalPlane():
            return [[x, y, *map(_seventh, anchor.to_geodetic(x, y))] for x, y in points]
        case _:
            return points


def _seventh(degrees: float) -> float:
    return round(degrees, 7)  # 1 cm


def _rows(column: Floats, grid: Grid) -> list[list[float | None]]:
    table = np.round(column, 2).reshape(grid.rows, grid.columns).astype(object)
    table[table == np.inf] = None
    rows: list[list[float | None]] = table.tolist()
    return rows


def _notes(area: Isochrones, situation: Situation, *, exact: bool) -> list[str]:
    field = area.field
    limited = bool(field.limited.any())
    asked = bool(np.any((field.time < np.inf) & ~field.limited & ~field.proved))
    return [
        ASKED if asked else EXACT,
        *((SEARCHED if exact else BOUND,) if limited else ()),
        *((INTENT,) if situation.leader.intent else ()),
        *((AMID,) if situation.others or situation.pursuer.altitude is not None else ()),
        DRAWN,
    ]
