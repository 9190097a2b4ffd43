"""The convergence area, exactly: how long the convergence takes from any place round the slot.

A leader that keeps straight, in calm air. Places are relative to the slot: x ahead of it along the
leader's heading, y to the left [m], headings counter-clockwise from the leader's [rad]. In this
frame the leader and the disc of d_min round it do not move: it is at (D, 0).
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.batch import Situations, Times, plan_arrays
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.units import Metre, MetrePerSecond, Radian, Second

Floats = NDArray[np.float64]
SAME = 1e-6
"""Ratios whose relative difference is less than this belong to one encounter: people round the
numbers they type."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Encounter:
    """Two aircraft, D and d_min, but not where the pursuer is: each has one convergence area."""

    pursuer_tas: MetrePerSecond
    """V_P [m/s]."""
    max_bank: Radian
    """φ_max [rad]."""
    leader_tas: MetrePerSecond
    """V_L [m/s]."""
    slot_distance: Metre
    """D [m]."""
    min_separation: Metre
    """d_min [m], 0 ≤ d_min ≤ D."""

    def __post_init__(self) -> None:
        """Refuse numbers that no situation may have."""
        self.situation(0.0, 0.0, 0.0)

    @property
    def turn_radius(self) -> Metre:
        """R [m]."""
        return self.situation(0.0, 0.0, 0.0).pursuer.turn_radius

    @property
    def speed_ratio(self) -> float:
        """V_L/V_P."""
        return self.leader_tas / self.pursuer_tas

    def situation(self, x: Metre, y: Metre, heading: Radian) -> Situation:
        """The situation with the pursuer at a place relative to the slot.

        The leader is at the origin of the world and flies east, so the slot frame's axes are those
        of the world.
        """
        return Situation(
            pursuer=Pursuer(
                x=x - self.slot_distance,
                y=y,
                heading=wrap(0.5 * pi - heading),
                tas=self.pursuer_tas,
                max_bank=self.max_bank,
            ),
            leader=Leader(x=0.0, y=0.0, heading=0.5 * pi, tas=self.leader_tas),
            slot_distance=self.slot_distance,
            min_separation=self.min_separation,
        )

    def place_of(self, situation: Situation) -> tuple[Metre, Metre, Radian]:
        """Where the pursuer of a situation is, relative to the slot: x, y, heading.

        Raises:
            ValueError: if the situation belongs to another encounter: only the ratios V_L/V_P, D/R
                and d_min/R count, as geometry scales.
        """
        if situation.wind.speed > 0.0:
            raise ValueError("A convergence area is for calm air; this situation has wind.")
        if situation.leader.intent:
            raise ValueError(
                "A convergence area is for a leader that keeps straight; this one has an intent."
            )
        frame = slot_frame(situation, situation.leader.trajectory)
        radius = self.turn_radius
        for name, here, there in (
            ("V_L/V_P", frame.alpha, self.speed_ratio),
            ("D/R", situation.slot_distance / frame.radius, self.slot_distance / radius),
            ("d_min/R", situation.min_separation / frame.radius, self.min_separation / radius),
        ):
            if abs(here - there) > SAME * there:
                raise ValueError(
                    f"This situation belongs to another convergence area: its {name} is "
                    f"{here:.4f}, here it is {there:.4f}."
                )
        return frame.x * radius, frame.y * radius, frame.h


def exact_times(
    encounter: Encounter,
    x: Floats,
    y: Floats,
    heading: Floats,
    *,
    threads: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> Times:
    """Plan from every place.

    Args:
        encounter: which aircraft joins which.
        x: places ahead of the slot [m]. shape (n,)
        y: and left of it [m]. shape (n,)
        heading: counter-clockwise from the leader's [rad]. shape (n,)
        threads: how many; all cores if left out.
        progress: called with the number of places done since the last call.
    """
    return plan_arrays(
        Situations(
            pursuer_x=x - encounter.slot_distance,
            pursuer_y=y,
            pursuer_heading=0.5 * pi - heading,
            pursuer_tas=encounter.pursuer_tas,
            max_bank=encounter.max_bank,
            leader_heading=0.5 * pi,
            leader_tas=encounter.leader_tas,
            slot_distance=encounter.slot_distance,
            min_separation=encounter.min_separation,
        ),
        threads=threads,
        progress=progress,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Area:
    """Time-to-converge on a grid round the slot, for one heading of the pursuer."""

    heading: Radian
    """Counter-clockwise from the leader's [rad]."""
    x: Floats
    """Edges of the cells along the leader's heading, from the slot [m]. shape (nx + 1,)"""
    y: Floats
    """Edges to the left of it [m]. shape (ny + 1,)"""
    time: Floats
    """T of each cell [s]; infinite where there is no plan within the horizon. shape (nx, ny)"""


def reach(encounter: Encounter, horizon: Second) -> tuple[Metre, Metre, Metre]:
    """The smallest region that contains every place from which the slot can be joined in time.

    In t seconds the pursuer joins from places at most V_P t away from where the slot will be.

    Returns:
        least x, greatest x, greatest |y| [m].
    """
    faster = encounter.leader_tas - encounter.pursuer_tas
    together = encounter.leader_tas + encounter.pursuer_tas
    return min(0.0, faster * horizon), together * horizon, encounter.pursuer_tas * horizon


def middles(area: Area) -> tuple[Floats, Floats]:
    """The middle of every cell of an area: x and y [m], of shape (nx · ny,)."""
    x, y = 0.5 * (area.x[1:] + area.x[:-1]), 0.5 * (area.y[1:] + area.y[:-1])
    grid_x, grid_y = np.meshgrid(x, y, indexing="ij")
    return grid_x.ravel(), grid_y.ravel()
