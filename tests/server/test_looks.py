"""Who may have situations looked at on the event loop."""

from relguide_server.lately import LATELY, REMEMBERED
from relguide_server.looks import SAVED, SHARE, Looks

SLOW = 0.003
"""A look that is in vain [s]."""


class Clock:
    """Time that passes when it is told to [s]."""

    t = 100.0

    def __call__(self) -> float:
        return self.t


def test_looks_in_vain_take_a_small_part_of_the_loop_however_many_clients_ask() -> None:
    clock = Clock()
    looks = Looks(now=clock)
    clients = [str(number) for number in range(6)]
    for client in clients:
        assert looks.may(client)
        looks.note(client, SLOW, vain=True)
    spent = 0.0
    for turn in range(4000):
        clock.t += 1e-3
        client = clients[turn % len(clients)]
        if looks.may(client):
            spent += SLOW
            looks.note(client, SLOW, vain=True)
    assert 0.9 * SHARE * 4.0 < spent <= SHARE * 4.0 + SAVED + SLOW


def test_others_are_always_looked_at() -> None:
    looks = Looks(now=lambda: 0.0)
    while looks.may("attacker"):
        looks.note("attacker", SLOW, vain=True)
    for _ in range(1000):
        assert looks.may("other")
        looks.note("other", SLOW, vain=False)


def test_a_look_that_finds_a_plan_makes_good_what_was_in_vain() -> None:
    clock = Clock()
    looks = Looks(now=clock)
    while looks.may("a"):
        looks.note("a", SLOW, vain=True)
    clock.t += 1.0
    assert looks.may("a")
    looks.note("a", 2.0 * SAVED, vain=False)
    assert looks.may("a")


def test_a_look_in_vain_is_forgotten_after_a_while() -> None:
    clock = Clock()
    looks = Looks(now=clock)
    looks.note("a", 0.0, vain=True)
    looks.note("a", 10.0, vain=True)
    clock.t += 0.9 * LATELY
    assert not looks.may("a")
    clock.t += 0.2 * LATELY
    assert looks.may("a")


def test_of_many_clients_the_latest_are_remembered() -> None:
    looks = Looks(now=lambda: 0.0)
    for number in range(REMEMBERED + 5):
        looks.note("0", SAVED, vain=True)
        looks.note(str(number), 0.0, vain=True)
    assert not looks.may("0")
    assert looks.may("1")
    assert not looks.may(str(REMEMBERED + 4))
