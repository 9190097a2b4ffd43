"""The closed loop flown ahead without planning: what will be flown if nothing new happens."""

from math import sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight import marks as at
from relguide.kernels.flight.flight_records import Body, Drift, Limits, store
from relguide.kernels.flight.guide import CONVERGE, Course, Gate, Progress, Task, act
from relguide.kernels.flight.lateral import lateral_step
from relguide.kernels.flight.laws import Gains, ground_track
from relguide.kernels.flight.program import fly_program
from relguide.kernels.flight.second import least_between

LEAST, AT, MODE, RIGHT, S, TO_SLOT = 0, 1, 2, 3, 4, 5
"""Columns of a forecast's account, a row a second: least separation in it [m] and when [s, flight
time], the mode flown, how far beside the path [m], how far along it [m], distance to close [m]."""
NEVER = -1.0
"""Join time of a forecast that does not join."""


@njit(cache=True, nogil=True)
def add_mark(marks: FloatArray, count: int, leader: Body, wind: Drift, t: float) -> None:
    """Write mark number `count` from where the leader is; the one before must be there."""
    last = marks[count - 1]
    dx, dy = leader.x - last[at.X], leader.y - last[at.Y]
    direction, speed = ground_track(leader, wind)
    marks[count, at.S] = last[at.S] + sqrt(dx * dx + dy * dy)
    marks[count, at.X], marks[count, at.Y] = leader.x, leader.y
    marks[count, at.HEADING], marks[count, at.TRACK] = leader.heading, direction
    marks[count, at.SPEED], marks[count, at.T] = speed, t


@njit(cache=True, nogil=True)
def fly_ahead(
    progress: Progress, body: Body, limits: Limits, course: Course, marks: FloatArray,
    leader: Body, leader_limits: Limits, program: FloatArray, cursor: int, held: float,
    leader_tas: float, last_turn: int, task: Task, gate: Gate, gains: Gains, wind: Drift,
    t: float, seconds: int, after_joining: int, steps: int,
) -> tuple[FloatArray, FloatArray, FloatArray, float]:  # fmt: skip
    """Fly both aircraft on, guidance acting once a second as it would.

    Args:
        progress: how far guidance has come.
        body: the pursuer now.
        limits: what it can do.
        course: what it converges by.
        marks: the leader's flown path, the last one now.
        leader: now.
        leader_limits: what it can do.
        program: what it is expected to fly. shape (k, 3)
        cursor: the piece being flown.
        held: its heading before the first piece [rad].
        leader_tas: the speed that it goes for [m/s].
        last_turn: number of its last declared turn, −1 if there is none.
        task: what the pursuer was asked to do.
        gate: when it has joined.
        gains: of the laws.
        wind: as it is believed.
        t: flight time [s].
        seconds: how far to fly at most.
        after_joining: how far to go on once joined [s].
        steps: of a second.

    Returns:
        the pursuer and the leader at each second, the present first, shape (n + 1, 7) each; the
        account, shape (n, 6); and when it joins, flight time [s], `NEVER` if it does not.
    """
    known = len(marks)
    grown = np.empty((known + seconds + 1, marks.shape[1]))
    grown[:known] = marks
    own, other = np.empty((seconds + 1, 7)), np.empty((seconds + 1, 7))
    account = np.empty((seconds, 6))
    store(own, 0, body)
    store(other, 0, leader)
    ours, theirs = np.empty((steps + 1, 7)), np.empty((steps + 1, 7))
    dt = 1.0 / steps
    join_time, flown = NEVER, seconds
    for k in range(seconds):
        now = t + k
        done = act(
            progress, body, limits, course, grown[: known + k], cursor <= last_turn,
            task, gate, gains, wind, now,
        )  # fmt: skip
        progress = done.progress
        if done.joined and join_time < 0.0:
            join_time, flown = now, min(k + after_joining, seconds)
        if k >= flown:
            return own[: k + 1], other[: k + 1], account[:k], join_time
        store(ours, 0, body)
        store(theirs, 0, leader)
        for i in range(steps):
            body = lateral_step(body, done.control, limits, wind, dt)
            leader, cursor = fly_program(
                program, cursor, held, leader, leader_limits, wind, now + i * dt, dt, leader_tas
            )
            store(ours, i + 1, body)
            store(theirs, i + 1, leader)
        least, when = least_between(ours, theirs)
        account[k, LEAST], account[k, AT] = least, now + when * dt
        account[k, MODE], account[k, TO_SLOT] = progress.mode, done.to_slot
        account[k, RIGHT] = done.right if progress.mode == CONVERGE else 0.0
        account[k, S] = progress.s
        store(own, k + 1, body)
        store(other, k + 1, leader)
        add_mark(grown, known + k, leader, wind, now + 1.0)
    return own, other, account, join_time
