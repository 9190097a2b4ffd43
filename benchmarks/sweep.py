"""The arrival through one contact with d = d_min, as a function of where on the circle it is.

What the search with the limit minimises, written out plainly for a picture: every bearing, both
ways round, every pair of words, judged by the certificate.
"""

from dataclasses import dataclass
from math import cos, hypot, inf, nan, pi, radians, sin

import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import Case
from relguide import Plan, Situation, Trajectory, candidates, certify, plan
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve, solve_toward
from relguide.planning.candidate import assemble
from relguide.planning.certificate import SLACK

GRAZE = 0.3 * SLACK
"""The contact lies this far outside d_min, so that rounding cannot break it [R]."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """One case, a straight leader, calm."""

    case: Case
    bearings: Floats
    """Of the contact as seen from the leader, clockwise from its nose [°], −180 … 180."""
    arrivals: dict[float, Floats]
    """By the way round (+1 counter-clockwise seen from above): arrival [s], NaN without one."""
    chosen: Plan
    unlimited: Trajectory
    """The fastest way without the limit."""
    contact: float
    """Bearing of the plan's contact [°]."""


def sweep(case: Case, *, count: int) -> Sweep:
    """Arrivals at so many bearings."""
    chosen = plan(case.situation)
    assert isinstance(chosen, Plan)
    bearings = np.linspace(-180.0, 180.0, count)
    return Sweep(
        case=case,
        bearings=bearings,
        arrivals={
            side: np.array([_arrival(case, -radians(bearing), side) for bearing in bearings])
            for side in (1.0, -1.0)
        },
        chosen=chosen,
        unlimited=next(candidates(case.situation).later).trajectory,
        contact=bearing_at(case.situation, chosen.trajectory, chosen.certificate.at_time),
    )


def _arrival(case: Case, bearing: float, side: float) -> float:
    """The first arrival through a contact that certifies [s]; NaN without one."""
    alpha, delta = case.frame.alpha, case.limit + GRAZE
    course = contact_heading(bearing, side, alpha)
    c, s = cos(course), sin(course)
    dx = case.frame.x - case.ahead - delta * cos(bearing)
    dy = case.frame.y - delta * sin(bearing)
    there, onward = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    seen = Pose(dx * c + dy * s, dy * c - dx * s, (case.frame.h - course) % (2.0 * pi))
    n = solve_toward(seen, Velocity(alpha * c, -alpha * s), 0.0, there)
    best = inf
    for first in there[:n]:
        if first[0] >= best or not _holds(case, first):
            continue
        x, y, h = case.frame.x, case.frame.y, case.frame.h
        for sign, amount in zip(SIGNS[int(first[1])], first[2:], strict=True):
            x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        m = solve(Pose(x - alpha * first[0], y, h % (2.0 * pi)), alpha, 0.0, onward)
        for second in onward[:m]:
            time = first[0] + second[0]
            if time >= best:
                break
            if _holds(case, first, second):
                best = time
    return float(best) * case.unit if best < inf else nan


def _holds(case: Case, *rows: Floats) -> bool:
    signs = [float(sign) for row in rows for sign in SIGNS[int(row[1])]]
    amounts = [float(amount) for row in rows for amount in row[2:]]
    way = assemble(case.situation, case.frame, signs, amounts, "")
    return certify(way.trajectory, case.situation).holds


def from_leader(situation: Situation, trajectory: Trajectory, t: float) -> tuple[float, float]:
    """The pursuer as seen from the leader: to its right, and ahead of it [m]."""
    ours, theirs = trajectory.pose_at(t), situation.leader.trajectory.pose_at(t)
    dx, dy, psi = ours.x - theirs.x, ours.y - theirs.y, theirs.heading
    return dx * cos(psi) - dy * sin(psi), dx * sin(psi) + dy * cos(psi)


def bearing_at(situation: Situation, trajectory: Trajectory, t: float) -> float:
    """Of the pursuer as seen from the leader, clockwise from its nose [°], −180 … 180."""
    right, ahead = from_leader(situation, trajectory, t)
    return float(np.degrees(np.arctan2(right / hypot(right, ahead), ahead / hypot(right, ahead))))
