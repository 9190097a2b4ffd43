"""`python -m relguide.warm_up`: compile kernels ahead of their use, and keep the result.

Numba compiles a kernel when it is first called, minutes for all of them, and reads it from disk
ever after (`kernels/cache.py`). So here everything that calls a kernel is done once, on situations
that lead through all branches. `tests/relguide/test_warm_up.py` sees that none is missing.

It is done in steps, each in a process of its own, since numba compiles one function at a time in a
process. A step begins once those it builds on are done, and reads from disk what they compiled.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from importlib.util import find_spec
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


class Preparing(NamedTuple):
    """How far it has come."""

    title: str
    """What is being compiled."""
    share: float
    """Of that, 0 to 1."""
    seconds: float
    """Of all steps, reckoned as in `Step.seconds`."""
    done: tuple[str, ...]
    """Steps that are compiled, by name."""


class _News(NamedTuple):
    step: str
    seconds: float
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
        "--jobs", type=int, default=os.cpu_count() or 1, help="processes (default: one a core)"
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
        warm_up(left, jobs=chosen.jobs)
    kept = f"kept in {cache.folder()}" if left else "in place"
    sys.stdout.write(f"The kernels are compiled and {kept}.\n")
    return 0


def missing(wanted: Iterable[str]) -> tuple[str, ...]:
    """The steps of these that are still to be compiled, and can be."""
    place = cache.folder()
    return tuple(name for name in wanted if _available(name) and not cache.is_warm(name, place))


def warm_up(wanted: Sequence[str], *, jobs: int) -> None:
    """Compile the kernels of some steps, with a progress bar if that takes long."""
    total = sum(STEPS[name].seconds for name in wanted)
    shown = ""
    for state in show_progress(
        prepare(wanted, jobs=jobs),
        title="compiling",
        total=total,
        done=lambda state: state.seconds,
        state=lambda state: state.title,
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
    spent = dict.fromkeys(wanted, 0.0)
    running: dict[str, subprocess.Popen[str]] = {}
    news: Queue[_News] = Queue()
    try:
        while pending or running:
            for name in _ready(pending, running)[: max(1, jobs) - len(running)]:
                pending.remove(name)
                running[name] = _begin(name, news)
            yield _state(running, spent, done)
            heard = _next(news, stopped)
            if heard is None:
                return
            name = heard.step
            spent[name] += heard.seconds
            if not heard.ended:
                continue
            if running.pop(name).wait() != 0:
                raise WarmUpError(f"Compiling {STEPS[name].title} broke off.\n{heard.complaint}")
            spent[name] = STEPS[name].seconds
            done += (name,)
            cache.record([name], cache.folder())
        if done and not missing(STEPS):  # else nothing is new, and the disk may be read-only
            cache.record([cache.EVERYTHING], cache.folder())
        yield _state(running, spent, done)
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
    """Pass on what a process writes: a number is the seconds of a kernel, all else a complaint."""
    complaint = ""
    with lines:
        for line in lines:
            try:
                news.put(_News(name, float(line)))
            except ValueError:
                complaint += line
    news.put(_News(name, 0.0, ended=True, complaint=complaint))


def _next(news: "Queue[_News]", stopped: Callable[[], bool]) -> "_News | None":
    while not stopped():
        try:
            return news.get(timeout=POLL)
        except Empty:
            continue
    return None


def _state(running: Iterable[str], spent: dict[str, float], done: tuple[str, ...]) -> Preparing:
    # a slower machine than the one the seconds were measured on: not at 100 % before it is done
    reached = {name: min(spent[name], 0.99 * STEPS[name].seconds) for name in running}
    total = sum(reached.values()) + sum(STEPS[name].seconds for name in done)
    for name in reached:  # the first one begun
        return Preparing(STEPS[name].title, reached[name] / STEPS[name].seconds, total, done)
    return Preparing("", 1.0, total, done)


def _work(name: str) -> None:
    """A step in this process, which is started for it; writes the seconds each kernel took."""
    if STEPS[name].after and hasattr(os, "nice"):
        os.nice(5)  # who flies or plans meanwhile comes first
    first_use.announced = True

    def say(seconds: float) -> None:
        sys.stdout.write(f"{seconds:.3f}\n")
        sys.stdout.flush()

    with each_kernel(say):
        STEPS[name].run()


def _available(name: str) -> bool:
    return all(find_spec(package) for package in STEPS[name].packages)
