"""What a client sends up a flight's stream: it takes control, moves the stick, gives control back.

A client that only watches sends nothing. One client at a time has control of a flight.
"""

from typing import Annotated, Literal

from pydantic import Field

from relguide.contract.crew_lines import Deflection, Ident
from relguide.contract.refusal import Strict


class TakeControl(Strict):
    """Take a pursuer's control from the autopilot, to fly it by hand."""

    kind: Literal["take_control"]
    """Which frame it is."""
    director: bool = True
    """Whether the flight director's bars are shown meanwhile."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class StickMove(Strict):
    """Move the stick.

    Sent as it moves, 20 times a second at most, and each 0.2 s while it is held out of neutral:
    after 0.5 s without one the stick is neutral.
    """

    kind: Literal["stick"]
    """Which frame it is."""
    roll: Deflection
    """1 asks for the type's full rate of roll to the right, -1 to the left, 0 keeps the bank."""
    pitch: Deflection = 0.0
    """1 pulls up with 0.1 g, -1 pushes down with as much, 0 keeps the rate of climb."""


class GiveBack(Strict):
    """Give control back to the autopilot."""

    kind: Literal["give_back"]
    """Which frame it is."""


Upstream = Annotated[TakeControl | StickMove | GiveBack, Field(discriminator="kind")]
"""What a client may send."""


class ControlAnswer(Strict):
    """A frame to the one client that has asked for control, or has had it."""

    kind: Literal["control"]
    """Which frame it is: all others are ticks."""
    yours: bool
    """Whether this client has control now."""
    message: str
    """What became of it, in a sentence."""
