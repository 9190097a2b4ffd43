"""A boundary arc along d = d_min as short arcs of partial bank, to be flown and certified like any
other.

Each step of the boundary arc is two arcs, so that at every node distance and heading are those of
the boundary arc; nodes lie where the leader's turn rate changes, too. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise; the leader is a table as in `clearance`.
"""

from math import ceil, hypot, inf

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_on, slide_within
from relguide.kernels.separation.clearance import fly_rate, leader_at, piece_at

NODE = 0.03
"""Time between nodes of a boundary arc [R/V_P]: between them it strays from d_min by some 1e-8 R.
"""
MAX_NODES = 600
"""Longest boundary arc in nodes: three times the time to circle any disc that can be ridden."""


@njit(cache=True, nogil=True)
def boundary_arc_arrival(
    leader: FloatArray, t: float, bearing: float, goal: float, side: float, alpha: float,
    delta: float,
) -> float:  # fmt: skip
    """When a boundary arc that begins at time t reaches a bearing; infinite if it cannot be flown."""
    i = piece_at(leader, t)
    while bearing != goal:
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        bearing, took = slide_within(bearing, goal, side, alpha, delta, leader[i, 4], left)
        if took == inf:
            return inf
        t += took
        i += 1
    return t


@njit(cache=True, nogil=True)
def boundary_arc_pieces(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    side: float, first: float, last: float, pieces: FloatArray,
) -> tuple[int, float, float, float, float]:  # fmt: skip
    """The boundary arc as arcs of partial bank.

    Args:
        x: where it begins: at the first contact, on its heading [R].
        y: the same [R].
        h: the same [rad].
        t: when [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance of the boundary arc [R].
        side: +1 counter-clockwise round the leader.
        first: bearing where it begins [rad].
        last: bearing where it ends [rad].
        pieces: takes duration [R/V_P] and turn rate of each arc. shape (2·MAX_NODES, 2)

    Returns:
        how many arcs, and x, y, h, t at the end.
    """
    n = 0
    bearing = first
    i = piece_at(leader, t)
    while bearing != last and n < len(pieces):
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        begun = bearing
        bearing, took = slide_within(begun, last, side, alpha, delta, leader[i, 4], left)
        if took == inf:
            break
        nodes = min(ceil(took / NODE), (len(pieces) - n) // 2)
        reached = begun
        for node in range(1, nodes + 1):
            goal = begun + (bearing - begun) * node / nodes
            _, duration = slide_within(reached, goal, side, alpha, delta, leader[i, 4], inf)
            if duration <= 0.0 or duration == inf:
                continue
            lx, ly, _ = leader_at(Scene(leader, alpha, 0.0, 0.0), i, t + duration)
            _, _, course = contact_on(leader, i, t + duration, goal, side, alpha, delta)
            x, y, h = _two_arcs(x, y, h, duration, lx, ly, course, delta, side, pieces[n : n + 2])
            n += 2
            t += duration
            reached = goal
        i += 1
    return n, x, y, h, t


@njit(cache=True, nogil=True)
def _two_arcs(
    x: float, y: float, h: float, duration: float, lx: float, ly: float, course: float,
    delta: float, side: float, pieces: FloatArray,
) -> tuple[float, float, float]:  # fmt: skip
    """Two arcs that end at distance δ from (lx, ly) on a course; their end."""
    half = 0.5 * duration
    # the mean rate brings the heading to the contact's, the spread the distance to δ
    mean = wrap_signed(course - h) / duration
    spread, last_spread, last_off = 0.0, 0.0, 0.0
    bx, by, bh = x, y, h
    for attempt in range(6):
        ax, ay, ah = fly_rate(Pose(x, y, h), mean + spread, half)
        bx, by, bh = fly_rate(Pose(ax, ay, ah), mean - spread, half)
        off = hypot(bx - lx, by - ly) - delta
        if abs(off) < 1e-13:
            break
        if attempt == 0:
            last_spread, last_off = spread, off
            spread = -off / (0.25 * side * duration * duration)
        else:
            if off == last_off:
                break
            following = spread - off * (spread - last_spread) / (off - last_off)
            last_spread, last_off, spread = spread, off, following
    pieces[0, 0], pieces[0, 1] = half, mean + spread
    pieces[1, 0], pieces[1, 1] = half, mean - spread
    return bx, by, bh
