"""Many situations with leaders that turn: the time of each whose optimum cheap tests prove.

Where the slot can be reached before it opens, and a simple path that keeps d_min arrives just then,
that is the optimum; elsewhere it is the fastest extremal, where that keeps d_min. Together these
are ninety-nine of a hundred airliners. The others are left to `plan`: they take a search.
"""

from math import hypot, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import turn_to, wrap
from relguide.kernels.base.motion import advance
from relguide.kernels.base.records import Pose, Scene, start_at, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.slot_frame import slot_offset, to_slot
from relguide.kernels.base.turn import turn_radius
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.maps.release import ON_TIME, reaches, release_clears
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import Scratch, make_scratch

UNDECIDED, OPTIMUM, ALREADY_LOST = 0.0, 1.0, 2.0
"""What a row of the answer says: ask `plan`; the optimum, proved; too close from the start."""
_IN_SLOT = 1e-6  # going straight just reaches the slot as it opens, to rounding: left to `plan` [R]
_FinalLeg = tuple[int, float, float, float, float]

IntArray = np.ndarray[tuple[int, ...], np.dtype[np.int64]]


@njit(cache=True, nogil=True)
def turning_rows(
    situations: FloatArray, starts: IntArray, pieces: FloatArray, horizon: float,
    answers: FloatArray,
) -> None:  # fmt: skip
    """Answers to all situations.

    Args:
        situations: x, y, ψ, V, φ_max of the pursuer; x, y, ψ, V of the leader; D; d_min; the wind
            east and north; in SI units and radians, world frame. shape (n, 13)
        starts: the first of `pieces` of each situation, and at the end how many there are.
            shape (n + 1,)
        pieces: of intents. ε, 0 for a straight; the heading at its end [rad], or how long the
            straight is flown [s]; |φ| of the turn [rad]. shape (m, 3)
        horizon: later arrivals are left to `plan` [s].
        answers: takes the arrival [s] and what it is. shape (n, 2)
    """
    scratch = make_scratch()
    row, piece = np.empty(5), np.empty(3)
    most = 0
    for n in range(len(situations)):
        most = max(most, starts[n + 1] - starts[n])
    table = np.empty((most + 1, 5))
    for n in range(len(situations)):
        px, py, psi, tas, bank, lx, ly, _, leader_tas, _, d_min, _, _ = situations[n]
        radius = turn_radius(tas, bank)
        answer = answers[n]
        answer[0], answer[1] = inf, UNDECIDED
        if hypot(px - lx, py - ly) < d_min - SLACK * radius:
            answer[1] = ALREADY_LOST
            continue
        intent = pieces[starts[n] : starts[n + 1]]
        count, x, y, heading, opens = _leader_table(situations[n], intent, radius, table)
        pose = Pose(x, y, wrap(heading - psi))
        limit = d_min / radius
        scene = Scene(table[:count], leader_tas / tas, limit, opens * tas / radius, inf)
        arrival = _arrival(pose, scene, scratch, row, piece) * radius / tas
        if arrival <= horizon:
            answer[0], answer[1] = arrival, OPTIMUM


@njit(cache=True, nogil=True)
def _arrival(
    pose: Pose, scene: Scene, scratch: Scratch, row: FloatArray, piece: FloatArray
) -> float:
    """The time of the optimum [R/V_P], infinite if that is not decided here."""
    alpha, t_release, limited = scene.alpha, scene.t_release, scene.d_min > 0.0
    near = with_limit(scene, scene.d_min - SLACK)
    start = start_at(pose)
    if t_release > 0.0:
        if abs(hypot(alpha * t_release - pose.x, pose.y) - t_release) <= _IN_SLOT:
            return inf
        if reaches(start, alpha * t_release, t_release, piece):
            # even without a limit there may be no path of just that length
            return t_release if release_clears(start, near, piece, row) else inf
    if not fastest(pose, alpha, t_release, 0, scratch, row):
        return inf
    if limited and not keeps_clear(start, 0.0, row, alpha * row[0], near, np.zeros(2)):
        return inf
    return row[0] if row[0] >= t_release - ON_TIME else inf


@njit(cache=True, nogil=True)
def _leader_table(
    situation: FloatArray, intent: FloatArray, radius: float, table: FloatArray
) -> _FinalLeg:
    """The leader's pieces in the slot frame, as in `Scene`.

    Args:
        situation: a row of `turning_rows`.
        intent: its pieces.
        radius: R [m].
        table: takes them.

    Returns:
        how many rows; the pursuer in the slot frame, x and y [R]; the leader's final heading [rad];
        and when the slot opens [s].
    """
    px, py, _, tas, _, x, y, heading, leader_tas, slot_distance, _, east, north = situation
    count, t, turns = 0, 0.0, False
    for i in range(len(intent) + 1):
        eps, duration, rate, end = 0.0, inf, 0.0, heading
        if i < len(intent):
            eps, duration = intent[i, 0], intent[i, 1]
        if eps != 0.0:
            end = intent[i, 1]
            angle, around = turn_to(-eps * (end - heading)), turn_radius(leader_tas, intent[i, 2])
            duration, rate = angle * around / leader_tas, -eps * leader_tas / around
            turns = turns or angle > 0.0
        if duration * tas / radius > ON_TIME:  # shorter pieces are rounding
            table[count, 0], table[count, 1], table[count, 2] = t, x, y
            table[count, 3], table[count, 4] = heading, rate
            count += 1
        if i < len(intent):
            x, y, _ = advance(x, y, heading, leader_tas, rate, duration)
            heading = end
            t += duration
    # the slot at t = 0, were the final leg flown from then on
    back_x, back_y, ground_speed = slot_offset(heading, leader_tas, east, north, slot_distance)
    ahead_x, ahead_y, _ = advance(x, y, heading, leader_tas, 0.0, -t)
    origin_x, origin_y = ahead_x + back_x, ahead_y + back_y
    for i in range(count):
        table[i, 0] *= tas / radius
        table[i, 1], table[i, 2] = to_slot(
            table[i, 1] - origin_x, table[i, 2] - origin_y, heading, radius
        )
        table[i, 3] = heading - table[i, 3]
        table[i, 4] *= -radius / tas
    px, py = to_slot(px - origin_x, py - origin_y, heading, radius)
    return count, px, py, heading, t + slot_distance / ground_speed if turns else 0.0
