"""The connections that are served, a share of them for each client, and room for one more.

Where all are taken, one that is idle makes room: of the client that has most of them, that on which
nothing was asked for longest. So no number of idle connections keeps anybody out. A client that
leaves again and again before it is answered is not let in for a while.
"""

from collections.abc import Callable, Iterator
from time import monotonic
from typing import Protocol

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric

from relguide.units import Second
from relguide_server.http.logs import SeldomLine
from relguide_server.shares.clients import client_at
from relguide_server.shares.token_buckets import TokenBuckets

TOLD = 64
"""So many connections beyond those that are served are told so."""
TOO_MANY = "This server has {most} connections, the most it serves: try again in a moment."
TOO_MANY_OF_YOURS = "You have {most} connections already, the most of a client's: close some."
HANG_UPS = 20.0
"""So often a client may leave before it is answered, and in each second all who do so together."""
BARRED = "%s leaves again and again before it is answered: its new connections are closed."


class Guest(Protocol):
    """A connection that has a place."""

    whose: str
    """The client's."""

    @property
    def idle_since(self) -> Second | None:
        """Since when nothing is asked on it, by the loop's clock; `None` while it is answered."""
        ...

    def shed(self) -> None:
        """End it, to make room."""
        ...


class ConnectionShares:
    """Who has which places. Lives on the event loop."""

    def __init__(
        self, most: int, proxies: Callable[[str], bool], now: Callable[[], Second] = monotonic
    ) -> None:
        """Open them.

        Args:
            most: connections served at once; one client has half of them at most.
            proxies: says of an address whether it speaks for many clients, and may have all.
            now: a clock.
        """
        self.most, self._share = most, max(most // 2, 1)
        self._proxies = proxies
        self._guests: dict[str, dict[Guest, None]] = {}
        self._count = 0
        self._told: set[Guest] = set()
        self._kept: set[Guest] = set()
        self._patience = TokenBuckets(HANG_UPS, rate=HANG_UPS, now=now)
        self._barred = SeldomLine(now)
        self.refused = {"share": 0, "full": 0, "hang_ups": 0}
        """Connections that were not let in, by what was exhausted."""
        self.shed = self.hang_ups = self.cut_off = 0

    def is_open_to(self, host: str) -> bool:
        """Whether a new connection from an address is to be heard at all."""
        client = client_at(host)
        if self._proxies(host):
            return True
        if self._patience.left(client) <= 0.0:
            self._lose_patience(client)
            self.refused["hang_ups"] += 1
            self._barred.write(BARRED, client)
            return False
        if len(self._told) >= TOLD and self._has_its_share(client):
            self.refused["share"] += 1
            return False
        return True

    def enter(self, guest: Guest, host: str) -> str:
        """Give a connection a place.

        Returns:
            Why it gets none; empty if it has one.
        """
        many = self._proxies(host)
        if not many and self._has_its_share(guest.whose):
            self._told.add(guest)
            self.refused["share"] += 1
            return TOO_MANY_OF_YOURS.format(most=self._share)
        if self._count >= self.most and not self._make_room(guest.whose):
            self._told.add(guest)
            self.refused["full"] += 1
            return TOO_MANY.format(most=self.most)
        self._seat(guest)
        return ""

    def hand_over(self, guest: Guest, to: Guest) -> None:
        """Let a stream have the place of the connection that it was asked for on."""
        self.leave(guest)
        self._seat(to)

    def keep(self, guest: Guest) -> None:
        """Count a connection no longer, and never shed it: its flight's owner watches."""
        self.leave(guest)
        self._kept.add(guest)

    def leave(self, guest: Guest) -> None:
        """Free the place of a connection, if it has one."""
        self._told.discard(guest)
        self._kept.discard(guest)
        guests = self._guests.get(guest.whose, {})
        if guest in guests:
            del guests[guest]
            self._count -= 1
            if not guests:
                del self._guests[guest.whose]

    def note_hang_up(self, host: str) -> None:
        """That a client left before it was answered."""
        self.hang_ups += 1
        if not self._proxies(host):
            self._lose_patience(client_at(host))

    def note_flood(self, host: str) -> None:
        """That a client was cut off for how much it sent: it is not heard for a while."""
        self.cut_off += 1
        if not self._proxies(host):
            self._lose_patience(client_at(host), 2.0 * HANG_UPS)

    def measure(self) -> Iterator[Metric]:
        """What is counted here, for Prometheus."""
        yield GaugeMetricFamily(
            "relguide_connections", "Connections open.", self._count + len(self._kept)
        )
        refused = CounterMetricFamily(
            "relguide_connections_refused", "Connections refused.", labels=["exhausted"]
        )
        for what, count in self.refused.items():
            refused.add_metric([what], count)
        yield refused
        yield CounterMetricFamily(
            "relguide_connections_shed", "Idle connections ended to make room.", self.shed
        )
        yield CounterMetricFamily(
            "relguide_sockets_cut_off", "WebSockets cut off for how much they sent.", self.cut_off
        )
        yield CounterMetricFamily(
            "relguide_hang_ups", "Connections left before they were answered.", self.hang_ups
        )

    def _lose_patience(self, client: str, times: float = 1.0) -> None:
        """Count some more that were in vain, but no more than are forgiven within a second."""
        self._patience.take(client, min(times, HANG_UPS + self._patience.left(client)))

    def _has_its_share(self, client: str) -> bool:
        return len(self._guests.get(client, ())) >= self._share

    def _seat(self, guest: Guest) -> None:
        self._guests.setdefault(guest.whose, {})[guest] = None
        self._count += 1

    def _make_room(self, client: str) -> bool:
        """End the idlest connection of who has most of them, but of nobody who has fewer."""
        own = len(self._guests.get(client, ()))
        for guests in sorted(self._guests.values(), key=len, reverse=True):
            if len(guests) <= own:
                return False
            idle = [(since, guest) for guest in guests if (since := guest.idle_since) is not None]
            if idle:
                _, idlest = min(idle, key=lambda one: one[0])
                self.leave(idlest)
                idlest.shed()
                self.shed += 1
                return True
        return False
