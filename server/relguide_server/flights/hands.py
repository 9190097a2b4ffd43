"""The hands of a client on a pursuer's stick: from what it sent last to orders of the flight.

The event loop says what is wanted; the flight's own thread asks for orders at each step, and gives
one only where something changes: each is recorded, so that the flight can be flown again.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import copysign
from time import monotonic

from relguide.flying.aircraft_documents import find_by_ident
from relguide.flying.documents import ControlChanged, Document, FlightStarted, Sample
from relguide.flying.engagement import AUTOPILOT_BANK
from relguide.flying.orders import Command, SetAutopilot, SetDirector, Stick
from relguide.units import Radian, Second

SILENCE: Second = 0.5
"""After so long without a frame, by the wall clock, the stick is neutral."""
LEVELLED: Radian = 0.75 * AUTOPILOT_BANK
"""Who lets go at a steeper bank is brought back to this one, for the autopilot to take over."""
FULL = 1.0
"""Deflection of the stick that does so."""
NEUTRAL = (0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Grip:
    """What a client wants: to fly a pursuer by hand."""

    ident: str
    """The pursuer's."""
    director: bool
    """Whether the flight director's bars are to be shown."""


class Hands:
    """Between the event loop and the thread of one flight; each attribute is written by one."""

    def __init__(self, clock: Callable[[], Second] = monotonic) -> None:
        self._clock = clock
        self._wanted: Grip | None = None
        self._held = (*NEUTRAL, clock())
        self._served: Grip | None = None
        self._lost: Grip | None = None
        self._flown = ""
        self._has = False  # whether the autopilot has let go since
        self._given: tuple[float, float] | None = None
        self._newest: Sample | None = None
        self._step: Second = 0.0

    # -- on the event loop ------------------------------------------------------------------------

    def take(self, ident: str, *, director: bool) -> None:
        """Fly a pursuer by hand from the next second of flight on."""
        self._held = (*NEUTRAL, self._clock())
        self._wanted = Grip(ident, director)

    def move(self, roll: float, pitch: float) -> None:
        """Deflect the stick, −1 … 1."""
        self._held = (roll, pitch, self._clock())

    def let_go(self) -> None:
        """Give control back: neutral at once, the autopilot from the next second of flight on."""
        self._wanted = None

    @property
    def lost(self) -> bool:
        """Whether control went back to the autopilot by another's order."""
        return self._wanted is not None and self._lost is self._wanted

    @property
    def flown(self) -> str:
        """The ident of the pursuer that is flown by these hands now; empty if there is none."""
        return self._flown

    # -- in the flight's thread -------------------------------------------------------------------

    @property
    def ahead(self) -> Second:
        """How long before its time a document is complete: a step, while it is flown by hand.

        A step's stick is read as the step begins, and nothing that comes later can change its end.
        """
        return self._step if self._flown else 0.0

    def note(self, document: Document) -> None:
        """A document of the flight, newer than all before."""
        if isinstance(document, Sample):
            self._newest = document
        elif isinstance(document, ControlChanged):
            if document.ident == self._flown:
                # what the crew switches before the autopilot lets go says that it still flies
                if document.autopilot and self._has:
                    self._flown, self._lost = "", self._served
                self._has = not document.autopilot
        elif isinstance(document, FlightStarted):
            self._step = document.step

    def orders(self, t: Second) -> Iterator[Command]:
        """What the flight is to be ordered at flight time t [s]; nothing where nothing changes."""
        wanted, sample = self._wanted, self._newest
        if (wanted is None and not self._flown) or sample is None:
            return
        whole = t.is_integer()  # all but sticks waits for the next second in any case
        if whole and wanted is not None and wanted is not self._served:
            if self._flown in ("", wanted.ident):
                yield from self._begin(wanted, sample)
        if not self._flown:
            return
        if wanted is not None:
            roll, pitch, since = self._held
            yield from self._give((roll, pitch) if self._clock() - since <= SILENCE else NEUTRAL)
            return
        bank = find_by_ident(sample.aircraft, self._flown).bank
        level = abs(bank) <= LEVELLED
        yield from self._give(NEUTRAL if level else (-copysign(FULL, bank), 0.0))
        if whole and level:
            yield SetAutopilot(on=True, ident=self._flown)

    def _begin(self, wanted: Grip, sample: Sample) -> Iterator[Command]:
        now = find_by_ident(sample.guidance, wanted.ident)
        if not self._flown:
            # after the autopilot the stick is neutral; after another crew it stands where it stood
            self._given = NEUTRAL if now.autopilot else None
        self._served, self._flown = wanted, wanted.ident
        self._has = not now.autopilot
        if now.autopilot:
            yield SetAutopilot(on=False, ident=wanted.ident)
        if now.director != wanted.director:
            yield SetDirector(on=wanted.director, ident=wanted.ident)

    def _give(self, stick: tuple[float, float]) -> Iterator[Command]:
        if stick != self._given:
            self._given = stick
            yield Stick(roll=stick[0], pitch=stick[1], ident=self._flown)
