"""Riding along d = d_min between two contacts: worth it where R < d_min and the way round is long.

Round a leader that keeps straight the ride is autonomous: its time depends on its two bearings
only. So the arrival splits into the way to the first contact, the ride, and the way from the last:
the best pair is found in one sweep round the disc, and each end refined by itself. Rides are looked
for while the leader is on its final leg, for V_L < V_P.

The ride is handed over as short arcs of partial bank, each made of two so that at every node
distance and heading are those of the ride. Slot frame: lengths in R, times in R/V_P, angles
counter-clockwise.
"""

from math import ceil, cos, hypot, inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.clearance import fly_rate, leader_at
from relguide.kernels.contact import contact_heading, ride_time, ride_turn
from relguide.kernels.extremals import MAX_ROWS
from relguide.kernels.passage import GRAZE, best_word, ways_to_contact, word_clears
from relguide.kernels.roots import FloatArray

NODE = 0.03
"""Time between nodes of a ride [R/V_P]: between them it strays from d_min by some 1e-8 R."""
MAX_NODES = 600
"""Longest ride in nodes: three times the time to circle any disc that can be ridden."""
_FINEST = 1e-8  # bearing steps end here: 0.1 mm at R = 12 km


@njit(cache=True, nogil=True)
def _time_to_contact(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, bearing: float,
    side: float, rows: FloatArray, way: FloatArray,
) -> float:  # fmt: skip
    """Earliest clear arrival at a contact on the final leg; infinite if none."""
    last = len(leader) - 1
    n = ways_to_contact(x, y, h, leader, last, alpha, delta, bearing, side, rows)
    for k in range(n):
        if word_clears(x, y, h, 0.0, rows[k], leader, alpha, delta - GRAZE):
            way[:] = rows[k]
            return float(rows[k, 0])
    return inf


@njit(cache=True, nogil=True)
def _time_from_contact(
    leader: FloatArray, alpha: float, delta: float, t_ref: float, bearing: float, side: float,
    rows: FloatArray,
) -> float:  # fmt: skip
    """From a contact to the open slot; the same at any time on the final leg."""
    lx, ly, lh = leader_at(leader, len(leader) - 1, alpha, t_ref)
    arrival, _ = best_word(
        lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing),
        lh + contact_heading(bearing, side, alpha), t_ref, leader, alpha, delta - GRAZE, t_ref,
        inf, rows,
    )  # fmt: skip
    return arrival - t_ref


@njit(cache=True, nogil=True)
def _can_ride(low: float, high: float, side: float, alpha: float, delta: float) -> bool:
    """Whether every bearing between can be ridden at full bank or less (looked at every 2°)."""
    steps = ceil(abs(high - low) / 0.035) + 1
    for k in range(steps + 1):
        if ride_turn(low + (high - low) * k / steps, side, alpha, delta) > 1.0:
            return False
    return True


@njit(cache=True, nogil=True)
def _somewhere(alpha: float, delta: float) -> bool:
    """Whether the disc can be ridden anywhere: easiest abeam, flying the leader's way."""
    return ride_turn(-0.5 * pi, 1.0, alpha, delta) <= 1.0


@njit(cache=True, nogil=True)
def _nodes(
    specials: FloatArray, side: float, alpha: float, delta: float, bearings: int
) -> FloatArray:
    """Bearings of one side in the order ridden: a grid, the specials, the ends of what can be."""
    nodes = np.empty(2 * bearings + len(specials))
    n = bearings
    for j in range(bearings):
        nodes[j] = TWO_PI * j / bearings
        low, high = side * nodes[j], side * (nodes[j] + TWO_PI / bearings)
        inside = ride_turn(low, side, alpha, delta) <= 1.0
        if inside != (ride_turn(high, side, alpha, delta) <= 1.0):
            for _ in range(50):
                middle = 0.5 * (low + high)
                if (ride_turn(middle, side, alpha, delta) <= 1.0) == inside:
                    low = middle
                else:
                    high = middle
            nodes[n] = side * (low if inside else high)
            n += 1
    for special in specials:
        if special[1] == side:
            nodes[n] = special[0] if side > 0.0 else wrap(-special[0])
            n += 1
    return side * np.sort(nodes[:n])


