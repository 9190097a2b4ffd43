"""Regular trajectories as outsiders enter them: the paper's triplets (ε_i, θ_i, l_i)."""

from collections.abc import Mapping
from math import radians
from typing import Annotated

from pydantic import Field

from relguide.contract.refusal import ContractError, Strict, parse
from relguide.planning.regular import RegularTrajectory, Triplet
from relguide.planning.trajectory import LEFT, RIGHT

MAX_TRIPLETS = 100
"""Most pairs of a regular trajectory."""


class TripletBody(Strict):
    """A turn at nominal bank, then a straight."""

    epsilon: Annotated[int, Field(ge=-1, le=1)]
    """ε: +1 turns left, −1 right."""
    theta_deg: Annotated[float, Field(ge=0.0, le=3600.0)]
    """θ: how far it turns."""
    l_m: Annotated[float, Field(ge=0.0, le=10_000_000.0)]
    """l: the straight flown after the turn."""


class RegularBody(Strict):
    """A regular trajectory of order n, by its n − 1 triplets."""

    triplets: Annotated[list[TripletBody], Field(max_length=MAX_TRIPLETS)]
    """Numbered backward from the slot, as the paper does: the first is i = 1, flown last."""


def regular_from_json(source: bytes | str | Mapping[str, object]) -> RegularTrajectory:
    """Read a regular trajectory from JSON text, or from JSON already parsed.

    Raises:
        ContractError: naming each field that is wrong.
    """
    body = parse(RegularBody, source)
    for i, triplet in enumerate(body.triplets):
        if triplet.epsilon == 0:
            message = "must be 1 (left) or -1 (right), not 0."
            raise ContractError([(f"triplets[{i}].epsilon", message)])
    return RegularTrajectory(
        triplets=tuple(
            Triplet(
                turn=LEFT if triplet.epsilon > 0 else RIGHT,
                turn_angle=radians(triplet.theta_deg),
                length=triplet.l_m,
            )
            for triplet in body.triplets
        )
    )
