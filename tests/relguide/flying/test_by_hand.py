"""A crew flies by hand: the stick acts at once, the bars show what the autopilot would do."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import pairwise
from math import exp, hypot

import numpy as np
import pytest

from relguide.flying.documents import (
    CommandGiven,
    ControlChanged,
    Document,
    Engagement,
    FlightStarted,
    PlanChanged,
    Sample,
    SeparationLost,
)
from relguide.flying.engagement import AUTOPILOT_BANK
from relguide.flying.fleet import Fleet
from relguide.flying.flight import Scenario, fly, world_of
from relguide.flying.orders import (
    Command,
    LeaderHeading,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    Stick,
)
from relguide.flying.pilot_model import PilotModel
from relguide.flying.scenarios import own_scenario, scenario
from relguide.kernels.base.turn import bank_for_turn_rate
from relguide.kernels.flight.by_hand import BAR_TIME, HAND_BANK
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, NM

STEP = 0.05
Script = tuple[tuple[float, Command], ...]
TAKEN: Script = ((2.0, SetAutopilot(on=False)), (2.0, SetDirector(on=True)))


def commands_of(script: Iterable[tuple[float, Command]]) -> Callable[[float], list[Command]]:
    """Each command once, as soon as its time has come."""
    left = list(script)

    def due(t: float) -> list[Command]:
        given = []
        while left and left[0][0] <= t + 1e-9:
            given.append(left.pop(0)[1])
        return given

    return due


def flown(
    script: Script,
    until: float,
    *,
    flight: Scenario | None = None,
    engagement: Engagement = "engaged",
) -> list[Document]:
    """A flight, fig. 6b's if no other, with orders at their times, up to a time [s]."""
    documents: list[Document] = []
    for document in fly(
        flight or scenario("fig_6b"), plan, commands=commands_of(script), engagement=engagement
    ):
        if document.t > until:
            break
        documents.append(document)
    return documents


def samples(documents: Iterable[Document]) -> list[Sample]:
    return [document for document in documents if isinstance(document, Sample)]


def banks(documents: Iterable[Document]) -> dict[float, float]:
    """Of the pursuer [°], by flight time to the step [s]."""
    return {round(one.t, 2): one.aircraft[0].bank / DEG for one in samples(documents)}


def said(documents: Iterable[Document]) -> list[str]:
    return [document.message for document in documents if isinstance(document, ControlChanged)]


def test_control_is_taken_and_given_back_and_each_is_said_once() -> None:
    documents = flown((*TAKEN, (30.0, SetAutopilot(on=True))), 40.0)
    changes = [one for one in documents if isinstance(one, ControlChanged)]
    assert [(one.t, one.autopilot, one.director) for one in changes] == [
        (2.0, False, False),
        (2.0, False, True),
        (30.0, True, True),
    ]
    assert said(documents)[0] == "You have control."
    for one in samples(documents):
        assert one.guidance[0].autopilot == (not 2.0 <= one.t < 30.0)
        assert one.guidance[0].engagement == "engaged"  # guidance goes on


def test_a_stick_moves_the_aircraft_from_its_own_step_on() -> None:
    still = banks(flown(TAKEN, 20.0))
    moved = banks(flown((*TAKEN, (10.35, Stick(roll=0.6))), 20.0))
    assert all(moved[t] == still[t] for t in still if t <= 10.35)
    assert moved[10.4] > still[10.4]
    assert moved[12.0] > 2.5


def test_neutral_keeps_the_bank_and_the_rate_of_climb() -> None:
    script = (
        *TAKEN,
        (10.0, Stick(roll=-1.0, pitch=0.5)),
        (13.0, Stick(roll=0.0)),
    )
    found = samples(flown(script, 30.0))
    late = [one.aircraft[0] for one in found if one.t >= 16.0]
    assert all(abs(one.bank - late[0].bank) < 0.01 * DEG for one in late)
    assert late[0].bank < -8.0 * DEG
    climbs = np.diff([one.altitude for one in late]) / STEP
    assert climbs.min() > 0.5
    assert np.ptp(climbs) < 1e-3 * climbs.max() + 1e-6


