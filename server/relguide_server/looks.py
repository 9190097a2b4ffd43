"""Looks: who may have situations looked at on the event loop, where each keeps everybody waiting.

Most situations are planned there in 0.1 ms. Where a search is needed the look was in vain, and it
may have taken 3 ms, which a client that leaves at once does not even wait for. So those whose last
look was in vain share a small part of the loop: their looks are allowed while there is something of
it left, and what they ask for otherwise goes to a worker unseen. All others are always looked at.
"""

from collections.abc import Callable
from time import monotonic

from relguide.units import Second
from relguide_server.lately import Lately

SHARE = 0.1
"""Of the event loop, for looks of those whose last one was in vain."""
SAVED: Second = 0.01
"""Most of it that is saved up while none of them asks."""


class Looks:
    """Clients whose last look was in vain, and what is left for them. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._now = now
        self._vain = Lately(now)
        self._left, self._at = SAVED, now()

    def may(self, client: str) -> bool:
        """Whether a situation of a client may be looked at now."""
        if client not in self._vain:
            return True
        now = self._now()
        self._left = min(self._left + SHARE * (now - self._at), SAVED)
        self._at = now
        return self._left > 0.0

    def note(self, client: str, spent: Second, *, vain: bool) -> None:
        """That a situation of a client was looked at.

        Args:
            client: whose.
            spent: how long that held up the loop [s].
            vain: whether a worker has to plan it.
        """
        if client in self._vain:
            self._left -= spent
        if vain:
            self._vain.note(client)
        else:
            self._vain.forget(client)
