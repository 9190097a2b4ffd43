"""Token buckets: what is taken is missing, comes back, and is forgotten."""

import pytest
from relguide_server.shares.token_buckets import KEPT, MOST, TokenBuckets


class Clock:
    """Time that passes when it is told to [s]."""

    t = 100.0

    def __call__(self) -> float:
        return self.t


def test_what_is_taken_is_missing_and_comes_back() -> None:
    clock = Clock()
    buckets = TokenBuckets(3.0, rate=1.0, now=clock)
    assert buckets.left("a") == 3.0
    buckets.take("a", 5.0)
    assert buckets.left("a") == -2.0
    assert buckets.left("b") == 3.0
    clock.t += 4.0
    assert buckets.left("a") == pytest.approx(2.0)
    clock.t += 0.9
    assert buckets.left("a") == pytest.approx(2.9)


def test_what_comes_back_is_shared() -> None:
    clock = Clock()
    buckets = TokenBuckets(3.0, rate=1.0, now=clock)
    for client in "ab":
        buckets.take(client, 3.0)
    clock.t += 2.0
    assert [buckets.left(client) for client in "ab"] == pytest.approx([1.0, 1.0])


def test_a_bucket_is_never_more_than_full_but_by_what_is_put_in() -> None:
    clock = Clock()
    buckets = TokenBuckets(3.0, rate=1.0, now=clock)
    buckets.take("a", 0.5)
    clock.t += 4.0
    assert buckets.left("a") == 3.0
    buckets.take("a", -1.0)
    clock.t += 4.0
    assert buckets.left("a") == 4.0


def test_an_unused_bucket_is_full_again_after_a_while() -> None:
    clock = Clock()
    buckets = TokenBuckets(3.0, now=clock)
    buckets.take("a", 3.0)
    clock.t += 0.9 * KEPT
    assert buckets.left("a") == 0.0
    clock.t += 0.2 * KEPT
    assert buckets.left("a") == 3.0


def test_of_too_many_the_one_unused_for_longest_is_forgotten() -> None:
    buckets = TokenBuckets(3.0, now=lambda: 0.0)
    for number in range(MOST + 5):
        buckets.take(str(number), 1.0)
        buckets.take("0", 0.0)
    assert [buckets.left(name) for name in ("0", "1", str(MOST + 4))] == [2.0, 3.0, 2.0]
