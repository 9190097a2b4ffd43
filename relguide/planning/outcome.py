"""What a planner answers: a plan with what is proved of it, or why there is none and what helps."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Literal

from numpy.typing import ArrayLike

from relguide.planning.arrival import Arrival, arrival
from relguide.planning.certificate import Certificate, certify
from relguide.planning.inputs import number
from relguide.planning.intent import LevelChange
from relguide.planning.sampling import Samples
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory, pieces_text
from relguide.units import Metre, Millisecond, Second

Proof = Literal["relaxation", "certified", "bound", "none"]
"""What proves a plan: the best plan without the limit keeps it; a lower bound within 0.1 s, which
`prove` finds; any lower bound; nothing."""
LONGEST_NAME = 40
"""Longest name of a planner [characters]: what fits on a line of the cockpit."""


class Reason(StrEnum):
    """Why there is no plan.

    Examples:
        >>> from dataclasses import replace
        >>> asked = rg.scenario("fig_6b").situation
        >>> near = replace(asked, pursuer=replace(asked.pursuer, x=-5e3, y=0.0))
        >>> rg.plan(near).reason is rg.Reason.SEPARATION_ALREADY_LOST
        True
    """

    SLOT_UNREACHABLE = "slot_unreachable"
    SEPARATION_ALREADY_LOST = "separation_already_lost"
    SEPARATION_UNAVOIDABLE = "separation_unavoidable"
    BEYOND_HORIZON = "beyond_horizon"
    DEADLINE = "deadline"
    TRAFFIC = "traffic"
    LEVEL = "level"


@dataclass(frozen=True, slots=True, kw_only=True)
class Optimality:
    """What is proved of a plan's time."""

    proof: Proof
    lower_bound: Second
    """No plan that keeps d_min is faster than this [s]."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Plan:
    """A certified trajectory to the slot.

    Examples:
        >>> best = rg.plan(rg.scenario("fig_6b").situation)
        >>> round(best.time_to_converge), best.optimality.proof  # [s]
        (904, 'relaxation')
        >>> best.over_ground([0.0, 60.0]).x  # [m]
        array([-40000., -25600.])
    """

    situation: Situation
    """What was asked about; the pursuer with the changes of level that were planned."""
    trajectory: Trajectory
    """In the air mass, from the pursuer's present state to the slot."""
    word: str
    """Its letters, e.g. `"LSR"`."""
    certificate: Certificate
    optimality: Optimality
    planner: str
    """What made it: `exact`, `network`, `regular_dp`, or the name of a planner of one's own."""
    compute_time: Millisecond = field(default=0.0, compare=False)
    """Wall time it took to find [ms]."""
    fell_back: bool = field(default=False, compare=False)
    """Whether it took the place of another planner's, which was asked first."""
    status: Literal["planned"] = "planned"

    def __post_init__(self) -> None:
        """Refuse a name that does not fit on a line."""
        name = self.planner
        if name != "exact" and not (
            isinstance(name, str) and name.isprintable() and 0 < len(name.strip()) <= LONGEST_NAME
        ):
            raise ValueError(
                f"planner must be a name of 1 to {LONGEST_NAME} printable characters, not {name!r}."
            )

    @property
    def levels(self) -> tuple[LevelChange, ...]:
        """Changes of level that the pursuer makes."""
        return self.situation.pursuer.levels

    @property
    def time_to_converge(self) -> Second:
        """T: when the pursuer is at the slot, on the leader's heading [s]."""
        return self.trajectory.duration

    @classmethod
    def from_trajectory(
        cls,
        trajectory: Trajectory,
        situation: Situation,
        *,
        planner: str,
        lower_bound: Second = 0.0,
    ) -> "Plan":
        """A plan from the trajectory of a planner of one's own, with its certificate.

        Whether it may be flown is decided where it is used: `certificate.holds` and
        `arrival.holds` must both be true.

        Args:
            trajectory: in the air mass, from the pursuer's present state to the slot.
            situation: what was asked about.
            planner: its name, 1 to 40 printable characters.
            lower_bound: no plan that keeps d_min is faster than this [s]; 0 if nothing is known.
        """
        certificate, bound = certify(trajectory, situation), number("lower_bound", lower_bound)
        return cls(
            situation=situation,
            trajectory=trajectory,
            word=trajectory.letters,
            certificate=certificate,
            optimality=Optimality(proof="bound" if bound > 0.0 else "none", lower_bound=bound),
            planner=planner,
        )

    def sample(self, t: ArrayLike) -> Samples:
        """Where the pursuer is at many times at once, as `Trajectory.sample`."""
        return self.trajectory.sample(t)

    def over_ground(self, t: ArrayLike | None = None) -> Samples:
        """The same over the ground, in the situation's wind, as `Trajectory.over_ground`."""
        return self.trajectory.over_ground(self.situation.wind, t)

    def __repr__(self) -> str:
        """Three lines: the path, the separation, the proof."""
        found, proof = self.certificate, self.optimality
        spans = ", ".join(f"{kept[0]:.0f} to {kept[1]:.0f} s" for kept in found.vertical)
        height = f",\n     1,000 ft keep them apart from {spans}" if spans else ""
        return (
            f"Plan({self.word} by {self.planner}: joins in {self.time_to_converge:.1f} s, "
            f"{pieces_text(self.trajectory)},\n"
            f"     least separation {found.least_separation:.1f} m at {found.at_time:.1f} s, "
            f"proved above {found.lower_bound:.1f} m{height},\n"
            f"     proof: {proof.proof}, no plan is faster than {proof.lower_bound:.1f} s)"
        )

    def _repr_svg_(self) -> str:
        """How notebooks show it: drawn, north up."""
        from relguide.planning.drawing import plan_drawing  # most plans are never drawn

        return plan_drawing(
            self.trajectory, self.situation, word=self.word, certificate=self.certificate
        )

    @property
    def arrival(self) -> Arrival:
        """How its end meets eq. (7); computed anew each time, from the trajectory alone."""
        return arrival(self.trajectory, self.situation)


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """What the best path that was found comes too close to."""

    ident: str
    """Of other traffic, or of a cell."""
    at_time: Second
    """When it is nearest [s]."""
    least_separation: Metre
    """How near it comes; negative inside a cell [m]."""
    min_separation: Metre
    """What is to be kept [m]; 0 for a cell."""


