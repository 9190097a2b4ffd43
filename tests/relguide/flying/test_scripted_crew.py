"""A scripted crew reacts to what is said of its flight, and orders what can follow."""

from dataclasses import replace
from functools import cache, partial
from typing import get_args

import pytest

from relguide.flying.aircraft_documents import LinkCard
from relguide.flying.documents import (
    Alert,
    CommandGiven,
    Document,
    EngagementChanged,
    FlightEnded,
    FlightStarted,
    ModeChanged,
    PlanProposed,
    Unable,
)
from relguide.flying.engagement import Engagement
from relguide.flying.flight import fly
from relguide.flying.orders import (
    CrewCommand,
    LeaderSpeed,
    PursuerBank,
    SetAutopilot,
    SetEngagement,
)
from relguide.flying.scenarios import fig_6, scenario
from relguide.flying.scripted_crew import CrewOrder, Cue, ScriptedCrew, both, with_crew
from relguide.planning.plan import plan
from relguide.units import DEG, Second
from tests.flights import saying

OWN = "PURSUER"
DESIGNATE = CrewOrder(after=1.0, command=SetEngagement(engagement="designated"))
ACCEPT = CrewOrder(on="proposed", after=5.0, command=SetEngagement(engagement="armed"))
ENGAGE = CrewOrder(on="armed", after=10.0, command=SetEngagement(engagement="engaged"))
STEEPLY = PursuerBank(bank=20.0 * DEG)


@cache
def said_first() -> tuple[FlightStarted, PlanProposed]:
    documents = fly(fig_6(intent_known=True), plan, engagement="designated", sample_period=1.0)
    found: list[Document] = []
    while not any(isinstance(one, PlanProposed) for one in found):
        found.append(next(documents))
    started = next(one for one in found if isinstance(one, FlightStarted))
    return started, next(one for one in found if isinstance(one, PlanProposed))


def proposed(t: Second) -> PlanProposed:
    return replace(said_first()[1], t=t)


def engaged(t: Second, now: Engagement, before: Engagement, ident: str = OWN) -> EngagementChanged:
    return EngagementChanged(t=t, ident=ident, engagement=now, previous=before, message="")


def answers(
    script: tuple[CrewOrder, ...], *said: Document, until: int = 100
) -> list[tuple[int, CrewCommand]]:
    """What a crew orders each second, as what was said before that second comes to it."""
    crew, left, given = (
        ScriptedCrew(script),
        [said_first()[0], *said],
        list[tuple[int, CrewCommand]](),
    )
    for second in range(until):
        while (left and left[0].t < second) or (left and second == left[0].t == 0.0):
            crew.watch(left.pop(0))
        given += [(second, command) for command in crew.commands(float(second))]
    return given


def test_an_order_comes_so_long_after_its_cue_and_once_for_each() -> None:
    script = (CrewOrder(on="follow", after=3.0, command=STEEPLY), DESIGNATE)
    follows = [
        ModeChanged(t=t, ident=OWN, mode="follow", previous="capture", message="") for t in (10, 50)
    ]
    assert answers(script, *follows) == [(1, DESIGNATE.command), (13, STEEPLY), (53, STEEPLY)]


def test_while_it_waits_its_cue_does_not_count_again() -> None:
    """A proposal is made anew every other second: a crew that began to read again never accepts."""
    assert answers((ACCEPT,), *map(proposed, (2.0, 4.0, 6.0))) == [(7, ACCEPT.command)]


def test_what_is_offered_again_is_accepted_again_and_nothing_twice() -> None:
    script = (DESIGNATE, ACCEPT, ENGAGE)
    said = (
        engaged(1.0, "designated", "off"),
        proposed(1.0),
        engaged(6.0, "armed", "designated"),
        proposed(8.0),  # while armed it is no offer
        proposed(12.0),
        engaged(12.0, "designated", "armed"),  # … until it takes the place of what was accepted
        engaged(17.0, "armed", "designated"),
        engaged(27.0, "engaged", "armed"),
    )
    assert [(t, command.engagement) for t, command in answers(script, *said)] == [
        (1, "designated"),
        (6, "armed"),
        (17, "armed"),
        (27, "engaged"),
    ]


