"""find_costates(cut): the adjoint variables of a trajectory, from the conditions themselves.

Between two touches of d = d_min a part has three constants (see `kernels.costate`): λ_x, λ_y, and
λ_ψ at one place. They obey linear equations. Some are met exactly:

    H(t_f) = 0;    H is continuous where d_min is touched;    at a contact so is λ_ψ.

Eq. (14) says no more of the end than that λ(t_f) is constant; H(t_f) = 0 is what it lacks.

The others are met in least squares: λ_ψ = 0 at each switch, on each straight and at both ends of a
boundary arc. An extremal without the limit has as many equations as unknowns; a constrained path
may have one more for each contact, which is met only if the contact is in the best place. A piece
of no length leaves fewer equations than unknowns; then eq. (16) and ν ≥ 0 choose.

Sliding, λ_ψ ≡ 0 and λ_p is along the course: λ_p = κ û / (1 − û·v̂_L), κ = λ_p · (û − v̂_L) being
what H keeps while the leader flies straight. All in R and R/V_P, as in `legs`.
"""

from dataclasses import dataclass

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.planning.legs import ROUNDING, CostateLeg, Cut, Instant, Touch, Vector
from relguide.planning.linear_program import highest_corner

RANK = 1e-8
"""Equations with a singular value below this are left out."""
PROBES = 16
"""Points of an arc at which eq. (16) is checked where it has to choose."""
FARTHEST = 1e3
"""Largest multiplier that such a choice may make."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Costates:
    """What solves the equations."""

    parts: FloatArray
    """λ_x, λ_y, and λ_ψ as it would be where the trajectory ends. shape (parts, 3)"""
    jumps: FloatArray
    """ν: by how much λ_d rises at entry and at exit; a contact's is all in the first. (·, 2)"""
    residual: float
    """Largest |λ_ψ| where it should vanish."""

    def kappa(self, i: int, boundary_arc: Touch) -> float:
        """κ of a boundary arc, touch number i: λ_p · (û − v̂_L) where it begins."""
        return dot(self.position(i), boundary_arc.entry.passing)

    def position(self, part: int) -> Vector:
        """λ_x and λ_y of a part."""
        return float(self.parts[part, 0]), float(self.parts[part, 1])

    def switching(self, part: int, x: float, y: float) -> float:
        """λ_ψ at a place of a part."""
        return float(_switching(x, y) @ self.parts[part])


def sliding_costate(kappa: float, course: Vector, leader_velocity: Vector) -> Vector:
    """λ_p on a boundary arc."""
    k = kappa / (1.0 - dot(course, leader_velocity))
    return k * course[0], k * course[1]


def multiplier(kappa: float, at: Instant) -> float:
    """μ of eq. (10) on a boundary arc: what it takes for λ_p to stay along the course, −λ_p′·e.

    d″ = 0 asks for û′ = r n̂, n̂ to the right of the course, with r n̂·e = |û − v̂_L|²/d; and from
    λ_p = κ û/(1 − û·v̂_L) follows λ_p′·e.
    """
    right = (at.course[1], -at.course[0])
    rate = dot(at.passing, at.passing) / (at.separation * dot(right, at.toward))
    gain = 1.0 - dot(at.course, at.leader_velocity)
    drawn = dot(right, at.leader_velocity) * dot(at.course, at.toward) / gain
    return -kappa / gain * rate * (dot(right, at.toward) + drawn)


def find_costates(whole: Cut, legs: tuple[CostateLeg, ...]) -> Costates:
    """Solve for the costates of a trajectory with free t_f.

    Args:
        whole: the trajectory.
        legs: those of its legs on which conditions are checked, one after another; at least one.
    """
    n = 3 * (len(whole.touches) + 1)
    exact = _exact_rows(whole, legs, n)
    due = np.zeros(len(exact))
    due[0] = -1.0  # H(t_f) = 0; the rows are homogeneous but for the 1 of the time itself
    vanishing = _vanishing_rows(whole, legs, n)
    z, free = _solve(exact, due, np.zeros(n), np.eye(n))
    z, free = _solve(vanishing, np.zeros(len(vanishing)), z, free)
    rises = _jump_rows(whole.touches, n)
    if free.shape[1] > 0:
        between, ends = _sign_rows(legs, n)
        z = _choose(z, free, between, np.vstack((ends, rises)))
    return Costates(
        parts=z.reshape(-1, 3),
        jumps=(rises @ z).reshape(-1, 2),
        residual=float(np.abs(vanishing @ z).max(initial=0.0)),
    )


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1]


def _switching(x: float, y: float) -> FloatArray:
    """λ_ψ = λ_ψ(end) − λ_p × p, the end being the origin."""
    return np.array((-y, x, 1.0))


def _wide_row(part: int, row: FloatArray, n: int) -> FloatArray:
    wide = np.zeros(n)
    wide[3 * part : 3 * part + 3] = row
    return wide


def _place(legs: tuple[CostateLeg, ...], t: float) -> Vector:
    """Where the pursuer is at a joint."""
    for leg in legs:
        if leg.start + leg.duration > t + ROUNDING:
            return leg.x, leg.y
    return 0.0, 0.0


