"""The contract as the browser gets it: its types, and a name that changes when they do."""

from hashlib import sha256
from typing import Any, Literal

from relguide.atc.clearances import Actor, State
from relguide.atc.documents import DeviationKind, DeviationLevel, ReasonCode
from relguide.atc.documents import Verdict as AtcVerdict
from relguide.contract.area_bodies import AreaAnswer, AreaRequest
from relguide.contract.bodies import SituationBody
from relguide.contract.clearance_bodies import (
    AtcFrame,
    ClearanceAnswer,
    ClearanceList,
    ClearanceReply,
    ClearanceRequest,
    ClearanceTrial,
    SpacingGoal,
)
from relguide.contract.commands import Command
from relguide.contract.crew_lines import CrewOrderLine
from relguide.contract.document_models import (
    AlternativeModel,
    AtcDocumentModel,
    DocumentModel,
    PathSegmentModel,
    PlanAnswer,
    ReferenceModel,
)
from relguide.contract.intent_bodies import Piece
from relguide.contract.messages import (
    FlightList,
    FlightRequest,
    PlannerComparison,
    ScenarioList,
    Tick,
)
from relguide.contract.order_lines import OrderLine
from relguide.contract.typescript import typescript
from relguide.contract.upstream import ControlAnswer, Upstream
from relguide.flying.aircraft_documents import AlertLevel, AlertState, Spacing
from relguide.flying.documents import (
    AlertSubject,
    ClearanceStatus,
    Engagement,
    Fault,
    LeaderChange,
    Mode,
    PlanReason,
    UnableReason,
)
from relguide.flying.plan_documents import Direction
from relguide.flying.verdicts import ComparedPlanner, Verdict
from relguide.planning.outcome import Proof, Reason

_ALIASES: dict[str, tuple[Any, str]] = {
    "Direction": (Direction, "Which way round."),
    "Mode": (
        Mode,
        "heading: no plan, a heading is held; converge: the plan is flown; capture: closes onto\n"
        "the leader's route under speed control; follow: on the route D behind the leader, at\n"
        "its speed; escape: turns away, as the separation would be lost on what was flown.",
    ),
    "Engagement": (
        Engagement,
        "off: nobody is to be joined; designated: paths to the leader's slot are proposed; armed:\n"
        "the proposal is accepted, and waits; engaged: guidance flies.",
    ),
    "Proof": (Proof, "Why a plan is optimal."),
    "PlanReason": (PlanReason, "Why a new plan was made."),
    "LeaderChange": (LeaderChange, "What is new about the leader."),
    "ClearanceStatus": (
        ClearanceStatus,
        "What became of a manoeuvre that was sent to air traffic control.",
    ),
    "Spacing": (Spacing, "What a link keeps once joined: a distance, or a time."),
    "AlertLevel": (
        AlertLevel,
        "advisory: to be known; caution: to be seen to at once; warning: to be acted upon at once.",
    ),
    "AlertState": (AlertState, "The highest level among the alerts that stand."),
    "AlertSubject": (AlertSubject, "What an alert is about."),
    "UnableReason": (UnableReason, "Why guidance cannot do what it is to do."),
    "ComparedPlanner": (ComparedPlanner, "A planner that is compared with others."),
    "Verdict": (Verdict, "Whether a planner's own path may be flown."),
    "Fault": (Fault, "What is wrong with a planner's plan."),
    "Reason": (Literal[tuple(r.value for r in Reason)], "Why there is no plan."),
    "PathSegment": (PathSegmentModel, "A piece of a path over the ground."),
    "Alternative": (AlternativeModel, "Another path to the slot, and why it is not flown."),
    "ReferenceCard": (ReferenceModel, "What guidance asks of the autopilot."),
    "Document": (DocumentModel, "A document of a flight."),
    "PlanAnswer": (PlanAnswer, "The answer to a situation."),
    "IntentPiece": (Piece, "A piece of the leader's intent."),
    "FlightRequest": (FlightRequest, "A request for a new flight."),
    "CrewOrderLine": (CrewOrderLine, "What a crew orders, and when."),
    "OrderLine": (OrderLine, "An order at a flight time."),
    "Command": (Command, "A command to a flight."),
    "Upstream": (Upstream, "What a client may send up a flight's stream."),
    "Actor": (Actor, "Who brings a clearance from one state to another."),
    "ClearanceState": (State, "How far a clearance has come."),
    "ValidationVerdict": (AtcVerdict, "What automation finds of a manoeuvre."),
    "ReasonCode": (ReasonCode, "Why a manoeuvre is not acceptable, or a clearance ends."),
    "DeviationKind": (DeviationKind, "In what an aircraft is not where it is cleared to be."),
    "DeviationLevel": (DeviationLevel, "How far."),
    "SpacingGoal": (SpacingGoal, "What is kept behind the traffic."),
    "ClearanceRequest": (ClearanceRequest, "A request for a clearance."),
    "AtcDocument": (AtcDocumentModel, "What the controllers' stream brings."),
}
_ROOTS = (
    Tick, ControlAnswer, SituationBody, ScenarioList, FlightList, AreaRequest, AreaAnswer,
    PlannerComparison, AtcFrame, ClearanceAnswer, ClearanceList, ClearanceReply, ClearanceTrial,
)  # fmt: skip


def typescript_body(*, docs: bool) -> str:
    """The browser's types, without the protocol's name."""
    return typescript(_ALIASES, _ROOTS, docs=docs)


def protocol(body: str) -> str:
    """The name of the stream's sub-protocol for these types."""
    return f"relguide-{sha256(body.encode()).hexdigest()[:12]}"


PROTOCOL = protocol(typescript_body(docs=False))
"""Sub-protocol of the stream: it changes whenever a shape of the contract does."""
STREAM = "relguide-stream-2"
"""Another name of it, for programs: it changes only when something that it had is no more, or means
something else. What is new may be added under the same name."""
ATC_STREAM = "relguide-atc-1"
"""The same of the controllers' stream."""
