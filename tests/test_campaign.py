"""The campaign: flights that can be drawn again, figures that are right, runs that go on."""

from dataclasses import replace
from itertools import pairwise
from math import hypot, pi
from pathlib import Path

import numpy as np
import pytest

from benchmarks.draws import active
from relguide.flying.cards import plan_card
from relguide.flying.documents import Alert, FlightEnded, ForecastChanged, Sample, Unable
from relguide.flying.flight import fly
from relguide.flying.plan_documents import PathPoint
from relguide.planning import situation as situation_words
from relguide.planning.plan import plan
from relguide.planning.situation import Leader, Pursuer, Situation
from relguide.units import DEG, NM
from tests.plans import find_plan, golden_plan
from tools.campaign import recordings
from tools.campaign.__main__ import main
from tools.campaign.evasion import best_turn
from tools.campaign.families import FAMILIES, REACH, draw
from tools.campaign.flights import failed_row, fly_case, row_of
from tools.campaign.paths import (
    circles,
    distance_from,
    lone_circles,
    path_in_air,
    reversals,
    reversals_of,
    turns_flown,
)
from tools.campaign.row import FIGURES, read_rows, row_from
from tools.campaign.tables import distributions, ranking

DRAWN = [family for family in FAMILIES if family != "recorded"]


@pytest.mark.parametrize("family", DRAWN)
@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_flight_is_drawn_from_its_name_alone(family: str, number: int) -> None:
    case = draw(family, number)
    assert case == draw(family, number)
    assert case.scenario.situation != draw(family, number + 3).scenario.situation
    times = [t for t, _ in case.orders]
    assert times == sorted(times)
    situation = case.scenario.situation
    away = hypot(situation.pursuer.x, situation.pursuer.y)
    assert situation.min_separation <= away <= REACH
    # what is printed makes the same situation again
    (printed,) = (line for line in case.as_code().splitlines() if line.startswith("situation"))
    assert eval(printed.removeprefix("situation = "), vars(situation_words)) == situation


@pytest.mark.slow
def test_all_recorded_flights_of_the_collection_lead() -> None:
    assert recordings.count() == 235
    assert draw("recorded", 1).scenario.leader_source is recordings.track(1)
    assert recordings.track(235) is recordings.track(0)
    assert all(draw("recorded", number).scenario.leader_source for number in range(235))


