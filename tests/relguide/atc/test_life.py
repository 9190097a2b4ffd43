"""The life of a clearance: who may bring it from where to where, and what time does to it."""

from collections.abc import Callable
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.atc.clearances import OVER, WHO_MAY, Actor, State, refusal
from relguide.atc.life import (
    Clearance,
    answer,
    answer_as_advised,
    back,
    begin,
    cancel,
    deviate,
    finish,
    note_deviations,
    note_validation,
    reply,
    supersede,
    terminate,
    tick,
)
from relguide.atc.settings import AtcSettings
from tests.relguide.atc.lives import (
    AT,
    STATES,
    asked,
    deviation,
    in_state,
    validated,
    validation,
)

ACTORS: tuple[Actor, ...] = get_args(Actor)
ALLOWED = """
requested   validating service | cancelled crew controller
validating  accepted controller service | unable controller service | standby controller service
            | cancelled crew controller | expired service | superseded service
standby     accepted controller service | unable controller service | cancelled crew controller
            | expired service | superseded service
accepted    wilco crew | unable controller service | cancelled crew controller | expired service
            | superseded service
wilco       flying service | cancelled crew controller | expired service | superseded service
flying      flown service | deviated service | cancelled crew controller | superseded service
deviated    flying service | terminated controller service | cancelled crew controller
            | superseded service
"""
"""What may follow, and by whom, written once more and by hand."""


def _allowed() -> set[tuple[str, str, str]]:
    cells = set()
    now = ""
    for line in ALLOWED.strip().splitlines():
        if not line.startswith(" "):
            now, line = line.split(None, 1)
        for step in line.strip().strip("|").split("|"):
            to, *actors = step.split()
            cells |= {(now, to, by) for by in actors}
    return cells


CELLS = [(now, to, by) for now in STATES for to in STATES for by in ACTORS]
Steps = Callable[[Clearance, float], Clearance]
HOW: dict[tuple[State, Actor | None], Callable[[Actor], Steps]] = {
    ("accepted", None): lambda by: lambda one, t: answer(one, "accepted", by, now=t, at=AT),
    ("unable", None): lambda by: lambda one, t: answer(one, "unable", by, now=t, at=AT),
    ("standby", None): lambda by: lambda one, t: answer(one, "standby", by, now=t, at=AT),
    ("cancelled", None): lambda by: lambda one, t: cancel(one, by, now=t, at=AT),
    ("terminated", None): lambda by: lambda one, t: terminate(one, by, now=t, at=AT),
    ("wilco", "crew"): lambda by: lambda one, t: reply(one, "WILCO", validation(), now=t, at=AT),
    ("flown", "service"): lambda by: lambda one, t: finish(one, now=t, at=AT),
    ("superseded", "service"): lambda by: lambda one, t: supersede(one, "C2", now=t, at=AT),
    ("deviated", "service"): lambda by: lambda one, t: deviate(one, (deviation(),), now=t, at=AT),
}
"""What brings a clearance to a state, by the actors who may try; `None`: any of them."""


def _steps(now: State, to: State, by: Actor) -> Steps | None:
    if to == "flying" and by == "service":
        step = back if now == "deviated" else begin
        return lambda one, t: step(one, now=t, at=AT)
    make = HOW.get((to, None)) or HOW.get((to, by))
    return make(by) if make else None


@pytest.mark.parametrize(("now", "to", "by"), CELLS)
def test_each_cell_of_the_table(now: State, to: State, by: Actor) -> None:
    may = (now, to, by) in _allowed()
    assert (refusal(now, to, by) == "") == may
    step = _steps(now, to, by)
    before = in_state(now, auto_answer=True)
    if step is None:
        return
    if may:
        after = step(before, 1.0)
        assert after.state == to
        assert after.history[:-1] == before.history
        last = after.history[-1]
        assert (last.state, last.t, last.at, last.by) == (to, 1.0, AT, by)
        assert last.message
    else:
        with pytest.raises(ValueError, match=r"\.$"):
            step(before, 1.0)


