"""Other traffic, cells and heights as outsiders send them, and how bad ones are refused."""

import json
from dataclasses import replace
from math import cos, hypot, pi, radians, sin
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyproj import Geod

from relguide import LEFT, Cell, ChangeLevel, Disc, FlyStraight, Polygon, Traffic, TurnTo, plan
from relguide.client.bodies import body_of
from relguide.contract.answers import answer
from relguide.contract.bodies import situation_from_json
from relguide.contract.document_models import plan_from_wire
from relguide.contract.refusal import ContractError
from relguide.flying.plan_documents import PlanCard
from relguide.learn.planners import PLANNERS, make_planner
from relguide.planning.heights import VERTICAL_MINIMUM
from relguide.planning.intent import LevelChange
from relguide.planning.limits import MAX_OTHERS
from relguide.planning.situation import Situation
from tests.bodies import AMID, BODY, CELLS, TRAFFIC, changed, on_earth
from tests.situations import GOLDEN, headings, intents, numbers, situations


def problem_of(body: Any) -> tuple[str, str]:
    with pytest.raises(ContractError) as caught:
        situation_from_json(body)
    return caught.value.problems[0]


def test_others_are_read() -> None:
    situation, _ = situation_from_json(json.dumps(AMID))
    first, second, disc, polygon = situation.others
    assert first == Traffic(
        ident="BAW12",
        x=200_000.0,
        y=150_000.0,
        heading=radians(200.0),
        tas=220.0,
        altitude=9_000.0,
        intent=(
            FlyStraight(duration=30.0),
            ChangeLevel(to_altitude=8_000.0, rate=8.0, hold="mach"),
            TurnTo(heading=pi / 2.0, turn=LEFT, bank=radians(20.0)),
        ),
        min_separation=5_000.0,
    )
    assert isinstance(second, Traffic)
    assert second.min_separation == situation.min_separation
    assert (second.altitude, second.intent) == (None, ())
    assert disc == Cell(
        ident="CB1",
        shape=Disc(x=-200_000.0, y=0.0, radius=20_000.0),
        east=10.0,
        north=-5.0,
        growth=2.0,
    )
    corners = ((-90e3, -150e3), (-50e3, -150e3), (-70e3, -120e3))
    assert polygon == Cell(ident="CB2", shape=Polygon(corners=corners))


def test_heights_are_read() -> None:
    body = changed(changed(BODY, "pursuer.altitude_m", 9_000), "leader.altitude_m", -500)
    change = {"level_change": {"to_altitude_m": 20_000, "rate_mps": 60}}
    situation, _ = situation_from_json(changed(body, "leader.intent", [change]))
    assert (situation.pursuer.altitude, situation.leader.altitude) == (9_000.0, -500.0)
    assert situation.leader.intent == (ChangeLevel(to_altitude=20_000.0, rate=60.0, hold="cas"),)


def test_the_pursuers_own_changes_of_level_are_read() -> None:
    levels = [
        {"at_s": 30, "to_altitude_m": 8_000, "rate_mps": 5},
        {"at_s": 30, "to_altitude_m": 7_000, "rate_mps": 6},
    ]
    situation, _ = situation_from_json(changed(BODY, "pursuer.levels", levels))
    assert situation.pursuer.levels == (
        LevelChange(at=30.0, to_altitude=8_000.0, rate=5.0),
        LevelChange(at=30.0, to_altitude=7_000.0, rate=6.0),
    )
    levels[1]["at_s"] = 29
    where, said = problem_of(changed(BODY, "pursuer.levels", levels))
    assert where == "pursuer.levels[1].at_s"
    assert said == "must not be before that of the level in front of it."


