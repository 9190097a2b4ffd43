"""Refusals of what comes from outside: each defect as a path and a sentence."""

import json
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any, ClassVar, TypeVar

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler, ValidationError
from pydantic_core import CoreSchema

from relguide.contract.docs import field_docs
from relguide.contract.wanted import TAG as TAG
from relguide.contract.wanted import fields_at, unit_of, wanted, wanted_tags

MAX_SAID = 8
"""How many defects the sentence of a refusal spells out."""
MAX_LISTED = 20
"""How many defects a refusal lists."""
MAX_QUOTED = 40
"""How many characters of a refused value are quoted back."""
FLOWN_ONLY = ("air", "believed_air", "surveillance")
"""Fields of situations that are flown, which plans do not have."""
MEANT = 0.7
"""How much an unknown field is like the one that is meant, from 0 to 1. A word of its name, as `x`
of `x_m`, or another unit, as in `tas_kt`, will do as well."""


class Strict(BaseModel):
    """The base of all outside shapes: nothing is converted, and nothing unknown is accepted."""

    always_written: ClassVar[frozenset[str]] = frozenset()
    """Fields that are described as required, though what was written before may lack them."""
    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        allow_inf_nan=False,
        frozen=True,
        defer_build=True,  # of dozens of shapes a program uses a few
    )

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The schema, with the string under each field as its description.

        pydantic's own way reads the sources of each shape as it is defined, schema or not.
        """
        described = handler(schema)
        shape = handler.resolve_ref_schema(described)
        members = shape.get("properties", {})
        if cls.always_written:
            needed = {*cls.always_written, *shape.get("required", ())}
            shape["required"] = [name for name in members if name in needed]
            for name in cls.always_written:
                members[name].pop("default", None)
        for owner in reversed(cls.__mro__):
            if issubclass(owner, Strict) and owner is not Strict:
                for name, doc in field_docs(owner).items():
                    members[name]["description"] = doc
        return described


class ContractError(ValueError):
    """Something from outside does not follow the contract.

    Attributes:
        problems: (path of the field, sentence), at least one and at most `MAX_LISTED`; the path is
            empty for the whole.
        count: how many there are in all.
    """

    def __init__(self, problems: Sequence[tuple[str, str]], *, count: int = 0) -> None:
        self.problems = tuple(
            (make_printable(path), make_printable(message))
            for path, message in problems[:MAX_LISTED]
        )
        self.count = max(count, len(problems))
        said = [f"{path}: {message}" if path else message for path, message in self.problems]
        if self.count > MAX_SAID:
            said[MAX_SAID:] = [f"And {self.count - MAX_SAID} more."]
        super().__init__(" ".join(said))


def decode(text: bytes) -> str:
    """Read UTF-8.

    Raises:
        ContractError: naming the first byte that is none.
    """
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError as error:
        message = f"This is not UTF-8 text: byte {error.start} cannot be read."
        raise ContractError([("", message)]) from None


def loads(text: bytes | str) -> object:
    """Parse JSON text, refusing what JSON does not have: NaN, infinities, a key given twice.

    Raises:
        ContractError: with the line and column where the text stops being JSON.
    """
    try:
        if isinstance(text, bytes):
            text = decode(text)
        # what spreadsheets and some editors put before JSON
        parsed: object = _DECODER.decode(text.removeprefix("\ufeff"))
    except ContractError:
        raise
    except RecursionError:
        raise ContractError([("", "This is nested too deeply to be read.")]) from None
    except json.JSONDecodeError as error:
        message = f"This is not JSON: {error.msg} at line {error.lineno}, column {error.colno}."
        raise ContractError([("", message)]) from None
    except ValueError:  # Python refuses to read an integer of thousands of digits
        raise ContractError([("", "A number in this has too many digits to be read.")]) from None
    return parsed


M = TypeVar("M", bound=BaseModel)


def parse(model: type[M], source: bytes | str | Mapping[str, object] | list[object]) -> M:
    """Read one outside shape from JSON text, or from JSON already parsed.

    Raises:
        ContractError: naming each field that is wrong.
    """
    content = loads(source) if isinstance(source, bytes | str) else source
    try:
        return model.model_validate(content)
    except ValidationError as error:
        raise refusal(error, content, model.__pydantic_core_schema__) from None


def refusal(error: ValidationError, content: object, schema: Mapping[str, Any]) -> ContractError:
    """Pydantic's findings about `content`, read by its core schema, in our words."""
    found: list[Any] = error.errors(include_url=False)[:MAX_LISTED]
    missing = [e["loc"] for e in found if e["type"] == "missing"]
    problems = [
        (
            _path(e, content),
            _say_wanted(e, schema) or _say_meant(e, missing, schema, content) or _sentence(e),
        )
        for e in found
    ]
    named = [(path, text if path else f"This {text}") for path, text in problems]
    return ContractError(named, count=error.error_count())


