"""Documents ↔ file: a line that says what the file is, then one JSON document a line.

What JSON needs is imported when a file is written or read: `relguide` has both functions on its
face, and loads fast.
"""

import gzip
import zlib
from collections.abc import Iterable, Iterator
from math import floor, inf
from pathlib import Path
from typing import IO, Any, Literal, cast

from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.planning.inputs import number

FORMAT = "relguide-flight"
"""What the first line calls the file."""
VERSION = 3
"""Version of the form of its lines."""
MAX_LINE = 16 * 1024 * 1024
"""Longest line that is read [bytes]; the longest document has some 10 kB."""


DIGITS = {"m": 3, "s": 3, "mps": 4, "deg": 6, "degps": 6}
"""Decimals of a sample's numbers by their unit: 1 mm, 1 ms, 0.1 mm/s, 10⁻⁶ degrees."""


class RecordingError(ValueError):
    """A file is not a recording, or is damaged from some line on."""


def record(
    documents: Iterable[Document], file: Path | str, *, sample_rate: float | None = 1.0
) -> Iterator[Document]:
    """Pass documents through while writing them to a file.

    All pass and all are written, but of the samples no more than `sample_rate`, and the last; in
    these lengths are rounded to 1 mm and angles to 10⁻⁶ degrees. A flight of 17 minutes then has
    less than 1 MB, and not 22.

    The file is opened when the first document is asked for, and complete once the last one has
    been taken; a name that ends in `.gz` compresses it.

    Examples:
        >>> flown = rg.fly(rg.scenario("fig_6b"), rg.plan, sample_period=1.0)
        >>> *_, end = rg.record(flown, "flight.jsonl")
        >>> end.kind
        'flight_ended'

    Args:
        documents: of a flight.
        file: where they are written.
        sample_rate: samples a second [Hz]; `None` to write each as it is, with all its digits.

    Raises:
        RecordingError: if the name does not end in .jsonl or .jsonl.gz.
        ValueError: if the rate is not above 0.
        OSError: if the file cannot be written.
    """
    check_name(file)
    if sample_rate is not None and number("sample_rate", sample_rate) <= 0.0:
        raise ValueError(f"sample_rate must be above 0 Hz, not {sample_rate:g} Hz.")
    return _record(documents, Path(file), sample_rate)


def replay(file: Path | str) -> Iterator[Document]:
    """The documents of a recording, in order, as a flight would give them.

    From a damaged file the readable documents come first, then the error.

    Examples:
        >>> *_, end = rg.record(rg.fly(rg.scenario("fig_6b"), sample_period=1.0), "flight.jsonl.gz")
        >>> next(rg.replay("flight.jsonl.gz")).title
        "Fig. 6b: the leader's intent is known"

    Raises:
        RecordingError: naming the first line that is not a document.
        OSError: if the file cannot be opened.
    """
    return (document for document, _ in read_lines(file))


def read_lines(file: Path | str) -> Iterator[tuple[Document, bytes]]:
    """The documents of a recording, each with the line it is written in; raises as `replay`."""
    path = Path(file)
    with _open(path, "rb") as stream:
        lines = _lines(stream, path)
        _check_header(next(lines, b""), path)
        for number, line in enumerate(lines, start=2):
            yield _document(line, f"{path}, line {number}"), line


def is_recording(file: Path | str) -> bool:
    """Whether a file says of itself that it is a recording, of whatever version.

    Raises:
        OSError: if it cannot be opened.
    """
    from relguide.contract.refusal import ContractError, loads

    path = Path(file)
    with _open(path, "rb") as stream:
        try:
            header = loads(next(_lines(stream, path), b""))
        except (ContractError, RecordingError):
            return False
    return isinstance(header, dict) and header.get("format") == FORMAT


def check_name(file: Path | str) -> None:
    """Refuse a name that a recording cannot have.

    Raises:
        RecordingError: if it does not end in .jsonl or .jsonl.gz.
    """
    if not str(file).endswith((".jsonl", ".jsonl.gz")):
        raise RecordingError(f"A recording's name must end in .jsonl or .jsonl.gz, not be {file}.")


