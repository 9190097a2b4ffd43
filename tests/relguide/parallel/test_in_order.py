"""Chunks are done in their order, and what a lost worker had is done again."""

from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from typing import Any, NamedTuple

import pytest

from relguide.learn.training.chunks import ATTEMPTS
from relguide.parallel.in_order import in_order


class Numbered(NamedTuple):
    """A chunk that is its number."""

    number: int

    @property
    def name(self) -> str:
        return f"The lines from {self.number} on"


def double(chunk: Numbered) -> int:
    return 2 * chunk.number


class Losing(Executor):
    """Loses each chunk some times before it answers."""

    def __init__(self, error: Exception, times: int) -> None:
        self.error, self.times = error, times
        self.sent: list[Numbered] = []

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        (chunk,) = args
        self.sent.append(chunk)
        future: Future[Any] = Future()
        if self.sent.count(chunk) <= self.times:
            future.set_exception(self.error)
        else:
            future.set_result(fn(chunk))
        return future


CHUNKS = [Numbered(n) for n in range(1, 5)]


def test_what_a_lost_worker_had_is_sent_again() -> None:
    losing = Losing(OSError("gone"), ATTEMPTS - 1)
    found = [made for _, made in in_order(double, CHUNKS, losing, 1)]
    assert found == [2, 4, 6, 8]
    assert len(losing.sent) == 4 * ATTEMPTS
    with pytest.raises(OSError, match="The lines from 1 on were lost 5 times, at last by: gone"):
        list(in_order(double, CHUNKS, Losing(OSError("gone"), ATTEMPTS), 1))


def test_a_process_that_is_ended_from_outside_is_named() -> None:
    with pytest.raises(ValueError, match="A worker process was ended from outside"):
        list(in_order(double, CHUNKS, Losing(BrokenProcessPool("x"), 1), 2))


def test_no_more_is_under_way_than_memory_has_room_for() -> None:
    class Waiting(Losing):
        most = 0
        out = 0

        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            self.out += 1
            self.most = max(self.most, self.out)
            return super().submit(fn, *args, **kwargs)

    waiting = Waiting(OSError(), 0)
    for _ in in_order(double, map(Numbered, range(1000)), waiting, 2):
        waiting.out -= 1
    assert waiting.most <= 9
