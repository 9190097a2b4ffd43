"""Everything a plan depends on at one instant: both aircraft, the intent, D, d_min, the wind.

A `Situation` is data and its own judge: what cannot be flown is refused when it is made, with a
sentence that says what would be right, always by a `ValueError`. What may be flown is bounded on
all sides (see `limits`), and with it the work that a plan takes. Positions and headings are
of the world frame (x east, y north, heading clockwise from north), at t = 0, over the ground.
"""

from dataclasses import dataclass
from math import cos, hypot, sin

from relguide.planning.aircraft import Leader, Pursuer, Traffic, expect_distance
from relguide.planning.cells import Cell
from relguide.planning.inputs import expect
from relguide.planning.intent import heading_in_degrees, settle
from relguide.planning.limits import CLEARANCE, HEADWAY, MAX_OTHERS, no_headway, too_close_a_slot
from relguide.planning.reprs import as_code
from relguide.planning.wind import CALM, Wind, wind_from
from relguide.units import KT, NM, Metre

Other = Traffic | Cell
"""What a pursuer keeps clear of besides its leader."""


def expect_others(name: str, value: object) -> tuple[Other, ...]:
    """Other traffic and cells, a list of them as well.

    Raises:
        ValueError: for anything else, for more than `MAX_OTHERS`, and for an ident given twice.
    """
    if not isinstance(value, tuple | list):
        raise ValueError(f"{name} must be a tuple of Traffic and Cell.")
    if len(value) > MAX_OTHERS:
        raise ValueError(f"{name} must have at most {MAX_OTHERS} members, not {len(value)}.")
    idents: set[str] = set()
    for i, other in enumerate(value):
        expect(f"{name}[{i}]", other, Traffic, Cell)
        if other.ident in idents:
            raise ValueError(f"{name} must have idents of their own, and {other.ident!r} is twice.")
        idents.add(other.ident)
    return tuple(value)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Situation:
    """Everything a plan depends on, at one instant (t = 0): the initial conditions, eq. (6).

    Examples:
        >>> own = rg.Pursuer(x=-40e3, y=40e3, heading=1.5, tas=240.0, max_bank=0.4)
        >>> leader = rg.Leader(x=0.0, y=0.0, heading=1.5, tas=200.0)
        >>> asked = rg.Situation(pursuer=own, leader=leader, slot_distance=10e3, min_separation=9e3)
    """

    pursuer: Pursuer
    leader: Leader
    slot_distance: Metre
    """D, along the leader's ground track of the final leg behind it [m]."""
    min_separation: Metre
    """d_min [m], 0 ≤ d_min ≤ D."""
    wind: Wind = CALM
    others: tuple[Other, ...] = ()
    """Other traffic and weather cells, each with an ident of its own."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse distances that contradict each other."""
        expect("pursuer", self.pursuer, Pursuer)
        expect("leader", self.leader, Leader)
        expect("wind", self.wind, Wind)
        for name in ("slot_distance", "min_separation"):
            settle(self, name, expect_distance(name, getattr(self, name)))
        if not CLEARANCE.admits(self.slot_distance - self.min_separation):
            wrong = too_close_a_slot(self.slot_distance, self.min_separation)
            raise ValueError(f"slot_distance {wrong}")
        if self.others != ():
            settle(self, "others", expect_others("others", self.others))
        heading = self.leader.final_heading
        headway = hypot(
            self.leader.tas * sin(heading) + self.wind.east,
            self.leader.tas * cos(heading) + self.wind.north,
        )
        if not HEADWAY.admits(headway):
            raise ValueError(f"The leader {no_headway(headway)}")

    @classmethod
    def from_display(
        cls,
        *,
        pursuer: Pursuer,
        leader: Leader,
        slot_distance_nm: float,
        min_separation_nm: float,
        wind_from_deg: float = 0.0,
        wind_kt: float = 0.0,
        others: tuple[Other, ...] = (),
    ) -> "Situation":
        """In the units of aviation: nautical miles, knots, and where the wind comes from."""
        direction = heading_in_degrees("wind_from_deg", wind_from_deg)
        return cls(
            pursuer=pursuer,
            leader=leader,
            slot_distance=slot_distance_nm * NM,
            min_separation=min_separation_nm * NM,
            wind=wind_from(direction, wind_kt * KT) if wind_kt else CALM,
            others=others,
        )
