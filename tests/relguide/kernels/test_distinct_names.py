"""Kernels that different processes compiled may be linked into one."""

import os
import subprocess
import sys
from pathlib import Path

SORTED = """
import numpy as np
from numba import njit

@njit(cache=True)
def ordered(x):
    return np.sort(x)
"""
RANKED = SORTED.replace("ordered", "ranked").replace("np.sort", "np.argsort")
BOTH = """
from numba import njit
from ordered import ordered
from ranked import ranked

@njit(cache=True)
def both(x):
    return ordered(x)[0], ranked(x)[0]
"""
THREE_MORE = "[njit(lambda: 0)() for _ in range(3)]"
"""With these numba comes to the same number for both of its quicksorts."""


def run(folder: Path, *statements: str) -> list[str]:
    """What a process of its own prints, with its compiled functions kept in a folder."""
    begin = (
        "import relguide.kernels, numpy as np",
        "from numba import njit",
        "x = -np.arange(300.0)",
    )
    paths = os.pathsep.join([str(folder), *filter(None, sys.path)])
    return subprocess.run(
        [sys.executable, "-c", "\n".join((*begin, *statements))],
        env={**os.environ, "NUMBA_CACHE_DIR": str(folder), "PYTHONPATH": paths},
        check=False,
        capture_output=True,
        text=True,
    ).stdout.split()


def test_code_of_two_processes_is_told_apart(tmp_path: Path) -> None:
    for name, text in (("ordered", SORTED), ("ranked", RANKED), ("both", BOTH)):
        (tmp_path / f"{name}.py").write_text(text)
    run(tmp_path, "from ordered import ordered; ordered(x)")
    run(tmp_path, THREE_MORE, "from ranked import ranked; ranked(x)")
    assert run(tmp_path, "from both import both; print(*both(x))") == ["-299.0", "299"]


def test_a_function_has_another_name_in_each_process(tmp_path: Path) -> None:
    name = "f.overloads[f.signatures[0]].fndesc.mangled_name"
    names = [run(tmp_path, "f = njit(lambda: 0); f()", f"print({name})") for _ in range(2)]
    assert names[0]
    assert names[0] != names[1]
