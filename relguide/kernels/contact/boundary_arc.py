"""A boundary arc along d = d_min as short arcs of partial bank, flown and certified like any other.

Each step of the boundary arc is two arcs, so that at every node distance and heading are those of
the boundary arc; nodes lie where the leader's turn rate changes, too. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import ceil, hypot, inf

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_distance, contact_on, disc_on, slide_within
from relguide.kernels.separation.clearance import fly_rate, leader_at, piece_at

NODE = 0.03
"""Time between nodes of a boundary arc [R/V_P]: between them it strays from d_min by some 1e-8 R.
"""
MAX_NODES = 600
"""Longest boundary arc in nodes: three times the time to circle any disc that can be circled."""


@njit(cache=True, nogil=True)
def boundary_arc_arrival(scene: Scene, t: float, bearing: float, goal: float, side: float) -> float:
    """When a boundary arc begun at time t reaches a bearing; infinite if it cannot be flown."""
    leader = scene.leader
    i = piece_at(leader, t)
    while bearing != goal:
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        bearing, took = slide_within(bearing, goal, disc_on(scene, i, side), left)
        if took == inf:
            return inf
        t += took
        i += 1
    return t


@njit(cache=True, nogil=True)
def boundary_arc_pieces(
    pose: Pose, t: float, scene: Scene, side: float, first: float, last: float, pieces: FloatArray
) -> tuple[int, Pose, float]:
    """The boundary arc as arcs of partial bank.

    Args:
        pose: where it begins: at the first contact, on its heading.
        t: when [R/V_P].
        scene: the leader and d_min.
        side: +1 counter-clockwise round the leader.
        first: bearing where it begins [rad].
        last: bearing where it ends [rad].
        pieces: takes duration [R/V_P] and turn rate of each arc. shape (2·MAX_NODES, 2)

    Returns:
        how many arcs, and where and when they end.
    """
    leader = scene.leader
    n = 0
    bearing = first
    i = piece_at(leader, t)
    while bearing != last and n < len(pieces):
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        disc = disc_on(scene, i, side)
        begun = bearing
        bearing, took = slide_within(begun, last, disc, left)
        if took == inf:
            break
        nodes = min(ceil(took / NODE), (len(pieces) - n) // 2)
        reached = begun
        for node in range(1, nodes + 1):
            goal = begun + (bearing - begun) * node / nodes
            _, duration = slide_within(reached, goal, disc, inf)
            if duration <= 0.0 or duration == inf:
                continue
            pose = _fly_two_arcs(
                pose, t, duration, scene, Contact(i, goal, side), pieces[n : n + 2]
            )
            n += 2
            t += duration
            reached = goal
        i += 1
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
        off = hypot(end.x - lx, end.y - ly) - distance
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