def _record(
    documents: Iterable[Document], path: Path, sample_rate: float | None
) -> Iterator[Document]:
    with _open(path, "wb") as stream:
        stream.write(header_line())
        for document, lines in written(documents, sample_rate):
            stream.write(lines)
            yield document


def recording_of(documents: Iterable[Document], *, sample_rate: float | None = 1.0) -> bytes:
    """What `record` would write of documents, up to the last of them.

    Args:
        documents: of a flight.
        sample_rate: as in `record` [Hz].
    """
    lines = (lines for _, lines in written(documents, sample_rate))
    return header_line() + b"".join(lines)


def header_line(version: int = VERSION, **origin: str) -> bytes:
    """The first line of a recording, and what else it says of where that comes from."""
    from pydantic_core import to_json

    return to_json({"format": FORMAT, "version": version, **origin}) + b"\n"


def written(
    documents: Iterable[Document], sample_rate: float | None
) -> Iterator[tuple[Document, bytes]]:
    """Each document, and the lines that a recording has of it: none, or one, or two at the end."""
    from pydantic_core import to_json

    from relguide.contract.wire import dumps, to_wire

    due, left_out = -inf, b""
    for document in documents:
        match document:
            case Sample(t=t) if sample_rate is not None:
                line = to_json(_rounded(to_wire(document))) + b"\n"
                if t > due - 1e-6:  # rounding of t, far below any step
                    yield document, line
                    due, left_out = (floor(t * sample_rate + 1e-6) + 1.0) / sample_rate, b""
                else:
                    yield document, b""
                    left_out = line
            case FlightEnded():
                yield document, left_out + dumps(document) + b"\n"
            case _:
                yield document, dumps(document) + b"\n"


def _rounded(written: Any, name: str = "") -> Any:
    """A document in JSON, with the digits that say something."""
    if isinstance(written, dict):
        return {key: _rounded(value, key) for key, value in written.items()}
    if isinstance(written, list):
        return [_rounded(member, name) for member in written]
    if isinstance(written, float):
        digits = DIGITS.get(name.rpartition("_")[2])
        if digits is None:
            return written
        number = round(written, digits) + 0.0  # −0 becomes 0
        return 0.0 if number == 360.0 and name.endswith("_deg") else number
    return written


def _open(path: Path, mode: Literal["rb", "wb"]) -> IO[bytes]:
    if not path.name.endswith(".gz"):
        return path.open(mode)
    # level 9, the default, takes three times as long for files a tenth smaller
    return cast(IO[bytes], gzip.open(path, mode, compresslevel=3))


def _lines(stream: IO[bytes], path: Path) -> Iterator[bytes]:
    number = 0
    try:
        while line := stream.readline(MAX_LINE):
            number += 1
            yield line
    except (EOFError, gzip.BadGzipFile, zlib.error):
        raise RecordingError(
            f"{path} is damaged or cut short after line {number}; what comes before is good."
        ) from None


def _check_header(line: bytes, path: Path) -> None:
    from relguide.contract.refusal import ContractError, loads

    try:
        header = loads(line)
    except ContractError:
        header = None
    match header:
        case {"format": str(name), "version": int(version)} if name == FORMAT:
            if version != VERSION:
                raise RecordingError(
                    f"{path} is a recording of version {version}; this program reads {VERSION}."
                )
        case _:
            raise RecordingError(f"{path} is not a recording made by relguide fly --record.")


def _document(line: bytes, where: str) -> Document:
    from pydantic_core import from_json

    from relguide.contract.document_models import from_wire
    from relguide.contract.refusal import ContractError

    if not line.endswith(b"\n"):
        raise RecordingError(f"{where}: the file is cut short here; what comes before is good.")
    try:
        # three times as fast as the careful reader, which explains what this refuses
        content = from_json(line, allow_inf_nan=False)
    except ValueError:
        content = line
    try:
        return from_wire(content if isinstance(content, dict) else line)
    except ContractError as error:
        raise RecordingError(f"{where}: {error} What comes before is good.") from None
