"""Who may have situations looked at on the event loop."""

from relguide_server.jobs.cpu_budget import SAVED, SHARE, CpuBudget
from relguide_server.jobs.ttl_cache import LATELY

SLOW = 0.003
"""A look that takes long [s]."""
SHORT = 0.0002
"""A usual one [s]."""


class Clock:
    """Time that passes when it is told to [s]."""

    t = 100.0

    def __call__(self) -> float:
        return self.t


def test_looks_in_vain_take_a_small_part_of_the_loop_however_many_clients_ask() -> None:
    clock = Clock()
    looks = CpuBudget(now=clock)
    clients = [str(number) for number in range(6)]
    for client in clients:
        assert looks.may(client)
        looks.note(client, SLOW, vain=True)
    spent = 0.0
    for turn in range(40_000):
        clock.t += 1e-3
        client = clients[turn % len(clients)]
        if looks.may(client):
            spent += SLOW
            looks.note(client, SLOW, vain=True)
    assert 0.9 * SHARE * 40.0 < spent <= SHARE * 40.0 + len(clients) * SLOW


def test_others_are_always_looked_at() -> None:
    looks = CpuBudget(now=lambda: 0.0)
    while looks.may("attacker"):
        looks.note("attacker", SLOW, vain=True)
    assert looks.may("other")


def test_who_asks_in_vain_now_and_then_is_looked_at_beside_those_who_always_do() -> None:
    clock = Clock()
    looks = CpuBudget(now=clock)
    refused = 0
    for turn in range(20_000):
        clock.t += 1e-3
        for attacker in "abcdef":
            if looks.may(attacker):
                looks.note(attacker, SLOW, vain=True)
        refused += not looks.may("other")
        if turn % 100 == 0:  # ten times a second
            looks.note("other", SHORT, vain=True)
    assert refused == 0


def test_a_quick_look_that_finds_a_plan_costs_nothing_and_pays_for_none_in_vain() -> None:
    looks = CpuBudget(now=lambda: 0.0)
    for _ in range(1000):
        assert looks.may("a")
        looks.note("a", SHORT, vain=False)
    looks.note("a", SLOW, vain=True)
    looks.note("a", SHORT, vain=False)
    assert not looks.may("a")


def test_a_long_look_counts_though_it_finds_a_plan() -> None:
    looks = CpuBudget(now=lambda: 0.0)
    looks.note("a", SLOW, vain=False)
    assert not looks.may("a")


def test_a_look_that_was_interrupted_costs_no_more_than_others() -> None:
    clock = Clock()
    looks = CpuBudget(now=clock)
    looks.note("a", 10.0, vain=False)
    clock.t += 0.01
    assert looks.may("a")


def test_some_looks_are_saved_up_but_not_many() -> None:
    clock = Clock()
    looks = CpuBudget(now=clock)
    looks.note("a", 0.0, vain=True)
    clock.t += 0.9 * LATELY
    spent = 0.0
    while looks.may("a"):
        looks.note("a", SHORT, vain=True)
        spent += SHORT
    assert SAVED - SHORT < spent < SAVED + SHORT


def test_a_look_in_vain_is_forgotten_after_a_while() -> None:
    clock = Clock()
    looks = CpuBudget(now=clock)
    for _ in range(1000):
        looks.note("a", SLOW, vain=True)
    clock.t += 0.9 * LATELY
    assert not looks.may("a")
    clock.t += 0.2 * LATELY
    assert looks.may("a")
