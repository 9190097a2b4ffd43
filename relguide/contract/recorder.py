"""Documents ↔ file: a line that says what the file is, then one JSON document a line.

What JSON needs is imported when a file is written or read: `relguide` has both functions on its
face, and numpy and numba are enough to import that.
"""

import gzip
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO, Literal, cast

from relguide.flying.documents import Document
from relguide.planning.extras import need

FORMAT = "relguide-flight"
"""What the first line calls the file."""
VERSION = 3
"""Version of the form of its lines."""
MAX_LINE = 16 * 1024 * 1024
"""Longest line that is read [bytes]; the longest document has some 10 kB."""


class RecordingError(ValueError):
    """A file is not a recording, or is damaged from some line on."""


def record(documents: Iterable[Document], file: Path | str) -> Iterator[Document]:
    """Pass documents through while writing them to a file.

    The file is opened when the first document is asked for, and complete once the last one has
    been taken; a name that ends in `.gz` compresses it.

    Raises:
        RecordingError: if the name does not end in .jsonl or .jsonl.gz.
        MissingExtra: if a package that writes JSON is not installed.
        OSError: if the file cannot be written.
    """
    need("orjson")
    check_name(file)
    return _record(documents, Path(file))


def replay(file: Path | str) -> Iterator[Document]:
    """The documents of a recording, in order, as a flight would give them.

    From a damaged file the readable documents come first, then the error.

    Raises:
        RecordingError: naming the first line that is not a document.
        MissingExtra: if a package that reads JSON is not installed.
        OSError: if the file cannot be opened.
    """
    need("orjson", "pydantic")
    path = Path(file)
    with _open(path, "rb") as stream:
        lines = _lines(stream, path)
        _check_header(next(lines, b""), path)
        for number, line in enumerate(lines, start=2):
            yield _document(line, f"{path}, line {number}")


def check_name(file: Path | str) -> None:
    """Refuse a name that a recording cannot have.

    Raises:
        RecordingError: if it does not end in .jsonl or .jsonl.gz.
    """
    if not str(file).endswith((".jsonl", ".jsonl.gz")):
        raise RecordingError(f"A recording's name must end in .jsonl or .jsonl.gz, not be {file}.")


def _record(documents: Iterable[Document], path: Path) -> Iterator[Document]:
    import orjson

    from relguide.contract.wire import dumps

    with _open(path, "wb") as stream:
        stream.write(orjson.dumps({"format": FORMAT, "version": VERSION}) + b"\n")
        for document in documents:
            stream.write(dumps(document) + b"\n")
            yield document


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
    import orjson

    from relguide.contract.messages import from_wire
    from relguide.contract.refusal import ContractError

    if not line.endswith(b"\n"):
        raise RecordingError(f"{where}: the file is cut short here; what comes before is good.")
    try:
        # orjson is five times as fast as the careful reader, which explains what orjson refuses
        content = orjson.loads(line)
    except orjson.JSONDecodeError:
        content = line
    try:
        return from_wire(content if isinstance(content, dict) else line)
    except ContractError as error:
        raise RecordingError(f"{where}: {error} What comes before is good.") from None
