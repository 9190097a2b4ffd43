"""One step of reverse dynamic programming: every (turn, straight) pair laid back from many states.

Seen from the slot the leader stands still, so what a pair reaches and how close it comes depend on
the state it leads to and on nothing else: laying pairs back from the slot works with the separation
limit. A pair flown forward is a turn θ = kΔθ, then a straight l = hΔl; laid back, the straight
comes first. Headings stay multiples of Δθ, numbered 0 … N − 1.

The tree is kept on one side, y ≥ 0: a state of the other side is stored as its mirror image.

Slot frame, moving with the slot: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, hypot, inf, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import piece_clears

IntArray = np.ndarray[tuple[int, ...], np.dtype[np.int32]]

TOUCH = 5e-7
"""Touching d_min counts as keeping it, to this much of R: half of what the certificate allows."""
TIE = 1e-9
"""A way must be faster than the one before it by this much [R/V_P], else rounding would decide."""
FITS = 1e-9
"""By how much a whole number of Δl may pass what is left of a straight [Δl]: rounding."""


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
def laid_back(
    x: float, y: float, c: float, s: float, before_c: float, before_s: float, turn: int,
    angle: float, length: float, alpha: float,
) -> tuple[float, float]:  # fmt: skip
    """Where a pair begins that ends at (x, y).

    Args:
        x: its end, ahead of the slot [R].
        y: and left of it [R].
        c: cos of the heading it ends on.
        s: sin of it.
        before_c: cos of the heading it begins on.
        before_s: sin of it.
        turn: ε of its turn, +1 left.
        angle: θ [rad].
        length: l [R].
        alpha: V_L/V_P.
    """
    x += length * (alpha - c) - turn * (s - before_s) + alpha * angle
    y += -length * s + turn * (c - before_c)
    return x, y


@njit(cache=True, nogil=True)
def free_length(
    x: float, y: float, c: float, s: float, leader_x: float, alpha: float, limit: float
) -> float:
    """How long a straight that ends at (x, y) may be before it has begun too close, (21)–(24).

    Seen from the leader it is laid back along w = (α − cos h, −sin h) in closed form:
    d² = |p|² + 2 l p·w + l²|w|².
    """
    px, wx, wy = x - leader_x, alpha - c, -s
    along, speed_squared = px * wx + y * wy, wx * wx + wy * wy
    if along >= 0.0 or speed_squared == 0.0:
        return inf
    spare = px * px + y * y - limit * limit
    root = along * along - speed_squared * spare
    if root <= 0.0:
        return inf
    return (-along - sqrt(root)) / speed_squared


@njit(cache=True, nogil=True)
def turn_clears(
    x: float, y: float, h: float, turn: int, angle: float, leader: FloatArray, alpha: float,
    limit: float,
) -> bool:  # fmt: skip
    """Whether the turn that begins at (x, y, h) stays `limit` away from the leader, as an arc."""
    # in the leader's frame no point of it is farther from its start than this
    reach = min(angle, 2.0) + alpha * angle
    if hypot(x - leader[0, 1], y) - reach >= limit:
        return True
    return bool(
        piece_clears(Pose(x, y, h), float(turn), 0.0, angle, Scene(leader, alpha, limit, 0.0))
    )


@njit(cache=True, nogil=True)
def expand(
    parents: IntArray, states: FloatArray, headings: IntArray, turns: IntArray, table: FloatArray,
    heading: int, alpha: float, leader_x: float, limit: float, horizon: float, delta_l: float,
    cell: float, x_low: float, nx: int, ny: int, best: FloatArray, origin: IntArray, pair: IntArray,
) -> tuple[int, int]:  # fmt: skip
    """Lay every pair back that begins on one heading, or on its mirror image.

    Nothing but the cells of these two headings is written, and parents are taken in order: threads
    with a heading each never meet, and their number changes nothing. A cell keeps the least time;
    of equal ones the first.

    Args:
        parents: the states to begin from.
        states: x, y, time-to-converge of every state. shape (n, 3)
        headings: the heading's number of every state. shape (n,)
        turns: ε of the turn every state begins with; 0 of a straight or the slot. shape (n,)
        table: `compass` of the N headings.
        heading: the one that pairs begin on, by number.
        alpha: V_L/V_P.
        leader_x: D [R].
        limit: d_min [R].
        horizon: longest time-to-converge [R/V_P].
        delta_l: Δl [R].
        cell: its edge [R].
        x_low: where the first cell begins [R].
        nx: cells along x.
        ny: cells along y, from 0 on.
        best: least time of each cell so far. shape (N, nx, ny)
        origin: takes the parent where a cell improves. shape (N, nx, ny)
        pair: takes (h, k, ε, 1 if mirrored) there. shape (N, nx, ny, 4)

    Returns:
        how many trajectories were laid, and how many of them came too close.
    """
    n_headings = len(table)
    delta_theta = 2.0 * pi / n_headings
    leader = np.zeros((1, 5))
    leader[0, 1] = leader_x
    near = max(limit - TOUCH, 0.0)
    laid, close = 0, 0
    for parent in parents:
        x, y, t = states[parent, 0], states[parent, 1], states[parent, 2]
        after = headings[parent]
        c, s = table[after, 0], table[after, 1]
        free = free_length(x, y, c, s, leader_x, alpha, near)
        for side in range(2):
            j = heading if side == 0 else (n_headings - heading) % n_headings
            if side == 1 and j == heading:
                break
            before_c, before_s = table[j, 0], table[j, 1]
            for turn in (1, -1):
                k = (turn * (after - j)) % n_headings
                if k == 0 and turn == -1:
                    continue  # no turn at all is one pair, not two
                angle = k * delta_theta
                left = horizon - t - angle
                if left < 0.0:
                    continue
                longest = int(min(left / delta_l + FITS, free / delta_l))
                # nothing at all, or two turns that are one, lead nowhere new
                shortest = 1 if k == 0 or turn == turns[parent] else 0
                laid += max(longest - shortest + 1, 0)
                for h in range(shortest, longest + 1):
                    length = h * delta_l
                    time = t + angle + length
                    at_x, at_y = laid_back(
                        x, y, c, s, before_c, before_s, turn, angle, length, alpha
                    )
                    mirrored = at_y < 0.0 or (at_y == 0.0 and 2 * j > n_headings)
                    m = (n_headings - j) % n_headings if mirrored else j
                    # the very edge of the region belongs to its last cell
                    ix = min(max(int((at_x - x_low) / cell), 0), nx - 1)
                    iy = min(int(abs(at_y) / cell), ny - 1)
                    if time >= best[m, ix, iy] - TIE:
                        continue
                    h_before = j * delta_theta
                    if k > 0 and not turn_clears(
                        at_x, at_y, h_before, turn, angle, leader, alpha, near
                    ):
                        close += 1
                        continue
                    best[m, ix, iy] = time
                    origin[m, ix, iy] = parent
                    pair[m, ix, iy, 0] = h
                    pair[m, ix, iy, 1] = k
                    pair[m, ix, iy, 2] = turn
                    pair[m, ix, iy, 3] = 1 if mirrored else 0
    return laid, close


@njit(cache=True, nogil=True)
def settle(
    parents: IntArray, pairs: IntArray, states: FloatArray, headings: IntArray, table: FloatArray,
    alpha: float, delta_l: float, settled: FloatArray, settled_headings: IntArray,
) -> None:  # fmt: skip
    """The states at which the pairs begin that `expand` has kept.

    Args:
        parents: the state each pair leads to. shape (m,)
        pairs: (h, k, ε, mirrored) of each. shape (m, 4)
        states: as in `expand`.
        headings: as in `expand`.
        table: as in `expand`.
        alpha: V_L/V_P.
        delta_l: Δl [R].
        settled: takes x, y, time. shape (m, 3)
        settled_headings: takes the heading's number. shape (m,)
    """
    n_headings = len(table)
    delta_theta = 2.0 * pi / n_headings
    for i in range(len(parents)):
        parent, h, k, turn = parents[i], pairs[i, 0], pairs[i, 1], pairs[i, 2]
        after = headings[parent]
        j = (after - turn * k) % n_headings
        angle, length = k * delta_theta, h * delta_l
        x, y = laid_back(
            states[parent, 0], states[parent, 1], table[after, 0], table[after, 1], table[j, 0],
            table[j, 1], turn, angle, length, alpha,
        )  # fmt: skip
        mirrored = pairs[i, 3] != 0
        settled[i, 0], settled[i, 1] = x, -y if mirrored else y
        settled[i, 2] = states[parent, 2] + angle + length
        settled_headings[i] = (n_headings - j) % n_headings if mirrored else j
