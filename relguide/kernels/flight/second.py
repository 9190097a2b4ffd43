"""Steps of all aircraft in one call: autopilots and hands, roll, speed, wind, least separations.

Where the wind changes, from place to place or in a gust, an aircraft keeps its speed over the
ground: its airspeed changes by as much, along its heading, and the air carries it across.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit
from numpy.typing import NDArray

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.autopilot import aileron, commanded_bank
from relguide.kernels.flight.by_hand import STICK, follow_bar, roll_by_stick, smooth_bar
from relguide.kernels.flight.flight_records import (
    Control,
    Drift,
    at_speed,
    body_at,
    limits_at,
    store,
)
from relguide.kernels.flight.lateral import roll_step
from relguide.kernels.flight.program import fly_program

IntArray = NDArray[np.int64]
GUIDED = 0
"""A pilot: the autopilot flies its row of `controls`."""
PROGRAMMED = 1
"""Flies its program, at the speed of its row of `controls`."""
RECORDED = 2
"""Flies what stands in `trace`."""
BY_STICK = 3
"""Its crew flies it: the stick stands in its row of `hands`, the speed in that of `controls`."""
BY_BAR = 4
"""The pilot of its row of `hands` follows the roll bar to its row of `controls`."""
BANKED = 0.05236
"""Less than 3° of bank is a correction, not a turn [rad]."""
SWING, TRACK, SIDE, REVERSALS = 0, 1, 2, 3
"""Columns of `tallies`: heading flown through [rad]; way over the ground [m]; the last side banked
to, +1 right, −1 left; and how often it changed."""


@njit(cache=True, nogil=True)
def fly_steps(
    states: FloatArray, limits: FloatArray, pilots: IntArray, controls: FloatArray,
    programs: FloatArray, lengths: IntArray, cursors: IntArray, helds: FloatArray,
    hands: FloatArray, whites: FloatArray, winds: FloatArray, t: float, dt: float, begin: int,
    end: int, trace: FloatArray, bars: FloatArray, tallies: FloatArray,
) -> None:  # fmt: skip
    """Fly all aircraft on, step by step, over some of the steps of a second.

    Args:
        states: where they are; in the end, where they are then. shape (n, 7), as `Body`
        limits: what they can do. shape (n, 15), as `Limits`
        pilots: how each is flown: `GUIDED`, `PROGRAMMED`, `RECORDED`, `BY_STICK` or `BY_BAR`.
            shape (n,)
        controls: what guidance asks of each. shape (n, 3), as `Control`
        programs: what each declared; the rest of a row is not read. shape (n, k, 3)
        lengths: how many pieces each declared. shape (n,)
        cursors: the piece each is flying, kept up to date. shape (n,)
        helds: headings before the first piece [rad]. shape (n,)
        hands: the bars, and the hands of those that are flown by them. shape (n, `columns(dt)`)
        whites: draws of the standard normal distribution, read for pilots that follow a bar.
            shape (n, steps)
        winds: what moves each, now and after each step, gusts and all [m/s, east and north].
            shape (n, steps + 1, 2)
        t: flight time at the first step of the second [s].
        dt: the step [s].
        begin: the first step to fly.
        end: the one after the last.
        trace: where each is after each step, the present first; rows of recorded aircraft are
            given, all others written. shape (n, steps + 1, 7)
        bars: commanded bank of guided aircraft, and their roll bar, as they come out of each step
            [rad]; the first are given. shape (n, steps + 1, 2)
        tallies: figures so far. shape (n, 4)
    """
    for i in range(len(states)):
        can = limits_at(limits, i)
        body = body_at(states, i)
        store(trace[i], begin, body)
        program = programs[i, : lengths[i]]
        for k in range(begin, end):
            wind = Drift(winds[i, k, 0], winds[i, k, 1])
            if pilots[i] == RECORDED:
                after = body_at(trace[i], k + 1)
            elif pilots[i] == PROGRAMMED:
                after, cursors[i] = fly_program(
                    program, cursors[i], helds[i], body, can, wind, t + k * dt, dt, controls[i, 2]
                )
            else:
                control = Control(controls[i, 0], controls[i, 1], controls[i, 2])
                bank, integral = commanded_bank(body, control, can, dt)
                bars[i, k + 1, 0] = bank
                bars[i, k + 1, 1] = smooth_bar(hands[i], bank - body.bank, dt)
                roll = aileron(bank, body, can)
                if pilots[i] == BY_BAR:
                    follow_bar(hands[i], bars[i, k, 1], body, whites[i, k], can, t + k * dt, dt)
                if pilots[i] != GUIDED:
                    roll = roll_by_stick(hands[i, STICK], body, can)
                after = roll_step(body, roll, integral, control.tas, can, wind, dt)
            east, north = winds[i, k + 1, 0] - wind.east, winds[i, k + 1, 1] - wind.north
            if (east != 0.0 or north != 0.0) and pilots[i] != RECORDED:
                along = east * sin(after.heading) + north * cos(after.heading)
                after = at_speed(after, after.tas - along)
            store(trace[i], k + 1, after)
            tallies[i, SWING] += abs(after.heading - body.heading)
            tallies[i, TRACK] += hypot(after.x - body.x, after.y - body.y)
            if abs(after.bank) > BANKED:
                side = 1.0 if after.bank > 0.0 else -1.0
                if side * tallies[i, SIDE] < 0.0:
                    tallies[i, REVERSALS] += 1.0
                tallies[i, SIDE] = side
            body = after
        store(states, i, body)


@njit(cache=True, nogil=True)
def least_between(one: FloatArray, other: FloatArray) -> tuple[float, float]:
    """The least distance of two aircraft on their traces, and at which share of them.

    Between steps the relative motion is taken as straight: over 0.05 s it bends by millimetres.

    Args:
        one: as a row of `trace`. shape (steps + 1, 7)
        other: the same of the other aircraft.

    Returns:
        distance [m], and when, in steps from the first.
    """
    least, at = inf, 0.0
    for k in range(len(one)):
        dx, dy = one[k, 0] - other[k, 0], one[k, 1] - other[k, 1]
        share = 0.0
        if k + 1 < len(one):
            vx, vy = one[k + 1, 0] - other[k + 1, 0] - dx, one[k + 1, 1] - other[k + 1, 1] - dy
            speed = vx * vx + vy * vy
            if speed > 0.0:
                share = min(max(-(dx * vx + dy * vy) / speed, 0.0), 1.0)
                dx, dy = dx + share * vx, dy + share * vy
        apart = hypot(dx, dy)
        if apart < least:
            least, at = apart, k + share
    return least, at
