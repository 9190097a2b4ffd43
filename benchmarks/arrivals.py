"""Consecutive arrivals of the Paris data: who landed behind whom on one centreline."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from relguide.campaign.recordings import all_tracks
from relguide.flying.recordings.together import placed_on, together
from relguide.flying.tracks import RecordedTrack
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, FT, NM, Metre, Radian, Second

PARIS = LocalPlane(48.87, 2.45)
LOW: Metre = 1500.0 * FT
"""An arrival ends below."""
DESCENDED: Metre = 600.0
GATE: Metre = 1.5 * NM
"""Before the place where the arrivals of a centreline are last seen."""
SAME_COURSE: Radian = 3.0 * DEG
SAME_LINE: Metre = 0.2 * NM
NEAR: Metre = 5.0 * NM
"""Between the ends of two arrivals of one centreline."""
LONGEST_INTERVAL: Second = 240.0
SEEN_TOGETHER: Second = 180.0

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Centreline:
    """A line that arrivals end on."""

    x: Metre
    """Where they are last seen, in the median."""
    y: Metre
    course: Radian
    tracks: tuple[RecordedTrack, ...]
    """Those that end on it, in `PARIS`."""

    def along(self, track: RecordedTrack) -> Floats:
        """How far a track is beyond the place where they are last seen [m]."""
        east, north = track.x - self.x, track.y - self.y
        return np.asarray(east * np.sin(self.course) + north * np.cos(self.course))

    def across(self, track: RecordedTrack) -> Floats:
        """How far a track is to the right of the line [m]."""
        east, north = track.x - self.x, track.y - self.y
        return np.asarray(east * np.cos(self.course) - north * np.sin(self.course))

    def gate_time(self, track: RecordedTrack) -> Second | None:
        """When a track passes the gate for the last time, since 1970 [s]."""
        before = np.flatnonzero(self.along(track) < -GATE)
        if not before.size or before[-1] == len(track.t) - 1:
            return None
        return track.start + float(track.t[before[-1]])


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Two consecutive arrivals, in one plane and on one clock, from when both are seen."""

    leader: RecordedTrack
    follower: RecordedTrack
    line: Centreline
    interval: Second
    """Between them, through the gate."""

    @property
    def separation(self) -> Floats:
        """At each second [m]."""
        leader, follower = self.leader, self.follower
        return np.hypot(leader.x - follower.x, leader.y - follower.y)


def centrelines() -> tuple[Centreline, ...]:
    """The lines that two arrivals or more end on."""
    arrivals = [
        placed_on(PARIS, track)
        for track in all_tracks()
        if track.altitude[-1] < LOW and track.altitude[0] > track.altitude[-1] + DESCENDED
    ]
    found = []
    while arrivals:
        first = arrivals[0]
        ours = [track for track in arrivals if _end_alike(first, track)]
        arrivals = [track for track in arrivals if track not in ours]
        if len(ours) > 1:
            found.append(_line(ours))
    return tuple(found)


def pairs() -> tuple[Pair, ...]:
    """Each arrival and the one just before it, less than `LONGEST_INTERVAL` apart at the gate."""
    found = []
    for line in centrelines():
        timed = [(at, track) for track in line.tracks if (at := line.gate_time(track)) is not None]
        timed.sort(key=lambda one: one[0])
        for (before, leader), (after, follower) in pairwise(timed):
            seen = min(leader.end, follower.end) - max(leader.start, follower.start)
            if after - before < LONGEST_INTERVAL and seen >= SEEN_TOGETHER:
                one, other = together(leader, follower)
                found.append(Pair(leader=one, follower=other, line=line, interval=after - before))
    return tuple(found)


def _end_alike(one: RecordedTrack, other: RecordedTrack) -> bool:
    turned = float(other.track[-1] - one.track[-1])
    east, north = other.x[-1] - one.x[-1], other.y[-1] - one.y[-1]
    across = east * np.cos(one.track[-1]) - north * np.sin(one.track[-1])
    return bool(
        np.cos(turned) > np.cos(SAME_COURSE)
        and abs(across) < SAME_LINE
        and np.hypot(east, north) < NEAR
    )


def _line(tracks: list[RecordedTrack]) -> Centreline:
    courses = np.array([track.track[-1] for track in tracks])
    return Centreline(
        x=float(np.median([track.x[-1] for track in tracks])),
        y=float(np.median([track.y[-1] for track in tracks])),
        course=float(np.arctan2(np.median(np.sin(courses)), np.median(np.cos(courses)))),
        tracks=tuple(tracks),
    )
