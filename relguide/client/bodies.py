"""Situations as the service takes them: the contract's reader the other way round."""

from collections.abc import Mapping
from math import atan2, degrees
from typing import Any

from relguide.planning.intent import ChangeLevel, FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
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
        },
        "leader": {
            "x_m": leader.x,
            "y_m": leader.y,
            "heading_deg": degrees(leader.heading),
            "tas_mps": leader.tas,
            "intent": [_piece(piece) for piece in leader.intent],
        },
        "slot_distance_m": asked.slot_distance,
        "min_separation_m": asked.min_separation,
        **_wind(asked.wind),
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
