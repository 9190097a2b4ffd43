"""The situations that all contenders are timed on: a straight leader, no wind, V_L < V_P."""

import json
from dataclasses import dataclass
from math import cos, radians, sin
from pathlib import Path

import numpy as np

from relguide import Leader, Pursuer, Situation
from relguide.planning.slot import SlotFrame, slot_frame

GOLDEN = Path(__file__).parents[1] / "golden"
FRESH = 240
"""How many situations are drawn beside the golden ones."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A situation, and what is known of it."""

    name: str
    situation: Situation
    frame: SlotFrame
    optimum: float | None
    """The best time without the separation limit [s] by an independent program, if there is one."""

    @property
    def unit(self) -> float:
        """R/V_P [s]."""
        return self.frame.radius / self.situation.pursuer.tas


def all_cases() -> list[Case]:
    return golden_cases() + fresh_cases()


def golden_cases() -> list[Case]:
    situations = _lines("reference.situations.jsonl")
    answers = _lines("reference.answers.jsonl")
    cases = []
    for given, answer in zip(situations, answers, strict=True):
        assert given["id"] == answer["id"]
        pursuer, leader = given["pursuer"], given["leader"]
        if leader["intent"] or leader["tas_mps"] >= pursuer["tas_mps"]:
            continue
        situation = Situation(
            pursuer=Pursuer(
                x=pursuer["x_m"],
                y=pursuer["y_m"],
                heading=radians(pursuer["heading_deg"]),
                tas=pursuer["tas_mps"],
                max_bank=radians(pursuer["max_bank_deg"]),
            ),
            leader=Leader(
                x=leader["x_m"],
                y=leader["y_m"],
                heading=radians(leader["heading_deg"]),
                tas=leader["tas_mps"],
            ),
            slot_distance=given["slot_distance_m"],
            min_separation=given["min_separation_m"],
        )
        cases.append(_case(given["id"], situation, answer.get("unlimited_time_s")))
    return [case for case in cases if case.optimum is not None]


def fresh_cases() -> list[Case]:
    """Drawn over the range that the golden ones cover; the same every time."""
    rng = np.random.default_rng(2003)
    cases = []
    for number in range(FRESH):
        far, bearing = rng.uniform(15e3, rng.choice([40e3, 150e3])), rng.uniform(0, 360)
        tas = rng.uniform(180, 250)
        situation = Situation(
            pursuer=Pursuer(
                x=float(far * sin(radians(bearing))),
                y=float(far * cos(radians(bearing))),
                heading=radians(rng.uniform(0, 360)),
                tas=float(tas),
                max_bank=radians(rng.uniform(15, 30)),
            ),
            leader=Leader(
                x=0.0, y=0.0, heading=radians(rng.uniform(0, 360)), tas=tas * rng.uniform(0.6, 0.98)
            ),
            slot_distance=float(rng.uniform(10e3, 20e3)),
            min_separation=float(rng.uniform(5.5e3, 9.3e3)),
        )
        cases.append(_case(f"fresh {number}", situation, None))
    return cases


def _case(name: str, situation: Situation, optimum: float | None) -> Case:
    frame = slot_frame(situation, situation.leader.trajectory)
    return Case(name=name, situation=situation, frame=frame, optimum=optimum)


def _lines(name: str) -> list[dict]:
    lines = (GOLDEN / name).read_text().splitlines()
    return [row for row in map(json.loads, lines) if "id" in row]
