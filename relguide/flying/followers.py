"""Further pursuers of a flight: those of the queue that its pursuer joins, and those behind it."""

from dataclasses import dataclass

from relguide.flying.airframe_files import airframe
from relguide.flying.dispersion import disperse
from relguide.flying.world import Aircraft, Guided
from relguide.planning.aircraft import Pursuer
from relguide.planning.inputs import expect, text
from relguide.units import Kilogram, Metre


@dataclass(frozen=True, slots=True, kw_only=True)
class Follower:
    """A guided aircraft that joins the one before it, as far behind as all of its queue are.

    Examples:
        >>> own = rg.Pursuer(x=-60e3, y=20e3, heading=1.5, tas=235.0, max_bank=0.4)
        >>> rg.Follower(ident="SECOND", pursuer=own).aircraft(9_449.0, seed=0).altitude  # [m]
        9449.0
    """

    ident: str
    pursuer: Pursuer
    """Where it begins, its speed V_P and the bank of its plans."""
    aircraft_type: str = "A306"
    """ICAO designator of one of the types that are known."""
    weight: Kilogram = 0.0
    """[kg]; 0 for the reference weight of its type."""

    def __post_init__(self) -> None:
        """Refuse what cannot be guided."""
        if not text("ident", self.ident).strip():
            raise ValueError("ident must not be empty.")
        expect("pursuer", self.pursuer, Pursuer)
        airframe(self.aircraft_type).expect_weight("weight", self.weight)

    def aircraft(self, altitude: Metre, seed: int) -> Aircraft:
        """As it begins.

        Args:
            altitude: of the flight, unless the pursuer has its own [m].
            seed: 0 flies the type as its data say; any other draws its constants.
        """
        can, own = airframe(self.aircraft_type), self.pursuer
        return Aircraft(
            ident=self.ident,
            airframe=disperse(can, seed),
            believed=can,
            aircraft_type=can.designator,
            x=own.x,
            y=own.y,
            heading=own.heading,
            tas=own.tas,
            altitude=altitude if own.altitude is None else own.altitude,
            weight=self.weight,
            max_bank=own.max_bank,
            pilot=Guided(),
        )


def expect_followers(name: str, followers: object, taken: set[str]) -> tuple[Follower, ...]:
    """Further pursuers, each with an ident of its own.

    Args:
        name: of the field, for messages.
        followers: what was given.
        taken: idents of all others; those of the followers are added.

    Raises:
        ValueError: for what is no follower, or has the ident of another.
    """
    found: list[Follower] = []
    if not isinstance(followers, tuple | list):
        raise ValueError(f"{name} must be a tuple of Follower, not {followers!r}.")
    for i, follower in enumerate(followers):
        expect(f"{name}[{i}]", follower, Follower)
        assert isinstance(follower, Follower)
        if follower.ident in taken:
            raise ValueError(
                f"{name}[{i}].ident must be its own: another aircraft is {follower.ident!r}."
            )
        taken.add(follower.ident)
        found.append(follower)
    return tuple(found)