WRONG: list[tuple[str, Any, str, str]] = [
    ("pursuer.altitude_m", 20_001, "pursuer.altitude_m", "must lie in -500 … 20000 m, not 20001"),
    ("leader.altitude_m", "FL100", "leader.altitude_m", 'must be a number, not the text "FL100".'),
    ("leader.intent.0", {"level_change": 3}, "leader.intent[0].level_change", "must be an object"),
    (
        "leader.intent.0",
        {"level_change": {"to_altitude_m": 1}},
        "leader.intent[0].level_change.rate_mps",
        "is missing: it must lie in 0.5 … 60 m/s.",
    ),
    (
        "traffic.0.intent.1.level_change.rate_mps",
        0.4,
        "traffic[0].intent[1].level_change.rate_mps",
        "must lie in 0.5 … 60 m/s, not 0.4 m/s.",
    ),
    (
        "traffic.0.intent.1.level_change.hold",
        "ias",
        "traffic[0].intent[1].level_change.hold",
        "must be 'cas', 'mach' or 'tas', not the text \"ias\".",
    ),
    ("traffic", {}, "traffic", "must be a list, not an object."),
    ("traffic.0", [], "traffic[0]", "must be an object with fields, not a list."),
    ("traffic", TRAFFIC[:1] * (MAX_OTHERS + 1), "traffic", "must have at most 100 entries, not"),
    ("traffic.0.ident", "", "traffic[0].ident", "must have 1 to 24 printable characters, not ''"),
    ("traffic.0.ident", "a\nb", "traffic[0].ident", "must have 1 to 24 printable characters"),
    ("traffic.0.ident", "a" * 25, "traffic[0].ident", "must have at most 24 characters."),
    ("traffic.0.ident", 12, "traffic[0].ident", "must be a text, not 12."),
    ("traffic.1.ident", "BAW12", "traffic[1].ident", "is that of traffic[0] already: give each"),
    ("cells.1.ident", "BAW12", "cells[1].ident", "is that of traffic[0] already: give each its"),
    ("traffic.0.tas_mps", 10, "traffic[0].tas_mps", "must lie in 30 … 400 m/s, not 10 m/s."),
    ("traffic.0.x_m", ..., "traffic[0].x_m", "is missing: it must lie in -1e+06 … 1e+06 m."),
    ("traffic.0.max_bank_deg", 25, "traffic[0].max_bank_deg", "is not a field of the contract"),
    (
        "traffic.0.min_separation_m",
        -1,
        "traffic[0].min_separation_m",
        "must lie in 0 … 200000 m, not -1 m.",
    ),
    (
        "traffic.1",
        {"ident": "A", "lat_deg": 50, "lon_deg": 8, "heading_deg": 0, "tas_mps": 200},
        "traffic[1]",
        "must be placed by x_m, y_m, as pursuer and leader are.",
    ),
    ("cells.0.disc.radius_m", 0, "cells[0].disc.radius_m", "must lie in 1 … 500000 m, not 0 m."),
    ("cells.0.disc", ..., "cells[0].disc", "is missing: it must be an object with x_m, y_m "),
    ("cells.1.disc", {}, "cells[1].disc", "is not a field of the contract: leave it out."),
    (
        "cells.0.disc",
        {"lat_deg": 50, "lon_deg": 8, "radius_m": 1e4},
        "cells[0].disc",
        "must be placed by x_m, y_m, as",
    ),
    ("cells.0.velocity_mps", [151, 0], "cells[0].velocity_mps[0]", "must lie in -150 … 150 m/s"),
    ("cells.0.velocity_mps", [1], "cells[0].velocity_mps", "must have at least 2 entries, not 1."),
    ("cells.0.growth_mps", -1, "cells[0].growth_mps", "must lie in 0 … 50 m/s, not -1 m/s."),
    (
        "cells.1.polygon",
        [[0, 0], [1e4, 0]],
        "cells[1].polygon",
        "must have at least 3 entries, not 2.",
    ),
    ("cells.1.polygon.0", [1, 2, 3], "cells[1].polygon[0]", "must have at most 2 entries, not 3."),
    ("cells.1.polygon.0", [1, 2e6], "cells[1].polygon[0][1]", "must lie in -1e+06 … 1e+06 m"),
    (
        "cells.1.polygon.0",
        {"lat_deg": 50, "lon_deg": 8},
        "cells[1].polygon[0]",
        "must be placed by [x, y], as pursuer and leader are.",
    ),
    (
        "cells.1.polygon",
        [[0, 0], [1e4, 0], [2e4, 0]],
        "cells[1].polygon",
        "must go round an area: these lie on one line, or cross themselves.",
    ),
    (
        "cells.1.polygon",
        [[0, 0], [1e4, 0], [5e3, 1e3], [5e3, 1e4]],
        "cells[1].polygon",
        "must go round one way, and at (5000, 1000) m they turn back",
    ),
]


