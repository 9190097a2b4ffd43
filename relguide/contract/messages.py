"""Documents read back from JSON, the ticks of the stream, and the requests and answers of flights.

The models of the documents are made from their dataclasses by the rules of `wire.py`: one source
for reading them back, for the OpenAPI document and for the browser's types.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, make_dataclass
from enum import Enum
from functools import cache, reduce
from operator import or_
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    Protocol,
    TypeVar,
    Union,
    get_args,
    get_origin,
    runtime_checkable,
)

from pydantic import (
    BaseModel,
    Discriminator,
    Field,
    Tag,
    TypeAdapter,
    ValidationError,
    create_model,
    field_validator,
    model_validator,
)

from relguide.atc.documents import AtcDocument
from relguide.contract.commands import Rate
from relguide.contract.crew_lines import CrewOrderLine, StickOrder
from relguide.contract.flown_bodies import FlownSituationBody
from relguide.contract.intent_bodies import Intent
from relguide.contract.order_lines import OrderLine
from relguide.contract.other_bodies import Ident
from relguide.contract.pilot_bodies import ByHand
from relguide.contract.refusal import Strict, loads, refusal
from relguide.contract.wire import WireField, wire_fields
from relguide.flying.aircraft_documents import ReferenceCard
from relguide.flying.documents import Document, EndReason, Engagement, Mode
from relguide.flying.plan_documents import (
    AnyAlternativeCard,
    FlownCard,
    NoPlanCard,
    NotFlownCard,
    OptimalityCard,
    OtherPathCard,
    PathSegment,
    PlanCard,
)
from relguide.flying.verdicts import OptimalityCheck, PlannerVerdict
from relguide.planning.limits import SPACING

Card = TypeVar("Card")
Extra = Literal["forbid", "ignore"]
"""What to do with fields that are not known: a newer program's are ignored by who only reads."""
_TAGS = ("kind", "status", "rejected")


def _no_default(schema: dict[str, Any]) -> None:
    del schema["default"]  # the field is left out, never null


_GEODETIC = Field(
    default=None,
    description="WGS84; there if the situation came with latitudes.",
    json_schema_extra=_no_default,
)
_OF_SNAPSHOTS = Field(default="", json_schema_extra=_no_default)
_MODELS: dict[type[Any], type[BaseModel]] = {}
_DATACLASSES: dict[type[BaseModel], type[Any]] = {}
_PLACED: dict[type[Any], type[Any]] = {}


def model_of(document_type: type[Any]) -> type[BaseModel]:
    """The JSON shape of a document or card."""
    if (known := _MODELS.get(document_type)) is not None:
        return known
    members: dict[str, Any] = {
        f.wire_name: (
            _json_type(f.annotation),
            Field(
                f.missing,
                description=f.doc or None,
                json_schema_extra=_no_default if f.left_out else None,
            ),
        )
        for f in wire_fields(document_type)
    }
    if document_type is PlanCard:
        others, described = members["alternatives"]
        members["alternatives"] = (
            others,
            Field(default_factory=list, description=described.description),
        )
        drawn = "The other paths to be drawn, the fastest first.\nIf asked for."
        members["others"] = (
            list[_json_type(OtherPathCard)],  # type: ignore[misc]
            Field(default_factory=list, description=drawn),
        )
        described = "The flight of it, with guidance engaged at once.\nIf asked for."
        members["flown"] = (
            _json_type(FlownCard | NotFlownCard),
            Field(default=None, description=described, json_schema_extra=_no_default),
        )
    if {"x_m", "y_m"} <= members.keys():
        kind = members["x_m"][0]  # of a point, or columns of many
        members |= {name: (kind, _GEODETIC) for name in ("lat_deg", "lon_deg")}
    if document_type is OptimalityCard:
        members |= _optional_members(OptimalityCheck)
    model = create_model(
        document_type.__name__, __base__=Strict, __doc__=document_type.__doc__, **members
    )
    model.always_written = frozenset(f.wire_name for f in wire_fields(document_type) if f.promised)
    _MODELS[document_type], _DATACLASSES[model] = model, document_type
    return model


