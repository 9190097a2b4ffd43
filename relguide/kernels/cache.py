"""Where compiled kernels are kept, and when they are out of date.

Numba keeps the machine code of a function with a stamp of the function's own file. But a kernel's
machine code holds that of the kernels it calls, which live in other files: change one of those, or
install another version over this one, and numba would go on running what was. So here the stamp is
one of a file and all files of ours that it imports. Numba asks the class below first.

They are kept in `NUMBA_CACHE_DIR` if that is set, else beside the sources, else in the user's own
cache: in the first that can be written, or that holds all kernels and can be read (another user's
installation, a container with a read-only disk). Where there is none, they are kept in a temporary
folder until the process ends, and `kernels/compiling.py` says so.

A folder also holds records: which steps of `relguide.warm_up` were compiled into it, and for what.
A wheel may bring kernels compiled for any CPU of its kind (`SHIPPED`): `adopt` makes them this
machine's own.
"""

import atexit
import json
import os
import pickle
import re
import sys
from collections.abc import Collection, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from functools import cache
from hashlib import sha256
from itertools import count
from pathlib import Path
from shutil import rmtree
from tempfile import TemporaryFile, mkdtemp
from typing import Any, Self

from numba import __version__ as numba_version
from numba.core import caching as numba_caching
from numba.core import serialize as numba_serialize
from numba.core.caching import CacheImpl, InTreeCacheLocator, UserWideCacheLocator
from numba.core.registry import cpu_target

try:
    import fcntl
except ImportError:  # Windows: there only one process at a time should compile
    fcntl = None  # type: ignore[assignment]

HERE = Path(__file__).parent
"""The kernels' sources."""
SHIPPED = HERE / "compiled"
"""Kernels that came with the wheel, if it brought any."""
IMPORT = re.compile(
    rb"^from relguide\.(?:(kernels(?:\.\w+){2,}|units) import"
    rb"|(kernels(?:\.\w+)+) import (\w+) as )",
    re.MULTILINE,
)
"""How our files name what they are made of."""
FORMAT = b"4"
"""Of what is kept: kernels kept in another format are compiled anew. Since 4 each has a digest."""
RECORD = ".warm"
"""How the name of a record ends."""
ADOPTED = "adopted"
"""The record of what has been taken over from a wheel."""
EVERYTHING = "everything"
"""The record of a folder that holds all kernels."""
SHARED = "_RELGUIDE_TEMPORARY_KERNELS"
"""The variable that names the temporary folder to the processes that this one starts."""
ANY_CPU = ["generic", ""]
"""What numba calls a CPU with no more than all of its kind have: its name and features."""
UNREADABLE = (
    ImportError,
    AttributeError,
    EOFError,
    LookupError,
    TypeError,
    ValueError,
    pickle.UnpicklingError,
)
"""What comes of reading an index that is damaged, or of another version."""

caching: Any = numba_caching
serialize: Any = numba_serialize


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
        return stamp((Path(self._py_file),))

    def ensure_cache_path(self) -> None:
        """Nothing to do: `folder` has looked."""


class LockedIndex(caching.IndexDataCacheFile):  # type: ignore[misc]
    """Numba's index of one function's machine code, safe where several processes compile.

    Numba reads the index, picks the next free number for a file, writes the index and then the
    file. Two processes that compile the same function for different types could pick the same
    number; and one that reads in between, or after a process that was killed in between, could find
    machine code of older sources, whose arguments may be others. So one process at a time does
    that, and an index never names a file that is not written yet.
    """

    def save(self, key: Any, data: Any) -> None:
        """Store the machine code for one signature; on a read-only disk it is for this process."""
        with self._alone(), suppress(OSError):
            known = self._load_index()
            if not known:  # what names files of older sources, which are overwritten now
                Path(self._index_path).unlink(missing_ok=True)
            name = known.get(key) or self._free_name(known.values())
            self._save_data(name, data)
            self._save_index({**known, key: name})

    def load(self, key: Any) -> Any:
        """The machine code for one signature, if it is there."""
        with self._alone():
            return super().load(key)

    def _free_name(self, taken: Collection[str]) -> str:
        names = map(self._data_name, count(1))
        return next(str(name) for name in names if name not in taken)

    def _load_index(self) -> Any:
        """What the index holds; nothing if it was cut short, or names types that are no more.

        An index of another version may: a folder of kernels outlives the sources it is of.
        """
        try:
            return super()._load_index()
        except UNREADABLE:
            return {}

    def _alone(self) -> AbstractContextManager[None]:
        place = Path(self._cache_path)
        return _lock(place) if place == folder() else nullcontext()


