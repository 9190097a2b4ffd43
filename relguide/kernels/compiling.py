"""Follow numba while it compiles kernels: time each, or announce on standard error what it does."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any

from numba.core import event
from numba.core.event import Listener

from relguide.kernels import cache

events: Any = event
COMPILE = "numba:compile"
"""Numba's name of the event; one that is read from disk causes none."""
PATIENCE, PATIENCE_OF_A_READER = 2.0, 0.3
"""How long compiling takes before it is announced, the second at a terminal [s]."""
ONCE = "Compiling kernels for this machine, each once: they are kept in {folder} …\n"
AT_EACH_START = (
    "Compiling kernels at this start, and at each one: they can be kept in none of {folders}. "
    "Let somebody who may write to one of them run `relguide warm-up`, or set NUMBA_CACHE_DIR to a "
    "folder that you may write to.\n"
)


class _Compiled(Listener):
    """Calls a function with the seconds that each kernel took, without those that it calls."""

    def __init__(self, done: Callable[[float], None]) -> None:
        self._done = done
        self._started: list[float] = []

    def on_start(self, event: Any) -> None:
        self._started.append(monotonic())

    def on_end(self, event: Any) -> None:
        now = monotonic()
        seconds = now - self._started.pop()
        self._started = [start + seconds for start in self._started]
        if event.data["dispatcher"]._cache.cache_path == str(cache.folder()):
            self._done(seconds)


@contextmanager
def each_kernel(done: Callable[[float], None]) -> Iterator[None]:
    """Call a function with the seconds each kernel took that had to be compiled meanwhile."""
    listener = _Compiled(done)
    events.register(COMPILE, listener)
    try:
        yield
    finally:
        events.unregister(COMPILE, listener)


class FirstUse:
    """One line on standard error if kernels must be compiled before they can be used.

    Set `announced` where somebody else says so.
    """

    def __init__(self) -> None:
        self.announced = False
        self._spent = 0.0
        events.register(COMPILE, _Compiled(self._count))

    def _count(self, seconds: float) -> None:
        if self.announced:
            return
        self._spent += seconds
        at_terminal = sys.stderr is not None and sys.stderr.isatty()
        if self._spent > (PATIENCE_OF_A_READER if at_terminal else PATIENCE):
            self.announced = True
            sys.stderr.write(sentence())


def sentence() -> str:
    """What compiling is announced with."""
    if cache.is_kept(cache.folder()):
        return ONCE.format(folder=cache.folder())
    return AT_EACH_START.format(folders=", ".join(map(str, cache.places())))


first_use = FirstUse()
"""Watches from the first import on."""