@njit(cache=True, nogil=True)
def best_ride(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_open: float,
    bearings: int, tangents: FloatArray, beat: float, way: FloatArray,
) -> tuple[float, float, float, float]:  # fmt: skip
    """The fastest way to the slot that rides along the disc.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance of the ride [R].
        t_open: when the slot opens [R/V_P].
        bearings: how finely the disc is scanned.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 3)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        way: takes the row of `solve` to the first contact. shape (5,)

    Returns:
        arrival [R/V_P], side, first and last bearing [rad]; `beat` and zeros if none is faster.
    """
    best, best_side, best_first, best_last = beat, 0.0, 0.0, 0.0
    if alpha >= 1.0:
        return best, best_side, best_first, best_last
    rows = np.empty((MAX_ROWS, 5))
    trial = np.empty(5)
    t_ref = max(t_open, leader[len(leader) - 1, 0])
    if not _somewhere(alpha, delta):
        return best, best_side, best_first, best_last
    stride = TWO_PI / bearings
    for k in range(2):
        side = 1.0 - 2.0 * k
        nodes = _nodes(tangents, side, alpha, delta, bearings)
        size = len(nodes)
        ride = np.empty(size)
        to = np.full(size, inf)
        onward = np.full(size, inf)
        for j in range(size):
            bearing = nodes[j]
            following = nodes[j + 1] if j + 1 < size else nodes[0] + side * TWO_PI
            rides = _can_ride(bearing, following, side, alpha, delta)
            ride[j] = ride_time(bearing, following, side, alpha, delta) if rides else inf
        for j in range(size):
            if ride[j] < inf:
                to[j] = _time_to_contact(x, y, h, leader, alpha, delta, nodes[j], side, rows, trial)
            if ride[j - 1] < inf:
                onward[j] = _time_from_contact(leader, alpha, delta, t_ref, nodes[j], side, rows)
        first, last, low = -1, -1, best
        for j in range(size):
            time = to[j]
            for n in range(1, size):
                time += ride[(j + n - 1) % size]
                if time >= low:
                    break
                arrival = time + onward[(j + n) % size]
                if t_open <= arrival < low:
                    first, last, low = j, j + n, arrival
        if first < 0:
            continue
        # the two ends are refined one by one about a bearing between them
        first_bearing = nodes[first]
        last_bearing = nodes[last % size] + (side * TWO_PI if last >= size else 0.0)
        middle = 0.5 * (first_bearing + last_bearing)
        head = to[first] + _long_ride(first_bearing, middle, side, alpha, delta)
        tail = onward[last % size] + _long_ride(middle, last_bearing, side, alpha, delta)
        for end in range(2):
            step = 0.5 * stride
            while step > _FINEST:
                moved = False
                for direction in range(2):
                    there = (first_bearing if end == 0 else last_bearing) + step * (
                        1.0 - 2.0 * direction
                    )
                    if (there - middle) * side * (1.0 if end == 1 else -1.0) < 0.0 or not _can_ride(
                        there, middle, side, alpha, delta
                    ):
                        continue
                    if end == 0:
                        value = _time_to_contact(
                            x, y, h, leader, alpha, delta, there, side, rows, trial
                        ) + _long_ride(there, middle, side, alpha, delta)
                        if value < head:
                            head, first_bearing, moved = value, there, True
                    else:
                        value = _time_from_contact(
                            leader, alpha, delta, t_ref, there, side, rows
                        ) + _long_ride(middle, there, side, alpha, delta)
                        if value < tail:
                            tail, last_bearing, moved = value, there, True
                    if moved:
                        break
                if not moved:
                    step *= 0.4
        arrival = _time_to_contact(
            x, y, h, leader, alpha, delta, first_bearing, side, rows, trial
        ) + _long_ride(first_bearing, last_bearing, side, alpha, delta)
        arrival += _time_from_contact(leader, alpha, delta, t_ref, last_bearing, side, rows)
        if t_open <= arrival < best:
            best, best_side, best_first, best_last = arrival, side, first_bearing, last_bearing
            way[:] = trial
    return best, best_side, best_first, best_last


@njit(cache=True, nogil=True)
def _long_ride(low: float, high: float, side: float, alpha: float, delta: float) -> float:
    """`ride_time` in steps of 4° at most: Simpson's rule is then right to 1e-9."""
    steps = ceil(abs(high - low) / 0.07) + 1
    time = 0.0
    for k in range(steps):
        time += ride_time(
            low + (high - low) * k / steps, low + (high - low) * (k + 1) / steps, side, alpha, delta
        )
    return time


@njit(cache=True, nogil=True)
def ride_pieces(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    side: float, first: float, last: float, pieces: FloatArray,
) -> tuple[int, float, float, float, float]:  # fmt: skip
    """The ride as arcs of partial bank.

    Args:
        x: where it begins: at the first contact, on its heading [R].
        y: the same [R].
        h: the same [rad].
        t: when [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance of the ride [R].
        side: +1 counter-clockwise round the leader.
        first: bearing where it begins [rad].
        last: bearing where it ends [rad].
        pieces: takes duration [R/V_P] and turn rate of each arc. shape (2·MAX_NODES, 2)

    Returns:
        how many arcs, and x, y, h, t at the end.
    """
    i = len(leader) - 1
    nodes = min(ceil(_long_ride(first, last, side, alpha, delta) / NODE), MAX_NODES)
    n = 0
    bearing = first
    for node in range(1, nodes + 1):
        goal = first + (last - first) * node / nodes
        duration = _long_ride(bearing, goal, side, alpha, delta)
        half = 0.5 * duration
        spread, last_spread, last_off = 0.0, 0.0, 0.0
        for attempt in range(6):
            lx, ly, lh = leader_at(leader, i, alpha, t + duration)
            # the mean rate brings the heading to the contact's, the spread the distance to δ
            mean = wrap_signed(lh + contact_heading(goal, side, alpha) - h) / duration
            ax, ay, ah = fly_rate(x, y, h, mean + spread, half)
            bx, by, bh = fly_rate(ax, ay, ah, mean - spread, half)
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
        pieces[n, 0], pieces[n, 1] = half, mean + spread
        pieces[n + 1, 0], pieces[n + 1, 1] = half, mean - spread
        n += 2
        x, y, h, t = bx, by, bh, t + duration
        bearing = goal
    return n, x, y, h, t
