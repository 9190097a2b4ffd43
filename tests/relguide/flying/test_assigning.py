"""What a crew asks of its guidance in flight: another D, d_min, bank or speed; or it is refused."""

from dataclasses import replace

import pytest

from relguide.flying.documents import (
    Alert,
    AssignmentChanged,
    EngagementChanged,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PromiseChanged,
    SeparationLost,
)
from relguide.flying.flight import fly
from relguide.flying.orders import Command, PursuerBank, PursuerSpeed, SetEngagement, SetSpacing
from relguide.flying.scenarios import own_scenario, scenario
from relguide.planning.plan import plan
from relguide.units import DEG, KT, NM
from tests.flights import Flown, fly_whole, random_start, saying

FIG_6B = scenario("fig_6b")
FOLLOWED = replace(FIG_6B, after_joining=900.0)
JOINED = 930.0
"""By then it follows, in fig. 6b."""


def _flown(until: float, *said: tuple[float, Command], engagement: str = "engaged") -> Flown:
    documents = []
    for document in fly(
        FOLLOWED,
        plan,
        commands=saying(*said),
        sample_period=1.0,
        engagement=engagement,  # type: ignore[arg-type]
    ):
        if document.t > until:
            break
        documents.append(document)
    return Flown(tuple(documents))


@pytest.mark.parametrize("miles", [5.5, 9.0])
def test_while_it_converges_another_d_is_planned_for_at_once(miles: float) -> None:
    flight = fly_whole(FIG_6B, (60.0, SetSpacing(slot_distance=miles * NM)))
    (changed,) = flight.of(AssignmentChanged)
    planned = [p for p in flight.of(PlanChanged) if p.reason == "assignment_changed"]
    assert [(p.t, p.announced) for p in planned] == [(60.0, True)]
    assert changed.slot_distance == pytest.approx(miles * NM)
    assert changed.message == f"D is {miles:.1f} NM, d_min 5.0 NM."
    assert planned[0].message.startswith(f"D is {miles:.1f} NM, d_min 5.0 NM: ")
    assert flight.result.joined
    assert flight.result.join_time == pytest.approx(60.0 + planned[0].promised, abs=10.0)
    assert flight.samples[-1].guidance.separation == pytest.approx(miles * NM, abs=0.2 * NM)
    assert flight.result.least_separation >= 5.0 * NM


@pytest.mark.parametrize(
    ("order", "words"),
    [
        (PursuerBank(bank=40.0 * DEG), "30° at most"),
        (PursuerSpeed(tas=600.0 * KT), "277 to 481 kt"),
        (SetSpacing(min_separation=7.0 * NM), "less than d_min"),
        (SetSpacing(slot_distance=14.0 * NM, min_separation=13.5 * NM), "25,002 m"),
    ],
    ids=["bank", "speed", "clearance", "no plan"],
)
def test_what_cannot_be_flown_is_refused_and_what_was_flown_is_flown_on(
    order: Command, words: str
) -> None:
    plain, asked = fly_whole(FIG_6B), fly_whole(FIG_6B, (850.0, order))
    (refused,) = asked.of(AssignmentChanged)
    assert words in refused.message
    assert "refused" in refused.message.lower()
    assert refused.slot_distance == pytest.approx(10_000.0)
    assert refused.selected_tas == ()
    assert [p.message for p in asked.of(PlanChanged)] == [p.message for p in plain.of(PlanChanged)]
    assert asked.samples == plain.samples


def test_plans_turn_with_the_bank_selected() -> None:
    flight = fly_whole(FIG_6B, (30.0, PursuerBank(bank=15.0 * DEG)))
    banks = [abs(each.pursuer.bank) for each in flight.samples if each.t > 40.0]
    assert 13.0 * DEG < max(banks) < 17.5 * DEG
    assert max(abs(each.pursuer.bank) for each in fly_whole(FIG_6B).samples) > 20.0 * DEG


