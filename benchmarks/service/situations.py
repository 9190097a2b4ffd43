"""Situations as the service takes them: drawn ones, plain ones, and some that take long."""

from math import degrees
from typing import Any

import numpy as np
from relguide_server.planning.plans import EXAMPLE

from benchmarks.deadline import draw
from relguide import LEFT, FlyStraight, Situation
from relguide.contract.compass import compass
from relguide.flying.cards import wind_card

STRAIGHT = {**EXAMPLE, "leader": {**EXAMPLE["leader"], "intent": []}}
"""Planned within 0.1 ms, as most are."""
HEAD_ON = {
    **STRAIGHT,
    "pursuer": {**EXAMPLE["pursuer"], "x_m": 0.0, "y_m": 30e3, "heading_deg": 180.0},
    "leader": {**STRAIGHT["leader"], "heading_deg": 0.0},
    "slot_distance_m": 12e3,
}
"""The limit binds: a worker plans it, in some 10 ms."""


def heavy(count: int) -> list[dict[str, Any]]:
    """Situations with twenty pieces of intent, among the slowest that are accepted."""
    found, case = [], 0
    while len(found) < count:
        situation = draw(np.random.default_rng([1, case]))
        case += 1
        if len(situation.leader.intent) == 20 and situation.min_separation > 0.0:
            found.append(body_of(situation))
    return found


def body_of(situation: Situation) -> dict[str, Any]:
    """A situation as a JSON object."""
    pursuer, leader = situation.pursuer, situation.leader
    wind = wind_card(situation.wind)
    return {
        "pursuer": {
            "x_m": pursuer.x,
            "y_m": pursuer.y,
            "heading_deg": compass(degrees(pursuer.heading)),
            "tas_mps": pursuer.tas,
            "max_bank_deg": degrees(pursuer.max_bank),
        },
        "leader": {
            "x_m": leader.x,
            "y_m": leader.y,
            "heading_deg": compass(degrees(leader.heading)),
            "tas_mps": leader.tas,
            "intent": [_piece(piece) for piece in leader.intent],
        },
        "slot_distance_m": situation.slot_distance,
        "min_separation_m": situation.min_separation,
        "wind": {"from_deg": compass(degrees(wind.from_)), "speed_mps": wind.speed},
    }


def _piece(piece: object) -> dict[str, Any]:
    if isinstance(piece, FlyStraight):
        return {"straight_s": piece.duration}
    return {
        "turn_to_heading_deg": compass(degrees(piece.heading)),
        "direction": "left" if piece.turn == LEFT else "right",
        "bank_deg": degrees(piece.bank),
    }