@pytest.mark.parametrize(("path", "value", "where", "sentence"), WRONG)
def test_each_defect_is_named(path: str, value: Any, where: str, sentence: str) -> None:
    found, message = problem_of(changed(AMID, path, value))
    assert found == where
    assert message.startswith(sentence)


def test_others_are_counted_together() -> None:
    many = [{**CELLS[0], "ident": f"C{k}"} for k in range(MAX_OTHERS - 1)]
    assert problem_of({**AMID, "cells": many}) == (
        "traffic, cells",
        "must be at most 100 together, not 101.",
    )


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["ident", "x_m", "lat_deg", "lon_deg", "disc", "polygon", "intent"]),
            inner,
            max_size=3,
        )
    ),
    max_leaves=8,
)
PATHS = [
    "traffic", "traffic.0", "cells", "cells.0", "cells.1", "cells.0.disc", "cells.1.polygon",
    "cells.1.polygon.0", "cells.0.velocity_mps", "pursuer.altitude_m", "traffic.0.intent.1",
    *(f"traffic.0.{name}" for name in TRAFFIC[0]),
    *(f"cells.0.{name}" for name in CELLS[0]),
]  # fmt: skip


@given(path=st.sampled_from(PATHS), value=json_values)
@settings(max_examples=300)
def test_garbage_is_read_or_refused_in_a_sentence(path: str, value: Any) -> None:
    try:
        situation_from_json(changed(AMID, path, value))
    except ContractError as error:
        str(error).encode()  # can be printed
        assert error.problems  # noqa: PT017


# --- there and back -----------------------------------------------------------------------------


altitudes = st.none() | numbers(-500.0, 20_000.0)
places = numbers(-1e6, 1e6)
level_changes = st.builds(
    ChangeLevel,
    to_altitude=numbers(-500.0, 20_000.0),
    rate=numbers(0.5, 60.0),
    hold=st.sampled_from(["cas", "mach", "tas"]),
)


levels = st.builds(
    LevelChange,
    at=numbers(0.0, 86_400.0),
    to_altitude=numbers(-500.0, 20_000.0),
    rate=numbers(0.5, 60.0),
)


def ring(x: float, y: float, size: float, corners: int) -> Polygon:
    angles = [2.0 * pi * k / corners for k in range(corners)]
    return Polygon(corners=tuple((x + size * cos(a), y + size * sin(a)) for a in angles))


shapes = st.builds(Disc, x=places, y=places, radius=numbers(1.0, 500_000.0)) | st.builds(
    ring, numbers(-5e5, 5e5), numbers(-5e5, 5e5), numbers(1e3, 4e5), st.integers(3, 64)
)


@st.composite
def amid_others(draw: st.DrawFn) -> Situation:
    """Situations at heights and amid others, each with an ident of its own."""
    plain = draw(situations())
    flying = st.builds(
        Traffic,
        ident=st.sampled_from([f"T{k}" for k in range(9)]),
        x=places,
        y=places,
        heading=headings,
        tas=numbers(30.0, 400.0),
        min_separation=numbers(0.0, 200_000.0),
        intent=st.tuples(intents, level_changes).map(lambda both: (*both[0], both[1])),
        altitude=altitudes,
    )
    weather = st.builds(
        Cell,
        ident=st.sampled_from([f"C{k}" for k in range(9)]),
        shape=shapes,
        east=numbers(-150.0, 150.0),
        north=numbers(-150.0, 150.0),
        growth=numbers(0.0, 50.0),
    )
    others = (
        *draw(st.lists(flying, unique_by=lambda other: other.ident, max_size=3)),
        *draw(st.lists(weather, unique_by=lambda other: other.ident, max_size=3)),
    )
    return replace(
        plain,
        pursuer=replace(
            plain.pursuer, altitude=draw(altitudes), levels=draw(st.lists(levels, max_size=1))
        ),
        leader=replace(plain.leader, altitude=draw(altitudes)),
        others=others,
    )


