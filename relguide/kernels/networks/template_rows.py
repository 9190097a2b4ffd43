"""The template network, held against exact answers in bulk.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_scores import (
    LEGS,
    Decision,
    choose_template,
    guess_of,
    template_shares,
)
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import NONE, SEVERAL, SIZE
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
        verdicts[n, 0] = first
        verdicts[n, 1] = share[first]
        verdicts[n, 2] = time
        verdicts[n, 3] = share[int(right[n])]
        chosen = choose_template(pose, scene, free, layers, decision, legs)
        verdicts[n, 4] = chosen.held
        verdicts[n, 5] = chosen.template
        verdicts[n, 6] = chosen.time
