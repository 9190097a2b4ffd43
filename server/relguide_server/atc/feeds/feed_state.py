"""What is known of a feed: how much came, how much of it could be used, and when the last."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf, isfinite
from time import time
from typing import Literal

from relguide.atc.reported import Reported
from relguide.contract.traffic_bodies import AHEAD, CLIMB, FASTEST, OLDEST
from relguide.planning.aircraft import LONGEST_IDENT
from relguide.units import Metre, Second
from relguide_server.atc.reports import Reports, Source

SILENT_AFTER: Second = 10.0
"""A feed from which nothing usable came for so long is silent."""
LOWEST: Metre = -1_500.0
"""Pressure altitudes that aircraft report lie above this …"""
HIGHEST: Metre = 40_000.0
"""… and below this."""
Standing = Literal["hears", "silent", "over"]


@dataclass(slots=True, kw_only=True)
class FeedState:
    """A feed, its counts, and where its reports go. One thread at a time writes it."""

    address: str
    """As the setting names it."""
    reports: Reports
    messages: int = 0
    """Datagrams, or answers, or seconds of a recording."""
    taken: int = 0
    """Reports that are in the picture, or were."""
    malformed: int = 0
    """Messages that could not be read."""
    unusable: int = 0
    """Reports without a place, a time, a velocity and a name that can be."""
    untimely: int = 0
    """Reports of more than a minute ago, or of later than now: clocks differ."""
    lost: int = 0
    """Messages that came faster than they could be read."""
    heard_at: Second = -inf
    """When the last report was taken, UTC [s]."""
    fault: str = ""
    """What went wrong last, in a sentence; empty while nothing does."""
    over: bool = False
    """Whether it has nothing more to say: a recording that was played to its end."""

    @property
    def source(self) -> Source:
        """Who reports, as the picture names it."""
        return Source("", self.address, feed=True)

    def take(self, found: Iterable[Reported], now: Second) -> None:
        """Put reports into the picture, if they are of now.

        Args:
            found: reports of a message.
            now: UTC [s].
        """
        for one in found:
            if not _can_be(one):
                self.unusable += 1
            elif not now - OLDEST <= one.t <= now + AHEAD:
                self.untimely += 1
                self.fault = f"{one.ident} was reported for {abs(one.t - now):.0f} s " + (
                    "from now: clocks differ." if one.t > now else "ago: that is forgotten."
                )
            elif self.reports.hear(self.source, one):
                self.taken += 1
                self.heard_at = now
                self.fault = ""

    def stands(self, now: Second) -> Standing:
        """Whether it is heard.

        Args:
            now: UTC [s].
        """
        if self.over:
            return "over"
        return "hears" if now - self.heard_at <= SILENT_AFTER else "silent"

    def message(self, now: Second) -> str:
        """How it stands, in a sentence.

        Args:
            now: UTC [s].
        """
        match self.stands(now):
            case "over":
                return self.fault or "It was played to its end."
            case "hears":
                return self.fault or "It is heard."
            case "silent":
                never = self.heard_at == -inf
                said = "Nothing usable has come of it yet." if never else (
                    f"Nothing usable has come of it for {now - self.heard_at:.0f} s."
                )  # fmt: skip
                return f"{said} {self.fault}".strip()


def _can_be(one: Reported) -> bool:
    """Whether an aircraft can be there, and so fast; what is no number is refused as well."""
    return (
        -90.0 <= one.lat_deg <= 90.0
        and -180.0 <= one.lon_deg <= 180.0
        and FASTEST.admits(one.ground_speed)
        and CLIMB.admits(one.climb)
        and isfinite(one.track)
        and isfinite(one.t)
        and (one.altitude is None or LOWEST <= one.altitude <= HIGHEST)
        and one.ident.isprintable()
        and 0 < len(one.ident) <= LONGEST_IDENT
    )


def clock() -> Second:
    """UTC now [s]."""
    return time()
