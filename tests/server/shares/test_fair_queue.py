"""Clients take turns, and none takes all the room."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from relguide_server.shares.fair_queue import FairQueue


def test_clients_take_turns() -> None:
    waiting = FairQueue[str](room=9)
    for job in ("a1", "a2", "a3", "b1", "c1", "b2"):
        waiting.put(job, client=job[0])
    assert [waiting.take() for _ in range(len(waiting))] == ["a1", "b1", "c1", "a2", "b2", "a3"]
    with pytest.raises(KeyError):
        waiting.take()


def test_one_client_has_half_of_the_room() -> None:
    waiting = FairQueue[int](room=4)
    for job in range(2):
        assert waiting.has_room("greedy")
        waiting.put(job, "greedy")
    assert not waiting.has_room("greedy")
    for job in range(2):
        assert waiting.has_room(f"client {job}")
        waiting.put(job, f"client {job}")
    assert not waiting.has_room("late")


def test_a_job_that_leaves_waits_no_longer() -> None:
    waiting = FairQueue[int](room=4)
    waiting.put(1, "a")
    waiting.put(2, "a")
    waiting.drop(1, "a")
    waiting.drop(1, "a")
    waiting.drop(2, "b")
    assert len(waiting) == 1
    assert waiting.take() == 2
    waiting.drop(2, "a")
    assert len(waiting) == 0


@given(st.lists(st.tuples(st.sampled_from("abc"), st.booleans())))
def test_each_job_is_taken_once_and_those_of_a_client_in_order(steps) -> None:
    waiting = FairQueue[tuple[str, int]](room=1000)
    taken, number = [], 0
    for client, puts in steps:
        if puts:
            number += 1
            waiting.put((client, number), client)
        elif len(waiting):
            taken.append(waiting.take())
    taken += [waiting.take() for _ in range(len(waiting))]
    assert len(taken) == len(set(taken)) == number
    for client in "abc":
        own = [job for job in taken if job[0] == client]
        assert own == sorted(own)
