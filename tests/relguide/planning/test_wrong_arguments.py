"""Whatever a public function is given, only a ValueError comes out, with a sentence."""

from collections.abc import Callable
from dataclasses import fields
from decimal import Decimal
from fractions import Fraction
from math import inf, nan, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import relguide
from relguide import (
    CALM,
    LEFT,
    RIGHT,
    Air,
    Aircraft,
    Airframe,
    Arc,
    BoundaryArc,
    Declared,
    DeclaredLeader,
    FlyStraight,
    Grid,
    Guided,
    IntentKnown,
    Leader,
    LeaderData,
    LeaderHeading,
    LeaderSpeed,
    Link,
    NoPlan,
    Plan,
    Pursuer,
    PursuerHeading,
    Reason,
    Recorded,
    RecordedTrack,
    Scenario,
    SetEngagement,
    Settings,
    Situation,
    Situations,
    Straight,
    Trajectory,
    TurnTo,
    Wind,
    World,
    airframe,
    alternatives,
    candidates,
    certify,
    check,
    fly,
    isochrones,
    own_scenario,
    plan,
    plan_arrays,
    progress_bar,
    prove,
    record,
    scenario,
    scenario_behind,
    simulate,
    wind_from,
)
from relguide.planning.frames import LocalPlane
from relguide.units import DEG

PURSUER = Pursuer(x=-40e3, y=-20e3, heading=1.0, tas=240.0, max_bank=25 * DEG)
LEADER = Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)
SITUATION = Situation(pursuer=PURSUER, leader=LEADER, slot_distance=12e3, min_separation=9e3)
COLUMNS = {
    "pursuer_x": -20e3,
    "pursuer_y": 19e3,
    "pursuer_heading": 1.0,
    "pursuer_tas": 240.0,
    "max_bank": 25 * DEG,
    "leader_x": 0.0,
    "leader_y": 0.0,
    "leader_heading": 0.0,
    "leader_tas": 200.0,
    "slot_distance": 12e3,
    "min_separation": 9e3,
    "wind_east": 0.0,
    "wind_north": 0.0,
}


def find_plan() -> Plan:
    answer = plan(SITUATION)
    assert isinstance(answer, Plan)
    return answer


