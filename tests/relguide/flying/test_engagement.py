"""A crew designates, accepts, engages and disconnects; nothing is flown that was not accepted."""

from collections.abc import Iterable
from math import hypot
from typing import TypeVar

import pytest

from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PlanUnavailable,
    Sample,
    SeparationLost,
    Unable,
)
from relguide.flying.engagement import MAY_BECOME, Engagement, refusal
from relguide.flying.flight import Scenario, fly
from relguide.flying.orders import (
    Command,
    LeaderData,
    LeaderSpeed,
    PursuerHeading,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    Stick,
)
from relguide.flying.scenarios import own_scenario, scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, KT, NM
from tests.flights import random_start
from tests.relguide.flying.guidance.beliefs import behind

T = TypeVar("T")
Orders = dict[float, Command]


def _beside(east: float, north: float, tas: float) -> Situation:
    """Both fly east, own ship so far from the leader [NM] and so fast [kt]."""
    east_bound = 90.0 * DEG
    return Situation(
        pursuer=Pursuer(
            x=east * NM, y=north * NM, heading=east_bound, tas=tas * KT, max_bank=25.0 * DEG
        ),
        leader=Leader(x=0.0, y=0.0, heading=east_bound, tas=390.0 * KT, intent=()),
        slot_distance=6.0 * NM,
        min_separation=5.0 * NM,
    )


TIES = {"beside": _beside(0.0, 12.0, 420.0), "overtaking": _beside(14.0, -7.0, 465.0)}
"""Two encounters of the cockpit's gallery."""


def flown(
    orders: Orders,
    until: float,
    *,
    flight: Scenario | None = None,
    engagement: Engagement = "off",
) -> list[Document]:
    """A flight, fig. 6b's if no other, up to a time [s], with orders at their times."""
    documents = []

    def commands(t: float) -> Iterable[Command]:
        return [orders[t]] if t in orders else []

    found = fly(
        flight or scenario("fig_6b"),
        plan,
        commands=commands,
        sample_period=1.0,
        engagement=engagement,
    )
    for document in found:
        if document.t > until:
            break
        documents.append(document)
    return documents


def of(documents: list[Document], kind: type[T]) -> list[T]:
    return [each for each in documents if isinstance(each, kind)]


def to(engagement: Engagement) -> SetEngagement:
    return SetEngagement(engagement=engagement)


def engagements(documents: list[Document]) -> list[Engagement]:
    return [each.guidance[0].engagement for each in of(documents, Sample)]


def test_at_off_a_heading_is_held_and_nothing_is_proposed() -> None:
    documents = flown({}, 60.0)
    assert not of(documents, PlanProposed)
    assert not of(documents, PlanChanged)
    assert {each.guidance[0].mode for each in of(documents, Sample)} == {"heading"}
    own = [each.aircraft[0] for each in of(documents, Sample)]
    assert own[0].heading == pytest.approx(own[-1].heading, abs=0.1 * DEG)


def test_at_off_a_loss_is_announced_a_minute_before_however_late_the_least_comes() -> None:
    """Overtaking at 30 m/s from 12 km: d_min is lost after 91 s, and the leader met after 400 s."""
    documents = flown({}, 100.0, flight=behind(along=12_000.0))
    (lost,), (caution, warning) = of(documents, SeparationLost), of(documents, Alert)
    assert (caution.level, warning.level) == ("caution", "warning")
    assert lost.announced == (caution.t,)
    assert 55.0 < lost.t - caution.t <= 61.0
    assert caution.predicted_at == pytest.approx(lost.t, abs=1.5)
    assert caution.message.startswith("Separation in 60 s: below 5.00 NM, down to ")


@pytest.mark.parametrize("engagement", ["off", "designated"])
def test_that_nothing_is_heard_of_the_leader_is_said_and_stands_in_every_mode(
    engagement: Engagement,
) -> None:
    orders: Orders = {10.0: LeaderData(received=False), 40.0: LeaderData(received=True)}
    documents = flown(orders, 60.0, engagement=engagement)
    begun, ended = of(documents, Alert)
    assert (begun.subject, begun.level, begun.cleared, begun.t) == ("data", "caution", False, 21.0)
    assert begun.message == (
        "Nothing was heard of the leader for 11 s: the separation is not known."
    )
    assert (ended.cleared, ended.message) == (True, "The leader is heard again.")
    stood = [each.t for each in of(documents, Sample) if each.guidance[0].alert == "caution"]
    assert stood == [float(t) for t in range(21, int(ended.t))]


