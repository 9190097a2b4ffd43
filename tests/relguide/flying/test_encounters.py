"""Public encounters: the monitor names who comes too close before it does; guidance avoids it."""

import json
from math import radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from relguide import (
    Air,
    Aircraft,
    Alert,
    Declared,
    Guided,
    Link,
    SeparationLost,
    World,
    airframe,
    simulate,
    wind_from,
)
from relguide.flying.engagement import Engagement

ENCOUNTERS = json.loads(
    (Path(__file__).parents[2] / "golden" / "encounters.json").read_text(encoding="utf-8")
)["encounters"]
LEADER_AHEAD = 60e3
"""A leader on the pursuer's own course is so far ahead [m]."""
UNTIL = 420.0
"""All is over by then [s]."""


def aircraft(state: dict[str, Any], altitude: float, ident: str, kind: str) -> Aircraft:
    can = airframe("AT76" if state["tas_mps"] < 120.0 else "A306")
    return Aircraft(
        ident=ident,
        airframe=can,
        aircraft_type=can.designator,
        x=state["x_m"],
        y=state["y_m"],
        heading=radians(state["heading_deg"]),
        tas=state["tas_mps"],
        altitude=altitude,
        max_bank=radians(25.0),
        pilot=Guided() if kind == "guided" else Declared(),
    )


def world_of(encounter: dict[str, Any]) -> World:
    """All of an encounter, and a leader far ahead on the pursuer's own course."""
    own, altitude = encounter["own"], encounter["altitude_m"]
    heading = radians(own["heading_deg"])
    ahead = own | {
        "x_m": own["x_m"] + LEADER_AHEAD * np.sin(heading),
        "y_m": own["y_m"] + LEADER_AHEAD * np.cos(heading),
        "tas_mps": 0.95 * own["tas_mps"],
    }
    blows = encounter.get("wind", {"from_deg": 0.0, "speed_mps": 0.0})
    return World(
        aircraft=(
            aircraft(own, altitude, "OWN", "guided"),
            aircraft(ahead, altitude, "LEADER", "declared"),
            *(aircraft(o, altitude, o["ident"], "declared") for o in encounter["others"]),
        ),
        links=(
            Link(
                pursuer="OWN",
                leader="LEADER",
                slot_distance=max(12e3, encounter["min_separation_m"]),
                min_separation=encounter["min_separation_m"],
            ),
        ),
        air=Air(wind=wind_from(radians(blows["from_deg"]), blows["speed_mps"])),
    )


def losses_if_straight(encounter: dict[str, Any]) -> dict[str, float]:
    """Who comes too close if all keep straight, and when first [s].

    Uniform wind moves all alike.
    """

    def places(state: dict[str, Any], t: np.ndarray) -> np.ndarray:
        heading = radians(state["heading_deg"])
        way = state["tas_mps"] * t[:, None] * np.array([np.sin(heading), np.cos(heading)])
        return np.asarray(way + np.array([state["x_m"], state["y_m"]]))

    t = np.arange(0.0, UNTIL, 0.1)
    own, lost = places(encounter["own"], t), {}
    for other in encounter["others"]:
        near = np.hypot(*(places(other, t) - own).T) < encounter["min_separation_m"]
        if near.any():
            lost[other["ident"]] = float(t[np.argmax(near)])
    return lost


def flown(encounter: dict[str, Any], engagement: Engagement) -> list[object]:
    return list(
        simulate(world_of(encounter), engagement=engagement, until=UNTIL, sample_period=1.0)
    )


@pytest.mark.parametrize("encounter", ENCOUNTERS, ids=lambda one: one["name"])
def test_who_comes_too_close_is_named_before(encounter: dict[str, Any]) -> None:
    expected = losses_if_straight(encounter)
    assert expected, "an encounter in which nothing comes too close shows nothing"
    documents = flown(encounter, "off")
    lost = {one.other: one.t for one in documents if isinstance(one, SeparationLost)}
    assert set(lost) == set(expected)
    warned = {one.other for one in documents if isinstance(one, Alert)}
    first = min(expected, key=expected.__getitem__)
    assert first in warned
    for ident, t in expected.items():
        assert lost[ident] == pytest.approx(t, abs=2.0)
    for one in documents:
        if isinstance(one, SeparationLost):
            assert one.announced, f"{one.other} came too close without a word"


@pytest.mark.parametrize("encounter", ENCOUNTERS, ids=lambda one: one["name"])
def test_guidance_keeps_clear(encounter: dict[str, Any]) -> None:
    documents = flown(encounter, "engaged")
    assert not [one for one in documents if isinstance(one, SeparationLost)]
