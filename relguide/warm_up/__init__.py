"""`python -m relguide.warm_up`: compile kernels ahead of their use, and keep the result.

Numba compiles a kernel when it is first called, minutes for all of them, and reads it from disk
ever after (`kernels/cache.py`). So here everything that calls a kernel is done once, on situations
that lead through all branches. `tests/relguide/test_warm_up.py` sees that none is missing.

It is done in steps, each in a process of its own, since numba compiles one function at a time in a
process. A step begins once those it builds on are done, and reads from disk what they compiled.
"""

import argparse
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import NamedTuple, TextIO

from relguide.kernels import cache
from relguide.kernels.compiling import each_kernel, first_use
from relguide.planning.progress import show_progress
from relguide.warm_up.steps import SETS as SETS
from relguide.warm_up.steps import STEPS as STEPS
from relguide.warm_up.steps import Step as Step

POLL = 0.2
"""How often it is looked whether to stop [s]."""
COMPILED = "A kernel is compiled.\n"
"""What the process of a step writes."""
MEMORY = 1 << 30
"""What the process of a step may need [bytes]."""


class Preparing(NamedTuple):
    """How far it has come."""

    title: str
    """What is being compiled."""
    share: float
    """Of that, 0 to 1."""
    kernels: int
    """How many are compiled, of all steps that are wanted."""
    done: tuple[str, ...]
    """Steps that are compiled, by name."""


class _News(NamedTuple):
    """What a step's process tells: that a kernel is compiled, or that it has ended."""

    step: str
    ended: bool = False
    complaint: str = ""


class WarmUpError(RuntimeError):
    """A step broke off."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Compile what is not compiled yet, and say where it is kept.

    Returns:
        the exit code.
    """
    parser = argparse.ArgumentParser(prog="python -m relguide.warm_up", description=__doc__)
    parser.add_argument(
        "--for", dest="wanted", choices=SETS, default="all", help="what for (default: all)"
    )
    parser.add_argument(
        "--jobs", type=int, default=0, help="processes (default: as many as cores and memory allow)"
    )
    parser.add_argument("--step", choices=STEPS, help=argparse.SUPPRESS)
    chosen = parser.parse_args(arguments)
    if chosen.step:
        _work(chosen.step)
        return 0
    wanted = SETS[chosen.wanted]
    for name in wanted:
        if not _available(name):
            sys.stderr.write(f"Left out, since packages are missing: {STEPS[name].title}.\n")
    left = missing(wanted)
    if left:
        warm_up(left, jobs=chosen.jobs or usual_jobs())
    kept = f"kept in {cache.folder()}" if left else "in place"
    sys.stdout.write(f"The kernels are compiled and {kept}.\n")
    return 0


def missing(wanted: Iterable[str]) -> tuple[str, ...]:
    """The steps of these that are still to be compiled, and can be."""
    place = cache.folder()
    return tuple(name for name in wanted if _available(name) and not cache.is_warm(name, place))


