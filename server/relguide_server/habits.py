"""Habits: which clients asked lately for plans that take long.

How long a plan takes is known once it is planned. Each is therefore first given a short time by the
worker that is kept for quick ones, which is lost where that does not do. A client whose plans did
not come to their end in it is taken to ask for more of them, and for a while none of its plans is
tried there. It loses nothing while nobody else asks for what takes long.
"""

from collections import OrderedDict
from collections.abc import Callable
from time import monotonic

from relguide.units import Second

LATELY: Second = 5.0
"""For so long a client is remembered."""
REMEMBERED = 1000
"""Most clients that are."""


class Habits:
    """Clients, and when each last asked for what takes long. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._now = now
        self._last: OrderedDict[str, Second] = OrderedDict()

    def note_long(self, client: str) -> None:
        """That a plan of a client took long, or that it did not wait for its end."""
        self._last[client] = self._now()
        self._last.move_to_end(client)
        if len(self._last) > REMEMBERED:
            self._last.popitem(last=False)

    def asks_long(self, client: str) -> bool:
        """Whether one did lately."""
        last = self._last.get(client)
        return last is not None and self._now() - last < LATELY