def test_full_deflection_rolls_at_the_types_rate_and_stops_at_45_degrees() -> None:
    found = flown((*TAKEN, (5.0, Stick(roll=1.0))), 40.0)
    bank = np.array([one.aircraft[0].bank for one in samples(found)])
    fastest = np.max(np.diff(bank)) / STEP
    assert 0.9 < fastest / world_of(scenario("fig_6b")).aircraft[0].airframe.max_roll_rate <= 1.0
    assert bank.max() <= HAND_BANK + 1e-6
    assert bank[-1] == pytest.approx(HAND_BANK, abs=0.5 * DEG)


def test_the_autopilot_takes_no_aircraft_that_banks_too_far() -> None:
    script = (*TAKEN, (5.0, Stick(roll=1.0)), (30.0, SetAutopilot(on=True)))
    documents = flown(script, 35.0)
    assert banks(documents)[30.0] * DEG > AUTOPILOT_BANK
    assert said(documents)[-1] == "The bank is 45°: bring it below 40° for the autopilot."
    assert not samples(documents)[-1].guidance[0].autopilot
    level = (*script, (31.0, Stick(roll=-1.0)), (34.0, SetAutopilot(on=True)))
    documents = flown(level, 60.0)
    assert samples(documents)[-1].guidance[0].autopilot
    assert abs(banks(documents)[60.0]) < 30.0


def test_a_stick_does_nothing_while_the_autopilot_flies() -> None:
    documents = flown(((5.0, Stick(roll=1.0)),), 20.0)
    assert banks(documents) == banks(flown((), 20.0))
    assert said(documents) == ["The autopilot flies: take control to fly by hand."]


def test_what_is_no_stick_waits_for_the_next_second() -> None:
    documents = flown((*TAKEN, (10.35, LeaderHeading(heading=1.0)), (10.6, Stick(roll=0.1))), 20.0)
    given = [(one.t, one.command.kind) for one in documents if isinstance(one, CommandGiven)]
    assert given[2:] == [(pytest.approx(10.6), "stick"), (11.0, "leader_heading")]


SEQUENCE: Script = (
    *TAKEN,
    (8.2, Stick(roll=0.7, pitch=-0.3)),
    (11.85, Stick(roll=-0.4)),
    (14.1, Stick(roll=0.0)),
    (20.45, LeaderHeading(heading=2.0)),
    (25.0, SetDirector(on=False)),
    (40.0, Stick(roll=-0.2)),
    (44.0, Stick(roll=0.0)),
    (50.0, SetAutopilot(on=True)),
)


def test_a_flight_is_flown_again_to_the_bit_from_its_orders() -> None:
    first = flown(SEQUENCE, 120.0)
    again = flown(
        tuple((one.t, one.command) for one in first if isinstance(one, CommandGiven)), 120.0
    )
    assert [one for one in again if not isinstance(one, PlanChanged)] == [
        one for one in first if not isinstance(one, PlanChanged)
    ]


def test_documents_come_in_order_of_time() -> None:
    times = [document.t for document in flown(SEQUENCE, 60.0)]
    assert all(before <= after for before, after in pairwise(times))


@pytest.mark.parametrize("name", ["leader_descends", "crossing_stream"])
def test_step_by_step_is_the_same_as_whole_seconds(name: str) -> None:
    world = world_of(replace(scenario(name), gusts=1.5))
    whole, steps = Fleet(world, STEP), Fleet(world, STEP)
    for second in range(60):
        t = float(second)
        whole.fly_second(t)
        steps.begin_second(t)
        for k in range(steps.steps):
            steps.fly_steps(t, k, k + 1)
        assert np.array_equal(whole.states, steps.states)
        assert np.array_equal(whole.trace, steps.trace)
        assert np.array_equal(whole.bars, steps.bars)
        assert np.array_equal(whole.altitudes, steps.altitudes)


