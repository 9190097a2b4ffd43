"""Hypothesis strategies for documents, made from their types."""

from dataclasses import is_dataclass
from enum import Enum
from functools import reduce
from operator import or_
from types import UnionType
from typing import Any, Literal, get_args, get_origin

from hypothesis import strategies as st

from relguide.contract.wire import COMPASS, wire_fields
from relguide.flying.documents import Document

DOCUMENT_TYPES: tuple[type[Any], ...] = get_args(Document)


def documents() -> st.SearchStrategy[Any]:
    """Any document, its headings in [0, 2π)."""
    return reduce(or_, map(document_of, DOCUMENT_TYPES))


def document_of(document_type: type[Any]) -> st.SearchStrategy[Any]:
    return st.builds(
        document_type,
        **{f.name: _values(f.name, f.annotation) for f in wire_fields(document_type)},
    )


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
        return st.lists(_values("", get_args(annotation)[0]), max_size=3).map(tuple)
    if get_origin(annotation) is UnionType:
        return reduce(or_, map(document_of, get_args(annotation)))
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return st.sampled_from(list(annotation))
    assert is_dataclass(annotation)
    return document_of(annotation)  # type: ignore[arg-type]
