"""Regular trajectories of order n as the paper writes them: triplets (ε_i, θ_i, l_i), (17).

A regular trajectory of order n is n − 1 pairs of a turn at nominal bank and a straight. Nodes and
pairs are numbered backward from the slot: node n is the initial situation, node 1 the final one,
and pair i leads from node i + 1 to node i. The turn of a pair is flown before its straight, in the
order of the triplet: (21) counts T* back from the end of the pair and compares it with l/V_P, which
is the straight's own time only if the straight comes last.

Any trajectory of turns at nominal bank and straights is a regular one if half a pair may be
missing: a straight after no turn has θ = 0 and ε = +1, a turn before no straight has l = 0. So
CSC is of order 3, with l₁ = 0; CCC of order 4, with l₁ = l₂ = l₃ = 0; SCSC of order 4, with θ₃ = 0.
"""

from dataclasses import dataclass
from typing import assert_never

from relguide.planning.inputs import expect, number, turn_sign
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, Arc, BoundaryArc, Segment, Straight, Trajectory, Turn
from relguide.units import Metre, Radian

SAME_RADIUS = 1e-9
"""Radii whose relative difference is less than this are equal."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Triplet:
    """A pair (ε_i, θ_i, l_i): a turn at nominal bank, then a straight."""

    turn: Turn
    """ε_i: `LEFT` (+1) or `RIGHT` (−1)."""
    turn_angle: Radian
    """θ_i [rad], ≥ 0."""
    length: Metre
    """l_i [m], ≥ 0."""

    def __post_init__(self) -> None:
        """Refuse what (17) does not allow; its numbers become floats."""
        object.__setattr__(self, "turn", turn_sign("ε", self.turn))
        for field, name, unit in (("turn_angle", "θ", "rad"), ("length", "l", "m")):
            value = number(name, getattr(self, field))
            if value < 0.0:
                raise ValueError(
                    f"{name} must be a finite number of 0 or more, not {value:g} {unit}."
                )
            object.__setattr__(self, field, value)


@dataclass(frozen=True, slots=True, kw_only=True)
class RegularTrajectory:
    """A regular trajectory by its parameters alone, (17)."""

    triplets: tuple[Triplet, ...]
    """Numbered backward from the slot: the first is i = 1, flown last."""

    def __post_init__(self) -> None:
        """Refuse anything but triplets."""
        expect("triplets", self.triplets, tuple)
        for i, triplet in enumerate(self.triplets, start=1):
            expect(f"triplet {i}", triplet, Triplet)

    @property
    def order(self) -> int:
        """The order n: one more than there are pairs."""
        return len(self.triplets) + 1

    def length(self, turn_radius: Metre) -> Metre:
        """Σ (l_k + R_min θ_k), what (17) minimises [m]."""
        return sum(t.length + turn_radius * t.turn_angle for t in self.triplets)


def regular_from_trajectory(trajectory: Trajectory, *, turn_radius: Metre) -> RegularTrajectory:
    """The parameters of a trajectory.

    Args:
        trajectory: of turns and straights.
        turn_radius: R_min, which all its turns must have [m].

    Raises:
        ValueError: if it turns at another bank, or slides along d_min.
    """
    expect("trajectory", trajectory, Trajectory)
    turn_radius = number("turn_radius", turn_radius)
    pairs: list[Triplet] = []
    turning: Arc | None = None
    for segment in trajectory.segments:
        match segment:
            case Arc():
                if abs(segment.radius - turn_radius) > SAME_RADIUS * turn_radius:
                    raise ValueError(
                        f"A regular trajectory turns at one radius, here {turn_radius:.1f} m; this "
                        f"trajectory has a turn of {segment.radius:.1f} m."
                    )
                if turning is not None:
                    pairs.append(_triplet(turning, 0.0))
                turning = segment
            case Straight():
                pairs.append(_triplet(turning, segment.length))
                turning = None
            case BoundaryArc():
                raise ValueError(
                    "A regular trajectory turns at nominal bank only; this trajectory slides along "
                    "d_min at less."
                )
            case _:
                assert_never(segment)
    if turning is not None:
        pairs.append(_triplet(turning, 0.0))
    return RegularTrajectory(triplets=tuple(reversed(pairs)))


def trajectory_from_regular(regular: RegularTrajectory, situation: Situation) -> Trajectory:
    """What the pursuer flies from its present state (18), without pieces of no length.

    Args:
        regular: the parameters.
        situation: gives the pursuer and R_min.
    """
    expect("regular", regular, RegularTrajectory)
    expect("situation", situation, Situation)
    pursuer = situation.pursuer
    segments: list[Segment] = []
    for pair in reversed(regular.triplets):
        if pair.turn_angle > 0.0:
            segments.append(
                Arc(turn=pair.turn, turn_angle=pair.turn_angle, radius=pursuer.turn_radius)
            )
        if pair.length > 0.0:
            segments.append(Straight(length=pair.length))
    return pursuer.flying(tuple(segments))


def _triplet(turning: Arc | None, length: Metre) -> Triplet:
    if turning is None:
        return Triplet(turn=LEFT, turn_angle=0.0, length=length)
    return Triplet(turn=turning.turn, turn_angle=turning.turn_angle, length=length)
