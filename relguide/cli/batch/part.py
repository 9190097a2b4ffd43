"""Part: answers on the way to their file, and how far they have come, so that no work is lost.

Answers are appended to `FILE.part`. Every two seconds `FILE.part.json` says how much of it counts
and how much of the input that answers; what comes after is cut off when a stopped run goes on. Both
are gone once FILE is there.
"""

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from hashlib import blake2b
from pathlib import Path
from time import monotonic
from typing import IO, Any

from relguide.cli.batch.order import BatchOrder
from relguide.cli.batch.source import LineChunk
from relguide.cli.batch.work import AnsweredChunk, beginning
from relguide.learn.training.files import expect_part, write_whole
from relguide.parallel.lock import lock
from relguide.units import Second

KEPT_EVERY: Second = 2.0
"""Between two records of how far it has come."""
FORMAT = "relguide-batch 1"
"""What a record calls itself."""
ROWS = 100_000
"""In a group of rows of Parquet, at least."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reached:
    """How far a run has come."""

    read: int = 0
    """How much of the input is answered: bytes, or rows of Parquet."""
    lines: int = 0
    digest: str = ""
    """Of the input so far."""
    written: int = 0
    """Bytes of the part that count."""
    answers: int = 0
    invalid: int = 0
    first_invalid: int = 0
    """The number of the first line that is no situation; 0 if there is none."""

    def after(self, chunk: LineChunk, answered: AnsweredChunk) -> "Reached":
        """Once a chunk is answered, and its answers are written."""
        return replace(
            self,
            read=self.read + chunk.size,
            lines=self.lines + chunk.lines,
            written=self.written + len(answered.content),
            answers=self.answers + answered.answers,
            invalid=self.invalid + answered.invalid,
            first_invalid=self.first_invalid or answered.first_invalid,
        )


class Part:
    """The part of a run: where its answers go, in order."""

    def __init__(
        self, stream: IO[bytes], record: Path, order: BatchOrder, reached: Reached
    ) -> None:
        self._stream, self._record, self._order = stream, record, order
        # one name for both: Ctrl-C may come between any two steps
        self._state = reached, blake2b()
        self._kept_at = monotonic()

    @property
    def reached(self) -> Reached:
        """How far it has come."""
        return self._state[0]

    def pass_over(self, content: bytes) -> None:
        """Take note of input that was answered before."""
        self._state[1].update(content)

    def check_input(self) -> None:
        """Once all that was answered is passed over: refuse an input that begins otherwise.

        Raises:
            ValueError: if it does.
        """
        reached, digest = self._state
        if reached.digest and digest.hexdigest() != reached.digest:
            raise ValueError(
                f"{self._stream.name} was made of another input: what it answers is not how this "
                "one begins."
            )

    def add(self, chunk: LineChunk, answered: AnsweredChunk) -> None:
        """Append the answers to a chunk."""
        self._stream.write(answered.content)
        digest = self._state[1].copy()
        digest.update(chunk.content)
        self._state = self.reached.after(chunk, answered), digest
        if monotonic() - self._kept_at > KEPT_EVERY:
            self.keep()

    def keep(self) -> None:
        """Record how far it has come, once that is on the disk."""
        self._stream.flush()
        os.fsync(self._stream.fileno())
        reached, digest = self._state
        reached = replace(reached, digest=digest.hexdigest())
        with write_whole(self._record) as stream:
            stream.write(json.dumps(_about(self._order) | {"reached": asdict(reached)}).encode())
        self._kept_at = monotonic()


@contextmanager
def open_part(file: Path, order: BatchOrder, *, resume: bool) -> Iterator[Part]:
    """The part of a run that begins, or of one that goes on; its record is kept to the end.

    Args:
        file: where the answers are to be once all are there.
        order: what is asked.
        resume: whether to go on with a part that is there.

    Raises:
        ValueError: if there is a part and it is not to be gone on with, or the other way round, or
            it was made for another order, or another process is writing it.
        OSError: if it cannot be written.
    """
    part, record = part_of(file), record_of(file)
    expect_part(part, resume=resume)
    reached = _load(record, order) if resume else None
    with part.open("r+b" if resume else "wb") as stream:
        lock(stream, f"{part} is being written by another run.")
        if reached is None:
            head = beginning(order)
            stream.write(head)
            reached = Reached(written=len(head))
        stream.truncate(reached.written)
        stream.seek(reached.written)
        found = Part(stream, record, order, reached)
        if not resume:
            found.keep()
        try:
            yield found
        finally:
            if found.reached is not reached:
                found.keep()


def finish_part(file: Path, order: BatchOrder) -> None:
    """Make a part that has all answers the file."""
    part = part_of(file)
    if order.to == "parquet":
        _write_parquet(part, file)
        part.unlink()
    else:
        os.replace(part, file)
    record_of(file).unlink()


def part_of(file: Path) -> Path:
    """Where answers are on the way to a file."""
    return file.with_name(f"{file.name}.part")


def record_of(file: Path) -> Path:
    """Where it is recorded how far they have come."""
    return file.with_name(f"{file.name}.part.json")


def _write_parquet(part: Path, file: Path) -> None:
    """Arrow's stream as Parquet, a few batches at a time."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    with part.open("rb") as stream, pa.ipc.open_stream(stream) as batches, write_whole(file) as out:
        with pq.ParquetWriter(out, batches.schema) as writer:
            some: list[pa.RecordBatch] = []
            for batch in batches:
                some.append(batch)
                if sum(one.num_rows for one in some) >= ROWS:
                    writer.write_table(pa.Table.from_batches(some))
                    some = []
            if some:
                writer.write_table(pa.Table.from_batches(some))


def _about(order: BatchOrder) -> dict[str, Any]:
    return {"format": FORMAT, "order": json.loads(json.dumps(asdict(order)))}


def _load(record: Path, order: BatchOrder) -> Reached:
    """How far a stopped run had come.

    Raises:
        ValueError: if that is not known, or it was asked for something else.
    """
    try:
        about = json.loads(record.read_bytes())
        reached = Reached(**about.pop("reached"))
    except (FileNotFoundError, KeyError, TypeError, ValueError):
        raise ValueError(f"{record} does not say how far the stopped run had come.") from None
    if about != _about(order):
        raise ValueError(
            f"{record.with_suffix('')} is of a run that was asked for something else: go on with "
            "the options it was begun with."
        )
    return reached
