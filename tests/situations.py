"""Hypothesis strategies for situations, near-degenerate ones on purpose, and the golden cases."""

import json
from dataclasses import replace
from functools import cache
from math import cos, pi, sin
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from relguide import (
    LEFT,
    RIGHT,
    FlyStraight,
    Leader,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
)
from relguide.contract.bodies import situation_from_json
from relguide.units import DEG

GOLDEN = Path(__file__).parent / "golden"


@cache
def golden(name: str) -> tuple[tuple[Situation, dict[str, Any]], ...]:
    """Situations and answers of one golden file."""
    situations = (GOLDEN / f"{name}.situations.jsonl").read_text().splitlines()
    answers = (GOLDEN / f"{name}.answers.jsonl").read_text().splitlines()
    pairs = []
    for line, answer in zip(situations, answers, strict=True):
        body = json.loads(line)
        assert body.pop("id") == json.loads(answer)["id"]
        pairs.append((situation_from_json(body)[0], json.loads(answer)))
    return tuple(pairs)


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


headings = st.one_of(
    numbers(0.0, 2.0 * pi), st.sampled_from([0.0, 0.5 * pi, pi, 1.5 * pi, 1e-7, 2.0 * pi - 1e-7])
)
intents = st.lists(
    st.one_of(
        st.builds(FlyStraight, duration=numbers(0.0, 300.0)),
        st.builds(
            TurnTo,
            heading=headings,
            turn=st.sampled_from([LEFT, RIGHT]),
            bank=numbers(10.0 * DEG, 30.0 * DEG),
        ),
    ),
    max_size=3,
).map(tuple)


@st.composite
def situations(
    draw: st.DrawFn,
    *,
    with_intent: bool = True,
    with_wind: bool = True,
    speed_ratio: tuple[float, float] = (0.6, 0.98),
    reach: float = 150_000.0,
) -> Situation:
    """Situations of airliners within `reach` [m] of each other."""
    tas = draw(numbers(150.0, 260.0))
    slot_distance = draw(numbers(8_000.0, 20_000.0))
    min_separation = draw(numbers(5_500.0, 9_300.0).filter(lambda d: d <= slot_distance))
    return Situation(
        pursuer=Pursuer(
            x=draw(numbers(-reach, reach)),
            y=draw(numbers(-reach, reach)),
            heading=draw(headings),
            tas=tas,
            max_bank=draw(numbers(15.0, 30.0)) * DEG,
        ),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=draw(headings),
            tas=tas * draw(numbers(*speed_ratio)),
            intent=draw(intents) if with_intent else (),
        ),
        slot_distance=slot_distance,
        min_separation=min_separation,
        wind=draw(st.builds(Wind, east=numbers(-40.0, 40.0), north=numbers(-40.0, 40.0)))
        if with_wind
        else Wind(),
    )


COINCIDENCES = (
    "slot at the limit",
    "start at the limit",
    "same heading",
    "opposite heading",
    "on the slot",
    "on the track",
    "same speed",
)
"""Numbers that are equal to the last digit, as people enter them."""


@st.composite
def coincidences(
    draw: st.DrawFn,
    *,
    kinds: tuple[str, ...] = COINCIDENCES,
    with_intent: bool = False,
    with_wind: bool = False,
    reach: float = 40_000.0,
) -> Situation:
    """Situations in which some of `kinds` hold exactly; several at once as well."""
    situation = draw(situations(with_intent=with_intent, with_wind=with_wind, reach=reach))
    held = draw(st.lists(st.sampled_from(kinds), min_size=1, max_size=3, unique=True))
    if "slot at the limit" in held:
        situation = replace(situation, slot_distance=situation.min_separation)
    pursuer, leader = situation.pursuer, situation.leader
    if "same speed" in held:
        leader = replace(leader, tas=pursuer.tas)
    if "same heading" in held:
        pursuer = replace(pursuer, heading=leader.heading)
    if "opposite heading" in held:
        # east and west, as round numbers are entered, are half a turn apart to the last digit
        leader = replace(leader, heading=0.5 * pi)
        pursuer = replace(pursuer, heading=1.5 * pi)
    # behind the leader: where the slot is, within the limit or beside both
    behind = 0.0
    if "on the slot" in held:
        behind = situation.slot_distance
    elif "start at the limit" in held:
        behind = situation.min_separation
    elif "on the track" in held:
        behind = draw(numbers(-reach, reach))
    if behind != 0.0:
        pursuer = replace(pursuer, x=-behind * sin(leader.heading), y=-behind * cos(leader.heading))
    return replace(situation, pursuer=pursuer, leader=leader)
