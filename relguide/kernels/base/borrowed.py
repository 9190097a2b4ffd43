"""Arrays whose references are not counted, for kernels that hand them on a million times.

Numba counts the references to each array of a tuple at every call that takes it, with instructions
that wait for other cores: a fifth of the time of a proof. A borrowed array is the same one, and
nobody counts. Whoever borrows must see to it that the array itself is kept meanwhile: it must be an
argument of his, or be used again after the last use of what was borrowed.

It still asks of every array whether somebody does: a tenth of the time of a proof. So a kernel that
makes no arrays and hands none back may be `uncounted`.
"""

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit
from numba.core import cgutils as numba_cgutils
from numba.core import types as numba_types
from numba.extending import intrinsic

cgutils: Any = numba_cgutils
types: Any = numba_types
_njit: Any = njit  # whose stubs do not name that option
_Kernel = TypeVar("_Kernel", bound=Callable[..., Any])


def _uncounted(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    """The same value, with no owner of its arrays."""
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        array.parent = cgutils.get_null_value(array.parent.type)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        parts = [
            _uncounted(context, builder, part, builder.extract_value(value, k))
            for k, part in enumerate(kind)
        ]
        return context.make_tuple(builder, kind, parts)
    return value


def _borrowing(_: Any, of: Any) -> Any:
    """An array, or a tuple with arrays in it, whose references are not counted."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _uncounted(context, builder, signature.args[0], arguments[0])

    return of(of), generate


borrowed: Any = intrinsic(_borrowing)


def uncounted(kernel: _Kernel) -> _Kernel:
    """Compile a kernel that counts no references.

    It may make no array nor hand one back, nor may what it calls: numba compiles that likewise.
    """
    compiled: _Kernel = _njit(cache=True, nogil=True, _nrt=False)(kernel)
    return compiled
