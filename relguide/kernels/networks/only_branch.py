"""Which one word a network of branches holds possible, in many situations."""

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.branch_scores import Layers, evaluate, shares
from relguide.kernels.words.branches import SIZE, WORD_OF

ByteArray = np.ndarray[tuple[int, ...], np.dtype[np.int8]]


@njit(cache=True, nogil=True)
def only_words(
    situations: FloatArray, layers: Layers, least_share: float, first: int, last: int,
    words: ByteArray,
) -> None:  # fmt: skip
    """Ask it in situations first … last − 1.

    Args:
        situations: x, y, h in [0, 2π), α. shape (n, 4)
        layers: the weights.
        least_share: branches with a smaller share than this are not possible.
        first: from this row on.
        last: up to this row.
        words: takes the number of the only word, −1 if several are possible. shape (n,)
    """
    scores, share = np.empty((3, SIZE)), np.empty(SIZE)
    for n in range(first, last):
        x, y, h, alpha = situations[n]
        evaluate(x, y, h, alpha, layers, scores)
        shares(scores, share)
        words[n] = WORD_OF[share.argmax()]
        for s in range(SIZE):
            if share[s] >= least_share and WORD_OF[s] != words[n]:
                words[n] = -1
                break
