"""Token buckets: how much of something scarce each client may still take."""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic

from relguide.units import Second

KEPT: Second = 5.0
"""A bucket that nothing was taken from for so long is full again."""
MOST = 1000
"""Most buckets that are kept."""


@dataclass(slots=True)
class _Bucket:
    tokens: float
    filled_at: Second
    used_at: Second


class TokenBuckets:
    """A bucket for each client that took some a moment ago; all others have a full one.

    Lives on the event loop.
    """

    def __init__(
        self, full: float, *, rate: float = 0.0, now: Callable[[], Second] = monotonic
    ) -> None:
        """Make them.

        Args:
            full: tokens of a full bucket.
            rate: tokens a second that all buckets get together, each as many.
            now: a clock.
        """
        self._full, self._rate, self._now = full, rate, now
        self._buckets: OrderedDict[str, _Bucket] = OrderedDict()
        """The one used last comes last."""

    def left(self, client: str) -> float:
        """How many tokens a client has; negative if it took more than there were."""
        now = self._now()
        self._forget(now)
        bucket = self._buckets.get(client)
        if bucket is None:
            return self._full
        if bucket.tokens < self._full:
            gained = self._rate / len(self._buckets) * (now - bucket.filled_at)
            bucket.tokens = min(bucket.tokens + gained, self._full)
        bucket.filled_at = now
        return bucket.tokens

    def take(self, client: str, tokens: float) -> None:
        """Let a client take some; fewer than none are put in, above what a full one has."""
        left, now = self.left(client) - tokens, self._now()
        self._buckets[client] = _Bucket(left, now, now)
        self._buckets.move_to_end(client)
        if len(self._buckets) > MOST:
            self._buckets.popitem(last=False)

    def _forget(self, now: Second) -> None:
        while self._buckets:
            oldest = next(iter(self._buckets))
            if now - self._buckets[oldest].used_at < KEPT:
                return
            del self._buckets[oldest]
