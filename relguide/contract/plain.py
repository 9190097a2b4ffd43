"""Plain situations as columns: a straight leader, positions as x and y, and nothing wrong.

A million of them are read so in seconds, without a model of each. What is not as plain, for
whatever reason, is left to the models of `bodies.py`, which say what is wrong with it.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from math import cos, sin
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from relguide.contract.bodies import LocalLeader, LocalPursuer, WindBody
from relguide.contract.compass import heading_of
from relguide.contract.refusal import loads
from relguide.planning import limits
from relguide.planning.batch import Floats, Situations

PURSUER, LEADER, WIND = (set(model.model_fields) for model in (LocalPursuer, LocalLeader, WindBody))
"""Fields of plain aircraft, and of a wind."""
REQUIRED = {"pursuer", "leader", "slot_distance_m", "min_separation_m"}
OPTIONAL = {"id", "wind"}
CALM = {"from_deg": 0.0, "speed_mps": 0.0}
NUMBERS = {float, int}
"""Types of what is a number in JSON; a truth value's is another."""

LARGE = re.compile(rb"\d{19}")
"""An integer that may be too large for a word of the machine."""
LARGEST = 1e300
"""Larger numbers are left to the models: an integer of JSON may be too large for a float."""
Row = tuple[float, ...]
"""The numbers of a plain situation, in the order of `columns_of`."""


def quick_loads(line: bytes) -> object:
    """As `loads`, five times as fast for what is right.

    Raises:
        ContractError: as `loads`.
    """
    try:
        content = orjson.loads(line)
    except orjson.JSONDecodeError:
        return loads(line)
    # of a key given twice orjson keeps the last, so that there are fewer colons than were read,
    # unless a text hides one as \u003a; and it makes a float of an integer that is too large
    if b"\\" in line or orjson.dumps(content).count(b":") != line.count(b":") or LARGE.search(line):
        return loads(line)
    return content


def plain_row(content: Mapping[str, Any]) -> Row | None:
    """The numbers of a plain situation, as they are in JSON; `None` if it is not plain."""
    given = content.keys()
    if not (given >= REQUIRED and given - REQUIRED <= OPTIONAL):
        return None
    p, l, wind = content["pursuer"], content["leader"], content.get("wind", CALM)
    if not (
        type(p) is type(l) is type(wind) is dict
        and p.keys() == PURSUER
        and l.keys() | {"intent"} == LEADER
        and l.get("intent", []) == []
        and wind.keys() == WIND
    ):
        return None
    row: tuple[Any, ...] = (
        p["x_m"], p["y_m"], p["heading_deg"], p["tas_mps"], p["max_bank_deg"],
        l["x_m"], l["y_m"], l["heading_deg"], l["tas_mps"],
        content["slot_distance_m"], content["min_separation_m"],
        wind["from_deg"], wind["speed_mps"],
    )  # fmt: skip
    plain = NUMBERS.issuperset(map(type, row)) and -LARGEST < min(row) and max(row) < LARGEST
    return row if plain else None


def columns_of(rows: Sequence[Row]) -> tuple[Situations, NDArray[np.bool_]]:
    """Plain rows in the library's units, and which of them are situations that can be flown."""
    (
        pursuer_x, pursuer_y, pursuer_heading, pursuer_tas, max_bank,
        leader_x, leader_y, leader_heading, leader_tas,
        slot_distance, min_separation, wind_from, wind_speed,
    ) = np.array(rows, np.float64).T  # fmt: skip
    situations = Situations(
        pursuer_x=pursuer_x,
        pursuer_y=pursuer_y,
        pursuer_heading=_headings(pursuer_heading),
        pursuer_tas=pursuer_tas,
        max_bank=np.radians(max_bank),
        leader_x=leader_x,
        leader_y=leader_y,
        leader_heading=_headings(leader_heading),
        leader_tas=leader_tas,
        slot_distance=slot_distance,
        min_separation=min_separation,
        # sine and cosine as `wind_from` takes them: numpy's differ in the last digit
        wind_east=[-v * sin(heading_of(a)) for v, a in _pairs(wind_speed, wind_from)],
        wind_north=[-v * cos(heading_of(a)) for v, a in _pairs(wind_speed, wind_from)],
    )
    return situations, situations.can_be_flown() & limits.WIND.admits(wind_speed)


def take(situations: Situations, rows: NDArray[np.bool_]) -> Situations:
    """Some of the rows."""
    columns = {f.name: np.asarray(getattr(situations, f.name))[rows] for f in fields(Situations)}
    return Situations(**columns)


def _headings(degrees: Floats) -> Floats:
    """As `heading_of`, of a column."""
    wrapped = np.mod(degrees, 360.0)
    return np.radians(np.where(wrapped < 360.0, wrapped, 0.0))


def _pairs(one: Floats, other: Floats) -> Iterator[tuple[float, float]]:
    return zip(one.tolist(), other.tolist(), strict=True)
