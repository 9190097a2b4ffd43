"""check(plan, situation): do Pontryagin's conditions, eqs. (9)–(16), hold along a trajectory?

The costates are found from the conditions (`costates`); what they leave unmet is reported, with H,
λ and the switching function over time. The conditions are necessary, and local: a trajectory
that fails them can be made faster by a small change; one that meets them may still be slower than
another word.
"""

from dataclasses import dataclass
from math import atan2, cos, hypot, sin
from typing import Literal

import numpy as np

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.costate import least_switching
from relguide.planning.adjoint import AdjointHistory, adjoint_history
from relguide.planning.costates import Costates, dot, find_costates, multiplier
from relguide.planning.inputs import expect, expect_within
from relguide.planning.legs import ROUNDING, CostateLeg, Cut, cut, is_partial, join_legs
from relguide.planning.outcome import Plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import HORIZON
from relguide.units import DEG, Radian, Second

FixedBy = Literal["free", "release", "at_once"]
"""What fixes t_f: the trajectory alone, the slot's release time, or being there from the start."""
ARRIVES = 1e-5
"""A trajectory reaches the slot if it ends this close to it [R; rad]: 12 cm for an airliner."""
MAX_ARRIVES = 10.0
"""Largest tolerance a caller may choose [R; rad]: a path that ends farther off does not arrive."""
AT_RELEASE = 1e-6
"""An arrival this close to the release time is at it [R/V_P]: 60 µs for an airliner."""
SLIVER = 2e-3
"""Pieces shorter than this may be left out of the conditions [R]: 0.1 s for an airliner."""
MET = 1e-3
"""Tolerance of the conditions, in R and R/V_P: the time that could still be gained goes with its
square, some tens of microseconds for an airliner."""
MAX_SAMPLES = 100_000
"""The most times at which H and λ are reported."""
TOGETHER = 0.05
"""Contacts closer together than this share their jumps [R/V_P]: some three seconds for an airliner.
A boundary arc is flown a millimetre outside, and a path may touch d_min just before it or after."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactPoint:
    """Where the trajectory touches d = d_min, or where a boundary arc along it begins or ends.

    With other traffic, also where the trajectory touches that one's minimum.
    """

    time: Second
    bearing: Radian
    """θ, from pursuer to leader, clockwise from north [rad], in [−π, π]."""
    jump: float
    """ν = λ_d after − λ_d before [s/m]; by (10) and (11) a minimum asks that ν ≥ 0. For contacts
    closer together than `TOGETHER` only the sum means much."""
    ident: str = ""
    """Of other traffic that is touched; empty for the leader."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlideReport:
    """A stretch flown along d = d_min at partial bank."""

    start: Second
    end: Second
    least_multiplier: float
    """Least μ on it [1/m]; eq. (10) asks that μ ≥ 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimalityReport:
    """What Pontryagin's conditions say of a trajectory.

    The certificate says whether it keeps d_min: where it comes closer, nothing is asked here. A
    path that touches a weather cell may be optimal and yet not meet these conditions.
    """

    arrival: FixedBy
    """`release`: H(t_f) ≥ 0 takes the place of H(t_f) = 0. Then λ = 0, H = 1 meets every condition
    on any path, and is what is reported: the conditions cannot distinguish paths.
    `at_once`: a trajectory of no length, of which nothing is asked."""
    holds: bool
    """All conditions are met: both residuals, eq. (16), ν ≥ 0 and μ ≥ 0, to `MET`."""
    hamiltonian_residual: float
    """Largest |H − H due| [1]; H due is 0, but for what the leader's turns to come add."""
    switching_residual: float
    """Largest |λ_ψ| at a switch or on a straight [s/rad]."""
    switching_ok: bool
    """Each arc turns at nominal bank to the side eq. (16) asks; λ_ψ vanishes where it should."""
    neglected: Second
    """Time in pieces too short to matter, left out [s]; 0 if the conditions hold on all."""
    contacts: tuple[ContactPoint, ...]
    boundary_arcs: tuple[SlideReport, ...]
    history: AdjointHistory


@dataclass(frozen=True, slots=True, kw_only=True)
class _Judgement:
    """The verdict, in R and R/V_P."""

    legs: tuple[CostateLeg, ...]
    costates: Costates
    hamiltonian_residual: float
    switching_ok: bool
    least_jump: float  # contacts that are `TOGETHER` as one
    multipliers: tuple[float, ...]  # least μ at each touch, 0 for contacts

    @property
    def holds(self) -> bool:
        return (
            self.hamiltonian_residual <= MET
            and self.switching_ok
            and self.least_jump >= -MET
            and min(self.multipliers, default=0.0) >= -MET
        )