RemedyKind = Literal["slot_distance", "level"]
"""Another D; another level."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """A change with which there is a plan: it was tried."""

    kind: RemedyKind
    value: float
    """D, or the level [m]."""
    time_to_converge: Second
    """T of the plan there is then, from the time that it is asked [s]."""
    message: str
    """The same for people."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoPlan:
    """Why there is no plan, and what would help.

    Examples:
        >>> from dataclasses import replace
        >>> asked = rg.scenario("fig_6b").situation
        >>> near = replace(asked, pursuer=replace(asked.pursuer, x=-5e3, y=0.0))
        >>> answer = rg.plan(near)
        >>> if isinstance(answer, rg.NoPlan):
        ...     print(answer.message)
        The aircraft are 5,000 m ... apart, closer than the minimum of 9,260 m...
    """

    reason: Reason
    message: str
    """A sentence for people."""
    lower_bound: Second = 0.0
    """No plan that keeps d_min is faster than this [s]; 0 where nothing is known."""
    conflict: Conflict | None = None
    """With `Reason.TRAFFIC`: what is in the way of the best path that was found."""
    remedies: tuple[Remedy, ...] = ()
    """With `Reason.TRAFFIC`: what would help."""
    status: Literal["no_plan"] = "no_plan"


AS_FAST: Second = 1e-6
"""Times closer than this count as equal: the same path found twice differs by rounding [s]."""
Planner = Callable[[Situation], Plan | NoPlan]
"""The one protocol of all planners."""
