"""Who has control of a flight: one client at a time, which flies a pursuer by hand."""

from dataclasses import dataclass

from relguide.contract.upstream import ControlAnswer, GiveBack, StickMove, TakeControl, Upstream
from relguide.flying.documents import FlightStarted
from relguide.flying.orders import SetAutopilot, order_fault
from relguide_server.flights.hands import Hands
from relguide_server.flights.stream import StreamClient
from relguide_server.http.access import NOT_YOURS

MOST_RATE = 5.0
"""Simulated seconds per second, while a flight is flown by hand."""
TOO_FAST = f"By hand a flight is flown at a rate of {MOST_RATE:g} at most, not {{rate:g}}."
OVER = "This flight has ended."
RECORDING = "This is a recording: it cannot be flown by hand."
MODELLED = "A modelled pilot flies by hand in this flight: it alone moves the stick."
HELD = "Another client has control of this flight: it has to give it back first."
STILL_FLOWN = "{ident} is still flown by hand: give it back, and try again in a second."
NOT_HELD = "You do not have control: take it first."
TAKEN = "You have control from the next second of flight on."
GIVEN_BACK = "The autopilot flies from the next second of flight on, once the bank is small enough."
REMOVED = "This flight was ended and removed, so it cannot be flown any more."
LOST = "The autopilot was switched on: it flies."


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """What decides whether a client may take control of a flight that no other has."""

    started: FlightStarted
    over: bool
    replay: bool
    modelled: bool
    rate: float
    may_command: bool
    """Whether the client may command the flight at all."""

    def refusal(self, ident: str) -> str:
        """Why it may not take control of a pursuer, in a sentence; empty if it may."""
        if self.over:
            return f"{OVER} Start another one to fly it by hand."
        if self.replay:
            return RECORDING
        if self.modelled:
            return MODELLED
        if not self.may_command:
            return NOT_YOURS
        if self.rate > MOST_RATE:
            return TOO_FAST.format(rate=self.rate)
        aircraft = [one.ident for one in self.started.aircraft]
        links = [(link.pursuer, link.leader) for link in self.started.links]
        return order_fault(SetAutopilot(on=False, ident=ident), aircraft, links)


class Control:
    """Gives the hands of a flight to one client. Lives on the event loop."""

    def __init__(self, hands: Hands) -> None:
        self._hands = hands
        self._holder: StreamClient | None = None

    @property
    def taken(self) -> bool:
        """Whether a client has control."""
        return self._holder is not None

    def hear(self, client: StreamClient, frame: Upstream, standing: Standing) -> None:
        """Do what a client asks for, and answer it."""
        match frame:
            case StickMove(roll=roll, pitch=pitch):
                if client is self._holder:
                    self._hands.move(roll, pitch)
                elif not client.knows_it_has_none:  # others may be on their way
                    self._answer(client, NOT_HELD)
            case TakeControl():
                self._answer(client, self._take(client, frame, standing))
            case GiveBack():
                held = client is self._holder
                self.release(client)
                self._answer(client, GIVEN_BACK if held else NOT_HELD)

    def release(self, client: StreamClient) -> None:
        """A client gives control back, if it has it, or is gone."""
        if client is self._holder:
            self._holder = None
            self._hands.let_go()

    def look(self, *, over: bool) -> None:
        """Tell the client that has control if it lost it.

        Args:
            over: whether the flight is over.
        """
        holder = self._holder
        if holder is not None and (over or self._hands.lost):
            self.release(holder)
            self._answer(holder, OVER if over else LOST)

    def end(self) -> None:
        """Tell the client that has control that the flight is removed."""
        holder = self._holder
        if holder is not None:
            self.release(holder)
            self._answer(holder, REMOVED)

    def _take(self, client: StreamClient, wanted: TakeControl, standing: Standing) -> str:
        ident = wanted.ident or next((link.pursuer for link in standing.started.links), "")
        if why := standing.refusal(ident):
            return why
        if self._holder not in (None, client):
            return HELD
        if self._hands.flown not in ("", ident):
            return STILL_FLOWN.format(ident=self._hands.flown)
        self._holder = client
        self._hands.take(ident, director=wanted.director)
        return TAKEN

    def _answer(self, client: StreamClient, message: str) -> None:
        yours = client is self._holder
        client.knows_it_has_none = not yours
        answer = ControlAnswer(kind="control", yours=yours, message=message)
        client.answer(answer.model_dump_json())