@pytest.mark.slow
def test_a_run_goes_on_where_it_stopped(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "flown.jsonl"
    options = ["fly", "--processes", "1", "--flights", "1", "--out", str(file)]
    assert main([*options, "--families", "declared", "follow"]) == 0
    begun = file.read_text()
    with file.open("a") as cut_short:
        cut_short.write('{"family": "declared"')
    assert main([*options, "--families", "declared"]) == 0
    assert file.read_text() == begun
    declared, follow = sorted(read_rows(file), key=lambda row: row.family)
    assert declared.planned
    assert declared.joined
    assert declared.join_over_plan is not None
    assert 0.95 < declared.join_over_plan < 1.5
    assert declared.least_share >= 1.0
    assert (declared.losses, declared.below_s, declared.loops) == ((), 0.0, 0)
    assert follow.joined
    assert row_from(begun.splitlines()[1]) in (declared, follow)
    capsys.readouterr()
    assert main(["table", str(file)]) == 0
    shown = capsys.readouterr().out
    for figure in FIGURES:
        assert (figure.heading in shown) == bool(figure.values([declared, follow]))
    assert main(["show", "declared", "0"]) == 0
    assert repr(draw("declared", 0).scenario.situation) in capsys.readouterr().out


def test_a_file_of_something_else_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "else.jsonl"
    file.write_text('{"kind": "sample"}\n')
    with pytest.raises(ValueError, match="no file of a campaign"):
        read_rows(file)
    assert main(["table", str(file)]) == 2
    assert "no file of a campaign" in capsys.readouterr().err
    file.write_text('{"code": "0"}\n{"kind": "sample"}\n')
    assert main(["table", str(file)]) == 2
    assert "no line of a campaign" in capsys.readouterr().err
    file.write_text('{"code": "0"}\n')
    assert main(["fly", "--families", "declared", "--out", str(file)]) == 2
    assert "another version" in capsys.readouterr().err


def test_a_flight_that_fails_is_listed_and_not_counted() -> None:
    row = failed_row(draw("declared", 0), ZeroDivisionError("by zero"))
    assert row.error == "ZeroDivisionError: by zero"
    assert distributions([row]) == []


def test_the_worst_comes_first_whichever_way_is_worse() -> None:
    row = replace(failed_row(draw("declared", 0), ValueError()), error="")
    rows = [replace(row, number=i, least_share=share) for i, share in enumerate((1.2, 0.9, 1.1))]
    (least,) = (figure for figure in FIGURES if figure.name == "least_share")
    assert [one.number for _, one in ranking(least, rows)] == [1, 2, 0]
    (circle,) = (figure for figure in FIGURES if figure.name == "loops")
    assert [one.number for _, one in ranking(circle, rows)] == [0, 1, 2]


@pytest.mark.slow
def test_a_loss_of_d_min_is_found_with_its_time_and_its_depth() -> None:
    case = draw("follow", 0)
    scenario = replace(case.scenario, duration_limit=60.0)
    case = replace(case, scenario=scenario, orders=())
    documents = tuple(fly(scenario, plan, sample_period=1.0))
    d_min = scenario.situation.min_separation
    near = {20.0: 0.9 * d_min, 21.0: 0.8 * d_min, 40.0: 0.95 * d_min}
    lost = tuple(
        replace(
            document,
            guidance=(replace(document.guidance[0], separation=near[document.t]),),
        )
        if isinstance(document, Sample) and document.t in near
        else replace(
            document, results=(replace(document.results[0], least_separation=0.79 * d_min),)
        )
        if isinstance(document, FlightEnded)
        else document
        for document in documents
    )
    row = row_of(case, lost, 1.0)
    assert [(loss.t_s, loss.seconds) for loss in row.losses] == [(20.0, 2.0), (40.0, 1.0)]
    assert row.losses[0].separation_m == 0.8 * d_min
    assert (row.below_s, row.silent_losses, row.least_share) == (3.0, 2, 0.79)
    # between two samples, too
    last = documents[-1]
    assert isinstance(last, FlightEnded)
    end = replace(last, results=(replace(last.results[0], least_separation=0.9 * d_min),))
    (loss,) = row_of(case, (*documents[:-1], end), 1.0).losses
    assert loss.seconds == 1.0
    assert row_of(case, documents, 1.0).losses == ()


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 11])
def test_the_path_of_a_card_is_the_path_of_its_plan(seed: int) -> None:
    found = find_plan(active(np.random.default_rng(seed), tight=True, intent=seed > 0))
    assert "B" in found.word
    path = path_in_air(plan_card(found).segments, found.situation.wind)
    flown = found.sample(np.linspace(0.0, found.time_to_converge, 200))
    off = [distance_from(path, x, y) for x, y in zip(flown.x, flown.y, strict=True)]
    assert max(off) < 20.0  # chords of a boundary arc, 5 s long, where it turns most
    assert distance_from(path, float(flown.x[-1]) + 3e5, float(flown.y[-1])) > 1e5


@pytest.mark.slow
def test_a_loss_is_announced_by_an_alert_that_stands_and_by_nothing_else() -> None:
    case = draw("follow", 0)
    scenario = replace(case.scenario, duration_limit=40.0)
    case = replace(case, scenario=scenario, orders=())
    first, *others, last = fly(scenario, plan, sample_period=1.0)
    d_min = scenario.situation.min_separation
    lost = [
        replace(one, guidance=(replace(one.guidance[0], separation=0.9 * d_min),))
        if isinstance(one, Sample) and one.t == 30.0
        else one
        for one in others
    ]
    alert = Alert(
        t=12.0, ident="PURSUER", other="LEADER", level="caution", subject="separation", message="",
        predicted_least=0.9 * d_min, predicted_at=30.0, cleared=False,
    )  # fmt: skip

    def announced(*said: Alert | Unable) -> float | None:
        (loss,) = row_of(case, (first, *said, *lost, last), 1.0).losses
        return loss.announced_s

    assert announced() is None
    assert announced(alert) == 18.0
    assert announced(alert, replace(alert, t=15.0, level="warning")) == 18.0
    assert announced(alert, replace(alert, t=20.0, cleared=True)) is None
    assert announced(replace(alert, level="advisory")) is None
    assert announced(replace(alert, subject="speed")) is None
    assert announced(Unable(t=29.0, ident="PURSUER", reason="speed", message="")) == 1.0


