"""Claims checked: each command run once, and each number held against what is claimed."""

import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from relguide.claims.claim import Claim
from relguide.claims.kept import results
from relguide.claims.reading import read_printed, read_table

POLL = 0.5
"""How often a command that runs is looked at [s]."""
WIDTH = "200"
"""Of the terminal that commands print for [characters], so that no table is wrapped."""
MISSING = re.compile(
    r"pip install|^ModuleNotFoundError: No module named '(?!(relguide|benchmarks|tests|tools)\b)"
)
"""In the last words of a command that misses a package of others."""
TRACEBACK = "Traceback (most recent call last)"
"""In what a command says that a mistake has ended."""


@dataclass(frozen=True)
class Checked:
    """A claim, and what became of it.

    Attributes:
        claim: that was checked.
        obtained: the number; None if there is none.
        why: a sentence if there is no number.
        ran: whether its command ran, or its table was read.
    """

    claim: Claim
    obtained: float | None = None
    why: str = ""
    ran: bool = True

    @property
    def ok(self) -> bool:
        """Whether it holds; what did not run does not."""
        return self.obtained is not None and self.claim.holds(self.obtained)

    @property
    def measured(self) -> bool:
        """Whether its command ran; a table that was only read measures nothing."""
        return self.ran and self.claim.runs != "kept"

    @property
    def failed(self) -> bool:
        """Whether it ran and does not hold."""
        return self.ran and not self.ok


@dataclass(frozen=True)
class Running:
    """How far it is.

    Attributes:
        command: that runs now.
        seconds: that it has run so far.
        minutes: of all commands that are done, and of this one so far, as their rows say.
        checked: what is known by now.
    """

    command: str
    seconds: float
    minutes: float
    checked: tuple[Checked, ...] = field(default=())


def total_minutes(claims: Sequence[Claim]) -> float:
    """What all their commands take, each counted once."""
    return sum({claim.command: claim.minutes for claim in claims if claim.runs != "kept"}.values())


def check_claims(claims: Sequence[Claim], root: Path | None) -> Iterator[Running]:
    """Check claims; yields twice a second and after each command how far that is.

    Where a command fails, its claims do not hold, and the others are still checked. At last all
    is known, in the order of the claims.

    Args:
        claims: to be checked.
        root: the folder of the project; None if relguide is run from a wheel.
    """
    checked: list[Checked] = []
    minutes = 0.0
    for command in dict.fromkeys(claim.command for claim in claims):
        rows = [claim for claim in claims if claim.command == command]
        if root is None and any(claim.needs_clone for claim in rows):
            why = "It needs a clone of the repository."
            checked += [Checked(claim, why=why, ran=False) for claim in rows]
            minutes += total_minutes(rows)
            continue
        kept = [claim for claim in rows if claim.runs == "kept"]
        if root is not None:
            checked += [_judge_kept(claim, root) for claim in kept]
        running = [claim for claim in rows if claim.runs != "kept"]
        if running:
            takes = running[0].minutes
            seconds = 0.0
            for now in _run(command, root):
                if isinstance(now, float):
                    seconds = now
                    so_far = minutes + min(seconds / 60.0, takes)
                    yield Running(command, seconds, so_far, (*checked,))
                else:
                    checked += [_judge(claim, now) for claim in running]
            minutes += takes
            yield Running(command, seconds, minutes, (*checked,))
    order = {claim.name: i for i, claim in enumerate(claims)}
    checked.sort(key=lambda one: order[one.claim.name])
    yield Running("", 0.0, minutes, (*checked,))


def arguments_of(command: str) -> list[str]:
    """What is run for what is typed: by this Python, whatever is first in the path.

    Raises:
        ValueError: if it is no command of this Python.
    """
    program, *rest = shlex.split(command)
    if program == "relguide":
        return [sys.executable, "-m", "relguide", *rest]
    if program == "python":
        return [sys.executable, *rest]
    raise ValueError(f"{program} is not run from here.")


def _run(command: str, root: Path | None) -> Iterator[float | subprocess.CompletedProcess[str]]:
    """Run it; yields how many seconds it has run, and at last what it printed."""
    began = monotonic()
    with (
        tempfile.TemporaryDirectory() as folder,
        tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out,
        tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as complaints,
    ):
        if root is not None:
            (root / "build").mkdir(exist_ok=True)  # where commands put what they make
        process = subprocess.Popen(
            arguments_of(command),
            cwd=root or folder,
            env=os.environ | {"COLUMNS": WIDTH, "PYTHONIOENCODING": "utf-8"},
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=complaints,
        )
        try:
            while process.poll() is None:
                yield monotonic() - began
                try:
                    process.wait(POLL)
                except subprocess.TimeoutExpired:
                    continue
        finally:
            process.terminate()
            process.wait()
        for file in (out, complaints):
            file.seek(0)
        yield subprocess.CompletedProcess(
            command, process.returncode, out.read(), complaints.read()
        )


def _judge(claim: Claim, done: subprocess.CompletedProcess[str]) -> Checked:
    last = (done.stderr.strip().splitlines() or [""])[-1]
    if done.returncode and MISSING.search(last):
        return Checked(claim, why=last, ran=False)
    crashed = done.returncode == 1 and TRACEBACK in done.stderr
    if crashed or done.returncode not in (0, 1):  # 1: no plan or a failed check, a result too
        return Checked(claim, why=f"It ended with the exit status {done.returncode}. {last}")
    try:
        return Checked(claim, read_printed(claim.reading, done.stdout))
    except ValueError as error:
        return Checked(claim, why=f"{error} {last}".strip())


def _judge_kept(claim: Claim, root: Path) -> Checked:
    try:
        return Checked(claim, read_table(claim.reading, results(root)))
    except FileNotFoundError:
        return Checked(claim, why=f"There is no table {claim.reading.table}.")
    except ValueError as error:
        return Checked(claim, why=str(error))