def _exact_rows(whole: Cut, legs: tuple[CostateLeg, ...], n: int) -> FloatArray:
    parts, end = len(whole.touches), whole.end
    rows = [_wide_row(parts, np.array((*end.passing, legs[-1].rate)), n)]
    for i, touch in enumerate(whole.touches):
        before = np.array((*touch.entry.passing, 0.0))
        after = np.array((*touch.exit.passing, 0.0))
        rows.append(_wide_row(i, before, n) - _wide_row(i + 1, after, n))
        if not touch.slides:
            unbroken = _switching(*_place(legs, touch.entry.time))
            rows.append(_wide_row(i, unbroken, n) - _wide_row(i + 1, unbroken, n))
    return np.array(rows)


def _vanishing_rows(whole: Cut, legs: tuple[CostateLeg, ...], n: int) -> FloatArray:
    rows = []
    last: CostateLeg | None = None
    for leg in legs:
        if leg.rate == 0.0:
            rows += [
                _wide_row(leg.part, _switching(*leg.at(t)[:2]), n) for t in (0.0, leg.duration)
            ]
        elif last is not None and _switches(last, leg):
            rows.append(_wide_row(leg.part, _switching(leg.x, leg.y), n))
        last = leg
    for i, touch in enumerate(whole.touches):
        if touch.slides:
            rows.append(_wide_row(i, _switching(*_place(legs, touch.entry.time)), n))
            rows.append(_wide_row(i + 1, _switching(*_place(legs, touch.exit.time)), n))
    return np.array(rows).reshape(-1, n)


def _switches(before: CostateLeg, after: CostateLeg) -> bool:
    """Whether one arc follows another at another rate, neither of them part of a boundary arc."""
    if before.sliding or after.sliding or before.rate == 0.0:
        return False
    return abs(before.rate - after.rate) > ROUNDING


def _jump_rows(touches: tuple[Touch, ...], n: int) -> FloatArray:
    """λ_p before = λ_p after + ν e, with e the unit vector from pursuer to leader."""
    rows = np.zeros((2 * len(touches), n))
    for i, touch in enumerate(touches):
        before = _wide_row(i, np.array((*touch.entry.toward, 0.0)), n)
        after = _wide_row(i + 1, np.array((*touch.exit.toward, 0.0)), n)
        if not touch.slides:
            rows[2 * i] = before - after
            continue
        for row, at, part, whole_row, sign in (
            (2 * i, touch.entry, i, before, 1.0),
            (2 * i + 1, touch.exit, i + 1, after, -1.0),
        ):
            share = dot(sliding_costate(1.0, at.course, at.leader_velocity), at.toward)
            kappa = _wide_row(part, np.array((*at.passing, 0.0)), n)
            rows[row] = sign * (whole_row - share * kappa)
    return rows


def _sign_rows(legs: tuple[CostateLeg, ...], n: int) -> tuple[FloatArray, FloatArray]:
    """−sign r · λ_ψ at points within each arc, and at its ends: eq. (16) asks that it be ≥ 0."""
    between: list[FloatArray] = []
    ends: list[FloatArray] = []
    for leg in legs:
        if leg.rate != 0.0 and not leg.sliding:
            for k in range(PROBES + 1):
                x, y, _ = leg.at(leg.duration * k / PROBES)
                row = _wide_row(leg.part, -np.sign(leg.rate) * _switching(x, y), n)
                (between if 0 < k < PROBES else ends).append(row)
    return np.array(between).reshape(-1, n), np.array(ends).reshape(-1, n)


def _solve(
    rows: FloatArray, due: FloatArray, z: FloatArray, free: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Move z within `free` so that rows·z = due, in least squares; and return what stays free."""
    u, s, vt = np.linalg.svd(rows @ free)
    rank = int((s > RANK).sum())
    step = vt[:rank].T @ (u[:, :rank].T @ (due - rows @ z) / s[:rank])
    return z + free @ step, free @ vt[rank:].T


def _choose(
    z: FloatArray, free: FloatArray, largest: FloatArray, positive: FloatArray
) -> FloatArray:
    """Move z within the span of `free` to maximise the least of largest·z, with positive·z ≥ 0.

    If there is no such place z stays as it is: the conditions cannot be met.
    """
    m = free.shape[1]
    wanted = np.vstack((largest, positive))
    # maximise s ≤ 1 with largest·(z + free·y) ≥ s, each of y within ±FARTHEST
    margin = np.concatenate((np.ones(len(largest)), np.zeros(len(positive))))
    bounds = np.vstack((np.eye(m + 1), -np.eye(m, m + 1)))
    farthest = np.concatenate((np.full(m, FARTHEST), [1.0], np.full(m, FARTHEST)))
    best = highest_corner(
        np.vstack((bounds, np.column_stack((-wanted @ free, margin)))),
        np.concatenate((farthest, wanted @ z)),
        np.arange(m + 1),
    )
    return z if best is None else z + free @ best[:m]
