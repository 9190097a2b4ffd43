"""Locks on files: one run at a time writes what another would spoil."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

try:
    import fcntl
except ImportError:  # Windows: there nobody else should write the same file
    fcntl = None  # type: ignore[assignment]


def lock(stream: IO[Any], refusal: str) -> None:
    """Keep other runs out as long as this process has the file open.

    Raises:
        ValueError: with this sentence, if one has it.
    """
    if fcntl is None:
        return
    try:
        fcntl.lockf(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise ValueError(refusal) from None


@contextmanager
def locked(file: Path, refusal: str) -> Iterator[None]:
    """Keep other runs out meanwhile, by a file that is there for nothing else."""
    with file.open("w") as stream:
        lock(stream, refusal)
        yield
