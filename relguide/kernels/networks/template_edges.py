"""Paths through one contact that are fastest at an edge: where they begin to keep the limit.

The least of t₁(b) + t₂(b) may lie where a word before or behind the contact leads through the disc
elsewhere. Then the fastest path that keeps the limit is next to it, at the edge: it touches once
more, or a word of the pair ceases to exist there. The edge is bracketed from a guess, and halved.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import inf

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.near_guess import Room, Task, time_through
from relguide.kernels.networks.template_legs import clears, write_legs

_STRIDE = 0.01  # of the first look beside a guess [rad]
_LOOKS = 5  # each twice as far as the last: up to 0.31 rad away
_FINEST = 1e-9  # brackets end here: a time is then good to 10⁻⁷ R/V_P, however steep


@njit(cache=True, nogil=True)
def _try(bearing: float, task: Task, room: Room, legs: FloatArray) -> tuple[float, bool]:
    """Time through a contact, and whether the path keeps the limit."""
    time = time_through(bearing, task, room.link[:2], room)
    if time == inf:
        return inf, False
    count = write_legs(task, bearing, room, legs)
    return time, clears(task, legs[:count])


@njit(cache=True, nogil=True)
def time_at_edge(bearing: float, task: Task, room: Room, legs: FloatArray) -> float:
    """The time of the fastest path through one contact that keeps the limit, next to a guess.

    Args:
        bearing: guess of the contact's, from the leader [rad].
        task: a template whose entry and way on are branches.
        room: to work in.
        legs: takes the legs. shape (≥ 2, 6)

    Returns:
        time; infinite if there is no edge there.
    """
    here, keeps = _try(bearing, task, room, legs)
    good, bad = bearing, bearing
    if keeps:
        # downhill, until the limit is kept no more
        ahead, _ = _try(bearing + _STRIDE, task, room, legs)
        behind, _ = _try(bearing - _STRIDE, task, room, legs)
        if (ahead < here) == (behind < here) and (ahead < inf) == (behind < inf):
            return inf
        forward = ahead < here or (ahead == inf and behind >= here)
        stride = _STRIDE if forward else -_STRIDE
        for _ in range(_LOOKS):
            bad = good + stride
            _, keeps = _try(bad, task, room, legs)
            if not keeps:
                break
            good = bad
            stride *= 2.0
        if keeps:
            return inf
    else:
        stride = _STRIDE
        for _ in range(_LOOKS):
            for direction in (1.0, -1.0):
                there = bearing + direction * stride
                _, keeps = _try(there, task, room, legs)
                if keeps:
                    good, bad = there, bearing + 0.5 * direction * stride
                    if stride == _STRIDE:
                        bad = bearing
                    break
            if keeps:
                break
            stride *= 2.0
        if not keeps:
            return inf
    while abs(good - bad) > _FINEST:
        middle = 0.5 * (good + bad)
        _, keeps = _try(middle, task, room, legs)
        if keeps:
            good = middle
        else:
            bad = middle
    time, _ = _try(good, task, room, legs)
    return time
