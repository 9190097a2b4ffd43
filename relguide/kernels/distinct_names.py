"""Machine code compiled in one process may be linked with that of another, so names must differ.

Numba numbers the functions of a process from 1 on and makes the number part of their names. The
functions it writes itself as closures, as both kinds of `quicksort` for `sort` and `argsort`, have
no other difference. Kernels read from disk bring the code of what they call; if two of them were
compiled by different processes, the same name may mean different code, and the linker keeps one:
a kernel then sorts where it should have ranked, and the process dies. So the numbers of a process
begin at random.
"""

from itertools import count
from secrets import randbits
from typing import Any

from numba.core import bytecode as numba_bytecode

bytecode: Any = numba_bytecode
bytecode.FunctionIdentity._unique_ids = count(randbits(48))