def _optional_members(document_type: type[Any]) -> dict[str, Any]:
    """The members of a card that are added to another card on request."""
    return {
        f.wire_name: (
            _json_type(f.annotation),
            Field(
                default=None, description=f"{f.doc}\nIf asked for.", json_schema_extra=_no_default
            ),
        )
        for f in wire_fields(document_type)
    }


def _json_type(annotation: Any) -> Any:
    origin = get_origin(annotation)
    if origin is tuple:
        return list[_json_type(get_args(annotation)[0])]  # type: ignore[misc]
    if origin in (UnionType, Union):
        members = tuple(m for m in get_args(annotation) if m is not NoneType)
        if len(members) == 1:
            return _json_type(members[0])  # it is left out where there is none, never null
        (tag,) = [t for t in _TAGS if all(_tag_field(m) == t for m in members)]
        return Annotated[reduce(or_, map(model_of, members)), Field(discriminator=tag)]
    if is_dataclass(annotation):
        assert isinstance(annotation, type)
        return model_of(annotation)
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return Literal[tuple(member.value for member in annotation)]
    return annotation


def _tag_field(document_type: type[Any]) -> str:
    (tag,) = [f.name for f in wire_fields(document_type) if f.name in _TAGS]
    return tag


DocumentModel: Any = _json_type(Document)
"""Any document of a flight."""
PlanAnswer: Any = _json_type(PlanCard | NoPlanCard)
"""The answer to a situation."""
PathSegmentModel: Any = _json_type(PathSegment)
"""A piece of a path over the ground."""
AlternativeModel: Any = _json_type(AnyAlternativeCard)
"""Another path to the slot, and why it is not flown."""
AtcDocumentModel: Any = _json_type(AtcDocument)
"""What the controllers' stream brings."""
ReferenceModel: Any = _json_type(ReferenceCard)
"""What guidance asks of the autopilot."""
_DOCUMENT: TypeAdapter[BaseModel] = TypeAdapter(DocumentModel)
_KINDS = {
    field.default
    for document_type in get_args(Document)
    for field in fields(document_type)
    if field.name == "kind"
}

MAX_ORDERS = 1000
"""Most orders that a request for a flight has beside sticks, and most lines of a crew's script."""
MAX_STICKS = 36_000
"""Most sticks that it has: ten a second for an hour."""
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]
"""Accepted seeds of a flight's random numbers."""
SpacingTime = Annotated[float, Field(gt=0.0, le=SPACING.high)]
"""Accepted times behind the leader [s]."""


def from_wire(source: bytes | str | Mapping[str, object], *, extra: Extra = "forbid") -> Document:
    """Read a document back from its JSON. A point with latitude and longitude is a `Placed` one.

    Args:
        source: its JSON.
        extra: what to do with fields that are not known.

    Raises:
        ContractError: naming each field that is wrong.
    """
    content = loads(source) if isinstance(source, bytes | str) else source
    try:
        model = _DOCUMENT.validate_python(content, extra=extra)
    except ValidationError as error:
        raise refusal(error, content) from None
    document: Document = _from_model(model)
    return document


def plan_from_wire(
    source: bytes | str | Mapping[str, object], *, extra: Extra = "forbid"
) -> PlanCard | NoPlanCard:
    """Read the answer to a situation back from its JSON, as `from_wire`.

    Raises:
        ContractError: naming each field that is wrong.
    """
    content = loads(source) if isinstance(source, bytes | str) else source
    try:
        model = _plan_answers().validate_python(content, extra=extra)
    except ValidationError as error:
        raise refusal(error, content) from None
    answer: PlanCard | NoPlanCard = _from_model(model)
    return answer


@cache
def _plan_answers() -> TypeAdapter[Any]:
    return TypeAdapter(PlanAnswer)


def card_from_wire(
    card_type: type[Card], source: bytes | str | Mapping[str, object], *, extra: Extra = "forbid"
) -> Card:
    """Read a card of that type back from its JSON, as `from_wire`.

    Raises:
        ContractError: naming each field that is wrong.
    """
    content = loads(source) if isinstance(source, bytes | str) else source
    try:
        model = model_of(card_type).model_validate(content, extra=extra)
    except ValidationError as error:
        raise refusal(error, content) from None
    card: Card = _from_model(model)
    return card


