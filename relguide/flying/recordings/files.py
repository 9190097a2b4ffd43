"""Files of recorded flights: which reader is theirs."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from relguide.flying.recordings.columns import read_table
from relguide.flying.recordings.file_text import text_of
from relguide.flying.recordings.flights import take_flight
from relguide.flying.recordings.fr24 import is_playback, read_playback
from relguide.flying.recordings.readsb import is_trace, read_trace
from relguide.flying.recordings.records import is_records, read_records
from relguide.flying.recordings.reports import Reports
from relguide.flying.recordings.scn import read_scn
from relguide.flying.tracks import RecordedTrack

TABLES = (".csv", ".tsv", ".txt")
SCENARIOS = (".scn",)
JSON = (".json",)
PACKED = ".gz"
JSON_READERS = ((is_trace, read_trace), (is_playback, read_playback), (is_records, read_records))
FORMS = (
    "tables of OpenSky, traffic or Flightradar24 (.csv, .tsv, .txt), traces of readsb, playbacks "
    "of Flightradar24 and records of traffic (.json), scenarios of BlueSky (.scn), all also as .gz"
)
"""What is read, for people."""


def load_track(path: Path | str, callsign: str = "") -> RecordedTrack:
    """A track from a file of recorded flights.

    Tables have columns as OpenSky (history and state vectors), traffic or Flightradar24 name them;
    others are not read. Files of JSON and scenarios of BlueSky are read as `FORMS` says.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("one.scn").write_text("00:00:00>CRE KL204 A320 52.0,4.0 90 FL310 280")
        >>> rg.load_track("one.scn").ident
        'KL204'

    Args:
        path: the file.
        callsign: which flight of it, or the aircraft's 24-bit address; may be left out if there is
            only one. Of several flights of that name the longest is taken; `NAME/2` is the second.

    Raises:
        ValueError: naming what is wrong, and where.
        OSError: if the file cannot be opened.
    """
    path = Path(path)
    return take_flight(reports_in(path), callsign, str(path))


def is_recording(path: Path) -> bool:
    """Whether a file is one of recorded flights; of JSON its content says so.

    Raises:
        OSError: if a file of JSON cannot be opened.
    """
    kind = _kind(path)
    return kind in (*TABLES, *SCENARIOS) or (kind in JSON and _json_reader(_json(path)) is not None)


def reports_in(path: Path) -> Reports:
    """All that a file of recorded flights says; raises as `load_track`."""
    kind = _kind(path)
    if kind in SCENARIOS:
        return read_scn(text_of(path), str(path))
    if kind in JSON:
        content = _json(path)
        reader = _json_reader(content)
        if reader is None:
            raise ValueError(f"{path} holds no recorded flight. Read are {FORMS}.")
        return reader(content, str(path))
    return read_table(text_of(path), str(path))


def _kind(path: Path) -> str:
    """The ending of a file's name, without that of packing, in small letters."""
    endings = [ending.lower() for ending in path.suffixes]
    return next((ending for ending in reversed(endings) if ending != PACKED), "")


def _json(path: Path) -> Any:
    try:
        return json.loads(text_of(path))
    except ValueError:  # also of text that is none: what reads situations says it
        return None


def _json_reader(content: Any) -> Callable[[Any, str], Reports] | None:
    return next((read for fits, read in JSON_READERS if fits(content)), None)