def refuse_parameters(findings: Sequence[Any]) -> ContractError:
    """Pydantic's findings about the query of an address, in our words.

    Args:
        findings: as its `errors()` has them; the path of each begins with where the value stood
            (`query`), and each value is the text that stood there.
    """
    problems = [
        (_path({**e, "loc": e["loc"][1:]}, None), _sentence(e, _quote_parameter(e["input"])))
        for e in findings
    ]
    return ContractError(problems[:MAX_LISTED], count=len(problems))


def _unique_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
    members = dict(pairs)
    if len(members) < len(pairs):
        seen: set[str] = set()
        for key, _ in pairs:
            if key in seen:
                raise ContractError([(_shorten(key), "is given more than once: give it once.")])
            seen.add(key)
    return members


def _refuse_constant(name: str) -> object:
    raise ContractError([("", f"{name} is not a number in JSON: give a finite one.")])


_DECODER = json.JSONDecoder(object_pairs_hook=_unique_keys, parse_constant=_refuse_constant)


def _path(error: Any, content: object) -> str:
    """Where in `content` it is, e.g. `leader.intent[1].bank_deg`, without the unions' tags."""
    path, here = "", content
    for step in error["loc"]:
        if isinstance(step, int):
            path += f"[{step}]"
            here = here[step] if isinstance(here, list) and step < len(here) else None
        elif not _is_tag(step, here):
            name = _shorten(step) or '""'
            path += f".{name}" if path else name
            here = here.get(step) if isinstance(here, Mapping) else None
    if error["type"] in ("union_tag_invalid", "union_tag_not_found"):
        field = error["ctx"]["discriminator"].strip("'")
        path += f".{field}" if path else field
    return path


def _is_tag(step: str, here: object) -> bool:
    # pydantic puts the tag of the chosen member of a union into the path
    if step.startswith(TAG):
        return True
    return isinstance(here, Mapping) and step not in here and step in _texts(here)


def _texts(members: Mapping[str, object]) -> list[str]:
    return [value for value in members.values() if isinstance(value, str)]


_TIME = "2026-11-23T06:30:00Z"
_SENTENCES = {
    "string_unicode": "must be text without lone surrogates, not {given}.",
    "missing": "is missing.",
    "extra_forbidden": "is not a field of the contract: leave it out.",
    "float_type": "must be a number, not {given}.",
    "int_type": "must be a whole number, not {given}.",
    "int_from_float": "must be a whole number, not {given}.",
    "int_parsing_size": "must be a whole number, not {given}.",
    "finite_number": "must be a finite number, not {given}.",
    "string_type": "must be a text, not {given}.",
    "bool_type": "must be true or false, not {given}.",
    "list_type": "must be a list, not {given}.",
    "model_type": "must be an object with fields, not {given}.",
    "model_attributes_type": "must be an object with fields, not {given}.",
    "dict_type": "must be an object with fields, not {given}.",
    "greater_than_equal": "must be at least {ge:.12g}{unit}, not {given}{unit}.",
    "less_than_equal": "must be at most {le:.12g}{unit}, not {given}{unit}.",
    "literal_error": "must be {expected}, not {given}.",
    "value_error": "{error}",
    "union_tag_invalid": "must be one of {expected_tags}, not {tag}.",
    "union_tag_not_found": "is missing: it says what kind of object this is.",
    "too_long": "must have at most {max_length} entries, not {actual_length}.",
    "too_short": "must have at least {min_length} entries, not {actual_length}.",
    "string_too_long": "must have at most {max_length} characters.",
    "string_too_short": "must have at least {min_length} characters.",
    "float_parsing": "must be a number, not {given}.",
    "int_parsing": "must be a whole number, not {given}.",
    "bool_parsing": "must be true or false, not {given}.",
    "timezone_aware": f"must be a time with its zone, as {_TIME}, not {{given}}.",
    "datetime_from_date_parsing": f"must be a time, as {_TIME}, not {{given}}; + is written %2B.",
}
"""Pydantic's type of an error → our sentence, with the names of its context in braces."""
_NUMBERS = ("float_type", "int_type", "int_from_float", "int_parsing_size")
"""Types that pydantic also gives to integers too large for it."""


