"""The tree of regular trajectories that all end in the slot, as data and as a file.

Every node is a state of the pursuer relative to the slot, and the pair (ε, θ, l) flown first from
there; its parent is the state at the end of that pair, the root the slot itself. Each cell of
(x, y, heading) knows its node of least time. That is *a* path of order n or less and the best
one *found* from anywhere in the cell: not the minimum time. Nodes hold their exact state, so what
is said of a node holds for that state and not for the middle of its cell.

The tree is kept on one side, y ≥ 0; a node may hold the mirror image of what its parent continues.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, isfinite, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from relguide.maps.area import Area, Encounter, reach
from relguide.planning.regular import RegularTrajectory, Triplet
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG, Metre, Radian, Second

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
MAX_ORDER = 6
"""Highest order n grown: five pairs."""
LEAST_HORIZON, MAX_HORIZON = 1.0, 3600.0
"""Accepted horizons [s]."""
MAX_MEMORY = 8e9
"""A tree that might take more is refused [bytes]."""
CELL_BYTES = 8 + 4 + 4 + 16
"""Of a cell while growing: time, node, parent, pair."""
NODE_BYTES = 24 + 4 + 4 + 16
"""Of a node while growing: state, heading, parent, pair."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TreeParameters:
    """What a tree is grown from."""

    encounter: Encounter
    """Both speeds, the bank, D and d_min."""
    order: int
    """n: up to n − 1 pairs."""
    delta_theta: Radian
    """Δθ [rad], a whole part of a full turn; also the width of a cell in heading."""
    delta_l: Metre
    """Δl [m]."""
    cell: Metre
    """Edge of a cell in x and y [m]."""
    horizon: Second = 600.0
    """Longest time-to-converge [s]; the paper's 10 minutes."""

    def __post_init__(self) -> None:
        """Refuse what cannot be grown."""
        if not 2 <= self.order <= MAX_ORDER:
            raise ValueError(f"order must be 2 … {MAX_ORDER}, not {self.order}.")
        for name, value in (("delta_l", self.delta_l), ("cell", self.cell)):
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{name} must be a length above 0 m, not {value:g} m.")
        if not LEAST_HORIZON <= self.horizon <= MAX_HORIZON:
            raise ValueError(
                f"horizon must lie in {LEAST_HORIZON:g} … {MAX_HORIZON:g} s, "
                f"not {self.horizon:g} s."
            )
        degrees = self.delta_theta / DEG
        if not (isfinite(degrees) and 1.0 - 1e-9 <= degrees <= 90.0 + 1e-9):
            raise ValueError(f"delta_theta must lie in 1 … 90°, not {degrees:g}°.")
        if abs(2.0 * pi / self.delta_theta - self.headings) > 1e-6:
            raise ValueError(
                f"delta_theta must go into 360° a whole number of times; {degrees:g}° does not."
            )
        if self.memory_bound > MAX_MEMORY:
            raise ValueError(
                f"This tree has {self.headings} × {self.cells_x} × {self.cells_y} cells and might "
                f"take {self.memory_bound / 1e9:.0f} GB; at most {MAX_MEMORY / 1e9:.0f} GB are "
                "taken. Larger cells or a larger delta_theta help."
            )

    @property
    def headings(self) -> int:
        """N: how many headings there are."""
        return round(2.0 * pi / self.delta_theta)

    @property
    def x_low(self) -> Metre:
        """Where the first cell begins, ahead of the slot [m]."""
        return self.cell * (reach(self.encounter, self.horizon)[0] // self.cell)

    @property
    def cells_x(self) -> int:
        """Cells along the leader's heading."""
        return ceil((reach(self.encounter, self.horizon)[1] - self.x_low) / self.cell)

    @property
    def cells_y(self) -> int:
        """Cells to the left of the leader's route; the others are their mirror images."""
        return ceil(reach(self.encounter, self.horizon)[2] / self.cell)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Cells by heading, x and y."""
        return self.headings, self.cells_x, self.cells_y

    @property
    def memory_bound(self) -> float:
        """Growing takes no more than this: every cell improved at every order [bytes]."""
        cells = float(self.headings * self.cells_x * self.cells_y)
        return cells * (CELL_BYTES + (self.order - 1) * NODE_BYTES)


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularTree:
    """A grown tree: its nodes as columns, the root first and parents before children."""

    parameters: TreeParameters
    laid: int
    """How many trajectories were laid back within the horizon, straights clear of d_min."""
    close: int
    """How many of them would have been the best of a cell but for a turn too close."""
    provenance: Mapping[str, str]
    """Who made it, with what and when."""
    x: Floats
    """Ahead of the slot [m]. shape (n,)"""
    y: Floats
    """To the left of the leader's route [m], ≥ 0."""
    heading_number: Ints
    """Heading, counter-clockwise from the leader's, in Δθ."""
    time: Floats
    """T of this path to the slot [s]."""
    parent: Ints
    """The node at the end of the first pair; −1 for the root."""
    length_number: Ints
    """l of the first pair in Δl."""
    angle_number: Ints
    """θ of it in Δθ."""
    turn: Ints
    """ε of it, before it is mirrored."""
    mirrored: Ints
    """1 where this node is the mirror image of what its parent continues."""
    best: Ints
    """Node of least time of each cell, −1 if there is none. shape (headings, cells_x, cells_y)"""

    def __len__(self) -> int:
        return len(self.x)

    @property
    def heading(self) -> Floats:
        """Heading of each node, counter-clockwise from the leader's [rad]."""
        return np.multiply(self.heading_number, 2.0 * pi / self.parameters.headings)

    @property
    def minima(self) -> Ints:
        """The nodes that are the least of their cell, the slot's own left out."""
        best = self.best.ravel()
        minima: Ints = np.sort(best[best > 0])
        return minima


def pairs_of(tree: RegularTree, nodes: Ints) -> Floats:
    """The parameters of the paths to the slot: (ε, θ [rad], l [m]) of each pair, forward.

    Returns:
        shape (n, order − 1, 3); past the last pair, zeros.
    """
    parameters = tree.parameters
    pairs = np.zeros((len(nodes), parameters.order - 1, 3))
    at, side = nodes.copy(), np.ones(len(nodes))
    for i in range(parameters.order - 1):
        going = at > 0
        now = at[going]
        side[going] = np.where(tree.mirrored[now] != 0, -side[going], side[going])
        pairs[going, i, 0] = tree.turn[now] * side[going]
        pairs[going, i, 1] = tree.angle_number[now] * (2.0 * pi / parameters.headings)
        pairs[going, i, 2] = tree.length_number[now] * parameters.delta_l
        at[going] = tree.parent[now]
    return pairs


def regular_from_pairs(pairs: Floats, *, mirrored: bool = False) -> RegularTrajectory:
    """One row of `pairs_of` as triplets, which count backward from the slot.

    Args:
        pairs: ε, θ, l of each pair, forward. shape (order − 1, 3)
        mirrored: left and right exchanged.
    """
    forward = [
        Triplet(
            turn=LEFT if angle == 0.0 or (turn > 0.0) != mirrored else RIGHT,
            turn_angle=angle,
            length=length,
        )
        for turn, angle, length in pairs.tolist()
        if turn != 0.0
    ]
    return RegularTrajectory(triplets=tuple(reversed(forward)))


def situation_of(tree: RegularTree, node: int) -> Situation:
    """The exact situation a node is the answer to."""
    return tree.parameters.encounter.situation(
        float(tree.x[node]), float(tree.y[node]), float(tree.heading[node])
    )


def nodes_at(tree: RegularTree, heading_number: int) -> Ints:
    """The best node of each cell on one heading, both sides; −1 where there is none.

    Right of the route it is the node whose mirror image begins there. shape (cells_x, 2 cells_y)
    """
    headings = tree.parameters.headings
    left, right = tree.best[heading_number % headings], tree.best[-heading_number % headings]
    return np.concatenate((right[:, ::-1], left), axis=1)


def tree_area(tree: RegularTree, heading_number: int) -> Area:
    """The convergence area as the tree has it, for one of its headings, on both sides."""
    parameters = tree.parameters
    time = np.append(tree.time, np.inf)  # what has no node, −1, is the last
    x = parameters.x_low + np.multiply(parameters.cell, np.arange(parameters.cells_x + 1))
    y = np.multiply(parameters.cell, np.arange(parameters.cells_y + 1))
    return Area(
        heading=(heading_number % parameters.headings) * (2.0 * pi / parameters.headings),
        x=x,
        y=np.concatenate((-y[:0:-1], y)),
        time=time[nodes_at(tree, heading_number)],
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Losses:
    """How much slower than the exact plan a tree's paths are, at the very same states."""

    nodes: Ints
    exact: Floats
    """T of the exact plan [s]; infinite where it finds none."""
    loss: Floats
    """T of the tree over the exact one, less 1; −1 where the exact planner finds no path."""

    def share_within(self, loss: float) -> float:
        """Share of the nodes that lose no more than this."""
        return float(np.mean(self.loss <= loss))


def losses(tree: RegularTree, nodes: Ints, exact: Floats) -> Losses:
    """Compare nodes with the exact plans from their very states.

    Args:
        tree: the nodes'.
        nodes: which.
        exact: T of the exact plan of each [s].
    """
    return Losses(nodes=nodes, exact=exact, loss=tree.time[nodes] / exact - 1.0)


ENCOUNTER_NAMES = {
    "pursuer_tas_mps": "pursuer_tas",
    "max_bank_rad": "max_bank",
    "leader_tas_mps": "leader_tas",
    "slot_distance_m": "slot_distance",
    "min_separation_m": "min_separation",
}
"""An encounter's fields by the names they have in files."""


def parameters_as_json(parameters: TreeParameters) -> dict[str, Any]:
    """Parameters as they are written into a file; Δθ as the number of headings, which is exact."""
    encounter = parameters.encounter
    return {
        **{name: getattr(encounter, field) for name, field in ENCOUNTER_NAMES.items()},
        "order": parameters.order,
        "headings": parameters.headings,
        "delta_l_m": parameters.delta_l,
        "cell_m": parameters.cell,
        "horizon_s": parameters.horizon,
    }


def parameters_from_json(content: Mapping[str, Any]) -> TreeParameters:
    """The inverse of `parameters_as_json`.

    Raises:
        ValueError: if they are not such parameters.
    """
    try:
        encounter = {field: float(content[name]) for name, field in ENCOUNTER_NAMES.items()}
        return TreeParameters(
            encounter=Encounter(**encounter),
            order=int(content["order"]),
            delta_theta=2.0 * pi / int(content["headings"]),
            delta_l=float(content["delta_l_m"]),
            cell=float(content["cell_m"]),
            horizon=float(content["horizon_s"]),
        )
    except (KeyError, TypeError, ZeroDivisionError) as error:
        raise ValueError(f"The parameters of the tree are not whole: {error}.") from None
