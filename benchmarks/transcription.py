"""Direct transcription with IPOPT: what one would try first where the separation limit binds.

Multiple shooting of the pursuer's three states in the leader's frame, turn rate constant over each
interval (so an interval is exactly an arc), final time free, separation held at the nodes and half
way between them. The leader flies its intent, and the slot opens when it does.

Slot frame seen from the slot: it stands still at the origin, as does the leader on its final leg.
Lengths in R, times in R/V_P, angles counter-clockwise.
"""

from dataclasses import dataclass
from math import hypot, pi
from typing import Any

import casadi as ca
import numpy as np

from benchmarks.cases import Case
from benchmarks.starts import Path
from relguide import LEFT, RIGHT, Arc, Straight, Trajectory, certify
from relguide.kernels.base.angles import wrap_signed

INTERVALS = 80
"""Arcs of a path: a turn of 30 s is some ten of them for an airliner 100 km out."""
ITERATIONS = 400
"""IPOPT gives up after this many."""
ARRIVED = 1e-3
"""A path that ends this far from the slot, flown again, has not converged [R]: 10 m or so."""
GENTLE = 1e-9
"""Turn rates below this are straights [V_P/R]."""
EARLY = 1e-6
"""So much before the slot opens counts as then, since IPOPT keeps bounds to 1e-8 [R/V_P]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """A path, flown again arc by arc."""

    path: Path
    time: float
    """Arrival [s]."""
    arrives: bool
    """Whether it ends in the slot, on the leader's heading, and not before it opens."""
    short: float
    """How far it cuts into d_min, as between two nodes [R]; negative if it keeps clear."""


class Transcription:
    """The nonlinear programme, built once: situations are its parameters."""

    def __init__(self, intervals: int = INTERVALS, *, turns: int = 0) -> None:
        """Build it for so many intervals, and leaders that turn no more often than that."""
        self.intervals, self.turns, n = intervals, turns, intervals
        states, rates, time = ca.MX.sym("s", 3, n + 1), ca.MX.sym("u", n), ca.MX.sym("T")
        start, alpha, goal = ca.MX.sym("start", 3), ca.MX.sym("alpha"), ca.MX.sym("goal", 3)
        leader, limit = ca.MX.sym("leader", 3 + 3 * turns), ca.MX.sym("d")
        step = _step()
        whole = step.map(n)(states[:, :-1], rates.T, time / n, alpha)
        half = step.map(n)(states[:, :-1], rates.T, 0.5 * time / n, alpha)
        seen = ca.horzcat(states[:2, 1:], half[:2, :])
        at = time * np.concatenate([np.arange(1, n + 1), np.arange(n) + 0.5]).reshape(1, -1) / n
        there = _leader(turns).map(2 * n)(at, leader, alpha)
        clear = ca.sum1((seen - there) ** 2) - limit**2
        constraints = ca.vertcat(
            states[:, 0] - start,
            ca.vec(states[:, 1:] - whole),
            states[:, n] - goal,
            clear.T,
        )
        equal = 3 * (n + 2)
        self._lower = np.zeros(equal + 2 * n)
        self._upper = np.concatenate([np.zeros(equal), np.full(2 * n, np.inf)])
        self._box = np.concatenate([np.full(3 * (n + 1), np.inf), np.ones(n), [np.inf]])
        self._solver = ca.nlpsol(
            "transcription",
            "ipopt",
            {
                "x": ca.vertcat(ca.vec(states), rates, time),
                "p": ca.vertcat(start, alpha, goal, leader, limit),
                "f": time,
                "g": constraints,
            },
            {
                "ipopt": {"print_level": 0, "sb": "yes", "max_iter": ITERATIONS, "tol": 1e-7},
                "print_time": False,
                "error_on_fail": False,
            },
        )

    def solve(self, case: Case, guess: Path, *, margin: float = 0.0) -> Path:
        """Improve a guess.

        Args:
            case: the situation.
            guess: where to begin.
            margin: held beyond d_min at the nodes [R].

        Returns:
            what IPOPT ends on, converged or not.
        """
        n = self.intervals
        goal = 2.0 * pi * round(guess.states[-1, 2] / (2.0 * pi))
        first = np.concatenate([guess.states.ravel(), guess.rates, [guess.time]])
        box = self._box.copy()
        low = -box
        low[-1], box[-1] = case.frame.t_release, np.inf
        found: dict[str, Any] = self._solver(
            x0=first,
            p=[
                *guess.states[0],
                case.frame.alpha,
                0.0,
                0.0,
                goal,
                *case.course.padded(self.turns),
                case.limit + margin,
            ],
            lbx=low,
            ubx=box,
            lbg=self._lower,
            ubg=self._upper,
        )
        flat = np.asarray(found["x"]).ravel()
        states, rates = np.split(flat[:-1], [3 * (n + 1)])
        return Path(states=states.reshape(n + 1, 3), rates=rates, time=float(flat[-1]))


