"""plan_arrays(situations): times of many situations at once, on all cores; arrays in, arrays out.

For straight leaders: an intent makes each situation its own shape, and `plan` takes those one by
one. Every number comes from the same kernels as a `Plan`.

Ten million situations may be given at once: they are taken in blocks, so that beside what is given
and the answer, 18 bytes a situation, there are some 40 MB.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, fields
from math import inf
from numbers import Integral
from os import cpu_count
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relguide.kernels.base.turn import turn_radii
from relguide.kernels.contact import time_rows as kernel
from relguide.kernels.words.extremals import WORDS
from relguide.planning import limits
from relguide.planning.aircraft import Leader, Pursuer, expect_distance
from relguide.planning.constrained_path import BEARINGS, HARDER
from relguide.planning.inputs import expect, expect_function, expect_whole, truth
from relguide.planning.situation import Situation
from relguide.planning.wind import Wind
from relguide.planning.words import HORIZON
from relguide.units import DEG, Second

Floats = NDArray[np.float64]
CHUNK = 512
"""Situations a thread takes at a time without the limit: a few ms of work."""
LIMITED_CHUNK = 32
"""As many with it: 100 ms at most, so that all threads finish together."""
BLOCK = 131_072
"""Situations whose rows for the kernel are held at a time."""
VERDICTS = (
    "planned",
    "planned",
    "slot_unreachable",
    "separation_already_lost",
    "separation_unavoidable",
    "beyond_horizon",
)
"""Status or reason of each verdict of the kernel, and of the one made here."""
BEYOND = VERDICTS.index("beyond_horizon")
NAMES = (*WORDS, "constrained", "")
"""Words by their number."""
CONSTRAINED, NO_WORD = len(WORDS), len(WORDS) + 1
RANGES = {
    "pursuer_x": limits.POSITION,
    "pursuer_y": limits.POSITION,
    "pursuer_heading": limits.HEADING,
    "pursuer_tas": limits.TAS,
    "max_bank": limits.BANK,
    "leader_x": limits.POSITION,
    "leader_y": limits.POSITION,
    "leader_heading": limits.HEADING,
    "leader_tas": limits.TAS,
    "slot_distance": limits.DISTANCE,
    "min_separation": limits.DISTANCE,
    "wind": limits.WIND,
    "clearance": limits.CLEARANCE,
    "headway": limits.HEADWAY,
}
"""What is accepted of each column, and of what is derived from several."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Situations:
    """Situations as columns, each of shape (n,) or one number for all, as in `Situation`.

    Places are east (x) and north (y) [m], headings clockwise from north [rad], airspeeds true
    [m/s], the bank [rad], D and d_min [m], the wind toward the east and the north [m/s].

    Examples:
        >>> asked = rg.Situations(
        ...     pursuer_x=[-40e3, -60e3], pursuer_y=40e3, pursuer_heading=0.0, pursuer_tas=240.0,
        ...     max_bank=0.4, leader_tas=200.0, slot_distance=10e3, min_separation=9_260.0)
        >>> rg.plan_arrays(asked).time_to_converge.round()
        array([427., 327.])
    """

    pursuer_x: ArrayLike
    pursuer_y: ArrayLike
    pursuer_heading: ArrayLike
    pursuer_tas: ArrayLike
    max_bank: ArrayLike
    leader_x: ArrayLike = 0.0
    leader_y: ArrayLike = 0.0
    leader_heading: ArrayLike = 0.0
    leader_tas: ArrayLike
    slot_distance: ArrayLike
    min_separation: ArrayLike
    wind_east: ArrayLike = 0.0
    wind_north: ArrayLike = 0.0

    def columns(self) -> tuple[Floats, ...]:
        """All columns at full length, checked as `Situation` checks itself.

        Raises:
            ValueError: naming the first row that cannot be flown, and why.
        """
        columns = self._full()
        for start, block in _blocks(columns):
            for i in np.flatnonzero(~_can_be_flown(block)):
                try:
                    _situation(**{name: float(column[i]) for name, column in block.items()})
                except ValueError as error:
                    raise ValueError(f"Situation {start + i}: {error}") from None
        return tuple(columns.values())

    def can_be_flown(self) -> NDArray[np.bool_]:
        """Which rows can be flown, to be sure: shape (n,). `Situation` says what is wrong.

        Raises:
            ValueError: if these are no columns.
        """
        blocks = [_can_be_flown(block) for _, block in _blocks(self._full())]
        return np.concatenate(blocks) if blocks else np.empty(0, np.bool_)

    def full_columns(self) -> tuple[Floats, ...]:
        """All columns at full length, unchecked."""
        return tuple(self._full().values())

    def to_dict(self) -> dict[str, Floats]:
        """Columns at full length by name, as data frames take them; `Situations(**frame)` back."""
        return self._full()

    def _full(self) -> dict[str, Floats]:
        given = {f.name: _column(f.name, getattr(self, f.name)) for f in fields(self)}
        sizes = {name: len(column) for name, column in given.items() if len(column) != 1}
        size = next(iter(sizes.values()), 1)
        for name, other in sizes.items():
            if other != size:
                raise ValueError(
                    f"All columns must have one length, but {next(iter(sizes))} has {size} and "
                    f"{name} has {other}."
                )
        return {name: np.broadcast_to(column, size) for name, column in given.items()}


