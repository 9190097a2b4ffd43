"""What is said only if asked for: how plans and regular trajectories meet their conditions.

As in `documents`, `contract/wire.py` gives each its JSON form.
"""

from dataclasses import dataclass

from relguide.flying.documents import PathPoint, PathSegment, Separation
from relguide.planning.optimality import Arrival
from relguide.units import Metre, PerMetre, Radian, Second, SecondPerMetre, SecondPerRadian


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactCard:
    """Where a plan touches d = d_min, or where a boundary arc along it begins or ends."""

    t: Second
    bearing: Radian
    """From pursuer to leader, clockwise from north, in [−180°, 180°]."""
    jump: SecondPerMetre
    """By how much λ_d rises there; a minimum asks that it be 0 or more."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryArcCard:
    """A stretch flown along d = d_min at partial bank."""

    start: Second
    end: Second
    least_multiplier: PerMetre
    """Least μ on it; eq. (10) asks that it be 0 or more."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimalityPanel:
    """H and the costates along a plan, in columns of one length.

    Each end of a segment and each touch of d_min is there twice, for before and after: there a
    column may jump. Between two times that differ it is smooth.
    """

    t: tuple[Second, ...]
    """Ascending."""
    hamiltonian: tuple[float, ...]
    """H of eq. (9): 0 once the leader has no turn to come; 1 on a plan that waits for the slot."""
    switching: tuple[SecondPerRadian, ...]
    """λ_ψ, eq. (16): above 0 the pursuer turns left, below 0 right, at 0 it flies straight."""
    separation_costate: tuple[SecondPerMetre, ...]
    """λ_d; jumps where d_min is touched."""
    bearing_costate: tuple[SecondPerRadian, ...]
    """λ_θ."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimalityCheck:
    """How a plan meets Pontryagin's conditions, eqs. (9)–(16): what `OptimalityCard` gains."""

    arrival: Arrival
    """What fixes t_f: the plan alone, the slot's opening, or being there from the start."""
    hamiltonian_residual: float
    """Largest |H − H due|."""
    switching_residual: SecondPerRadian
    """Largest |λ_ψ| at a switch or on a straight."""
    switching_ok: bool
    """The plan is stationary: each arc turns the way eq. (16) asks, λ_ψ vanishes where it should,
    H is as due, and no jump and no μ is below 0, all to a thousandth of R. If not, a small change
    would make it faster."""
    contacts: tuple[ContactCard, ...]
    boundary_arcs: tuple[BoundaryArcCard, ...]
    panel: OptimalityPanel


@dataclass(frozen=True, slots=True, kw_only=True)
class TripletCard:
    """A pair (ε_i, θ_i, l_i) of a regular trajectory, eq. (17)."""

    epsilon: int
    """+1 turns left, −1 right."""
    theta: Radian
    """How far it turns."""
    l: Metre
    """The straight flown after the turn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EndErrorCard:
    """By how much an end condition is missed."""

    along: Metre
    """Along the leader's heading."""
    left: Metre
    """To the left of it."""
    heading_error: Radian
    """Clockwise of what it should be, in [−180°, 180°]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairCard:
    """The separation on a pair, eq. (20) by the corrected (21)–(24)."""

    turn_least: Metre
    turn_proved_above: Metre
    t_star: Second
    """T* of (21), counted back from the pair's end."""
    straight_least: Metre
    keeps_separation: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class NotAsked:
    """Pontryagin's conditions are not asked of what does not reach the slot."""

    not_asked: str
    """Why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularCheck:
    """A regular trajectory against the conditions of the paper.

    Pairs and nodes are numbered as the paper does, backward from the slot: the first of each is
    number 1.
    """

    passed: bool
    """It reaches the slot, keeps d_min and is stationary."""
    order: int
    length: Metre
    """Eq. (17)."""
    duration: Second
    reaches_slot: bool
    """Eqs. (18), (19), to 100 m and 0.5°."""
    initial_error: EndErrorCard
    """Laid backward from the slot, how far it begins from the pursuer."""
    final_error: EndErrorCard
    """Flown from the pursuer's state, how far it ends from the slot."""
    keeps_separation: bool
    """Eq. (20)."""
    separation: Separation
    stationarity: OptimalityCheck | NotAsked
    """How it meets Pontryagin's conditions."""
    triplets: tuple[TripletCard, ...]
    pairs: tuple[PairCard, ...]
    nodes: tuple[PathPoint, ...]
    """Over the ground; node n, the last, is the pursuer's present state."""
    segments: tuple[PathSegment, ...]
    """What is flown, in the order flown."""
