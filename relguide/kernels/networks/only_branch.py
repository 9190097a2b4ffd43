"""Which one word a branch network holds possible, in many situations."""

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.branch_scores import Layers, evaluate, shares
from relguide.kernels.words.branches import SIZE, WORD_OF

ByteArray = np.ndarray[tuple[int, ...], np.dtype[np.int8]]


@njit(cache=True, nogil=True)
def only_words(
    situations: FloatArray, layers: Layers, least_share: float, words: ByteArray
) -> None:
    """Ask a branch network in many situations.

    Args:
        situations: x, y, h in [0, 2π), α. shape (n, 4)
        layers: the weights.
        least_share: branches with a smaller share than this are not possible.
        words: takes the number of the only word, −1 if several are possible. shape (n,)
    """
    scores, share = np.empty((3, SIZE)), np.empty(SIZE)
    for n in range(len(situations)):
        x, y, h, alpha = situations[n]
        evaluate(Pose(x, y, h), alpha, layers, scores)
        shares(scores, share)
        words[n] = WORD_OF[share.argmax()]
        for s in range(SIZE):
            if share[s] >= least_share and WORD_OF[s] != words[n]:
                words[n] = -1
                break