@given(situation=amid_others())
@settings(max_examples=100, deadline=None)
def test_a_situation_comes_back_as_it_was_sent(situation: Situation) -> None:
    text = json.dumps(body_of(situation))
    read, _ = situation_from_json(text)
    assert read.pursuer.altitude == situation.pursuer.altitude
    assert read.pursuer.levels == situation.pursuer.levels
    assert read.leader.altitude == situation.leader.altitude
    assert len(read.others) == len(situation.others)
    for ours, theirs in zip(situation.others, read.others, strict=True):
        if isinstance(ours, Cell):
            assert theirs == ours
            continue
        assert isinstance(theirs, Traffic)
        assert replace(theirs, heading=0.0, intent=()) == replace(ours, heading=0.0, intent=())
        off = abs(theirs.heading - ours.heading) % (2.0 * pi)
        assert min(off, 2.0 * pi - off) < 1e-12
        for said, heard in zip(ours.intent, theirs.intent, strict=True):
            assert type(heard) is type(said)
            for name in ("duration", "turn", "bank", "to_altitude", "rate", "hold"):
                kept = getattr(said, name, None)
                assert getattr(heard, name, None) == (
                    pytest.approx(kept, abs=1e-12) if isinstance(kept, float) else kept
                )


# --- on the earth -------------------------------------------------------------------------------


def placed() -> dict[str, Any]:
    body = on_earth((49.4, 1.4), (49.0, 2.0))
    turn = {"turn_to_heading_deg": 90, "direction": "right", "bank_deg": 20}
    body["traffic"] = [
        {
            "ident": "BAW12",
            "lat_deg": 50.5,
            "lon_deg": 8.0,
            "heading_deg": 0,
            "tas_mps": 200,
            "intent": [turn],
        }
    ]
    body["cells"] = [
        {
            "ident": "CB1",
            "disc": {"lat_deg": 51.0, "lon_deg": 8.0, "radius_m": 1e4},
            "velocity_mps": [10, 0],
        },
        {
            "ident": "CB2",
            "polygon": [
                {"lat_deg": lat, "lon_deg": lon}
                for lat, lon in ((47.0, -1.0), (47.0, 0.0), (47.5, -0.5))
            ],
        },
    ]
    return body


def test_places_and_directions_are_those_of_the_earth() -> None:
    situation, _ = situation_from_json(placed())
    flying, disc, polygon = situation.others
    assert isinstance(flying, Traffic)
    assert isinstance(disc, Cell)
    assert isinstance(disc.shape, Disc)
    assert isinstance(polygon, Cell)
    assert isinstance(polygon.shape, Polygon)
    geod = Geod(ellps="WGS84")
    for lat, lon, x, y in (
        (50.5, 8.0, flying.x, flying.y),
        (51.0, 8.0, disc.shape.x, disc.shape.y),
        (47.0, -1.0, *polygon.shape.corners[0]),
    ):
        assert hypot(x, y) == pytest.approx(geod.inv(2.0, 49.0, lon, lat)[2], abs=0.01)
    # it flies north: what is north of it lies ahead
    north, _ = situation_from_json(changed(placed(), "traffic.0.lat_deg", 50.51))
    ahead = north.others[0]
    assert isinstance(ahead, Traffic)
    along = (ahead.x - flying.x) * sin(flying.heading) + (ahead.y - flying.y) * cos(flying.heading)
    assert along == pytest.approx(hypot(ahead.x - flying.x, ahead.y - flying.y), rel=1e-9)
    turn = flying.intent[0]
    assert isinstance(turn, TurnTo)
    assert (turn.heading - flying.heading) % (2.0 * pi) == pytest.approx(pi / 2.0)
    east, _ = situation_from_json(changed(placed(), "cells.0.disc.lon_deg", 8.0001))
    moved = east.others[1]
    assert isinstance(moved, Cell)
    assert isinstance(moved.shape, Disc)
    to_the_east = moved.shape.x - disc.shape.x, moved.shape.y - disc.shape.y
    assert hypot(disc.east, disc.north) == pytest.approx(10.0)
    # 0.1 %: the plane stretches what lies across the way from the leader
    assert disc.north / disc.east == pytest.approx(to_the_east[1] / to_the_east[0], abs=1e-3)


