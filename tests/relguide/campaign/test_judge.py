"""The figures of a flight are right, and flights that fail are not counted."""

from dataclasses import replace

import pytest

from relguide.campaign.families import draw
from relguide.campaign.judge import fly_case, row_of
from relguide.flying.documents import Alert, Document, FlightEnded, ForecastChanged, Sample, Unable
from relguide.flying.flight import fly
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.orders import SetEngagement
from relguide.flying.pilot_model import PilotModel
from relguide.flying.plan_documents import PathPoint
from relguide.flying.scripted_crew import CrewOrder
from relguide.planning.plan import plan
from relguide.planning.wind import Wind
from tests.plans import find_plan


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


def test_the_last_promise_is_the_first_where_no_other_was_announced() -> None:
    told, untold = fly_case(draw("declared", 1)), fly_case(draw("undeclared", 1))
    assert told.shown_replans == 0
    assert told.join_over_last_promise == told.join_over_promise
    assert untold.shown_replans > 0
    assert untold.join_over_promise is not None
    assert untold.join_over_last_promise is not None
    assert abs(untold.join_over_last_promise - 1.0) < 0.03 < abs(untold.join_over_promise - 1.0)


def test_the_optimum_is_the_plan_that_knows_all() -> None:
    case = draw("declared", 0)
    row = fly_case(case)
    best = find_plan(case.scenario.situation)
    assert row.optimum_s == best.time_to_converge
    assert row.join_s is not None
    assert row.over_optimum_s == row.join_s - best.time_to_converge > 0.0
    assert row.swing_deg > 0.0
    assert row.why_not_joined == ""
    ordered = replace(case, orders=draw("commands", 0).orders)
    short = replace(ordered, scenario=replace(case.scenario, duration_limit=30.0))
    cut = fly_case(short)
    assert (cut.optimum_s, cut.over_optimum_s) == (None, None)
    assert cut.why_not_joined.startswith("time_over in ")


def test_a_flight_that_joins_an_earlier_leg_is_not_compared_with_the_last() -> None:
    row = fly_case(draw("undeclared", 1))
    assert row.optimum_s is not None
    assert row.join_s is not None
    assert row.join_s < row.optimum_s - 900.0
    assert row.over_optimum_s is None


def test_what_guidance_believes_wrongly_is_what_the_case_says() -> None:
    case = replace(
        draw("declared", 0), wind_error=Wind(east=3.0, north=-4.0), factors={"max_roll_rate": 0.5}
    )
    world = case.world()
    assert world.believed_air is not None
    assert world.believed_air.wind.east == pytest.approx(world.air.wind.east + 3.0)
    assert world.believed_air.wind.north == pytest.approx(world.air.wind.north - 4.0)
    pursuer, _ = world.aircraft
    assert pursuer.airframe.max_roll_rate == 0.5 * pursuer.known_airframe.max_roll_rate
    assert draw("declared", 0).world().believed_air is None


@pytest.mark.slow
def test_a_flight_by_hand_is_held_against_the_autopilots() -> None:
    case = draw("declared", 4)
    by_hand = replace(case, scenario=replace(case.scenario, by_hand=PilotModel()))
    ours, theirs = fly_case(by_hand), fly_case(case)
    assert ours.autopilot_join_s == theirs.join_s
    assert ours.autopilot_least_share == pytest.approx(theirs.least_share)
    assert ours.late_share is not None
    assert abs(ours.late_share) < 0.05
    assert ours.nearer_share == pytest.approx(theirs.least_share - ours.least_share)
    assert ours.within_bar_share is not None
    assert 0.7 < ours.within_bar_share < 1.0
    assert ours.off_autopilot_m is not None
    assert 0.0 < ours.off_autopilot_m < 300.0
    assert (theirs.late_share, theirs.tube_m, theirs.nearer_share) == (None, None, None)


@pytest.mark.slow
def test_the_perfect_pilot_has_nothing_on_the_autopilot() -> None:
    case = draw("declared", 4)
    perfect = replace(case.scenario, by_hand=PilotModel.perfect())
    settings = replace(DEFAULT, by_hand_margin=1.0)
    row = fly_case(replace(case, scenario=perfect, settings=settings))
    assert row.late_share == 0.0
    assert row.off_autopilot_m == pytest.approx(0.0, abs=5.0)
    assert row.nearer_share == pytest.approx(0.0, abs=1e-3)


@pytest.mark.slow
def test_a_crew_engages_and_its_times_count_from_there() -> None:
    engaged = fly_case(draw("declared", 4))
    crew = (
        CrewOrder(command=SetEngagement(engagement="designated")),
        CrewOrder(command=SetEngagement(engagement="armed"), on="proposed", after=5.0),
        CrewOrder(command=SetEngagement(engagement="engaged"), on="armed", after=10.0),
    )
    row = fly_case(replace(draw("declared", 4), crew=crew))
    assert row.joined
    assert row.planned
    assert engaged.join_over_plan is not None
    assert row.join_over_plan == pytest.approx(engaged.join_over_plan, abs=0.05)
    assert fly_case(replace(draw("declared", 4), crew=crew[:1])).joined is False


@pytest.mark.slow
def test_who_flies_on_until_the_plane_ends_was_unable_for_what_made_it_fly_on() -> None:
    case = draw("follow", 0)
    case = replace(
        case, scenario=replace(case.scenario, duration_limit=20.0, after_joining=100.0), orders=()
    )
    *before, last = fly(case.scenario, plan, sample_period=1.0)
    assert isinstance(last, FlightEnded)
    end = replace(last, reason="plane_left", results=(replace(last.results[0], joined=False),))
    edge = Unable(t=end.t, ident="PURSUER", reason="geometry", message="")
    slow = replace(edge, t=end.t - 10.0, reason="speed")

    def why(*added: Document) -> str:
        return row_of(case, (*before, *added, end), 1.0).why_not_joined

    assert why(slow, edge) == "unable: speed"
    assert why(edge) == "unable: geometry"
