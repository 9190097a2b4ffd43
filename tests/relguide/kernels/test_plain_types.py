"""A constant in a call does not make numba compile the kernel called once more."""

import tomllib
from pathlib import Path
from typing import Any

import numba
from packaging.requirements import Requirement

from relguide.kernels import cache

PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())["project"]
(NUMBA,) = (
    wanted for wanted in map(Requirement, PROJECT["dependencies"]) if wanted.name == "numba"
)

SOURCE = """
from numba import njit

@njit
def raised(x, by, often):
    return x + by if often else x

@njit
def calls(x, by):
    return raised(x, 1, True) + raised(x, 2, False) + raised(x, by, by > 0)
"""


def compile_in(file: str) -> Any:
    there: dict[str, Any] = {}
    exec(compile(SOURCE, file, "exec"), there)
    assert there["calls"](1.0, 3) == 2.0 + 1.0 + 4.0
    return there["raised"].signatures


def test_a_kernel_is_compiled_once_for_all_constants() -> None:
    compiled = compile_in(str(cache.HERE / "sketch.py"))
    assert len(compiled) == 1, (
        f"numba {numba.__version__} compiles {compiled}, which no longer asks "
        "Dispatcher.get_call_template: mend relguide/kernels/plain_types.py, or admit only older "
        "versions of numba in pyproject.toml."
    )


def test_only_versions_of_numba_that_were_tried_are_admitted() -> None:
    """The lookup that is wrapped, and the index of compiled kernels, are no promise of numba's."""
    assert numba.__version__ in NUMBA.specifier
    assert {bound.operator for bound in NUMBA.specifier} == {">=", "<"}


def test_functions_of_others_are_left_as_they_are() -> None:
    assert len(compile_in("elsewhere.py")) == 3