def test_plans_and_promises_go_by_a_selected_speed_until_it_is_given_back() -> None:
    said = (240.0, PursuerSpeed(tas=440.0 * KT)), (700.0, PursuerSpeed(tas=0.0))
    flight = fly_whole(FIG_6B, *said)
    selected, back = flight.of(AssignmentChanged)
    assert (selected.message, back.message) == ("440 kt is selected.", "Guidance sets the speed.")
    assert selected.selected_tas == (pytest.approx(440.0 * KT),)
    before, slower, after = flight.of(PlanChanged)[:3]
    assert (slower.t, slower.reason) == (240.0, "assignment_changed")
    assert slower.promised > before.promised - 240.0 + 60.0
    speeds = [each.pursuer.tas for each in flight.samples if 290.0 < each.t < 700.0]
    assert all(tas == pytest.approx(440.0 * KT, abs=1.5) for tas in speeds)
    assert after.promised < slower.promised - 460.0
    assert flight.result.join_time == pytest.approx(700.0 + after.promised, abs=10.0)


@pytest.mark.parametrize("miles", [6.5, 9.0])
def test_behind_the_leader_speed_alone_opens_and_closes_the_spacing(miles: float) -> None:
    flight = fly_whole(
        replace(FIG_6B, after_joining=700.0), (950.0, SetSpacing(slot_distance=miles * NM))
    )
    assert [each.mode for each in flight.of(ModeChanged)][-2:] == ["capture", "follow"]
    promise = [each for each in flight.of(PromiseChanged) if each.t == 950.0]
    assert [each.message.startswith(f"D is {miles:.1f} NM") for each in promise] == [True]
    joined = flight.of(ModeChanged)[-1].t
    assert joined == pytest.approx(950.0 + promise[0].promised, abs=10.0)
    assert flight.samples[-1].guidance.separation == pytest.approx(miles * NM, abs=0.1 * NM)
    assert flight.result.least_separation >= 5.0 * NM
    assert not flight.of(SeparationLost)
    assert max(abs(each.pursuer.bank) for each in flight.samples if each.t > 950.0) < 3.0 * DEG


def test_a_small_change_behind_the_leader_leaves_the_mode() -> None:
    flight = _flown(1150.0, (JOINED + 100.0, SetSpacing(slot_distance=10_150.0)))
    assert flight.of(ModeChanged)[-1].t < JOINED
    assert flight.samples[-1].guidance.separation == pytest.approx(10_150.0, abs=50.0)


def test_behind_the_leader_a_selected_speed_breaks_the_spacing_and_says_so_at_once() -> None:
    said = (950.0, PursuerSpeed(tas=370.0 * KT)), (1050.0, PursuerSpeed(tas=0.0))
    flight = _flown(1500.0, *said)
    alerts = [each for each in flight.of(Alert) if each.subject == "spacing"]
    assert [(each.level, each.cleared) for each in alerts] == [
        ("advisory", False),
        ("advisory", True),
    ]
    assert alerts[0].t == 950.0
    assert "370 kt" in alerts[0].message
    assert alerts[1].t > 1050.0
    apart = {each.t: each.guidance.separation for each in flight.samples}
    assert apart[1050.0] > apart[950.0] + 0.3 * NM
    assert apart[1500.0] == pytest.approx(apart[950.0], abs=0.05 * NM)


def test_a_speed_that_closes_on_the_leader_never_costs_the_separation() -> None:
    flight = _flown(1800.0, (950.0, PursuerSpeed(tas=420.0 * KT)))
    assert not flight.of(SeparationLost)
    assert flight.of(ModeChanged)[-1].mode != "follow"


def test_a_plan_that_is_made_anew_each_second_for_separation_is_said_once() -> None:
    """At 240 m/s it comes to the slot too fast: from 163 s on each plan lasts a second."""
    fast = PursuerSpeed(tas=240.0)
    flight = fly_whole(replace(scenario("lesson_turn"), duration_limit=180.0), (20.0, fast))
    for_separation = [p for p in flight.of(PlanChanged) if p.reason == "separation"]
    assert len(for_separation) == 10
    assert [(p.plan.word, p.announced) for p in for_separation[:8]] == [
        ("LSL", k == 0) for k in range(8)
    ]
    assert for_separation[-1].announced
    assert for_separation[-1].plan.word == "RLR"


