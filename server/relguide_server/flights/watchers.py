"""Who watches a flight: a share of its watchers for each client, and always room for its owner."""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from fastapi import WebSocket

from relguide_server.doors.sockets import KEEP
from relguide_server.http.proxy import believed
from relguide_server.shares.clients import client_of

FULL = "As many watch {what} as may: try again later."
YOURS = "You watch {what} {share} times, the most of one client: close one of them."


class TooManyWatch(Exception):
    """A watcher is one too many; its text says why."""


class Watchers:
    """Those of one flight's stream, or of its scene. Lives on the event loop."""

    def __init__(self, owner: str, what: str = "this flight") -> None:
        """None yet.

        Args:
            owner: the client that started the flight, whose streams are always let in.
            what: they watch.
        """
        self._owner, self._what = owner, what
        self._counts: Counter[str] = Counter()

    @contextmanager
    def joined_by(self, websocket: WebSocket) -> Iterator[None]:
        """Count a watcher in, until it leaves.

        Raises:
            TooManyWatch: if it is one too many.
        """
        client, settings = client_of(websocket.scope), websocket.app.state.settings
        self._admit(client, settings.max_watchers, many=believed(settings.proxies)(client))
        if client == self._owner and KEEP in websocket.scope.get("extensions", {}):
            websocket.scope["extensions"][KEEP]["keep"]()
        self._counts[client] += 1
        try:
            yield
        finally:
            self._counts[client] -= 1
            if not self._counts[client]:
                del self._counts[client]

    def _admit(self, client: str, most: int, *, many: bool) -> None:
        """Refuse one too many.

        Args:
            client: whose the watcher is.
            most: how many may watch, beside those of the owner.
            many: whether the client speaks for many.
        """
        share = min(max(most // 4, 2), most)
        if self._counts[client] < share and client == self._owner:
            return
        if self._counts[client] >= share and not many:
            raise TooManyWatch(YOURS.format(what=self._what, share=share))
        if self._counts.total() >= most:
            raise TooManyWatch(FULL.format(what=self._what))
