"""field_docs(class): the strings under its fields, read from its source once they are asked for."""

import ast
import inspect
from typing import Any

_KNOWN: dict[type[Any], dict[str, str]] = {}


def field_docs(document_type: type[Any]) -> dict[str, str]:
    """The string under each field of a class, by name."""
    if (known := _KNOWN.get(document_type)) is not None:
        return known
    try:
        (definition,) = ast.parse(inspect.getsource(document_type)).body
    except OSError:  # installed without sources: there are no docstrings
        return {}
    assert isinstance(definition, ast.ClassDef)
    docs: dict[str, str] = {}
    for field, below in zip(definition.body, definition.body[1:], strict=False):
        match field, below:
            case (
                ast.AnnAssign(target=ast.Name(id=name)),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                docs[name] = inspect.cleandoc(text)
    return _KNOWN.setdefault(document_type, docs)
