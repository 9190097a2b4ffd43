"""Where compiled kernels are kept, and when they are out of date.

Numba keeps the machine code of a function with a stamp of the function's own file. But a kernel's
machine code holds that of the kernels it calls, which live in other files: change one of those, or
install another version over this one, and numba would go on running what was. So here the stamp is
one of a file and all files of ours that it imports. Numba asks the class below first.

They are kept in `NUMBA_CACHE_DIR` if that is set, else beside the sources, else in the user's own
cache: in the first that can be written, or that `python -m relguide.warm_up` has filled and that
can be read (another user's installation, a container with a read-only disk).
"""

import json
import os
import re
from functools import cache
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryFile, mkdtemp
from typing import Any, Self

from numba import __version__ as numba_version
from numba.core.caching import CacheImpl, InTreeCacheLocator, UserWideCacheLocator
from numba.core.registry import cpu_target

HERE = Path(__file__).parent
"""The kernels' sources."""
RECORD = "relguide-kernels.json"
"""The file that says for what a folder has been filled."""
IMPORT = re.compile(rb"^from relguide\.(kernels\.\w+\.\w+|units) import", re.MULTILINE)
"""How our files name what they are made of."""


class KernelLocator(InTreeCacheLocator):
    """Tells numba where a kernel's machine code is kept."""

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> Self | None:
        """For our own files; numba's other classes see to all the rest."""
        if not py_file.startswith(str(HERE)):
            return None
        self = cls(py_func, py_file)
        self._cache_path = str(folder())
        return self

    def get_source_stamp(self) -> str:
        """Changes with whatever the kernel is made of."""
        return _stamp((Path(self._py_file),))

    def ensure_cache_path(self) -> None:
        """Nothing to do: `folder` has looked."""


@cache
def folder() -> Path:
    """Where kernels are kept."""
    for place in _places():
        if _can_write(place) or filled(place):
            return place
    try:
        return Path(mkdtemp(prefix="relguide-"))  # compiled for this process alone
    except OSError:
        sentence = "Compiled kernels can be kept nowhere: set NUMBA_CACHE_DIR to a writable folder."
        raise OSError(sentence) from None


def filled(place: Path) -> bool:
    """Whether a folder holds every kernel, of these sources and for this machine."""
    try:
        return bool(json.loads((place / RECORD).read_text()) == _wanted())
    except (OSError, ValueError):
        return False


def record(place: Path) -> None:
    """Note that a folder holds every kernel."""
    (place / RECORD).write_text(json.dumps(_wanted()))


def _wanted() -> list[str]:
    machine = cpu_target.target_context.codegen().magic_tuple()
    return [_stamp(tuple(sorted(HERE.rglob("*.py")))), numba_version, *map(str, machine)]


@cache
def _stamp(files: tuple[Path, ...]) -> str:
    """A digest of files and of all that they import, directly or not."""
    seen: set[Path] = set()
    pending = list(files)
    while pending:
        file = pending.pop()
        if file not in seen:
            seen.add(file)
            pending += _made_of(file)[1]
    digest = sha256()
    for file in sorted(seen):
        digest.update(_made_of(file)[0])
    return digest.hexdigest()


@cache
def _made_of(file: Path) -> tuple[bytes, tuple[Path, ...]]:
    """The digest of one file, and the files of ours that it names."""
    text = file.read_bytes()
    names = {match[1].decode().replace(".", "/") for match in IMPORT.finditer(text)}
    digest = sha256(file.name.encode() + b"\0" + text).digest()
    return digest, tuple(HERE.parent / f"{name}.py" for name in sorted(names))


def _places() -> list[Path]:
    users: Any = UserWideCacheLocator
    beside = [HERE / "__pycache__", Path(users(_can_write, __file__).get_cache_path())]
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    return [Path(chosen) / "relguide", *beside] if chosen else beside


def _can_write(place: Path) -> bool:
    try:
        place.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=place):
            return True
    except OSError:
        return False


CacheImpl._locator_classes.insert(0, KernelLocator)
