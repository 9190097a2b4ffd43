"""Documents and cards read back from JSON, by models that are made from their dataclasses.

The rules are those of `wire.py`: one source for reading them back, for the OpenAPI document and for
the browser's types.
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
    Field,
    TypeAdapter,
    ValidationError,
    create_model,
)

from relguide.atc.documents import AtcDocument
from relguide.contract.refusal import Strict, loads, refusal
from relguide.contract.wire import WireField, wire_fields
from relguide.flying.aircraft_documents import ReferenceCard
from relguide.flying.documents import Document
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
from relguide.flying.verdicts import OptimalityCheck

Card = TypeVar("Card")
Extra = Literal["forbid", "ignore"]
"""What to do with fields that are not known: a newer program's are ignored by who only reads."""
_TAGS = ("kind", "status", "rejected")


def no_default(schema: dict[str, Any]) -> None:
    """Of a field that is left out, never null: say no default of it."""
    del schema["default"]


_GEODETIC = Field(
    default=None,
    description="WGS84; there if the situation came with latitudes.",
    json_schema_extra=no_default,
)
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
                json_schema_extra=no_default if f.left_out else None,
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
            Field(default=None, description=described, json_schema_extra=no_default),
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
                default=None, description=f"{f.doc}\nIf asked for.", json_schema_extra=no_default
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
        raise refusal(error, content, _DOCUMENT.core_schema) from None
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
        raise refusal(error, content, _plan_answers().core_schema) from None
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
        schema = model_of(card_type).__pydantic_core_schema__
        raise refusal(error, content, schema) from None
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