def test_the_bars_show_what_the_autopilot_would_do() -> None:
    """Against the laws, worked out from the turn rate that guidance asks for."""
    turning = 317.0
    documents = flown((*TAKEN, (320.0, Stick(roll=0.3)), (322.0, Stick(roll=0.0))), 330.0)
    most = world_of(scenario("fig_6b")).aircraft[0].autopilot_bank
    checked = 0
    for before, now in pairwise(samples(documents)):
        reference, own = before.guidance[0].reference, before.aircraft[0]
        if before.t < turning or reference.kind != "turn_rate":
            continue
        (shown,), (was,) = now.guidance[0].bars, before.guidance[0].bars
        commanded = bank_for_turn_rate(own.tas, reference.turn_rate)
        commanded = min(max(commanded, -most), most)
        assert shown.commanded_bank == pytest.approx(commanded, abs=1e-9)
        error = commanded - own.bank
        smoothed = error + (was.roll - error) * exp(-STEP / BAR_TIME)
        assert shown.roll == pytest.approx(smoothed, abs=1e-9)
        checked += 1
    assert checked > 100


def test_a_pitch_bar_asks_for_the_level_that_was_left() -> None:
    documents = flown((*TAKEN, (10.0, Stick(roll=0.0, pitch=0.4)), (12.0, Stick(roll=0.0))), 40.0)
    now = samples(documents)[-1]
    (bars,) = now.guidance[0].bars
    assert now.aircraft[0].altitude > scenario("fig_6b").altitude + 5.0
    assert bars.pitch < 0.0
    assert bars.commanded_climb < 0.0


def test_bars_are_out_of_view_without_the_director_and_without_guidance() -> None:
    script = (*TAKEN, (10.0, SetEngagement(engagement="off")), (20.0, SetDirector(on=False)))
    for one in samples(flown(script, 30.0)):
        guidance = one.guidance[0]
        in_view = guidance.director and guidance.engagement != "off"
        assert bool(guidance.bars) == in_view == (2.0 <= one.t < 10.0)


def test_a_loss_by_hand_is_told_at_its_step_and_was_announced() -> None:
    """A crew that flies straight on past a leader that comes the other way, 3 NM to the side."""
    situation = Situation(
        pursuer=Pursuer(x=-30.0 * NM, y=0.0, heading=90.0 * DEG, tas=220.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=3.0 * NM, heading=270.0 * DEG, tas=200.0, intent=()),
        slot_distance=6.0 * NM,
        min_separation=5.0 * NM,
    )
    documents = flown(TAKEN, 150.0, flight=own_scenario(situation))
    (loss,) = (one for one in documents if isinstance(one, SeparationLost))
    apart = {
        round(one.t, 2): hypot(
            one.aircraft[0].x - one.aircraft[1].x, one.aircraft[0].y - one.aircraft[1].y
        )
        for one in samples(documents)
    }
    assert apart[round(loss.t, 2)] < 5.0 * NM <= apart[round(loss.t - STEP, 2)]
    assert loss.announced


def test_a_modelled_pilot_keeps_its_stick_and_its_bars() -> None:
    flight = replace(scenario("fig_6b"), by_hand=PilotModel())
    script = ((5.0, Stick(roll=1.0)), (6.0, SetDirector(on=False)))
    documents = flown(script, 20.0, flight=flight)
    assert banks(documents) == banks(flown((), 20.0, flight=flight))
    assert said(documents) == [
        "A modelled pilot flies: it alone moves the stick.",
        "A modelled pilot needs the bars: they stay on.",
    ]
    assert samples(documents)[-1].guidance[0].bars


def test_what_limits_the_hand_is_said() -> None:
    flown = fly(scenario("fig_6b"), plan, sample_period=1.0)
    started = next(flown)
    assert isinstance(started, FlightStarted)
    pursuer, leader = started.aircraft
    assert pursuer.autopilot_bank > pursuer.max_bank > 0.0
    assert leader.autopilot_bank == 0.0
    first = next(one for one in flown if isinstance(one, Sample))
    assert 0.5 < first.guidance[0].least_tas / first.aircraft[0].tas < 1.0
