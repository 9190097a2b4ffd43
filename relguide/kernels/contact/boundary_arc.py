"""A boundary arc along d = d_min as short arcs of partial bank, flown and certified like any other.

Each step of the boundary arc is two arcs, so that at every node distance and heading are those of
the boundary arc; nodes lie where the leader's turn rate changes, too. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import ceil, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import (
    boundary_arc_sense,
    contact_distance,
    contact_on,
    disc_on,
    slide_within,
)
from relguide.kernels.separation.clearance import fly_rate, leader_at, piece_at, piece_end

NODE = 0.03
"""Time between nodes of a boundary arc [R/V_P]: between them it strays from d_min by some 1e-8 R.
"""
_LONGEST = 1.5  # times the mean time between nodes, where the bearing moves slowly
MAX_NODES = 600
"""Longest boundary arc in nodes: three times the time to circle any disc that can be circled."""


@njit(cache=True, nogil=True)
def boundary_arc_arrival(
    scene: Scene, t: float, bearing: float, goal: float, side: float, piece: int
) -> float:
    """When a boundary arc begun at time t reaches a bearing; infinite if it cannot be flown.

    As the leader begins or ends a turn, the bearing may begin to move back: it then has the same
    value several times.

    Args:
        scene: the leader and d_min.
        t: when it begins [R/V_P].
        bearing: where [rad].
        goal: where it ends; not wrapped, so that it says which way round [rad].
        side: +1 counter-clockwise round the leader.
        piece: the leader's, on which the goal counts as reached, or on a later one; if it is not
            reached any more then, the first time counts.
    """
    stretches = np.empty((2 * len(scene.leader), 4))
    n = _stretches_of(scene, t, bearing, goal, side, piece, stretches)
    return float(t + stretches[:n, 3].sum()) if n >= 0 else inf


@njit(cache=True, nogil=True)
def _stretches_of(
    scene: Scene, t: float, bearing: float, goal: float, side: float, piece: int,
    stretches: FloatArray,
) -> int:  # fmt: skip
    """A boundary arc, cut where the leader's turn rate changes and where it passes its goal.

    Arguments as `boundary_arc_arrival`; `stretches` takes the leader's piece, the first and the
    last bearing and the time of each. Returns how many; −1 if it cannot be flown.
    """
    leader = scene.leader
    n, met = 0, -1
    for i in range(piece_at(leader, t), len(leader)):
        left = piece_end(leader, i) - t
        disc = disc_on(scene, i, side)
        ahead = boundary_arc_sense(bearing, disc) * (goal - bearing)
        if ahead > 0.0:
            begun = bearing
            bearing, took = slide_within(begun, goal, disc, left)
            if took == inf:
                break
            stretches[n, 0], stretches[n, 1], stretches[n, 2], stretches[n, 3] = (
                i, begun, bearing, took,
            )  # fmt: skip
            n += 1
            left -= took
        if bearing == goal:
            met = n if met < 0 else met
            if i >= piece:
                return n
        if left == inf:
            break
        if left > 0.0:
            begun = bearing
            beyond = begun + TWO_PI * boundary_arc_sense(begun, disc)
            bearing, took = slide_within(begun, beyond, disc, left)
            if took < left or took == inf:
                break  # round the leader once, or it cannot be flown
            stretches[n, 0], stretches[n, 1], stretches[n, 2], stretches[n, 3] = (
                i, begun, bearing, took,
            )  # fmt: skip
            n += 1
        t = leader[i + 1, 0]
    return met


@njit(cache=True, nogil=True)
def boundary_arc_pieces(
    pose: Pose, t: float, planned: float, scene: Scene, leg: FloatArray, pieces: FloatArray
) -> tuple[int, Pose, float]:
    """The boundary arc as arcs of partial bank.

    Args:
        pose: where it begins: at the first contact, on its heading.
        t: when [R/V_P].
        planned: when it was found to begin, the same but for rounding [R/V_P]: begun a little
            sooner or later, an arc that is flown to where it ends could not be flown.
        scene: the leader and d_min.
        leg: BOUNDARY_ARC, side, first and last bearing, the leader's piece as in
            `boundary_arc_arrival`. shape (6,)
        pieces: takes duration [R/V_P] and turn rate of each arc. shape (2·MAX_NODES, 2)

    Returns:
        how many arcs, and where and when they end.
    """
    side = leg[1]
    stretches = np.empty((2 * len(scene.leader), 4))
    n = 0
    for k in range(_stretches_of(scene, planned, leg[2], leg[3], side, int(leg[4]), stretches)):
        i, begun, bearing, took = (
            int(stretches[k, 0]),
            stretches[k, 1],
            stretches[k, 2],
            stretches[k, 3],
        )
        disc = disc_on(scene, i, side)
        # at most 5/3 times as many: some by bearing, some by time
        nodes = max(min(ceil(took / NODE), 3 * ((len(pieces) - n) // 2) // 5), 1)
        reached, node = begun, 0
        while reached != bearing and n + 2 <= len(pieces):
            # neither equal steps of bearing nor of time would do: some of them may be far longer
            node += 1
            goal = begun + (bearing - begun) * min(node / nodes, 1.0)
            if (goal - reached) * (bearing - begun) <= 0.0:
                if node >= nodes:
                    break  # there but for rounding
                continue
            step, duration = slide_within(reached, goal, disc, _LONGEST * took / nodes)
            if step != goal:
                goal = step
                node -= 1
            if duration <= 0.0 or duration == inf:
                break
            pose = _fly_two_arcs(
                pose, t, duration, scene, Contact(i, goal, side), pieces[n : n + 2]
            )
            n += 2
            t += duration
            reached = goal
    return n, pose, t


@njit(cache=True, nogil=True)
def _fly_two_arcs(
    pose: Pose, t: float, duration: float, scene: Scene, contact: Contact, pieces: FloatArray
) -> Pose:
    """Two arcs that end on the heading of a contact, at its distance from the leader; their end."""
    lx, ly, _ = leader_at(scene, contact.piece, t + duration)
    course = contact_on(scene, contact, t + duration).h
    distance = contact_distance(scene.d_min)
    half = 0.5 * duration
    # the mean rate brings the heading to the contact's, the spread the distance to δ
    mean = wrap_signed(course - pose.h) / duration
    spread, last_spread, last_off = 0.0, 0.0, 0.0
    end = pose
    for attempt in range(6):
        between = fly_rate(pose, mean + spread, half)
        end = fly_rate(between, mean - spread, half)
        off = norm(end.x - lx, end.y - ly) - distance
        if abs(off) < 1e-13:
            break
        if attempt == 0:
            last_spread, last_off = spread, off
            spread = -off / (0.25 * contact.side * duration * duration)
        else:
            if off == last_off:
                break
            following = spread - off * (spread - last_spread) / (off - last_off)
            last_spread, last_off, spread = spread, off, following
    pieces[0, 0], pieces[0, 1] = half, mean + spread
    pieces[1, 0], pieces[1, 1] = half, mean - spread
    return end
