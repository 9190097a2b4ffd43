"""Who did something lately."""

from relguide_server.lately import LATELY, REMEMBERED, Lately


def test_a_client_is_remembered_for_a_while() -> None:
    now = 100.0
    lately = Lately(now=lambda: now)
    assert "a" not in lately
    lately.note("a")
    assert "a" in lately
    assert "b" not in lately
    now += 0.9 * LATELY
    assert "a" in lately
    lately.note("a")
    now += 0.9 * LATELY
    assert "a" in lately
    now += 0.2 * LATELY
    assert "a" not in lately


def test_of_many_clients_the_latest_are_remembered() -> None:
    lately = Lately(now=lambda: 0.0)
    for number in range(REMEMBERED + 5):
        lately.note(str(number))
        lately.note("0")
    assert "0" in lately
    assert "1" not in lately
    assert str(REMEMBERED + 4) in lately


def test_who_is_forgotten_did_nothing_lately() -> None:
    lately = Lately(now=lambda: 0.0)
    lately.note("a")
    lately.forget("a")
    lately.forget("b")
    assert "a" not in lately
