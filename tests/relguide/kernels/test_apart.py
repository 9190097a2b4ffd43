"""Each kernel is compiled once, is found again by its callers, and answers as numba's own code."""

import gc
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from relguide.kernels import apart, cache

INNER = """
from typing import NamedTuple
import numpy as np
from numba import njit
from relguide.kernels.toys.least import least

@njit(cache=True, nogil=True)
def ranked(values):
    order = np.argsort(values)
    for k in range(len(values) - 1):
        assert values[order[k]] <= values[order[k + 1]]
    return order, least(values)

@njit(cache=True, nogil=True, forceinline=True)
def doubled(value):
    return 2.0 * value

class Pair(NamedTuple):
    n: int
    values: object

@njit(cache=True, nogil=True)
def first(pair):
    return Pair(pair.n + 1, pair.values)

@njit(cache=True, nogil=True)
def factorial(n):
    return 1 if n < 2 else n * factorial(n - 1)
"""
LEAST = """
from numba import njit

@njit(cache=True, nogil=True)
def least(values):
    found = values[0]
    for value in values:
        found = min(found, value)
    return found
"""
OUTER = """
from numba import njit
from relguide.kernels.toys.inner import Pair, doubled, factorial, first, ranked

@njit(cache=True, nogil=True)
def outer(values):
    order, smallest = ranked(values)
    return order[0], doubled(smallest), factorial(first(Pair(4, values)).n)
"""
CALL = """
import numpy as np
from relguide.kernels.toys.outer import outer
from relguide.kernels.toys.inner import ranked
print(outer(np.array([3.0, 1.0, 2.0])))
"""
COMPILED = """
import sys
from relguide.kernels.compiling import COMPILE, events
from numba.core.event import RecordingListener
with events.install_recorder(COMPILE) as told:
    exec(sys.argv[1])
functions = [event.data["dispatcher"].py_func for _, event in told.buffer]
names = {one.__name__ for one in functions if one.__module__.startswith("relguide.")}
print(*sorted(names), sep=", ")
"""
ANSWER = "(1, 2.0, 120)"


@pytest.fixture
def toys(tmp_path: Path) -> Path:
    """A package with this one's way to compile, and few kernels."""
    kernels = tmp_path / "relguide" / "kernels"
    (kernels / "toys").mkdir(parents=True)
    (tmp_path / "relguide" / "__init__.py").touch()
    for file in cache.HERE.glob("*.py"):
        shutil.copy(file, kernels)
    for name, text in (("inner", INNER), ("least", LEAST), ("outer", OUTER), ("__init__", "")):
        (kernels / "toys" / f"{name}.py").write_text(text)
    return tmp_path


def run(toys: Path, *arguments: str, name: str = "kept") -> subprocess.CompletedProcess[str]:
    paths = os.pathsep.join([str(toys), *filter(None, sys.path)])
    return subprocess.run(
        [sys.executable, "-W", "default", "-c", *arguments],
        env={**os.environ, "NUMBA_CACHE_DIR": str(toys / name), "PYTHONPATH": paths},
        cwd=toys,
        check=True,
        capture_output=True,
        text=True,
    )


def compiled(toys: Path, statements: str = CALL) -> tuple[str, list[str]]:
    """What a process prints, and which kernels it compiles."""
    *said, names = run(toys, COMPILED, statements).stdout.splitlines()
    return "\n".join(said), names.split(", ") if names else []


def index_of(toys: Path, kernel: str) -> Path:
    (index,) = (toys / "kept" / "relguide").glob(f"{kernel}-*.nbi")
    return index


EVERY = ["doubled", "factorial", "first", "least", "outer", "ranked"]


@pytest.mark.slow
def test_a_second_process_compiles_nothing_and_answers_the_same(toys: Path) -> None:
    assert compiled(toys) == (ANSWER, EVERY)
    assert compiled(toys) == (ANSWER, [])


@pytest.mark.slow
def test_a_callee_that_is_gone_from_the_disk_is_compiled_alone(toys: Path) -> None:
    compiled(toys)
    index_of(toys, "inner.ranked").unlink()
    assert compiled(toys) == (ANSWER, ["ranked"])
    for file in (toys / "kept" / "relguide").glob("*ranked*.nbc"):
        file.unlink()
    assert compiled(toys) == (ANSWER, ["ranked"])
    assert compiled(toys) == (ANSWER, [])


@pytest.mark.slow
@pytest.mark.parametrize("damage", [b"", b"\0" * 5000, None])
def test_a_damaged_file_is_compiled_anew(toys: Path, damage: bytes | None) -> None:
    compiled(toys)
    (ranked,) = (toys / "kept" / "relguide").glob("inner.ranked-*.1.nbc")
    (least,) = (toys / "kept" / "relguide").glob("least.least-*.1.nbc")
    ranked.write_bytes(least.read_bytes() if damage is None else damage)
    assert compiled(toys) == (ANSWER, ["ranked"])
    assert compiled(toys) == (ANSWER, [])


