"""plan_arrays(situations): times of many situations at once, on all cores; arrays in, arrays out.

For straight leaders: an intent makes each situation its own shape, and `plan` takes those one by
one. Every number comes from the same kernels as a `Plan`.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from os import cpu_count

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relguide.kernels import batch as kernel
from relguide.kernels.extremals import WORDS
from relguide.planning import situation as limits
from relguide.planning.detour import BEARINGS
from relguide.units import G0

Floats = NDArray[np.float64]
CHUNK = 512
"""Situations a thread takes at a time: a few ms of work, or a few s where the limit binds."""
VERDICTS = (
    "planned",
    "planned",
    "slot_unreachable",
    "separation_already_lost",
    "separation_unavoidable",
)
"""Status or reason of each verdict of the kernel."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Situations:
    """Situations as columns, each of shape (n,) or one number for all; units as in `Situation`."""

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
            ValueError: naming the first row that cannot be flown.
        """
        names = self.__slots__
        columns = np.broadcast_arrays(
            *(np.atleast_1d(np.asarray(getattr(self, name), dtype=np.float64)) for name in names)
        )
        by_name = dict(zip(names, columns, strict=True))
        _check("finite numbers", np.logical_and.reduce([np.isfinite(c) for c in columns]))
        for name in ("pursuer_x", "pursuer_y", "leader_x", "leader_y"):
            near = abs(by_name[name]) <= limits.MAX_POSITION
            _check(f"|{name}| ≤ {limits.MAX_POSITION:g} m", near)
        for name in ("pursuer_tas", "leader_tas"):
            tas = by_name[name]
            fits = (tas >= limits.MIN_TAS) & (tas <= limits.MAX_TAS)
            _check(f"{name} in {limits.MIN_TAS:g} … {limits.MAX_TAS:g} m/s", fits)
        bank = by_name["max_bank"]
        slack = 1e-9  # a bound in degrees comes back from radians with its last digit changed
        _check(
            "max_bank in 1 … 60°",
            (bank >= limits.MIN_BANK - slack) & (bank <= limits.MAX_BANK + slack),
        )
        nearest, distance = by_name["min_separation"], by_name["slot_distance"]
        fits = (nearest >= 0.0) & (nearest <= distance) & (distance <= limits.MAX_SLOT_DISTANCE)
        _check(f"0 ≤ min_separation ≤ slot_distance ≤ {limits.MAX_SLOT_DISTANCE:g} m", fits)
        wind = np.hypot(by_name["wind_east"], by_name["wind_north"])
        _check(f"wind of at most {limits.MAX_WIND:g} m/s", wind <= limits.MAX_WIND)
        return tuple(columns)


@dataclass(frozen=True, slots=True, kw_only=True)
class Times:
    """Answers to `Situations`, row by row."""

    time_to_converge: Floats
    """T [s]; infinite where there is no plan."""
    lower_bound: Floats
    """No plan that keeps d_min is faster [s]; infinite where the slot is out of reach."""
    verdict: NDArray[np.str_]
    """`planned`, or the reason why not."""
    proved: NDArray[np.bool_]
    """Whether T is the global optimum, proved; elsewhere it lies within `lower_bound`."""
    word: NDArray[np.str_]
    """The extremal's word; `detour` for a way that touches or rides along d_min."""


def plan_arrays(
    situations: Situations,
    *,
    limited: bool = True,
    threads: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> Times:
    """Plan many situations with straight leaders.

    The answers do not depend on the number of threads: each row is computed by itself.

    Args:
        situations: as columns.
        limited: whether d_min counts; without it the six words alone decide.
        threads: how many cores to use; all of them if not given.
        progress: called with the number of situations done since the last call.

    Raises:
        ValueError: for situations that cannot be flown.
    """
    rows, scale = _in_slot_frame(situations)
    answers = np.empty((len(rows), 4))
    starts = range(0, len(rows), CHUNK)

    def work(start: int) -> int:
        end = min(start + CHUNK, len(rows))
        kernel.plan_rows(rows, BEARINGS, limited, start, end, answers)
        return end - start

    with ThreadPoolExecutor(threads or cpu_count() or 1) as pool:
        for done in pool.map(work, starts):
            if progress is not None:
                progress(done)
    verdict = answers[:, 2].astype(int)
    number = answers[:, 3].astype(int)
    return Times(
        time_to_converge=answers[:, 0] * scale,
        lower_bound=answers[:, 1] * scale,
        verdict=np.array(VERDICTS)[verdict],
        proved=verdict == int(kernel.PROVED),
        word=np.where(verdict < 2, np.array((*WORDS, "detour"))[number], ""),
    )


def _in_slot_frame(situations: Situations) -> tuple[Floats, Floats]:
    """Rows for the kernel, shape (n, 7), and R/V_P of each [s]."""
    px, py, psi, tas, bank, lx, ly, leading, leader_tas, distance, nearest, east, north = (
        situations.columns()
    )
    along_east, along_north = np.sin(leading), np.cos(leading)
    ground_east, ground_north = leader_tas * along_east + east, leader_tas * along_north + north
    ground_speed = np.hypot(ground_east, ground_north)
    _check(
        f"a leader that makes {limits.MIN_HEADWAY:g} m/s over the ground",
        ground_speed >= limits.MIN_HEADWAY,
    )
    # the slot is D behind along the leader's ground track
    share = distance / ground_speed
    back_east, back_north = share * ground_east, share * ground_north
    radius = tas**2 / (G0 * np.tan(bank))

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


def _check(rule: str, holds: NDArray[np.bool_]) -> None:
    if not holds.all():
        row = int(np.flatnonzero(~holds)[0])
        raise ValueError(f"Situation {row} breaks a rule: there must be {rule}.")
