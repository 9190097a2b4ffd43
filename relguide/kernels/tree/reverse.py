"""One step of reverse dynamic programming: every (turn, straight) pair laid back from many states.

Seen from the slot the leader stands still, so where a pair begins and how close it comes depend
only on the state it leads to: laying pairs back from the slot works with the separation limit. A
pair flown forward is a turn θ = kΔθ, then a straight l = hΔl; laid back, the straight comes first.
Headings stay multiples of Δθ, numbered 0 … N − 1.

The tree is kept on one side, y ≥ 0: a state of the other side is stored as its mirror image.

Slot frame, moving with the slot: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import piece_clears

IntArray = np.ndarray[tuple[int, ...], np.dtype[np.int32]]

TOUCH = 5e-7
"""Touching d_min counts as keeping it, to this much of R: half of what the certificate allows."""
TIE = 1e-9
"""A path must be faster than the one before it by this much [R/V_P], else rounding decides."""
FITS = 1e-9
"""By how much a whole number of Δl may exceed the length of a straight [Δl]: rounding."""


class State(NamedTuple):
    """What a pair leads to, seen from the slot."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    c: float
    """cos h."""
    s: float
    """sin h."""


class Direction(NamedTuple):
    """A heading."""

    c: float
    """cos h."""
    s: float
    """sin h."""


class Pair(NamedTuple):
    """A turn, then a straight."""

    turn: int
    """ε, +1 left."""
    angle: float
    """θ [rad]."""
    length: float
    """l [R]."""


class Nodes(NamedTuple):
    """All states of a tree."""

    states: FloatArray
    """x, y, time-to-converge. shape (n, 3)"""
    headings: IntArray
    """The heading's number. shape (n,)"""
    turns: IntArray
    """ε of the turn each begins with; 0 of a straight or the slot. shape (n,)"""


class Mesh(NamedTuple):
    """How far and how finely pairs and cells are laid."""

    horizon: float
    """Longest time-to-converge [R/V_P]."""
    delta_l: float
    """Δl [R]."""
    cell: float
    """Edge of a cell [R]."""
    x_low: float
    """Where the first cell begins; along y they begin at 0 [R]."""
    nx: int
    """Cells along x."""
    ny: int
    """Cells along y."""


class Cells(NamedTuple):
    """What has reached each cell, of N headings."""

    best: FloatArray
    """Least time so far. shape (N, nx, ny)"""
    origin: IntArray
    """The parent, where a cell has improved. shape (N, nx, ny)"""
    pair: IntArray
    """(h, k, ε, 1 if mirrored) there. shape (N, nx, ny, 4)"""