def _sentence(error: Any, given: str = "") -> str:
    kind, value = error["type"], error["input"]
    given = given or _quote(value)
    if kind in _NUMBERS and isinstance(value, int) and not isinstance(value, bool):
        return "is too large a number to be read."
    sentence = _SENTENCES.get(kind)
    if sentence is None:
        return f"{error['msg']} (given: {given})."
    context = dict(error.get("ctx", {}))
    if "tag" in context:
        context["tag"] = _quote(context["tag"])
    return sentence.format(**context, given=given, unit=unit_of(error["loc"]))


def _say_wanted(error: Any, schema: Mapping[str, Any]) -> str:
    """What would be right in place of what is missing; or nothing."""
    match error["type"]:
        case "missing":
            must = wanted(schema, error["loc"])
        case "union_tag_not_found":
            must = wanted_tags(schema, error["loc"])
        case _:
            return ""
    return f"is missing: it {must}." if must else ""


def _say_meant(
    error: Any, missing: Sequence[tuple[Any, ...]], schema: Mapping[str, Any], content: object
) -> str:
    """What an unknown field may be meant for, of those that are not there beside it; or nothing."""
    if error["type"] != "extra_forbidden":
        return ""
    *where, name = error["loc"]
    if name in FLOWN_ONLY:
        return (
            "belongs in the situation of a flight (relguide fly FILE, POST /api/v1/flights): "
            "no plan depends on it."
        )
    there = _at(where, content)
    needed = [str(last) for *place, last in missing if place == where]
    other = [one for one in fields_at(schema, where) if one not in (*needed, *there)]
    return _ask_about(str(name), needed) or _ask_about(str(name), other)


def _ask_about(name: str, beside: Sequence[str]) -> str:
    meant = get_close_matches(name[:MAX_QUOTED], beside, 1, MEANT) or [
        one for one in beside if {name, _stem(name)} & {_stem(one), *one.split("_")}
    ]
    return f"is not a field of the contract: did you mean {meant[0]}?" if meant else ""


def _at(location: Sequence[Any], content: object) -> Mapping[str, object]:
    """The object at a place; an empty one where there is none."""
    here = content
    for step in location:
        if isinstance(step, int):
            here = here[step] if isinstance(here, list) and step < len(here) else None
        elif not _is_tag(step, here):
            here = here.get(step) if isinstance(here, Mapping) else None
    return here if isinstance(here, Mapping) else {}


def _stem(name: str) -> str:
    """The name of a field without its unit."""
    return name.rpartition("_")[0] or name


def _quote_parameter(value: object) -> str:
    return _shorten(value) if isinstance(value, str) and value else _quote(value)


def _quote(value: object) -> str:
    match value:
        case None:
            return "null"
        case bool():
            return "true" if value else "false"
        case int() if abs(value) >= 10**MAX_QUOTED:
            return "a number of that size"
        case int() | float():
            return f"{value}"
        case str():
            return f'the text "{_shorten(value)}"'
        case Mapping():
            return "an object"
        case list() | tuple():
            return "a list"
        case _:
            return f"a Python {type(value).__name__}"


def _shorten(text: str) -> str:
    return text if len(text) <= MAX_QUOTED else text[: MAX_QUOTED - 1] + "…"


def make_printable(text: str) -> str:
    """Text without lone surrogates, which JSON can write but no terminal or socket."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")
