"""Two recorded tracks in one plane and on one clock, as they flew together."""

from dataclasses import replace

import numpy as np

from relguide.flying.tracks import RecordedTrack
from relguide.planning.frames import LocalPlane
from relguide.units import Second

STEP: Second = 1.0
SHORTEST: Second = 30.0
"""Fewer seconds together are no flight."""


def together(leader: RecordedTrack, follower: RecordedTrack) -> tuple[RecordedTrack, RecordedTrack]:
    """Both tracks in the leader's plane, from when both are seen until one is not.

    Args:
        leader: whose plane is kept.
        follower: the other.

    Returns:
        the leader and the follower, of one origin, start and length.

    Raises:
        ValueError: if they are not seen together for `SHORTEST`, in a sentence.
    """
    start, end = max(leader.start, follower.start), min(leader.end, follower.end)
    if end - start < SHORTEST:
        raise ValueError(
            f"{leader.ident} and {follower.ident} are not seen together for {SHORTEST:g} s."
        )
    return (
        between(leader, start, end),
        between(placed_on(leader.origin, follower), start, end),
    )


def placed_on(plane: LocalPlane, track: RecordedTrack) -> RecordedTrack:
    """A track in another plane: its places, and its directions by that plane's north."""
    lat, lon = track.origin.to_geodetic_each(track.x, track.y)
    x, y = plane.to_local_each(lat, lon)
    # both meridians point to true north, each in its plane
    turned = plane.meridian_each(lat, lon) - track.origin.meridian_each(lat, lon)
    return replace(track, origin=plane, x=x, y=y, track=np.unwrap(track.track + turned))


def between(track: RecordedTrack, start: Second, end: Second) -> RecordedTrack:
    """The part of a track between two times since 1970 [s], both within it."""
    t = np.arange(0.0, end - start + 1e-6, STEP)
    x, y, east, north, altitude = track.sample(np.minimum(t + start - track.start, track.duration))
    return replace(
        track,
        t=t,
        x=x,
        y=y,
        track=np.unwrap(np.arctan2(east, north)),
        ground_speed=np.hypot(east, north),
        altitude=altitude,
        start=start,
    )
