"""A network of ways round the limit, held against exact answers in bulk.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_scores import (
    LEGS,
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
    situations: FloatArray, kinds: FloatArray, layers: Layers, least_share: float, most: int,
    doubt: float, verdicts: FloatArray,
) -> None:  # fmt: skip
    """What a network says of situations in which the limit binds, and where that leads.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R, none of which `needs_mirror`. shape (n, 6)
        kinds: numbers of those of the exact answers. shape (n,)
        layers: the weights.
        least_share: as in `choose_template`.
        most: as there.
        doubt: as there.
        verdicts: takes the likeliest of all kinds, its share, the arrival that it has next to its
            guess (infinite if none, or if it is `SEVERAL` or `NONE`) [R/V_P], the share of the
            exact answer's kind; and of `choose_template` how many kinds are held possible, the kind
            of the way and its arrival (infinite if there is none) [R/V_P]. shape (n, VERDICTS)
    """
    free, guess, share = np.empty(5), np.zeros(2), np.empty(SIZE)
    legs = np.zeros((LEGS, 6))
    for n in range(len(situations)):
        x, y, h, alpha, slot, limit = situations[n]
        fastest(Pose(x, y, h), alpha, 0.0, 0, make_scratch(), free)
        hidden = template_shares(x, y, h, slot, alpha, limit, free, layers, share)
        first, time = int(np.argmax(share)), inf
        if first != SEVERAL and first != NONE:
            guess_of(hidden, layers, first, guess)
            time, _ = solve_template(x, y, h, slot, alpha, limit, first, guess, inf, legs)
        verdicts[n, 0] = first
        verdicts[n, 1] = share[first]
        verdicts[n, 2] = time
        verdicts[n, 3] = share[int(kinds[n])]
        held, kind, best, _ = choose_template(
            x, y, h, slot, alpha, limit, free, layers, least_share, most, doubt, legs
        )
        verdicts[n, 4] = held
        verdicts[n, 5] = kind
        verdicts[n, 6] = best
