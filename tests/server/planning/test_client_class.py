"""What is known of clients by how long their plans took."""

import pytest
from relguide_server.jobs.ttl_cache import LATELY
from relguide_server.planning.client_class import ENOUGH, SHORT, TRIAL, ClientClass
from relguide_server.planning.tasks import PlanReply


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
    standing = ClientClass(now=lambda: 0.0)
    assert standing.time_for("a") == TRIAL
    standing.note("a", TRIAL, answered)
    assert standing.time_for("a") == time
    assert standing.time_for("b") == TRIAL


def test_who_is_known_for_quick_plans_has_more_time_to_show_that_one_is() -> None:
    standing = ClientClass(now=lambda: 0.0)
    for _ in range(ENOUGH):
        assert standing.time_for("a") == TRIAL
        standing.note("a", TRIAL, made(0.005))
    standing.note("a", SHORT, made(0.9 * TRIAL, cut=True))
    assert standing.time_for("a") == SHORT
    standing.note("a", SHORT, made(0.9 * SHORT, cut=True))
    assert standing.time_for("a") == 0.0


def test_a_quick_plan_does_not_make_good_what_took_long() -> None:
    now = 100.0
    standing = ClientClass(now=lambda: now)
    standing.note_impatient("a")
    standing.note("a", SHORT, made(0.001))
    assert standing.time_for("a") == 0.0
    now += 1.1 * LATELY
    assert standing.time_for("a") == TRIAL
