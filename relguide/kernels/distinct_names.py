"""What a function is called in machine code: the same in every process if it is ours, else not.

Numba numbers the functions of a process from 1 on and makes the number part of their names. But
code that one process compiled runs beside that of another.

- A kernel calls another one by name (`apart.py`), so its number is a digest of what it is made of
  and where it stands.
- The functions numba writes itself as closures, as both kinds of `quicksort` for `sort` and
  `argsort`, have no other difference than their number. If two of them were compiled by different
  processes, the same name may mean different code, and the linker keeps one: a kernel then sorts
  where it should have ranked, and the process dies. So the numbers of a process begin at random.
"""

from hashlib import sha256
from itertools import count
from pathlib import Path
from secrets import randbits
from typing import Any

from numba.core import bytecode as numba_bytecode

from relguide.kernels import cache

bytecode: Any = numba_bytecode
OURS = "relguide.kernels."
"""How the names of our modules begin."""
_any_identity = bytecode.FunctionIdentity.from_function.__func__


def _identity(cls: Any, function: Any) -> Any:
    """As numba's, with a number of ours for ours."""
    self = _any_identity(cls, function)
    if self.modname.startswith(OURS) and self.func.__closure__ is None:
        self.unique_id = number(Path(self.filename), self.func_qualname, self.firstlineno)
        self.unique_name = f"{self.func_qualname}${self.unique_id}"
    return self


def number(file: Path, name: str, line: int) -> int:
    """48 bits that no other function of ours has, in any version of it."""
    digest = sha256(f"{cache.stamp((file,))} {name} {line}".encode()).digest()
    return int.from_bytes(digest[:6], "big")


bytecode.FunctionIdentity._unique_ids = count(randbits(48))
bytecode.FunctionIdentity.from_function = classmethod(_identity)
