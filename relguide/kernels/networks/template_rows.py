"""The template networks, held against exact answers in bulk.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a leader that keeps straight is
at (D/R, 0) at t = 0 and keeps heading 0.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_scores import (
    LEGS,
    Choice,
    Decision,
    choose_template,
    choose_turn_template,
    guess_of,
    template_shares,
    turn_template_shares,
)
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import NONE, SEVERAL, SIZE
from relguide.kernels.networks.turn_solutions import solve_turn_template
from relguide.kernels.networks.turn_templates import GUESS as TURN_GUESS
from relguide.kernels.networks.turn_templates import SIZE as TURN_TEMPLATES
from relguide.kernels.networks.turning_leader import bound_without_limit, turning_scene
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

VERDICTS = 7
"""Numbers found of each situation."""


@njit(cache=True, nogil=True)
def judge_templates(
    situations: FloatArray, right: FloatArray, layers: Layers, decision: Decision,
    verdicts: FloatArray,
) -> None:  # fmt: skip
    """What a network says of situations in which the limit binds, and where that leads.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R; not `needs_mirror`. shape (n, 6)
        right: templates of the exact answers. shape (n,)
        layers: the weights.
        decision: as in `choose_template`.
        verdicts: takes the likeliest template, its share, the arrival next to its guess (infinite
            if there is no path, or if it is `SEVERAL` or `NONE`) [R/V_P], and the share of the
            exact answer's template; and of `choose_template` how many templates are held possible,
            that of the path and its arrival (infinite if there is none) [R/V_P]. shape
            (n, VERDICTS)
    """
    free, guess, share = np.empty(5), np.zeros(2), np.empty(SIZE)
    legs = np.zeros((LEGS, 6))
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        pose, scene = Pose(x, y, h), straight_scene(alpha, slot, d_min)
        fastest(pose, alpha, 0.0, 0, make_scratch(), free)
        hidden = template_shares(pose, scene, free, layers, share)
        first, time = int(np.argmax(share)), inf
        if first != SEVERAL and first != NONE:
            guess_of(hidden, layers, first, guess)
            time, _ = solve_template(pose, scene, first, guess, inf, legs)
        own = share[int(right[n])]
        chosen = choose_template(pose, scene, free, layers, decision, legs)
        _write_verdict(first, share[first], time, own, chosen, verdicts[n])


@njit(cache=True, nogil=True)
def judge_turn_templates(
    situations: FloatArray, right: FloatArray, layers: Layers, decision: Decision,
    verdicts: FloatArray,
) -> None:  # fmt: skip
    """As `judge_templates`, behind leaders that turn; situations as in `turning_leader`."""
    guess, share = np.zeros(TURN_GUESS), np.empty(TURN_TEMPLATES)
    rows, legs = np.empty((MAX_ROWS, 5)), np.zeros((LEGS, 6))
    for n in range(len(situations)):
        numbers = situations[n]
        pose, scene = turning_scene(numbers)
        bound = bound_without_limit(pose, scene, rows)
        hidden = turn_template_shares(pose, scene, numbers, bound, layers, share)
        first, time = int(np.argmax(share)), inf
        if first != SEVERAL and first != NONE:
            guess_of(hidden, layers, first, guess)
            time, _ = solve_turn_template(pose, scene, first, guess, inf, True, legs)
        own = share[int(right[n])]
        chosen = choose_turn_template(pose, scene, numbers, bound, layers, decision, legs)
        _write_verdict(first, share[first], time, own, chosen, verdicts[n])


@njit(cache=True, nogil=True)
def _write_verdict(
    first: int, share: float, time: float, own: float, chosen: Choice, verdict: FloatArray
) -> None:
    """Put down what is found of one situation."""
    verdict[0], verdict[1], verdict[2], verdict[3] = first, share, time, own
    verdict[4], verdict[5], verdict[6] = chosen.held, chosen.template, chosen.time