def check(
    flown: Plan | Trajectory,
    situation: Situation,
    samples: int = 200,
    *,
    arrives: float = ARRIVES,
) -> OptimalityReport:
    """Check whether Pontryagin's conditions hold along a trajectory.

    Examples:
        >>> best = rg.plan(rg.scenario("fig_6b").situation)
        >>> rg.check(best, best.situation).holds
        True

    Args:
        flown: a plan, or any trajectory that reaches the slot.
        situation: what it was made for.
        samples: about how many times to report H and λ at; each piece has two at least.
        arrives: how far from the slot it may end [R; rad]. The conditions are then those of a slot
            moved and turned by as much.

    Raises:
        ValueError: if the trajectory does not reach the slot, or only after 12 hours.
    """
    expect("flown", flown, Plan, Trajectory)
    expect("situation", situation, Situation)
    expect_within("samples", samples, 1, MAX_SAMPLES, "")
    expect_within("arrives", arrives, 0.0, MAX_ARRIVES, "R")
    trajectory = flown.trajectory if isinstance(flown, Plan) else flown
    if trajectory.duration > HORIZON:
        raise ValueError(
            f"The trajectory takes {trajectory.duration / 3600.0:.3g} h; conditions are asked of "
            f"{HORIZON / 3600.0:.0f} h at most."
        )
    arrival = _arrival(trajectory, situation, arrives)
    whole = cut(trajectory, situation)
    judgement = _judge(arrival, whole, whole.legs)
    longer = tuple(leg for leg in whole.legs if leg.duration > SLIVER or leg.sliding)
    if not judgement.holds and 0 < len(longer) < len(whole.legs):
        # a search that ends on an edge leaves pieces of hardly any length, which should not be
        without = _judge(arrival, whole, join_legs(longer))
        judgement = without if without.holds else judgement
    scale = situation.pursuer.turn_radius / trajectory.tas
    found, touches = judgement.costates, whole.touches
    return OptimalityReport(
        arrival=arrival,
        holds=judgement.holds,
        hamiltonian_residual=judgement.hamiltonian_residual,
        switching_residual=found.residual * scale,
        switching_ok=judgement.switching_ok,
        neglected=(whole.end.time - sum(leg.duration for leg in judgement.legs)) * scale,
        contacts=tuple(
            ContactPoint(
                time=at.time * scale,
                bearing=atan2(*at.toward),
                jump=jump / trajectory.tas,
                ident=at.ident,
            )
            for touch, jumps in zip(touches, found.jumps.tolist(), strict=True)
            for at, jump in zip(touch.ends, jumps[: len(touch.ends)], strict=True)
        ),
        boundary_arcs=tuple(
            SlideReport(
                start=touch.entry.time * scale,
                end=touch.exit.time * scale,
                least_multiplier=least / situation.pursuer.turn_radius,
            )
            for touch, least in zip(touches, judgement.multipliers, strict=True)
            if touch.slides
        ),
        history=adjoint_history(found, whole, trajectory, situation, samples),
    )


def _arrival(trajectory: Trajectory, situation: Situation, arrives: float) -> FixedBy:
    frame = slot_frame(situation, situation.leader.trajectory)
    end = trajectory.pose_at(trajectory.duration)
    x, y = frame.to_slot(end.x, end.y)
    gap = hypot(x - situation.leader.tas * trajectory.duration / frame.radius, y)
    off = abs(wrap_signed(end.heading - frame.heading))
    early = frame.t_release - trajectory.duration * situation.pursuer.tas / frame.radius
    if gap > arrives or off > arrives:
        raise ValueError(
            f"The trajectory ends {gap * frame.radius:.1f} m from the slot and {off / DEG:.3f}° "
            "off the leader's heading; conditions are asked only of one that reaches the slot."
        )
    if early > AT_RELEASE:
        raise ValueError(
            f"The trajectory ends {early * frame.radius / situation.pursuer.tas:.1f} s before the "
            "slot opens; conditions are asked only of one that reaches the open slot."
        )
    if frame.t_release > 0.0 and early >= -AT_RELEASE:
        return "release"
    return "free" if trajectory.length > ROUNDING * frame.radius else "at_once"


def _judge(arrival: FixedBy, whole: Cut, legs: tuple[CostateLeg, ...]) -> _Judgement:
    n = len(whole.touches)
    if arrival != "free":
        rest = Costates(parts=np.zeros((n + 1, 3)), jumps=np.zeros((n, 2)), residual=0.0)
        return _Judgement(
            legs=legs, costates=rest, hamiltonian_residual=0.0, switching_ok=True,
            least_jump=0.0, multipliers=(0.0,) * n,
        )  # fmt: skip
    found = find_costates(whole, legs)
    # what the leader's turns still add: H due(t) = level − λ_p·v_L(t), continuous at touches
    levels = [dot(found.position(n), whole.end.leader_velocity)]
    for i, touch in reversed(tuple(enumerate(whole.touches))):
        due = levels[0] - dot(found.position(i + 1), touch.exit.leader_velocity)
        levels.insert(0, due + dot(found.position(i), touch.entry.leader_velocity))
    residual, signs_ok = 0.0, True
    for leg in legs:
        if leg.sliding:
            signs_ok &= abs(leg.rate) <= 1.0 + MET
            continue
        (lam_x, lam_y), sigma = found.position(leg.part), found.switching(leg.part, leg.x, leg.y)
        hamiltonian = 1.0 + lam_x * sin(leg.heading) + lam_y * cos(leg.heading) + sigma * leg.rate
        residual = max(residual, abs(hamiltonian - levels[leg.part]))
        if leg.rate != 0.0:
            least = least_switching(leg.heading, leg.rate, leg.duration, 1.0, lam_x, lam_y, sigma)
            signs_ok &= least >= -MET and not is_partial(leg.rate)
    return _Judgement(
        legs=legs,
        costates=found,
        hamiltonian_residual=residual,
        switching_ok=signs_ok and found.residual <= MET,
        least_jump=_least_jump(whole, found),
        multipliers=tuple(
            min(multiplier(found.kappa(i, touch), at) for at in touch.nodes)
            if touch.slides
            else 0.0
            for i, touch in enumerate(whole.touches)
        ),
    )


def _least_jump(whole: Cut, found: Costates) -> float:
    least, total, last = 0.0, 0.0, -1.0
    for touch, jumps in zip(whole.touches, found.jumps.tolist(), strict=True):
        for at, jump in zip(touch.ends, jumps, strict=False):
            if at.time - last > TOGETHER:
                least, total = min(least, total), 0.0
            total, last = total + jump, at.time
    return min(least, total)