def test_a_loss_while_nothing_is_heard_counts_as_announced_by_that() -> None:
    documents = flown({10.0: LeaderData(received=False)}, 100.0, flight=behind(along=12_000.0))
    (lost,), (said, *_) = of(documents, SeparationLost), of(documents, Alert)
    assert lost.announced == (said.t,) == (21.0,)


def test_from_off_to_engaged_and_back() -> None:
    orders: Orders = {
        5.0: to("designated"),
        12.0: to("armed"),
        20.0: to("engaged"),
        40.0: to("designated"),  # refused: what is flown is disconnected, not designated anew
        60.0: to("off"),
    }
    documents = flown(orders, 90.0)
    changes = [each.engagement for each in of(documents, EngagementChanged)]
    assert changes == ["designated", "armed", "engaged", "engaged", "off"]
    proposed = of(documents, PlanProposed)
    assert [each.t for each in proposed][:3] == [5.0, 7.0, 9.0]
    assert proposed[-1].t < 20.0
    (first, *_) = of(documents, PlanChanged)
    assert (first.t, first.reason) == (20.0, "engaged")
    assert [each.mode for each in of(documents, ModeChanged)] == ["converge", "heading"]
    assert "holding" in of(documents, ModeChanged)[-1].message


def test_a_proposal_is_what_would_be_flown_and_begins_at_the_aircraft() -> None:
    documents = flown({5.0: to("designated"), 9.0: to("armed"), 11.0: to("engaged")}, 12.0)
    proposed, engaged = of(documents, PlanProposed)[-1], of(documents, PlanChanged)[0]
    assert engaged.t - proposed.t <= 2.0
    assert proposed.promised == pytest.approx(engaged.promised, abs=10.0)
    (at,) = [each for each in of(documents, Sample) if each.t == proposed.t]
    start = proposed.plan.segments[0].start
    assert hypot(start.x - at.aircraft[0].x, start.y - at.aircraft[0].y) < 30.0
    assert proposed.others
    assert all(each.segments for each in proposed.others)
    times = [proposed.plan.time_to_converge, *(o.time_to_converge for o in proposed.others)]
    assert times[1:] == sorted(times[1:])


def test_what_may_not_follow_is_refused_with_a_sentence_and_changes_nothing() -> None:
    documents = flown({5.0: to("engaged"), 8.0: to("armed"), 9.0: to("off")}, 12.0)
    said = of(documents, EngagementChanged)
    assert [(each.previous, each.engagement) for each in said] == [("off", "off")] * 3
    assert all(each.message.endswith(".") for each in said)
    assert set(engagements(documents)) == {"off"}


def test_without_a_proposal_there_is_nothing_to_accept() -> None:
    orders: Orders = {
        0.0: LeaderSpeed(tas=400.0),
        1.0: PursuerHeading(heading=315.0 * DEG),
        300.0: to("designated"),
        310.0: to("armed"),
    }
    documents = flown(orders, 315.0)
    assert len(of(documents, PlanUnavailable)) == 1
    assert "no proposal" in of(documents, EngagementChanged)[-1].message
    assert engagements(documents)[-1] == "designated"


def test_an_accepted_proposal_that_can_no_longer_be_flown_disarms() -> None:
    orders: Orders = {2.0: to("designated"), 6.0: to("armed"), 8.0: LeaderSpeed(tas=300.0)}
    documents = flown(orders, 120.0)
    assert engagements(documents)[-1] == "designated"
    assert not of(documents, PlanChanged)


@pytest.mark.parametrize(
    "order", [PursuerHeading(heading=110.0 * DEG), LeaderSpeed(tas=170.0)], ids=["own", "leader"]
)
def test_an_accepted_proposal_lapses_when_either_drifts_slowly_from_it(order: Command) -> None:
    """Each new proposal is nearly the one before, but no longer the one that was accepted."""
    orders: Orders = {2.0: to("designated"), 6.0: to("armed"), 8.0: order}
    documents = flown(orders, 240.0)
    armed = engagements(documents).count("armed")
    assert 10 < armed < 230
    assert engagements(documents)[-1] == "designated"
    assert "accept it again" in of(documents, EngagementChanged)[-1].message
    assert of(documents, PlanProposed)[-1].t > 230.0


