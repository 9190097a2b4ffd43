"""What would be right where something is missing, by the core schema that pydantic reads with.

That schema is there once anything has been read. The one of JSON would have to be made first.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from relguide.planning.inputs import Range

ACCEPTED = "relguide_accepted"
"""Under this name the metadata of a number's schema has its `Range`."""
UNITS = {
    "m": "m",
    "s": "s",
    "mps": "m/s",
    "deg": "°",
    "kg": "kg",
    "k": "K",
}
"""The last part of a field's name → the unit that it names."""
TAG = "#"
"""First character of tags that no field holds."""

Schema = Mapping[str, Any]


def wanted(schema: Schema, location: Sequence[str | int]) -> str:
    """What something must be, as a sentence goes on; empty where the schema does not tell.

    Args:
        schema: pydantic's core schema of the whole.
        location: the path in it, with the tags of unions, as an error has it.
    """
    known: dict[str, Schema] = {}
    here = _find(schema, location, known)
    if here is None:
        return ""
    return _describe(here, known, unit_of(location))


def wanted_tags(schema: Schema, location: Sequence[str | int]) -> str:
    """What the field must be that says which member of a union at that place is meant."""
    known: dict[str, Schema] = {}
    here = _find(schema, location, known)
    choices = _bare(here, known)[0].get("choices", {}) if here else {}
    tags = [tag for tag in choices if not str(tag).startswith(TAG)]
    return f"must be {_any_of(tags)}" if tags else ""


def fields_at(schema: Schema, location: Sequence[str | int]) -> tuple[str, ...]:
    """The fields that an object at that place may have."""
    known: dict[str, Schema] = {}
    here = _find(schema, location, known)
    return tuple(_bare(here, known)[0].get("fields", ())) if here else ()


def unit_of(location: Sequence[str | int]) -> str:
    """The unit that the name of a field ends with, behind a space; empty where it names none."""
    name = next((step for step in reversed(location) if isinstance(step, str)), "")
    unit = UNITS.get(name.rpartition("_")[2], "")
    return f" {unit}" if unit else ""


def _find(schema: Schema, location: Sequence[str | int], known: dict[str, Schema]) -> Schema | None:
    """The schema at a place; the shapes that it names are in `known` then."""
    for step in location:
        found = _step(_bare(schema, known)[0], step)
        if found is None:
            return None
        schema = found
    return schema


def _bare(schema: Schema, known: dict[str, Schema]) -> tuple[Schema, Range | None]:
    """What is read in the end, without what is done before and after; and its range, if any."""
    accepted: Range | None = None
    while True:
        accepted = schema.get("metadata", {}).get(ACCEPTED, accepted)
        match schema["type"]:
            case "definitions":
                known.update({one["ref"]: one for one in schema["definitions"]})
                schema = schema["schema"]
            case "definition-ref":
                schema = known[schema["schema_ref"]]
            case "json-or-python":
                schema = schema["json_schema"]
            case "lax-or-strict":
                schema = schema["strict_schema"]
            case (
                "model" | "default" | "nullable"
                | "function-before" | "function-after" | "function-wrap"
            ):  # fmt: skip
                schema = schema["schema"]
            case _:
                return schema, accepted


def _step(schema: Schema, step: str | int) -> Schema | None:
    match schema["type"]:
        case "model-fields" if step in schema["fields"]:
            field: Schema = schema["fields"][step]["schema"]
            return field
        case "tagged-union" if step in schema["choices"]:
            member: Schema = schema["choices"][step]
            return member
        case "list":
            entry: Schema = schema["items_schema"]
            return entry
        case _:
            return None


def _describe(schema: Schema, known: dict[str, Schema], unit: str) -> str:
    bare, accepted = _bare(schema, known)
    if accepted is not None:
        return f"must lie in {accepted.span}"
    match bare["type"]:
        case "float" | "int" as kind:
            number = "a number" if kind == "float" else "a whole number"
            return f"must be {number}{_bounds(bare, unit) or (f' [{unit[1:]}]' if unit else '')}"
        case "str":
            return "must be a text"
        case "bool":
            return "must be true or false"
        case "literal":
            return f"must be {_any_of(bare['expected'])}"
        case "list":
            return "must be a list"
        case "model-fields":
            return f"must be an object{_needed(bare)}"
        case "tagged-union":
            return _describe_any(bare, known, unit)
        case _:
            return ""


def _describe_any(union: Schema, known: dict[str, Schema], unit: str) -> str:
    """What any member of a union must be; of objects, the fields of each."""
    said = [_describe(member, known, unit) for member in union["choices"].values()]
    first, *others = dict.fromkeys(filter(None, said)) or [""]
    return ", or ".join([first, *(one.removeprefix("must be an object ") for one in others)])


def _bounds(number: Schema, unit: str) -> str:
    least, most = (number.get(bound) for bound in ("ge", "le"))
    if least is not None and most is not None:
        return f" of {least:g} … {most:g}{unit}"
    if least is not None:
        return f" of at least {least:g}{unit}"
    return f" of at most {most:g}{unit}" if most is not None else ""


def _needed(model: Schema) -> str:
    """The fields that an object must have."""
    names = [
        name for name, field in model["fields"].items() if field["schema"]["type"] != "default"
    ]
    *all_but_last, last = names or [""]
    if not last:
        return " with fields"
    return f" with {', '.join(all_but_last)} and {last}" if all_but_last else f" with {last}"


def _any_of(values: Iterable[object]) -> str:
    *first, last = (f"'{value}'" for value in values)
    return f"{', '.join(first)} or {last}" if first else last