def _step() -> ca.Function:
    """One interval at constant turn rate: an exact arc, seen from the slot."""
    state, rate, dt, alpha = ca.MX.sym("s", 3), ca.MX.sym("u"), ca.MX.sym("dt"), ca.MX.sym("a")
    half = 0.5 * rate * dt
    square = half * half
    # sin z / z as its series: right to 1e-9 for half turns of an interval below 1 rad
    chord = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72)))
    middle = state[2] + half
    end = ca.vertcat(
        state[0] + dt * (chord * ca.cos(middle) - alpha),
        state[1] + dt * chord * ca.sin(middle),
        state[2] + 2.0 * half,
    )
    return ca.Function("step", [state, rate, dt, alpha], [end])


def _leader(turns: int) -> ca.Function:
    """Where a leader is that keeps straight and turns in turn, seen from the slot."""
    t, course, alpha = ca.MX.sym("t"), ca.MX.sym("course", 3 + 3 * turns), ca.MX.sym("a")
    x, y, h, left = course[0], course[1], course[2], t
    for k in range(turns):
        before, rate, lasts = course[3 + 3 * k], course[4 + 3 * k], course[5 + 3 * k]
        straight = ca.fmin(left, before)
        turning = ca.fmin(left - straight, lasts)
        after = h + rate * turning
        x += alpha * (straight * ca.cos(h) + (ca.sin(after) - ca.sin(h)) / rate)
        y += alpha * (straight * ca.sin(h) - (ca.cos(after) - ca.cos(h)) / rate)
        h, left = after, left - straight - turning
    place = ca.vertcat(x + alpha * (left * ca.cos(h) - t), y + alpha * left * ca.sin(h))
    return ca.Function("leader", [t, course, alpha], [place])


def fly_path(case: Case, path: Path) -> Answer:
    """Fly the arcs again, in metres, and judge them as any trajectory is judged."""
    situation, radius = case.situation, case.frame.radius
    pursuer, length = situation.pursuer, path.time / len(path.rates)
    segments = tuple(
        Arc(
            turn=LEFT if rate > 0.0 else RIGHT,
            turn_angle=abs(rate) * length,
            radius=radius / abs(rate),
        )
        if abs(rate) > GENTLE
        else Straight(length=length * radius)
        for rate in path.rates.tolist()
    )
    trajectory = Trajectory(
        x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas, segments=segments
    )
    end = trajectory.pose_at(trajectory.duration)
    x, y = case.frame.to_slot(end.x, end.y)
    off = wrap_signed(end.heading - case.frame.heading)
    opened = path.time >= case.frame.t_release - EARLY
    return Answer(
        path=path,
        time=path.time * case.unit,
        arrives=opened
        and hypot(x - case.frame.alpha * path.time, y) < ARRIVED
        and abs(off) < ARRIVED,
        short=(situation.min_separation - certify(trajectory, situation).least_separation) / radius,
    )
