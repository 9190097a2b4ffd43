"""Orders by ident: the aircraft named obeys and no other; an order it cannot obey is refused."""

from collections.abc import Iterator
from math import pi

import pytest

from relguide.flying.airframe_files import airframe
from relguide.flying.documents import Document, EngagementChanged, LeaderChanged, Sample
from relguide.flying.orders import (
    Command,
    IntentKnown,
    LeaderData,
    LeaderHeading,
    LeaderSpeed,
    PursuerHeading,
    SetEngagement,
    order_fault,
)
from relguide.flying.simulation import simulate
from relguide.flying.world import Aircraft, Declared, Guided, Link, World
from relguide.units import DEG, NM
from tests.flights import saying

FLYING = ("P", "LEAD", "Q", "OTHER", "BY")
LINKS = (("P", "LEAD"), ("Q", "OTHER"))


def craft(ident: str, pilot: Guided | Declared, x: float, y: float, tas: float = 200.0) -> Aircraft:
    return Aircraft(
        ident=ident, airframe=airframe("A306"), aircraft_type="A306", x=x, y=y, heading=0.0,
        tas=tas, altitude=9_449.0, max_bank=25.0 * DEG, pilot=pilot,
    )  # fmt: skip


def world() -> World:
    """Two pairs far apart, and one aircraft that flies by."""
    return World(
        aircraft=(
            craft("P", Guided(), 0.0, -40_000.0, 235.0),
            craft("LEAD", Declared(), 0.0, 0.0),
            craft("Q", Guided(), 300_000.0, -40_000.0, 235.0),
            craft("OTHER", Declared(), 300_000.0, 0.0),
            craft("BY", Declared(), -300_000.0, 0.0),
        ),
        links=tuple(
            Link(pursuer=pursuer, leader=leader, slot_distance=12_000.0, min_separation=5.0 * NM)
            for pursuer, leader in LINKS
        ),
    )


def flown(*said: tuple[float, Command], until: float = 60.0) -> list[Document]:
    return list(simulate(world(), commands=saying(*said), sample_period=1.0, until=until))


def last(documents: list[Document]) -> Sample:
    return [document for document in documents if isinstance(document, Sample)][-1]


def tas_of(documents: list[Document]) -> dict[str, float]:
    return {one.ident: one.tas for one in last(documents).aircraft}


def heading_of(documents: list[Document]) -> dict[str, float]:
    return {one.ident: one.heading for one in last(documents).aircraft}


@pytest.mark.parametrize("named", ["LEAD", "OTHER", "BY"])
def test_the_aircraft_named_does_as_it_is_ordered_and_no_other(named: str) -> None:
    quiet = flown()
    for order, seen in (
        (LeaderSpeed(tas=190.0, ident=named), tas_of),
        (LeaderHeading(heading=0.5 * pi, ident=named), heading_of),
    ):
        documents = flown((5.0, order))
        changed = {one for one, value in seen(documents).items() if value != seen(quiet)[one]}
        followers = {pursuer for pursuer, leader in LINKS if leader == named}
        assert named in changed <= {named} | followers
        (said,) = [d for d in documents if isinstance(d, LeaderChanged)]
        assert said.ident == named
        assert said.message.startswith(f"{named} is instructed to ")


def test_without_a_name_it_is_the_first_link_s_leader() -> None:
    (said,) = [d for d in flown((5.0, LeaderSpeed(tas=190.0))) if isinstance(d, LeaderChanged)]
    assert (said.ident, said.message) == ("LEAD", "The leader is instructed to fly 369 kt.")


def test_a_crew_is_ordered_by_its_ident() -> None:
    documents = flown(
        (5.0, SetEngagement(engagement="off", ident="Q")),
        (6.0, PursuerHeading(heading=1.5 * pi, ident="Q")),
        (7.0, LeaderData(received=False, ident="Q")),
        until=120.0,
    )
    assert [d.ident for d in documents if isinstance(d, EngagementChanged)] == ["Q"]
    assert heading_of(documents)["Q"] == pytest.approx(1.5 * pi, abs=1.0 * DEG)
    ages = {one.ident: one.leader_age for one in last(documents).guidance}
    assert ages["P"] == 0.0 < ages["Q"]


def test_an_intent_is_withdrawn_from_those_who_follow_that_leader() -> None:
    (said,) = [
        d
        for d in flown((5.0, IntentKnown(known=False, ident="OTHER")))
        if d.kind == "leader_changed"
    ]
    assert (said.ident, said.message) == ("OTHER", "OTHER's intent is withdrawn.")


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        (
            LeaderSpeed(tas=200.0, ident="X"),
            "There is no aircraft 'X' to order: there are P, LEAD, Q, OTHER, BY.",
        ),
        (SetEngagement(engagement="off", ident="X"), "There is no aircraft 'X' to order: "),
        (LeaderHeading(heading=0.0, ident="Q"), "Q joins a leader, and its guidance flies it: "),
        (SetEngagement(engagement="off", ident="BY"), "BY is no pursuer, so it has no crew to "),
        (LeaderData(received=True, ident="LEAD"), "LEAD is no pursuer, so it has no crew to order"),
        (IntentKnown(known=True, ident="BY"), "No pursuer follows BY: followed is LEAD, OTHER."),
    ],
)
def test_who_cannot_be_ordered_is_refused_with_a_sentence(command: Command, sentence: str) -> None:
    assert order_fault(command, FLYING, LINKS).startswith(sentence)

    def flight() -> Iterator[Document]:
        return simulate(world(), commands=saying((2.0, command)), sample_period=1.0, until=9.0)

    with pytest.raises(ValueError, match=r"^" + sentence[:20]):
        list(flight())


def test_who_can_be_ordered_is_not_refused() -> None:
    fine: tuple[Command, ...] = (
        LeaderSpeed(tas=200.0),
        LeaderSpeed(tas=200.0, ident="BY"),
        LeaderHeading(heading=0.0, ident="OTHER"),
        IntentKnown(known=True),
        IntentKnown(known=True, ident="OTHER"),
        PursuerHeading(heading=0.0),
        SetEngagement(engagement="off", ident="Q"),
    )
    assert [order_fault(command, FLYING, LINKS) for command in fine] == [""] * len(fine)


def test_an_order_shows_itself_as_code_without_what_is_left_out() -> None:
    assert repr(LeaderSpeed(tas=200.0)) == "LeaderSpeed(tas=200.0)"
    assert repr(LeaderSpeed(tas=200.0, ident="BY")) == "LeaderSpeed(tas=200.0, ident='BY')"