PLAN = find_plan()
PATH = PLAN.trajectory
SECONDS = np.arange(200.0)
TRACK = RecordedTrack(
    ident="REC1",
    aircraft_type="A320",
    origin=LocalPlane(48.0, 2.0),
    t=SECONDS,
    x=180.0 * SECONDS,
    y=0.0 * SECONDS,
    track=np.full(200, 0.5 * pi),
    ground_speed=np.full(200, 180.0),
    altitude=np.full(200, 5_000.0),
)
A306 = airframe("A306")
OWN: dict[str, Any] = {
    "ident": "OWN", "airframe": A306, "aircraft_type": "A306", "x": -40e3, "y": 0.0, "heading": 0.0,
    "tas": 240.0, "altitude": 9e3, "max_bank": 25 * DEG, "pilot": Guided(), "believed": None,
}  # fmt: skip
OTHER: dict[str, Any] = OWN | {"ident": "OTHER", "x": 0.0, "tas": 200.0, "pilot": Declared()}
LINK: dict[str, Any] = {
    "pursuer": "OWN", "leader": "OTHER", "slot_distance": 12e3, "min_separation": 9e3,
    "spacing": 0.0, "intent_known": True, "declared_intent": None,
}  # fmt: skip
WORLD: dict[str, Any] = {
    "aircraft": (Aircraft(**OWN), Aircraft(**OTHER)), "links": (Link(**LINK),), "air": Air(),
    "believed_air": None, "settings": Settings(),
}  # fmt: skip
CALLS: dict[str, tuple[Callable[..., object], dict[str, Any]]] = {
    "Leader": (
        Leader,
        {"x": 0.0, "y": 0.0, "heading": 0.0, "tas": 200.0, "intent": (FlyStraight(duration=1.0),)},
    ),
    "FlyStraight": (FlyStraight, {"duration": 60.0}),
    "Pursuer": (
        Pursuer,
        {"x": 0.0, "y": 0.0, "heading": 0.0, "tas": 200.0, "max_bank": 25 * DEG},
    ),
    "Situation": (
        Situation,
        {
            "pursuer": PURSUER,
            "leader": LEADER,
            "slot_distance": 12e3,
            "min_separation": 9e3,
            "wind": CALM,
        },
    ),
    "Situations": (lambda **columns: Situations(**columns).columns(), COLUMNS),
    "Trajectory": (
        Trajectory,
        {"x": 0.0, "y": 0.0, "heading": 0.0, "tas": 200.0, "segments": (Straight(length=1.0),)},
    ),
    "TurnTo": (TurnTo, {"heading": 1.0, "turn": LEFT, "bank": 20 * DEG}),
    "Wind": (Wind, {"east": 1.0, "north": 2.0}),
    "alternatives": (alternatives, {"plan": PLAN}),
    "candidates": (candidates, {"situation": SITUATION}),
    "certify": (certify, {"trajectory": PATH, "situation": SITUATION}),
    "check": (check, {"flown": PLAN, "situation": SITUATION, "samples": 3, "arrives": 1e-5}),
    "plan": (plan, {"situation": SITUATION}),
    "plan_arrays": (
        plan_arrays,
        {"situations": Situations(**COLUMNS), "limited": True, "threads": 1, "progress": None},
    ),
    "pose_at": (PATH.pose_at, {"t": 1.0}),
    "sample": (PATH.sample, {"t": [1.0, 2.0]}),
    "over_ground": (PATH.over_ground, {"wind": CALM, "t": [1.0, 2.0]}),
    "from_trajectory": (
        Plan.from_trajectory,
        {"trajectory": PATH, "situation": SITUATION, "planner": "own", "lower_bound": 1.0},
    ),
    "Grid": (Grid, {"x": 0.0, "y": 0.0, "width": 5e4, "height": 4e4, "columns": 4, "rows": 3}),
    "isochrones": (
        isochrones,
        {
            "situation": SITUATION,
            "grid": Grid(x=0.0, y=0.0, columns=4, rows=3),
            "levels": (300.0,),
            "evaluate": None,
            "exact": False,
            "threads": 1,
            "progress": print,
        },
    ),
    "Scenario": (
        Scenario,
        {
            "name": "own",
            "title": "",
            "description": "",
            "situation": SITUATION,
            "intent_known": True,
            "leader_source": DeclaredLeader(),
            "altitude": 9e3,
            "duration_limit": 1.0,
            "after_joining": 0.0,
        },
    ),
    "fly": (
        fly,
        {
            "scenario": scenario("fig_6a"),
            "planner": plan,
            "commands": lambda t: (),
            "step": 0.05,
            "sample_period": 1.0,
            "seed": 0,
        },
    ),
    "Air": (Air, {"wind": CALM, "isa_deviation": 10.0}),
    "Aircraft": (Aircraft, OWN),
    "Airframe": (Airframe, {field.name: getattr(A306, field.name) for field in fields(A306)}),
    "Declared": (Declared, {"intent": (FlyStraight(duration=1.0),)}),
    "IntentKnown": (IntentKnown, {"known": False}),
    "LeaderData": (LeaderData, {"received": False}),
    "LeaderHeading": (LeaderHeading, {"heading": 1.0, "direction": "left"}),
    "LeaderSpeed": (LeaderSpeed, {"tas": 190.0}),
    "Link": (Link, LINK),
    "PursuerHeading": (PursuerHeading, {"heading": 1.0}),
    "Recorded": (Recorded, {"track": TRACK}),
    "SetEngagement": (SetEngagement, {"engagement": "armed"}),
    "Settings": (Settings, {"damping": 0.8, "caution": 60, "always_ask": False}),
    "World": (World, WORLD),
    "airframe": (airframe, {"designator": "A306"}),
    "simulate": (
        simulate,
        {
            "world": World(**WORLD),
            "planner": plan,
            "scenario": "own",
            "title": "",
            "planner_name": "exact",
            "commands": lambda t: (),
            "step": 0.05,
            "sample_period": 1.0,
            "seed": 0,
            "until": 1.0,
            "after_joining": 0.0,
            "engagement": "engaged",
        },
    ),
    "scenario": (scenario, {"name": "fig_6a"}),
    "own_scenario": (own_scenario, {"situation": SITUATION, "intent_known": False}),
    "scenario_behind": (scenario_behind, {"track": TRACK, "behind": 3e4, "abeam": 2e4}),
    "record": (record, {"documents": (), "file": "flight.jsonl"}),
    "progress_bar": (lambda title, total: list(show(title, total)), {"title": "", "total": 1.0}),
    "prove": (prove, {"plan": PLAN, "seconds": 0.0, "progress": iter}),
    "wind_from": (wind_from, {"direction": 1.0, "speed": 10.0}),
}
"""What may be called, with arguments that are right."""
ANSWERS = {
    "Alert", "Alternative", "Arrival", "Candidate", "Certificate", "Document",
    "EngagementChanged", "FlightEnded", "FlightStarted", "ForecastChanged", "Isochrones",
    "LeaderChanged", "LeaderRoute", "ModeChanged", "NoPlan", "Optimality", "OptimalityReport",
    "Plan", "PlanChanged", "PlanProposed", "PlanRefused", "PlanUnavailable", "Planner", "Pose",
    "Reason", "Sample", "Samples", "SeparationLost", "TimeRow", "Times", "Unable",
}  # fmt: skip
"""What calls give back, and is not asked for."""
UNIONS = {"Command"}
"""What is one of several that are called."""
PARTS = {"Arc", "BoundaryArc", "DeclaredLeader", "Guided", "RecordedTrack", "Straight"}
"""What a `Trajectory` or a `Scenario` checks as it is made of them."""
FILES = {"load_airframe", "load_settings", "load_track", "replay"}
"""What reads a file: tests of its own say what it refuses."""
METHODS = {"from_trajectory", "over_ground", "pose_at", "sample"}
ARGUMENTS = [(name, argument) for name, (_, given) in CALLS.items() for argument in given]

