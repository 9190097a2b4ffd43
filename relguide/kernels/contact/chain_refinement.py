"""Chains of contacts refined: their bearings are moved until the arrival falls no more.

The arrival is smooth but for edges, where a word between two contacts ceases to exist or a piece
begins to break the limit. Bearings are moved one after another, by parabolas where that is all
right and by smaller steps at edges; then together, the way that the sweep went; then along edges.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`, a chain as in `chain`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD, fly_links

FINEST = 1e-7
"""Bearing steps end here: 1 mm at R = 12 km, 10 µs where the time has an edge."""
GAIN = 1e-8
"""Or where a parabola promises less than this [R/V_P]: 1 µs."""
_SWEEPS = 16  # over all bearings of a chain
_FURTHEST = 64.0  # times the way of a sweep
_NEAR = 0.3  # values farther above the least say nothing about a minimum [R/V_P]
_BESIDE = 5e-3  # an edge is looked for this near to a contact [rad] …
_CLIFF = 2e-3  # … where to both sides together the arrival rises by more than this [R/V_P]
_NARROW = 1e-3  # it is followed in steps down to this [rad]
_ACROSS = 3  # places looked at either way across a valley


@njit(cache=True, nogil=True)
def refine_chain(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    chain: FloatArray, here: float, stride: float, beat: float, rows: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a chain, whose bearings are moved.

    From the chain's arrival `here` on, looking as far as `stride` [rad] at first; given up where
    the last sweep gained less than what is missing to `beat`. Other arguments as `fly_links`.
    """
    strides = np.full(len(chain), stride)
    finest = 0.1 * stride
    further = np.empty_like(chain)
    for _ in range(_SWEEPS):
        before, begun = here, chain.copy()
        for k in range(len(chain)):
            ax, ay, ah, t = fly_links(
                x, y, h, 0.0, leader, alpha, delta, t_release, chain, 0, k - 1, inf, rows, legs
            )
            last = _last_moved(leader, t, t_release, chain, k, 1)
            here = _refine_one(
                ax, ay, ah, t, leader, alpha, delta, t_release, chain, k, last, here, strides, finest,
                rows, legs,
            )  # fmt: skip
        gain = before - here
        # a valley that no bearing goes down alone: on the way that this sweep went together
        reach = 1.0
        while gain > GAIN and len(chain) > 1 and reach <= _FURTHEST:
            further[:] = chain
            further[:, 2] += reach * (chain[:, 2] - begun[:, 2])
            _, _, _, there = fly_links(
                x,
                y,
                h,
                0.0,
                leader,
                alpha,
                delta,
                t_release,
                further,
                0,
                len(chain),
                here,
                rows,
                legs,
            )
            if there >= here:
                break
            here = there
            begun[:] = chain
            chain[:] = further
            reach *= 2.0
        gain = before - here
        if here - 2.0 * gain > beat or (gain < GAIN and finest == FINEST):
            break
        finest = max(0.1 * finest, FINEST)
    return here


@njit(cache=True, nogil=True)
def follow_edges(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    chain: FloatArray, here: float, stride: float, rows: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """Move two bearings along an edge: where the word between two contacts ceases to exist.

    A chain often leaves the disc straight and comes back to it with nothing left to turn: just
    there its word ends, and neither bearing gets on alone. So one is moved, and for each of its
    places the other one's best is found. Other arguments as `refine_chain`.
    """
    tried, strides = np.empty_like(chain), np.empty(len(chain))
    for k in range(len(chain) - 1):
        if chain[k + 1, 3] != WORD:
            continue
        ax, ay, ah, t = fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_release, chain, 0, k - 1, inf, rows, legs
        )
        link = t, leader, alpha, delta, t_release
        last = _last_moved(leader, t, t_release, chain, k, 2)
        _, _, _, begun = fly_links(ax, ay, ah, *link, chain, k, last, inf, rows, legs)
        rise = -2.0 * begun
        for way in (-1.0, 1.0):
            tried[:] = chain
            tried[k + 1, 2] += way * _BESIDE
            _, _, _, there = fly_links(ax, ay, ah, *link, tried, k, last, inf, rows, legs)
            rise += there
        if not rise > _CLIFF:
            continue
        least, step = begun, stride
        while step > _NARROW:
            moved = False
            for way in (-1.0, 1.0):
                tried[:] = chain
                tried[k, 2] += way * step
                found, to = inf, 0.0
                for j in range(-_ACROSS, _ACROSS + 1):
                    tried[k + 1, 2] = chain[k + 1, 2] + 0.5 * step * j
                    _, _, _, there = fly_links(
                        ax, ay, ah, *link, tried, k, last, min(found, least + _NEAR), rows, legs
                    )
                    if there < found:
                        found, to = there, tried[k + 1, 2]
                if found == inf:
                    continue
                tried[k + 1, 2] = to
                strides[k + 1] = 0.25 * step
                bx, by, bh, then = fly_links(ax, ay, ah, *link, tried, k, k, inf, rows, legs)
                found = _refine_one(
                    bx, by, bh, then, leader, alpha, delta, t_release, tried, k + 1, last, found,
                    strides, 1e-3 * step, rows, legs,
                )  # fmt: skip
                if found < least - GAIN:
                    least, moved = found, True
                    chain[:] = tried
                    break
            if not moved:
                step *= 0.4
        here -= begun - least
    return here