def test_what_was_withdrawn_is_not_engaged() -> None:
    said = (
        engaged(1.0, "designated", "off"),
        engaged(6.0, "armed", "designated"),
        engaged(9.0, "designated", "armed"),
    )
    assert answers((ENGAGE,), *said) == []


def test_a_crew_listens_to_what_is_said_to_it() -> None:
    script = (
        CrewOrder(on="data_lost", command=SetAutopilot(on=False, ident="B")),
        CrewOrder(on="alert", command=SetAutopilot(on=False)),
        CrewOrder(on="unable", command=STEEPLY),
    )
    alert = Alert(
        t=3.0, ident=OWN, other="LEADER", level="caution", subject="data", message="",
        predicted_least=0.0, predicted_at=0.0, cleared=False,
    )  # fmt: skip
    said = (
        alert,
        Unable(t=5.0, ident=OWN, reason="data", message=""),
        replace(alert, t=7.0, cleared=True),
        replace(alert, t=8.0, ident="B"),
        Unable(t=9.0, ident="B", reason="speed", message=""),
    )
    two = LinkCard(
        pursuer="B", leader="LEADER", slot_distance=1e4, min_separation=9e3, spacing="distance",
        spacing_time=0.0,
    )  # fmt: skip
    started = said_first()[0]
    begins = replace(started, links=(*started.links, two))
    assert answers(script, begins, *said) == [(4, script[1].command), (6, STEEPLY)]


def test_a_refusal_is_no_cue() -> None:
    assert answers((CrewOrder(on="off", command=STEEPLY),), engaged(4.0, "off", "off")) == []


@pytest.mark.slow
def test_a_flight_is_engaged_and_joins_and_others_are_obeyed_too() -> None:
    flight = partial(fly, fig_6(intent_known=True), plan, engagement="off", sample_period=1.0)
    slower = LeaderSpeed(tas=190.0)
    flown = list(with_crew((DESIGNATE, ACCEPT, ENGAGE), flight, saying((100.0, slower))))
    given = [(one.t, one.command) for one in flown if isinstance(one, CommandGiven)]
    assert given == [
        (1.0, DESIGNATE.command),
        (6.0, ACCEPT.command),
        (16.0, ENGAGE.command),
        (100.0, slower),
    ]
    ended = flown[-1]
    assert isinstance(ended, FlightEnded)
    assert ended.results[0].joined


@pytest.mark.slow
def test_each_pursuer_of_a_queue_has_its_crew() -> None:
    stream = scenario("stream_of_five")
    idents = [stream.pursuer_ident, *(one.ident for one in (*stream.ahead, *stream.followers))]
    script = [
        replace(one, command=replace(one.command, ident=ident))
        for ident in idents[:2]
        for one in (DESIGNATE, ACCEPT)
    ]
    flight = partial(fly, stream, plan, engagement="off", sample_period=1.0)
    armed = set()
    for document in with_crew(script, flight):
        if isinstance(document, EngagementChanged) and document.engagement == "armed":
            armed.add(document.ident)
        if document.t > 60.0:
            break
    assert armed == set(idents[:2])


def test_both_are_given_in_turn() -> None:
    one, other = SetAutopilot(on=True), SetAutopilot(on=False)
    given = both(saying((3.0, one)), saying((3.0, other), (4.0, other)))
    assert [list(given(t)) for t in (2.0, 3.0, 4.0)] == [[], [one, other], [other]]


def test_what_is_no_script_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^on must be one of start, proposed, .*, not 'arm'\.$"):
        CrewOrder(on="arm", command=STEEPLY)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^after must be 0 s or more, not -1 s\.$"):
        CrewOrder(after=-1.0, command=STEEPLY)
    with pytest.raises(ValueError, match=r"^command must be a LeaderData or "):
        CrewOrder(command=LeaderSpeed(tas=200.0))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^An order of a crew must be a CrewOrder, not "):
        ScriptedCrew([STEEPLY])  # type: ignore[list-item]
    assert eval(repr(ACCEPT), {"CrewOrder": CrewOrder, "SetEngagement": SetEngagement}) == ACCEPT
    assert len(get_args(Cue)) == 14
