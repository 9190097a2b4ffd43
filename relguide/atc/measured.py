"""What is measured of an aircraft, kind by kind: how far it is off, and the same in words."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, hypot, inf, sin
from typing import Literal

from relguide.atc.documents import DeviationKind, DeviationLevel
from relguide.atc.off_path import heights, off_path
from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import CLEARS, AtcSettings, Threshold
from relguide.atc.spacing import behind_leader
from relguide.atc.track import Track
from relguide.atc.turns import AwaitedTurn
from relguide.planning.phrases import distance
from relguide.units import FT, Metre, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """How far an aircraft is off in one kind."""

    subject: DeviationKind
    amount: float
    """≥ 0 [m] or [s]."""
    unit: Literal["m", "s"]
    threshold: Threshold
    message: str
    at_once: bool = False
    """Whether it is an alert, however large it is."""

    def level(self, before: DeviationLevel) -> DeviationLevel:
        """The level of it, after the one that it had before."""
        alert = self.threshold.alert * (CLEARS if before == "alert" else 1.0)
        caution = self.threshold.caution * (1.0 if before == "none" else CLEARS)
        if self.at_once or self.amount > alert:
            return "alert"
        return "caution" if self.amount > caution else "none"


def on_path(seen: Seen, path: Track, settings: AtcSettings) -> Iterator[Measured]:
    """Beside the path, and before or behind its time; while the path lasts."""
    if not path.begin <= seen.t <= path.end:
        return
    across, along = off_path(path, seen.t, seen.x, seen.y)
    side = "right" if across > 0.0 else "left"
    yield Measured(
        subject="across",
        amount=abs(across),
        unit="m",
        threshold=settings.across,
        message=f"{distance(abs(across))} to the {side} of its cleared path.",
    )
    yield Measured(
        subject="along",
        amount=abs(along),
        unit="s",
        threshold=settings.along,
        message=f"{abs(along):.0f} s {'early' if along > 0.0 else 'late'} on its cleared path.",
    )


def to_leader(
    seen: Seen, manoeuvre: Manoeuvre, leader: Seen | None, settings: AtcSettings
) -> Iterator[Measured]:
    """Too near its leader at any time; once joined, off the place behind it that it is to keep."""
    if leader is None or abs(seen.t - leader.t) > settings.stale:
        return
    since = seen.t - leader.t
    at = (
        leader.x + since * leader.ground_speed * sin(leader.track),
        leader.y + since * leader.ground_speed * cos(leader.track),
    )
    apart, least = hypot(at[0] - seen.x, at[1] - seen.y), manoeuvre.min_separation
    if apart < least and not _apart_in_height(seen, leader, settings):
        yield Measured(
            subject="spacing",
            amount=least - apart,
            unit="m",
            threshold=settings.spacing,
            message=f"{distance(apart)} from {leader.ident}: {distance(least)} are to be kept.",
            at_once=True,
        )
    elif seen.t >= manoeuvre.joins:
        yield _spacing(seen, manoeuvre, leader, at, settings)


def _spacing(
    seen: Seen, manoeuvre: Manoeuvre, leader: Seen, at: tuple[Metre, Metre], settings: AtcSettings
) -> Measured:
    by_time = manoeuvre.spacing_type == "time"
    expected = manoeuvre.spacing / (1.0 if by_time else max(leader.ground_speed, 1.0))
    behind = behind_leader(manoeuvre.leader_path, seen.t, at, (seen.x, seen.y), expected)
    error = (behind.time if by_time else behind.length) - manoeuvre.spacing
    amount = f"{abs(error):.0f} s" if by_time else distance(abs(error))
    where = "too far" if error > 0.0 else "too close"
    return Measured(
        subject="spacing",
        amount=abs(error),
        unit="s" if by_time else "m",
        threshold=settings.spacing_time if by_time else settings.spacing,
        message=f"{amount} {where} behind {leader.ident}.",
    )


def _apart_in_height(seen: Seen, leader: Seen, settings: AtcSettings) -> bool:
    if seen.altitude is None or leader.altitude is None:
        return False
    return abs(seen.altitude - leader.altitude) >= settings.vertical_minimum


def in_level(seen: Seen, path: Track, settings: AtcSettings) -> Iterator[Measured]:
    """Above or below what the path may be flown at; where both are known."""
    if seen.altitude is None:
        return
    low, high = heights(path, seen.t)
    if low == -inf or high == inf:
        return
    below, above = low - seen.altitude, seen.altitude - high
    off = max(below, above, 0.0)
    yield Measured(
        subject="level",
        amount=off,
        unit="m",
        threshold=settings.level,
        message=f"{off / FT:.0f} ft {'above' if above > below else 'below'} its cleared level.",
    )


def turning(turn: AwaitedTurn, seen: Seen, settings: AtcSettings) -> Iterator[Measured]:
    """A turn that has not begun, or begins to the wrong side."""
    if turn.begun or turn.turn is None:
        return
    late: Second = max(seen.t - turn.turn.seen, 0.0)
    right = turn.turn.side > 0
    side, other = ("right", "left") if right else ("left", "right")
    message = f"It turns to the {other}, and is cleared to turn to the {side}."
    if not turn.wrong:
        message = f"Its turn to the {side} is {late:.0f} s late."
    yield Measured(
        subject="turn",
        amount=late,
        unit="s",
        threshold=settings.turn,
        message=message,
        at_once=turn.wrong,
    )
