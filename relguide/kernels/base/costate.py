"""Costates along a trajectory: eqs. (9)–(16), in closed form between contacts with d = d_min.

In Cartesian co-ordinates of the air mass nothing depends on where the pursuer is, so its position
costate λ_p = (λ_x, λ_y) [s/m] is constant while d > d_min, and λ_ψ′ = −(λ_x y′ − λ_y x′) gives

    λ_ψ = λ_ψ(t₀) − λ_p × (p − p₀)          with a × b = a_x b_y − a_y b_x:

λ_ψ vanishes on a line parallel to λ_p; all switches and straights of one free part lie on it. In
the paper's polar form, with e the unit vector P→L and θ its bearing clockwise from north,

    λ_d = −λ_p · (sin θ, cos θ),     λ_θ = −d λ_p · (cos θ, −sin θ),

which solves (11)–(13) with μ = 0. At a contact μ is an impulse ν ≥ 0: by (11) λ_d rises by ν, while
λ_θ, λ_ψ and H go on unbroken; λ_p changes by −ν e.
"""

from math import atan2, cos, inf, pi, sin

from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import Motion, advance
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray


@njit(cache=True, nogil=True)
def polar_costate(lam_x: float, lam_y: float, dx: float, dy: float) -> tuple[float, float]:
    """λ_d [s/m] and λ_θ [s/rad] of a position costate.

    Args:
        lam_x: λ_x, east [s/m].
        lam_y: λ_y, north [s/m].
        dx: pursuer minus leader, east [m].
        dy: the same, north [m]; not both zero.
    """
    d = norm(dx, dy)
    return (lam_x * dx + lam_y * dy) / d, lam_x * dy - lam_y * dx


@njit(cache=True, nogil=True)
def hamiltonian(
    d: float, brg: float, psi: float, lam_d: float, lam_brg: float, lam_psi: float, r: float,
    v_p: float, v_l: float, psi_l: float,
) -> float:  # fmt: skip
    """H of eq. (9); its last term vanishes, by (10).

    Args:
        d: separation [m], > 0.
        brg: θ, from pursuer to leader, clockwise from north [rad].
        psi: ψ_P [rad].
        lam_d: λ_d [s/m].
        lam_brg: λ_θ [s/rad].
        lam_psi: λ_ψ [s/rad].
        r: turn rate [rad/s], positive to the right.
        v_p: V_P [m/s].
        v_l: V_L [m/s].
        psi_l: ψ_L [rad].
    """
    d_rate = v_l * cos(brg - psi_l) - v_p * cos(brg - psi)  # eq. (1)
    brg_rate = (v_p * sin(brg - psi) - v_l * sin(brg - psi_l)) / d  # eq. (2)
    return 1.0 + lam_d * d_rate + lam_brg * brg_rate + lam_psi * r


@njit(cache=True, nogil=True)
def least_switching(
    psi: float, r: float, duration: float, v_p: float, lam_x: float, lam_y: float, lam_psi: float
) -> float:
    """Least λ_ψ · (−sign r) on an arc: eq. (16) asks that it be ≥ 0.

    λ_ψ is extreme where the heading is along or against λ_p, and at the ends: exact, not sampled.

    Args:
        psi: heading at its start [rad].
        r: its turn rate [rad/s], positive to the right, not 0.
        duration: [s].
        v_p: V_P [m/s].
        lam_x: λ_x [s/m].
        lam_y: λ_y [s/m].
        lam_psi: λ_ψ at its start [s/rad].

    Returns:
        [s/rad]; negative if the arc turns the wrong way somewhere.
    """
    wanted = -1.0 if r > 0.0 else 1.0
    along = atan2(lam_x, lam_y)
    least = inf
    for k in range(4):
        if k < 2:
            t = wrap((along + pi * k - psi) * -wanted) / abs(r)
        else:
            t = duration * (k - 2)
        if t <= duration:
            x, y, _ = advance(0.0, 0.0, psi, v_p, r, t)
            least = min(least, wanted * (lam_psi - (lam_x * y - lam_y * x)))
    return least


@njit(cache=True, nogil=True)
def contacts(
    pursuer: Motion, leader: Motion, horizon: float, low: float, high: float, stride: float,
    out: FloatArray,
) -> int:  # fmt: skip
    """When the separation passes a local minimum between two values.

    Above `high` steps are as long as the speeds allow without missing anything; at and below it
    they are `stride`: minima closer together than that count as one.

    Args:
        pursuer: how the pursuer moves.
        leader: and the leader.
        horizon: until when [s].
        low: least separation that counts [m].
        high: largest that does [m].
        stride: least step [s].
        out: takes the times; no more than fit are found. shape (any,)

    Returns:
        how many.
    """
    n = 0
    t, earlier = 0.0, 0.0
    d, last = _closing(pursuer, leader, t)
    while t < horizon and n < len(out):
        earlier = t
        t = min(t + max(stride, (d - high) / (pursuer.tas + leader.tas)), horizon)
        d, rate = _closing(pursuer, leader, t)
        if last < 0.0 <= rate:
            left, right = earlier, t
            for _ in range(60):
                middle = 0.5 * (left + right)
                reached, slope = _closing(pursuer, leader, middle)
                if slope < 0.0:
                    left = middle
                else:
                    right = middle
            if low <= reached <= high:
                out[n] = right
                n += 1
        last = rate
    return n


@njit(cache=True, nogil=True)
def _closing(pursuer: Motion, leader: Motion, t: float) -> tuple[float, float]:
    """Separation [m] and its rate of change [m/s] at time t; the separation is not 0."""
    px, py, ppsi = _fly(pursuer, t)
    lx, ly, lpsi = _fly(leader, t)
    dx, dy = px - lx, py - ly
    dvx = pursuer.tas * sin(ppsi) - leader.tas * sin(lpsi)
    dvy = pursuer.tas * cos(ppsi) - leader.tas * cos(lpsi)
    d = norm(dx, dy)
    return d, (dx * dvx + dy * dvy) / max(d, 1e-9)  # 1e-9 m: where they meet it has no rate


@njit(cache=True, nogil=True)
def _fly(motion: Motion, t: float) -> tuple[float, float, float]:
    x, y, psi, tas, pieces = motion
    for i in range(len(pieces)):
        x, y, psi = advance(x, y, psi, tas, pieces[i, 1], min(t, pieces[i, 0]))
        t -= pieces[i, 0]
        if t <= 0.0:
            return x, y, psi
    return advance(x, y, psi, tas, 0.0, t)