@cache
def folder() -> Path:
    """Where kernels are kept."""
    for place in places():
        if _can_write(place) or is_full(place):
            return place
    if SHARED in os.environ:
        return Path(os.environ[SHARED])
    try:
        place = Path(mkdtemp(prefix="relguide-"))
    except OSError:
        sentence = "Compiled kernels can be kept nowhere: set NUMBA_CACHE_DIR to a writable folder."
        raise OSError(sentence) from None
    os.environ[SHARED] = str(place)
    atexit.register(_remove, place, os.getpid())
    return place


def is_kept(place: Path) -> bool:
    """Whether what is compiled into a folder is there at the next start."""
    return str(place) != os.environ.get(SHARED)


def _remove(place: Path, owner: int) -> None:
    if os.getpid() == owner:  # not in a process forked from it
        rmtree(place, ignore_errors=True)


def is_full(place: Path) -> bool:
    """Whether a folder holds every kernel, of these sources and for this machine."""
    return is_warm(EVERYTHING, place)


def is_warm(step: str, place: Path) -> bool:
    """Whether a folder holds the kernels of a step, of these sources and for this machine."""
    return _read_record(step, place) == _expected_record()


def record(steps: Iterable[str], place: Path) -> None:
    """Note that a folder holds the kernels of some steps."""
    for step in steps:
        _write(_record(step, place), json.dumps(_expected_record()).encode())


def adopt(shipped: Path = SHIPPED) -> None:
    """Take over kernels that a wheel brought, once, if they are of these sources and this numba.

    Numba files machine code under the name of the CPU it was compiled for, and runs no other. What
    is compiled for any CPU of this kind runs on this one, so it is filed under this one's name.
    All modules of kernels must be importable: their types are named in the index.
    """
    offered, place = _read_record(EVERYTHING, shipped), folder()
    if offered is None or shipped == place or _read_record(ADOPTED, place) == offered:
        return
    with _lock(place):
        if offered == [*_expected_record()[:-2], *ANY_CPU] and not is_full(place):
            for index in sorted(shipped.glob("*.nbi")):
                _adopt_function(index, place)
            for file in shipped.glob(f"*{RECORD}"):
                _write(place / file.name, json.dumps(_expected_record()).encode())
        _write(_record(ADOPTED, place), json.dumps(offered).encode())


def _adopt_function(index: Path, place: Path) -> None:
    """The machine code of one function, as numba's `IndexDataCacheFile` writes it."""
    machine = tuple(_expected_record()[-3:])
    with index.open("rb") as file:
        version = pickle.load(file)
        stamp, overloads = pickle.load(file)
    (place / index.name).unlink(missing_ok=True)
    own = {(signature, machine, code): name for (signature, _, code), name in overloads.items()}
    for name in own.values():
        _write(place / name, (index.parent / name).read_bytes())
    head = pickle.dumps(version, protocol=-1)
    _write(place / index.name, head + serialize.dumps((stamp, own)))


@cache
def _expected_record() -> list[str]:
    machine = cpu_target.target_context.codegen().magic_tuple()
    sources = stamp(tuple(sorted(HERE.rglob("*.py"))))
    return [sources, numba_version, str(sys.implementation.cache_tag), *map(str, machine)]


def _record(step: str, place: Path) -> Path:
    return place / f"{step}{RECORD}"


def _read_record(step: str, place: Path) -> object:
    try:
        return json.loads(_record(step, place).read_text())
    except (OSError, ValueError):
        return None


@cache
def stamp(files: tuple[Path, ...]) -> str:
    """A digest of files and of all that they import, directly or not."""
    seen: set[Path] = set()
    pending = list(files)
    while pending:
        file = pending.pop()
        if file not in seen:
            seen.add(file)
            pending += _digest_and_imports(file)[1]
    digest = sha256(FORMAT)
    for file in sorted(seen):
        digest.update(_digest_and_imports(file)[0])
    return digest.hexdigest()


@cache
def _digest_and_imports(file: Path) -> tuple[bytes, tuple[Path, ...]]:
    """The digest of one file, and the files of ours that it names."""
    text = file.read_bytes()
    found = (match[1] or b".".join(match.groups()[1:]) for match in IMPORT.finditer(text))
    names = {name.decode().replace(".", "/") for name in found}
    place = file.relative_to(HERE.parent).as_posix()  # machine code names its modules
    digest = sha256(place.encode() + b"\0" + text).digest()
    return digest, tuple(HERE.parent / f"{name}.py" for name in sorted(names))


def places() -> list[Path]:
    """Where kernels may be kept, the best place first."""
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


def _write(file: Path, content: bytes) -> None:
    """Write a file whole or not at all, whoever reads it meanwhile."""
    new = file.with_name(f"{file.name}.{os.getpid()}")
    new.write_bytes(content)
    os.replace(new, file)


@contextmanager
def _lock(place: Path) -> Iterator[None]:
    """Keep other processes out of a folder meanwhile."""
    if fcntl is None:
        yield
        return
    lock = os.open(place, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)


CacheImpl._locator_classes.insert(0, KernelLocator)
