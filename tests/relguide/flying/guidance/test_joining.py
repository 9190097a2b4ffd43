"""In capture a late join is news, and so is a spacing that is not kept for a minute."""

from dataclasses import replace
from itertools import pairwise
from math import inf

import numpy as np
import pytest

from relguide.flying.documents import Alert, ModeChanged, PlanChanged, PromiseChanged
from relguide.flying.guidance.announcements import Alerted, NewPromise
from relguide.flying.guidance.joining import judge_spacing, promise_anew
from relguide.flying.guidance.memory import LONG_AGO, Announced, Memory, Promise, begin
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.modes import Mode
from relguide.flying.orders import LeaderHeading, LeaderSpeed
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from relguide.kernels.flight.guide import FOLLOW, Act, Progress
from relguide.units import DEG, NM
from tests.flights import fly_whole
from tests.relguide.flying.guidance.beliefs import behind, observe
from tests.relguide.flying.guidance.test_forecast import make_forecast

BELIEF, ASSIGNMENT = observe(behind(along=30_000.0))
AHEAD = make_forecast([12_000.0] * 100, t=0.0)
OUT = DEFAULT.joined_along + 500.0
"""Half a kilometre out of the gate [m]."""


def promised(joins: float, *, mode: Mode = "capture") -> Memory:
    """In capture for a while, a join promised for then."""
    path = BELIEF.leader_after(0.0).trajectory
    said = Announced(t=0.0, joins=joins, path=path, quiet_until=0.0)
    told = Promise(t=LONG_AGO, joins=joins, settled=True)
    return begin(BELIEF)._replace(mode=mode, announced=said, promise=told, pending=None)


def promises(memory: Memory, *, joins: float) -> list[tuple[float, NewPromise]]:
    """What is said in two minutes in which the forecast joins at a time."""
    said = list[tuple[float, NewPromise]]()
    for t in range(120):
        memory = memory._replace(forecast=AHEAD._replace(join_time=joins))
        memory, events = promise_anew(memory, replace(BELIEF, t=float(t)), ASSIGNMENT)
        for event in events:
            assert isinstance(event, NewPromise)
            said.append((float(t), event))
    return said


@pytest.mark.parametrize(
    ("joins", "message"),
    [
        (300.0, "Joins in 5 min 00 s, was 3 min 20 s."),
        (150.0, "Joins in 2 min 30 s, was 3 min 20 s."),
    ],
)
def test_another_time_is_promised_once(joins: float, message: str) -> None:
    ((t, event),) = promises(promised(200.0), joins=joins)
    assert (t, event.joins, event.was) == (0.0, joins, 200.0)
    assert event.message == message


def test_a_join_that_should_have_been_is_said_so() -> None:
    late = promised(-20.0)
    ((_, event),) = promises(late, joins=60.0)
    assert event.message == "Joins in 1 min 00 s, and should have joined by now."


def test_ten_seconds_are_no_news_nor_5_percent_of_the_time_to_go() -> None:
    assert promises(promised(200.0), joins=209.0) == []
    assert promises(promised(2_000.0), joins=2_090.0) == []


@pytest.mark.parametrize("mode", ["heading", "follow", "escape"])
def test_nothing_is_promised_where_nothing_is_joined(mode: Mode) -> None:
    assert promises(promised(200.0, mode=mode), joins=300.0) == []


def test_while_the_leader_turns_it_is_said_at_once_and_then_only_how_much_it_moves() -> None:
    """Within 5 s of the change, every ten seconds at most, and what was last said is true."""
    memory, joins, said = promised(200.0), 200.0, list[tuple[float, float]]()
    for t in range(120):
        turns = t < 40
        joins += 4.0 if turns else 0.0
        memory = memory._replace(forecast=AHEAD._replace(join_time=joins))
        memory = memory._replace(changed=float(t) if turns else memory.changed)
        memory, events = promise_anew(memory, replace(BELIEF, t=float(t)), ASSIGNMENT)
        said += [(float(t), event.joins) for event in events if isinstance(event, NewPromise)]
    assert said[0][0] <= 5.0
    assert all(
        later - before >= DEFAULT.promise_every for (before, _), (later, _) in pairwise(said)
    )
    assert 2 <= len(said) <= 4
    assert said[-1][1] == pytest.approx(joins, abs=DEFAULT.shown_time)


def test_a_great_change_interrupts_the_pause_after_a_small_one() -> None:
    """Fig. 6a: 11 s later at 13:41, and 173 s later at 13:44."""
    memory = promised(200.0)._replace(changed=0.0)
    memory = memory._replace(promise=Promise(t=0.0, joins=200.0, settled=False))
    assert promises(memory, joins=400.0)[0][0] <= 5.0


