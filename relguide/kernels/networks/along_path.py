"""Where a pursuer is on its way round the limit, and what is left of the way.

What is left of an optimal way is optimal from there (Bellman): so one answer tells of many
situations.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, sin

from numba import njit

from relguide.kernels.base.angles import mirror_heading, wrap
from relguide.kernels.base.records import Disc, Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import contact_distance, contact_heading
from relguide.kernels.contact.touch_points import slide_between
from relguide.kernels.words.branches import needs_mirror
from relguide.kernels.words.extremals import SIGNS, fly_piece


@njit(cache=True, nogil=True)
def along(
    x: float, y: float, h: float, slot: float, alpha: float, delta: float, legs: FloatArray,
    time: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Where it is after some time, in the slot frame of then.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        slot: D [R].
        alpha: V_L/V_P.
        delta: distance of boundary arcs [R].
        legs: the way, as `chain.fly_links`. shape (n, 6)
        time: since the start [R/V_P]; on a boundary arc, at an even rate of bearings.

    Returns:
        x, y and heading; at the end of the way if that is sooner.
    """
    done = 0.0
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            begin, end = legs[k, 2], legs[k, 3]
            _, took = slide_between(begin, end, Disc(alpha, delta, legs[k, 1], 0.0))
            part = min(1.0, (time - done) / took) if took > 0.0 else 1.0
            bearing = begin + part * (end - begin)
            done += part * took
            x, y = slot + alpha * done + delta * cos(bearing), delta * sin(bearing)
            h = contact_heading(bearing, legs[k, 1], alpha)
            if part < 1.0:
                return x - alpha * done, y, h
            continue
        row = legs[k, 1:6]
        for piece in range(3):
            amount = min(row[2 + piece], time - done)
            x, y, h = fly_piece(Pose(x, y, h), SIGNS[int(row[1]), piece], amount)
            done += amount
            if done >= time:
                return x - alpha * done, y, h
    return x - alpha * done, y, h


@njit(cache=True, nogil=True)
def along_rows(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray,
    off: FloatArray, out: FloatArray,
) -> None:  # fmt: skip
    """Situations on ways, or a little off them, on the left of the route.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        times: how long each way has been flown [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.fly_links`. shape (n, ·, 6)
        off: what is added to x, y [R] and h [rad]. shape (n, 3)
        out: takes the situations. shape (n, 6)
    """
    for n in range(len(situations)):
        x, y, h, alpha, slot, limit = situations[n]
        delta = contact_distance(limit)
        x, y, h = along(x, y, h, slot, alpha, delta, legs[n, : int(counts[n])], times[n])
        x, y, h = x + off[n, 0], y + off[n, 1], wrap(h + off[n, 2])
        if needs_mirror(y, h):
            y, h = -y, mirror_heading(h)
        out[n, 0], out[n, 1], out[n, 2] = x, y, h
        out[n, 3], out[n, 4], out[n, 5] = alpha, slot, limit


@njit(cache=True, nogil=True)
def later_rows(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray,
    shares: FloatArray, out: FloatArray, left: FloatArray, rest: FloatArray,
) -> None:  # fmt: skip
    """Situations on the first turns of ways, and what is left of these ways, which is optimal.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        times: of the ways [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.fly_links`. shape (n, ·, 6)
        shares: how much of the first turn has been flown. shape (n,)
        out: takes the situations, on the left of the route. shape (n, 6)
        left: takes the times of what is left. shape (n,)
        rest: takes its legs. shape as legs
    """
    for n in range(len(situations)):
        x, y, h, alpha, slot, limit = situations[n]
        count, turned = int(counts[n]), shares[n] * legs[n, 0, 3]
        delta = contact_distance(limit)
        x, y, h = along(x, y, h, slot, alpha, delta, legs[n, :count], turned)
        h = wrap(h)
        rest[n] = legs[n]
        rest[n, 0, 1] -= turned
        rest[n, 0, 3] -= turned
        left[n] = times[n] - turned
        if needs_mirror(y, h):
            y, h = -y, mirror_heading(h)
            mirror_legs(rest[n, :count])
        out[n, 0], out[n, 1], out[n, 2] = x, y, h
        out[n, 3], out[n, 4], out[n, 5] = alpha, slot, limit


@njit(cache=True, nogil=True)
def mirror_legs(legs: FloatArray) -> None:
    """Exchange left and right."""
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            legs[k, 1:4] *= -1.0
        else:
            # words stand beside their mirror images
            legs[k, 2] = int(legs[k, 2]) ^ 1
