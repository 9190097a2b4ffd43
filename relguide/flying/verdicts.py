"""Documents given only when asked for: how plans and regular trajectories meet their conditions.

As in `documents`, `contract/wire.py` gives each its JSON form.
"""

from dataclasses import dataclass, field
from typing import Literal

from relguide.flying.plan_documents import LEFT_OUT, PathPoint, PathSegment, Separation
from relguide.planning.optimality import FixedBy
from relguide.units import (
    Metre,
    Millisecond,
    PerMetre,
    Radian,
    Second,
    SecondPerMetre,
    SecondPerRadian,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactCard:
    """A contact with d = d_min, or the beginning or end of a boundary arc."""

    t: Second
    """When."""
    bearing: Radian
    """From pursuer to leader, clockwise from north, in [−180°, 180°]."""
    jump: SecondPerMetre
    """By how much λ_d rises there; 0 or more along a minimum."""
    ident: str = field(default="", metadata=LEFT_OUT)
    """Of other traffic that is touched. Left out for the leader."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryArcCard:
    """A segment flown along d = d_min at partial bank."""

    start: Second
    """When it begins."""
    end: Second
    """When it ends."""
    least_multiplier: PerMetre
    """Least μ on it; 0 or more by eq. (10)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CostatesCard:
    """H, the switching function and the costates along a plan, in columns of equal length.

    The ends of segments and the contacts with d_min appear twice, with the values before and after:
    columns may jump there. Between two different times they are smooth.
    """

    t: tuple[Second, ...]
    """Ascending."""
    hamiltonian: tuple[float, ...]
    """H of eq. (9): 0 once the leader has no turn to come; 1 if it arrives as the slot opens."""
    switching: tuple[SecondPerRadian, ...]
    """λ_ψ, eq. (16): above 0 the pursuer turns left, below 0 right, at 0 it flies straight."""
    separation_costate: tuple[SecondPerMetre, ...]
    """λ_d; it jumps at contacts with d_min."""
    bearing_costate: tuple[SecondPerRadian, ...]
    """λ_θ."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimalityCheck:
    """How a plan meets Pontryagin's conditions, eqs. (9)–(16): added to `OptimalityCard`."""

    arrival: FixedBy
    """What sets t_f: the plan alone, the slot's release time, or that it is in the slot at once."""
    hamiltonian_residual: float
    """Largest |H − H required|."""
    switching_residual: SecondPerRadian
    """Largest |λ_ψ| at a switch or on a straight."""
    stationary: bool
    """Whether each arc turns as eq. (16) requires, λ_ψ vanishes where it should, H is as required,
    and no jump and no μ is below 0, all to a thousandth of R. If not, a small change of the plan
    makes it faster."""
    contacts: tuple[ContactCard, ...]
    boundary_arcs: tuple[BoundaryArcCard, ...]
    costates: CostatesCard


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
    """The error in an end condition."""

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
class NotChecked:
    """Pontryagin's conditions were not checked, as the trajectory does not reach the slot."""

    not_checked: str
    """Why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularCheck:
    """A regular trajectory against the conditions of the paper.

    Pairs and nodes are numbered as the paper does, backward from the slot: the first of each is
    number 1.
    """

    passed: bool
    """Whether it reaches the slot, keeps d_min and is stationary."""
    order: int
    length: Metre
    """Eq. (17)."""
    duration: Second
    reaches_slot: bool
    """Eqs. (18), (19), to 100 m and 0.5°."""
    initial_error: EndErrorCard
    """How far it begins from the pursuer if laid backward from the slot."""
    final_error: EndErrorCard
    """How far it ends from the slot if flown from the pursuer's state."""
    keeps_separation: bool
    """Eq. (20)."""
    separation: Separation
    stationarity: OptimalityCheck | NotChecked
    """How it meets Pontryagin's conditions."""
    triplets: tuple[TripletCard, ...]
    pairs: tuple[PairCard, ...]
    nodes: tuple[PathPoint, ...]
    """Over the ground; node n, the last, is the pursuer's present state."""
    segments: tuple[PathSegment, ...]
    """In the order in which they are flown."""


ComparedPlanner = Literal["exact", "network", "regular_dp", "printed_network"]
"""exact: all words are solved; network: networks pick them; regular_dp: the paper's tree does;
printed_network: the paper's network, flown as it is."""
Verdict = Literal["planned", "refused", "handed_over", "no_plan", "preparing"]
"""planned: its own path may be flown; refused: it may not; handed_over: it has none, and the exact
planner answers; no_plan: nothing can be flown; preparing: its kernels are being compiled."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerVerdict:
    """What one planner would fly in a situation, and what is wrong with that."""

    planner: ComparedPlanner
    """Who finds it."""
    status: Verdict
    """Whether its own path may be flown."""
    message: str
    """The same in a sentence, with what is wrong or how good it is."""
    word: str = ""
    """Its letters; empty where it has no path."""
    time_to_converge: Second = 0.0
    """When its path ends; 0 as above."""
    over_exact: Second = 0.0
    """How much later than the exact plan that is; below 0 for a path that may not be flown. 0 where
    either has none."""
    least: Metre = 0.0
    """Least separation on it; 0 where it has no path."""
    compute: Millisecond = 0.0
    """How long it takes to find, once all that it needs is loaded."""
    segments: tuple[PathSegment, ...] = ()
    """The path, in the order flown."""
