"""Plain situations: positions as x and y, and nothing wrong. As columns, or one by one.

A million of them are read so in seconds, without a model of each. What is not as plain, for
whatever reason, is left to the models of `bodies.py`, which say what is wrong with it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from math import cos, radians, sin
from typing import Any, NamedTuple

import numpy as np
import orjson
from numpy.typing import NDArray

from relguide.contract.bodies import (
    LocalLeader,
    LocalPursuer,
    StraightPiece,
    TurnPiece,
    WindBody,
    wind_of,
)
from relguide.contract.compass import heading_of
from relguide.contract.refusal import loads
from relguide.planning import limits
from relguide.planning.batch import Floats, Situations
from relguide.planning.situation import FlyStraight, IntentPiece, Leader, Pursuer, Situation, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.turning_batch import Intents, can_be_flown

PURSUER, LEADER, WIND, STRAIGHT, TURN = (
    set(model.model_fields)
    for model in (LocalPursuer, LocalLeader, WindBody, StraightPiece, TurnPiece)
)
"""Fields of plain aircraft, of a wind, and of the pieces of an intent."""
REQUIRED = {"pursuer", "leader", "slot_distance_m", "min_separation_m"}
OPTIONAL = {"id", "wind"}
NO_WIND = {"from_deg": 0.0, "speed_mps": 0.0}
NUMBERS = {float, int}
"""Types of what is a number in JSON; a truth value's is another."""
SIDES = {"left": float(LEFT), "right": float(RIGHT)}

DIGITS, LARGE = bytes.maketrans(b"123456789", b"0" * 9), b"0" * 19
"""A row of digits: an integer that may be too large for a word of the machine."""
LARGEST = 1e300
"""Larger numbers are left to the models: an integer of JSON may be too large for a float."""


class Row(NamedTuple):
    """A plain situation, as it is in JSON."""

    numbers: tuple[float, ...]
    """In the order of `columns_of`."""
    intent: list[tuple[float, float, float]]
    """Of each piece ε, 0 for a straight; heading [°] or duration [s]; bank [°]."""


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
    if (
        b"\\" in line
        or orjson.dumps(content).count(b":") != line.count(b":")
        or LARGE in line.translate(DIGITS)
    ):
        return loads(line)
    return content


def plain_row(content: Mapping[str, Any]) -> Row | None:
    """The numbers of a plain situation, as they are in JSON; `None` if it is not plain."""
    given = content.keys()
    if not (given >= REQUIRED and given - REQUIRED <= OPTIONAL):
        return None
    p, l, wind = content["pursuer"], content["leader"], content.get("wind", NO_WIND)
    if not (
        type(p) is type(l) is type(wind) is dict
        and p.keys() == PURSUER
        and l.keys() | {"intent"} == LEADER
        and wind.keys() == WIND
    ):
        return None
    intent = _plain_intent(l.get("intent", []))
    row: tuple[Any, ...] = (
        p["x_m"], p["y_m"], p["heading_deg"], p["tas_mps"], p["max_bank_deg"],
        l["x_m"], l["y_m"], l["heading_deg"], l["tas_mps"],
        content["slot_distance_m"], content["min_separation_m"],
        wind["from_deg"], wind["speed_mps"],
    )  # fmt: skip
    return Row(row, intent) if intent is not None and _are_plain(row) else None


def _plain_intent(pieces: Any) -> list[tuple[float, float, float]] | None:
    if type(pieces) is not list:
        return None
    intent: list[tuple[float, float, float]] = []
    for piece in pieces:
        if type(piece) is not dict:
            return None
        if piece.keys() == STRAIGHT:
            amounts = (0.0, piece["straight_s"], 0.0)
        elif piece.keys() == TURN and type(side := piece["direction"]) is str and side in SIDES:
            amounts = (SIDES[side], piece["turn_to_heading_deg"], piece["bank_deg"])
        else:
            return None
        if not _are_plain(amounts):
            return None
        intent.append(amounts)
    return intent


def _are_plain(numbers: tuple[Any, ...]) -> bool:
    return (
        NUMBERS.issuperset(map(type, numbers))
        and -LARGEST < min(numbers)
        and max(numbers) < LARGEST
    )


def situation_of(row: Row) -> Situation | None:
    """The situation that it is; `None` if it is none that can be flown."""
    px, py, psi, tas, bank, lx, ly, leading, leader_tas, slot, nearest, wind, speed = row.numbers
    if len(row.intent) > limits.MAX_PIECES or not limits.WIND.admits(speed):
        return None
    try:
        return Situation(
            pursuer=Pursuer(
                x=px, y=py, heading=heading_of(psi), tas=tas, max_bank=radians(bank)
            ),
            leader=Leader(
                x=lx, y=ly, heading=heading_of(leading), tas=leader_tas,
                intent=tuple(_piece(*piece) for piece in row.intent),
            ),
            slot_distance=slot,
            min_separation=nearest,
            wind=wind_of(wind, speed),
        )  # fmt: skip
    except ValueError:  # the models say what is wrong
        return None


def _piece(side: float, amount: float, bank: float) -> IntentPiece:
    if side == 0.0:
        return FlyStraight(duration=amount)
    turn = LEFT if side == LEFT else RIGHT
    return TurnTo(heading=heading_of(amount), turn=turn, bank=radians(bank))


def columns_of(rows: Sequence[Row]) -> tuple[Situations, Intents, NDArray[np.bool_]]:
    """Plain rows in the library's units, and which of them are situations that can be flown."""
    (
        pursuer_x, pursuer_y, pursuer_heading, pursuer_tas, max_bank,
        leader_x, leader_y, leader_heading, leader_tas,
        slot_distance, min_separation, wind_from, wind_speed,
    ) = np.array([row.numbers for row in rows], np.float64).T  # fmt: skip
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
    pieces = np.array([piece for row in rows for piece in row.intent], np.float64).reshape(-1, 3)
    turns = pieces[:, 0] != 0.0
    pieces[turns, 1] = _headings(pieces[turns, 1])
    pieces[:, 2] = np.radians(pieces[:, 2])
    counts = np.array([len(row.intent) for row in rows], np.int64)
    intents = Intents(counts=counts, pieces=pieces)
    sound = can_be_flown(situations, intents) & limits.WIND.admits(wind_speed)
    return situations, intents, sound


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
