"""What a flight's documents tell in short."""

from dataclasses import replace

import pytest

from relguide.contract.flight_summary import failures, figures, summarize
from relguide.flying.aircraft_documents import (
    AircraftCard,
    ClosestOther,
    LinkCard,
    LinkResult,
    Loss,
    WindCard,
)
from relguide.flying.documents import FlightEnded, FlightStarted, PlanChanged
from relguide.units import DEG, NM
from tests.documents import rare_documents
from tests.relguide.contract.test_wire import SAMPLE
from tests.server.flown import ideal_flight

CARDS = tuple(
    AircraftCard(ident=ident, aircraft_type="A300", max_bank=0.4) for ident in ("A", "B", "C")
)
LINK = LinkCard(
    pursuer="A",
    leader="B",
    slot_distance=10_000.0,
    min_separation=5.0 * NM,
    spacing="distance",
    spacing_time=0.0,
)
STARTED = FlightStarted(
    t=0.0,
    scenario="s",
    title="t",
    planner="exact",
    aircraft=CARDS,
    links=(LINK,),
    wind=WindCard(from_=0.0, speed=0.0),
    step=0.05,
    seed=0,
)
RESULT = LinkResult(
    ident="A",
    leader="B",
    joined=True,
    join_time=600.0,
    planned_time=590.0,
    promised=595.0,
    least_separation=5.0 * NM,
    heading_swing=400.0 * DEG,
    bank_reversals=1,
    replans=2,
    replans_announced=1,
    fallbacks=3,
    track=10.0 * NM,
    losses=(),
)
ENDED = FlightEnded(
    t=720.0, reason="joined", message="Joined, and followed for 120 s.", results=(RESULT,)
)


def end_of_flight(*results: LinkResult) -> FlightEnded:
    return replace(ENDED, results=results)


def test_a_good_flight_has_no_failures() -> None:
    flight = summarize([STARTED, SAMPLE, ENDED])
    assert (flight.documents, flight.last_time, flight.broken) == (3, 720.0, "")
    assert failures(flight) == ()
    assert figures(flight)["heading_swing_deg"] == pytest.approx(400.0)
    assert figures(flight)["track_nm"] == pytest.approx(10.0)


def test_a_lost_separation_is_a_failure() -> None:
    lost = summarize([STARTED, end_of_flight(replace(RESULT, least_separation=4.0 * NM))])
    assert failures(lost) == ("The separation fell below 5.00 NM: they came within 4.00 NM.",)


def test_a_loss_to_another_is_a_failure_and_named() -> None:
    near = ClosestOther(ident="BAW12", separation=4.0 * NM, t=60.0, min_separation=5.0 * NM)
    inside = ClosestOther(ident="CB1", separation=-50.0, t=70.4, min_separation=0.0)
    loss = Loss(t=60.0, separation=4.0 * NM, cause="why", announced=(), other="BAW12")
    result = replace(RESULT, losses=(loss,), least_other=(near,))
    lost = summarize([STARTED, end_of_flight(result)])
    assert failures(lost) == ("It came within 4.00 NM of BAW12, closer than 5.00 NM.",)
    told = figures(lost)
    assert told["losses"][0]["other"] == "BAW12"
    assert told["least_other"]["ident"] == "BAW12"
    assert "least_other" not in figures(summarize([STARTED, ENDED]))
    wet = summarize([STARTED, end_of_flight(replace(RESULT, least_other=(inside,)))])
    assert failures(wet) == ("It flew into the weather CB1 at 70 s.",)
    kept = replace(near, separation=5.0 * NM)
    assert failures(summarize([STARTED, end_of_flight(replace(RESULT, least_other=(kept,)))])) == ()


def test_not_joining_is_a_failure() -> None:
    last = replace(
        end_of_flight(replace(RESULT, joined=False)),
        reason="recording_over",
        message="The leader's recording ends after 720 s.",
    )
    assert failures(summarize([STARTED, last])) == (
        "It did not join. The leader's recording ends after 720 s.",
    )


def test_what_did_not_join_has_no_time_of_joining() -> None:
    result = replace(RESULT, join_time=720.0, optimum=580.0)
    joined = figures(summarize([STARTED, SAMPLE, end_of_flight(result)]))
    assert (joined["join_time_s"], joined["over_optimum_s"]) == (720.0, 140.0)
    lost = figures(summarize([STARTED, SAMPLE, end_of_flight(replace(result, joined=False))]))
    assert (lost["joined"], lost["join_time_s"], lost["over_optimum_s"]) == (False, None, None)
    assert lost["simulated_s"] == 720.0


def test_of_several_links_each_is_judged_by_its_own_limit() -> None:
    wide = replace(LINK, pursuer="C", leader="A", min_separation=6.0 * NM)
    started = replace(STARTED, links=(LINK, wide))
    close = replace(RESULT, least_separation=5.5 * NM)
    second = replace(close, ident="C", leader="A", joined=False)
    assert failures(summarize([started, end_of_flight(close, second)])) == (
        f"C did not join. {ENDED.message}",
        "The separation fell below 6.00 NM: they came within 5.50 NM.",
    )


def test_of_several_links_each_has_its_figures_and_one_alone_has_no_list() -> None:
    second = replace(RESULT, ident="C", leader="A", join_time=700.0)
    told = rare_documents(5.0, "C", "A")
    found = figures(summarize([STARTED, *told, end_of_flight(RESULT, second)]))
    alone = figures(summarize([STARTED, *told, ENDED]))
    assert "links" not in alone
    links = found.pop("links")
    assert found == alone
    assert [(one["pursuer"], one["leader"]) for one in links] == [("A", "B"), ("C", "A")]
    assert links[0] == {"pursuer": "A", "leader": "B"} | alone
    assert links[1]["join_time_s"] == 700.0
    assert links[1]["unables"] != alone["unables"] == []


def test_a_plan_that_is_no_news_is_not_in_the_story() -> None:
    plan = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    flight = summarize([STARTED, plan, replace(plan, announced=False), ENDED])
    assert (flight.events, flight.documents) == ((plan,), 4)


def test_alerts_and_losses_are_in_the_story_and_forecasts_are_not() -> None:
    rare = rare_documents(5.0, "A", "B")
    assert summarize([STARTED, *rare, ENDED]).events == rare[:-1]


def test_losses_are_given_with_when_they_were_announced() -> None:
    said = Loss(t=50.0, separation=9_000.0, cause="The leader slowed down.", announced=(20.0,))
    silent = replace(said, t=90.0, announced=())
    lost = summarize([STARTED, end_of_flight(replace(RESULT, losses=(said, silent)))])
    assert figures(lost)["losses"] == [
        {
            "t_s": 50.0,
            "separation_m": 9_000.0,
            "cause": "The leader slowed down.",
            "announced_s": 20.0,
        },
        {
            "t_s": 90.0,
            "separation_m": 9_000.0,
            "cause": "The leader slowed down.",
            "announced_s": None,
        },
    ]


def test_what_the_crew_was_told_is_given_with_when_and_why() -> None:
    others = rare_documents(5.0, "C", "B")
    found = figures(summarize([STARTED, *rare_documents(5.0, "A", "B"), *others, ENDED]))
    assert found["alerts"] == [
        {
            "t_s": 5.0,
            "level": "caution",
            "reason": "separation",
            "message": "The leader slows down: 4.8 NM in 45 s.",
            "cleared": False,
        }
    ]
    assert found["unables"] == [
        {"t_s": 5.0, "reason": "speed", "message": "The leader is too slow to follow."}
    ]
