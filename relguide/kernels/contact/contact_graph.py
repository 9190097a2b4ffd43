"""A graph of contacts with d = d_min: earliest arrivals by words between them and slides along it.

Nodes are contacts: a piece of the leader's intent, a side and a bearing of a grid. Words lead from
the start to a node, from node to node, and on to the slot; boundary arcs lead from a node to its
neighbour. Labels are earliest arrivals. A node from which even the best way without the limit would
come too late is not followed, so where one contact is enough there is little to do here.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, MAX_CONTACTS, WORD, earliest_contact
from relguide.kernels.contact.contact import (
    boundary_arc_sense,
    contact_at,
    contact_exists,
    slide_within,
)
from relguide.kernels.contact.delay_after_contact import delay_until_release
from relguide.kernels.contact.passage import GRAZE, first_clear
from relguide.kernels.contact.paths_to_contact import not_before, not_before_slot
from relguide.kernels.separation.clearance import piece_at
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import MAX_ROWS, solve

_TRIES = 4  # times the hops of a round: so many nodes are left by a path that waits, 0.3 ms each
_ROUNDS = (
    3  # of hops, each followed by boundary arcs: chains with up to two hops and three boundary arcs
)
_BESIDE = 0.05  # nodes this close lead to the same places: 3° [rad]
_BETTER = 1e-9  # a label must fall by more than this [R/V_P], or rounding goes round in circles


@njit(cache=True, nogil=True)
def _next(
    bearings: FloatArray, n: int, size: int, leader: FloatArray, t: float, sides: FloatArray,
    alpha: float, delta: float,
) -> tuple[int, float, float]:  # fmt: skip
    """The node that a boundary arc from node n at time t comes to first, when, and its bearing
    unwrapped.

    −1 if the boundary arc cannot be flown. The leader may have gone on to another piece meanwhile.
    """
    side = sides[n]
    bearing = bearings[n]
    i = piece_at(leader, t)
    for _ in range(len(leader)):
        group = (2 * i + (0 if side > 0.0 else 1)) * size
        way = boundary_arc_sense(bearing, side, alpha, delta, leader[i, 4])
        if way == 0.0:
            break
        m, gap = -1, inf
        for j in range(size):
            ahead = wrap(way * (bearings[group + j] - bearing))
            if 1e-9 < ahead < gap:
                m, gap = group + j, ahead
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        goal = bearing + way * gap
        bearing, took = slide_within(bearing, goal, side, alpha, delta, leader[i, 4], left)
        if took == inf:
            break
        t += took
        if bearing == goal:
            return m, t, goal
        i += 1
    return -1, inf, 0.0


@njit(cache=True, nogil=True)
def _onward(
    leader: FloatArray, t: float, bearing: float, side: float, alpha: float, delta: float,
    t_release: float, beat: float, rows: FloatArray,
) -> tuple[float, float]:  # fmt: skip
    """From a contact to the slot: a bound on the arrival, and the arrival if before `beat`.

    The bound is the arrival without the limit, or when the slot opens: what is early may wait.
    """
    x, y, h = contact_at(leader, t, bearing, side, alpha, delta)
    n = solve(Pose(x - alpha * t, y, wrap(h)), alpha, 0.0, rows)
    if n == 0:
        return inf, inf
    lower = max(t + rows[0, 0], t_release)
    arrival, _ = first_clear(x, y, h, t, rows[:n], leader, alpha, delta - GRAZE, t_release, beat)
    return lower, arrival


@njit(cache=True, nogil=True)
def _waits(
    leader: FloatArray, alpha: float, delta: float, t_release: float, sides: FloatArray,
    bearings: FloatArray, time: FloatArray, lower: FloatArray, tried: FloatArray, tries: int,
) -> tuple[int, int]:  # fmt: skip
    """A node from which a clear path arrives just as the slot opens, −1 if none; tries left."""
    pieces = np.empty((DELAY_PIECES, 2))
    while tries > 0:
        n = -1
        for m in range(len(time)):
            if lower[m] <= t_release and time[m] < tried[m] and (n < 0 or time[m] < time[n]):
                n = m
        if n < 0:
            break
        tried[n] = time[n]
        tries -= 1
        x, y, h = contact_at(leader, time[n], bearings[n], sides[n], alpha, delta)
        if delay_until_release(x, y, h, time[n], leader, alpha, delta - GRAZE, t_release, pieces):
            return n, tries
    return -1, tries


@njit(cache=True, nogil=True)
def best_chains(
    leader: FloatArray, alpha: float, delta: float, t_release: float, sides: FloatArray,
    bearings: FloatArray, time: FloatArray, lower: FloatArray, beat: float, slack: float,
    hops: int, chains: FloatArray,
) -> int:  # fmt: skip
    """The best chains of two contacts or more on the grid, best first.

    Args:
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts [R].
        t_release: when the slot opens [R/V_P].
        sides: of the nodes, k groups of both sides. shape (n,)
        bearings: of the nodes [rad]. shape (n,)
        time: earliest arrival at each node from the start, infinite where none matters; falls.
        lower: before what no way by that node's label arrives at the slot; the time it opens where
            it could be reached sooner.
        beat: an arrival already known [R/V_P].
        slack: chains on the grid that arrive this much later are kept, to be refined [R/V_P].
        hops: from how many nodes words to other nodes are looked for, in each round.
        chains: takes the chains: a row with their arrival and number of contacts, then rows as in
            `fly_links`. One that arrives at t_release itself waits for that behind its last
            contact. shape (·, MAX_CONTACTS + 1, 4)

    Returns:
        how many.
    """
    count, size = len(bearings), len(bearings) // (2 * len(leader))
    pred = np.full(count, -1)
    link = np.full(count, WORD)
    gained = np.zeros(count)  # bearing ridden on the link
    arrive = np.full(count, inf)
    hopped = np.full(count, inf)  # the label with which a node was last followed
    fresh = np.zeros(count)
    tried, tries = np.full(count, inf), _TRIES * hops
    waiting = np.zeros(count)  # nodes whose label has fallen since they were last ridden from
    rows = np.empty((MAX_ROWS, 5))
    # on the final leg the way on without the limit takes as long at any time
    free = np.zeros(count)
    final = 2 * size * (len(leader) - 1)
    for n in range(final, count):
        if t_release <= time[n] < inf:
            free[n] = lower[n] - time[n]
    best = beat
    for n in range(count):
        if lower[n] < best + slack:
            waiting[n] = 1.0
    for turn in range(_ROUNDS):
        while True:
            # in order of time: a label that was taken does not fall again
            n = -1
            for m in range(count):
                if waiting[m] == 1.0 and (n < 0 or time[m] < time[n]):
                    n = m
            if n < 0:
                break
            waiting[n] = 0.0
            m, t, goal = _next(bearings, n, size, leader, time[n], sides, alpha, delta)
            if m < 0 or t >= time[m] - _BETTER:
                continue
            x, y, h = contact_at(leader, t, bearings[m], sides[m], alpha, delta)
            if not_before_slot(x, y, h, t, alpha, t_release) >= best + slack:
                continue
            time[m], pred[m], link[m], gained[m] = t, n, BOUNDARY_ARC, goal - bearings[n]
            fresh[m], waiting[m] = 1.0, 1.0
        for n in range(count):
            if fresh[n] == 0.0:
                continue
            fresh[n] = 0.0
            lower[n], arrive[n] = _onward(
                leader, time[n], bearings[n], sides[n], alpha, delta, t_release, best + slack, rows
            )
            best = min(best, arrive[n])
            if n >= final and t_release <= time[n]:
                free[n] = lower[n] - time[n]
        if lower.min() <= t_release < best:
            end, tries = _waits(
                leader, alpha, delta, t_release, sides, bearings, time, lower, tried, tries
            )
            if end >= 0:
                # what arrives as the slot opens cannot be beaten
                arrive[:] = inf
                arrive[end] = t_release
                best = t_release
                break
        if turn == _ROUNDS - 1:
            break
        near = np.zeros(count)  # nodes beside one that was followed in this round
        for _ in range(hops):
            n = -1
            for m in range(count):
                if (
                    near[m] == 0.0
                    and lower[m] < best
                    and time[m] < hopped[m]
                    and (n < 0 or lower[m] < lower[n])
                ):
                    n = m
            if n < 0:
                break
            group = n // size * size
            for m in range(group, group + size):
                if abs(wrap_signed(bearings[m] - bearings[n])) < _BESIDE:
                    near[m] = 1.0
            hopped[n] = time[n]
            x, y, h = contact_at(leader, time[n], bearings[n], sides[n], alpha, delta)
            for m in range(count):
                i = m // (2 * size)
                if m == n or not contact_exists(bearings[m], alpha):
                    continue
                t = not_before(
                    x, y, h, time[n], leader, i, alpha, delta, bearings[m], sides[m]
                )  # fmt: skip
                if t >= time[m] - _BETTER:
                    continue
                if t + free[m] >= best:
                    continue
                ax, ay, ah = contact_at(leader, t, bearings[m], sides[m], alpha, delta)
                if not_before_slot(ax, ay, ah, t, alpha, t_release) >= best:
                    continue
                t, _ = earliest_contact(
                    x, y, h, time[n], leader, i, alpha, delta, bearings[m], sides[m],
                    time[m] - _BETTER, rows,
                )  # fmt: skip
                if t == inf:
                    continue
                time[m], pred[m], link[m], fresh[m] = t, n, WORD, 1.0
        waiting[:] = fresh
        if not waiting.any():
            break
    return _collected(leader, sides, bearings, pred, link, gained, arrive, best + slack, chains)


@njit(cache=True, nogil=True)
def _collected(
    leader: FloatArray, sides: FloatArray, bearings: FloatArray, pred: FloatArray, link: FloatArray,
    gained: FloatArray, arrive: FloatArray, beat: float, chains: FloatArray,
) -> int:  # fmt: skip
    """The chains that end in the best nodes; of those alike in sides and links only the best."""
    size = len(bearings) // (2 * len(leader))
    kept = 0
    path = np.empty(len(bearings), dtype=np.int64)
    trial = np.empty((MAX_CONTACTS + 1, 4))
    for end in np.argsort(arrive):
        if arrive[end] >= beat or kept == len(chains):
            break
        length, n = 0, end
        while n >= 0:
            path[length] = n
            length += 1
            n = pred[n]
        contacts = 0
        for k in range(length - 1, -1, -1):
            n = path[k]
            bearing, boundary_arcs = bearings[n], link[n] == BOUNDARY_ARC and pred[n] >= 0
            if boundary_arcs:
                bearing = trial[contacts, 2] + gained[n]
            if not boundary_arcs or trial[contacts, 3] != BOUNDARY_ARC:
                contacts += 1
                if contacts > MAX_CONTACTS:
                    break
            trial[contacts, 0], trial[contacts, 1] = n // (2 * size), sides[n]
            trial[contacts, 2], trial[contacts, 3] = (
                bearing,
                BOUNDARY_ARC if boundary_arcs else WORD,
            )
        if contacts > MAX_CONTACTS:
            continue
        trial[0, 0], trial[0, 1] = arrive[end], contacts
        alike = False
        for k in range(kept):
            same = chains[k, 0, 1] == contacts
            for j in range(1, contacts + 1):
                if chains[k, j, 1] != trial[j, 1] or chains[k, j, 3] != trial[j, 3]:
                    same = False
            alike = alike or same
        if not alike:
            chains[kept] = trial
            kept += 1
    return kept
