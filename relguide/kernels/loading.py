"""A kernel's machine code is read from disk without all that numba imports to compile anything.

Before it reads machine code, numba imports what can be compiled: lists, sets, random numbers,
linear algebra with scipy. With the code it reads the name of the module of each function that was
called, and imports that too. Code that is there needs none of this to run: of a module it would
take the globals of functions that work on Python objects, and no kernel is one. That was a third of
the time that `relguide plan` takes to start. If something is to be compiled after all, numba then
imports what it needs.

Numba offers no option for that. So what it does is wrapped, for our own kernels; the versions of
numba for which that is tested are those of `pyproject.toml`.
"""

import pickle
import sys
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

from numba.core import caching as numba_caching
from numba.core import environment as numba_environment
from numba.core import runtime as numba_runtime

from relguide.kernels.apart import StaleCalleeError
from relguide.kernels.cache import KernelLocator, LockedIndex, folder

caching: Any = numba_caching
environment: Any = numba_environment
runtime: Any = numba_runtime
_load_any = caching.Cache.load_overload


def _rebuild_environment(module: str, constants: list[Any], name: str) -> Any:
    """As numba's function of that name, but no module is imported."""
    known = environment.lookup_environment(name)
    if known is not None:
        return known
    imported = sys.modules.get(module)
    # numba asks for the name alone, should it write the machine code of a caller to disk
    built = environment.Environment(vars(imported) if imported else {"__name__": module})
    built.consts[:] = constants
    built.env_name = name
    environment.Environment._memo[name] = built
    return built


class _Unpickler(pickle.Unpickler):
    """Reads the machine code of kernels."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) == (environment.__name__, "_rebuild_env"):
            return _rebuild_environment
        return super().find_class(module, name)


class KernelIndex(LockedIndex):
    """As `LockedIndex`; of our own kernels no module is imported for what they call.

    Each file begins with a digest. One that is damaged, as by a power cut, counts as missing.
    """

    def _save_data(self, name: str, data: Any) -> None:
        if Path(self._cache_path) != folder():
            super()._save_data(name, data)
            return
        content = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(_digest(name, content) + content)

    def _load_data(self, name: str) -> Any:
        place = Path(self._cache_path)
        if place != folder():
            return super()._load_data(name)
        whole = (place / name).read_bytes()
        digest, content = whole[:DIGEST], whole[DIGEST:]
        if digest != _digest(name, content):
            raise OSError(f"{name} is damaged.")  # numba compiles what it cannot read
        return _Unpickler(BytesIO(content)).load()


DIGEST = 32
"""Its length [bytes]."""


def _digest(name: str, content: bytes) -> bytes:
    return sha256(name.encode() + b"\0" + content).digest()


def _load_ours(self: Any, signature: Any, target: Any) -> Any:
    if not isinstance(self._impl.locator, KernelLocator):
        return _load_any(self, signature, target)
    runtime.rtsys.initialize(target)  # who counts the references to arrays
    try:
        with self._guard_against_spurious_io_errors():
            return self._load_overload(signature, target)
    except StaleCalleeError:
        return None  # so it is compiled anew


caching.IndexDataCacheFile = KernelIndex
caching.Cache.load_overload = _load_ours