def test_losses_are_counted_by_the_new_d_min() -> None:
    wide = SetSpacing(slot_distance=60.0 * NM, min_separation=60.0 * NM)
    flight = _flown(20.0, (10.0, wide), engagement="off")
    (lost,) = flight.of(SeparationLost)
    assert lost.t == pytest.approx(10.0, abs=1.0)
    assert lost.announced


def test_d_may_become_less_than_d_min_was_where_both_are_changed() -> None:
    flight = _flown(20.0, (10.0, SetSpacing(slot_distance=4.0 * NM, min_separation=3.0 * NM)))
    (changed,) = flight.of(AssignmentChanged)
    assert (changed.t, changed.message) == (10.0, "D is 4.0 NM, d_min 3.0 NM.")


def test_a_proposal_is_made_anew_and_one_that_was_accepted_is_to_be_accepted_again() -> None:
    designated, armed = (
        SetEngagement(engagement="designated"),
        SetEngagement(engagement="armed"),
    )
    engaged = SetEngagement(engagement="engaged")
    flight = _flown(
        30.0,
        (2.0, designated),
        (6.0, armed),
        (9.0, SetSpacing(slot_distance=9.0 * NM)),
        (11.0, engaged),
        (13.0, armed),
        (15.0, engaged),
        engagement="off",
    )
    said = [(each.t, each.engagement) for each in flight.of(EngagementChanged)]
    assert said == [
        (2.0, "designated"),
        (6.0, "armed"),
        (9.0, "designated"),
        (11.0, "designated"),
        (13.0, "armed"),
        (15.0, "engaged"),
    ]
    assert 9.0 in [each.t for each in flight.of(PlanProposed)]
    refused = flight.of(EngagementChanged)[3]
    assert refused.message.startswith("D is 9.0 NM")
    assert refused.message.endswith("accept it again first.")
    (flown,) = flight.of(PlanChanged)
    assert flown.reason == "engaged"


@pytest.mark.parametrize(
    "at_once",
    [SetSpacing(slot_distance=9.0 * NM), SetEngagement(engagement="designated")],
    ids=["another D", "called off"],
)
def test_what_is_called_off_in_the_second_in_which_it_is_engaged_is_not_flown(
    at_once: Command,
) -> None:
    flight = _flown(
        20.0,
        (2.0, SetEngagement(engagement="designated")),
        (6.0, SetEngagement(engagement="armed")),
        (9.0, SetEngagement(engagement="engaged")),
        (9.0, at_once),
        engagement="off",
    )
    said = [(each.t, each.engagement) for each in flight.of(EngagementChanged)]
    assert said == [(2.0, "designated"), (6.0, "armed"), (9.0, "designated")]
    assert not flight.of(PlanChanged)


def test_in_a_queue_a_slot_that_another_is_to_take_is_refused() -> None:
    queue = scenario("stream_of_five")
    documents = []
    said = saying(
        (10.0, SetSpacing(slot_distance=11.0 * NM)), (12.0, SetSpacing(min_separation=3.0 * NM))
    )
    for document in fly(queue, plan, commands=said, sample_period=1.0):
        if document.t > 15.0:
            break
        documents.append(document)
    changed = Flown(tuple(documents)).of(AssignmentChanged)
    assert len(changed) == 2
    assert changed[0].ident == changed[1].ident


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_whatever_is_asked_on_the_way_no_separation_is_lost_and_d_is_kept(seed: int) -> None:
    start = replace(random_start(seed), min_separation=5.0 * NM, slot_distance=7.0 * NM)
    miles = 6.0 + seed / 3.0
    flight = fly_whole(
        own_scenario(start),
        (60.0, SetSpacing(slot_distance=miles * NM)),
        (90.0, PursuerBank(bank=(18.0 + seed % 3) * DEG)),
        (150.0, PursuerSpeed(tas=0.97 * start.pursuer.tas)),
        (200.0, PursuerSpeed(tas=0.0)),
    )
    # one begins so near that d_min is lost before anything is asked
    assert all(loss.t < 60.0 for loss in flight.of(SeparationLost))
    d = flight.of(AssignmentChanged)[-1].slot_distance
    if flight.result.joined:
        assert flight.samples[-1].guidance.separation == pytest.approx(d, abs=0.25 * NM)