class TimeRow(NamedTuple):
    """The answer to one of `Situations`."""

    time_to_converge: Second
    """T [s]; infinite without a plan."""
    lower_bound: Second
    """No plan that keeps d_min is faster [s]; infinite if the slot is out of reach."""
    verdict: str
    """`planned`, or the reason why not."""
    word: str
    """As in `Times.word`."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Times:
    """Answers to `Situations`, row by row: columns of one length n.

    `times[7]` is a row, `times[7:9]` and `times[times.planned]` are those rows as columns again.
    """

    time_to_converge: Floats
    """T [s]; infinite where there is no plan. shape (n,)"""
    lower_bound: Floats
    """No plan that keeps d_min is faster [s]; infinite if the slot is out of reach. shape (n,)"""
    verdicts: NDArray[np.int8]
    """Numbers of `VERDICTS`. shape (n,)"""
    words: NDArray[np.int8]
    """Numbers of `NAMES`. shape (n,)"""

    def __len__(self) -> int:
        return len(self.verdicts)

    @overload
    def __getitem__(self, rows: int) -> TimeRow: ...
    @overload
    def __getitem__(self, rows: slice | NDArray[np.bool_] | NDArray[np.intp]) -> "Times": ...
    def __getitem__(
        self, rows: int | slice | NDArray[np.bool_] | NDArray[np.intp]
    ) -> "TimeRow | Times":
        """One row by its number, or some by a slice, a mask or their numbers."""
        if isinstance(rows, Integral):
            return TimeRow(
                float(self.time_to_converge[rows]),
                float(self.lower_bound[rows]),
                VERDICTS[self.verdicts[rows]],
                NAMES[self.words[rows]],
            )
        return Times(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})

    def __iter__(self) -> Iterator[TimeRow]:
        """Row by row, of which `pandas.DataFrame(times)` makes a table."""
        return (self[row] for row in range(len(self)))

    def __repr__(self) -> str:
        planned = self.time_to_converge[self.planned]
        span = f", {planned.min():.1f} … {planned.max():.1f} s" if len(planned) else ""
        return f"Times({len(self)} situations, {len(planned)} with a plan{span})"

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """Columns by name, as data frames and savez take them; verdict and word as text.

        Rows without a plan are infinite in time: `times[times.planned]` leaves them out.
        """
        return {
            "time_to_converge": self.time_to_converge,
            "lower_bound": self.lower_bound,
            "verdict": self.verdict,
            "word": self.word,
        }

    @property
    def planned(self) -> NDArray[np.bool_]:
        """Whether there is a plan."""
        return np.isin(self.verdicts, (int(kernel.PROVED), int(kernel.BOUNDED)))

    @property
    def proved(self) -> NDArray[np.bool_]:
        """Whether T is the global optimum, proved; elsewhere it lies within `lower_bound`."""
        proved: NDArray[np.bool_] = self.verdicts == int(kernel.PROVED)
        return proved

    @property
    def verdict(self) -> NDArray[np.str_]:
        """`planned`, or the reason why not. 92 bytes a situation, made anew each time."""
        return np.array(VERDICTS)[self.verdicts]

    @property
    def word(self) -> NDArray[np.str_]:
        """The extremal's word; `constrained` for a path that touches d_min or slides along it."""
        return np.array(NAMES)[self.words]


