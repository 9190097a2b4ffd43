"""Outside shapes as TypeScript, for `web/src/wire.ts`."""

import json
from collections.abc import Mapping, Sequence
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

LINE_WIDTH = 100
"""Where the formatter breaks lines."""
NUMBERS_AND_TEXTS = {
    float: "number",
    int: "number",
    str: "string",
    bool: "boolean",
    NoneType: "null",
}


def typescript(aliases: Mapping[str, tuple[Any, str]], roots: Sequence[Any], *, docs: bool) -> str:
    """Interfaces of all models that `roots` reach, and the named unions.

    Args:
        aliases: TypeScript name → (union or `Literal` that gets it, its doc).
        roots: models or annotations to begin with.
        docs: whether to carry the docstrings over.
    """
    names = {_key(annotation): name for name, (annotation, _) in aliases.items()}
    models: dict[str, type[BaseModel]] = {}
    for root in [*roots, *(annotation for annotation, _ in aliases.values())]:
        _collect(root, models)
    blocks = [
        _doc(doc, "") * docs + _alias(name, annotation, names)
        for name, (annotation, doc) in aliases.items()
    ]
    blocks += [_interface(models[name], names, docs=docs) for name in sorted(models)]
    return "\n".join(blocks)


def _collect(annotation: Any, models: dict[str, type[BaseModel]]) -> None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        known = models.setdefault(annotation.__name__, annotation)
        assert known is annotation, f"Two shapes are called {annotation.__name__}."
        for field in annotation.model_fields.values():
            _collect(field.annotation, models)
    else:
        for member in get_args(annotation):
            _collect(member, models)


def _interface(model: type[BaseModel], names: Mapping[Any, str], *, docs: bool) -> str:
    lines = [_doc(model.__doc__ or "", "") * docs + f"export interface {model.__name__} {{\n"]
    for name, field in model.model_fields.items():
        lines.append(_doc(field.description or "", "  ") * docs)
        lines.append(
            _member(
                name,
                field,
                names,
                there=name in getattr(model, "always_written", ()) or field.is_required(),
            )
        )
    return "".join([*lines, "}\n"])


def _member(name: str, field: FieldInfo, names: Mapping[Any, str], *, there: bool) -> str:
    # What a server sends with a default may be left out by who sends it to the server.
    optional = "" if there else "?"
    line = f"  {name}{optional}: {_type(field.annotation, names)};\n"
    if len(line) <= LINE_WIDTH + 1:
        return line
    members = "".join(f"\n    | {member}" for member in _union(field.annotation, names))
    return f"  {name}{optional}:{members};\n"


def _alias(name: str, annotation: Any, names: Mapping[Any, str]) -> str:
    others = {key: other for key, other in names.items() if other != name}
    line = f"export type {name} = {_type(annotation, others)};\n"
    if len(line) <= LINE_WIDTH + 1:
        return line
    members = "".join(f"\n  | {member}" for member in _union(annotation, others))
    return f"export type {name} ={members};\n"


def _union(annotation: Any, names: Mapping[Any, str]) -> list[str]:
    if get_origin(annotation) is Annotated:
        return _union(get_args(annotation)[0], names)
    if get_origin(annotation) is Literal:
        return [json.dumps(value) for value in get_args(annotation)]
    return [_type(member, names) for member in get_args(annotation)]


def _type(annotation: Any, names: Mapping[Any, str]) -> str:
    if (name := names.get(_key(annotation))) is not None:
        return name
    origin = get_origin(annotation)
    if origin is Annotated:
        return _type(get_args(annotation)[0], names)
    if origin in (UnionType, Union, Literal):
        return " | ".join(_union(annotation, names))
    if origin is list:
        inside = get_args(annotation)[0]
        member = _type(inside, names)
        union = " " in member and get_origin(inside) is not list
        return f"({member})[]" if union else f"{member}[]"
    if issubclass(annotation, BaseModel):
        return str(annotation.__name__)
    return NUMBERS_AND_TEXTS[annotation]


def _key(annotation: Any) -> Any:
    """The same for `X` and `Annotated[X, …]`, whatever is annotated inside."""
    origin, members = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _key(members[0])
    if origin in (UnionType, Union):
        return frozenset(map(_key, members))
    if origin is list:
        return ("list", _key(members[0]))
    return annotation


def _doc(text: str, indent: str) -> str:
    if not text:
        return ""
    lines = [line.strip() for line in text.strip().splitlines()]
    if len(lines) == 1:
        return f"{indent}/** {lines[0]} */\n"
    return (
        f"{indent}/**\n"
        + "".join(f"{indent} * {line}".rstrip() + "\n" for line in lines)
        + f"{indent} */\n"
    )
