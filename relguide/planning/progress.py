"""A progress bar on standard error, for what takes longer than two seconds; in a log, a line."""

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from shutil import get_terminal_size
from threading import Lock, Timer
from time import monotonic
from typing import TextIO, TypeVar

from relguide.planning.inputs import number

PATIENCE = 2.0
"""How long nothing is shown [s]."""
REFRESH = 0.1
"""Between two updates [s]."""
LOGGED = 120.0
"""Between two lines where standard error is no terminal, but a file or a log [s]."""
LENGTH = 40
"""Of the bar [characters]."""

T = TypeVar("T")


def show_progress(
    items: Iterable[T],
    *,
    title: str,
    total: float,
    done: Callable[[T], float],
    state: Callable[[T], str] = lambda _: "",
) -> Iterator[T]:
    """Pass items through, with a bar once they have taken longer than two seconds.

    Args:
        items: what is waited for.
        title: what the bar is called.
        total: what `done` reaches at the end; 0 if that is not known.
        done: how far an item has brought us.
        state: what more to say of it, behind the title.
    """
    with _show_bar(title, total) as bar:
        for item in items:
            yield item
            if bar.due:
                bar.draw(done(item), state(item))


@contextmanager
def progress_bar(title: str, *, total: float) -> Iterator[Callable[[float], None]]:
    """A bar once it has taken longer than two seconds; yields what to call with each advance.

    Examples:
        >>> with rg.progress_bar("planning", total=2) as count:
        ...     for name in ("fig_6a", "fig_6b"):
        ...         answer = rg.plan(rg.scenario(name).situation)
        ...         count(1)

    Args:
        title: what the bar is called.
        total: what the advances sum up to, in any unit.

    Raises:
        ValueError: if `total` or an advance is no number.
    """
    total = number("total", total)
    reached = 0.0
    with _show_bar(title, total) as bar:

        def count(advance: float) -> None:
            nonlocal reached
            reached += number("advance", advance)
            if bar.due:
                bar.draw(reached)

        yield count


class _Bar:
    """One line on a terminal, drawn in place; else a line now and then."""

    def __init__(self, title: str, total: float, terminal: TextIO) -> None:
        self._title, self._total, self._terminal = title, total, terminal
        self._watched = terminal.isatty()
        self._began = self._drawn = monotonic()
        self._shown = False
        self._lock = Lock()  # the clock that shows the bar is a thread of its own

    @property
    def due(self) -> bool:
        """Whether it is time to draw it again."""
        since = monotonic() - self._drawn
        return self._shown and since > REFRESH if self._watched else since > LOGGED

    def show(self) -> None:
        """Draw it for the first time."""
        self._shown = True
        self.draw(0.0)

    def draw(self, reached: float, state: str = "") -> None:
        """Draw it as it stands: how far, and how long it will still take at this pace."""
        self._drawn = monotonic()
        name = f"{self._title} {state}".rstrip()
        share = min(max(reached / self._total, 0.0), 1.0) if self._total > 0.0 else 0.0
        if share > 0.0:
            left = (self._drawn - self._began) * (1.0 / share - 1.0)
            filled = round(share * LENGTH)
            line = f" {'━' * filled}{'╌' * (LENGTH - filled)}" if self._watched else ""
            name += f"{line} {share:4.0%}, {left:.0f} s left"
        else:
            name += " …"
        self._write(name)

    def clear(self) -> None:
        """Take it away."""
        if self._shown:
            self._write("")

    def _write(self, line: str) -> None:
        width = get_terminal_size().columns - 1  # a full line would be wrapped
        drawn = f"\r{line[:width]:<{width}}\r{line[:width]}" if self._watched else f"{line}\n"
        with self._lock:
            self._terminal.write(drawn)
            self._terminal.flush()


@contextmanager
def _show_bar(title: str, total: float) -> Iterator[_Bar]:
    """A bar that stays hidden until `PATIENCE` is over.

    A clock of its own shows it: the first item may be what takes so long.
    """
    bar = _Bar(title, total, sys.stderr)
    if not sys.stderr.isatty():  # no thread: processes begin as copies of this one
        yield bar
        return
    clock = Timer(PATIENCE, bar.show)
    clock.daemon = True
    clock.start()
    try:
        yield bar
    finally:
        clock.cancel()
        clock.join()  # it may be about to show the bar
        bar.clear()