@pytest.mark.slow
def test_what_changes_in_a_callee_changes_the_answer(toys: Path) -> None:
    compiled(toys)
    inner = toys / "relguide/kernels/toys/inner.py"
    inner.write_text(INNER.replace("2.0 * value", "4.0 * value"))
    assert compiled(toys) == ("(1, 4.0, 120)", ["doubled", "factorial", "first", "outer", "ranked"])


@pytest.mark.slow
def test_a_name_that_no_kernel_has_any_more_makes_the_caller_anew(toys: Path) -> None:
    """As when the folder holds files of two versions; else the process would end."""
    compiled(toys)
    renamed = CALL.replace(
        "import numpy",
        "from relguide.kernels import distinct_names as names\n"
        "number = names.number\n"
        "names.number = lambda file, name, line: number(file, name, line + (name == 'ranked'))\n"
        "import numpy",
    )
    index_of(toys, "inner.ranked").unlink()
    assert compiled(toys, renamed) == (ANSWER, ["outer", "ranked"])


@pytest.mark.slow
def test_python_calls_an_inner_kernel_after_compiled_code_has(toys: Path) -> None:
    inner = CALL + "order, least = ranked(np.array([2.0, 1.0]))\nprint(order, least)"
    for _ in range(2):
        assert compiled(toys, inner)[0].splitlines() == [ANSWER, "[1 0] 1.0"]


@pytest.mark.slow
def test_python_calls_what_was_read_from_disk_for_a_kernel_alone(toys: Path) -> None:
    compiled(toys)
    inner = (
        "import numpy as np\n"
        "from relguide.kernels.toys.inner import Pair, first\n"
        "print(first(Pair(4, np.array([2.0, 1.0]))))"
    )
    for _ in range(2):
        assert compiled(toys, inner) == ("Pair(n=5, values=array([2., 1.]))", [])


@pytest.mark.slow
def test_threads_that_call_a_kernel_first_at_once_make_one_entry(toys: Path) -> None:
    """Of two equal entries numba takes none, and would ask for one at every later call."""
    compiled(toys)
    first_calls = (
        "from threading import Barrier, Thread\n"
        "import numpy as np\n"
        "from relguide.kernels import apart\n"
        "from relguide.kernels.toys.least import least\n"
        "compile, both, asked = apart._compile_any, Barrier(2), []\n"
        "def compile_together(kernel, signature):\n"
        "    asked.append(kernel.py_func.__name__)\n"
        "    if len(asked) <= 2:\n"
        "        both.wait(20.0)\n"
        "    return compile(kernel, signature)\n"
        "apart._compile_any = compile_together\n"
        "call = lambda: least(np.array([2.0, 1.0]))\n"
        "threads = [Thread(target=call) for _ in range(2)]\n"
        "[one.start() for one in threads]\n"
        "[one.join() for one in threads]\n"
        "print(call(), len(asked))"
    )
    assert compiled(toys, first_calls)[0] == "1.0 2"


@pytest.mark.slow
def test_processes_at_once_do_not_disturb_each_other(toys: Path) -> None:
    paths = os.pathsep.join([str(toys), *filter(None, sys.path)])
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(toys / "kept"), "PYTHONPATH": paths}
    begun = [
        subprocess.Popen(
            [sys.executable, "-c", CALL], env=environment, cwd=toys, stdout=subprocess.PIPE
        )
        for _ in range(3)
    ]
    assert [one.communicate()[0].decode().strip() for one in begun] == [ANSWER] * 3
    assert compiled(toys) == (ANSWER, [])


@pytest.mark.slow
def test_an_untested_numba_compiles_as_ever_with_a_warning(toys: Path) -> None:
    done = run(toys, 'import numba; numba.__version__ = "0.99.0"\n' + CALL, name="elsewhere")
    assert done.stdout.strip() == ANSWER
    assert "numba 0.99.0 is not one that relguide was tested with" in done.stderr
    assert "tested with" not in run(toys, CALL).stderr


@pytest.mark.slow
def test_a_large_kernel_is_only_declared_in_its_callers(toys: Path) -> None:
    defined = (
        "module = outer.overloads[outer.signatures[0]].library._final_module\n"
        "print(*(f.name for f in module.functions if not f.is_declaration))"
    )
    (names,) = run(toys, CALL + defined).stdout.splitlines()[1:]
    assert "5outer" in names
    assert "6ranked" not in names


def test_garbage_is_collected_as_before_once_the_last_thread_has_compiled() -> None:
    before, enabled = gc.get_threshold(), gc.isenabled()
    one, other = apart._few_collections(), apart._few_collections()
    gc.disable()
    try:
        one.__enter__()
        other.__enter__()
        one.__exit__(None, None, None)
        assert gc.get_threshold()[0] == apart.COLLECT_EVERY
        assert gc.isenabled()
        other.__exit__(None, None, None)
        assert gc.get_threshold() == before
        assert not gc.isenabled()
    finally:
        if enabled:
            gc.enable()
