"""A steady clock that kernels read while they work, so that a search can stop when its time is up.

A reading takes some 25 ns. Python reads the same clock by `now`, and hands kernels the time at
which they are to stop; without one they read no clock at all, and depend on nothing but numbers.
"""

import ctypes
import sys
from math import inf
from typing import Any

from llvmlite import ir as llvm
from numba import njit
from numba.core import cgutils as numba_cgutils
from numba.core import types as numba_types
from numba.extending import intrinsic

ir: Any = llvm
cgutils: Any = numba_cgutils
types: Any = numba_types

_INT, _LONG, _DOUBLE = ir.IntType(32), ir.IntType(64), ir.DoubleType()


def _ticks_per_second() -> int:
    """Of the counter that Windows has."""
    ticks = ctypes.c_int64()
    ctypes.CDLL("kernel32").QueryPerformanceFrequency(ctypes.byref(ticks))
    return ticks.value


if sys.platform == "win32":
    _NAME, _ARGUMENTS, _PER_SECOND = "QueryPerformanceCounter", (), _ticks_per_second()
else:
    # CLOCK_MONOTONIC; into seconds, and nanoseconds
    _NAME, _ARGUMENTS = "clock_gettime", (_INT(6 if sys.platform == "darwin" else 1),)
    _PER_SECOND = 1


def _reading(_: Any) -> Any:
    """The clock's count in seconds, by a call into the C library: numba has none of its own."""

    def generate(_context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
        counts = cgutils.alloca_once(builder, ir.ArrayType(_LONG, 2))
        builder.store(ir.Constant(ir.ArrayType(_LONG, 2), [0, 0]), counts)
        first = builder.gep(counts, [_INT(0), _INT(0)])
        second = builder.gep(counts, [_INT(0), _INT(1)])
        function = ir.FunctionType(_INT, [*(a.type for a in _ARGUMENTS), _LONG.as_pointer()])
        read = cgutils.get_or_insert_function(builder.module, function, _NAME)
        builder.call(read, [*_ARGUMENTS, first])
        whole = builder.fdiv(builder.sitofp(builder.load(first), _DOUBLE), _DOUBLE(_PER_SECOND))
        part = builder.fmul(builder.sitofp(builder.load(second), _DOUBLE), _DOUBLE(1e-9))
        return builder.fadd(whole, part)

    return types.float64(), generate


_read_clock: Any = intrinsic(_reading)


@njit(cache=True, nogil=True)
def now() -> float:
    """The time [s], from a beginning of no meaning; it never runs backward."""
    return float(_read_clock())


@njit(cache=True, nogil=True)
def time_is_up(until: float) -> bool:
    """Whether that time has come; an infinite one never does, and no clock is read."""
    return bool(until < inf and now() >= until)
