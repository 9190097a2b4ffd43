"""Hypothesis strategies for documents, made from their types."""

from dataclasses import is_dataclass
from enum import Enum
from functools import reduce
from operator import or_
from types import NoneType, UnionType
from typing import Any, Literal, get_args, get_origin

from hypothesis import strategies as st

from relguide.contract.wire import COMPASS, wire_fields
from relguide.flying.documents import Alert, Document, ForecastChanged, SeparationLost, Unable
from relguide.flying.orders import Command
from relguide.flying.plan_documents import PathPoint

DOCUMENT_TYPES: tuple[type[Any], ...] = get_args(Document)
ORDERED = {
    "heading": (-6.0, 12.0),
    "tas": (30.0, 400.0),
    "altitude": (-500.0, 20_000.0),
    "rate": (0.5, 60.0),
    "bank": (0.02, 1.04),
    "slot_distance": (10_000.0, 200_000.0),
    "min_separation": (0.0, 10_000.0),
    "x": (-1e6, 1e6),
    "y": (-1e6, 1e6),
    "track": (-6.0, 12.0),
    "ground_speed": (0.0, 600.0),
    "roll": (-1.0, 1.0),
    "pitch": (-1.0, 1.0),
}
"""What orders may ask, by the names of their fields."""


def documents() -> st.SearchStrategy[Any]:
    """Any document, its headings in [0, 2π)."""
    return reduce(or_, map(document_of, DOCUMENT_TYPES))


def document_of(document_type: type[Any]) -> st.SearchStrategy[Any]:
    if document_type in get_args(Command):
        return order_of(document_type)
    return st.builds(
        document_type,
        **{f.name: _values(f.name, f.annotation) for f in wire_fields(document_type)},
    )


def order_of(order_type: type[Any]) -> st.SearchStrategy[Any]:
    """Any order of a kind."""
    values = {
        f.name: st.floats(*ORDERED[f.name]) if f.name in ORDERED else _values(f.name, f.annotation)
        for f in wire_fields(order_type)
    }
    return st.builds(order_type, **values)


def orders() -> st.SearchStrategy[Any]:
    """Any order to an aircraft of a flight."""
    return reduce(or_, map(order_of, get_args(Command)))


def _values(name: str, annotation: Any) -> st.SearchStrategy[Any]:
    if annotation is float:
        low, high = (0.0, 6.283) if name in COMPASS else (-1e9, 1e9)
        return st.floats(low, high)
    if annotation is int:
        return st.integers(0, 2**40)
    if annotation in (bool, str):
        return st.from_type(annotation)
    if get_origin(annotation) is Literal:
        return st.sampled_from(get_args(annotation))
    if get_origin(annotation) is tuple:
        return st.lists(_values(name, get_args(annotation)[0]), max_size=3).map(tuple)
    if get_origin(annotation) is UnionType:
        members = (st.none() if m is NoneType else document_of(m) for m in get_args(annotation))
        return reduce(or_, members)
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return st.sampled_from(list(annotation))
    assert is_dataclass(annotation)
    return document_of(annotation)  # type: ignore[arg-type]


def rare_documents(t: float, ident: str, other: str) -> tuple[Document, ...]:
    """What a good flight has no reason to say."""
    alert = Alert(
        t=t,
        ident=ident,
        other=other,
        level="caution",
        subject="separation",
        message="The leader slows down: 4.8 NM in 45 s.",
        predicted_least=8_900.0,
        predicted_at=t + 45.0,
        cleared=False,
    )
    return (
        alert,
        Unable(t=t, ident=ident, reason="speed", message="The leader is too slow to follow."),
        SeparationLost(
            t=t,
            ident=ident,
            other=other,
            separation=9_259.0,
            x=0.0,
            y=0.0,
            cause="The leader slowed down.",
            announced=(t - 30.0,),
        ),
        ForecastChanged(
            t=t,
            ident=ident,
            times=(t, t + 5.0),
            x=(0.0, 1e3),
            y=(0.0, 0.0),
            heading=(1.5, 1.5),
            least_separation=9_500.0,
            pursuer_at_closest=PathPoint(t=t + 5.0, x=1e3, y=0.0, heading=1.5),
            leader_at_closest=PathPoint(t=t + 5.0, x=1e3, y=9_500.0, heading=1.5),
        ),
    )
