"""A constant in a call does not make numba compile the kernel called once more."""

from typing import Any

from relguide.kernels import cache

SOURCE = """
from numba import njit

@njit
def raised(x, by, often):
    return x + by if often else x

@njit
def calls(x, by):
    return raised(x, 1, True) + raised(x, 2, False) + raised(x, by, by > 0)
"""


def compiled_in(file: str) -> Any:
    there: dict[str, Any] = {}
    exec(compile(SOURCE, file, "exec"), there)
    assert there["calls"](1.0, 3) == 2.0 + 1.0 + 4.0
    return there["raised"].signatures


def test_a_kernel_is_compiled_once_for_all_constants() -> None:
    assert len(compiled_in(str(cache.HERE / "sketch.py"))) == 1


def test_functions_of_others_are_left_as_they_are() -> None:
    assert len(compiled_in("elsewhere.py")) == 3