def test_every_allowed_step_can_be_taken() -> None:
    taken = {cell for cell in _allowed() if _steps(*cell) is not None}  # type: ignore[arg-type]
    by_asking = {("requested", "validating", "service")}
    by_time = {cell for cell in _allowed() if cell[1] == "expired"}
    assert taken | by_asking | by_time == _allowed()


def test_what_is_over_has_no_next_state() -> None:
    assert OVER | set(WHO_MAY) == set(STATES)
    assert not OVER & set(WHO_MAY)
    for state in OVER:
        one = in_state(state)
        assert one.over
        assert one.due == 0.0
        assert tick(one, 1e9, AT) is one
        for note in (
            lambda one: note_validation(one, validation()),
            lambda one: note_deviations(one, (deviation(),)),
        ):
            with pytest.raises(ValueError, match="This clearance is over: it is"):
                note(one)


def test_a_request_is_validated_from_the_first_moment() -> None:
    one = asked(now=100.0)
    assert [step.state for step in one.history] == ["requested", "validating"]
    assert [step.by for step in one.history] == ["crew", "service"]
    assert one.due == 160.0


@pytest.mark.parametrize(
    ("state", "after", "end"),
    [
        ("validating", 60.0, "expired"),
        ("standby", 120.0, "expired"),
        ("accepted", 30.0, "expired"),
        ("wilco", 30.0, "expired"),
        ("deviated", 30.0, "terminated"),
    ],
)
def test_time_ends_what_nothing_happens_to(state: State, after: float, end: State) -> None:
    one = in_state(state, now=1000.0)
    assert tick(one, 1000.0 + after - 0.001, AT) is one
    ended = tick(one, 1000.0 + after, AT)
    assert (ended.state, ended.history[-1].by) == (end, "service")
    assert ended.history[-1].reason == ("expired" if end == "expired" else "conformance")
    assert ended.history[-1].message
    assert tick(ended, 1e9, AT) is ended


@pytest.mark.parametrize("state", ["requested", "flying"])
def test_nothing_is_due_in_other_states(state: State) -> None:
    one = in_state(state)
    assert tick(one, 1e9, AT) is one


@given(st.sampled_from(STATES), st.floats(0.0, 500.0))
def test_whoever_acts_too_late_is_told_so_before_any_tick(state: State, later: float) -> None:
    one = in_state(state, now=1000.0)
    t = 1000.0 + later
    ended = tick(one, t, AT)
    if ended is one:
        return
    for step in (
        lambda: answer(one, "accepted", "controller", now=t, at=AT),
        lambda: reply(one, "WILCO", validation(), now=t, at=AT),
        lambda: reply(one, "CANCEL", now=t, at=AT),
        lambda: begin(one, now=t, at=AT),
        lambda: back(one, now=t, at=AT),
    ):
        with pytest.raises(ValueError, match=f"it is {ended.state}"):
            step()


def test_the_service_answers_only_where_it_is_told_to() -> None:
    for to in ("accepted", "unable", "standby"):
        with pytest.raises(ValueError, match="The controller answers this clearance"):
            answer(in_state("validating"), to, "service", now=1.0, at=AT)
    told = in_state("validating", auto_answer=True)
    assert answer(told, "accepted", "service", now=1.0, at=AT).state == "accepted"


@pytest.mark.parametrize(
    ("verdict", "state", "reason"),
    [
        ("acceptable", "accepted", ""),
        ("unable", "unable", "separation"),
        ("standby", "standby", "stale_picture"),
    ],
)
def test_the_automation_answers_as_it_advises(verdict: str, state: State, reason: str) -> None:
    one = validated("validating", verdict, auto_answer=True)  # type: ignore[arg-type]
    answered = answer_as_advised(one, now=1.0, at=AT)
    assert (answered.state, answered.history[-1].reason) == (state, reason)
    assert answered.history[-1].by == "service"


