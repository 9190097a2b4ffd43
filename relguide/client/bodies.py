"""Situations as the service takes them: the contract's reader the other way round."""

from collections.abc import Mapping, Sequence
from math import atan2, degrees
from typing import Any, assert_never

from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.intent import ChangeLevel, FlyStraight, IntentPiece, LevelChange, TurnTo
from relguide.planning.situation import Other, Situation
from relguide.planning.trajectory import LEFT
from relguide.planning.wind import CALM, Wind

Asked = Situation | Mapping[str, Any]
"""A situation, or the JSON object of one."""


def body_of(asked: Asked) -> Mapping[str, Any]:
    """The JSON object of a situation; one that is given is taken."""
    if not isinstance(asked, Situation):
        return asked
    own, leader = asked.pursuer, asked.leader
    return {
        "pursuer": {
            "x_m": own.x,
            "y_m": own.y,
            "heading_deg": degrees(own.heading),
            "tas_mps": own.tas,
            "max_bank_deg": degrees(own.max_bank),
            **_altitude(own),
            **_levels(own.levels),
        },
        "leader": {
            "x_m": leader.x,
            "y_m": leader.y,
            "heading_deg": degrees(leader.heading),
            "tas_mps": leader.tas,
            "intent": [_piece(piece) for piece in leader.intent],
            **_altitude(leader),
        },
        "slot_distance_m": asked.slot_distance,
        "min_separation_m": asked.min_separation,
        **_wind(asked.wind),
        **_others(asked.others),
    }


def _altitude(aircraft: Pursuer | Leader | Traffic) -> dict[str, Any]:
    return {} if aircraft.altitude is None else {"altitude_m": aircraft.altitude}


def _levels(levels: Sequence[LevelChange]) -> dict[str, Any]:
    if not levels:
        return {}
    return {
        "levels": [
            {"at_s": level.at, "to_altitude_m": level.to_altitude, "rate_mps": level.rate}
            for level in levels
        ]
    }


def _others(others: Sequence[Other]) -> dict[str, Any]:
    """Those of each kind, if there are any."""
    written: dict[str, Any] = {}
    for other in others:
        match other:
            case Traffic():
                written.setdefault("traffic", []).append(_traffic(other))
            case Cell():
                written.setdefault("cells", []).append(_cell(other))
    return written


def _traffic(traffic: Traffic) -> dict[str, Any]:
    return {
        "ident": traffic.ident,
        "x_m": traffic.x,
        "y_m": traffic.y,
        "heading_deg": degrees(traffic.heading),
        "tas_mps": traffic.tas,
        **_altitude(traffic),
        "intent": [_piece(piece) for piece in traffic.intent],
        "min_separation_m": traffic.min_separation,
    }


def _cell(cell: Cell) -> dict[str, Any]:
    match cell.shape:
        case Disc(x=x, y=y, radius=radius):
            shape: dict[str, Any] = {"disc": {"x_m": x, "y_m": y, "radius_m": radius}}
        case Polygon(corners=corners):
            shape = {"polygon": [[x, y] for x, y in corners]}
        case _:
            assert_never(cell.shape)
    return {
        "ident": cell.ident,
        **shape,
        "velocity_mps": [cell.east, cell.north],
        "growth_mps": cell.growth,
    }


def _piece(piece: IntentPiece) -> dict[str, Any]:
    match piece:
        case FlyStraight(duration=duration):
            return {"straight_s": duration}
        case TurnTo(heading=heading, turn=turn, bank=bank):
            return {
                "turn_to_heading_deg": degrees(heading),
                "direction": "left" if turn == LEFT else "right",
                "bank_deg": degrees(bank),
            }
        case ChangeLevel(to_altitude=altitude, rate=rate, hold=hold):
            return {"level_change": {"to_altitude_m": altitude, "rate_mps": rate, "hold": hold}}


def _wind(wind: Wind) -> dict[str, Any]:
    if wind == CALM:
        return {}
    return {
        "wind": {
            "from_deg": degrees(atan2(-wind.east, -wind.north)) % 360.0,
            "speed_mps": wind.speed,
        }
    }
