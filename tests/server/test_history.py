"""What a late joiner gets."""

from dataclasses import replace

from relguide_server.history import TRAIL_PERIOD, History

from relguide.flying.documents import (
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    Sample,
)
from tests.server.flown import ideal_flight


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


def test_the_newest_sample_is_told_once() -> None:
    samples = [d for d in history_of(60.0).documents() if isinstance(d, Sample)]
    assert [s.t for s in samples].count(60.0) == 1


def test_only_the_last_plan_and_mode_are_kept_but_all_changes_of_the_leader() -> None:
    history = history_of(1.0)
    plan, mode = history.plan[0], history.mode[0]
    assert isinstance(plan, PlanChanged)
    newer = replace(plan, t=5.0, reason="leader_turned")
    history.add(newer)
    history.add(replace(mode, t=5.0))
    for k in range(3):
        history.add(LeaderChanged(t=5.0 + k, change="speed", message=f"{k}"))
    documents = history.documents()
    assert [d for d in documents if isinstance(d, PlanChanged)] == [newer]
    assert len([d for d in documents if isinstance(d, ModeChanged)]) == 1
    assert len([d for d in documents if isinstance(d, LeaderChanged)]) == 3
