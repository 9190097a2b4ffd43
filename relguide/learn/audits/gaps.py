"""surfaces(situations): how near a missed answer is to where its fastest branch begins to exist.

The time of each branch is smooth, but branches begin to exist at surfaces in the space of
situations. Where the fastest one has just begun to, something much slower is best on the other
side: the least time itself jumps, and a network, which is continuous, must miss some of it. The
distance to where the fastest branch ceases to exist, and to where another becomes the fastest,
shows whether a gap is of that kind.

Distances are those of place and heading at the same V_L/V_P: hypot(Δx, Δy, Δh), in R and rad. They
are looked for by bisection along fixed directions: what is found may be a little too long, never
too short.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from relguide.learn.words.branch_labels import Floats, times_of

SMALL = 0.02
"""A gap this close to where a branch begins, or to a switching surface, is explained [R, rad]:
250 m and a degree for an airliner."""
LADDER = np.geomspace(1e-6, 0.5, 20)
"""Distances tried along each direction [R, rad]."""
BISECTIONS = 12
"""Halvings between the last one without and the first one with what is looked for."""
DIRECTIONS = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class Surfaces:
    """How near surfaces are to each situation; infinite where none was found."""

    birth: Floats
    """To where its fastest branch does not exist [R, rad]."""
    switch: Floats
    """To where it is not the fastest, whether it exists or not [R, rad]."""

    @property
    def near(self) -> NDArray[np.bool_]:
        """Whether one is near enough to explain a gap."""
        near: NDArray[np.bool_] = np.minimum(self.birth, self.switch) <= SMALL
        return near


def surfaces(situations: Floats, progress: Callable[[float], object] = lambda _: None) -> Surfaces:
    """Find the distances; 20 ms a situation.

    Args:
        situations: x, y [R], h [rad], α. shape (n, 4)
        progress: called with 1 after each.
    """
    birth, switch = np.empty(len(situations)), np.empty(len(situations))
    best = times_of(situations).argmin(axis=1).tolist()
    for i, (situation, branch) in enumerate(zip(situations, best, strict=True)):
        birth[i] = _distance(situation, partial(_has_vanished, branch))
        switch[i] = _distance(situation, partial(_is_beaten, branch))
        progress(1.0)
    return Surfaces(birth=birth, switch=switch)


def _has_vanished(branch: int, times: Floats) -> NDArray[np.bool_]:
    gone: NDArray[np.bool_] = ~np.isfinite(times[:, branch])
    return gone


def _is_beaten(branch: int, times: Floats) -> NDArray[np.bool_]:
    beaten: NDArray[np.bool_] = times.argmin(axis=1) != branch
    return beaten


def _distance(situation: Floats, beyond: Callable[[Floats], NDArray[np.bool_]]) -> float:
    """To the nearest place found where something holds of the branches' times."""
    directions = _directions()
    steps = LADDER[None, :] * np.ones((DIRECTIONS, 1))
    holds = beyond(times_of(_move(situation, directions, steps))).reshape(steps.shape)
    there = holds.any(axis=1)
    if not there.any():
        return float("inf")
    directions, first = directions[there], holds[there].argmax(axis=1)
    far = LADDER[first]
    near = np.where(first > 0, LADDER[np.maximum(first - 1, 0)], 0.0)
    for _ in range(BISECTIONS):
        middle = 0.5 * (near + far)
        out = beyond(times_of(_move(situation, directions, middle[:, None])))
        near, far = np.where(out, near, middle), np.where(out, middle, far)
    return float(far.min())


def _move(situation: Floats, directions: Floats, steps: Floats) -> Floats:
    """A situation moved along each direction by its steps, shape (directions · steps, 4)."""
    moved = situation[:3] + steps[:, :, None] * directions[:, None, :]
    ratio = np.full((*steps.shape, 1), situation[3])
    return np.concatenate((moved, ratio), axis=2).reshape(-1, 4)


def _directions() -> Floats:
    """Along the axes, and evenly at random over the sphere; always the same."""
    axes = np.concatenate((np.eye(3), -np.eye(3)))
    others = np.random.default_rng(0).normal(size=(DIRECTIONS - len(axes), 3))
    return np.concatenate((axes, others / np.linalg.norm(others, axis=1, keepdims=True)))
