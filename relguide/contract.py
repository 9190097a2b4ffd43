"""The contract: everything outsiders send and get, as strict JSON in which each name says its unit.

situations      `situation_from_json`                      `bodies.py`
documents       `to_wire`, `dumps`, `from_wire`            `wire.py`, `messages.py`
plans           `plan_to_wire`                             `bodies.py`
stream          `Tick`, `tick`, `PROTOCOL`                 `messages.py`, `wire.py`, here
flights         `FlightRequest`, `FlightStatus`, `Command` `messages.py`
refusals        `ContractError`                            `refusal.py`
browser's types `typescript_body`                          `typescript.py`
"""

from hashlib import sha256
from typing import Any, Literal

from relguide.bodies import Anchor as Anchor
from relguide.bodies import NamedSituationBody as NamedSituationBody
from relguide.bodies import Piece
from relguide.bodies import SituationBody as SituationBody
from relguide.bodies import Unanchored as Unanchored
from relguide.bodies import plan_to_wire as plan_to_wire
from relguide.bodies import situation_from_body as situation_from_body
from relguide.bodies import situation_from_json as situation_from_json
from relguide.documents import Direction, LeaderChange, Mode, PlanReason
from relguide.messages import Command as Command
from relguide.messages import DocumentModel as DocumentModel
from relguide.messages import FlightList as FlightList
from relguide.messages import FlightRequest as FlightRequest
from relguide.messages import FlightStatus as FlightStatus
from relguide.messages import LeaderHeadingCommand as LeaderHeadingCommand
from relguide.messages import LeaderSpeedCommand as LeaderSpeedCommand
from relguide.messages import PathSegmentModel, ReferenceModel
from relguide.messages import PauseCommand as PauseCommand
from relguide.messages import PlanAnswer as PlanAnswer
from relguide.messages import PlayCommand as PlayCommand
from relguide.messages import ScenarioFlightRequest as ScenarioFlightRequest
from relguide.messages import ScenarioInfo as ScenarioInfo
from relguide.messages import ScenarioList as ScenarioList
from relguide.messages import SetIntentKnownCommand as SetIntentKnownCommand
from relguide.messages import SetRateCommand as SetRateCommand
from relguide.messages import SituationFlightRequest as SituationFlightRequest
from relguide.messages import Tick as Tick
from relguide.messages import from_wire as from_wire
from relguide.messages import model_of as model_of
from relguide.plan import PlannerName, Proof, Reason
from relguide.refusal import ContractError as ContractError
from relguide.refusal import parse as parse
from relguide.typescript import typescript
from relguide.wire import dumps as dumps
from relguide.wire import tick as tick
from relguide.wire import to_wire as to_wire

_ALIASES: dict[str, tuple[Any, str]] = {
    "Direction": (Direction, "Which way round."),
    "Mode": (
        Mode,
        "heading: nothing to fly, holds its heading; converge: flies the plan; capture: closes\n"
        "onto the leader's route at its own speed; follow: on the route at D, speed matched.",
    ),
    "PlannerName": (PlannerName, "Who made the plan."),
    "Proof": (Proof, "Why a plan is optimal."),
    "PlanReason": (PlanReason, "Why a new plan was made."),
    "LeaderChange": (LeaderChange, "What the leader does anew."),
    "Reason": (Literal[tuple(r.value for r in Reason)], "Why there is no plan."),
    "PathSegment": (PathSegmentModel, "A piece of a path over the ground."),
    "ReferenceCard": (ReferenceModel, "What guidance asks of the autopilot."),
    "Document": (DocumentModel, "What a flight says of itself."),
    "PlanAnswer": (PlanAnswer, "The answer to a situation."),
    "IntentPiece": (Piece, "A piece of the leader's intent."),
    "FlightRequest": (FlightRequest, "What starts a flight."),
    "Command": (Command, "What a flight can be told."),
}
_ROOTS = (Tick, SituationBody, ScenarioList, FlightList)


def typescript_body(*, docs: bool) -> str:
    """The browser's types, without the protocol's name."""
    return typescript(_ALIASES, _ROOTS, docs=docs)


def protocol(body: str) -> str:
    """The stream's sub-protocol for types written so."""
    return f"relguide-{sha256(body.encode()).hexdigest()[:12]}"


PROTOCOL = protocol(typescript_body(docs=False))
"""Sub-protocol of the stream: changes whenever a shape of the contract does."""
