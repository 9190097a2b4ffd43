"""What the browser is told of the contract: its types, and a name that changes whenever they do."""

from hashlib import sha256
from typing import Any, Literal

from relguide.contract.area_bodies import AreaAnswer
from relguide.contract.bodies import Piece, SituationBody
from relguide.contract.messages import (
    AlternativeModel,
    Command,
    DocumentModel,
    FlightList,
    FlightRequest,
    PathSegmentModel,
    PlanAnswer,
    ReferenceModel,
    ScenarioList,
    Tick,
)
from relguide.contract.typescript import typescript
from relguide.flying.documents import Direction, LeaderChange, Mode, PlanReason
from relguide.planning.plan import Proof, Reason

_ALIASES: dict[str, tuple[Any, str]] = {
    "Direction": (Direction, "Which way round."),
    "Mode": (
        Mode,
        "heading: nothing to fly, holds its heading; converge: flies the plan; capture: closes\n"
        "onto the leader's route at its own speed; follow: on the route at D, speed matched.",
    ),
    "Proof": (Proof, "Why a plan is optimal."),
    "PlanReason": (PlanReason, "Why a new plan was made."),
    "LeaderChange": (LeaderChange, "What the leader does anew."),
    "Reason": (Literal[tuple(r.value for r in Reason)], "Why there is no plan."),
    "PathSegment": (PathSegmentModel, "A piece of a path over the ground."),
    "Alternative": (AlternativeModel, "Another way to the slot, and why it is not flown."),
    "ReferenceCard": (ReferenceModel, "What guidance asks of the autopilot."),
    "Document": (DocumentModel, "What a flight says of itself."),
    "PlanAnswer": (PlanAnswer, "The answer to a situation."),
    "IntentPiece": (Piece, "A piece of the leader's intent."),
    "FlightRequest": (FlightRequest, "What starts a flight."),
    "Command": (Command, "What a flight can be told."),
}
_ROOTS = (Tick, SituationBody, ScenarioList, FlightList, AreaAnswer)


def typescript_body(*, docs: bool) -> str:
    """The browser's types, without the protocol's name."""
    return typescript(_ALIASES, _ROOTS, docs=docs)


def protocol(body: str) -> str:
    """The stream's sub-protocol for types written so."""
    return f"relguide-{sha256(body.encode()).hexdigest()[:12]}"


PROTOCOL = protocol(typescript_body(docs=False))
"""Sub-protocol of the stream: changes whenever a shape of the contract does."""
