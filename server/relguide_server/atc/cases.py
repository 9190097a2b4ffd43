"""Clearances of this run of the service: each with what belongs to it, and how they are found."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from relguide.atc.cards import card_of
from relguide.atc.clearances import State
from relguide.atc.conformance import Memory
from relguide.atc.life import Clearance
from relguide.atc.track import Track
from relguide.contract.wire import placed_to_wire
from relguide.flying.documents import ClearanceNews, ForecastChanged
from relguide.planning.frames import LocalPlane
from relguide.units import Second
from relguide_server.http.errors import Refusal

MOST_LIVE = 500
"""Clearances that live at once …"""
MOST_OF_ONE = 50
"""… and those that one client asked for."""
MOST_OVER = 500
"""Clearances that are over and still kept here: older ones are on record."""
CLEARED: tuple[State, ...] = ("accepted", "wilco", "flying")
"""States in which others keep clear of the path."""


@dataclass(slots=True, kw_only=True)
class Case:
    """A clearance, and what the desk knows of it beside."""

    clearance: Clearance
    number: int
    """In the order they were asked for."""
    request: str
    """The body that asked, JSON."""
    client: str
    """Who asked, for a share."""
    owner: str
    """Who asked, as access knows it."""
    asked_by: str
    """Address of the client."""
    asked_at: float
    """Unix time [s]."""
    plane: LocalPlane | None
    """How its sky lies on the earth; `None` where nobody has said so."""
    pursuer: str = ""
    """Its ident in its flight."""
    text: bytes = b""
    """All of it as it was sent last."""
    memory: Memory = field(default_factory=Memory)
    """Of the monitor."""
    checked: Second = 0.0
    """When it was validated last [s]."""
    checking: bool = False
    """Whether it is being validated."""
    looked_at: ForecastChanged | None = None
    """The last forecast that was compared with its path."""
    told: ClearanceNews | None = None
    """What its crew was told last."""
    joined: Second | None = None
    """Since when its flight has joined [s]."""

    @property
    def state(self) -> State:
        """How far it has come."""
        return self.clearance.state

    @property
    def lives(self) -> bool:
        """Whether it is not over."""
        return not self.clearance.over

    def as_json(self) -> dict[str, object]:
        """All of it, as the API shows it."""
        place = None if self.plane is None else self.plane.to_geodetic
        return placed_to_wire(card_of(self.clearance), place)


class Cases:
    """All of them, the oldest first. Lives on the event loop."""

    def __init__(self) -> None:
        self._known: dict[str, Case] = {}
        self._number = 0

    def __iter__(self) -> Iterator[Case]:
        return iter(self._known.values())

    def living(self, sky: str | None = None) -> list[Case]:
        """Those that are not over; of one sky, if that is given."""
        return [case for case in self if case.lives and (sky is None or case.clearance.sky == sky)]

    def next_number(self) -> int:
        """Of the next one that is asked for."""
        self._number += 1
        return self._number

    def add(self, case: Case) -> None:
        """One more; the oldest that are over are kept here no longer."""
        self._known[case.clearance.id] = case
        over = [known for known in self if not known.lives]
        for gone in over[: max(len(over) - MOST_OVER, 0)]:
            del self._known[gone.clearance.id]

    def get(self, clearance_id: str) -> Case | None:
        """One by its id; `None` if it is not known here."""
        return self._known.get(clearance_id)

    def expect_room(self, client: str) -> None:
        """Refuse one more where too many live.

        Raises:
            Refusal: 429.
        """
        living = self.living()
        own = sum(case.client == client for case in living)
        if len(living) < MOST_LIVE and own < MOST_OF_ONE:
            return
        raise Refusal(
            429,
            f"{len(living)} clearances live, {own} of them yours: at most {MOST_LIVE} may, and "
            f"{MOST_OF_ONE} of one client. Cancel one, or wait until one is over.",
            kind="too-many-clearances",
            headers={"Retry-After": "30"},
        )

    def cleared(self, sky: str) -> dict[str, Track]:
        """What aircraft of a sky are cleared to fly, by ident."""
        return {
            case.clearance.request.ident: case.clearance.request.path
            for case in self.living(sky)
            if case.state in CLEARED
        }
