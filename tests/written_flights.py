"""A flight whose truth is known, as files of recorded flights write it."""

import csv
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from relguide.flying.tracks import RecordedTrack
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, KT

COLUMNS = (
    "timestamp",
    "icao24",
    "callsign",
    "latitude",
    "longitude",
    "altitude",
    "groundspeed",
    "track",
    "vertical_rate",
)
PLANE = LocalPlane(49.0, 2.0)
SPEED = 150.0


def truth(t: float) -> tuple[float, float, float]:
    """A truth to record: 200 s straight, a right turn of 90° at 1.5°/s, straight: x, y, track."""
    rate = 1.5 * DEG
    turned = min(max(t - 200.0, 0.0), 60.0) * rate
    radius = SPEED / rate
    x, y = radius * (1.0 - math.cos(turned)), radius * math.sin(turned)
    y += SPEED * min(t, 200.0)
    after = max(t - 260.0, 0.0) * SPEED
    return x + after * math.sin(turned), y + after * math.cos(turned), turned


Row = dict[str, Any]


def row(t: float) -> Row:
    x, y, track = truth(t)
    lat, lon = PLANE.to_geodetic(x, y)
    return {
        "timestamp": f"2021-10-07 12:{int(t) // 60:02d}:{t % 60:06.3f}+00:00",
        "icao24": "39bd20",
        "callsign": "TEST12",
        "latitude": lat,
        "longitude": lon,
        "altitude": 10000.0 + 20.0 * t,
        "groundspeed": round(SPEED / KT),
        "track": round(track / DEG, 1),
        "vertical_rate": 1200,
    }


def rows(until: int = 600) -> list[Row]:
    return [row(float(t)) for t in range(until)]


def write_csv(file: Path, content: Iterable[Row], columns: tuple[str, ...] = COLUMNS) -> Path:
    with file.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(content)
    return file


def worst(track: RecordedTrack, *, start: float = 0.0) -> float:
    """Largest distance from the truth [m]; `start` is when the track begins."""
    distance = 0.0
    for t in np.arange(0.0, track.duration, 0.7):
        state = track.state_at(float(t))
        x, y = PLANE.to_local(*track.origin.to_geodetic(state.x, state.y))
        true_x, true_y, _ = truth(start + float(t))
        distance = max(distance, math.hypot(x - true_x, y - true_y))
    return distance