@pytest.mark.slow
def test_a_forecast_is_compared_at_the_same_time() -> None:
    case = draw("declared", 0)
    scenario = replace(case.scenario, duration_limit=20.0)
    said = fly(scenario, plan, sample_period=1.0)
    documents = tuple(one for one in said if not isinstance(one, ForecastChanged))
    assert row_of(case, documents, 1.0).off_forecast_m is None
    flown = [(one.t, one.aircraft[0]) for one in documents if isinstance(one, Sample)]
    nowhere = PathPoint(t=0.0, x=0.0, y=0.0, heading=0.0)
    forecast = ForecastChanged(
        t=0.0,
        ident="PURSUER",
        times=tuple(t for t, _ in flown[:11]),
        x=tuple(here.x + 3.0 * t for t, here in flown[:11]),
        y=tuple(here.y for _, here in flown[:11]),
        heading=tuple(here.heading for _, here in flown[:11]),
        least_separation=9e3,
        pursuer_at_closest=nowhere,
        leader_at_closest=nowhere,
    )
    row = row_of(case, (documents[0], forecast, *documents[1:]), 1.0)
    assert row.off_forecast_m == pytest.approx(30.0)


@pytest.mark.slow
def test_a_turn_begun_at_once_is_judged_by_what_it_keeps() -> None:
    leader = Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)
    beside = Pursuer(x=6.0 * NM, y=0.0, heading=0.0, tas=200.0, max_bank=25.0 * DEG)
    situation = Situation(
        pursuer=beside, leader=leader, slot_distance=8.0 * NM, min_separation=5.0 * NM
    )
    assert best_turn(situation) == pytest.approx(6.0 * NM)  # straight on, or away
    # head-on and 2 km away nothing keeps more than the few hundred metres of a turn aside
    head_on = replace(beside, x=0.0, y=2_000.0, heading=pi)
    assert best_turn(replace(situation, pursuer=head_on)) < 100.0


def test_the_last_promise_is_the_first_where_no_other_was_announced() -> None:
    told, untold = fly_case(draw("declared", 1)), fly_case(draw("undeclared", 1))
    assert told.shown_replans == 0
    assert told.join_over_last_promise == told.join_over_promise
    assert untold.shown_replans > 0
    assert untold.join_over_promise is not None
    assert untold.join_over_last_promise is not None
    assert abs(untold.join_over_last_promise - 1.0) < 0.03 < abs(untold.join_over_promise - 1.0)


def test_circles_are_counted_across_short_straights() -> None:
    right = [(3.0 * DEG, 1.0)] * 120
    assert circles(right) == 1
    assert circles(right[:110]) == 0
    assert circles([*right[:60], (0.0, 20.0), *right[:60]]) == 1
    assert circles([*right[:60], (0.0, 60.0), *right[:60]]) == 0
    assert circles([*right[:60], (-1.0 * DEG, 1.0), *right[:60]]) == 0
    assert circles(right * 2) == 2
    assert circles([(-2.0 * pi, 100.0), (2.0 * pi, 100.0)]) == 2


def test_a_circle_behind_a_leader_that_circles_is_told_apart() -> None:
    right, still, back = [2.0 * DEG] * 185, [0.0] * 185, [-1.0 * DEG] * 185
    assert lone_circles(right, still, 1.0) == 1
    assert lone_circles(right, [0.5 * DEG] * 185, 1.0) == 1
    assert lone_circles(right, back, 1.0) == 0
    assert lone_circles([*still, *right], [*back, *still], 1.0) == 1


def test_plans_turn_only_as_far_as_they_are_flown() -> None:
    segments = plan_card(golden_plan("R061")).segments
    whole = list(turns_flown([(0.0, segments)], 1e6))
    assert sum(seconds for _, seconds in whole) == pytest.approx(
        sum(segment.duration for segment in segments)
    )
    assert reversals(angle for angle, _ in whole) == reversals_of(segments)
    first = segments[0].duration
    cut = list(turns_flown([(10.0, segments), (10.0 + 0.5 * first, segments)], 10.0 + 0.5 * first))
    assert cut == [(pytest.approx(0.5 * whole[0][0]), pytest.approx(0.5 * first))]
    again = list(turns_flown([(0.0, segments), (0.5 * first, segments)], 1.5 * first))
    assert sum(angle for angle, _ in again) == pytest.approx(1.5 * whole[0][0])


def test_small_corrections_are_no_reversals() -> None:
    assert reversals(angle * DEG for angle in (30.0, 0.0, -0.6, 5.0, -0.6, 0.0, -0.6)) == 1
    assert reversals(angle * DEG for angle in (30.0, -0.6, 5.0, -40.0, 0.0, 2.0)) == 2


def test_a_plan_has_the_circles_and_reversals_of_its_turns() -> None:
    segments = plan_card(golden_plan("R061")).segments
    sides = [segment.direction for segment in segments if segment.kind == "turn"]
    assert reversals_of(segments) == sum(a != b for a, b in pairwise(sides))
    assert circles(turns_flown([(0.0, segments)], 1e6)) == 0
