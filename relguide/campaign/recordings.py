"""The recorded leaders of the campaign: every callsign of one collection that makes a track."""

from functools import lru_cache

from relguide.flying.recordings.flights import choose
from relguide.flying.recordings.samples import QUICKSTART, collection_flights
from relguide.flying.tracks import RecordedTrack
from relguide.units import Second

LONG_ENOUGH: Second = 180.0
"""A shorter track is nothing to follow."""


def track(number: int) -> RecordedTrack:
    """One of them, in the order of their callsigns; behind the last comes the first again.

    Raises:
        ValueError: if the recorded flights are not installed.
    """
    found = all_tracks()
    return found[number % len(found)]


def count() -> int:
    """How many there are.

    Raises:
        ValueError: if they are not installed.
    """
    return len(all_tracks())


@lru_cache(maxsize=1)
def all_tracks() -> tuple[RecordedTrack, ...]:
    """All of them, from one reading of the file; `load_sample` would read it for each."""
    flights = collection_flights(QUICKSTART)
    found = []
    for name in sorted({flight.callsign for flight in flights if flight.callsign}):
        its = [flight for flight in flights if flight.callsign == name]
        try:
            made = choose(its, name, QUICKSTART)
        except ValueError:  # it never flies, or has no positions
            continue
        if made.duration >= LONG_ENOUGH:
            found.append(made)
    return tuple(found)
