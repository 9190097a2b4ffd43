"""Hands on a stick: orders where something changes, neutral after silence, and never left alone."""

from collections.abc import Callable, Iterator
from itertools import pairwise

from relguide_server.flights.hands import LEVELLED, SILENCE, Hands

from relguide.flying.documents import CommandGiven, ControlChanged, Document, PlanChanged, Sample
from relguide.flying.flight import fly
from relguide.flying.orders import Command, SetAutopilot, SetDirector, Stick
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from relguide.units import DEG

PURSUER = "PURSUER"


def flown(script: dict[float, Callable[[Hands], None]], until: float) -> list[Document]:
    """Fig. 6b with hands on the stick, at rate 1: what they do, at their times."""
    now = 0.0
    hands = Hands(lambda: now)
    left = dict(script)

    def commands(t: float) -> Iterator[Command]:
        nonlocal now
        now = t
        for at in [at for at in left if at <= t + 1e-9]:
            left.pop(at)(hands)
        yield from hands.orders(t)

    documents = []
    for document in fly(scenario("fig_6b"), plan, commands=commands):
        if document.t > until:
            break
        hands.note(document)
        documents.append(document)
    return documents


def take(hands: Hands) -> None:
    hands.take(PURSUER, director=True)


def let_go(hands: Hands) -> None:
    hands.let_go()


def stick(roll: float, pitch: float = 0.0) -> Callable[[Hands], None]:
    return lambda hands: hands.move(roll, pitch)


def orders(documents: list[Document]) -> list[tuple[float, Command]]:
    return [(round(d.t, 2), d.command) for d in documents if isinstance(d, CommandGiven)]


def sticks(documents: list[Document]) -> list[tuple[float, float]]:
    return [(t, one.roll) for t, one in orders(documents) if isinstance(one, Stick)]


def held(roll: float, begin: float, end: float) -> dict[float, Callable[[Hands], None]]:
    """A stick that is held: said again each 0.2 s."""
    count = round((end - begin) / 0.2)
    return {round(begin + 0.2 * k, 2): stick(roll) for k in range(count + 1)}


def test_a_flight_without_hands_is_given_no_orders() -> None:
    assert orders(flown({}, 5.0)) == []


def test_a_stick_that_is_held_is_one_order_and_silence_makes_it_neutral() -> None:
    documents = flown({1.3: take, **held(0.4, 3.1, 5.1)}, 10.0)
    given = orders(documents)
    assert given[0] == (2.0, SetAutopilot(on=False, ident=PURSUER))
    (_, first), (t, last) = sticks(documents)
    assert (first, last) == (0.4, 0.0)
    assert 5.1 + SILENCE <= t <= 5.1 + SILENCE + 0.1
    assert [d.message for d in documents if isinstance(d, ControlChanged)] == [
        "You have control.",
        "The flight director is on.",
    ]


def test_a_stick_that_moves_before_control_is_taken_does_nothing_and_is_not_forgotten() -> None:
    documents = flown({2.1: take, **held(0.3, 2.2, 4.0)}, 6.0)
    assert sticks(documents)[0] == (3.0, 0.3)


def test_letting_go_is_neutral_at_once_and_the_autopilot_flies_from_the_next_second() -> None:
    documents = flown({1.0: take, **held(0.3, 2.0, 3.4), 3.55: let_go}, 10.0)
    assert sticks(documents)[-1] == (3.55, 0.0)
    assert orders(documents)[-1] == (4.0, SetAutopilot(on=True, ident=PURSUER))
    assert documents[-1].t > 9.0
    assert all(d.guidance[0].autopilot for d in documents if isinstance(d, Sample) and d.t >= 4.0)


def test_who_lets_go_in_a_steep_bank_is_levelled_first() -> None:
    documents = flown({1.0: take, **held(1.0, 2.0, 15.0), 15.1: let_go}, 40.0)
    samples = [d for d in documents if isinstance(d, Sample)]
    steepest = max(abs(one.aircraft[0].bank) for one in samples)
    assert steepest > 43.0 * DEG
    (back,) = [t for t, one in orders(documents) if one == SetAutopilot(on=True, ident=PURSUER)]
    assert 15.1 < back < 22.0
    at = next(one for one in samples if one.t >= back)
    assert abs(at.aircraft[0].bank) <= LEVELLED
    assert samples[-1].guidance[0].autopilot


def test_who_gives_the_autopilot_the_controls_by_another_way_takes_them_from_the_hands() -> None:
    now = 0.0
    hands = Hands(lambda: now)

    def commands(t: float) -> Iterator[Command]:
        if t == 1.0:
            hands.take(PURSUER, director=False)
        if t == 4.0:
            yield SetAutopilot(on=True)
        hands.move(0.2, 0.0)
        yield from hands.orders(t)

    documents = []
    for document in fly(scenario("fig_6b"), plan, commands=commands):
        if document.t > 8.0:
            break
        hands.note(document)
        documents.append(document)
        if document.t < 4.0:
            assert not hands.lost
            # a step's end is certain as soon as its stick is read
            assert hands.ahead == (0.05 if document.t >= 1.0 else 0.0)
    assert hands.lost
    assert hands.ahead == 0.0
    assert not hands.flown
    messages = [d.message for d in documents if isinstance(d, ControlChanged)]
    assert messages == ["You have control.", "The autopilot flies."]
    hands.let_go()
    assert not hands.lost


def test_a_director_that_is_switched_as_control_is_taken_does_not_take_it_back() -> None:
    hands = Hands(lambda: 0.0)

    def commands(t: float) -> Iterator[Command]:
        if t == 1.0:
            take(hands)
            taken = list(hands.orders(t))
            yield SetDirector(on=True, ident=PURSUER)  # of another way, before what hands ordered
            yield from taken
        else:
            yield from hands.orders(t)

    for document in fly(scenario("fig_6b"), plan, commands=commands):
        hands.note(document)
        if document.t > 3.0:
            break
    assert hands.flown == PURSUER
    assert not hands.lost


def test_what_hands_do_is_flown_again_to_the_bit_from_its_orders() -> None:
    script = {
        1.0: take, **held(0.8, 2.35, 4.0), **held(-0.5, 4.15, 8.0), 9.1: let_go, 12.0: take,
        13.15: stick(0.1, 0.9), 16.4: let_go,
    }  # fmt: skip
    first = flown(script, 60.0)
    given = [(d.t, d.command) for d in first if isinstance(d, CommandGiven)]
    assert len(given) > 8
    assert all(one != other for (_, one), (_, other) in pairwise(given))

    def commands(t: float) -> Iterator[Command]:
        while given and given[0][0] <= t + 1e-9:
            yield given.pop(0)[1]

    again = []
    for document in fly(scenario("fig_6b"), plan, commands=commands):
        if document.t > 60.0:
            break
        again.append(document)

    def compared(documents: list[Document]) -> list[Document]:
        return [d for d in documents if not isinstance(d, PlanChanged)]  # says how long it took

    assert compared(again) == compared(first)