def test_who_stands_by_goes_on_until_the_verdict_is_another() -> None:
    standing = validated("standby", "standby", auto_answer=True)
    assert answer_as_advised(standing, now=1.0, at=AT) is standing
    clear = validated("standby", "acceptable", auto_answer=True)
    assert answer_as_advised(clear, now=1.0, at=AT).state == "accepted"
    with pytest.raises(ValueError, match="was not validated"):
        answer_as_advised(in_state("validating", auto_answer=True), now=1.0, at=AT)


def test_the_controller_decides_whatever_automation_advises() -> None:
    bad = validated("validating", "unable")
    assert answer(bad, "accepted", "controller", now=1.0, at=AT).state == "accepted"
    good = validated("validating", "acceptable")
    refused = answer(good, "unable", "controller", "airspace", "DUE TO AIRSPACE", now=1.0, at=AT)
    assert (refused.state, refused.history[-1].reason) == ("unable", "airspace")
    assert refused.history[-1].message == "DUE TO AIRSPACE"
    plain = answer(good, "unable", "controller", now=1.0, at=AT)
    assert plain.history[-1].reason == "controller"


@pytest.mark.parametrize("verdict", ["unable", "standby"])
def test_wilco_is_refused_when_the_second_validation_fails(verdict: str) -> None:
    second = validation(verdict, computed=9.0)  # type: ignore[arg-type]
    ended = reply(in_state("accepted"), "WILCO", second, now=10.0, at=AT)
    assert (ended.state, ended.history[-1].by) == ("unable", "service")
    assert ended.history[-1].reason == second.findings[0].reason
    assert second.findings[0].message in ended.history[-1].message
    assert ended.validation == second


def test_wilco_needs_its_second_validation() -> None:
    one = in_state("accepted")
    with pytest.raises(ValueError, match="WILCO needs a validation"):
        reply(one, "WILCO", now=1.0, at=AT)
    second = validation(computed=9.0)
    complies = reply(one, "WILCO", second, now=10.0, at=AT)
    assert (complies.state, complies.due) == ("wilco", one.due)
    assert complies.validation == second


def test_the_crew_is_unable_to_comply_with_what_is_accepted_only() -> None:
    ended = reply(in_state("accepted"), "UNABLE", now=1.0, at=AT)
    assert (ended.state, ended.history[-1].reason) == ("cancelled", "crew")
    with pytest.raises(ValueError, match=r"this one is validating\. CANCEL withdraws it"):
        reply(in_state("validating"), "UNABLE", now=1.0, at=AT)
    with pytest.raises(ValueError, match="This clearance is over"):
        reply(in_state("flown"), "UNABLE", now=1.0, at=AT)


@pytest.mark.parametrize(
    "state", ["validating", "standby", "accepted", "wilco", "flying", "deviated"]
)
def test_the_crew_withdraws_at_any_time(state: State) -> None:
    ended = reply(in_state(state), "CANCEL", now=1.0, at=AT)
    assert (ended.state, ended.history[-1].by) == ("cancelled", "crew")


def test_who_comes_back_in_time_flies_on_with_what_still_stands() -> None:
    deviated = in_state("deviated")
    assert deviated.deviations == (deviation(0.0),)
    assert deviated.history[-1].message == deviation().message
    flying = back(deviated, (), now=29.0, at=AT)
    assert (flying.state, flying.due, flying.deviations) == ("flying", 0.0, ())
    again = deviate(flying, (deviation(50.0),), now=50.0, at=AT)
    assert again.due == 80.0


def test_times_are_of_the_settings() -> None:
    longer = AtcSettings(answer_within=7.0, standby_within=8.0, valid_for=9.0)
    one = in_state("validating")
    assert answer(one, "standby", "controller", now=1.0, at=AT, settings=longer).due == 9.0
    assert answer(one, "accepted", "controller", now=1.0, at=AT, settings=longer).due == 10.0
