"""answer_chunk(order, chunk) → Answered: what a process that plans does, in turn with others."""

import csv
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from io import StringIO
from typing import TYPE_CHECKING, Any, NamedTuple

import orjson

from relguide.cli.batch.order import BatchOrder
from relguide.cli.batch.source import LineChunk
from relguide.cli.proving import prove_after
from relguide.contract.bulk import Record, Wanted, answer_all
from relguide.contract.flat import Kind, answer_columns, cells_of_answers, situation_of_row
from relguide.contract.refusal import ContractError, decode
from relguide.learn.planners import make_planner

if TYPE_CHECKING:
    import pyarrow


class AnsweredChunk(NamedTuple):
    """The answers to a chunk."""

    content: bytes
    """As they are written into the file."""
    answers: int
    """How many."""
    invalid: int
    """How many lines are no situation."""
    first_invalid: int
    """The number of the first of those; 0 if there is none."""


def answer_chunk(order: BatchOrder, chunk: LineChunk) -> AnsweredChunk:
    """Answer each line of a chunk, in order."""
    answers = answer_all(_records(order, chunk), _wanted(order))
    wrong = [answer["line"] for answer in answers if answer["status"] == "invalid"]
    content = encode(order, answers)
    return AnsweredChunk(content, len(answers), len(wrong), wrong[0] if wrong else 0)


@cache
def _wanted(order: BatchOrder) -> Wanted:
    # no bar of its own: that of the batch goes on
    planner = prove_after(make_planner(order.planner), order.prove, shown=False)
    return Wanted(
        planner=planner, fields=order.fields, include=order.include, deadline=order.deadline
    )


# --- lines --------------------------------------------------------------------------------------


def _records(order: BatchOrder, chunk: LineChunk) -> Iterator[Record]:
    """What each line holds; blank ones are passed over."""
    if order.source == "parquet":
        yield from enumerate(_parquet_rows(chunk), start=chunk.first)
        return
    for number, line in enumerate(chunk.content.split(b"\n"), start=chunk.first):
        if line.strip():
            yield number, line if order.source == "jsonl" else _csv_row(line, order.header)


def _csv_row(line: bytes, header: Sequence[str]) -> dict[str, Any] | ContractError:
    """A line of CSV by itself: a quote that is not closed spoils no other line."""
    try:
        (cells,) = csv.reader([decode(line).rstrip("\r")], strict=True)
        if len(cells) == len(header):
            return situation_of_row(header, cells)
        message = f"This line must have {len(header)} cells, as the first has, not {len(cells)}."
    except csv.Error as error:
        message = f"This is not a line of CSV: {error}."
    except ContractError as error:
        return error
    return ContractError([("", message)])


def _parquet_rows(chunk: LineChunk) -> Iterator[object]:
    import pyarrow as pa

    with pa.ipc.open_stream(chunk.content) as stream:
        rows = stream.read_all().to_pylist()
    for row in rows:
        flat: dict[str, Any] = {}
        for name, cell in row.items():
            if isinstance(cell, dict):
                flat |= {f"{name}.{inner}": value for inner, value in cell.items()}
            else:
                flat[name] = cell
        try:
            yield situation_of_row(tuple(flat), tuple(flat.values()))
        except ContractError as error:
            yield error


# --- answers ------------------------------------------------------------------------------------


def encode(order: BatchOrder, answers: Sequence[Mapping[str, Any]]) -> bytes:
    """Answers as they are written into the file."""
    if order.to == "jsonl":
        return b"".join(
            [orjson.dumps(answer, option=orjson.OPT_APPEND_NEWLINE) for answer in answers]
        )
    columns = answer_columns(order.fields, order.include, amid=order.amid)
    cells = cells_of_answers(answers, columns)
    if order.to == "csv":
        return _csv_lines(zip(*cells, strict=True))
    return bytes(_batch(cells, columns, whole_ids=order.whole_ids).serialize())


def beginning(order: BatchOrder) -> bytes:
    """What a file of answers begins with."""
    if order.to == "jsonl":
        return b""
    columns = answer_columns(order.fields, order.include, amid=order.amid)
    if order.to == "csv":
        return _csv_lines([tuple(columns)])
    none = cells_of_answers([], columns)
    return bytes(_batch(none, columns, whole_ids=order.whole_ids).schema.serialize())


def _csv_lines(rows: Iterable[Sequence[Any]]) -> bytes:
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode()


def _batch(
    cells: Sequence[Sequence[Any]], columns: Mapping[str, Kind], *, whole_ids: bool
) -> "pyarrow.RecordBatch":
    """The cells of each column as Arrow's."""
    import pyarrow as pa

    types = {
        "number": pa.float64(),
        "whole": pa.int64(),
        "text": pa.string(),
        "truth": pa.bool_(),
        "json": pa.string(),
    }
    arrays = []
    for (name, kind), column in zip(columns.items(), cells, strict=True):
        if name == "id":
            kind = "whole" if whole_ids else "text"
            if not whole_ids:
                column = [None if cell is None else str(cell) for cell in column]
        arrays.append(pa.array(column, types[kind]))
    return pa.record_batch(arrays, names=list(columns))
