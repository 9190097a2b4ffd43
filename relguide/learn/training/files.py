"""Files of this package: written whole or not at all, and read as plain arrays and one text.

A file is written beside its name and then moved there: a reader never meets half of one. What a
stopped run can go on from lies in another, named `.part`.
"""

import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, TypeVar
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from relguide.learn.training.tensor_file import pack, unpack

T = TypeVar("T")


@contextmanager
def write_whole(file: Path) -> Iterator[IO[bytes]]:
    """A stream to write a file by, which has its name once all is written."""
    beside = file.with_name(file.name + ".new")
    with beside.open("wb") as stream:
        yield stream
    os.replace(beside, file)


def save_columns(file: Path, about: Mapping[str, Any], columns: Mapping[str, NDArray[Any]]) -> None:
    """Write an .npz file: arrays, and a JSON text `about` that says the rest."""
    content: dict[str, Any] = {"about": np.array(json.dumps(about, ensure_ascii=False)), **columns}
    with write_whole(file) as stream:
        np.savez(stream, **content)


def load_columns(
    file: Path, kind: str, names: tuple[str, ...], refusal: str
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Read an .npz file; never pickled objects.

    Args:
        file: to read.
        kind: what it must say it is, by `file` in its text.
        names: of the arrays wanted.
        refusal: what to say, behind its name, of a file that is not of this kind.

    Raises:
        ValueError: if it is not an .npz file, or of another kind.
    """
    try:
        with file.open("rb") as stream, np.load(stream, allow_pickle=False) as content:
            about: dict[str, Any] = json.loads(str(content["about"]))
            found = about["file"]
            columns = {name: content[name] for name in names} if found == kind else {}
    # numpy says ValueError of what is no .npz file at all, and of pickled objects
    except (KeyError, TypeError, ValueError, EOFError, BadZipFile):
        raise ValueError(f"{file} {refusal}") from None
    if found != kind:
        raise ValueError(f"{file} is a file of another kind: {found}, not {kind}.")
    return about, columns


def save_weights(file: Path, about: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write a .safetensors file: arrays, and a JSON text `about` in its header."""
    with write_whole(file) as stream:
        stream.write(pack(arrays, {"about": json.dumps(about, ensure_ascii=False)}))


def load_weights(
    file: Path, network: Callable[[dict[str, Any], dict[str, NDArray[Any]]], T], refusal: str
) -> T:
    """Read a .safetensors file, and make a network of it.

    Args:
        file: to read.
        network: makes it of the text and the arrays; a LookupError, TypeError or ValueError of its
            says that this file holds none.
        refusal: what to say of a file that holds none, behind its name.

    Raises:
        ValueError: if it holds none.
    """
    content = file.read_bytes()
    try:
        metadata, arrays = unpack(content)
        return network(json.loads(metadata["about"]), arrays)
    except (LookupError, TypeError, ValueError):
        raise ValueError(f"{file} {refusal}") from None


def expect_part(part: Path, *, resume: bool) -> None:
    """Refuse to begin where a stopped run has left something, and to resume where nothing was left.

    Raises:
        ValueError: saying what to do instead.
    """
    if resume and not part.exists():
        raise ValueError(f"There is nothing to resume: {part} does not exist.")
    if part.exists() and not resume:
        raise ValueError(
            f"{part} is left from a run that was stopped: --resume goes on with it; delete it to "
            "begin anew."
        )
