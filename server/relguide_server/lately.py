"""Lately: clients that did something a moment ago."""

from collections import OrderedDict
from collections.abc import Callable
from time import monotonic

from relguide.units import Second

LATELY: Second = 5.0
"""For so long a client is remembered."""
REMEMBERED = 1000
"""Most clients that are."""


class Lately:
    """Clients, and when each last did something. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._now = now
        self._last: OrderedDict[str, Second] = OrderedDict()

    def note(self, client: str) -> None:
        """That a client does it now."""
        self._last[client] = self._now()
        self._last.move_to_end(client)
        if len(self._last) > REMEMBERED:
            self._last.popitem(last=False)

    def forget(self, client: str) -> None:
        """That it does not count any more."""
        self._last.pop(client, None)

    def __contains__(self, client: str) -> bool:
        """Whether a client did it lately."""
        last = self._last.get(client)
        return last is not None and self._now() - last < LATELY
