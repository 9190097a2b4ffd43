"""Recordings as feeds, at rate 1 from the start of the service: `replay:FILE`.

A file of recorded flights (OpenSky, traffic, Flightradar24, readsb) has places of its own. A flight
that relguide recorded has none: `replay:FILE@LATITUDE,LONGITUDE` says where its x = y = 0 is.
"""

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby
from math import floor
from pathlib import Path

import numpy as np

from relguide.atc.reported import Reported
from relguide.contract.recorder import read_lines
from relguide.flying.documents import Sample
from relguide.flying.recordings.exchanged import refuse_exchanged
from relguide.flying.recordings.files import reports_in
from relguide.flying.recordings.flights import flights_of
from relguide.planning.frames import LocalPlane
from relguide.units import DEG
from relguide_server.atc.feeds.feed_state import FeedState, clock


async def play(file: str, plane: LocalPlane | None, state: FeedState) -> None:
    """Report what a recording holds, until its end.

    Args:
        file: its name.
        plane: where a flight of relguide lies; `None` for a file that has places of its own.
        state: of the feed.
    """
    begun = clock()
    try:
        seconds = await asyncio.to_thread(_by_second, file, plane)
        while (found := await asyncio.to_thread(next, seconds, None)) is not None:
            due = begun + found[0].t
            await asyncio.sleep(max(due - clock(), 0.0))
            state.messages += 1
            state.take([replace(one, t=begun + one.t) for one in found], clock())
    except (OSError, ValueError) as error:
        state.fault = f"It cannot be played: {error}"
    state.over = True


def _by_second(file: str, plane: LocalPlane | None) -> Iterator[list[Reported]]:
    """What is reported in each second in turn, since the beginning [s]; empty seconds are none."""
    found = _of_reports(file) if plane is None else _of_flight(file, plane)
    return (list(group) for _, group in groupby(found, key=lambda one: floor(one.t)))


def _of_flight(file: str, plane: LocalPlane) -> Iterator[Reported]:
    """All aircraft of a flight that relguide recorded, once a second."""
    for document, _ in read_lines(file):
        if not isinstance(document, Sample) or document.t % 1.0 > 1e-6:
            continue
        for one in document.aircraft:
            lat, lon = plane.to_geodetic(one.x, one.y)
            yield Reported(
                ident=one.ident,
                t=document.t,
                lat_deg=lat,
                lon_deg=lon,
                track=(one.track - plane.meridian(lat, lon)) % (360.0 * DEG),
                ground_speed=one.ground_speed,
                altitude=one.altitude,
            )


def _of_reports(file: str) -> Iterator[Reported]:
    """All reports of a file of recorded flights, in order of time, of aircraft in the air."""
    reports = reports_in(Path(file))
    for flight in flights_of(reports):
        refuse_exchanged(flight.numbers, f"{flight.name} of {file}")
    t, lat, lon, altitude, speed, track, ground = reports.numbers.T
    complete = np.isfinite(t + lat + lon + speed + track) & (ground != 1.0)
    rows = np.flatnonzero(complete)
    rows = rows[np.argsort(t[rows], kind="stable")]
    for k in rows.tolist():
        yield Reported(
            ident=reports.callsign[k] or reports.address[k],
            t=float(t[k] - t[rows[0]]),
            lat_deg=float(lat[k]),
            lon_deg=float(lon[k]),
            track=float(track[k]) * DEG % (360.0 * DEG),
            ground_speed=float(speed[k]),
            altitude=float(altitude[k]) if np.isfinite(altitude[k]) else None,
        )
