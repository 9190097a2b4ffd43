"""adjoint_history(…): H and the costates of the paper over time, from those of `costates`.

They solve (11), (12) and (13).
"""

from dataclasses import dataclass, fields
from math import atan2, ceil, cos, hypot, sin

import numpy as np

from relguide.kernels.base.costate import hamiltonian, polar_costate
from relguide.planning.costates import Costates, sliding_costate
from relguide.planning.legs import Cut
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.units import Second


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class AdjointHistory:
    """H and the adjoint variables along a trajectory: as many of each as there are times.

    An instant at which both aircraft are in one place is left out: (1)–(3) have no meaning there.
    """

    times: tuple[Second, ...]
    """Ascending [s]; every switch and contact twice, for before and after."""
    hamiltonian: tuple[float, ...]
    """H of eq. (9) [1]; linear in the turn rate, (15)."""
    separation: tuple[float, ...]
    """λ_d of (11) [s/m]; jumps at contacts."""
    bearing: tuple[float, ...]
    """λ_θ of (12) [s/rad]."""
    switching: tuple[float, ...]
    """λ_ψ of (13) [s/rad]: the switching function of eq. (16)."""

    def __repr__(self) -> str:
        return f"AdjointHistory({len(self.times)} times: {', '.join(f.name for f in fields(self))})"


def adjoint_history(
    found: Costates, whole: Cut, trajectory: Trajectory, situation: Situation, samples: int
) -> AdjointHistory:
    """Sample H, λ_d, λ_θ and λ_ψ.

    Args:
        found: the costates of the trajectory.
        whole: the trajectory in legs.
        trajectory: the same in the world frame.
        situation: gives the leader and R.
        samples: about how many times; each leg has two at least.
    """
    tas, radius = trajectory.tas, situation.pursuer.turn_radius
    leader, scale = situation.leader.trajectory, radius / tas
    last = trajectory.pose_at(trajectory.duration)
    rows: list[tuple[float, float, float, float, float]] = []
    for leg in whole.legs:
        count = max(2, ceil(samples * leg.duration / whole.end.time) + 1)
        for flown in np.linspace(0.0, leg.duration, count).tolist():
            t = (leg.start + flown) * scale
            x, y, heading = leg.at(flown)
            theirs = leader.pose_at(t)
            dx, dy = last.x + x * radius - theirs.x, last.y + y * radius - theirs.y
            if dx == dy == 0.0:  # there polar co-ordinates have no direction
                continue
            (lam_x, lam_y), sigma = found.position(leg.part), found.switching(leg.part, x, y)
            if leg.sliding:
                alpha = leader.tas / tas
                lam_x, lam_y = sliding_costate(
                    found.kappa(leg.part, whole.touches[leg.part]),
                    (sin(heading), cos(heading)),
                    (alpha * sin(theirs.heading), alpha * cos(theirs.heading)),
                )
                sigma = 0.0
            lam_d, lam_brg = polar_costate(lam_x / tas, lam_y / tas, dx, dy)
            h = hamiltonian(
                hypot(dx, dy), atan2(-dx, -dy), heading, lam_d, lam_brg, sigma * scale,
                leg.rate / scale, tas, leader.tas, theirs.heading,
            )  # fmt: skip
            rows.append((t, h, lam_d, lam_brg, sigma * scale))
    times, values, separation, bearing, switching = zip(*rows, strict=True) if rows else [()] * 5
    return AdjointHistory(
        times=times,
        hamiltonian=values,
        separation=separation,
        bearing=bearing,
        switching=switching,
    )
