"""A pilot model that flies by hand, as outsiders ask for it."""

from collections.abc import Mapping
from math import degrees, radians
from typing import Annotated, Any

from pydantic import Discriminator, Tag

from relguide.contract.accepted import Accepted
from relguide.contract.refusal import Strict
from relguide.flying.dispersion import disperse_pilot
from relguide.flying.pilot_model import (
    BANDWIDTH,
    DELAY,
    REACTION,
    REMNANT,
    THRESHOLD,
    PilotModel,
)

_USUAL = PilotModel()


class PilotBody(Strict):
    """The constants of the crossover model; those left out are as pilots were found to have."""

    bandwidth_radps: Annotated[float, Accepted(BANDWIDTH)] = _USUAL.bandwidth
    """ω_c, how fast it takes errors away [rad/s]."""
    delay_s: Annotated[float, Accepted(DELAY)] = _USUAL.delay
    """τ, how late it does so."""
    remnant_share: Annotated[float, Accepted(REMNANT)] = _USUAL.remnant
    """Variance of the noise that it adds over that of the errors that it sees."""
    threshold_deg: Annotated[float, Accepted(THRESHOLD)] = round(degrees(_USUAL.threshold), 9)
    """An error of the bank that it lets stand."""
    reaction_s: Annotated[float, Accepted(REACTION)] = _USUAL.reaction
    """How long after an announcement it begins to answer the bar."""


def _which(value: Any) -> str:
    return "#pilot" if isinstance(value, Mapping | PilotBody) else "#switch"


ByHand = Annotated[
    Annotated[bool, Tag("#switch")] | Annotated[PilotBody, Tag("#pilot")], Discriminator(_which)
]
"""Whether a pilot model flies by hand, and which."""


def pilot_to_body(pilot: PilotModel) -> dict[str, float]:
    """How a pilot model is asked for.

    Raises:
        ValueError: if it looks ahead, which none that is asked for does.
    """
    if pilot.lead != 0.0:
        raise ValueError(f"lead must be 0 s for a pilot of the service, not {pilot.lead:g} s.")
    return {
        "bandwidth_radps": pilot.bandwidth,
        "delay_s": pilot.delay,
        "remnant_share": pilot.remnant,
        "threshold_deg": degrees(pilot.threshold),
        "reaction_s": pilot.reaction,
    }


def pilot_of(wanted: ByHand, seed: int) -> PilotModel | None:
    """The pilot model that is asked for; `None` where the autopilot flies.

    Args:
        wanted: whether one flies, and which; without constants it is drawn as its aircraft is.
        seed: of the flight.
    """
    if not isinstance(wanted, PilotBody):
        return disperse_pilot(_USUAL, seed) if wanted else None
    return PilotModel(
        bandwidth=wanted.bandwidth_radps,
        delay=wanted.delay_s,
        remnant=wanted.remnant_share,
        threshold=radians(wanted.threshold_deg),
        reaction=wanted.reaction_s,
    )
