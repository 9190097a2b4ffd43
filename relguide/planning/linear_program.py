"""highest_corner(rows, due, start): a linear programme of few unknowns, by the dual simplex method.

As many of the inequalities as there are unknowns, met exactly, make a corner. From one at which
none of them would let the last unknown grow, an inequality that is broken takes the place of one
of them until none is broken: the last unknown sinks, or stays, with each exchange.
"""

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.roots import FloatArray

ROUNDING = 1e-9
"""What counts as nothing, of numbers near 1."""
EXCHANGES = 20
"""Most for each inequality; one in two are the rule, and rounding alone could make them endless."""


def highest_corner(rows: FloatArray, due: FloatArray, start: NDArray[np.intp]) -> FloatArray | None:
    """The x with rows·x ≤ due whose last member is largest; `None` if no x meets them all.

    Args:
        rows: shape (n, m)
        due: shape (n,)
        start: numbers of m of the rows, at whose corner the last of x can grow no further without
            one of these being broken.
    """
    goal = np.zeros(rows.shape[1])
    goal[-1] = 1.0
    met = start.copy()
    for _ in range(EXCHANGES * len(due)):
        corner = rows[met]
        x = np.asarray(np.linalg.solve(corner, due[met]), np.float64)
        broken = np.flatnonzero(rows @ x > due + ROUNDING)
        if not broken.size:
            return x
        # both as sums of the rows that are met: the goal, which has no negative shares, and what
        # is to come in; of rows alike always the first, or the exchange could go round for ever
        price = np.linalg.solve(corner.T, goal)
        share = np.linalg.solve(corner.T, rows[broken[0]])
        may_leave = np.flatnonzero(share > ROUNDING)
        if not may_leave.size:
            return None
        ratio = price[may_leave] / share[may_leave]
        least = may_leave[ratio <= ratio.min() + ROUNDING]
        met[least[np.argmin(met[least])]] = broken[0]
    return None
