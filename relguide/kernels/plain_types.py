"""A kernel is compiled once for all integers, and not again for each that is written in a call.

In a call from compiled code numba gives a constant a type of its own, `Literal[int](0)`, and
compiles what is called for it again. That makes nothing faster, since LLVM knows the constants of
what it inlines, and takes a tenth of the time that the first flight waits for. So our kernels are
looked up by plain types.

numba offers no option for that. Explicit signatures would, but such kernels are compiled, or read
from disk, when they are imported: all of them, whatever is wanted. So its lookup is wrapped; the
versions of numba for which that is tested are those of `pyproject.toml`.
"""

from typing import Any

from numba.core import dispatcher as numba_dispatcher
from numba.core import types as numba_types

from relguide.kernels import cache

types: Any = numba_types
dispatcher: Any = numba_dispatcher
_of_any = dispatcher.Dispatcher.get_call_template


def _of_ours(self: Any, args: Any, kws: Any) -> Any:
    if self.py_func.__code__.co_filename.startswith(str(cache.HERE)):
        args = tuple(map(types.unliteral, args))
        kws = {name: types.unliteral(value) for name, value in kws.items()}
    return _of_any(self, args, kws)


dispatcher.Dispatcher.get_call_template = _of_ours
