"""Plain situations: positions as x and y, and nothing wrong. As columns, or one by one.

A million of them are read so in seconds, without a model of each. What is not as plain, for
whatever reason, is left to the models of `bodies.py`, which say what is wrong with it.
"""

from collections.abc import Sequence
from dataclasses import fields
from math import cos, isfinite, radians, sin
from typing import Annotated, NamedTuple

import numpy as np
import orjson
from msgspec import UNSET, Meta, MsgspecError, Struct, UnsetType, convert
from msgspec.json import Decoder
from msgspec.structs import astuple
from numpy.typing import NDArray

from relguide.contract.bodies import MAX_ID, MAX_INTEGER, wind_of
from relguide.contract.compass import heading_of
from relguide.contract.refusal import ContractError, loads, make_printable
from relguide.flying.plan_documents import Direction
from relguide.planning import limits
from relguide.planning.batch import Floats, Situations
from relguide.planning.situation import FlyStraight, IntentPiece, Leader, Pursuer, Situation, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.turning_batch import Intents, can_be_flown

SIDES = {"left": float(LEFT), "right": float(RIGHT)}
KEYS = 13
"""How many fields a situation has at least, those of its aircraft included."""
DIGITS, LARGE = bytes.maketrans(b"123456789", b"0" * 9), b"0" * 19
"""A row of digits: an integer that may be too large for a word of the machine."""


class _Pursuer(Struct, forbid_unknown_fields=True, gc=False):
    """As `LocalPursuer`."""

    x_m: float
    y_m: float
    heading_deg: float
    tas_mps: float
    max_bank_deg: float


class _Piece(Struct, forbid_unknown_fields=True, gc=False):
    """As `StraightPiece` or `TurnPiece`: the first field, or the three others."""

    straight_s: float | UnsetType = UNSET
    turn_to_heading_deg: float | UnsetType = UNSET
    direction: Direction | UnsetType = UNSET
    bank_deg: float | UnsetType = UNSET


class _Leader(Struct, forbid_unknown_fields=True, gc=False):
    """As `LocalLeader`."""

    x_m: float
    y_m: float
    heading_deg: float
    tas_mps: float
    intent: list[_Piece] | UnsetType = UNSET


class _Wind(Struct, forbid_unknown_fields=True, gc=False):
    """As `WindBody`."""

    from_deg: float
    speed_mps: float


class _Body(Struct, forbid_unknown_fields=True, gc=False):
    """As `NamedSituationBody`."""

    pursuer: _Pursuer
    leader: _Leader
    slot_distance_m: float
    min_separation_m: float
    wind: _Wind | UnsetType = UNSET
    id: (
        Annotated[str, Meta(max_length=MAX_ID)]
        | Annotated[int, Meta(ge=-MAX_INTEGER, le=MAX_INTEGER)]
        | UnsetType
    ) = UNSET


READER = Decoder(_Body)
"""Reads and checks at once, in C."""


class Row(NamedTuple):
    """A plain situation, as it is in JSON."""

    numbers: tuple[float, ...]
    """In the order of `columns_of`."""
    intent: list[tuple[float, float, float]]
    """Of each piece ε, 0 for a straight; heading [°] or duration [s]; bank [°]."""
    named: dict[str, str | int]
    """The `id` alone, if it has one."""


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


def plain_row(content: object) -> Row | None:
    """The numbers of a plain situation, as they are in JSON; `None` if it is not plain.

    Args:
        content: JSON text, or what JSON holds.
    """
    try:
        if isinstance(content, bytes) and b"\\" in content:
            content = loads(content)  # it may hide a colon as \u003a
        text = content if isinstance(content, bytes) else None
        body = convert(content, _Body) if text is None else READER.decode(text)
    except (MsgspecError, UnicodeDecodeError, ContractError):
        return None
    row = _row_of(body)
    if row is None:
        return None
    # of a key given twice the reader takes the last, so that the text has more colons than were
    # read; and it takes finite numbers only
    if text is not None:
        return row if text.count(b":") == _colons(body, row) else None
    total = sum(row.numbers) + sum(map(sum, row.intent))
    return row if isfinite(total) else None


def _row_of(body: _Body) -> Row | None:
    p, l, name = body.pursuer, body.leader, body.id
    intent: list[tuple[float, float, float]] = []
    for piece in l.intent or ():
        amounts = _amounts(piece)
        if amounts is None:
            return None
        intent.append(amounts)
    if isinstance(name, str) and make_printable(name) != name:
        return None
    numbers = (
        *astuple(p), l.x_m, l.y_m, l.heading_deg, l.tas_mps,
        body.slot_distance_m, body.min_separation_m,
        *((0.0, 0.0) if body.wind is UNSET else astuple(body.wind)),
    )  # fmt: skip
    return Row(numbers, intent, {} if name is UNSET else {"id": name})


def _colons(body: _Body, row: Row) -> int:
    """How many colons it has as JSON text: one to a key, and those of its `id`."""
    count = KEYS
    if body.wind is not UNSET:
        count += 3
    if body.leader.intent is not UNSET:
        count += 1 + sum([1 if side == 0.0 else 3 for side, _, _ in row.intent])
    if body.id is not UNSET:
        count += 1 + (body.id.count(":") if isinstance(body.id, str) else 0)
    return count


def _amounts(piece: _Piece) -> tuple[float, float, float] | None:
    """As in `Row.intent`; `None` if it is neither a straight nor a turn."""
    straight, heading, side, bank = astuple(piece)
    if heading is side is bank is UNSET and straight is not UNSET:
        return 0.0, straight, 0.0
    if straight is UNSET and UNSET not in (heading, side, bank):
        return SIDES[side], heading, bank
    return None


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
    wind_east, wind_north = _winds(wind_from, wind_speed)
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
        wind_east=wind_east,
        wind_north=wind_north,
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


def _winds(from_deg: Floats, speeds: Floats) -> Floats:
    """As `wind_of`, of columns: to the east and to the north, shape (2, n) [m/s]."""
    winds = list(zip(from_deg.tolist(), speeds.tolist(), strict=True))
    # many situations have one wind; numpy's sine and cosine differ in the last digit
    known = {wind: _wind(*wind) for wind in set(winds)}
    return np.array([known[wind] for wind in winds]).T


def _wind(from_deg: float, speed: float) -> tuple[float, float]:
    heading = heading_of(from_deg)
    return -speed * sin(heading), -speed * cos(heading)
