"""The clock of the records: the time of day for people, and one that never jumps for waiting."""

import time
from collections.abc import Callable
from datetime import UTC, datetime

from relguide.units import Second

JUMP: Second = 3600.0
"""A clock that goes so much too fast or too slow has been set."""


class Clock:
    """Both times; a test may give its own."""

    def __init__(
        self,
        now: Callable[[], float] = time.time,
        elapsed: Callable[[], float] = time.monotonic,
    ) -> None:
        self.now, self.elapsed = now, elapsed
        self._offset = now() - elapsed()

    def steady(self) -> bool:
        """Whether the time of day has not been set since the start.

        Where it has, ages are not to be trusted: nothing is forgotten for its age until the next
        start.
        """
        return abs(self.now() - self.elapsed() - self._offset) < JUMP


def date(at: float) -> str:
    """A Unix time [s] as RFC 3339 has it."""
    text = datetime.fromtimestamp(at, UTC).isoformat(timespec="milliseconds")
    return text.replace("+00:00", "Z")
