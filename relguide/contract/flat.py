"""Situations and answers as flat rows, for CSV and Parquet: a column for each number or text.

A column is named by the path of its field in the JSON, with dots: `pursuer.x_m`,
`optimality.proof`. What is a list there is JSON text here: `leader.intent`, `segments`. An empty
cell is a field that is left out.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import is_dataclass
from types import UnionType
from typing import Any, Literal, get_args, get_origin

import orjson
from pydantic import BaseModel

from relguide.contract.answers import Include
from relguide.contract.bodies import (
    GeodeticLeader,
    GeodeticPursuer,
    LocalLeader,
    LocalPursuer,
    WindBody,
)
from relguide.contract.bulk import Fields
from relguide.contract.refusal import ContractError, loads
from relguide.contract.wire import wire_fields
from relguide.flying.plan_documents import FlownCard, NoPlanCard, PlanCard
from relguide.flying.verdicts import OptimalityCheck

Kind = Literal["number", "whole", "text", "truth", "json"]
"""What the cells of a column hold."""

Cell = str | float | bool | None


def _paths(name: str, *models: type[BaseModel]) -> Iterator[str]:
    for model in models:
        for field in model.model_fields:
            yield f"{name}.{field}"


LISTS = ("pursuer.levels", "leader.intent", "traffic", "cells")
"""Columns of a situation that hold JSON text."""
TEXTS = ("id", *LISTS)
"""Columns of a situation that do not hold numbers."""
AMID = ("pursuer.altitude_m", "leader.altitude_m", "traffic", "cells")
"""Columns of a situation to which answers say more."""
SITUATION_COLUMNS = tuple(
    dict.fromkeys(
        (
            "id",
            *_paths("pursuer", LocalPursuer, GeodeticPursuer),
            *_paths("leader", LocalLeader, GeodeticLeader),
            "slot_distance_m",
            "min_separation_m",
            *_paths("wind", WindBody),
            "traffic",
            "cells",
        )
    )
)
"""All columns that a file of situations may have, in any order."""


def check_columns(header: Sequence[str], file: str) -> None:
    """Refuse a file whose columns are not those of situations.

    Raises:
        ValueError: naming the columns that are unknown or there twice, and those there are.
    """
    unknown = [name for name in header if name not in SITUATION_COLUMNS]
    if unknown:
        raise ValueError(
            f"{file} has the column {', '.join(unknown)}, and those of situations are "
            f"{', '.join(SITUATION_COLUMNS)}."
        )
    twice = [name for name in dict.fromkeys(header) if header.count(name) > 1]
    if twice:
        raise ValueError(f"{file} has the column {', '.join(twice)} more than once.")


def is_amid(header: Sequence[str]) -> bool:
    """Whether a file with these columns may have other traffic, cells or heights."""
    return not set(AMID).isdisjoint(header)


def situation_of_row(header: Sequence[str], cells: Sequence[Any]) -> dict[str, Any]:
    """A row as the JSON object that it stands for, yet to be checked.

    Args:
        header: names of the columns, of `SITUATION_COLUMNS`.
        cells: as many; numbers may be texts.

    Raises:
        ContractError: if a cell of JSON holds something else.
    """
    body: dict[str, Any] = {}
    for name, cell in zip(header, cells, strict=True):
        if cell is None or cell == "":
            continue
        value = cell
        if name in LISTS:
            value = _list(name, cell)
        elif isinstance(cell, str) and name not in TEXTS:
            value = _number(cell)
        outer, dot, inner = name.partition(".")
        if dot:
            body.setdefault(outer, {})[inner] = value
        else:
            body[name] = value
    return body


def _list(name: str, cell: object) -> object:
    """What a list holds: JSON text, or rows with a column for each field."""
    if isinstance(cell, str):
        try:
            return loads(cell)
        except ContractError as error:
            raise ContractError([(name, str(error))]) from None
    return _without_empty(cell)


def _without_empty(cell: object) -> object:
    """Rows within rows, without the fields that are left out in each."""
    if isinstance(cell, list):
        return [_without_empty(part) for part in cell]
    if isinstance(cell, Mapping):
        return {name: _without_empty(part) for name, part in cell.items() if part is not None}
    return cell


def _number(cell: str) -> float | str:
    """A cell as the number it shows; what shows none stays text, to be refused as that."""
    try:
        return float(cell) if "_" not in cell else cell  # Python reads 1_000, and nobody writes it
    except ValueError:
        return cell


def _leaves(card: type[Any], path: str = "", *, amid: bool = False) -> Iterator[tuple[str, Kind]]:
    """The columns that a card of an answer makes; `amid` others or at heights, all of them."""
    for field in wire_fields(card):
        if field.left_out and not amid:
            continue
        name, annotation = f"{path}{field.wire_name}", field.annotation
        if isinstance(annotation, UnionType):  # a card, or none
            annotation = get_args(annotation)[0]
        if is_dataclass(annotation):
            yield from _leaves(annotation, f"{name}.", amid=amid)  # type: ignore[arg-type]
        elif get_origin(annotation) is tuple:
            yield name, "json"
        else:
            yield name, _KINDS.get(annotation, "text")


_KINDS: dict[Any, Kind] = {float: "number", int: "whole", bool: "truth"}
"""What columns of these types hold; texts, and words of a few, are text."""
_FIRST: dict[str, Kind] = {"id": "text", "line": "whole", "status": "text"}
"""Columns that all answers have; `line` says where a situation stood that is none."""
_OF_TIMES: dict[str, Kind] = {
    "time_to_converge_s": "number",
    "optimality.proof": "text",
    "optimality.lower_bound_s": "number",
}
"""Columns of a plan's time alone."""


def answer_columns(
    fields: Fields, include: Collection[Include], *, amid: bool = False
) -> dict[str, Kind]:
    """The columns of answers: their names in order, and what they hold.

    Args:
        fields: how much of each plan.
        include: what is added to it.
        amid: whether situations may have other traffic, cells, or heights.
    """
    columns = dict(_FIRST)
    if fields == "times":
        return columns | _OF_TIMES | dict(_leaves(NoPlanCard))
    columns |= dict(_leaves(PlanCard, amid=amid))
    if "alternatives" not in include:
        del columns["alternatives"]
    if "paths" in include:
        columns["others"] = "json"
    if "flown" in include:
        columns |= dict(_leaves(FlownCard, "flown."))
    if "optimality" in include:
        columns |= dict(_leaves(OptimalityCheck, "optimality."))
    return columns | dict(_leaves(NoPlanCard, amid=amid))


def cells_of_answers(
    answers: Sequence[Mapping[str, Any]], columns: Mapping[str, Kind]
) -> list[list[Cell]]:
    """The cells of each column, in order; `None` where an answer has no such field."""
    return [_cells(answers, name, kind) for name, kind in columns.items()]


def _cells(answers: Sequence[Mapping[str, Any]], name: str, kind: Kind) -> list[Cell]:
    *outer, last = name.split(".")
    holders = answers
    for step in outer:
        holders = [holder.get(step, {}) for holder in holders]
    if kind == "json":
        return [orjson.dumps(h[last]).decode() if last in h else None for h in holders]
    return [holder.get(last) for holder in holders]
