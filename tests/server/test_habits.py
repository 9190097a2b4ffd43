"""Who asked for plans that take long lately."""

from relguide_server.habits import LATELY, REMEMBERED, Habits


def test_a_client_is_remembered_for_a_while() -> None:
    now = 100.0
    habits = Habits(now=lambda: now)
    assert not habits.asks_long("a")
    habits.note_long("a")
    assert habits.asks_long("a")
    assert not habits.asks_long("b")
    now += 0.9 * LATELY
    assert habits.asks_long("a")
    habits.note_long("a")
    now += 0.9 * LATELY
    assert habits.asks_long("a")
    now += 0.2 * LATELY
    assert not habits.asks_long("a")


def test_of_many_clients_the_latest_are_remembered() -> None:
    habits = Habits(now=lambda: 0.0)
    for number in range(REMEMBERED + 5):
        habits.note_long(str(number))
        habits.note_long("0")
    assert habits.asks_long("0")
    assert not habits.asks_long("1")
    assert habits.asks_long(str(REMEMBERED + 4))