@pytest.mark.parametrize("accepted", [4.0, 5.0, 11.0])
@pytest.mark.parametrize("encounter", ["beside", "overtaking"])
def test_a_crew_has_time_to_engage_what_it_accepted(encounter: str, accepted: float) -> None:
    """Left and right are as fast here, by tenths of a second that change with every proposal."""
    orders: Orders = {accepted: to("armed"), accepted + 15.0: to("engaged")}
    documents = flown(
        orders, accepted + 20.0, flight=own_scenario(TIES[encounter]), engagement="designated"
    )
    assert [each.engagement for each in of(documents, EngagementChanged)] == ["armed", "engaged"]
    offered = {each.plan.word for each in of(documents, PlanProposed) if each.t > accepted}
    flown_word = of(documents, PlanChanged)[0].plan.word
    assert offered == {flown_word}


def test_a_crew_flies_headings_until_it_engages() -> None:
    orders: Orders = {5.0: PursuerHeading(heading=180.0 * DEG), 100.0: to("designated")}
    own = of(flown(orders, 110.0), Sample)[-1].aircraft[0]
    assert own.heading == pytest.approx(180.0 * DEG, abs=1.0 * DEG)


@pytest.mark.parametrize("begins", ["engaged", "armed"])
def test_old_data_of_the_leader_give_the_aircraft_back(begins: Engagement) -> None:
    orders: Orders = {30.0: LeaderData(received=False), 60.0: LeaderData(received=True)}
    if begins == "armed":
        orders |= {2.0: to("designated"), 6.0: to("armed")}
    start: Engagement = "engaged" if begins == "engaged" else "off"
    documents = flown(orders, 70.0, engagement=start)
    ages = {each.t: each.guidance[0].leader_age for each in of(documents, Sample)}
    assert (ages[29.0], ages[35.0], ages[59.0]) == pytest.approx((0.0, 5.0, 29.0))
    assert ages[62.0] == 0.0
    (unable,) = of(documents, Unable)
    assert (unable.reason, unable.t) == ("data", 41.0)
    assert engagements(documents)[-1] == "designated"
    again = [each.t for each in of(documents, PlanProposed) if each.t > 35.0]
    assert min(again) >= 60.0


def test_no_step_of_the_table_leads_to_a_flight_that_was_not_accepted() -> None:
    before = {now for now, then in MAY_BECOME.items() if "engaged" in then}
    assert before == {"armed"}
    for now in MAY_BECOME:
        for then in MAY_BECOME:
            allowed = not refusal(now, then, proposed=True)
            assert allowed == (then in MAY_BECOME[now])
    assert refusal("designated", "armed", proposed=False)


ALL_ORDERS: dict[Engagement, Orders] = {
    "off": {},
    "designated": {2.0: to("designated")},
    "armed": {2.0: to("designated"), 6.0: to("armed")},
    "engaged": {2.0: to("designated"), 6.0: to("armed"), 10.0: to("engaged")},
}


@pytest.mark.parametrize("director", [True, False])
@pytest.mark.parametrize("autopilot", [True, False])
@pytest.mark.parametrize("engagement", ALL_ORDERS)
def test_autopilot_director_and_bars_agree_in_every_engagement(
    engagement: Engagement, autopilot: bool, director: bool
) -> None:
    orders = dict(ALL_ORDERS[engagement])
    if not autopilot:
        orders[14.0] = SetAutopilot(on=False)
    if director:
        orders[15.0] = SetDirector(on=True)
    guidance = of(flown(orders, 20.0), Sample)[-1].guidance[0]
    assert guidance.engagement == engagement
    assert guidance.mode == ("converge" if engagement == "engaged" else "heading")
    assert (guidance.autopilot, guidance.director) == (autopilot, director)
    assert bool(guidance.bars) == (director and engagement != "off")


