"""Situations and their exact answers in bulk: the time of every branch, without the limit.

Three sources, as the box alone hardly ever meets what is hard: `box`, places drawn evenly; the
`reverse` of random paths, laid back from the slot as `reverse_dp` does, of which those are kept
whose fastest branches are rare (of such paths only a quarter is optimal: they propose situations,
the exact solution labels them); `edge`, places next to a switching surface, found by bisection
between situations with different answers. Beside them, where it is asked for, the `loop`: what
flights meet.

Labels are made in chunks. A chunk is a function of the request and its number, so any executor may
make it, anywhere and as often as need be, and the result is the same.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import asdict, dataclass, field
from functools import partial
from math import inf, isfinite, pi
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.angles import wrap_each
from relguide.kernels.words.branches import BRANCHES as BRANCHES
from relguide.kernels.words.branches import SIZE, WORD_OF, branch_times
from relguide.kernels.words.extremals import SIGNS
from relguide.learn.training.chunks import gather
from relguide.learn.training.files import load_columns, save_columns
from relguide.learn.training.requests import (
    begin_chunk,
    check_ratios,
    check_request,
    chunks_of,
)
from relguide.learn.words.visited import draw_visited

Floats = NDArray[np.float64]
SOURCES = ("box", "reverse", "edge", "loop")
"""Where a situation comes from, by number."""
FILE = "relguide exact labels 1"
"""What a file says it is, with the version of its columns."""
COLUMNS = ("situations", "times_r_per_v", "sources")
NONE = "holds no labels of relguide dataset --method exact, or is cut short."
"""What is said of a file that is not one."""
PROPOSALS = 4
"""Reversed paths laid back for each that is kept."""
FEWEST = 128
"""Proposals drawn at least: of fewer, none might serve."""
BISECTIONS = 14
"""Halvings of the way to a switching surface: 1e-4 of it is left."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """The situations that are learnt; beyond them nothing is claimed."""

    max_range: float = 40.0
    """Farthest from the slot [R]."""
    min_ratio: float = 0.3
    """Least V_L/V_P."""
    max_ratio: float = 0.97
    """Largest V_L/V_P."""

    def __post_init__(self) -> None:
        """Refuse a box that holds nothing, or where the slot may be out of reach."""
        if not (isfinite(self.max_range) and self.max_range > 0.0):
            raise ValueError(f"max_range must be above 0 R, not {self.max_range:g} R.")
        check_ratios(self.min_ratio, self.max_ratio)


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelRequest:
    """What labels to make. The same request gives the same labels."""

    count: int
    seed: int = 0
    box: Box = field(default_factory=Box)
    shares: tuple[float, float, float] = (0.4, 0.3, 0.3)
    """Of the first three `SOURCES`."""
    chunk: int = 10_000
    """Labels made at a time."""
    loops: float = 0.0
    """For each of them so many more that flights met; they take 5 ms each, the others 0.02."""

    def __post_init__(self) -> None:
        """Refuse what is no request."""
        check_request(self)
        if not 0.0 <= self.loops <= 1.0:
            raise ValueError(f"loops must be a share from 0 to 1, not {self.loops:g}.")

    @property
    def chunks(self) -> int:
        """How many chunks there are."""
        return chunks_of(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Labels:
    """Situations and their exact answers, as columns."""

    situations: Floats
    """x, y ≥ 0 [R], h in [0, 2π) [rad], α, in the slot frame. shape (n, 4)"""
    times: Floats
    """τ of every branch [R/V_P], infinite where it does not exist. shape (n, SIZE)"""
    sources: NDArray[np.int8]
    """Numbers of `SOURCES`. shape (n,)"""

    def __len__(self) -> int:
        return len(self.situations)

    @property
    def best(self) -> NDArray[np.int64]:
        """The fastest branch of each."""
        best: NDArray[np.int64] = self.times.argmin(axis=1)
        return best


def held_out_regions(situations: Floats) -> dict[str, NDArray[np.bool_]]:
    """The regions that no training has seen: a band of ratios, a sector of headings, a ring."""
    x, y, h, alpha = situations.T
    away = np.hypot(x, y)
    return {
        "ratio 0.70 … 0.73": (alpha >= 0.70) & (alpha < 0.73),
        "heading 120 … 135°": (h >= 2.0 * pi / 3.0) & (h < 0.75 * pi),
        "range 6 … 7 R": (away >= 6.0) & (away < 7.0),
    }


def make_labels(request: LabelRequest, executor: Executor) -> Iterator[tuple[int, Labels]]:
    """Make labels, chunk by chunk, as they are ready.

    Args:
        request: what to make.
        executor: where; see `chunks.gather`.

    Yields:
        number and labels of each chunk; `join_labels` puts them in order.
    """
    return gather(partial(label_chunk, request), request.chunks, executor)


def join_labels(chunks: dict[int, Labels]) -> Labels:
    """Chunks in order of their numbers."""
    parts = [chunks[number] for number in sorted(chunks)]
    return Labels(
        situations=np.concatenate([part.situations for part in parts]),
        times=np.concatenate([part.times for part in parts]),
        sources=np.concatenate([part.sources for part in parts]),
    )


def label_chunk(request: LabelRequest, number: int) -> Labels:
    """Make one chunk; a function of its arguments alone."""
    rng, (box, reverse, edge) = begin_chunk(request, number)
    parts = [_draw_in_box(rng, request.box, box), _lay_back(rng, request.box, reverse)]
    parts.append(_draw_at_edges(rng, request.box, edge))
    # the last, so that those before are the same with and without them
    parts.append(_draw_in_flight(rng, request.box, round((box + reverse + edge) * request.loops)))
    situations = np.concatenate(parts)
    sources = np.repeat(np.arange(len(SOURCES), dtype=np.int8), [len(part) for part in parts])
    return Labels(situations=situations, times=times_of(situations), sources=sources)


def times_of(situations: Floats) -> Floats:
    """τ of every branch in many situations, shape (n, SIZE)."""
    times = np.empty((len(situations), SIZE))
    branch_times(situations, 0, len(situations), times)
    return times


def canonical(situations: Floats) -> Floats:
    """Situations on the right of the route replaced by their mirror images."""
    x, y, h, alpha = situations.T
    h = wrap_each(h)
    mirrored = np.where(h > 0.0, 2.0 * pi - h, 0.0)
    return np.column_stack((x, np.abs(y), np.where(lies_right(situations), mirrored, h), alpha))


def lies_right(situations: Floats) -> NDArray[np.bool_]:
    """Which situations lie right of the route, or on it and lead there."""
    _, y, h, _ = situations.T
    right: NDArray[np.bool_] = (y < 0.0) | ((y == 0.0) & (wrap_each(h) > pi))
    return right


def _draw_in_box(rng: np.random.Generator, box: Box, size: int) -> Floats:
    """Half of the ranges even in their logarithm, half even: both near and far are common."""
    share = rng.random(size)
    away = np.where(
        rng.random(size) < 0.5, box.max_range * share, box.max_range * 10.0 ** (-3.0 * share)
    )
    bearing, h = rng.uniform(0.0, 2.0 * pi, (2, size))
    alpha = rng.uniform(box.min_ratio, box.max_ratio, size)
    return canonical(np.column_stack((away * np.cos(bearing), away * np.sin(bearing), h, alpha)))


def _lay_back(rng: np.random.Generator, box: Box, size: int) -> Floats:
    """Starts of random paths to the slot, all fastest branches as nearly alike as may be."""
    if size == 0:
        return np.empty((0, 4))
    laid = max(PROPOSALS * size, FEWEST)
    branch = rng.integers(SIZE, size=laid)
    signs = SIGNS[WORD_OF[branch]]  # (laid, 3)
    amounts = rng.uniform(0.0, 2.0 * pi, (laid, 3))
    straight = branch < 4
    far = box.max_range * 10.0 ** (-3.0 * rng.random(laid))
    long_middle = pi + 0.5 * amounts[:, 1]
    middle = np.where(branch % 2 == 1, long_middle, 0.5 * amounts[:, 1])
    amounts[:, 1] = np.where(straight, far, middle)
    alpha = rng.uniform(box.min_ratio, box.max_ratio, laid)
    x, y, h = alpha * amounts.sum(axis=1), np.zeros(laid), np.zeros(laid)
    for piece in (2, 1, 0):
        sign, amount = signs[:, piece], amounts[:, piece]
        before = h - sign * amount
        turning = sign != 0.0
        x -= np.where(turning, sign * (np.sin(h) - np.sin(before)), amount * np.cos(h))
        y -= np.where(turning, -sign * (np.cos(h) - np.cos(before)), amount * np.sin(h))
        h = before
    found = canonical(np.column_stack((x, y, h, alpha)))
    found = found[np.hypot(found[:, 0], found[:, 1]) <= box.max_range]
    best = times_of(found).argmin(axis=1)
    weight = 1.0 / np.maximum(np.bincount(best, minlength=SIZE), 1)[best]
    return found[rng.choice(len(found), size, replace=len(found) < size, p=weight / weight.sum())]


def _draw_at_edges(rng: np.random.Generator, box: Box, size: int) -> Floats:
    """Places next to where the fastest branch changes, at distances even in their logarithm."""
    if size == 0:
        return np.empty((0, 4))
    begun = max(size, FEWEST)
    here = np.concatenate((_draw_in_box(rng, box, begun), _lay_back(rng, box, begun)))
    there = _move(rng, box, here, np.ones(len(here)))
    at_here = times_of(here).argmin(axis=1)
    between = at_here != times_of(there).argmin(axis=1)
    here, there, at_here = here[between], there[between], at_here[between]
    for _ in range(BISECTIONS):
        middle = 0.5 * (here + there)
        same = times_of(middle).argmin(axis=1) == at_here
        here, there = np.where(same[:, None], middle, here), np.where(same[:, None], there, middle)
    chosen = here[rng.integers(len(here), size=size)]
    return _move(rng, box, chosen, 0.3 * 10.0 ** (-3.0 * rng.random(size)))


def _draw_in_flight(rng: np.random.Generator, box: Box, size: int) -> Floats:
    """What the exact planner was asked in flights."""
    met = draw_visited(
        rng,
        size,
        max_range=box.max_range,
        min_ratio=box.min_ratio,
        max_ratio=box.max_ratio,
    )
    return canonical(met[:, :4])


def _move(rng: np.random.Generator, box: Box, situations: Floats, by: Floats) -> Floats:
    """Situations moved at random, by a share of their size, and kept in the box."""
    x, y, h, alpha = situations.T
    step = by[:, None] * rng.normal(size=(len(situations), 4))
    size = 1.0 + np.hypot(x, y)
    x, y = x + size * step[:, 0], y + size * step[:, 1]
    inside = np.minimum(1.0, box.max_range / np.maximum(np.hypot(x, y), 1e-12))
    ratio = np.clip(alpha + 0.3 * step[:, 3], box.min_ratio, box.max_ratio)
    return canonical(np.column_stack((x * inside, y * inside, h + step[:, 2], ratio)))


def request_as_json(request: LabelRequest) -> dict[str, Any]:
    """A request as it is written into a file."""
    return asdict(request)


def save_labels(
    labels: Labels, request: LabelRequest, provenance: dict[str, str], file: Path
) -> None:
    """Write labels: situations, times_r_per_v, sources, and how they were made."""
    about = {
        "file": FILE,
        "request": request_as_json(request),
        "branches": BRANCHES,
        "sources": SOURCES,
        "provenance": provenance,
    }
    columns: tuple[NDArray[Any], ...] = (labels.situations, labels.times, labels.sources)
    save_columns(file, about, dict(zip(COLUMNS, columns, strict=True)))


def load_labels(file: Path) -> tuple[Labels, dict[str, Any]]:
    """Read labels, and what the file says of itself.

    Raises:
        ValueError: if the file does not hold labels.
    """
    about, columns = load_columns(file, FILE, COLUMNS, NONE)
    situations, times, sources = (columns[name] for name in COLUMNS)
    labels = Labels(situations=situations, times=times, sources=sources)
    n = len(labels)
    if labels.times.shape != (n, SIZE) or labels.sources.shape != (n,) or n == 0:
        raise ValueError(f"{file}: its columns do not fit together; make the labels again.")
    if not (labels.times.min(axis=1) < inf).all():
        raise ValueError(f"{file} holds situations without an answer; make the labels again.")
    return labels, about
