"""Direct transcription with IPOPT: what one would try first where the separation limit binds.

Multiple shooting of the pursuer's three states in the leader's frame, turn rate constant over each
interval (so an interval is exactly an arc), final time free, separation held at the nodes and half
way between them; three starts: straight there, round the leader's left, round its right.

Slot frame seen from the slot: it stands still at the origin, the leader ahead of it at (D, 0).
Lengths in R, times in R/V_P, angles counter-clockwise.
"""

from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from relguide import LEFT, RIGHT, Arc, Straight, Trajectory, certify
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve, solve_toward
from tests.bench.cases import Case

INTERVALS = 80
"""Arcs of a path: a turn of 30 s is some ten of them for an airliner 100 km out."""
ABEAM = 1.2
"""How far out a start passes the leader [d_min]."""
ITERATIONS = 400
"""IPOPT gives up after this many."""
ARRIVED = 1e-3
"""A path that ends this far from the slot, flown again, has not converged [R]: 10 m or so."""
GENTLE = 1e-9
"""Turn rates below this are straights [V_P/R]."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """What IPOPT begins with, and what it ends on."""

    states: Floats
    """x, y, heading (unwrapped) at the nodes. shape (intervals + 1, 3)"""
    rates: Floats
    """Turn rate of each interval. shape (intervals,)"""
    time: float
    """Arrival."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """A path, flown again arc by arc."""

    path: Path
    time: float
    """Arrival [s]."""
    arrives: bool
    """Whether it ends in the slot, on the leader's heading."""
    short: float
    """How far it cuts into d_min, as between two nodes [R]; negative if it keeps clear."""


class Transcription:
    """The nonlinear programme, built once: situations are its parameters."""

    def __init__(self, intervals: int = INTERVALS) -> None:
        """Build it for so many intervals."""
        self.intervals = n = intervals
        states, rates, time = ca.MX.sym("s", 3, n + 1), ca.MX.sym("u", n), ca.MX.sym("T")
        start, alpha, goal = ca.MX.sym("start", 3), ca.MX.sym("alpha"), ca.MX.sym("goal", 3)
        leader, limit = ca.MX.sym("D"), ca.MX.sym("d")
        step = _step()
        whole = step.map(n)(states[:, :-1], rates.T, time / n, alpha)
        half = step.map(n)(states[:, :-1], rates.T, 0.5 * time / n, alpha)
        seen = ca.horzcat(states[:2, 1:], half[:2, :])
        clear = (seen[0, :] - leader) ** 2 + seen[1, :] ** 2 - limit**2
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
        low[-1], box[-1] = 0.0, np.inf
        found: dict[str, Any] = self._solver(
            x0=first,
            p=[*guess.states[0], case.frame.alpha, 0.0, 0.0, goal, case.ahead, case.limit + margin],
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


def guesses(case: Case, intervals: int = INTERVALS) -> list[Path]:
    """The best way without the limit, and the best ways past a point on the leader's either side.

    All three can be flown and end in the slot, which is the best one can do for IPOPT: from
    polylines it ends on points of local infeasibility more often than on a path.
    """
    ways = [_pieces(_onward(case, 0.0, *_start(case)))]
    ways += [_past_leader(case, side) for side in (1.0, -1.0)]
    return [_sample(case, way, intervals) for way in ways]


def _start(case: Case) -> tuple[float, float, float]:
    return case.frame.x, case.frame.y, case.frame.h


def _onward(case: Case, t: float, x: float, y: float, h: float) -> Floats:
    """The best word to the slot from time t on, as a row of `solve`."""
    rows: Floats = np.empty((MAX_ROWS, 5))
    solve(Pose(x - case.frame.alpha * t, y, h % (2.0 * pi)), case.frame.alpha, 0.0, rows)
    best: Floats = rows[0]
    return best


def _past_leader(case: Case, side: float) -> list[tuple[float, float]]:
    """To a point abeam of the leader, falling back along the circle there, and on to the slot."""
    alpha, (x, y, h) = case.frame.alpha, _start(case)
    course = contact_heading(side * 0.5 * pi, side, alpha)
    c, s = cos(course), sin(course)
    dx, dy = x - case.ahead, y - side * ABEAM * case.limit
    seen = Pose(dx * c + dy * s, dy * c - dx * s, (h - course) % (2.0 * pi))
    rows = np.empty((MAX_ROWS, 5))
    # always found: the leader is slower
    solve_toward(seen, Velocity(alpha * c, -alpha * s), 0.0, rows)
    first = _pieces(rows[0])
    t = 0.0
    for sign, amount in first:
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        t += amount
    return first + _pieces(_onward(case, t, x, y, h))


def _pieces(row: Floats) -> list[tuple[float, float]]:
    signs = SIGNS[int(row[1])].tolist()
    return list(zip(signs, row[2:].tolist(), strict=True))


def _sample(case: Case, pieces: list[tuple[float, float]], intervals: int) -> Path:
    """States at equally spaced times, seen from the slot, headings unwrapped."""
    ends = np.cumsum([amount for _, amount in pieces])
    at = np.linspace(0.0, ends[-1], intervals + 1)
    states = np.empty((intervals + 1, 3))
    rates = np.empty(intervals)
    for k, t in enumerate(at):
        x, y, h = _start(case)
        left = t
        for sign, amount in pieces:
            x, y, h = fly_piece(Pose(x, y, h), sign, min(left, amount))
            left -= min(left, amount)
        states[k] = x - case.frame.alpha * t, y, h
    rates[:] = np.diff(states[:, 2]) / np.diff(at)
    return Path(states=states, rates=rates, time=float(ends[-1]))


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
    return Answer(
        path=path,
        time=path.time * case.unit,
        arrives=hypot(x - case.frame.alpha * path.time, y) < ARRIVED and abs(off) < ARRIVED,
        short=(situation.min_separation - certify(trajectory, situation).least_separation) / radius,
    )
