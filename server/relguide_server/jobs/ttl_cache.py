"""What is known of clients by what they did a moment ago, and forgotten some seconds later."""

from collections import OrderedDict
from collections.abc import Callable
from time import monotonic
from typing import Generic, TypeVar

from relguide.units import Second

T = TypeVar("T")
LATELY: Second = 5.0
"""For so long a client is remembered."""
REMEMBERED = 1000
"""Most clients that are."""


class TtlCache(Generic[T]):
    """What clients did, and when each did it last. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._now = now
        self._last: OrderedDict[str, tuple[Second, T]] = OrderedDict()

    def note(self, client: str, known: T) -> None:
        """That a client does it now.

        Args:
            client: who.
            known: what is known of it by that, in place of what was known.
        """
        self._last[client] = self._now(), known
        self._last.move_to_end(client)
        if len(self._last) > REMEMBERED:
            self._last.popitem(last=False)

    def get(self, client: str) -> T | None:
        """What is known of a client; `None` if it did nothing lately."""
        at, known = self._last.get(client, (None, None))
        return None if at is None or self._now() - at >= LATELY else known

    def __len__(self) -> int:
        """How many clients did it lately."""
        now = self._now()
        while self._last and now - next(iter(self._last.values()))[0] >= LATELY:
            self._last.popitem(last=False)
        return len(self._last)
