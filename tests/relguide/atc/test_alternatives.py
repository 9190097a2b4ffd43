"""Alternatives are acceptable: each was validated, and joins where it says."""

from dataclasses import replace

import numpy as np
import pytest

from relguide.atc.alternatives import OFFERED, later, suggest
from relguide.atc.picture import Picture, Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.tracks import intent_track, plan_track
from relguide.atc.validate import validate
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.intent import ChangeLevel, FlyStraight, LevelChange, TurnTo
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT
from relguide.planning.wind import Wind
from relguide.units import DEG, FT, NM
from tests.relguide.atc.pictures import LEVEL, NOW, seen_of

SITUATION = Situation(
    pursuer=Pursuer(x=-30_000.0, y=20_000.0, heading=2.0, tas=160.0, max_bank=25.0 * DEG),
    leader=Leader(
        x=0.0, y=0.0, heading=1.5, tas=140.0,
        intent=(FlyStraight(duration=100.0), TurnTo(heading=0.5, turn=LEFT, bank=20.0 * DEG)),
    ),
    slot_distance=6.0 * NM,
    min_separation=4.0 * NM,
    wind=Wind(east=12.0, north=5.0),
)  # fmt: skip


def asked_of(situation: Situation) -> tuple[Manoeuvre, Seen]:
    found = plan(situation)
    assert isinstance(found, Plan)
    leader, wind = situation.leader, situation.wind
    joins = NOW + found.time_to_converge
    path = intent_track(leader, start=NOW, until=joins + 600.0, wind=wind)
    flown = path.velocity(NOW)
    seen = Seen(ident="LEAD", t=NOW, x=leader.x, y=leader.y, track=float(np.arctan2(*flown)),
                ground_speed=float(np.hypot(*flown)), altitude=leader.altitude,
                path=path)  # fmt: skip
    asked = Manoeuvre(
        ident="OWN", leader="LEAD", spacing_type="distance", spacing=situation.slot_distance,
        min_separation=situation.min_separation, path=plan_track(found, start=NOW),
        joins=joins, leader_path=path, word=found.word,
    )  # fmt: skip
    return asked, seen


ASKED, LEADER = asked_of(SITUATION)


def in_the_way(t: float, *, altitude: float | None = None) -> Seen:
    """One that flies through the path's place at a time, at right angles."""
    (x, y), (east, north) = ASKED.path.place(NOW + t), ASKED.path.velocity(NOW + t)
    heading = (np.arctan2(east, north) + 0.5 * np.pi) % (2.0 * np.pi)
    air = 220.0
    x -= (air * np.sin(heading) + SITUATION.wind.east) * t
    y -= (air * np.cos(heading) + SITUATION.wind.north) * t
    traffic = Traffic(ident="BAW12", x=x, y=y, heading=heading, tas=air, min_separation=0.0,
                      altitude=altitude)  # fmt: skip
    return seen_of(traffic, ASKED.joins + 600.0, SITUATION.wind)


def test_what_is_offered_is_acceptable_soonest_first():
    picture = Picture(as_of=NOW, aircraft=(LEADER, in_the_way(250.0)))
    assert validate(ASKED, picture, NOW).verdict == "unable"
    offered = suggest(SITUATION, ASKED, picture, NOW, within=60.0)
    assert 0 < len(offered) <= OFFERED
    assert [one.joins for one in offered] == sorted(one.joins for one in offered)
    for one in offered:
        assert one.least >= 5.0 * NM
        assert one.route.t[0] == NOW
        assert one.message.endswith("s.")
        assert one.spacing >= SITUATION.slot_distance
        here = np.interp(one.joins, one.route.t, one.route.x)
        there = np.interp(one.joins, one.route.t, one.route.y)
        leader = ASKED.leader_path.place(one.joins)
        assert np.hypot(here - leader[0], there - leader[1]) == pytest.approx(one.spacing, abs=30.0)


def test_nothing_is_offered_where_nothing_is_acceptable():
    own = SITUATION.pursuer
    beside = Seen(ident="BAW12", t=NOW, x=own.x + 2_000.0, y=own.y, track=2.0, ground_speed=160.0)
    picture = Picture(as_of=NOW, aircraft=(LEADER, beside))
    assert suggest(SITUATION, ASKED, picture, NOW, within=60.0) == ()


def test_no_time_is_one_try_and_no_plan_is_none():
    picture = Picture(as_of=NOW, aircraft=(LEADER,))
    tried = []

    def planner(situation: Situation) -> Plan | NoPlan:
        tried.append(situation)
        return plan(situation)

    offered = suggest(SITUATION, ASKED, picture, NOW, planner=planner, within=0.0)
    assert len(tried) == 1
    assert [one.change for one in offered] == ["later"]


def test_another_level_on_the_way_is_tried_where_levels_are_known():
    own = replace(SITUATION.pursuer, altitude=LEVEL + 2_000.0 * FT)
    situation = replace(SITUATION, pursuer=own, leader=replace(SITUATION.leader, altitude=LEVEL))
    asked, leader = asked_of(situation)
    picture = Picture(as_of=NOW, aircraft=(leader, in_the_way(150.0, altitude=LEVEL)))
    offered = suggest(situation, asked, picture, NOW, within=60.0)
    assert offered
    assert all(len(one.route.altitude) == len(one.route.t) for one in offered)


@pytest.mark.parametrize("after", [30.0, 100.0, 103.0, 240.0])
def test_a_situation_later_is_what_all_have_flown_to(after):
    then = later(SITUATION, after)
    assert then is not None
    wind = SITUATION.wind
    for before, behind in ((SITUATION.leader, then.leader),):
        for t in (0.0, 40.0, 300.0):
            a, b = before.trajectory.pose_at(after + t), behind.trajectory.pose_at(t)
            assert a.x + wind.east * after == pytest.approx(b.x, abs=1e-3)
            assert a.y + wind.north * after == pytest.approx(b.y, abs=1e-3)
    own = then.pursuer
    assert own.x - wind.east * after == pytest.approx(-30_000.0 + 160.0 * after * np.sin(2.0))


def test_changes_of_level_go_on_later():
    change = ChangeLevel(to_altitude=LEVEL - 1_000.0, rate=5.0)
    intent = (FlyStraight(duration=50.0), change, FlyStraight(duration=400.0))
    leader = replace(SITUATION.leader, altitude=LEVEL, intent=intent)
    situation = replace(SITUATION, leader=leader)
    then = later(situation, 100.0)
    assert then is not None
    assert then.leader.altitude == pytest.approx(LEVEL - 250.0)
    assert then.leader.intent[0] == change
    done = later(situation, 300.0)
    assert done is not None
    assert change not in done.leader.intent
    begun = LevelChange(at=50.0, to_altitude=LEVEL, rate=5.0)
    climbing = replace(SITUATION.pursuer, altitude=LEVEL - 500.0, levels=(begun,))
    assert later(replace(SITUATION, pursuer=climbing), 100.0) is None
