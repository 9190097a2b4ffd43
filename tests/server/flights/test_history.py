"""What a late joiner gets."""

from dataclasses import replace

from relguide_server.flights.history import TRAIL_PERIOD, History

from relguide.flying.documents import (
    Alert,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    Sample,
)
from tests.documents import rare_documents
from tests.server.flown import LEADER, OWN, ideal_flight


def history_of(duration: float = 65.0) -> History:
    history = History()
    for document in ideal_flight(duration=duration, step=0.5):
        history.add(document)
    return history


def test_snapshot_holds_what_a_late_joiner_needs_in_order() -> None:
    kinds = [type(document) for document in history_of().documents()]
    assert kinds[:4] == [FlightStarted, LeaderRoute, PlanChanged, ModeChanged]
    assert kinds[-2:] == [Sample, FlightEnded]
    assert set(kinds[4:-1]) == {Sample}


def test_the_trail_is_thinned_and_ends_with_now() -> None:
    samples = [d for d in history_of().documents() if isinstance(d, Sample)]
    assert [s.t for s in samples] == [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 65.0]
    assert TRAIL_PERIOD == 10.0


def test_the_newest_sample_is_given_once() -> None:
    samples = [d for d in history_of(60.0).documents() if isinstance(d, Sample)]
    assert [s.t for s in samples].count(60.0) == 1


def test_only_the_last_plan_and_mode_are_kept_but_all_changes_of_the_leader() -> None:
    history = history_of(1.0)
    plan = next(d for d in history.documents() if isinstance(d, PlanChanged))
    mode = next(d for d in history.documents() if isinstance(d, ModeChanged))
    newer = replace(plan, t=5.0, reason="leader_turned")
    history.add(newer)
    history.add(replace(mode, t=5.0))
    for k in range(3):
        history.add(LeaderChanged(t=5.0 + k, ident="LDR 01", change="speed", message=f"{k}"))
    documents = history.documents()
    assert [d for d in documents if isinstance(d, PlanChanged)] == [newer]
    assert len([d for d in documents if isinstance(d, ModeChanged)]) == 1
    assert len([d for d in documents if isinstance(d, LeaderChanged)]) == 3


def test_alerts_and_losses_are_given_in_the_order_of_the_flight() -> None:
    history = history_of(1.0)
    alert, unable, lost, forecast = rare_documents(5.0, OWN, LEADER)
    assert isinstance(alert, Alert)
    over = replace(alert, t=6.0, cleared=True)
    other_subject = replace(alert, t=5.5, subject="speed")
    for document in (alert, unable, lost, forecast, other_subject, over, replace(lost, t=7.0)):
        history.add(document)
    past = [d for d in history.documents() if d.t > 1.0]
    assert past == [unable, lost, forecast, other_subject, over, replace(lost, t=7.0)]


def test_each_aircraft_has_a_plan_and_a_mode_of_its_own() -> None:
    history = history_of(1.0)
    plan = next(d for d in history.documents() if isinstance(d, PlanChanged))
    history.add(replace(plan, ident="RG 07", t=2.0))
    (route,) = history.routes()
    history.add(replace(route, expected_by="RG 07"))
    assert [d.ident for d in history.documents() if isinstance(d, PlanChanged)] == [OWN, "RG 07"]
    assert [d.expected_by for d in history.routes()] == [OWN, "RG 07"]
