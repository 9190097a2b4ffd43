"""Standing: what is known of clients by how long their plans took lately.

One worker is kept for plans that take some hundredths of a second. A client that is known for such
has all of its plans tried there; one whose plan took long has none tried for a while, and of one
that is not known yet a little time tells which it is. So those who come to ask for what takes long
keep others waiting for a few such trials, and after that not at all.
"""

from collections.abc import Callable
from time import monotonic

from relguide.units import Second
from relguide_server.jobs.ttl_cache import TtlCache
from relguide_server.planning.tasks import PlanReply

SHORT: Second = 0.04
"""What a worker has not planned in this time waits for those who plan what takes long, and is begun
anew: so those who ask for it wait for each other, and nobody else for them."""
TRIAL: Second = 0.015
"""The same for a client that is not known for quick plans."""
ENOUGH = 3
"""So many plans that did not take long make a client known for such."""
AT_WORK = 0.75
"""What was at work for this share of its time, and was cut short, takes long; what waited for a
processor does not by that."""


class ClientClass:
    """Whether plans of clients took long lately. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._quick: TtlCache[int] = TtlCache(now)
        """How many quick plans of each were made; 0 since one took long."""

    def time_for(self, client: str) -> Second:
        """How long a plan of a client may be tried among the quick ones; 0 if it may not."""
        quick = self._quick.get(client)
        if quick == 0:
            return 0.0
        return TRIAL if quick is None or quick < ENOUGH else SHORT

    def note(self, client: str, short: Second, answered: PlanReply) -> None:
        """What a worker made of a plan of a client, whether or not that has left.

        Args:
            client: whose.
            short: how long a plan of it may be tried [s].
            answered: what was found.
        """
        if takes_long(answered, short):
            self._quick.note(client, 0)
        elif not answered.cut:
            quick = self._quick.get(client)
            if quick != 0:
                self._quick.note(client, 1 + (quick or 0))

    def note_impatient(self, client: str) -> None:
        """That a client left while its plan was among those that take long."""
        self._quick.note(client, 0)


def takes_long(answered: PlanReply, short: Second) -> bool:
    """Whether a worker was at work on a plan for longer than a quick one takes."""
    return answered.processor > AT_WORK * (short if answered.cut else SHORT)