junk = st.one_of(
    st.none(),
    st.booleans(),
    st.text(max_size=3),
    st.binary(max_size=3),
    st.integers(),
    st.floats(),
    st.complex_numbers(),
    st.fractions(),
    st.decimals(),
    st.lists(st.floats(), max_size=3),
    st.tuples(st.floats()),
    st.dictionaries(st.text(max_size=2), st.floats(), max_size=2),
    st.sampled_from(
        [
            nan,
            inf,
            -inf,
            10**400,
            np.True_,
            np.float64(nan),
            np.float32(inf),
            np.int64(-3),
            np.array(1.0),
            np.array([1.0, nan]),
            np.array(["a"]),
            np.datetime64("2003-08-11"),
            Decimal("NaN"),
            Fraction(-1, 3),
            object(),
            ((1.0,), 2.0),
            [[1.0], [1.0, 2.0]],
            PURSUER,
            LEADER,
            SITUATION,
            PATH,
            PLAN,
            NoPlan(reason=Reason.SLOT_UNREACHABLE, message="None."),
        ]
    ),
)


def world(pursuer: str = "OWN", leader: str = "OTHER", tas: float = 240.0) -> World:
    link = Link(**LINK | {"pursuer": pursuer, "leader": leader})
    return World(aircraft=(Aircraft(**OWN | {"tas": tas}), Aircraft(**OTHER)), links=(link,))


def flown_with(command: Any) -> object:
    return list(simulate(World(**WORLD), commands=lambda t: (command,), until=1.0))


def show(title: Any, total: Any) -> Any:
    with progress_bar(title, total=total) as count:
        yield count(0.0)


def test_all_that_can_be_called_is() -> None:
    public = {name for name in relguide.__all__ if name not in ("CALM", "LEFT", "RIGHT")}
    assert public == (set(CALLS) | ANSWERS | UNIONS | PARTS | FILES) - METHODS


@pytest.mark.parametrize("name", CALLS)
def test_right_arguments_are_answered(name: str) -> None:
    call, right = CALLS[name]
    call(**right)


@pytest.mark.parametrize(("name", "argument"), ARGUMENTS)
@settings(max_examples=40)
@given(wrong=junk)
def test_a_wrong_argument_is_refused_with_a_sentence(name: str, argument: str, wrong: Any) -> None:
    call, right = CALLS[name]
    try:
        call(**{**right, argument: wrong})
    except ValueError as refusal:
        said = str(refusal)
    else:
        return
    assert said.endswith(".")
    assert any(
        word in said
        for word in ("must", "at least", "at most", "reaches", "headway", "there are", "choose")
    )


@given(amount=junk, other=junk, boundary_arc=junk)
def test_a_wrong_segment_is_refused_with_a_sentence(
    amount: Any, other: Any, boundary_arc: Any
) -> None:
    for segment in (
        Straight(length=amount),
        Arc(turn=LEFT, turn_angle=amount, radius=1e3),
        Arc(turn=LEFT, turn_angle=1.0, radius=amount),
        Arc(turn=other, turn_angle=amount, radius=1e3),
        BoundaryArc(side=LEFT, bends=boundary_arc),
        BoundaryArc(side=LEFT, bends=(boundary_arc,)),  # type: ignore[arg-type]
        BoundaryArc(side=LEFT, bends=((amount, other),)),
        BoundaryArc(side=other, bends=((1.0, 0.0),)),
        amount,
    ):
        try:
            path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(segment,))
        except ValueError as refusal:
            said = str(refusal)
        else:
            certify(path, SITUATION)
            path.breakpoints()
            continue
        assert "must" in said
        assert said.endswith(".")


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
        (lambda: Declared(intent=(1,)), r"intent\[0\] must be a FlyStraight or a TurnTo"),  # type: ignore[arg-type]
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


@pytest.mark.parametrize("value", [1, np.float32(1.0), np.int64(1), Fraction(1)])
def test_segments_are_of_floats(value: Any) -> None:
    segments = (
        Straight(length=value),
        Arc(turn=np.int64(1), turn_angle=value, radius=value),  # type: ignore[arg-type]
        BoundaryArc(side=np.int64(-1), bends=((value, value),)),  # type: ignore[arg-type]
    )
    path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=segments)
    assert repr(path.segments) == repr(
        (
            Straight(length=1.0),
            Arc(turn=LEFT, turn_angle=1.0, radius=1.0),
            BoundaryArc(side=RIGHT, bends=((1.0, 1.0),)),
        )
    )


@pytest.mark.parametrize("seconds", [0, np.float64(0.0), np.int64(0), Fraction(0)])
def test_other_numbers_will_do(seconds: Any) -> None:
    assert prove(PLAN, seconds=seconds) == PLAN
