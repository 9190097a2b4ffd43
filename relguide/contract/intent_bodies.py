"""What an aircraft declares that it will fly, as outsiders send it."""

from collections.abc import Mapping, Sequence
from math import radians
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from relguide.contract.accepted import Accepted
from relguide.contract.compass import heading_of
from relguide.contract.places import Altitude, Heading
from relguide.contract.refusal import Strict
from relguide.flying.plan_documents import Direction
from relguide.planning import limits
from relguide.planning.intent import ChangeLevel, FlyStraight, IntentPiece, SpeedRule, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT

Bank = Annotated[float, Accepted(limits.BANK)]
ClimbRate = Annotated[float, Accepted(limits.VERTICAL_RATE)]


class StraightPiece(Strict):
    """A piece of intent: keep the heading."""

    straight_s: Annotated[float, Accepted(limits.PIECE)]
    """For how long."""


class TurnPiece(Strict):
    """A piece of intent: turn at constant bank."""

    turn_to_heading_deg: Heading
    """Heading to roll out on, clockwise from true north."""
    direction: Direction
    """Which way round."""
    bank_deg: Bank
    """Bank of the turn."""


class LevelChange(Strict):
    """A climb or a descent to a level."""

    to_altitude_m: Altitude
    """Pressure altitude to level off at."""
    rate_mps: ClimbRate
    """How fast to climb or to descend."""
    hold: SpeedRule = "cas"
    """What is kept meanwhile; `cas` goes over to Mach number, and back, where the two cross."""


class LevelChangePiece(Strict):
    """A piece of intent: begin to change the level. The pieces behind it are flown meanwhile."""

    level_change: LevelChange
    """Where to, and how; it takes the place of a change that is not over."""


_TURN_FIELDS = frozenset(TurnPiece.model_fields)


def _which_piece(value: Any) -> str:
    if isinstance(value, Mapping):
        if "level_change" in value:
            return "#level"
        return "#straight" if value.keys().isdisjoint(_TURN_FIELDS) else "#turn"
    if isinstance(value, LevelChangePiece):
        return "#level"
    return "#turn" if isinstance(value, TurnPiece) else "#straight"


PieceBody = StraightPiece | TurnPiece | LevelChangePiece
Piece = Annotated[
    Annotated[StraightPiece, Tag("#straight")]
    | Annotated[TurnPiece, Tag("#turn")]
    | Annotated[LevelChangePiece, Tag("#level")],
    Discriminator(_which_piece),
]
Intent = Annotated[list[Piece], Field(max_length=limits.MAX_PIECES)]


def intent_from_body(
    pieces: Sequence[PieceBody], *, turned_deg: float = 0.0
) -> tuple[IntentPiece, ...]:
    """What an aircraft declares or flies.

    Args:
        pieces: their headings are from true north where the aircraft is.
        turned_deg: what makes those headings of the world frame [°].
    """
    return tuple(_piece(piece, turned_deg) for piece in pieces)


def _piece(body: PieceBody, turned_deg: float) -> IntentPiece:
    match body:
        case StraightPiece():
            return FlyStraight(duration=body.straight_s)
        case TurnPiece():
            return TurnTo(
                heading=heading_of(body.turn_to_heading_deg + turned_deg),
                turn=LEFT if body.direction == "left" else RIGHT,
                bank=radians(body.bank_deg),
            )
        case LevelChangePiece(level_change=change):
            return ChangeLevel(
                to_altitude=change.to_altitude_m, rate=change.rate_mps, hold=change.hold
            )