@pytest.mark.parametrize(
    ("path", "value", "where", "sentence"),
    [
        ("traffic.0.lat_deg", -50, "traffic[0].lat_deg, traffic[0].lon_deg", "must lie within 10"),
        ("cells.0.disc.lat_deg", 91, "cells[0].disc.lat_deg", "must be at most 90 °, not 91 °."),
        (
            "cells.1.polygon.1",
            {"lat_deg": -47, "lon_deg": 179},
            "cells[1].polygon[1].lat_deg, cells[1].polygon[1].lon_deg",
            "must lie within 1000 km of the leader.",
        ),
        (
            "cells.1.polygon.1",
            [0, 0],
            "cells[1].polygon[1]",
            "must be placed by lat_deg, lon_deg, as pursuer and leader are.",
        ),
    ],
)
def test_each_defect_on_the_earth_is_named(
    path: str, value: Any, where: str, sentence: str
) -> None:
    found, message = problem_of(changed(placed(), path, value))
    assert found == where
    assert message.startswith(sentence)


# --- answers ------------------------------------------------------------------------------------


def text_of(body: dict[str, Any]) -> str:
    situation, anchor = situation_from_json(body)
    reply = answer(situation, anchor, plan, include=["alternatives"])
    return json.dumps({**reply, "compute_ms": 0})


@pytest.mark.parametrize("name", ["reference", "wind"])
def test_without_others_nothing_is_said_of_them(name: str) -> None:
    lines = (GOLDEN / f"{name}.situations.jsonl").read_text().splitlines()
    for line in lines[::10]:
        body = json.loads(line)
        del body["id"]
        plain = text_of(body)
        assert text_of({**body, "traffic": [], "cells": []}) == plain
        for word in ("others", "vertical", "levels", "ident", "conflict", "remedies"):
            assert f'"{word}"' not in plain


def test_far_away_others_change_nothing_but_what_is_said_of_them() -> None:
    plain, amid = json.loads(text_of(BODY)), json.loads(text_of(AMID))
    others = amid["separation"].pop("others")
    assert amid == plain
    assert {other["ident"] for other in others} == {"BAW12", "AFR7", "CB1", "CB2"}
    margins = [other["proved_above_m"] - other["min_separation_m"] for other in others]
    assert margins == sorted(margins)
    for other in others:
        assert other["least_m"] >= other["proved_above_m"] > other["min_separation_m"]
        assert set(other) == {"ident", "least_m", "at_s", "proved_above_m", "min_separation_m"}


DESCENDING: dict[str, Any] = {
    **BODY,
    "pursuer": {**BODY["pursuer"], "altitude_m": 10_668},
    "leader": {
        **BODY["leader"],
        "altitude_m": 9_144,
        "intent": [
            {"straight_s": 60},
            {"level_change": {"to_altitude_m": 7_620, "rate_mps": 8}},
        ],
    },
}
"""Its pursuer begins above the leader, who descends."""


@pytest.mark.parametrize("name", PLANNERS)
def test_a_plan_says_when_it_changes_its_level_and_when_height_counts(name: str) -> None:
    reply = answer(*situation_from_json(DESCENDING), make_planner(name))
    assert reply["levels"][-1]["to_altitude_m"] == 7_620.0
    assert reply["levels"][-1].keys() == {"at_s", "to_altitude_m", "rate_mps"}
    (first, *_) = reply["separation"]["vertical"]
    assert first.keys() == {"from_s", "to_s", "least_m"}
    assert first["from_s"] == 0.0
    assert first["least_m"] > VERTICAL_MINIMUM - 2.0
    card = plan_from_wire(reply)
    assert isinstance(card, PlanCard)
    assert card.levels[-1].to_altitude == 7_620.0
    assert card.separation.vertical[0].from_ == 0.0


def test_height_keeps_traffic_apart_as_well() -> None:
    """Who crosses above, far enough, may do so anywhere."""
    above = {**TRAFFIC[1], "x_m": -20_000, "y_m": 38_000, "altitude_m": 10_668 + 1_000}
    body = {**DESCENDING, "leader": {**BODY["leader"], "altitude_m": 10_668}, "traffic": [above]}
    reply = answer(*situation_from_json(body), plan)
    (other,) = reply["separation"]["others"]
    assert other["vertical"][0]["from_s"] == 0.0
    assert "vertical" not in reply["separation"]
    assert "levels" not in reply
