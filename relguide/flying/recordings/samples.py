"""The recorded flights that the package `traffic` brings, by collection and callsign.

They are read as data from the installed package, which is never imported itself; it can be
installed without its dependencies by `pip install --no-deps traffic==2.13`.
"""

import json
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from relguide.flying.recordings.file_text import text_of
from relguide.flying.recordings.flights import Flight, choose, flights_of
from relguide.flying.recordings.records import is_records, read_records
from relguide.flying.tracks import RecordedTrack

INSTALL = "pip install --no-deps traffic==2.13"
"""How to install the samples."""
QUICKSTART = "quickstart"
"""Arrivals and departures around Paris, one position a second."""
DEFAULT_LEADER = "TVF22LK"
"""Of QUICKSTART: 12 minutes near 310 kt at 11,000 ft and above, with one clear turn, 35° to 84°."""
SAMPLES = "traffic/data/samples"
ENDING = ".json.gz"
NAMED = 12
"""How many collections are named."""


def load_sample(callsign: str, collection: str = QUICKSTART) -> RecordedTrack:
    """A track of the samples that the `traffic` package brings.

    Args:
        callsign: as for `load_track`.
        collection: its name, like `quickstart`, or with its folder, like `featured/zero_gravity`.

    Raises:
        ValueError: if the package, the collection or the callsign is not there, in a sentence.
    """
    return choose(collection_flights(collection), callsign, collection)


def collection_flights(collection: str = QUICKSTART) -> tuple[Flight, ...]:
    """All flights of a collection.

    Raises:
        ValueError: if the package or the collection is not there, in a sentence.
    """
    path = _path(collection)
    try:
        content = json.loads(text_of(path))
        if not is_records(content):
            raise ValueError
        return flights_of(read_records(content, collection))
    except ValueError:
        raise ValueError(f"{path} is damaged; install it again: {INSTALL}") from None


def _path(collection: str) -> Path:
    """The file of a collection."""
    try:
        package = distribution("traffic")
    except PackageNotFoundError:
        raise ValueError(
            f"Recorded tracks come with the package traffic, which is not installed: {INSTALL}"
        ) from None
    folder = Path(str(package.locate_file(SAMPLES)))
    known = {file.relative_to(folder).as_posix(): file for file in folder.rglob(f"*{ENDING}")}
    for name, file in known.items():
        if collection in (name.removesuffix(ENDING), file.name.removesuffix(ENDING)):
            return file
    names = sorted(file.name.removesuffix(ENDING) for file in known.values())
    raise ValueError(
        f"traffic {package.version} has no samples {collection!r}; "
        f"it has {len(names)}, for example {', '.join(names[:NAMED])}."
    )
