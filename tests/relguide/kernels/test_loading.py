"""Machine code is read from disk without what compiling needs, and compiling works afterwards."""

import subprocess
import sys
from pathlib import Path

from numba.core.environment import lookup_environment

from relguide import Plan, plan
from relguide.kernels.loading import _rebuild_environment
from relguide.planning.deadline import LOADING

TO_COMPILE = ("numba.np.linalg", "numba.np.arraymath", "scipy.linalg")
"""What numba imports before it compiles."""

PROGRAM = f"""
import sys
from relguide import plan
from relguide.planning.deadline import LOADING

planned = plan(LOADING[0])
loaded = [name for name in {TO_COMPILE!r} if name in sys.modules]
assert not loaded, loaded

import numpy as np
from numba import njit
from relguide.kernels.base.records import Pose
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

@njit
def total(numbers):
    return np.sort(numbers).sum() + np.dot(numbers, numbers)

@njit
def soonest(pose, alpha, row):
    fastest(pose, alpha, 0.0, 0, make_scratch(), row)
    return row[0]

assert total(np.array([3.0, 1.0, 2.0])) == 20.0
pose, row = Pose(-3.0, 1.0, 2.0), np.empty(5)
assert soonest(pose, 0.8, row) == soonest.py_func(pose, 0.8, row)
print(planned.time_to_converge)
"""


def test_planning_imports_nothing_to_compile_with_and_compiling_works_after_it() -> None:
    planned = plan(LOADING[0])  # from here on its kernels are on the disk
    assert isinstance(planned, Plan)
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        check=True, capture_output=True, text=True, cwd=Path(__file__).parents[3],
    )  # fmt: skip
    assert float(done.stdout) == planned.time_to_converge


def test_what_was_read_can_be_written_again_with_a_caller() -> None:
    built = _rebuild_environment("nowhere.module", [1, "two"], "of a function of it")
    assert built.can_cache()
    assert built.consts == [1, "two"]
    assert built.__reduce__()[1] == ("nowhere.module", [1, "two"], "of a function of it")
    assert lookup_environment("of a function of it") is built
    assert _rebuild_environment("nowhere.module", [], "of a function of it") is built
    assert "nowhere.module" not in sys.modules
