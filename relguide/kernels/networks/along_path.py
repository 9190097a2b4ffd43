"""Where a pursuer is on its constrained path, and the rest of the path from there.

The rest of an optimal path is optimal from where it begins (Bellman): so one answer gives those of
many situations.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, sin

from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Disc, Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import contact_distance, contact_heading
from relguide.kernels.contact.touch_points import slide_between
from relguide.kernels.networks.network_view import mirror_to_left
from relguide.kernels.words.extremals import SIGNS, fly_piece


@njit(cache=True, nogil=True)
def pose_along(start: Pose, slot: float, disc: Disc, legs: FloatArray, time: float) -> Pose:
    """Where a pursuer is after some time, in the slot frame of that time.

    Args:
        start: where the path begins, at t = 0.
        slot: D [R].
        disc: its α, and the distance of boundary arcs; each leg has its side.
        legs: the path, as `chain.Chain`. shape (n, 6)
        time: since the start [R/V_P]; on a boundary arc, at an even rate of bearings.

    Returns:
        its pose; at the end of the path if that is sooner.
    """
    alpha, pose, done = disc.alpha, start, 0.0
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            begin, end = legs[k, 2], legs[k, 3]
            _, took = slide_between(begin, end, Disc(alpha, disc.distance, legs[k, 1], 0.0))
            part = min(1.0, (time - done) / took) if took > 0.0 else 1.0
            bearing = begin + part * (end - begin)
            done += part * took
            pose = Pose(
                slot + alpha * done + disc.distance * cos(bearing),
                disc.distance * sin(bearing),
                contact_heading(bearing, legs[k, 1], alpha),
            )
            if part < 1.0:
                break
            continue
        row = legs[k, 1:6]
        for piece in range(3):
            amount = min(row[2 + piece], time - done)
            pose = fly_piece(pose, SIGNS[int(row[1]), piece], amount)
            done += amount
            if done >= time:
                return Pose(pose.x - alpha * done, pose.y, pose.h)
    return Pose(pose.x - alpha * done, pose.y, pose.h)


@njit(cache=True, nogil=True)
def along_rows(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray,
    off: FloatArray, out: FloatArray,
) -> None:  # fmt: skip
    """Situations on constrained paths, or a little off them, on the left of the route.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        times: how long each path has been flown [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.Chain`. shape (n, ·, 6)
        off: what is added to x, y [R] and h [rad]. shape (n, 3)
        out: takes the situations. shape (n, 6)
    """
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        disc = Disc(alpha, contact_distance(d_min), 0.0, 0.0)
        x, y, h = pose_along(Pose(x, y, h), slot, disc, legs[n, : int(counts[n])], times[n])
        pose, _ = mirror_to_left(Pose(x + off[n, 0], y + off[n, 1], wrap(h + off[n, 2])))
        out[n, 0], out[n, 1], out[n, 2] = pose
        out[n, 3], out[n, 4], out[n, 5] = alpha, slot, d_min


@njit(cache=True, nogil=True)
def advance_rows(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray,
    shares: FloatArray,
) -> None:  # fmt: skip
    """Put situations forward on their paths by a share of the first turn; what remains is optimal.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R; replaced by those on the path, on the left
            of the route. shape (n, 6)
        times: of the paths [R/V_P]; replaced by those of the rest. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.Chain`; replaced by those of the rest. shape (n, ·, 6)
        shares: how much of the first turn has been flown. shape (n,)
    """
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        path, turned = legs[n, : int(counts[n])], shares[n] * legs[n, 0, 3]
        disc = Disc(alpha, contact_distance(d_min), 0.0, 0.0)
        x, y, h = pose_along(Pose(x, y, h), slot, disc, path, turned)
        path[0, 1] -= turned
        path[0, 3] -= turned
        times[n] -= turned
        pose, mirrored = mirror_to_left(Pose(x, y, wrap(h)))
        if mirrored:
            mirror_legs(path)
        situations[n, 0], situations[n, 1], situations[n, 2] = pose


@njit(cache=True, nogil=True)
def mirror_legs(legs: FloatArray) -> None:
    """Exchange left and right."""
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            legs[k, 1:4] *= -1.0
        else:
            # words stand beside their mirror images
            legs[k, 2] = int(legs[k, 2]) ^ 1
