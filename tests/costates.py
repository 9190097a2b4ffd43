"""Which words have a costate: the others are as fast as none that is optimal."""

import numpy as np

from relguide.kernels.words.extremals import WORDS


def with_costate(rows: np.ndarray) -> np.ndarray:
    """Those of `extremals.solve` that are no three turns of which an outer one is the longest.

    λ_ψ vanishes at both switches, hence on the line through them, which both outer turns meet again
    after as long as the middle one takes. With two turns only, the line may go anywhere.
    """
    return rows[[_has_costate(row) for row in rows]] if len(rows) else rows


def _has_costate(row: np.ndarray) -> bool:
    first, middle, last = row[2:]
    if WORDS[int(row[1])][1] == "S" or min(first, last) < 1e-6:
        return True
    return bool(max(first, last) <= middle + 1e-6)
