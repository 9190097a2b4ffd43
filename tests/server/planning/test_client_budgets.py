"""What clients may take of the kept worker, and of the event loop."""

import pytest
from relguide_server.planning.client_budgets import (
    ENOUGH,
    LOOK_SAVED,
    LOOK_SHARE,
    SHORT,
    TRIAL,
    ClientBudgets,
)
from relguide_server.planning.tasks import PlanReply
from relguide_server.shares.token_buckets import KEPT


def made(processor: float, *, cut: bool = False) -> PlanReply:
    return PlanReply(b"", "planned", "", processor, final=True, processor=processor, cut=cut)


@pytest.mark.parametrize(
    ("answered", "time"),
    [
        (made(0.005), TRIAL),  # quick: the first of three
        (made(0.9 * TRIAL, cut=True), 0.0),  # long
        (made(0.3 * TRIAL, cut=True), TRIAL),  # it waited for a processor: nothing is known
        (made(1.1 * SHORT), 0.0),  # it came to its end, but would not again
    ],
)
def test_a_first_plan_tells_how_much_time_the_next_gets(answered: PlanReply, time: float) -> None:
    budgets = ClientBudgets(now=lambda: 0.0)
    assert budgets.time_for("a") == TRIAL
    budgets.note_plan("a", TRIAL, answered)
    assert budgets.time_for("a") == time
    assert budgets.time_for("b") == TRIAL


def test_who_is_known_for_quick_plans_has_more_time_to_show_that_one_is() -> None:
    budgets = ClientBudgets(now=lambda: 0.0)
    for _ in range(ENOUGH):
        assert budgets.time_for("a") == TRIAL
        budgets.note_plan("a", TRIAL, made(0.005))
    budgets.note_plan("a", SHORT, made(0.9 * TRIAL, cut=True))
    assert budgets.time_for("a") == SHORT
    budgets.note_plan("a", SHORT, made(0.9 * SHORT, cut=True))
    assert budgets.time_for("a") == 0.0


def test_a_quick_plan_does_not_make_good_what_took_long() -> None:
    now = 100.0
    budgets = ClientBudgets(now=lambda: now)
    budgets.note_impatient("a")
    budgets.note_plan("a", SHORT, made(0.001))
    assert budgets.time_for("a") == 0.0
    now += 1.1 * KEPT
    assert budgets.time_for("a") == TRIAL


# --- looks on the event loop ---------------------------------------------------------------------


SLOW = 0.003
"""A look that takes long [s]."""
USUAL = 0.0002
"""A usual one [s]."""


class Clock:
    """Time that passes when it is told to [s]."""

    t = 100.0

    def __call__(self) -> float:
        return self.t


def test_looks_in_vain_take_a_small_part_of_the_loop_however_many_clients_ask() -> None:
    clock = Clock()
    budgets = ClientBudgets(now=clock)
    clients = [str(number) for number in range(6)]
    for client in clients:
        assert budgets.may_look(client)
        budgets.note_look(client, SLOW, vain=True)
    spent = 0.0
    for turn in range(40_000):
        clock.t += 1e-3
        client = clients[turn % len(clients)]
        if budgets.may_look(client):
            spent += SLOW
            budgets.note_look(client, SLOW, vain=True)
    assert 0.9 * LOOK_SHARE * 40.0 < spent <= LOOK_SHARE * 40.0 + len(clients) * SLOW


def test_others_are_always_looked_at() -> None:
    budgets = ClientBudgets(now=lambda: 0.0)
    while budgets.may_look("attacker"):
        budgets.note_look("attacker", SLOW, vain=True)
    assert budgets.may_look("other")


def test_who_asks_in_vain_now_and_then_is_looked_at_beside_those_who_always_do() -> None:
    clock = Clock()
    budgets = ClientBudgets(now=clock)
    refused = 0
    for turn in range(20_000):
        clock.t += 1e-3
        for attacker in "abcdef":
            if budgets.may_look(attacker):
                budgets.note_look(attacker, SLOW, vain=True)
        refused += not budgets.may_look("other")
        if turn % 100 == 0:  # ten times a second
            budgets.note_look("other", USUAL, vain=True)
    assert refused == 0


def test_a_quick_look_that_finds_a_plan_costs_nothing_and_pays_for_none_in_vain() -> None:
    budgets = ClientBudgets(now=lambda: 0.0)
    for _ in range(1000):
        assert budgets.may_look("a")
        budgets.note_look("a", USUAL, vain=False)
    budgets.note_look("a", SLOW, vain=True)
    budgets.note_look("a", USUAL, vain=False)
    assert not budgets.may_look("a")


def test_a_long_look_counts_though_it_finds_a_plan() -> None:
    budgets = ClientBudgets(now=lambda: 0.0)
    budgets.note_look("a", SLOW, vain=False)
    assert not budgets.may_look("a")


def test_a_look_that_was_interrupted_costs_no_more_than_others() -> None:
    clock = Clock()
    budgets = ClientBudgets(now=clock)
    budgets.note_look("a", 10.0, vain=False)
    clock.t += 0.01
    assert budgets.may_look("a")


def test_some_looks_are_saved_up_but_not_many() -> None:
    clock = Clock()
    budgets = ClientBudgets(now=clock)
    budgets.note_look("a", 0.0, vain=True)
    clock.t += 0.9 * KEPT
    spent = 0.0
    while budgets.may_look("a"):
        budgets.note_look("a", USUAL, vain=True)
        spent += USUAL
    assert LOOK_SAVED - USUAL < spent < LOOK_SAVED + USUAL


def test_a_look_in_vain_is_forgotten_after_a_while() -> None:
    clock = Clock()
    budgets = ClientBudgets(now=clock)
    for _ in range(1000):
        budgets.note_look("a", SLOW, vain=True)
    clock.t += 0.9 * KEPT
    assert not budgets.may_look("a")
    clock.t += 0.2 * KEPT
    assert budgets.may_look("a")
