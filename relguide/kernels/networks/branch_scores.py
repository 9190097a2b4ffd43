"""A feed-forward network of branches, evaluated for one situation, and decoded.

Layers of one width with SiLU between them; three numbers come out for each branch: the score by
which it is chosen, the logit of its existence, log(1 + τ). Weights are float32, as they were
trained. Left and right are exchanged before and after if the situation is on the right of the
route, so mirror images get mirrored answers, to the last bit.
"""

from math import exp, inf
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.margins import INPUTS, inputs
from relguide.kernels.networks.network_view import mirror_to_left
from relguide.kernels.words.branches import MIRROR_OF, SIZE, WORD_OF, branch_of
from relguide.kernels.words.extremals import MAX_ROWS, solve_word


class Layers(NamedTuple):
    """Weights by layer, inputs along the first axis. float32."""

    first: Any
    """shape (inputs, width)"""
    first_bias: Any
    """shape (width,)"""
    hidden: Any
    """shape (depth − 1, width, width)"""
    hidden_bias: Any
    """shape (depth − 1, width)"""
    last: Any
    """shape (width, outputs)"""
    last_bias: Any
    """shape (outputs,)"""


@njit(cache=True, nogil=True)
def evaluate(pose: Pose, alpha: float, layers: Layers, scores: FloatArray) -> None:
    """What the network says of a situation.

    Args:
        pose: the pursuer's, seen from the slot; its heading in [0, 2π).
        alpha: V_L/V_P, below 1.
        layers: the weights.
        scores: takes score, logit and log(1 + τ) of each branch. shape (3, SIZE)
    """
    left, mirrored = mirror_to_left(pose)
    numbers = np.empty(INPUTS)
    inputs(left, alpha, numbers)
    a = last_hidden_layer(numbers, layers)
    out = layers.last_bias.copy()
    for i in range(len(a)):
        value = a[i]
        for j in range(3 * SIZE):
            out[j] += value * layers.last[i, j]
    for which in range(3):
        for s in range(SIZE):
            scores[which, MIRROR_OF[s] if mirrored else s] = out[which * SIZE + s]


@njit(cache=True, nogil=True)
def last_hidden_layer(numbers: FloatArray, layers: Layers) -> FloatArray:
    """The layer before the outputs, float32.

    Args:
        numbers: the inputs, not scaled. shape (inputs,)
        layers: the weights.
    """
    width = len(layers.first_bias)
    a: FloatArray = layers.first_bias.copy()
    for i in range(len(numbers)):
        value = np.float32(numbers[i])
        for j in range(width):
            a[j] += value * layers.first[i, j]
    _silu(a)
    for k in range(len(layers.hidden)):
        b = layers.hidden_bias[k].copy()
        for i in range(width):
            value = a[i]
            for j in range(width):
                b[j] += value * layers.hidden[k, i, j]
        _silu(b)
        a = b
    return a


@njit(cache=True, nogil=True, fastmath=True)
def _silu(a: FloatArray) -> None:
    for j in range(len(a)):
        a[j] = a[j] / (np.float32(1.0) + np.exp(-a[j]))


@njit(cache=True, nogil=True)
def shares(scores: FloatArray, out: FloatArray) -> None:
    """How likely the network takes each branch to be the fastest: softmax of its scores.

    Args:
        scores: of `evaluate`; its first row counts. shape (3, SIZE)
        out: takes them. shape (SIZE,)
    """
    most = scores[0].max()
    for s in range(SIZE):
        out[s] = exp(scores[0, s] - most)
    out /= out.sum()


@njit(cache=True, nogil=True)
def choose(
    x: float, y: float, h: float, alpha: float, layers: Layers, least_share: float, most: int,
    rows: FloatArray,
) -> tuple[int, int]:  # fmt: skip
    """Solve the words that the network holds possible, exactly, and no others.

    Its numbers are loose for one call from Python a plan.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        layers: the weights.
        least_share: branches with a smaller share than this are left out.
        most: with more branches than this, nothing is solved.
        rows: takes their extremals by time, as `solve` gives them. shape (MAX_ROWS, 5)

    Returns:
        how many branches are held possible, and how many rows there are.
    """
    pose, scores = Pose(x, y, h), np.empty((3, SIZE))
    evaluate(pose, alpha, layers, scores)
    return decode(pose, alpha, scores, least_share, most, rows)


@njit(cache=True, nogil=True)
def decode(
    pose: Pose, alpha: float, scores: FloatArray, least_share: float, most: int, rows: FloatArray
) -> tuple[int, int]:
    """`choose`, from the scores of `evaluate`, shape (3, SIZE)."""
    share = np.empty(SIZE)
    shares(scores, share)
    held = 0
    for s in range(SIZE):
        held += share[s] >= least_share
    if held > most:
        return held, 0
    found = np.empty((MAX_ROWS, 4))
    n, before = 0, -1
    for s in range(SIZE):
        # both branches of a word come from one solution of it
        if share[s] >= least_share and WORD_OF[s] != before:
            before = WORD_OF[s]
            n = solve_word(pose, Velocity(alpha, 0.0), Window(0.0, inf), before, found, rows, n)
    return held, n


@njit(cache=True, nogil=True)
def judge_branches(
    situations: FloatArray, layers: Layers, least_share: float, most: int, scores: FloatArray,
    verdicts: FloatArray,
) -> None:  # fmt: skip
    """`evaluate` and `choose` for many situations.

    Args:
        situations: x, y, h in [0, 2π), α. shape (n, 4)
        layers: the weights.
        least_share: as in `choose`.
        most: as in `choose`.
        scores: takes what the network says. shape (n, 3, SIZE)
        verdicts: takes how many branches are held possible, the least time that `choose` finds
            [R/V_P] (infinite if there is none), and its branch (−1 if there is none). shape (n, 3)
    """
    rows = np.empty((MAX_ROWS, 5))
    for n in range(len(situations)):
        x, y, h, alpha = situations[n]
        pose = Pose(x, y, h)
        evaluate(pose, alpha, layers, scores[n])
        held, found = decode(pose, alpha, scores[n], least_share, most, rows)
        verdicts[n, 0] = held
        verdicts[n, 1] = rows[0, 0] if found > 0 else np.inf
        verdicts[n, 2] = branch_of(rows[0]) if found > 0 else -1
