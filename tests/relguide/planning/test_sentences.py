"""What a refusal says: what was given, and what would be right."""

from collections.abc import Callable
from fractions import Fraction
from math import nan
from typing import Any

import numpy as np
import pytest

from relguide import (
    Aircraft,
    Declared,
    IntentKnown,
    LeaderData,
    LeaderHeading,
    LeaderSpeed,
    Link,
    PursuerHeading,
    SetEngagement,
    Situations,
    World,
    airframe,
    alternatives,
    check,
    plan_arrays,
    prove,
    simulate,
)
from tests.calls import COLUMNS, LINK, OTHER, OWN, PLAN, SITUATION, WORLD, show


def world(pursuer: str = "OWN", leader: str = "OTHER", tas: float = 240.0) -> World:
    link = Link(**LINK | {"pursuer": pursuer, "leader": leader})
    return World(aircraft=(Aircraft(**OWN | {"tas": tas}), Aircraft(**OTHER)), links=(link,))


def flown_with(command: Any) -> object:
    return list(simulate(World(**WORLD), commands=lambda t: (command,), until=1.0))


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: prove(None, seconds=1.0), "plan must be a Plan, not None"),  # type: ignore[arg-type]
        (lambda: prove(PLAN, seconds="1"), "must be a number, not '1' .str."),  # type: ignore[arg-type]
        (lambda: prove(PLAN, seconds=True), "must be a number, not True"),
        (lambda: prove(PLAN, seconds=nan), "must be a finite number"),
        (lambda: prove(PLAN, seconds=1.0, progress=3), "must be a function"),  # type: ignore[arg-type]
        (lambda: alternatives(SITUATION), "plan must be a Plan"),  # type: ignore[arg-type]
        (lambda: check(None, SITUATION), "must be a Plan or a Trajectory"),  # type: ignore[arg-type]
        (lambda: check(PLAN, SITUATION, arrives=nan), "arrives must be a finite number"),
        (lambda: list(show("", "ten")), "total must be a number, not 'ten'"),
        (lambda: Situations(**{**COLUMNS, "leader_x": [[1.0], []]}).columns(), "leader_x must be"),
        (lambda: plan_arrays(Situations(**COLUMNS), threads=True), "a whole number of 1 or more"),
        (lambda: plan_arrays(Situations(**COLUMNS), limited=None), "limited must be True or"),  # type: ignore[arg-type]
        (lambda: check(PLAN, SITUATION, samples=0), "samples must lie in 1 … 100000, not 0"),
        (lambda: Aircraft(**OWN | {"ident": " "}), "ident must not be empty"),
        (lambda: Aircraft(**OWN | {"altitude": 31_000.0}), "altitude must lie in -500 … 20000 m"),
        (lambda: Aircraft(**OWN | {"max_bank": 25.0}), "max_bank must lie in 1 … 60 °"),
        (lambda: Aircraft(**OWN | {"pilot": "me"}), "must be a Guided or a Declared or a Recorded"),
        (
            lambda: Declared(intent=(1,)),
            r"intent\[0\] must be a FlyStraight, a TurnTo or a ChangeLevel",
        ),  # type: ignore[arg-type]
        (lambda: Link(**LINK | {"slot_distance": 5e3}), "must be at least min_separation"),
        (lambda: Link(**LINK | {"spacing": 900.0}), "spacing must lie in 0 … 600 s"),
        (lambda: World(**WORLD | {"aircraft": Aircraft(**OWN)}), "must be a tuple of Aircraft"),
        (lambda: World(**WORLD | {"links": (1,)}), r"links\[0\] must be a Link, not 1"),
        (lambda: world("OTHER", "OWN"), "pilot of 'OTHER' must be Guided\\(\\) to join a leader"),
        (lambda: world("OWN", "X"), "no aircraft 'X' to link: there are OWN, OTHER"),
        (lambda: world("OWN", "OWN"), "cannot follow itself: choose another leader"),
        (lambda: world(tas=330.0), "The A306 cannot fly 641 kt at FL295: .*choose"),
        (lambda: simulate(World(**WORLD), until=0.0), "until must be above 0 s"),
        (lambda: simulate(World(**WORLD), engagement="on"), "must be one of off, designated"),  # type: ignore[arg-type]
        (lambda: flown_with(3), "A command must be a LeaderHeading or a LeaderSpeed or .* not 3"),
        (lambda: LeaderHeading(heading=nan), "heading must be a finite number, not nan"),
        (lambda: LeaderHeading(heading=1.0, direction="up"), "must be left, right or shorter"),  # type: ignore[arg-type]
        (lambda: LeaderSpeed(tas=500.0), "tas must lie in 30 … 400 m/s, not 500 m/s"),
        (lambda: IntentKnown(known=None), "known must be True or False, not None"),  # type: ignore[arg-type]
        (lambda: LeaderData(received=1), "received must be True or False, not 1"),
        (lambda: PursuerHeading(heading="north"), "heading must be a number, not 'north'"),  # type: ignore[arg-type]
        (lambda: SetEngagement(engagement="on"), "must be one of off, designated, armed, engaged"),  # type: ignore[arg-type]
        (lambda: airframe("A380"), "There is no airframe 'A380': choose one of"),
    ],
)
def test_sentences_say_what_would_be_right(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        call()


@pytest.mark.parametrize("seconds", [0, np.float64(0.0), np.int64(0), Fraction(0)])
def test_other_numbers_will_do(seconds: Any) -> None:
    assert prove(PLAN, seconds=seconds) == PLAN
