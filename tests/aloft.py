"""Short ways to fly the flight kernels in tests: one aircraft, asked something once a second."""

from collections.abc import Callable
from math import inf

import numpy as np

from relguide.flying.air import STANDARD_AIR
from relguide.flying.airframe import Airframe
from relguide.flying.airframe_files import airframe
from relguide.flying.envelope import FL310
from relguide.flying.guidance.settings import DEFAULT
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.by_hand import columns
from relguide.kernels.flight.flight_records import HOLD_HEADING, Body, Control, Drift, Limits
from relguide.kernels.flight.guide import CONVERGE, Course, Progress, Task, act
from relguide.kernels.flight.laws import Gains
from relguide.kernels.flight.second import GUIDED, IntArray, fly_steps
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

A306 = airframe("A306")
MAX_BANK: Radian = 25.0 * DEG
"""What most flights let the autopilot use."""
STEP: Second = 0.05
STILL = Drift(0.0, 0.0)
Law = Callable[[Second, Body], Control]
"""What to ask of the autopilot for a second, at a flight time."""


def limits_of(
    kind: Airframe = A306,
    *,
    max_bank: Radian = MAX_BANK,
    min_tas: MetrePerSecond = 100.0,
    max_tas: MetrePerSecond = 250.0,
) -> Limits:
    """What a type can do at FL310, by an autopilot that may bank so much."""
    climb, idle, brakes, induced = kind.energy(FL310, STANDARD_AIR)
    return Limits(
        max_bank,
        kind.max_roll_rate,
        kind.roll_time_constant,
        kind.speed_time_constant,
        *climb,
        *idle,
        brakes,
        induced,
        1.0,
        min_tas,
        max_tas,
    )


LIMITS = limits_of()


def level(
    x: float = 0.0, y: float = 0.0, heading: float = 0.0, *, bank: float = 0.0, tas: float = 240.0
) -> Body:
    """An aircraft that does not roll; angles in degrees."""
    return Body(x, y, heading * DEG, bank * DEG, 0.0, tas, 0.0)


def hold(heading: float, tas: float = 240.0) -> Control:
    """A heading in degrees."""
    return Control(HOLD_HEADING, heading * DEG, tas)


def steady(wind: Drift, count: int = 1, steps: int = round(1.0 / STEP)) -> FloatArray:
    """One wind at each step of a second, for so many aircraft. shape (count, steps + 1, 2)"""
    return np.tile(np.array(wind), (count, steps + 1, 1))


def fly_second(
    states: FloatArray, limits: FloatArray, pilots: IntArray, controls: FloatArray,
    programs: FloatArray, lengths: IntArray, cursors: IntArray, helds: FloatArray,
    winds: FloatArray, t: float, dt: float, trace: FloatArray, tallies: FloatArray,
) -> None:  # fmt: skip
    """A whole second of aircraft that no crew flies by hand, as `fly_steps` takes them."""
    count, steps = len(states), trace.shape[1] - 1
    fly_steps(
        states, limits, pilots, controls, programs, lengths, cursors, helds,
        np.zeros((count, columns(dt))), np.zeros((count, steps)), winds, t, dt, 0, steps, trace,
        np.zeros((count, steps + 1, 2)), tallies,
    )  # fmt: skip


def fly(
    asked: Law | Control,
    begun: Body,
    duration: Second,
    *,
    limits: Limits = LIMITS,
    wind: Drift = STILL,
    step: Second = STEP,
) -> FloatArray:
    """Where an aircraft is at each step, the present first. shape (n + 1, 7), as `Body`."""
    steps = round(1.0 / step)
    states, rows = np.array([begun], dtype=float), [np.array([begun], dtype=float)]
    idle = np.zeros(1, dtype=np.int64)
    pilots = np.full(1, GUIDED, dtype=np.int64)
    for second in range(round(duration)):
        control = asked(float(second), Body(*states[0])) if callable(asked) else asked
        trace = np.zeros((1, steps + 1, 7))
        fly_second(
            states, np.array([limits]), pilots, np.array([control]), np.zeros((1, 0, 3)), idle,
            idle.copy(), np.zeros(1), steady(wind, 1, steps), float(second), step, trace,
            np.zeros((1, 4)),
        )  # fmt: skip
        rows.append(trace[0, 1:])
    return np.vstack(rows)


FAR_AWAY = np.array([[0.0, 1e7, 1e7, 0.0, 0.0, 200.0, 0.0], [2e2, 1e7, 1e7, 0.0, 0.0, 200.0, 1.0]])
"""Marks of a leader that is nowhere near: nothing is captured."""
GAINS = DEFAULT.gains(0.6)


def tracking(
    path: FloatArray,
    *,
    tas: MetrePerSecond = 240.0,
    s: Metre = 0.0,
    limits: Limits = LIMITS,
    gains: Gains = GAINS,
    wind: Drift = STILL,
) -> Law:
    """The law that tracks a path through the air mass, from length s on, at one speed."""
    progress = Progress(CONVERGE, s - tas, 0.0, 0.0)
    task = Task(tas, 10_000.0, 10_000.0, 0.0, 0.0)
    course = Course(path, 0.0, 1e6, tas, wind, inf)

    def law(t: Second, body: Body) -> Control:
        nonlocal progress
        done = act(
            progress, body, limits, course, FAR_AWAY, False, task, DEFAULT.gate, gains, wind, t
        )
        progress = done.progress
        return done.control

    return law
