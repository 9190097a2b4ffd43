"""Reports parted into flights: one address is one aircraft, and a long silence ends a flight."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from relguide.flying.recordings.reports import Reports
from relguide.flying.recordings.stretch import clock, track_of
from relguide.flying.spline import Array
from relguide.flying.tracks import RecordedTrack
from relguide.units import Second

LEG_GAP: Second = 1800.0
"""A callsign that is silent for longer comes back as another flight: no aircraft lands, turns round
and leaves in less."""
NAMED = 8
"""How many of many flights are named."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Flight:
    """Reports of one aircraft under one callsign, without long silences."""

    callsign: str
    address: str
    aircraft_type: str
    numbers: Array
    """As in `Reports`, in order of time."""

    @property
    def name(self) -> str:
        """Its callsign, or the aircraft's address where there is none."""
        return self.callsign or self.address

    @property
    def span(self) -> str:
        """Whose it is, and from when to when it was heard, for people."""
        whose = f"{self.address} " if self.address and self.callsign else ""
        return f"{whose}{clock(self.numbers[0, 0])} to {clock(self.numbers[-1, 0])}"


def flights_of(reports: Reports) -> tuple[Flight, ...]:
    """All flights of a recording, in order of their names, those of one name in order of time."""
    by_aircraft = defaultdict[tuple[str, str], list[int]](list)
    for row, address in enumerate(reports.address):
        by_aircraft[address, "" if address else reports.callsign[row]].append(row)
    found = []
    for (address, _), heard in by_aircraft.items():
        rows = np.array(heard)
        rows = rows[np.argsort(reports.numbers[rows, 0], kind="stable")]
        silences = np.flatnonzero(np.diff(reports.numbers[rows, 0]) > LEG_GAP) + 1
        for leg in np.split(rows, silences):
            by_callsign = defaultdict[str, list[int]](list)
            for row, callsign in zip(leg, _filled([reports.callsign[i] for i in leg]), strict=True):
                by_callsign[callsign].append(row)
            found += [
                Flight(
                    callsign=callsign,
                    address=address,
                    aircraft_type=next(filter(None, (reports.aircraft_type[i] for i in its)), ""),
                    numbers=reports.numbers[its],
                )
                for callsign, its in by_callsign.items()
            ]
    return tuple(sorted(found, key=lambda flight: (flight.name, flight.numbers[0, 0])))


def take_flight(reports: Reports, wanted: str, source: str) -> RecordedTrack:
    """One flight of a recording as a track; see `choose`."""
    return choose(flights_of(reports), wanted, source)


def choose(flights: Sequence[Flight], wanted: str, source: str) -> RecordedTrack:
    """The longest track of the flights of a name.

    Args:
        flights: of one recording.
        wanted: a callsign or an address, capitals or not; `NAME/2` for the second flight of that
            name; empty if there is only one name.
        source: the recording's name, for people.

    Raises:
        ValueError: if there is no such flight, or none of them makes a track, in a sentence.
    """
    if not flights:
        raise ValueError(f"{source} has no reports.")
    name, number = _parted(wanted)
    called = [flight for flight in flights if name.lower() in ("", *_names(flight))]
    names = sorted({flight.name for flight in flights})
    if not called or (not name and len(names) > 1):
        said = f"has no flight {name!r}" if name else "has several flights: choose one"
        raise ValueError(
            f"{source} {said}. It has {len(names)}, for example {', '.join(names[:NAMED])}. "
            "Its callsign names it: callsign=…, on the command line --callsign."
        )
    if number > len(called):
        raise ValueError(
            f"{source} has {_count(called)} of {name!r}, not {number}: {_listed(called)}."
        )
    tracks, refusals = list[tuple[int, RecordedTrack]](), list[ValueError]()
    for count, flight in enumerate(called, 1):
        if number not in (0, count):
            continue
        about = f"{flight.name} of {source}" if len(names) > 1 else source
        try:
            track = track_of(flight.numbers, flight.name, flight.aircraft_type, about)
            tracks.append((count, track))
        except ValueError as refusal:
            refusals.append(refusal)
    if not tracks:
        raise refusals[0]
    taken, longest = max(tracks, key=lambda one: one[1].duration)
    if len(called) == 1:
        return longest
    why, known = "" if number else ", the longest", called[0].name
    said = (
        f"{known} is {_count(called)}: {_listed(called)}. Flight {taken} is flown{why}; "
        f"{known}/1 to {known}/{len(called)} name them."
    )
    return replace(longest, taken=f"{said} {longest.taken}")


def _names(flight: Flight) -> tuple[str, str]:
    return flight.callsign.lower(), flight.address.lower()


def _parted(wanted: str) -> tuple[str, int]:
    """A name, and which flight of it; 0 if that is not said."""
    name, slash, number = wanted.strip().rpartition("/")
    if slash and number.isascii() and number.isdigit() and int(number) > 0:
        return name, int(number)
    return wanted.strip(), 0


def _count(flights: Sequence[Flight]) -> str:
    return "1 flight" if len(flights) == 1 else f"{len(flights)} flights"


def _listed(flights: Sequence[Flight]) -> str:
    named = [f"{count} ({flight.span})" for count, flight in enumerate(flights[:NAMED], 1)]
    return ", ".join(named) + (" …" if len(flights) > NAMED else "")


def _filled(callsigns: Iterable[str]) -> list[str]:
    """Each callsign, or the one before it where it is missing; the first from what follows."""
    filled, last = list[str](), ""
    for callsign in callsigns:
        last = callsign or last
        filled.append(last)
    first = next(filter(None, filled), "")
    return [callsign or first for callsign in filled]