@pytest.mark.parametrize("autopilot", [True, False])
@pytest.mark.parametrize("how", ["data", "disconnect"])
def test_a_reversion_is_announced_and_the_bars_show_what_is_commanded_then(
    how: str, autopilot: bool
) -> None:
    last: Command = LeaderData(received=False) if how == "data" else to("off")
    orders: Orders = {0.0: SetDirector(on=True), 30.0: last}
    if not autopilot:
        orders[1.0] = SetAutopilot(on=False)
    documents = flown(orders, 60.0, engagement="engaged")
    when = 41.0 if how == "data" else 30.0
    assert [(each.t, each.mode) for each in of(documents, ModeChanged)][-1] == (when, "heading")
    (said,) = of(documents, EngagementChanged)
    assert (said.t, said.previous) == (when, "engaged")
    assert "holding" in said.message
    before, after = (
        [each.guidance[0] for each in of(documents, Sample) if a <= each.t < b]
        for a, b in ((2.0, when), (when + 1.0, 61.0))
    )
    assert all(each.bars for each in before)
    assert {each.mode for each in after} == {"heading"}
    assert {each.autopilot for each in after} == {autopilot}
    if how == "disconnect":
        assert not any(each.bars for each in after)
    else:
        assert all(each.bars for each in after)
        assert all(abs(each.bars[0].commanded_bank) < 30.0 * DEG for each in after)


def test_a_heading_is_refused_while_guidance_flies_by_whatever_hand() -> None:
    orders: Orders = {
        5.0: PursuerHeading(heading=0.0),
        10.0: SetAutopilot(on=False),
        15.0: PursuerHeading(heading=0.0),
    }
    documents = flown(orders, 20.0, engagement="engaged")
    said = of(documents, EngagementChanged)
    assert [(each.t, each.previous, each.engagement) for each in said] == [
        (5.0, "engaged", "engaged"),
        (15.0, "engaged", "engaged"),
    ]
    assert {each.message for each in said} == {
        "Relative guidance flies: disconnect it to select a heading."
    }
    assert of(documents, Sample)[-1].guidance[0].mode == "converge"


def test_engagement_goes_on_while_a_crew_flies_by_hand() -> None:
    orders: Orders = {0.0: SetAutopilot(on=False), **ALL_ORDERS["engaged"], 20.0: to("off")}
    documents = flown(orders, 25.0)
    changes = [each.engagement for each in of(documents, EngagementChanged)]
    assert changes == ["designated", "armed", "engaged", "off"]
    assert {each.guidance[0].autopilot for each in of(documents, Sample) if each.t > 0.0} == {False}


def test_an_autopilot_that_takes_over_holds_the_heading_that_was_flown_to() -> None:
    orders: Orders = {
        0.0: SetAutopilot(on=False),
        1.0: Stick(roll=0.5),
        4.0: Stick(roll=0.0),
        20.0: SetAutopilot(on=True),
    }
    own = {each.t: each.aircraft[0].heading for each in of(flown(orders, 60.0), Sample)}
    assert abs(own[20.0] - own[0.0]) > 3.0 * DEG
    assert own[60.0] == pytest.approx(own[20.0], abs=1.0 * DEG)


@pytest.mark.parametrize(("seed", "accepts", "waits"), [(6, 20, 50), (12, 3, 40)])
def test_a_changed_proposal_is_offered_again_and_one_order_accepts_it(
    seed: int, accepts: int, waits: int
) -> None:
    """The crew engages too soon, is told why, accepts once more, and engages."""
    engage = float(accepts + waits)
    orders: Orders = {
        float(accepts): to("armed"),
        engage: to("engaged"),
        engage + 2.0: to("armed"),
        engage + 4.0: to("engaged"),
    }
    documents = flown(
        orders, engage + 6.0, flight=own_scenario(random_start(seed)), engagement="designated"
    )
    said = of(documents, EngagementChanged)
    assert [(each.previous, each.engagement) for each in said] == [
        ("designated", "armed"),
        ("armed", "designated"),
        ("designated", "designated"),
        ("designated", "armed"),
        ("armed", "engaged"),
    ]
    assert said[1].message.startswith("The proposal has changed (")
    assert said[1].message.endswith("): accept it again.")
    assert said[2].message == said[1].message[:-1] + " first."
    (first,) = of(documents, PlanChanged)
    assert (first.t, first.reason) == (engage + 4.0, "engaged")
