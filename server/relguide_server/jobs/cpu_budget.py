"""Looks: who may have situations looked at on the event loop, where each keeps everybody waiting.

Most situations are planned there in 0.1 ms. Where a search is needed the look is in vain, and
behind a leader with many turns it takes 3 ms, which a client that leaves at once does not even wait
for. Those whose looks were in vain or long lately share a small part of the loop for such looks,
all alike: who has used up its part gets no looks for a while, and what it asks for goes to a worker
unseen. All others are always looked at.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic

from relguide.units import Second
from relguide_server.jobs.ttl_cache import TtlCache

SHARE = 0.03
"""Of the event loop, for looks that are in vain or long."""
LONG: Second = 1e-3
"""What takes longer is long."""
SAVED: Second = 0.003
"""Most of its part that a client saves up while it does not ask: a look that takes long."""


@dataclass(slots=True)
class _Purse:
    left: Second
    """What a client has left; negative if it took more."""
    at: Second


class CpuBudget:
    """Clients whose looks cost much, and what each has left. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._now = now
        self._costly: TtlCache[_Purse] = TtlCache(now)

    def may(self, client: str) -> bool:
        """Whether a situation of a client may be looked at now."""
        purse = self._costly.get(client)
        if purse is None:
            return True
        now = self._now()
        purse.left = min(purse.left + SHARE / len(self._costly) * (now - purse.at), SAVED)
        purse.at = now
        return purse.left > 0.0

    def note(self, client: str, spent: Second, *, vain: bool) -> None:
        """That a situation of a client was looked at.

        Args:
            client: whose.
            spent: how long that held up the loop [s].
            vain: whether a worker has to plan it.
        """
        if not vain and spent <= LONG:
            return
        purse = self._costly.get(client) or _Purse(SAVED, self._now())
        purse.left -= min(spent, SAVED)  # it was interrupted if it took longer
        self._costly.note(client, purse)
