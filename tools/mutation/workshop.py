"""A copy of the repository in which faults are put in, and the tests run over them.

Kernels are compiled, and a fault in one makes all that it is part of be compiled again. So the copy
starts from the kernels already compiled, and each fault writes to a folder of its own beside them,
of hard links: numba replaces files and never writes into one. Much quicker than to compile is to
leave a kernel to Python: its nearest tests are run so first, as far as they pass and end soon
without the fault.
"""

import os
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Literal

from tools.mutation.pytest_process import run_pytest
from tools.mutation.sampling import Mutant

Result = Literal["killed", "timeout", "survived"]
KERNELS, TESTS = Path("relguide/kernels"), Path("tests")
SOON = 15.0
"""A module of tests that takes longer uncompiled is left to the compiled run [s]."""
SLACK = 4.0
"""How many times longer than without the fault tests may take."""
STARTING, COMPILING = 20.0, 240.0
"""What they may take besides, and once more where kernels are compiled [s]."""
KILLED = (1, 2)
"""pytest's exit codes when a test fails, and when one could not even be imported."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """What became of one fault."""

    result: Result
    by: str
    """The test that failed first, or how the run ended."""
    seconds: float


@dataclass(slots=True)
class Workshop:
    """The copy, and how long its tests take there without any fault."""

    root: Path
    folder: Path
    """Where the copy is made; thrown away by `close`."""
    times: dict[tuple[Path, bool], float] = field(default_factory=dict)
    """By test module and whether it is compiled [s]; infinite if uncompiled it is no use."""

    @property
    def tree(self) -> Path:
        """The copy itself."""
        return self.folder / "tree"

    def open(self) -> None:
        """Copy what git knows of and what it does not ignore, and the kernels compiled so far."""
        self.close()
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=self.root,
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for name in filter(None, listed.split("\0")):
            if (self.root / name).is_file() and not name.startswith("web/"):
                (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(self.root / name, self.tree / name)
        compiled = self.folder / "compiled/relguide"
        compiled.mkdir(parents=True)
        for file in (self.root / KERNELS / "__pycache__").glob("*.nb?"):
            shutil.copy2(file, compiled / file.name)

    def close(self) -> None:
        """Throw the copy away."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def judge(self, mutant: Mutant, tests: Sequence[Path]) -> Verdict:
        """Run these tests with the fault in place, until one fails."""
        place = self.tree / mutant.file
        in_kernels = mutant.file.is_relative_to(KERNELS)
        near = [test for test in tests if in_kernels and test.is_relative_to(TESTS / KERNELS)]
        quick = [test for test in near if self.time(test, compiled=False) < SOON]
        soon = SLACK * sum(self.time(test, compiled=False) for test in quick) + STARTING
        late = SLACK * sum(self.time(test, compiled=True) for test in tests) + STARTING
        before, started = place.read_bytes(), monotonic()
        place.write_bytes(mutant.text)
        try:
            result, by = self._run(quick, False, soon) if quick else ("survived", "")
            if result == "survived":
                result, by = self._run(tests, True, late + COMPILING * in_kernels)
        finally:
            place.write_bytes(before)
        return Verdict(result=result, by=by, seconds=monotonic() - started)

    def time(self, test: Path, *, compiled: bool) -> float:
        """How long a module of tests takes without a fault [s]; measured once."""
        if (test, compiled) not in self.times:
            started = monotonic()
            limit = 10.0 * COMPILING if compiled else SOON
            code, said = self._pytest([test], compiled, limit, self.folder / "compiled")
            if compiled and code != 0:
                raise RuntimeError(f"{test} must pass before a fault is put in:\n{said}")
            self.times[test, compiled] = monotonic() - started if code == 0 else float("inf")
        return self.times[test, compiled]

    def _run(self, tests: Sequence[Path], compiled: bool, limit: float) -> tuple[Result, str]:
        kernels = self.folder / "with fault"
        shutil.rmtree(kernels, ignore_errors=True)
        shutil.copytree(self.folder / "compiled", kernels, copy_function=os.link)
        code, said = self._pytest(tests, compiled, limit, kernels)
        if code is None:
            return "timeout", f"after {limit:.0f} s"
        if code == 0:
            return "survived", ""
        lines = [line for line in said.splitlines() if line.startswith(("FAILED", "ERROR"))]
        if code in KILLED or code < 0:
            return "killed", lines[0].split()[1] if lines else f"exit code {code}"
        raise RuntimeError(f"pytest ended with {code}:\n{said}")

    def _pytest(
        self, tests: Sequence[Path], compiled: bool, limit: float, kernels: Path
    ) -> tuple[int | None, str]:
        """pytest's exit code, None if it did not end in time, and what it printed."""
        log = self.folder / "pytest.log"
        environment = {
            "NUMBA_CACHE_DIR": str(kernels),
            "NUMBA_DISABLE_JIT": str(int(not compiled)),
        }
        code = run_pytest(self.tree, tests, environment, log, limit)
        return code, log.read_text() if log.exists() else ""
