"""Across which side a cell of contacts is cut in two: its bearings or its times.

A cell is worth cutting where that raises the bound most, and what does so differs: where a word
leads to a contact its time is known once its bearing is, while a contact that is come to with time
to spare may be at any time. So a radian is weighed against the time as long as it, and the weights
follow from what cuts of either kind have gained of late in the same search: both shall gain alike.
Lengths in R, times in R/V_P.
"""

from math import exp, inf

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray

_WEIGHT, _OF_BEARINGS, _OF_TIMES = 0, 1, 2
_FIRST = ((0.5, 0.25, 1.0), (1.0, 0.125, 8.0))
"""The weight to begin with, the least one and the largest: where a word leads to the contact, and
where there is time to spare."""
_RECENT = 0.02  # the share of the latest cut in what is held to be gained
_PACE = 0.02  # how fast weights follow


@njit(cache=True, nogil=True)
def begin_cuts() -> FloatArray:
    """How cells are cut before anything has been learned.

    Returns:
        the weight, and what cuts across bearings and across times have gained of late; of contacts
        to which a word leads, and of those with time to spare. shape (2, 3)
    """
    cuts = np.zeros((2, 3))
    for k in range(2):
        cuts[k, _WEIGHT] = _FIRST[k][0]
    return cuts


@njit(cache=True, nogil=True, forceinline=True)
def length_of(span: float, d_min: float) -> float:
    """How many radians weigh as much as half a window of time, before what has been learned.

    In a time t a contact moves by some t (the leader's way), and one on its circle by d_min for
    each radian of bearing; a radian turns the heading at it, too.
    """
    return span / (d_min + 1.0) if span < inf else 0.0


@njit(cache=True, nogil=True, forceinline=True)
def cuts_times(cuts: FloatArray, spare: bool, half: float, span: float, d_min: float) -> bool:
    """Whether a cell is cut across its times.

    Args:
        cuts: of `begin_cuts`.
        spare: whether contacts are come to with time to spare.
        half: half of what its bearings differ by [rad].
        span: half of what its times differ by [R/V_P]; infinite windows are not cut.
        d_min: the least separation [R].
    """
    return bool(length_of(span, d_min) > cuts[1 if spare else 0, _WEIGHT] * half)


@njit(cache=True, nogil=True)
def learn_cut(cuts: FloatArray, spare: bool, times: bool, gain: float) -> None:
    """Put down what a cut has gained.

    Args:
        cuts: of `begin_cuts`; takes it.
        spare: whether the cell's contacts are come to with time to spare.
        times: whether it was cut across its times.
        gain: the share of what its bound lacked that its halves' bounds lack no longer, 0 to 1.
    """
    k = 1 if spare else 0
    which = _OF_TIMES if times else _OF_BEARINGS
    cuts[k, which] += _RECENT * (gain - cuts[k, which])
    weight = cuts[k, _WEIGHT] * exp(_PACE * (cuts[k, _OF_BEARINGS] - cuts[k, _OF_TIMES]))
    cuts[k, _WEIGHT] = min(max(weight, _FIRST[k][1]), _FIRST[k][2])
