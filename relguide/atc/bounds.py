"""How far an aircraft may be from its track: what validation adds is what conformance allows."""

from math import hypot, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from relguide.atc.picture import Seen
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.units import Metre, MetrePerSecond, Radian, Second


class Stray(NamedTuple):
    """b(t) = at_first + growth (t − since): how far an aircraft may be from its track at t."""

    at_first: Metre
    growth: MetrePerSecond
    """[m/s], ≥ 0."""
    since: Second

    def at(self, t: Second) -> Metre:
        """B at a time, not before `since` [m]."""
        return self.at_first + self.growth * max(t - self.since, 0.0)


NONE = Stray(0.0, 0.0, 0.0)
"""Of the two that are guided relative to each other."""


def cleared_stray(track: Track, settings: AtcSettings) -> Metre:
    """How far an aircraft may be from its cleared path while no caution is due [m].

    It may be before or behind by v τ, and across by a at the place where it then is. While it turns
    by S within τ these are not at right angles:

        b² = (v τ)² + a² + 2 v τ a sin S.

    Args:
        track: what it is cleared to fly.
        settings: the thresholds of conformance.
    """
    along, across = track.fastest * settings.along.caution, settings.across.caution
    swing = min(largest_turn(track, settings.along.caution), 0.5 * pi)
    return sqrt(hypot(along, across) ** 2 + 2.0 * along * across * sin(swing))


def largest_turn(track: Track, within: Second) -> Radian:
    """The most that a track changes its direction within so many seconds [rad]."""
    directions = np.unwrap(np.arctan2(np.diff(track.x), np.diff(track.y)))
    last = np.searchsorted(track.t[:-1], track.t[1:] + within, side="right") - 1
    reaches = int(np.max(last - np.arange(len(last))))
    most = 0.0
    for step in range(1, reaches + 1):  # pieces apart
        seen = step <= (last - np.arange(len(last)))[:-step]
        turned = np.abs(directions[step:] - directions[:-step])[seen]
        most = max(most, float(np.max(turned, initial=0.0)))
    return most


def stray_of(seen: Seen, settings: AtcSettings, own: Metre) -> Stray:
    """How far another aircraft and one's own may be from their tracks, together.

    Args:
        seen: the other.
        settings: the thresholds.
        own: how far one's own may be [m].
    """
    if seen.cleared and seen.path is not None:
        return Stray(own + cleared_stray(seen.path, settings), 0.0, seen.t)
    return Stray(own + settings.traffic_bound, settings.traffic_growth, seen.t)
