"""answer_file(…): every line of a file answered, to a file or to standard output."""

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from itertools import chain
from pathlib import Path
from time import monotonic
from typing import IO, NamedTuple

from relguide.cli.batch.order import BatchOrder
from relguide.cli.batch.part import Part, Reached, finish_part, open_part, part_of
from relguide.cli.batch.source import (
    BLOCK,
    LineChunk,
    flat_names,
    names_others,
    parquet_chunks,
    read_header,
    text_chunks,
)
from relguide.cli.batch.work import AnsweredChunk, answer_chunk, beginning
from relguide.cli.output import DONE, FAILED, say, write
from relguide.cli.situation_file import open_input
from relguide.cli.workers import start_workers
from relguide.contract.flat import check_columns, is_amid
from relguide.parallel.in_order import in_order
from relguide.parallel.pool import start_processes
from relguide.planning.extras import need
from relguide.planning.progress import progress_bar

STANDARD_INPUT = "-"


class OpenSource(NamedTuple):
    """A file of situations that is open."""

    order: BatchOrder
    """With what the file says of itself."""
    size: int
    """Bytes, or rows of Parquet; 0 if that is not known."""
    skip: Callable[[Part], None]
    """Pass over what is answered in a part."""
    chunks: Callable[[Reached], Iterator[LineChunk | None]]
    """What comes after that."""


class BatchWorkers(NamedTuple):
    """Where chunks are answered."""

    processes: int
    """Of this machine."""
    scheduler: str | None
    """Of a Dask cluster, which then does it all."""


def answer_file(
    file: str, out: Path | None, order: BatchOrder, workers: BatchWorkers, *, resume: bool
) -> int:
    """Answer every line of a file.

    Args:
        file: situations; - for standard input.
        out: where the answers go; to standard output if it is `None`.
        order: what is asked.
        workers: who answers.
        resume: whether to go on with what a stopped run left beside `out`.

    Returns:
        the exit status: 1 if a line is no situation.
    """
    started = monotonic()
    with _open_source(file, order) as source:
        if out is None:
            write(beginning(source.order).decode())
            reached = Reached()
            for chunk, answered in _answers(source, reached, workers):
                write(answered.content.decode())
                reached = reached.after(chunk, answered)
        else:
            with open_part(out, source.order, resume=resume) as part:
                source.skip(part)
                part.check_input()
                try:
                    for chunk, answered in _answers(source, part.reached, workers):
                        part.add(chunk, answered)
                except KeyboardInterrupt:
                    say(f"What is done is in {part_of(out)}: --resume goes on with it.")
                    raise
            reached = part.reached
            finish_part(out, source.order)
            noun = "answer" if reached.answers == 1 else "answers"
            write(f"{out}: {reached.answers:,} {noun}, in {monotonic() - started:.1f} s.\n")
    if reached.invalid:
        noun = "line is" if reached.invalid == 1 else "lines are"
        first = reached.first_invalid
        say(f"{reached.invalid} {noun} no valid situation, the first is line {first}.")
        if 1 < reached.invalid == reached.answers:
            say(f"If {file} is one situation, leave --batch out.")
    return FAILED if reached.invalid else DONE


def _answers(
    source: OpenSource, reached: Reached, workers: BatchWorkers
) -> Iterator[tuple[LineChunk, AnsweredChunk]]:
    """The answers to all chunks from there on, in order, with a bar."""
    order, chunks = source.order, source.chunks(reached)
    with progress_bar("planning", total=source.size) as advance, ExitStack() as stack:
        advance(reached.read)
        if workers.scheduler is not None:
            executor = stack.enter_context(start_workers(None, workers.scheduler))
            found = in_order(partial(answer_chunk, order), chunks, executor, 1)
        else:
            found = _answer_here(order, chunks, workers.processes, stack)
        for chunk, answered in found:
            yield chunk, answered
            advance(chunk.size)


def _answer_here(
    order: BatchOrder, chunks: Iterator[LineChunk | None], processes: int, stack: ExitStack
) -> Iterator[tuple[LineChunk, AnsweredChunk]]:
    """The first chunk in this process, which loads the kernels; the others in copies of it."""
    loaded = False
    for chunk in chunks:
        if chunk is None:
            continue
        if loaded and processes > 1:
            executor = stack.enter_context(start_processes(processes))
            task = partial(answer_chunk, order)
            yield from in_order(task, chain((chunk,), chunks), executor, processes)
            return
        yield chunk, answer_chunk(order, chunk)
        loaded = True


@contextmanager
def _open_source(file: str, order: BatchOrder) -> Iterator[OpenSource]:
    """A file of situations, and the order with what the file says of itself."""
    if order.source == "parquet":
        with _open_parquet(file, order) as source:
            yield source
        return
    with open_input(file) as stream:
        size = os.fstat(stream.fileno()).st_size if file != STANDARD_INPUT else 0
        head = b""
        if order.source == "csv":
            header, head = read_header(stream, file)
            check_columns(header, file)
            order = replace(order, header=header, amid=is_amid(header))
        elif order.to != "jsonl":
            order = replace(order, amid=names_others(stream))
        yield _text_source(stream, order, size, head)


def _text_source(stream: IO[bytes], order: BatchOrder, size: int, head: bytes) -> OpenSource:
    def skip(part: Part) -> None:
        left = part.reached.read
        while left > 0 and (block := stream.read(min(left, BLOCK))):
            part.pass_over(block)
            left -= len(block)

    def chunks(reached: Reached) -> Iterator[LineChunk | None]:
        first = (1 if head else 0) + reached.lines + 1
        return text_chunks(stream, first, order.at_once)

    return OpenSource(order, max(size - len(head), 0), skip, chunks)


@contextmanager
def _open_parquet(file: str, order: BatchOrder) -> Iterator[OpenSource]:
    need("pyarrow")
    import pyarrow as pa
    import pyarrow.parquet as pq

    if file == STANDARD_INPUT:
        raise ValueError("Parquet is not read from standard input: name a file.")
    try:
        opened = pq.ParquetFile(file)
    except pa.ArrowInvalid as error:
        raise ValueError(f"{file} is no Parquet file: {error}.") from None
    with opened:
        schema = opened.schema_arrow
        names = flat_names(schema)
        check_columns(names, file)
        whole = "id" in schema.names and pa.types.is_integer(schema.field("id").type)
        order = replace(order, whole_ids=whole, amid=is_amid(names))
        rows = parquet_chunks(opened, order.at_once)

        def skip(part: Part) -> None:
            left = part.reached.read
            while left > 0 and (chunk := next(rows, None)):
                part.pass_over(chunk.content)
                left -= chunk.size

        yield OpenSource(order, opened.metadata.num_rows, skip, lambda reached: rows)