@pytest.mark.slow
@pytest.mark.parametrize("tas", [212.0, 190.0])
def test_in_capture_another_speed_of_the_leader_is_another_promise_that_is_kept(tas: float) -> None:
    """Straight behind it captures at once, and no plan is made anew; 30 m/s close, then 18, 40."""
    flight = behind(along=22_000.0)
    flown = fly_whole(flight, (60.0, LeaderSpeed(tas=tas)))
    assert [d.mode for d in flown.of(ModeChanged)] == ["converge", "capture", "follow"]
    (plan,) = flown.of(PlanChanged)
    *_, last = flown.of(PromiseChanged)
    join = flown.result.join_time
    assert abs(join - plan.promised) > 60.0
    assert last.t < 60.0 + 60.0
    assert join == pytest.approx(last.t + last.promised, abs=10.0)


def spacing(*seconds: tuple[int, float, float], mode: Mode = "follow") -> list[tuple[int, Alerted]]:
    """What is said while it is so far behind D and beside the route for so many seconds each."""
    memory, t, said = begin(BELIEF)._replace(mode=mode), 0, list[tuple[int, Alerted]]()
    for lasts, along, right in seconds:
        to_slot = along - ASSIGNMENT.aim + ASSIGNMENT.slot_distance
        joined = abs(along) <= DEFAULT.joined_along and abs(right) <= DEFAULT.joined_across
        done = Act(
            Control(HOLD_HEADING, 0.0, 200.0), Progress(FOLLOW, 0.0, 0.0, 0.0), right, to_slot,
            joined,
        )  # fmt: skip
        for _ in range(lasts):
            belief = replace(BELIEF, t=float(t))
            outlook = Outlook(AHEAD, 9_800.0, t + 30.0, inf)
            memory, events = judge_spacing(memory, belief, ASSIGNMENT, done, outlook)
            for event in events:
                assert isinstance(event, Alerted)
                said.append((t, event))
            t += 1
    return said


@pytest.mark.parametrize(
    ("along", "right", "text"),
    [
        (2.0 * NM, 0.0, "Spacing: 2.00 NM too far behind, 0 m aside."),
        (-0.5 * NM, 0.0, "Spacing: 0.50 NM too near, 0 m aside."),
        (0.0, -0.25 * NM, "Spacing: 0 m too near, 0.25 NM aside."),
    ],
)
def test_it_is_said_after_a_minute_out_of_the_gate_and_cleared_once_in(
    along: float, right: float, text: str
) -> None:
    (t, out), (later, over) = spacing((10, 0.0, 0.0), (90, along, right), (20, 0.0, 0.0))
    assert (t, later) == (10 + DEFAULT.out_for, 100)
    assert (out.subject, out.level, out.cleared, out.message) == (
        "spacing", "advisory", False, text,
    )  # fmt: skip
    assert out.predicted_least == 9_800.0
    assert (over.cleared, over.message) == (True, "The spacing is kept again.")


def test_less_than_a_minute_out_is_not_said_however_often() -> None:
    assert spacing(*[(59, OUT, 0.0), (5, 0.0, 0.0)] * 5) == []


def test_nothing_is_said_of_the_spacing_before_it_follows() -> None:
    assert spacing((200, OUT, 0.0), mode="capture") == []


def test_what_is_uncertain_of_the_leader_is_not_out_of_the_gate() -> None:
    unsure = replace(BELIEF, spread=BELIEF.spread._replace(place=500.0))
    assert unsure.place_slack > 500.0
    memory = begin(unsure)._replace(mode="follow")
    done = Act(
        Control(HOLD_HEADING, 0.0, 200.0), Progress(FOLLOW, 0.0, 0.0, 0.0), 0.0,
        OUT + ASSIGNMENT.slot_distance - ASSIGNMENT.aim, False,
    )  # fmt: skip
    for t in np.arange(100.0):
        outlook = Outlook(AHEAD, 9_800.0, float(t), inf)
        memory, said = judge_spacing(memory, replace(unsure, t=float(t)), ASSIGNMENT, done, outlook)
        assert said == []


@pytest.mark.slow
def test_a_leader_that_weaves_is_followed_or_it_is_said_within_a_minute() -> None:
    """±20° each minute for half an hour: it once fell back from 10 to 40 km in silence."""
    weaving = [
        (300.0 + 60.0 * k, LeaderHeading(heading=(20.0 if k % 2 else 340.0) * DEG))
        for k in range(30)
    ]
    scenario = replace(behind(along=14_000.0), after_joining=2_000.0, duration_limit=2_100.0)
    flown = fly_whole(scenario, *weaving)
    assert flown.result.joined
    spaced = [d for d in flown.of(Alert) if d.subject == "spacing"]
    out_since, silent = None, 0.0
    for sample in flown.samples:
        if sample.t < flown.result.join_time:
            continue
        link = sample.guidance
        out = abs(link.spacing_error) > 2.0 * NM
        told = sum(-1 if d.cleared else 1 for d in spaced if d.t <= sample.t)
        out_since = (sample.t if out_since is None else out_since) if out and not told else None
        silent = max(silent, 0.0 if out_since is None else sample.t - out_since)
    assert silent <= 60.0