@njit(cache=True, nogil=True)
def _last_moved(
    leader: FloatArray, t: float, t_release: float, chain: FloatArray, k: int, moved: int
) -> int:
    """The last link that must be flown to compare chains alike but for contacts k … k + moved − 1.

    On the final leg nothing depends on time: past the next contact all stays as it is.
    """
    if t >= t_release and chain[k, 0] == len(leader) - 1:
        return min(k + moved, len(chain))
    return len(chain)


@njit(cache=True, nogil=True)
def simplify_chain(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    chain: FloatArray, here: float, stride: float, rows: FloatArray, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """Leave out contacts that a chain does as well without, or better.

    As `refine_chain`; `chain` takes the shorter one. Returns its arrival and how many contacts.
    """
    contacts = len(chain)
    k = 0
    while k < contacts and contacts > 1:
        fewer = np.empty((contacts - 1, 4))
        fewer[:k] = chain[:k]
        fewer[k:] = chain[k + 1 : contacts]
        if k < contacts - 1 and chain[k, 3] == WORD:
            fewer[k, 3] = WORD  # the boundary arc that began at k is left out with it
        _, _, _, there = fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_release, fewer, 0, contacts - 1, here + _NEAR, rows,
            legs,
        )  # fmt: skip
        if there < inf:
            there = refine_chain(
                x, y, h, leader, alpha, delta, t_release, fewer, there, stride, here, rows, legs
            )
        if there <= here + GAIN:
            contacts -= 1
            here = there
            chain[:contacts] = fewer
            k = 0
        else:
            k += 1
    return here, contacts


@njit(cache=True, nogil=True)
def _refine_one(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    t_release: float, chain: FloatArray, k: int, last: int, arrival: float, strides: FloatArray,
    finest: float, rows: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """One bearing of a chain: parabolas where the arrival is smooth, smaller steps at edges.

    Only the links up to `last` depend on it; the arrival falls by as much as their end.
    """
    stride, moved_by = strides[k], 0.0
    link = t, leader, alpha, delta, t_release, chain, k, last
    _, _, _, begun = fly_links(x, y, h, *link, inf, rows, legs)
    here = begun
    while stride >= finest and here < inf:
        bearing = chain[k, 2]
        beat = here + _NEAR
        chain[k, 2] = bearing - stride
        _, _, _, below = fly_links(x, y, h, *link, beat, rows, legs)
        chain[k, 2] = bearing + stride
        _, _, _, above = fly_links(x, y, h, *link, beat, rows, legs)
        shift, promised = vertex(below, here, above, stride)
        to, least, smooth = bearing, here, False
        if promised > 0.0:
            chain[k, 2] = bearing + shift
            _, _, _, found = fly_links(x, y, h, *link, beat, rows, legs)
            smooth = abs(here - found - promised) <= 0.1 * promised + GAIN
            if found < least:
                to, least = bearing + shift, found
        if below < least:
            to, least = bearing - stride, below
        if above < least:
            to, least = bearing + stride, above
        chain[k, 2] = to
        moved_by = max(moved_by, abs(to - bearing))
        here = least
        if smooth and promised < GAIN:
            break
        if smooth:
            stride *= 0.1
        elif abs(to - bearing) < stride:
            stride *= 0.4
    strides[k] = max(2.0 * moved_by, finest)
    return arrival - (begun - here) if here < inf else arrival


@njit(cache=True, nogil=True)
def vertex(below: float, here: float, above: float, stride: float) -> tuple[float, float]:
    """The least point of the parabola through three values: how far it is, and what it promises.

    Both 0 where there is none within two strides.
    """
    bend = below - 2.0 * here + above
    if not 0.0 < bend < inf:
        return 0.0, 0.0
    shift = 0.5 * stride * (below - above) / bend
    if abs(shift) > 2.0 * stride:
        return 0.0, 0.0
    return shift, shift * shift * bend / (2.0 * stride * stride)