@njit(cache=True, nogil=True)
def compass(headings: int) -> FloatArray:
    """Cosine and sine of each heading, shape (N, 2), mirror images to the last digit."""
    table = np.empty((headings, 2))
    for j in range(headings // 2 + 1):
        table[j, 0], table[j, 1] = cos(2.0 * pi * j / headings), sin(2.0 * pi * j / headings)
        if 2 * j == headings:
            table[j, 0], table[j, 1] = -1.0, 0.0
        other = (headings - j) % headings
        if other != j:
            table[other, 0], table[other, 1] = table[j, 0], -table[j, 1]
    return table


@njit(cache=True, nogil=True)
def lay_back(end: State, before: Direction, pair: Pair, alpha: float) -> tuple[float, float]:
    """Where a pair begins [R].

    Args:
        end: the state it leads to.
        before: the heading it begins on.
        pair: what is flown.
        alpha: V_L/V_P.
    """
    turn, angle, length = pair
    x = end.x + (length * (alpha - end.c) - turn * (end.s - before.s) + alpha * angle)
    y = end.y + (-length * end.s + turn * (end.c - before.c))
    return x, y


@njit(cache=True, nogil=True)
def free_length(end: State, scene: Scene) -> float:
    """How long a straight to this end may be before it has begun closer than d_min, (21)–(24).

    Seen from the leader it is laid back along w = (α − cos h, −sin h) in closed form:
    d² = |p|² + 2 l p·w + l²|w|².
    """
    px, y = end.x - scene.leader[0, 1], end.y
    wx, wy = scene.alpha - end.c, -end.s
    along, speed_squared = px * wx + y * wy, wx * wx + wy * wy
    if along >= 0.0 or speed_squared == 0.0:
        return inf
    spare = px * px + y * y - scene.d_min * scene.d_min
    root = along * along - speed_squared * spare
    if root <= 0.0:
        return inf
    return float((-along - sqrt(root)) / speed_squared)


@njit(cache=True, nogil=True)
def turn_clears(pose: Pose, turn: int, angle: float, scene: Scene) -> bool:
    """Whether the turn that begins at a pose keeps d_min, as an arc."""
    # in the leader's frame no point of it is farther from its start than this
    reach = min(angle, 2.0) + scene.alpha * angle
    if hypot(pose.x - scene.leader[0, 1], pose.y) - reach >= scene.d_min:
        return True
    return bool(piece_clears(pose, float(turn), 0.0, angle, scene))


@njit(cache=True, nogil=True)
def expand(
    parents: IntArray, nodes: Nodes, table: FloatArray, heading: int, scene: Scene, mesh: Mesh,
    cells: Cells,
) -> tuple[int, int]:  # fmt: skip
    """Lay every pair back that begins on one heading, or on its mirror image.

    Nothing but the cells of these two headings is written, and parents are taken in order: threads
    with a heading each never meet, and their number changes nothing. A cell keeps the least time;
    of equal ones the first.

    Args:
        parents: the states to begin from, by number.
        nodes: every state.
        table: `compass` of the N headings.
        heading: the one that pairs begin on, by number.
        scene: of `straight_scene`.
        mesh: how far and how finely pairs and cells are laid.
        cells: kept up to date.

    Returns:
        how many trajectories were laid, and how many of them came too close.
    """
    n_headings = len(table)
    delta_theta = 2.0 * pi / n_headings
    near = with_limit(scene, max(scene.d_min - TOUCH, 0.0))
    laid, close = 0, 0
    for parent in parents:
        x, y, t = nodes.states[parent, 0], nodes.states[parent, 1], nodes.states[parent, 2]
        after = nodes.headings[parent]
        end = State(x, y, table[after, 0], table[after, 1])
        free = free_length(end, near)
        for side in range(2):
            j = heading if side == 0 else (n_headings - heading) % n_headings
            if side == 1 and j == heading:
                break
            before = Direction(table[j, 0], table[j, 1])
            for turn in (1, -1):
                k = (turn * (after - j)) % n_headings
                if k == 0 and turn == -1:
                    continue  # no turn at all is one pair, not two
                angle = k * delta_theta
                left = mesh.horizon - t - angle
                if left < 0.0:
                    continue
                longest = int(min(left / mesh.delta_l + FITS, free / mesh.delta_l))
                # nothing at all, or two turns that are one, lead nowhere new
                shortest = 1 if k == 0 or turn == nodes.turns[parent] else 0
                laid += max(longest - shortest + 1, 0)
                for h in range(shortest, longest + 1):
                    length = h * mesh.delta_l
                    time = t + angle + length
                    at_x, at_y = lay_back(end, before, Pair(turn, angle, length), scene.alpha)
                    mirrored = at_y < 0.0 or (at_y == 0.0 and 2 * j > n_headings)
                    m = (n_headings - j) % n_headings if mirrored else j
                    # the very edge of the region belongs to its last cell
                    ix = min(max(int((at_x - mesh.x_low) / mesh.cell), 0), mesh.nx - 1)
                    iy = min(int(abs(at_y) / mesh.cell), mesh.ny - 1)
                    if time >= cells.best[m, ix, iy] - TIE:
                        continue
                    begin = Pose(at_x, at_y, j * delta_theta)
                    if k > 0 and not turn_clears(begin, turn, angle, near):
                        close += 1
                        continue
                    cells.best[m, ix, iy] = time
                    cells.origin[m, ix, iy] = parent
                    cells.pair[m, ix, iy, 0] = h
                    cells.pair[m, ix, iy, 1] = k
                    cells.pair[m, ix, iy, 2] = turn
                    cells.pair[m, ix, iy, 3] = 1 if mirrored else 0
    return laid, close


@njit(cache=True, nogil=True)
def settle(
    parents: IntArray, pairs: IntArray, nodes: Nodes, table: FloatArray, alpha: float,
    delta_l: float,
) -> tuple[FloatArray, IntArray]:  # fmt: skip
    """The states at which the pairs begin that `expand` has kept.

    Args:
        parents: the state each pair leads to. shape (m,)
        pairs: (h, k, ε, mirrored) of each. shape (m, 4)
        nodes: as in `expand`.
        table: as in `expand`.
        alpha: V_L/V_P.
        delta_l: Δl [R].

    Returns:
        x, y, time, shape (m, 3), and the heading's number, shape (m,).
    """
    settled, headings = np.empty((len(parents), 3)), np.empty(len(parents), np.int32)
    n_headings = len(table)
    delta_theta = 2.0 * pi / n_headings
    for i in range(len(parents)):
        parent, h, k, turn = parents[i], pairs[i, 0], pairs[i, 1], pairs[i, 2]
        after = nodes.headings[parent]
        j = (after - turn * k) % n_headings
        angle, length = k * delta_theta, h * delta_l
        state = nodes.states[parent]
        end = State(state[0], state[1], table[after, 0], table[after, 1])
        before = Direction(table[j, 0], table[j, 1])
        x, y = lay_back(end, before, Pair(turn, angle, length), alpha)
        mirrored = pairs[i, 3] != 0
        settled[i, 0], settled[i, 1] = x, -y if mirrored else y
        settled[i, 2] = state[2] + angle + length
        headings[i] = (n_headings - j) % n_headings if mirrored else j
    return settled, headings
