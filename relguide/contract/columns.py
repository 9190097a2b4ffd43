"""Situations with positions as x and y, as columns in the library's units: for many at once."""

from collections.abc import Sequence
from dataclasses import fields
from math import cos, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from relguide.contract.bodies import LocalLeader, LocalPursuer, SituationBody
from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import LevelChangePiece, StraightPiece, TurnPiece
from relguide.planning import limits
from relguide.planning.batch import Floats, Situations
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.turning_batch import Intents, can_be_flown

SIDES = {"left": float(LEFT), "right": float(RIGHT)}


class Row(NamedTuple):
    """A situation, as it is in JSON."""

    numbers: tuple[float, ...]
    """In the order of `columns_of`."""
    intent: list[tuple[float, float, float]]
    """Of each piece ε, 0 for a straight; heading [°] or duration [s]; bank [°]."""


def row_of(body: SituationBody) -> Row | None:
    """The numbers of a situation; `None` if it has more than rows hold.

    That is positions on the earth, heights, other traffic or cells.
    """
    if body.traffic or body.cells:
        return None
    match body.pursuer, body.leader:
        case LocalPursuer(altitude_m=None) as p, LocalLeader(altitude_m=None) as l:
            intent = [piece for piece in l.intent if not isinstance(piece, LevelChangePiece)]
            if len(intent) < len(l.intent):
                return None
            return Row(
                (
                    p.x_m, p.y_m, p.heading_deg, p.tas_mps, p.max_bank_deg,
                    l.x_m, l.y_m, l.heading_deg, l.tas_mps,
                    body.slot_distance_m, body.min_separation_m,
                    body.wind.from_deg, body.wind.speed_mps,
                ),
                [_amounts(piece) for piece in intent],
            )  # fmt: skip
        case _:
            return None


def _amounts(piece: StraightPiece | TurnPiece) -> tuple[float, float, float]:
    """As in `Row.intent`."""
    match piece:
        case StraightPiece():
            return 0.0, piece.straight_s, 0.0
        case TurnPiece():
            return SIDES[piece.direction], piece.turn_to_heading_deg, piece.bank_deg


def columns_of(rows: Sequence[Row]) -> tuple[Situations, Intents, NDArray[np.bool_]]:
    """Rows in the library's units, and which of them are situations that can be flown."""
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
