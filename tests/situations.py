"""Hypothesis strategies for situations, near-degenerate ones on purpose, and the golden cases."""

import json
from functools import cache
from math import pi
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
