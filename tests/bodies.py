"""A situation as outsiders send it, to be changed a field at a time, and placed on the earth."""

import copy
from typing import Any

BODY: dict[str, Any] = {
    "pursuer": {
        "x_m": -40000,
        "y_m": 40000,
        "heading_deg": 90,
        "tas_mps": 235,
        "max_bank_deg": 25,
    },
    "leader": {
        "x_m": 0,
        "y_m": 0,
        "heading_deg": 90,
        "tas_mps": 200,
        "intent": [
            {"straight_s": 60},
            {"turn_to_heading_deg": 135, "direction": "right", "bank_deg": 20},
        ],
    },
    "slot_distance_m": 12000,
    "min_separation_m": 9260,
    "wind": {"from_deg": 270, "speed_mps": 15},
}

TRAFFIC: list[dict[str, Any]] = [
    {
        "ident": "BAW12",
        "x_m": 200000,
        "y_m": 150000,
        "heading_deg": 200,
        "tas_mps": 220,
        "altitude_m": 9000,
        "intent": [
            {"straight_s": 30},
            {"level_change": {"to_altitude_m": 8000, "rate_mps": 8, "hold": "mach"}},
            {"turn_to_heading_deg": 90, "direction": "left", "bank_deg": 20},
        ],
        "min_separation_m": 5000,
    },
    {"ident": "AFR7", "x_m": -150000, "y_m": 0, "heading_deg": 0, "tas_mps": 200},
]
"""Other aircraft that are far away."""
CELLS: list[dict[str, Any]] = [
    {
        "ident": "CB1",
        "disc": {"x_m": -200000, "y_m": 0, "radius_m": 20000},
        "velocity_mps": [10, -5],
        "growth_mps": 2,
    },
    {"ident": "CB2", "polygon": [[-90000, -150000], [-50000, -150000], [-70000, -120000]]},
]
"""Weather that is far away."""
AMID: dict[str, Any] = {**BODY, "traffic": TRAFFIC, "cells": CELLS}


def change(path: str, value: Any) -> dict[str, Any]:
    """BODY with one field set, or removed if the value is `...`."""
    return changed(BODY, path, value)


def changed(body: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    """The same of any body."""
    body = copy.deepcopy(body)
    put(body, path, value)
    return body


def put(body: dict[str, Any], path: str, value: Any) -> None:
    """Set one field of a body, or remove it if the value is `...`."""
    *way, last = path.split(".")
    here: Any = body
    for step in way:
        here = here[int(step)] if step.isdigit() else here[step]
    if value is ...:
        del here[last]
    elif last.isdigit():
        here[int(last)] = value
    else:
        here[last] = value


def on_earth(pursuer: tuple[float, float], leader: tuple[float, float]) -> dict[str, Any]:
    """BODY with both aircraft at latitude and longitude."""
    body = copy.deepcopy(BODY)
    for name, (lat, lon) in (("pursuer", pursuer), ("leader", leader)):
        del body[name]["x_m"], body[name]["y_m"]
        body[name] |= {"lat_deg": lat, "lon_deg": lon}
    return body
