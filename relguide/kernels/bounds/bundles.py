"""Bundles of paths, by cells of their first contact and their last one, the least bound first."""

from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.contact_tree import IntArray, Tree
from relguide.kernels.bounds.kept_fronts import Fronts

MAX_BUNDLES = 400_000
"""Most bundles of paths kept, and cells; the search ends there."""
TOGETHER = 131_071
"""So many pairs of cells are remembered."""
DEPTH = 128
"""More than halvings of a cell."""
MOST_LASTS = 256
"""So many cells of last contacts are kept of a cell of first ones, or as many as hold all."""
_LASTS = 1_000_000  # so many in all


class Lasts(NamedTuple):
    """Which contacts may be last ones after first ones, see `last_contacts`."""

    cells: IntArray
    """Numbers of cells of last contacts, those of one cell of first contacts after another's …
    shape (_LASTS,)"""
    size: IntArray
    """… how many they are in all, and never more of one than this. shape (2,)"""


class Search(NamedTuple):
    """The bundles of paths that may arrive before what is to be beaten."""

    first: Tree
    """Of first contacts."""
    last: Tree
    """Of last contacts."""
    roots: IntArray
    """Numbers of cells that hold all last contacts. shape (·,)"""
    bounds: FloatArray
    """A heap: no path of a bundle arrives before this [R/V_P]. shape (MAX_BUNDLES,)"""
    bundles: IntArray
    """Numbers of both cells, 1 where the time round was looked at closely, and the level at which
    it was last asked whether paths hop too late. shape (·, 4)"""
    size: IntArray
    """How many bundles there are, and have been looked at; and whether last contacts have been
    looked at alone. shape (3,)"""
    vain: IntArray
    """Of `hopping.hops_late`. shape (REASONS,)"""
    fronts: Fronts
    """From cells of first contacts."""
    pairs: IntArray
    """Which cells were looked at together, as one number … shape (TOGETHER,)"""
    together: FloatArray
    """… and the bound of their paths [R/V_P]. shape (TOGETHER,)"""
    lasts: Lasts
    """Which contacts may be last ones after first ones."""
    probes: IntArray
    """How many bundles have been probed, by their size. shape (·,)"""


@njit(cache=True, nogil=True)
def begin_lasts(roots: int) -> Lasts:
    """Nothing is known, but that so many cells hold all last contacts."""
    size = np.zeros(2, np.int64)
    size[1] = max(roots, MOST_LASTS + 1)
    return Lasts(np.empty(_LASTS, np.int64), size)


@njit(cache=True, nogil=True, forceinline=True)
def has_room(search: Search) -> bool:
    """Whether so many bundles may be added as one look adds."""
    return bool(search.size[0] + 2 * search.lasts.size[1] + DEPTH < MAX_BUNDLES)


@njit(cache=True, nogil=True, forceinline=True)
def push(search: Search, bound: float, n: int, m: int, eased: int, asked: int) -> None:
    """Put a bundle into the heap."""
    at = int(search.size[0])
    search.size[0] += 1
    while at > 0:
        above = (at - 1) // 2
        if search.bounds[above] <= bound:
            break
        search.bounds[at] = search.bounds[above]
        search.bundles[at] = search.bundles[above]
        at = above
    search.bounds[at] = bound
    bundle = search.bundles[at]
    bundle[0], bundle[1], bundle[2], bundle[3] = n, m, eased, asked


@njit(cache=True, nogil=True, forceinline=True)
def drop_least(search: Search) -> None:
    """Take the least bundle from the heap."""
    bounds, bundles = search.bounds, search.bundles
    search.size[0] -= 1
    count, at = int(search.size[0]), 0
    bound = bounds[count]
    while 2 * at + 1 < count:
        below = 2 * at + 1
        if below + 1 < count and bounds[below + 1] < bounds[below]:
            below += 1
        if bounds[below] >= bound:
            break
        bounds[at] = bounds[below]
        bundles[at] = bundles[below]
        at = below
    bounds[at] = bound
    bundles[at] = bundles[count]