def usual_jobs() -> int:
    """As many processes as there are cores for this one, but no more than memory has room for."""
    try:
        cores = len(os.sched_getaffinity(0))
    except AttributeError:  # macOS, Windows
        cores = os.cpu_count() or 1
    return max(1, min(cores, _available_memory() // MEMORY))


def _available_memory() -> int:
    """What processes may still take [bytes]; without bound where the system does not tell."""
    unbounded = sys.maxsize
    try:
        found = re.search(r"^MemAvailable: *(\d+) kB", Path("/proc/meminfo").read_text(), re.M)
    except OSError:  # macOS, Windows
        return unbounded
    return min(int(found[1]) << 10 if found else unbounded, _left_to_container())


def _left_to_container(group: Path = Path("/sys/fs/cgroup")) -> int:
    """What a container's limit leaves [bytes]."""
    try:
        limit, used = ((group / f"memory.{name}").read_text() for name in ("max", "current"))
        return int(limit) - int(used)
    except (OSError, ValueError):  # no container, or "max": no limit
        return sys.maxsize


def warm_up(wanted: Sequence[str], *, jobs: int) -> None:
    """Compile the kernels of some steps, with a progress bar if that takes long."""
    total = sum(STEPS[name].kernels for name in wanted)
    shown = ""
    for state in show_progress(
        prepare(wanted, jobs=jobs),
        title="compiling",
        total=total,
        done=lambda state: state.kernels,
        state=lambda state: f"{state.title}, {state.kernels} of {total} kernels",
    ):
        if state.title not in (shown, "") and not sys.stderr.isatty():
            sys.stderr.write(f"compiling {state.title} …\n")
        shown = state.title


def prepare(
    wanted: Sequence[str], *, jobs: int, stopped: Callable[[], bool] = lambda: False
) -> Iterator[Preparing]:
    """Compile the kernels of some steps in processes of their own; yields how far that is.

    Args:
        wanted: names of steps, in the order they are begun.
        jobs: how many processes there may be at a time.
        stopped: looked at now and then; once it is true, the processes are ended.

    Raises:
        WarmUpError: if a step breaks off, with what it wrote.
    """
    pending, done = list(wanted), tuple[str, ...]()
    compiled = dict.fromkeys(wanted, 0)
    running: dict[str, subprocess.Popen[str]] = {}
    news: Queue[_News] = Queue()
    try:
        while pending or running:
            for name in _ready(pending, running)[: max(1, jobs) - len(running)]:
                pending.remove(name)
                running[name] = _begin(name, news)
            yield _state(running, compiled, done)
            heard = _next(news, stopped)
            if heard is None:
                return
            name = heard.step
            if not heard.ended:
                compiled[name] += 1
                continue
            if running.pop(name).wait() != 0:
                raise WarmUpError(f"Compiling {STEPS[name].title} broke off.\n{heard.complaint}")
            done += (name,)
            cache.record([name], cache.folder())
        if done and not missing(STEPS):  # else nothing is new, and the disk may be read-only
            cache.record([cache.EVERYTHING], cache.folder())
        yield _state(running, compiled, done)
    finally:
        for process in running.values():
            process.terminate()
            process.wait()


def _ready(pending: Sequence[str], running: Iterable[str]) -> list[str]:
    """Steps that nothing before them holds up."""
    unfinished = {*pending, *running}
    return [name for name in pending if not unfinished.intersection(STEPS[name].after)]


def _begin(name: str, news: "Queue[_News]") -> "subprocess.Popen[str]":
    process = subprocess.Popen(
        [sys.executable, "-m", "relguide.warm_up", "--step", name],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    Thread(target=_listen, args=(name, process.stdout, news), daemon=True).start()
    return process


def _listen(name: str, lines: TextIO, news: "Queue[_News]") -> None:
    """Pass on what a process writes: that a kernel is compiled, or a complaint."""
    complaint = ""
    with lines:
        for line in lines:
            if line == COMPILED:
                news.put(_News(name))
            else:
                complaint += line
    news.put(_News(name, ended=True, complaint=complaint))


def _next(news: "Queue[_News]", stopped: Callable[[], bool]) -> "_News | None":
    while not stopped():
        try:
            return news.get(timeout=POLL)
        except Empty:
            continue
    return None


def _state(running: Iterable[str], compiled: dict[str, int], done: tuple[str, ...]) -> Preparing:
    # what other steps compile meanwhile is not compiled here, or more is: never all before the end
    reached = {name: min(compiled[name], STEPS[name].kernels - 1) for name in running}
    total = sum(reached.values()) + sum(STEPS[name].kernels for name in done)
    for name in reached:  # the first one begun
        return Preparing(STEPS[name].title, reached[name] / STEPS[name].kernels, total, done)
    return Preparing("", 1.0, total, done)


def _work(name: str) -> None:
    """A step in this process, which is started for it; writes a line for each kernel compiled."""
    if STEPS[name].after and hasattr(os, "nice"):
        os.nice(5)  # who flies or plans meanwhile comes first
    first_use.announced = True

    def say(_: float) -> None:
        sys.stdout.write(COMPILED)
        sys.stdout.flush()

    with each_kernel(say):
        STEPS[name].run()


def _available(name: str) -> bool:
    return all(find_spec(package) for package in STEPS[name].packages)