def _from_model(model: BaseModel) -> Any:
    document_type = _DATACLASSES[type(model)]
    members = {f.name: _decode(f, getattr(model, f.wire_name)) for f in wire_fields(document_type)}
    lat, lon = getattr(model, "lat_deg", None), getattr(model, "lon_deg", None)
    if lat is None or lon is None:
        return document_type(**members)
    kind = type(lat) if isinstance(lat, float) else tuple
    return _placed(document_type)(**members, lat_deg=kind(lat), lon_deg=kind(lon))


def _placed(document_type: type[Any]) -> type[Any]:
    """A document type with a place on the earth."""
    if (known := _PLACED.get(document_type)) is not None:
        return known
    made = make_dataclass(
        document_type.__name__,
        [(name, float) for name in ("lat_deg", "lon_deg")],
        bases=(document_type,),
        namespace={"__doc__": document_type.__doc__, "__module__": document_type.__module__},
        frozen=True,
        slots=True,
        kw_only=True,
    )
    return _PLACED.setdefault(document_type, made)


def _decode(field: WireField, value: Any) -> Any:
    if isinstance(value, BaseModel):
        return _from_model(value)
    if isinstance(value, list):
        plain = field.annotation in (tuple[float, ...], tuple[str, ...])
        return tuple(map(field.decode_number if plain else _from_model, value))
    if isinstance(field.annotation, type) and issubclass(field.annotation, Enum):
        return field.annotation(value)
    return field.decode_number(value)


@runtime_checkable
class Placed(Protocol):
    """What has a place on the earth (WGS84); of columns of points each is a tuple."""

    @property
    def lat_deg(self) -> Any:
        """Latitude [°]."""

    @property
    def lon_deg(self) -> Any:
        """Longitude [°]."""


def knows(content: Mapping[str, object]) -> bool:
    """Whether an object in JSON is a kind of document that `from_wire` reads."""
    return content.get("kind") in _KINDS


class Tick(Strict):
    """A frame of the stream: what happened in a flight since the last one."""

    kind: Literal["tick"]
    flight_id: str
    t_s: float
    """Flight time now."""
    rate: float
    """Simulated seconds per second."""
    paused: bool
    ended: bool
    documents: list[DocumentModel]
    """Since the last tick, in order; of several samples only the newest."""
    started_at: str = _OF_SNAPSHOTS
    """When the flight began by the wall clock, RFC 3339, UTC; of a recording, when it was flown.
    In a snapshot, as is `version`."""
    version: str = _OF_SNAPSHOTS
    """Of the software that flies it."""


class PlannerComparison(Strict):
    """What planners would fly in one situation."""

    planners: list[model_of(PlannerVerdict)]  # type: ignore[valid-type]
    """`exact`, `network`, `regular_dp` and `printed_network`, in this order."""


class ScenarioInfo(Strict):
    """A scenario that can be flown."""

    name: str
    """To start it by."""
    title: str
    """For people."""
    description: str
    """What it shows."""
    available: bool
    """Whether what it needs is installed."""
    message: str
    """If it is not available, what to install."""


class ScenarioList(Strict):
    """All scenarios."""

    scenarios: list[ScenarioInfo]
    """The paper's, and ours."""


