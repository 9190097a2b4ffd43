"""Chains that were refined but were not the best: begun again, one of them may be.

Units and frame as in `neighbourhoods`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_CONTACTS


@njit(cache=True, nogil=True)
def no_chains(room: int) -> FloatArray:
    """Room for some chains, none of which is known yet: shape (room, MAX_CONTACTS + 1, 4).

    The contacts of each come behind a row with its arrival and how many they are.
    """
    spare = np.zeros((room, MAX_CONTACTS + 1, 4))
    spare[:, 0, 0] = inf
    return spare


@njit(cache=True, nogil=True)
def keep_chain(spare: FloatArray, arrival: float, contacts: FloatArray) -> None:
    """Keep a chain, if it is sooner than one that is alike, or than the last one."""
    if len(spare) == 0:
        return
    last = 0
    for k in range(len(spare)):
        if are_alike(spare[k, 1 : int(spare[k, 0, 1]) + 1], contacts):
            last = k
            break
        if spare[k, 0, 0] > spare[last, 0, 0]:
            last = k
    if arrival < spare[last, 0, 0]:
        spare[last, 0, 0], spare[last, 0, 1] = arrival, len(contacts)
        spare[last, 1 : len(contacts) + 1] = contacts


@njit(cache=True, nogil=True)
def are_alike(chain: FloatArray, other: FloatArray) -> bool:
    """Whether two chains have as many contacts, on the same sides and linked the same way."""
    if len(chain) != len(other):
        return False
    for k in range(len(chain)):
        if chain[k, 1] != other[k, 1] or chain[k, 3] != other[k, 3]:
            return False
    return True
