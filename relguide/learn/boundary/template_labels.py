"""Situations in which the limit binds, and their exact answers in bulk.

The leader keeps straight and the air is calm, or the wind along its heading; what remains of a
situation in the slot frame are six numbers, x, y, h, α, D/R, d_min/R. Four sources, as the box
alone hardly ever meets what is hard: `tight`, within some widths of a disc larger than R; `near`,
round a disc smaller than R; `far`, anywhere; `along`, somewhere on the path of another one's answer
or a little off it, which is what a closed loop asks. Of each, those are kept in which the fastest
path without the limit breaks it.

An answer takes the search some milliseconds. So labels are made in small chunks, each a function of
the request and its number, and every chunk is written down as it is ready: a run that was stopped
goes on from there.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import partial
from math import inf, isfinite, log, pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.contact.chain import MAX_LEGS
from relguide.kernels.contact.constrained_rows import limit_binds_rows, solve_constrained_rows
from relguide.kernels.networks.along_path import advance_rows, along_rows
from relguide.learn.training.chunks import gather
from relguide.learn.training.requests import (
    begin_chunk,
    check_ratios,
    check_request,
    chunks_of,
)
from relguide.planning.constrained_path import BEARINGS

Floats = NDArray[np.float64]
SOURCES = ("tight", "near", "far", "along")
"""Where a situation comes from, by number."""
LONGEST = 2000.0
"""Paths that take longer count as none [R/V_P]: 12 hours at R/V_P = 21 s."""
DRAWN = 1024
"""Situations drawn at a time, to see where the limit binds."""
LEAST_TURN = 0.05
"""First turns shorter than this are not looked at again [rad]."""
OFF = (1e-3, 0.3)
"""How far off a path `along` puts a pursuer, by a normal law: its scale between these [R, rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateBox:
    """The situations that are learnt; beyond them nothing is claimed."""

    min_ratio: float = 0.5
    """Least V_L/V_P."""
    max_ratio: float = 0.99
    """Largest V_L/V_P."""
    min_limit: float = 0.15
    """Least d_min [R]."""
    max_limit: float = 4.0
    """Largest d_min [R]."""
    max_slot: float = 4.0
    """Largest D [d_min]; the least is 1."""
    max_range: float = 25.0
    """Farthest from the disc round the leader [R]."""

    def __post_init__(self) -> None:
        """Refuse a box that holds nothing, or where the slot may be out of reach."""
        check_ratios(self.min_ratio, self.max_ratio)
        if not 0.0 < self.min_limit < 1.0 < self.max_limit < inf:
            raise ValueError(
                f"d_min must reach from below R to above it, not {self.min_limit:g} … "
                f"{self.max_limit:g} R."
            )
        if not (isfinite(self.max_slot) and self.max_slot > 1.0 and 1.0 < self.max_range < inf):
            raise ValueError(
                f"max_slot and max_range must be above 1, not {self.max_slot:g} and "
                f"{self.max_range:g}."
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateLabelRequest:
    """What labels to make. The same request gives the same labels."""

    count: int
    seed: int = 0
    box: TemplateBox = field(default_factory=TemplateBox)
    shares: tuple[float, float, float, float] = (0.35, 0.25, 0.25, 0.15)
    """Of `SOURCES`."""
    chunk: int = 250
    """Labels made at a time."""

    def __post_init__(self) -> None:
        """Refuse what is no request."""
        check_request(self)

    @property
    def chunks(self) -> int:
        """How many chunks there are."""
        return chunks_of(self)


class ConstrainedPaths(NamedTuple):
    """Situations and their fastest paths, as columns of `TemplateLabels`."""

    situations: Floats
    times: Floats
    """Of the paths. shape (n,)"""
    counts: NDArray[np.int8]
    legs: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateLabels:
    """Situations in which the limit binds and their exact answers, as columns."""

    situations: Floats
    """x, y ≥ 0 [R], h in [0, 2π) [rad], α, D/R, d_min/R, in the slot frame. shape (n, 6)"""
    times: Floats
    """Without the limit, by the fastest extremal that keeps it, and by the fastest path [R/V_P];
    infinite where there is none. shape (n, 3)"""
    counts: NDArray[np.int8]
    """Legs of the path; 0 where there is none. shape (n,)"""
    legs: Floats
    """As in `kernels.contact.chain.Chain`. shape (n, MAX_LEGS, 6)"""
    sources: NDArray[np.int8]
    """Numbers of `SOURCES`. shape (n,)"""

    def __len__(self) -> int:
        return len(self.situations)

    @property
    def paths(self) -> ConstrainedPaths:
        """What they say of the fastest paths."""
        times = np.ascontiguousarray(self.times[:, 2])
        return ConstrainedPaths(self.situations, times, self.counts, self.legs)

    def columns(self) -> tuple[NDArray[Any], ...]:
        """All of them, in this order."""
        return self.situations, self.times, self.counts, self.legs, self.sources


def make_template_labels(
    request: TemplateLabelRequest, executor: Executor, *, made: frozenset[int] = frozenset()
) -> Iterator[tuple[int, TemplateLabels]]:
    """Make labels, chunk by chunk, as they are ready.

    Args:
        request: what to make.
        executor: where; see `chunks.gather`.
        made: numbers of chunks that are there already.

    Yields:
        number and labels of each other chunk; `join_labels` puts them in order.
    """
    missing = tuple(n for n in range(request.chunks) if n not in made)
    task = partial(_missing_chunk, request, missing)
    for n, labels in gather(task, len(missing), executor):
        yield missing[n], labels


def from_columns(
    situations: Floats, times: Floats, counts: NDArray[np.int8], legs: Floats,
    sources: NDArray[np.int8],
) -> TemplateLabels:  # fmt: skip
    """Labels of `TemplateLabels.columns`."""
    return TemplateLabels(
        situations=situations, times=times, counts=counts, legs=legs, sources=sources
    )


def pick_paths(paths: ConstrainedPaths, rows: NDArray[Any]) -> ConstrainedPaths:
    """Some of them: by their places, or by whether they are wanted."""
    return ConstrainedPaths(*(column[rows] for column in paths))


def advance_paths(paths: ConstrainedPaths, rng: np.random.Generator) -> ConstrainedPaths:
    """The rest of each path from some moment of its first turn on: as exact, and costs no search.

    Paths without a contact, or without a first turn worth the name, are left out.
    """
    turning = (paths.counts > 1) & (paths.legs[:, 0, 3] > LEAST_TURN)
    rest = pick_paths(paths, turning)  # a copy, which is put forward in place
    advance_rows(
        rest.situations, rest.times, rest.counts.astype(float), rest.legs,
        rng.random(len(rest.times)),
    )  # fmt: skip
    return rest


def _missing_chunk(
    request: TemplateLabelRequest, missing: tuple[int, ...], n: int
) -> TemplateLabels:
    return template_label_chunk(request, missing[n])


def join_labels(chunks: dict[int, TemplateLabels]) -> TemplateLabels:
    """Chunks in order of their numbers."""
    parts = zip(*(chunks[number].columns() for number in sorted(chunks)), strict=True)
    return from_columns(*(np.concatenate(part) for part in parts))


def template_label_chunk(request: TemplateLabelRequest, number: int) -> TemplateLabels:
    """Make one chunk; a function of its arguments alone."""
    rng, sizes = begin_chunk(request, number)
    drawn = [_draw(rng, request.box, source, n) for source, n in enumerate(sizes[:3])]
    first = _answer(np.concatenate(drawn), np.repeat(np.arange(3, dtype=np.int8), sizes[:3]))
    if sizes[3] == 0:
        return first
    second = _draw_along_paths(rng, request.box, first, sizes[3])
    return join_labels({0: first, 1: _answer(second, np.full(sizes[3], 3, dtype=np.int8))})


def _answer(situations: Floats, sources: NDArray[np.int8]) -> TemplateLabels:
    times, counts, legs = answers_of(situations)
    return TemplateLabels(
        situations=situations, times=times, counts=counts, legs=legs, sources=sources
    )


def answers_of(situations: Floats) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Times, numbers of legs and legs of the fastest paths, as in `TemplateLabels`."""
    n = len(situations)
    times, counts, legs = np.empty((n, 3)), np.empty(n), np.zeros((n, MAX_LEGS, 6))
    solve_constrained_rows(situations, BEARINGS, LONGEST, times, counts, legs)
    return times, counts.astype(np.int8), legs


def _draw(rng: np.random.Generator, box: TemplateBox, source: int, size: int) -> Floats:
    """Situations of one source in which the limit binds."""
    found = np.empty((0, 6))
    while len(found) < size:
        drawn = draw_situations(rng, box, source, DRAWN)
        binds = np.empty(DRAWN)
        limit_binds_rows(drawn, binds)
        found = np.concatenate((found, drawn[binds == 1.0]))
    return found[:size]


def _draw_along_paths(
    rng: np.random.Generator, box: TemplateBox, labels: TemplateLabels, size: int
) -> Floats:
    """Situations on the paths of others, or a little off them, in which the limit binds."""
    parents = np.flatnonzero(labels.counts > 1)
    if len(parents) == 0:
        return _draw(rng, box, 0, size)
    found = np.empty((0, 6))
    while len(found) < size:
        chosen = rng.choice(parents, DRAWN)
        scale = np.exp(rng.uniform(log(OFF[0]), log(OFF[1]), DRAWN))
        off = scale[:, None] * rng.normal(size=(DRAWN, 3))
        there = np.empty((DRAWN, 6))
        along_rows(
            labels.situations[chosen], labels.times[chosen, 2] * rng.random(DRAWN),
            labels.counts[chosen].astype(float), labels.legs[chosen], off, there,
        )  # fmt: skip
        away = np.hypot(there[:, 0] - there[:, 4], there[:, 1]) - there[:, 5]
        binds = np.empty(DRAWN)
        limit_binds_rows(there, binds)
        found = np.concatenate(
            (found, there[(binds == 1.0) & (away >= 0.0) & (away <= box.max_range)])
        )
    return found[:size]


def draw_situations(rng: np.random.Generator, box: TemplateBox, source: int, size: int) -> Floats:
    """Situations of one source, the pursuer on the left of the route."""
    alpha = rng.uniform(box.min_ratio, box.max_ratio, size)
    if source == 0:
        limit = rng.uniform(1.0, box.max_limit, size)
        away = limit * rng.uniform(1.0, 1.6, size)
    elif source == 1:
        limit = rng.uniform(box.min_limit, 1.0, size)
        away = limit * rng.uniform(1.0, 8.0, size)
    else:
        limit = np.exp(rng.uniform(log(box.min_limit), log(box.max_limit), size))
        away = limit + np.exp(rng.uniform(log(0.3), log(box.max_range), size))
    most = np.where(rng.random(size) < 0.5, min(2.0, box.max_slot), box.max_slot)
    slot = limit * rng.uniform(1.0, most, size)
    bearing, h = rng.uniform(0.0, pi, size), rng.uniform(0.0, 2.0 * pi, size)
    x, y = slot + away * np.cos(bearing), away * np.sin(bearing)
    return np.column_stack((x, y, h, alpha, slot, limit))
