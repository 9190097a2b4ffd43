"""Documents as JSON, made mechanically from their dataclasses: every name ends with its unit.

A field annotated with a unit of `units.py` gets that unit as suffix (`Metre` → `_m`); radians are
written as degrees (`_deg`, `_degps`), headings and tracks in [0, 360). A trailing underscore of a
Python name is dropped. The field that names a union's member (`kind`, `status`) comes first.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, dataclass, fields, is_dataclass
from enum import Enum
from math import degrees, isfinite, radians
from types import MappingProxyType, UnionType
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Literal,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from pydantic_core import to_json

from relguide.contract.compass import compass
from relguide.contract.docs import field_docs
from relguide.flying.plan_documents import ADDED, LEFT_OUT, PROMISED

if TYPE_CHECKING:  # most of what can be written is never needed where plans are made
    from relguide.atc.documents import AtcDocument, ClearanceCard, TrackCard, ValidationCard
    from relguide.flying.aircraft_documents import (
        AircraftCard,
        AircraftSample,
        ClosestOther,
        FlownByHand,
        GuidanceSample,
        LinkCard,
        LinkResult,
        Loss,
    )
    from relguide.flying.documents import Document
    from relguide.flying.plan_documents import (
        AnyAlternativeCard,
        FlownCard,
        NoPlanCard,
        NotFlownCard,
        OtherPathCard,
        PathPoint,
        PlanCard,
    )
    from relguide.flying.verdicts import OptimalityCheck, PlannerVerdict, RegularCheck

    Card = (
        PlanCard
        | NoPlanCard
        | PathPoint
        | AnyAlternativeCard
        | OtherPathCard
        | FlownCard
        | NotFlownCard
        | PlannerVerdict
        | OptimalityCheck
        | RegularCheck
        | AircraftCard
        | AircraftSample
        | LinkCard
        | GuidanceSample
        | LinkResult
        | Loss
        | ClosestOther
        | FlownByHand
        | AtcDocument
        | ClearanceCard
        | TrackCard
        | ValidationCard
    )
    """Parts of documents that also travel alone."""

SUFFIX = {
    "m": "_m",
    "s": "_s",
    "ms": "_ms",
    "mps": "_mps",
    "rad": "_deg",
    "radps": "_degps",
    "s/m": "_s_per_m",
    "s/rad": "_s_per_deg",
    "1/m": "_per_m",
}
"""Unit of `units.py` → what the JSON name ends in."""
COMPASS = ("heading", "track", "from_")
"""Angles with these names are directions, written in [0, 360)."""
TAGS = ("kind", "status")
"""Fields that say which member of a union this is, and come first."""

Convert = Callable[[Any], Any]
Place = Callable[[float, float], tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class WireField:
    """One field of a document, on both sides of the wire."""

    name: str
    """In Python."""
    wire_name: str
    """In JSON."""
    annotation: Any
    """Its Python type, without the unit."""
    owner: type[Any]
    """The document that has it."""
    encode: Convert
    """Python value → JSON value."""
    decode_number: Convert
    """JSON number → Python number, for angles; the identity for everything else. For a column of
    numbers, that of each member."""
    missing: Any = ...
    """JSON value where a recording of before has none; `...` for a field that is always there."""
    left_out: bool = False
    """Whether it is written only where it is not its default."""
    promised: bool = False
    """Whether it is described as always there, though recordings of before may lack it."""
    default: Any = None
    """In Python, of a field that may be left out."""

    @property
    def doc(self) -> str:
        """Its docstring, or nothing: read from the source when it is asked for.

        Radians are left out of it: the name says degrees.
        """
        said = field_docs(self.owner).get(self.name, "")
        return said.replace(" [rad]", "") if self.wire_name.endswith("_deg") else said


def to_wire(document: "Document | Card") -> dict[str, Any]:
    """A document, or a card of one, as a JSON object.

    Raises:
        ValueError: if a number in it is not finite; JSON has no such numbers.
    """
    written: dict[str, Any] = _encoder(type(document))(document)
    return written


def dumps(document: "Document | Card") -> bytes:
    """A document, or a card of one, as JSON text."""
    return to_json(to_wire(document))


def placed_to_wire(document: "Document | Card", place: Place | None) -> dict[str, Any]:
    """As `to_wire`, with the latitude and longitude of each point.

    Args:
        document: it.
        place: x, y [m] → latitude, longitude [°]; `None` where that is not known.
    """
    written = to_wire(document)
    if place is not None:
        _add_places(written, place)
    return written


def tick(
    flight_id: str,
    *,
    t: float,
    rate: float,
    paused: bool,
    ended: bool,
    documents: "Sequence[Document]",
    place: Place | None = None,
    origin: Mapping[str, str] = MappingProxyType({}),
) -> bytes:
    """One frame of the stream: what happened since the last one, in order, as JSON text.

    Args:
        flight_id: whose stream it is.
        t: flight time now [s].
        rate: simulated seconds per second.
        paused: whether the flight is paused.
        ended: whether it is over.
        documents: since the last tick.
        place: x, y [m] → latitude, longitude [°], which every point then has as well.
        origin: when the flight began and what flies it, for a frame that begins with that.
    """
    written = [to_wire(document) for document in documents]
    if place is not None:
        _add_places(written, place)
    return to_json(
        {
            "kind": "tick",
            "flight_id": flight_id,
            "t_s": _expect_finite(t),
            "rate": _expect_finite(rate),
            "paused": paused,
            "ended": ended,
            "documents": written,
            **origin,
        }
    )


def _add_places(written: Any, place: Place) -> None:
    """Give each point in something written its latitude and longitude."""
    if isinstance(written, list):
        for part in written:
            _add_places(part, place)
    elif isinstance(written, dict):
        for part in written.values():
            _add_places(part, place)
        match written:
            case {"x_m": [*xs], "y_m": [*ys]}:  # columns
                places = [place(x, y) for x, y in zip(xs, ys, strict=True)]
                written["lat_deg"] = [lat for lat, _ in places]
                written["lon_deg"] = [lon for _, lon in places]
            case {"x_m": x, "y_m": y}:
                written["lat_deg"], written["lon_deg"] = place(x, y)


_FIELDS: dict[type[Any], tuple[WireField, ...]] = {}


def wire_fields(document_type: type[Any]) -> tuple[WireField, ...]:
    """The fields of a document type in the order of its JSON."""
    if (known := _FIELDS.get(document_type)) is not None:
        return known
    hints = get_type_hints(document_type, include_extras=True)
    described = [_describe(f, hints[f.name], document_type) for f in fields(document_type)]
    described.sort(key=lambda f: f.name not in TAGS)
    return _FIELDS.setdefault(document_type, tuple(described))


_ENCODERS: dict[type[Any], Convert] = {}


def _encoder(document_type: type[Any]) -> Convert:
    """What writes a document: a display of a dict with a call for each field, made as code once.

    A loop over the fields takes twice the time.
    """
    if (known := _ENCODERS.get(document_type)) is not None:
        return known
    every = wire_fields(document_type)
    encoders = {f"encode_{f.name}": f.encode for f in every}
    encoders |= {f"default_{f.name}": f.default for f in every if f.left_out}
    made: Convert = eval(f"lambda document: {{{', '.join(map(_member, every))}}}", encoders)
    return _ENCODERS.setdefault(document_type, made)


def _member(field: WireField) -> str:
    """The code of one field."""
    member = f"{field.wire_name!r}: encode_{field.name}(document.{field.name})"
    if field.left_out:
        is_default = f"document.{field.name} == default_{field.name}"
        return f"**({{}} if {is_default} else {{{member}}})"
    return member


def _describe(field: Field[Any], hint: Any, owner: type[Any]) -> WireField:
    name, unit, annotation = field.name, "", hint
    if get_origin(hint) is Annotated:
        annotation, unit = get_args(hint)
    elif get_origin(hint) is tuple and get_origin(get_args(hint)[0]) is Annotated:
        _, unit = get_args(get_args(hint)[0])
        annotation = tuple[float, ...]
    encode, decode = _conversion(name, annotation, unit)
    return WireField(
        name=name,
        wire_name=name.rstrip("_") + SUFFIX.get(unit, ""),
        annotation=annotation,
        owner=owner,
        encode=encode,
        decode_number=decode,
        missing=_missing(field, encode),
        left_out=field.metadata == LEFT_OUT,
        promised=field.metadata == PROMISED,
        default=field.default,
    )


def _missing(field: Field[Any], encode: Convert) -> Any:
    if field.metadata not in (ADDED, LEFT_OUT, PROMISED):
        return ...
    return None if field.default is None else encode(field.default)


def _conversion(name: str, annotation: Any, unit: str) -> tuple[Convert, Convert]:
    if annotation == tuple[float, ...]:
        encode_number, decode = _conversion(name, float, unit)
        return lambda numbers: [encode_number(number) for number in numbers], decode
    if unit == "s/rad":
        return _per_degree, degrees
    if unit in ("rad", "radps"):
        return (_compass_degrees if name in COMPASS else _degrees), radians
    if annotation is float:
        return _expect_finite, _keep
    if annotation in (int, bool, str):
        return annotation, _keep  # also turns numpy's scalars into Python's
    if annotation == tuple[str, ...]:
        return list, _keep
    if get_origin(annotation) is tuple:
        return _encode_all, _keep
    if is_dataclass(annotation):
        return _encoder(annotation), _keep  # type: ignore[arg-type]
    if get_origin(annotation) in (UnionType, Union):
        return to_wire, _keep
    if get_origin(annotation) is Literal or issubclass(annotation, Enum):
        return str, _keep
    raise TypeError(f"{name}: the wire has no form for {annotation!r}.")


def _encode_all(members: Sequence[Any]) -> list[dict[str, Any]]:
    return [to_wire(member) for member in members]


def _keep(value: Any) -> Any:
    return value


def _expect_finite(value: float) -> float:
    if not isfinite(value):
        raise ValueError(f"A document must hold finite numbers only, not {value}.")
    return float(value)


def _degrees(value: float) -> float:
    return degrees(_expect_finite(value))


def _per_degree(value: float) -> float:
    return radians(_expect_finite(value))


def _compass_degrees(value: float) -> float:
    return compass(degrees(_expect_finite(value)))
