"""What may be called of the library, with arguments that are right."""

from collections.abc import Callable
from dataclasses import fields
from math import pi
from typing import Any

import numpy as np

from relguide import (
    CALM,
    LEFT,
    Air,
    Aircraft,
    Airframe,
    Cell,
    ChangeLevel,
    CrewOrder,
    Declared,
    DeclaredLeader,
    Disc,
    FlyStraight,
    Follower,
    Grid,
    Guided,
    IntentKnown,
    Leader,
    LeaderData,
    LeaderHeading,
    LeaderLevel,
    LeaderReport,
    LeaderSpeed,
    LevelChange,
    Link,
    PilotModel,
    Plan,
    Polygon,
    Pursuer,
    PursuerBank,
    PursuerHeading,
    PursuerSpeed,
    Recorded,
    RecordedTrack,
    Scenario,
    ScriptedCrew,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    SetSpacing,
    Settings,
    Situation,
    Situations,
    Stick,
    Straight,
    Surveillance,
    Traffic,
    Trajectory,
    TurnTo,
    Wind,
    WindProfile,
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
    queue_up,
    record,
    scenario,
    scenario_behind,
    simulate,
    soonest_first,
    wind_from,
    with_crew,
)
from relguide.flying.surveillance import EXACT
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


def show(title: Any, total: Any) -> Any:
    with progress_bar(title, total=total) as count:
        yield count(0.0)


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
    "Traffic": (
        Traffic,
        {
            "ident": "BAW12",
            "x": 50e3,
            "y": 0.0,
            "heading": 0.0,
            "tas": 220.0,
            "min_separation": 9e3,
            "intent": (FlyStraight(duration=1.0),),
            "altitude": 9e3,
        },
    ),
    "Disc": (Disc, {"x": 0.0, "y": 50e3, "radius": 9e3}),
    "Polygon": (Polygon, {"corners": ((0.0, 0.0), (1e3, 0.0), (0.0, 1e3))}),
    "Cell": (
        Cell,
        {
            "ident": "CB1",
            "shape": Disc(x=0.0, y=50e3, radius=9e3),
            "east": 5.0,
            "north": 0.0,
            "growth": 1.0,
        },
    ),
    "LevelChange": (LevelChange, {"at": 0.0, "to_altitude": 9e3, "rate": 8.0}),
    "ChangeLevel": (ChangeLevel, {"to_altitude": 9e3, "rate": 8.0, "hold": "cas"}),
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
            "gusts": 0.0,
            "profile": None,
            "believed_air": None,
            "surveillance": EXACT,
            "by_hand": PilotModel(),
            "ahead": (),
            "followers": (),
            "duration_limit": 1.0,
            "after_joining": 0.0,
        },
    ),
    "PilotModel": (PilotModel, {f.name: getattr(PilotModel(), f.name) for f in fields(PilotModel)}),
    "Follower": (
        Follower,
        {
            "ident": "SECOND",
            "pursuer": SITUATION.pursuer,
            "aircraft_type": "A306",
            "weight": 140e3,
        },
    ),
    "queue_up": (
        queue_up,
        {
            "followers": ("A", "B"),
            "leader": "LEAD",
            "slot_distance": 12e3,
            "min_separation": 9260.0,
            "spacing": 60.0,
            "intent_known": True,
            "declared_intent": None,
        },
    ),
    "soonest_first": (
        soonest_first,
        {
            "followers": (Aircraft(**OWN),),
            "leader": Aircraft(**OWN),
            "slot_distance": 12e3,
            "min_separation": 9260.0,
            "wind": CALM,
            "planner": plan,
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
            "wants_fan": lambda t: False,
        },
    ),
    "Air": (Air, {"wind": CALM, "isa_deviation": 10.0}),
    "Aircraft": (Aircraft, OWN),
    "Surveillance": (Surveillance, {"kind": "adsb", "nacp": 9, "loss_share": 0.05}),
    "WindProfile": (WindProfile, {"levels": ((9_000.0, CALM), (3_000.0, CALM))}),
    "Airframe": (Airframe, {field.name: getattr(A306, field.name) for field in fields(A306)}),
    "Declared": (Declared, {"intent": (FlyStraight(duration=1.0),)}),
    "IntentKnown": (IntentKnown, {"known": False}),
    "LeaderData": (LeaderData, {"received": False}),
    "LeaderHeading": (LeaderHeading, {"heading": 1.0, "direction": "left"}),
    "LeaderLevel": (LeaderLevel, {"altitude": 8e3, "rate": 8.0}),
    "LeaderReport": (
        LeaderReport,
        {"x": 1e3, "y": 2e3, "track": 1.0, "ground_speed": 200.0, "altitude": 8e3},
    ),
    "LeaderSpeed": (LeaderSpeed, {"tas": 190.0}),
    "Link": (Link, LINK),
    "PursuerHeading": (PursuerHeading, {"heading": 1.0}),
    "Recorded": (Recorded, {"track": TRACK}),
    "CrewOrder": (CrewOrder, {"command": SetAutopilot(on=True), "on": "armed", "after": 3.0}),
    "ScriptedCrew": (ScriptedCrew, {"script": [CrewOrder(command=SetAutopilot(on=True))]}),
    "with_crew": (
        with_crew,
        {
            "script": [CrewOrder(command=SetAutopilot(on=True))],
            "flown": lambda commands: iter(()),
            "commands": lambda t: (),
        },
    ),
    "PursuerBank": (PursuerBank, {"bank": 0.3}),
    "PursuerSpeed": (PursuerSpeed, {"tas": 220.0}),
    "SetAutopilot": (SetAutopilot, {"on": True}),
    "SetDirector": (SetDirector, {"on": True}),
    "SetSpacing": (SetSpacing, {"slot_distance": 12e3, "min_separation": 9e3}),
    "Stick": (Stick, {"roll": 0.5, "pitch": 0.1}),
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
            "wants_fan": lambda t: False,
            "until": 1.0,
            "after_joining": 0.0,
            "engagement": "engaged",
        },
    ),
    "scenario": (scenario, {"name": "fig_6a"}),
    "own_scenario": (
        own_scenario,
        {"situation": SITUATION, "intent_known": False, "isa_deviation": 0.0},
    ),
    "scenario_behind": (scenario_behind, {"track": TRACK, "behind": 3e4, "abeam": 2e4}),
    "record": (record, {"documents": (), "file": "flight.jsonl"}),
    "progress_bar": (lambda title, total: list(show(title, total)), {"title": "", "total": 1.0}),
    "prove": (prove, {"plan": PLAN, "seconds": 0.0, "progress": iter}),
    "wind_from": (wind_from, {"direction": 1.0, "speed": 10.0}),
}
"""What may be called, with arguments that are right."""
