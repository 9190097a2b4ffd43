"""How much of what all clients share each may take, by what its situations cost before.

Most situations are planned on the event loop in 0.1 ms. Where a search is needed that look is in
vain, and behind a leader with many turns it takes 3 ms, which keeps everybody waiting. So looks
that are in vain or long cost tokens, of which all get a small part of the loop's time; without
tokens a client is not looked at, and what it asks for goes to a worker unseen.

One worker is kept for plans that take some hundredths of a second. A client of which nothing is
known is tried there for a little time. Quick plans earn it more; a plan that takes long costs all
of it, so that those who ask for such keep others waiting for a few trials, and no more.
"""

from collections.abc import Callable
from time import monotonic

from relguide.units import Second
from relguide_server.planning.tasks import PlanReply
from relguide_server.shares.token_buckets import TokenBuckets

LOOK_SHARE = 0.03
"""Of the event loop, for looks that are in vain or long."""
LONG_LOOK: Second = 1e-3
"""What takes longer is long."""
LOOK_SAVED: Second = 0.003
"""Most that a client saves up while it does not ask: a look that takes long."""
SHORT: Second = 0.04
"""What the kept worker has not planned in this time waits for those who plan what takes long, and
is begun anew: so those who ask for it wait for each other, and nobody else for them."""
TRIAL: Second = 0.015
"""The same for a client that is not known for quick plans."""
ENOUGH = 3
"""So many plans that did not take long make a client known for such."""
AT_WORK = 0.75
"""What was at work for this share of its time, and was cut short, takes long; what waited for a
processor does not by that."""


class ClientBudgets:
    """What each client may still take. Lives on the event loop."""

    def __init__(self, now: Callable[[], Second] = monotonic) -> None:
        self._looks = TokenBuckets(LOOK_SAVED, rate=LOOK_SHARE, now=now)
        self._trials = TokenBuckets(TRIAL, now=now)

    def may_look(self, client: str) -> bool:
        """Whether a situation of a client may be looked at on the event loop now."""
        return self._looks.left(client) > 0.0

    def note_look(self, client: str, spent: Second, *, vain: bool) -> None:
        """That a situation of a client was looked at.

        Args:
            client: whose.
            spent: how long that held up the loop [s].
            vain: whether a worker has to plan it.
        """
        if vain or spent > LONG_LOOK:
            self._looks.take(client, min(spent, LOOK_SAVED))  # it was interrupted if it took longer

    def time_for(self, client: str) -> Second:
        """How long a plan of a client may be tried by the kept worker; 0 if it may not."""
        left = self._trials.left(client)
        if left < TRIAL:
            return 0.0
        return SHORT if left > SHORT - 1e-6 else TRIAL  # rounding of what was earned

    def note_plan(self, client: str, short: Second, made: PlanReply) -> None:
        """What a worker made of a plan of a client, whether or not that has left.

        Args:
            client: whose.
            short: how long a plan of it may be tried [s].
            made: what was found.
        """
        if takes_long(made, short):
            self.note_impatient(client)
        elif not made.cut and (time := self.time_for(client)):
            earned = (SHORT - TRIAL) / ENOUGH if time < SHORT else 0.0
            self._trials.take(client, -earned)

    def note_impatient(self, client: str) -> None:
        """That a plan of a client takes long, or that it did not wait to see."""
        self._trials.take(client, self._trials.left(client))


def takes_long(made: PlanReply, short: Second) -> bool:
    """Whether a worker was at work on a plan for longer than a quick one takes."""
    return made.processor > AT_WORK * (short if made.cut else SHORT)
