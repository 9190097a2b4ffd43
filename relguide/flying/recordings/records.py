"""JSON as the package traffic and pandas write it: a list of records, or columns by name.

Times are in milliseconds, altitudes in feet, speeds in knots.
"""

from typing import Any

import numpy as np

from relguide.flying.recordings.cells import PER_SECOND
from relguide.flying.recordings.reports import NUMBERS, Reports
from relguide.flying.spline import Array
from relguide.units import FT, KT

COLUMNS = ("timestamp", "latitude", "longitude", "altitude", "groundspeed", "track", "onground")
"""In the order of `NUMBERS`."""
UNITS = (1.0, 1.0, 1.0, FT, KT, 1.0, 1.0)
NEEDED = COLUMNS[:4]
TEXTS = ("icao24", "callsign", "typecode")


def is_records(content: object) -> bool:
    """Whether JSON looks like it."""
    match content:
        case [dict() as first, *_]:
            return "timestamp" in first
        case {"timestamp": dict() | list(), "latitude": dict() | list()}:
            return True
    return False


def read_records(content: Any, source: str) -> Reports:
    """The reports of traffic's JSON.

    Raises:
        ValueError: if it is no such JSON, in a sentence.
    """
    try:
        columns = _columns(content)
        nothing = [None] * len(columns["timestamp"])
        # as floats, a missing value (None) becomes NaN
        numbers = np.array([columns.get(name, nothing) for name in COLUMNS], dtype=np.float64).T
        texts = [[str(cell or "") for cell in columns.get(name, nothing)] for name in TEXTS]
    except (TypeError, AttributeError, KeyError, OverflowError, ValueError):
        raise ValueError(f"{source} is no table of reports as traffic writes them.") from None
    missing = [name for name in NEEDED if name not in columns]
    if missing:
        raise ValueError(f"{source} has no {missing[0]}. Found: {', '.join(columns)}.")
    if not np.all(np.isfinite(numbers[:, 0])):
        raise ValueError(f"{source} has reports without a time.")
    numbers[:, 0] = _seconds(numbers[:, 0])
    addresses, callsigns, types = ([text.strip() for text in column] for column in texts)
    assert len(UNITS) == len(NUMBERS)
    lowered = [address.lower() for address in addresses]
    return Reports(lowered, callsigns, types, numbers * np.array(UNITS))


def _columns(content: Any) -> dict[str, list[Any]]:
    if isinstance(content, dict):
        return {
            name: list(column.values()) if isinstance(column, dict) else column
            for name, column in content.items()
        }
    names = dict.fromkeys(name for row in content[:1000] for name in row)
    return {name: [row.get(name) for row in content] for name in names}


def _seconds(times: Array) -> Array:
    for least, per in PER_SECOND:
        times = np.where(np.abs(times) >= least, times / per, times)
    return times