class _HowToFly(Strict):
    """What may be asked of any flight."""

    rate: Rate = 1.0
    """Simulated seconds per second."""
    paused: bool = False
    """Whether it waits for the command `play`."""
    intent_known: bool | None = None
    """Whether the pursuer knows the leader's intent; if left out, as the scenario says. Of a
    situation of your own it does."""
    engagement: Engagement = "engaged"
    """How far guidance is engaged at the start."""
    seed: Seed = 0
    """0 flies the type as its data say; any other draws its constants, unknown to its guidance, and
    those of a pilot model that is asked for without any."""
    spacing_time_s: SpacingTime | None = None
    """Time behind the leader to keep once joined; if left out, D is kept."""
    by_hand: ByHand = False
    """Whether a pilot model flies the pursuer by hand, along the flight director's bars; its
    constants, if they are not those that pilots were found to have."""
    orders: list[OrderLine] = Field(default_factory=list, max_length=MAX_ORDERS + MAX_STICKS)
    """What aircraft are ordered at flight times, in order of time: at most 36,000 sticks, an hour
    of flying by hand, and at most 1,000 others."""
    crew: Annotated[list[CrewOrderLine] | None, Field(max_length=MAX_ORDERS)] = None
    """The script of a crew that reacts. Guidance is off at the start, unless `engagement` or the
    first line, an engagement at 0 s, says otherwise."""

    @field_validator("orders", mode="before")
    @classmethod
    def _expect_readable(cls, lines: Any) -> Any:
        most = MAX_ORDERS + MAX_STICKS
        if isinstance(lines, list) and len(lines) > most:  # before each of them is read
            raise ValueError(f"must have at most {most:,} entries, not {len(lines):,}.")
        return lines

    @field_validator("orders")
    @classmethod
    def _expect_not_too_many(cls, lines: list[Any]) -> list[Any]:
        sticks = sum(isinstance(line, StickOrder) for line in lines)
        if sticks > MAX_STICKS:
            raise ValueError(f"must have at most {MAX_STICKS:,} sticks, not {sticks:,}.")
        if len(lines) - sticks > MAX_ORDERS:
            others = len(lines) - sticks
            raise ValueError(f"must have at most {MAX_ORDERS:,} beside sticks, not {others:,}.")
        return lines


class ScenarioFlightRequest(_HowToFly):
    """Start a flight of a scenario."""

    scenario: Annotated[str, Field(max_length=100)]
    """Its name."""

    @model_validator(mode="before")
    @classmethod
    def _expect_a_flight(cls, value: Any) -> Any:
        if isinstance(value, Mapping) and "scenario" not in value:
            raise ValueError("must have a scenario, by its name, or a situation of your own.")
        return value


class SituationFlightRequest(_HowToFly):
    """Start a flight from a situation of your own."""

    situation: FlownSituationBody
    """As `POST /plans` takes it, and what only a flight depends on."""
    flown_intent: Intent | None = None
    """What the leader flies if that is not what it declares in `situation`: it breaks its word."""
    reported_leader: Ident | None = None
    """The aircraft of the picture of air traffic that is the leader: it begins, and flies, as that
    one is reported, whatever place `situation` gives. The situation is on the earth, and the flight
    is flown at rate 1."""


def _which_request(value: Any) -> str:
    own = isinstance(value, SituationFlightRequest) or (
        isinstance(value, Mapping) and "situation" in value
    )
    return "#situation" if own else "#scenario"


FlightRequest = Annotated[
    Annotated[ScenarioFlightRequest, Tag("#scenario")]
    | Annotated[SituationFlightRequest, Tag("#situation")],
    Discriminator(_which_request),
]
"""A request for a new flight."""


FlightOutcome = Literal["", "broken", "stopped", EndReason]
"""Why a flight is over; empty while it flies."""


class FlightStatus(Strict):
    """Where a flight stands."""

    id: str
    """To ask for it by."""
    scenario: str
    """Its name; empty for a situation of your own."""
    title: str
    """For people."""
    t_s: float
    """Flight time."""
    rate: float
    """Simulated seconds per second."""
    paused: bool
    """Whether it waits for `play`."""
    ended: bool
    """Whether it is over."""
    outcome: FlightOutcome
    """Why: broken: by a mistake of the server; stopped: nothing follows, as at the end of a
    recording that was cut short; the others as in `flight_ended`. Empty while it flies."""
    started_at: str
    """When it began by the wall clock, RFC 3339, UTC; of a recording, when it was flown."""
    mode: Mode
    """What guidance does now."""
    engagement: Engagement
    """How far the crew has engaged guidance."""
    joined: bool
    """Whether the pursuer has joined."""
    separation_m: float
    """Between pursuer and leader now."""
    stream_url: str
    """Path of its WebSocket."""
    scene_url: str
    """Path of its 3D scene."""
    seed: int
    """Of its random numbers, as asked for: with the same version it gives the same flight."""
    version: str
    """Of the software that flies it."""
    recorded: bool
    """Whether it is on record: `GET /records/flights/{id}` knows it."""


class FlightList(Strict):
    """All flights."""

    flights: list[FlightStatus]
    """In the order they were started; of several processes, one after the other."""
    missing: list[str] = Field(default_factory=list)
    """Letters of the processes that did not answer; left out if all did."""