def plan_arrays(
    situations: Situations,
    *,
    limited: bool = True,
    threads: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> Times:
    """Plan many situations with straight leaders.

    The answers do not depend on the number of threads: each row is computed by itself. With a
    progress bar:

        with progress_bar("planning", total=n) as count:
            times = plan_arrays(situations, progress=count)

    Examples:
        >>> asked = rg.Situations(
        ...     pursuer_x=-40e3, pursuer_y=[20e3, 40e3], pursuer_heading=0.0, pursuer_tas=240.0,
        ...     max_bank=0.4, leader_tas=200.0, slot_distance=10e3, min_separation=9_260.0)
        >>> rg.plan_arrays(asked).word.tolist()
        ['RLR', 'LRL']

    Args:
        situations: as columns. All are checked before the first is planned.
        limited: whether d_min counts; without it the six words alone decide.
        threads: how many cores to use; all of them if not given.
        progress: called with the number of situations done since the last call.

    Raises:
        ValueError: for situations that cannot be flown.
    """
    expect("situations", situations, Situations)
    limited = truth("limited", limited)
    if threads is not None:
        threads = expect_whole("threads", threads, 1)
    if progress is not None:
        expect_function("progress", progress)
    chunk = LIMITED_CHUNK if limited else CHUNK
    columns = situations.columns()
    size = len(columns[0])
    times = Times(
        time_to_converge=np.empty(size),
        lower_bound=np.empty(size),
        verdicts=np.empty(size, np.int8),
        words=np.empty(size, np.int8),
    )
    with _threads(threads or cpu_count() or 1) as run:
        for start in range(0, size, BLOCK):
            block = slice(start, min(start + BLOCK, size))
            rows, scale = _to_slot_frame(*(column[block] for column in columns))
            latest, answers = HORIZON / scale, np.empty((len(rows), 4))

            def work(
                first: int, rows: Floats = rows, latest: Floats = latest, answers: Floats = answers
            ) -> int:
                last = min(first + chunk, len(rows))
                kernel.plan_rows(rows, latest, BEARINGS, HARDER, limited, first, last, answers)
                return last - first

            for done in run(work, range(0, len(rows), chunk)):
                if progress is not None:
                    progress(done)
            _take(times, block, answers, scale)
    return times


@contextmanager
def _threads(count: int) -> Iterator[Callable[..., Iterable[int]]]:
    """Map a function by so many threads; one is this thread."""
    if count == 1:
        yield map
        return
    from concurrent.futures import ThreadPoolExecutor  # 15 ms to import, which `plan` need not pay

    with ThreadPoolExecutor(count) as pool:
        yield pool.map


def _take(times: Times, block: slice, answers: Floats, scale: Floats) -> None:
    """Put the kernel's answers, in R/V_P, where they belong."""
    verdict, word = answers[:, 2].astype(np.int8), answers[:, 3].astype(np.int8)
    time, bound = answers[:, 0] * scale, answers[:, 1] * scale
    far = (bound > HORIZON) & (bound < inf)
    verdict[far], time[far] = BEYOND, inf
    times.time_to_converge[block] = time
    times.lower_bound[block] = bound
    times.verdicts[block] = verdict
    word[word == kernel.CONSTRAINED] = CONSTRAINED
    times.words[block] = np.where(time < inf, word, NO_WORD)


def _column(name: str, given: ArrayLike) -> Floats:
    """A column of floats, of length 1 if one number was given."""
    try:
        column = np.asarray(given)
    except ValueError:
        raise ValueError(f"{name} must be a column, not rows of different lengths.") from None
    if column.dtype.kind not in "fiu":
        raise ValueError(f"{name} must be numbers, not {column.dtype}.")
    if column.ndim > 1:
        raise ValueError(f"{name} must be a number or a column of them, not of {column.ndim} axes.")
    if type(given) is int and RANGES.get(name) is limits.DISTANCE:
        expect_distance(name, given)
    return np.atleast_1d(column.astype(np.float64, copy=False))


def _blocks(columns: Mapping[str, Floats]) -> Iterator[tuple[int, dict[str, Floats]]]:
    """A block of rows after another, with the number of its first."""
    for start in range(0, len(columns["pursuer_x"]), BLOCK):
        block = slice(start, start + BLOCK)
        yield start, {name: column[block] for name, column in columns.items()}


def _can_be_flown(columns: Mapping[str, Floats]) -> NDArray[np.bool_]:
    """Which rows of a block lie in all ranges; what is wrong with the others says `Situation`."""
    east, north = columns["wind_east"], columns["wind_north"]
    tas, heading = columns["leader_tas"], columns["leader_heading"]
    with np.errstate(invalid="ignore", over="ignore"):  # no range admits what is not a number
        derived = {
            "max_bank": columns["max_bank"] / DEG,
            "wind": np.hypot(east, north),
            "clearance": columns["slot_distance"] - columns["min_separation"],
            "headway": np.hypot(tas * np.sin(heading) + east, tas * np.cos(heading) + north),
        }
    shown = {**columns, **derived}
    good = np.ones(len(east), np.bool_)
    for name, accepted in RANGES.items():
        column = shown[name]
        # the extremes alone are twice as fast, and nearly always all is well
        if not (accepted.admits(float(column.min())) and accepted.admits(float(column.max()))):
            good &= accepted.admits(column)
    return good


def _situation(
    *, pursuer_x: float, pursuer_y: float, pursuer_heading: float, pursuer_tas: float,
    max_bank: float, leader_x: float, leader_y: float, leader_heading: float, leader_tas: float,
    slot_distance: float, min_separation: float, wind_east: float, wind_north: float,
) -> Situation:  # fmt: skip
    """One row."""
    return Situation(
        pursuer=Pursuer(
            x=pursuer_x, y=pursuer_y, heading=pursuer_heading, tas=pursuer_tas, max_bank=max_bank
        ),
        leader=Leader(x=leader_x, y=leader_y, heading=leader_heading, tas=leader_tas),
        slot_distance=slot_distance,
        min_separation=min_separation,
        wind=Wind(east=wind_east, north=wind_north),
    )


def _to_slot_frame(
    px: Floats, py: Floats, psi: Floats, tas: Floats, bank: Floats, lx: Floats, ly: Floats,
    leading: Floats, leader_tas: Floats, distance: Floats, nearest: Floats, east: Floats,
    north: Floats,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Rows for the kernel, shape (n, 7), and R/V_P of each [s]."""
    along_east, along_north = np.sin(leading), np.cos(leading)
    ground_east, ground_north = leader_tas * along_east + east, leader_tas * along_north + north
    # the slot is D behind along the leader's ground track
    share = distance / np.hypot(ground_east, ground_north)
    back_east, back_north = share * ground_east, share * ground_north
    radius = turn_radii(tas, bank)

    def to_slot(dx: Floats, dy: Floats) -> tuple[Floats, Floats]:
        return (
            (dx * along_east + dy * along_north) / radius,
            (dy * along_east - dx * along_north) / radius,
        )

    x, y = to_slot(px - lx + back_east, py - ly + back_north)
    leader_x, leader_y = to_slot(back_east, back_north)
    rows = np.column_stack(
        (x, y, leading - psi, leader_tas / tas, leader_x, leader_y, nearest / radius)
    )
    return np.ascontiguousarray(rows), radius / tas
