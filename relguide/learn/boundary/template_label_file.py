"""Labels of situations in which the limit binds, and labels still being made, as files.

What is still being made is a row of arrays: the request as JSON, then number and columns of each
chunk. A run that was stopped leaves half a chunk at its end, which is written over.
"""

import json
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import asdict
from pathlib import Path
from typing import IO, Any

import numpy as np

from relguide.learn.boundary.template_labels import (
    SOURCES,
    TemplateLabelRequest,
    TemplateLabels,
    from_columns,
    make_template_labels,
)
from relguide.learn.training.files import expect_part, load_columns, save_columns

FILE = "relguide limit labels 1"
"""What a file says it is, with the version of its columns."""
COLUMNS = ("situations", "times_r_per_v", "counts", "legs", "sources")
NONE = "holds no labels of relguide dataset --method templates, or is cut short."
"""What is said of a file that is not one."""


def save_template_labels(
    labels: TemplateLabels, request: TemplateLabelRequest, provenance: dict[str, str], file: Path
) -> None:
    """Write labels, and how they were made."""
    about = {
        "file": FILE,
        "request": asdict(request),
        "sources": SOURCES,
        "provenance": provenance,
    }
    save_columns(file, about, dict(zip(COLUMNS, labels.columns(), strict=True)))


def load_template_labels(file: Path) -> tuple[TemplateLabels, dict[str, Any]]:
    """Read labels, and what the file says of itself.

    Raises:
        ValueError: if the file does not hold labels.
    """
    about, columns = load_columns(file, FILE, COLUMNS, NONE)
    labels = from_columns(*(columns[name] for name in COLUMNS))
    n = len(labels)
    shapes = ((n, 6), (n, 3), (n,), (n, *labels.legs.shape[1:2], 6), (n,))
    if n == 0 or tuple(column.shape for column in labels.columns()) != shapes:
        raise ValueError(f"{file}: its columns do not fit together; make the labels again.")
    return labels, about


def grow_template_labels(
    request: TemplateLabelRequest, part: Path, executor: Executor, *, resume: bool
) -> Iterator[tuple[int, TemplateLabels]]:
    """Make labels, and write every chunk down as it is ready.

    Args:
        request: what to make.
        part: where to; it stays, until the caller has all.
        executor: where they are made.
        resume: go on from what a stopped run left in `part`; the result is the same.

    Yields:
        number and labels of each chunk, those that were there first.

    Raises:
        ValueError: if `part` is not what `resume` says, or was begun with another request.
    """
    expect_part(part, resume=resume)
    with part.open("r+b" if resume else "w+b") as stream:
        begun = _whole_chunks(stream, request, part) if resume else {}
        if not resume:
            np.save(stream, np.array(json.dumps(asdict(request))))
            stream.flush()
        yield from begun.items()
        for number, labels in make_template_labels(request, executor, made=frozenset(begun)):
            np.save(stream, np.array(number))
            for column in labels.columns():
                np.save(stream, column)
            stream.flush()
            yield number, labels


def _whole_chunks(
    stream: IO[bytes], request: TemplateLabelRequest, part: Path
) -> dict[int, TemplateLabels]:
    """The chunks a stopped run left; the stream then stands behind the last whole one."""
    chunks: dict[int, TemplateLabels] = {}
    end = 0
    asked = None
    while True:
        try:
            if asked is None:
                asked = str(np.load(stream, allow_pickle=False))
            else:
                number = int(np.load(stream, allow_pickle=False))
                columns = [np.load(stream, allow_pickle=False) for _ in COLUMNS]
                chunks[number] = from_columns(*columns)
            end = stream.tell()
        except (EOFError, ValueError, TypeError):
            break
    if asked != json.dumps(asdict(request)):
        raise ValueError(
            f"{part} was begun with another request: give the same, or delete it to begin anew."
        )
    stream.seek(end)
    stream.truncate()
    return chunks
