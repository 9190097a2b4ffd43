"""All feeds of a service: listened to from `start` to `stop`, reported on and counted."""

import asyncio
import logging
from collections.abc import Callable, Coroutine, Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric

from relguide.planning.extras import need
from relguide.planning.frames import LocalPlane
from relguide.units import Second
from relguide_server.atc.feeds.asterix_feed import listen_to_asterix
from relguide_server.atc.feeds.feed_state import FeedState, clock
from relguide_server.atc.feeds.readsb_feed import poll_readsb
from relguide_server.atc.feeds.replay_feed import play
from relguide_server.atc.reports import Reports
from relguide_server.feed_settings import AsterixFeed, FeedSetting, ReadsbFeed, ReplayFeed

AGAIN: Second = 10.0
"""How long until a feed that could not be opened is tried again."""
COUNTS = {
    "messages": "Datagrams, answers or seconds of a recording that came.",
    "taken": "Reports that were put into the picture.",
    "malformed": "Messages that could not be read.",
    "unusable": "Reports without a place, a time, a velocity and a name that can be.",
    "untimely": "Reports of more than a minute ago, or of later than now.",
    "lost": "Messages that came faster than they could be read.",
}
log = logging.getLogger("relguide.feeds")


@dataclass(frozen=True, slots=True)
class _Feed:
    state: FeedState
    listen: Callable[[], Coroutine[Any, Any, None]]


class Feeds:
    """All feeds. Lives on the event loop, from `start` to `stop`."""

    def __init__(self, settings: tuple[FeedSetting, ...], reports: Reports) -> None:
        """Take feeds as they are set.

        Raises:
            MissingExtra: if one needs a package that is not installed.
        """
        if any(isinstance(one, AsterixFeed) for one in settings):
            need("asterix")
        self._feeds = [_feed(one, FeedState(address=one.address, reports=reports))
                       for one in settings]  # fmt: skip
        self._tasks: list[asyncio.Task[None]] = []

    def start(self) -> None:
        """Listen to all of them."""
        self._tasks = [asyncio.create_task(_keep(feed)) for feed in self._feeds]

    async def stop(self) -> None:
        """Listen to none of them any more."""
        for task in self._tasks:
            task.cancel()
        for task in self._tasks:
            with suppress(asyncio.CancelledError):
                await task

    def report(self) -> list[dict[str, Any]]:
        """How each stands, for `/readyz`."""
        now = clock()
        return [
            {
                "feed": feed.state.address,
                "state": feed.state.stands(now),
                "message": feed.state.message(now),
                **{name: getattr(feed.state, name) for name in COUNTS},
            }
            for feed in self._feeds
        ]

    def measure(self) -> Iterator[Metric]:
        """Their counts, and whether each is heard."""
        if not self._feeds:
            return
        now = clock()
        heard = GaugeMetricFamily(
            "relguide_feed_heard", "Whether a feed is heard: 1, or 0.", labels=["feed"]
        )
        for feed in self._feeds:
            heard.add_metric([feed.state.address], feed.state.stands(now) == "hears")
        yield heard
        for name, text in COUNTS.items():
            family = CounterMetricFamily(f"relguide_feed_{name}", text, labels=["feed"])
            for feed in self._feeds:
                family.add_metric([feed.state.address], getattr(feed.state, name))
            yield family


def _feed(setting: FeedSetting, state: FeedState) -> _Feed:
    match setting:
        case AsterixFeed(host=host, port=port):
            return _Feed(state, lambda: listen_to_asterix(host, port, state))
        case ReadsbFeed(where=where):
            return _Feed(state, lambda: poll_readsb(where, state))
        case ReplayFeed(file=file, place=place):
            plane = None if place is None else LocalPlane(*place)
            return _Feed(state, lambda: play(file, plane, state))


async def _keep(feed: _Feed) -> None:
    """Listen to a feed; one that cannot be opened is tried again and again."""
    while True:
        try:
            await feed.listen()
        except OSError as error:
            feed.state.fault = f"It cannot be opened: {error}."
            log.warning("%s cannot be opened: %s", feed.state.address, error)
            await asyncio.sleep(AGAIN)
        else:
            log.info("%s: %s", feed.state.address, feed.state.message(clock()))
            return
