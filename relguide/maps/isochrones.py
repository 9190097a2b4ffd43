"""isochrones(situation): the time-to-converge round the leader, as lines and as regions of words.

A pursuer on its present heading is put on every node of a grid round the leader; speeds, bank, D,
d_min, wind and the leader with its intent stay as they are. Each node gets

- a time: that of the fastest extremal that keeps d_min, certified against the leader as it really
  flies, its turns included;
- a bound: the time of the fastest extremal without the limit. No plan is faster. Where both agree
  the time is proved to be the optimum; where they do not, the limit binds, and paths that touch
  d_min or slide along it may be faster than the time given. They are searched only with `exact`.

An intent is planned for as in `plan`: toward a leader that was on its final leg all along, whose
slot opens when the real leader gets there. Where the slot can be reached before, T is that instant;
if two simple families of paths of that length do not keep d_min, the time given is that of the
first extremal after it, again with its bound.

The source of the times is an argument (`Evaluate`): lines and regions can be drawn from any.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from math import inf
from os import cpu_count
from time import perf_counter_ns
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.records import with_limit
from relguide.kernels.maps.field import NO_WORD, field_rows
from relguide.kernels.maps.final_leg import last_turns
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.extremals import WORDS
from relguide.maps.constrained_times import CONSTRAINED, between_nodes, search_nodes
from relguide.maps.contours import Contour, Evaluate, Field, Floats, Region, contours, regions
from relguide.planning.inputs import (
    expect,
    expect_function,
    expect_whole,
    expect_within,
    number,
    truth,
)
from relguide.planning.limits import POSITION
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.tables import scene_of
from relguide.planning.words import HORIZON
from relguide.units import Metre, Millisecond, Second

NAMES = (*WORDS, "delay", "constrained", "")
"""What a number in `Field.words` means: the extremal's word; a delay, which arrives exactly when
the slot opens; a constrained path, which touches d_min or slides along it; no plan."""
NONE = CONSTRAINED + 1
WIDTH, HEIGHT = 160_000.0, 120_000.0
"""Extent of a grid if none is given [m]."""
COLUMNS, ROWS = 160, 120
"""Its nodes."""
MAX_NODES = 512
"""Most columns, and most rows, of a grid."""
MIN_EXTENT, MAX_EXTENT = 1_000.0, 2.0 * POSITION.high
"""Accepted width and height of a grid [m]."""
MAX_LEVELS = 64
"""Most levels of contours."""
STEPS = (15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 1800.0, 3600.0, 7200.0, 14_400.0)
"""Steps between levels that people read well [s]."""
WANTED_LEVELS = 15
"""About so many levels if none are given."""
LEAST_CHUNK, CHUNK = 64, 512
"""Places a thread takes at a time: 0.1 to 1 ms of work."""


Words = Callable[[Floats, Floats], NDArray[np.int8]]
"""Places east and north [m], each of shape (n,), over the ground at t = 0 → the number of the only
word that need be solved there, −1 for all of them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Grid:
    """Where the pursuer is put: the nodes of a rectangle, its edges east and north.

    Examples:
        >>> rg.Grid(x=0.0, y=0.0, width=80e3, height=60e3, columns=5, rows=4).axes[0]
        array([-40000., -20000.,      0.,  20000.,  40000.])
    """

    x: Metre
    """Its middle, east [m]."""
    y: Metre
    """Its middle, north [m]."""
    width: Metre = WIDTH
    """From the first column to the last [m]."""
    height: Metre = HEIGHT
    """From the first row to the last [m]."""
    columns: int = COLUMNS
    rows: int = ROWS

    def __post_init__(self) -> None:
        """Refuse a grid without nodes, or with more than a display can show."""
        for name, count in (("columns", self.columns), ("rows", self.rows)):
            if not isinstance(count, int) or not 2 <= count <= MAX_NODES:
                raise ValueError(
                    f"{name} must be a whole number from 2 to {MAX_NODES}, not {count!r}."
                )
        for name, value in (("width", self.width), ("height", self.height)):
            expect_within(f"grid.{name}", value, MIN_EXTENT, MAX_EXTENT, "m")
        for name, middle, extent in (("x", self.x, self.width), ("y", self.y, self.height)):
            if abs(number(f"grid.{name}", middle)) + 0.5 * extent > POSITION.high:
                raise ValueError(
                    f"The grid must lie within |{name}| ≤ {POSITION.high / 1000.0:g} km."
                )

    @property
    def axes(self) -> tuple[Floats, Floats]:
        """East of each column and north of each row [m]."""
        return (
            np.linspace(self.x - 0.5 * self.width, self.x + 0.5 * self.width, self.columns),
            np.linspace(self.y - 0.5 * self.height, self.y + 0.5 * self.height, self.rows),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Isochrones:
    """The convergence area of a situation, ready to be drawn. World frame, at t = 0."""

    grid: Grid
    field: Field
    """The answers at the nodes, row after row. (rows · columns,)"""
    contours: tuple[Contour, ...]
    """One a level, in their order."""
    regions: tuple[Region, ...]
    """Where each word is the answer. Together they cover the grid."""
    compute_time: Millisecond
    """Wall time it took [ms]."""


def isochrones(
    situation: Situation,
    grid: Grid | None = None,
    levels: Sequence[Second] = (),
    *,
    evaluate: Evaluate | None = None,
    exact: bool = False,
    threads: int | None = None,
    progress: Callable[[int], object] = lambda done: None,
) -> Isochrones:
    """Lines of equal time-to-converge, and regions of equal word.

    Examples:
        >>> grid = rg.Grid(x=0.0, y=0.0, columns=9, rows=9)
        >>> lines = rg.isochrones(rg.scenario("fig_6b").situation, grid, levels=(600.0, 900.0))

    Args:
        situation: all but the pursuer's place counts, and the others, who are left out.
        grid: where to look; 160 × 120 km round the leader if left out.
        levels: times of the lines [s], ascending; some round ones if empty.
        evaluate: gives the times; `times_around(situation)` if left out. Two threads call it at
            once, unless `threads` is 1.
        exact: whether to search the constrained paths at each node where the limit binds, which
            takes some ten ms, or up to a second if the leader turns. Between those nodes their
            times are then interpolated.
        threads: how many; all cores if left out.
        progress: called with the number of nodes searched since the last call.
    """
    expect("situation", situation, Situation)
    situation = replace(situation, others=()) if situation.others else situation
    exact = truth("exact", exact)
    if threads is not None:
        threads = expect_whole("threads", threads, 1)
    if evaluate is not None:
        expect_function("evaluate", evaluate)
    expect_function("progress", progress)
    if grid is None:
        grid = grid_around(situation)
    expect("grid", grid, Grid)
    started = perf_counter_ns()
    levels = check_levels(levels)
    evaluate = evaluate or times_around(situation, threads=threads)
    x, y = grid.axes
    east, north = (axis.ravel() for axis in np.meshgrid(x, y))
    field = evaluate(east, north)
    if exact:
        field = search_nodes(situation, field, east, north, threads, progress)
        evaluate = between_nodes(field, x, y, evaluate)
    levels = levels or round_levels(field)
    lines, words = _draw(field, x, y, levels, evaluate, beside=threads != 1)
    return Isochrones(
        grid=grid,
        field=field,
        contours=lines,
        regions=words,
        compute_time=(perf_counter_ns() - started) * 1e-6,
    )


def _draw(
    field: Field, x: Floats, y: Floats, levels: Sequence[Second], evaluate: Evaluate, *,
    beside: bool,
) -> tuple[tuple[Contour, ...], tuple[Region, ...]]:  # fmt: skip
    """Lines and regions; in two threads if wanted, since Python draws while the kernels work."""
    if not beside:
        return (
            contours(field, x, y, levels, evaluate),
            regions(field, x, y, NAMES, evaluate),
        )
    with ThreadPoolExecutor(1) as other:
        words = other.submit(regions, field, x, y, NAMES, evaluate)
        return contours(field, x, y, levels, evaluate), words.result()


def grid_around(situation: Situation) -> Grid:
    """The grid taken if none is given: round the leader, if there is room."""
    leader = situation.leader
    east, north = POSITION.high - 0.5 * WIDTH, POSITION.high - 0.5 * HEIGHT
    return Grid(x=min(max(leader.x, -east), east), y=min(max(leader.y, -north), north))


def check_levels(levels: Sequence[Second]) -> tuple[Second, ...]:
    """The levels, ascending.

    Raises:
        ValueError: if one is no time, or there are too many.
    """
    expect("levels", levels, tuple, list)
    if len(levels) > MAX_LEVELS:
        raise ValueError(f"There must be at most {MAX_LEVELS} levels, not {len(levels)}.")
    return tuple(sorted({expect_within("A level", level, 0.0, HORIZON, "s") for level in levels}))


def round_levels(field: Field) -> tuple[Second, ...]:
    """Round levels that span most of the field."""
    times = field.time[field.time < inf]
    if times.size == 0:
        return ()
    least, most = np.quantile(times, (0.0, 0.98)).tolist()
    step = next((s for s in STEPS if (most - least) / s <= WANTED_LEVELS), STEPS[-1])
    return tuple(
        step * k for k in range(int(least // step) + 1, int(most // step) + 1) if step * k > 0.0
    )[:MAX_LEVELS]


def times_around(
    situation: Situation, *, threads: int | None = None, words: Words | None = None
) -> Evaluate:
    """Times from the exact kernels without constrained paths: some 600,000 places a second.

    Args:
        situation: all but the pursuer's place counts.
        threads: how many; all cores if left out.
        words: says where only one word need be solved; all of them everywhere if left out.
    """
    frame = slot_frame(situation, situation.leader.trajectory)
    scene = scene_of(situation, frame)
    longest = last_turns(with_limit(scene, scene.d_min - SLACK))
    scale = frame.radius / situation.pursuer.tas
    workers = threads or cpu_count() or 1
    pool = ThreadPoolExecutor(workers)  # its threads start when needed, and end with it

    def evaluate(x: Floats, y: Floats) -> Field:
        places = np.column_stack(_to_slot(frame, x, y))
        alone = np.full(len(places), -1, np.int8) if words is None else words(x, y)
        answers = np.empty((len(places), 4))

        chunk = min(max(len(places) // (4 * workers), LEAST_CHUNK), CHUNK)

        def work(first: int) -> None:
            part = slice(first, first + chunk)
            field_rows(places[part], alone[part], frame.h, scene, longest, answers[part])

        if len(places) <= chunk or workers == 1:
            for first in range(0, len(places), chunk):
                work(first)
        else:
            for _ in pool.map(work, range(0, len(places), chunk)):
                pass
        return _field(answers[:, 0] * scale, answers[:, 1] * scale, *answers.T[2:])

    return evaluate


def _to_slot(frame: SlotFrame, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    to_slot: Callable[[Any, Any], tuple[Any, Any]] = frame.to_slot  # as good for columns
    return to_slot(x, y)


def _field(time: Floats, lower_bound: Floats, words: Floats, limited: Floats) -> Field:
    numbers = words.astype(np.int8)
    numbers[numbers == NO_WORD] = NONE
    # as in `plan`: only what is known to take longer is left out
    beyond = (lower_bound > HORIZON) & (lower_bound < inf)
    time = np.where(beyond, inf, time)
    numbers[time == inf] = NONE
    return Field(
        time=time,
        lower_bound=np.where(beyond, inf, lower_bound),
        words=numbers,
        limited=(limited > 0.0) & ~beyond,
    )
