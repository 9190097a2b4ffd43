"""Who did something lately, and what is known of it."""

from relguide_server.jobs.ttl_cache import LATELY, REMEMBERED, TtlCache


def test_what_a_client_did_is_remembered_for_a_while() -> None:
    now = 100.0
    lately: TtlCache[str] = TtlCache(now=lambda: now)
    assert lately.get("a") is None
    lately.note("a", "first")
    assert lately.get("a") == "first"
    assert lately.get("b") is None
    now += 0.9 * LATELY
    lately.note("a", "second")
    now += 0.9 * LATELY
    assert lately.get("a") == "second"
    now += 0.2 * LATELY
    assert lately.get("a") is None


def test_of_many_clients_the_latest_are_remembered() -> None:
    lately: TtlCache[int] = TtlCache(now=lambda: 0.0)
    for number in range(REMEMBERED + 5):
        lately.note(str(number), number)
        lately.note("0", 0)
    assert lately.get("0") == 0
    assert lately.get("1") is None
    assert lately.get(str(REMEMBERED + 4)) == REMEMBERED + 4
    assert len(lately) == REMEMBERED


def test_those_are_counted_who_did_it_lately() -> None:
    now = 100.0
    lately: TtlCache[int] = TtlCache(now=lambda: now)
    lately.note("a", 0)
    now += 0.6 * LATELY
    lately.note("b", 0)
    assert len(lately) == 2
    now += 0.6 * LATELY
    assert len(lately) == 1
