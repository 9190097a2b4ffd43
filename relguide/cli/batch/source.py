"""A file of situations as chunks of whole lines, which are answered independently."""

import csv
import select
from collections.abc import Iterator, Sequence
from io import UnsupportedOperation
from mmap import ACCESS_READ, mmap
from typing import IO, TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import pyarrow.parquet

BLOCK = 1 << 20
"""Bytes read at a time."""
LONGEST = 64 << 20
"""Longest line [bytes]: more is no file of lines, and would fill the memory."""
OTHERS = (b'"traffic"', b'"cells"', b'"altitude_m"')
"""Fields of situations to which answers say more."""
SIGNATURE = b"\xef\xbb\xbf"
"""What spreadsheets put before UTF-8."""


class LineChunk(NamedTuple):
    """Lines that are answered together."""

    first: int
    """The number of its first line; the first of a file is 1."""
    lines: int
    content: bytes
    size: int
    """How much of the file it is: bytes, or rows of Parquet."""

    @property
    def name(self) -> str:
        """As a sentence begins that is about it."""
        return f"The lines from {self.first} on"


def text_chunks(stream: IO[bytes], first: int, at_once: int) -> Iterator[LineChunk | None]:
    """The lines from here on, in chunks; `None` where the next would have to be waited for.

    Args:
        stream: read up to line `first`.
        first: the number of its next line.
        at_once: lines in a chunk, at most.

    Raises:
        ValueError: if a line is longer than `LONGEST`.
    """
    rest = b""
    for block in _blocks(stream):
        if block is None:
            yield None
            continue
        *lines, rest = (rest + block).split(b"\n")
        if len(rest) > LONGEST:
            raise ValueError(
                f"Line {first + len(lines)} is longer than {LONGEST >> 20} MiB: this is no file of "
                "situations."
            )
        for at in range(0, len(lines), at_once):
            some = lines[at : at + at_once]
            content = b"\n".join(some) + b"\n"
            yield LineChunk(first, len(some), content, len(content))
            first += len(some)
    if rest:
        yield LineChunk(first, 1, rest, len(rest))


def _blocks(stream: IO[bytes]) -> Iterator[bytes | None]:
    """All bytes, as they come; `None` before waiting for more."""
    try:
        handle = stream.fileno()
    except UnsupportedOperation:  # a file of the memory's
        handle = -1
    regular = handle < 0 or stream.seekable()
    while True:
        if not regular and not _has_more(handle):
            yield None
        block = stream.read(BLOCK) if regular else stream.read1(BLOCK)  # type: ignore[attr-defined]
        if not block:
            return
        yield block


def _has_more(handle: int) -> bool:
    """Whether a pipe can be read without waiting; on Windows that cannot be asked of it."""
    try:
        return bool(select.select([handle], [], [], 0.0)[0])
    except OSError:
        return False


def read_header(stream: IO[bytes], file: str) -> tuple[tuple[str, ...], bytes]:
    """The names of a CSV file's columns, and the line that has them.

    Raises:
        ValueError: if the first line holds no names of columns.
    """
    line = stream.readline(LONGEST)
    try:
        names = next(csv.reader([line.removeprefix(SIGNATURE).decode()], strict=True), [])
    except (UnicodeDecodeError, csv.Error):
        names = []
    if not any(names):
        raise ValueError(f"{file}: the first line of a CSV file must name its columns.")
    return tuple(name.strip() for name in names), line


def names_others(stream: IO[bytes]) -> bool:
    """Whether a file of JSON lines has situations amid others or at heights; a pipe does not say.

    Answers in columns need to know before the first line is read.
    """
    try:
        with mmap(stream.fileno(), 0, access=ACCESS_READ) as text:
            return any(text.find(name) >= 0 for name in OTHERS)
    except (OSError, ValueError):  # a pipe, or empty
        return False


def parquet_chunks(file: "pyarrow.parquet.ParquetFile", at_once: int) -> Iterator[LineChunk]:
    """The rows of a Parquet file, each chunk as Arrow's stream of one batch."""
    import pyarrow as pa

    first = 1
    for batch in file.iter_batches(batch_size=at_once):
        sink = pa.BufferOutputStream()
        with pa.ipc.new_stream(sink, batch.schema) as writer:
            writer.write_batch(batch)
        yield LineChunk(first, batch.num_rows, sink.getvalue().to_pybytes(), batch.num_rows)
        first += batch.num_rows


def flat_names(schema: "pyarrow.Schema") -> Sequence[str]:
    """The columns of a Parquet file, those within a struct with a dot."""
    import pyarrow as pa

    names: list[str] = []
    for field in schema:
        if pa.types.is_struct(field.type):
            names += [f"{field.name}.{inner.name}" for inner in field.type]
        else:
            names.append(field.name)
    return names
