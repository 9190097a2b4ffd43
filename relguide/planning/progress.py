"""A progress bar on standard error, for what takes longer than two seconds."""

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from threading import Timer
from time import monotonic
from typing import TYPE_CHECKING, TypeVar

from relguide.planning.inputs import number

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

PATIENCE = 2.0
"""How long nothing is shown [s]."""
REFRESH = 0.1
"""Between two updates [s]."""

T = TypeVar("T")


def watched(
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
    shown = 0.0
    with _bar(title, total) as bars:
        for item in items:
            yield item
            if bars and monotonic() - shown > REFRESH:
                shown = monotonic()
                progress, task = bars[0]
                progress.update(
                    task, completed=done(item), description=f"{title} {state(item)}".rstrip()
                )


@contextmanager
def progress_bar(title: str, *, total: float) -> Iterator[Callable[[float], None]]:
    """A bar once it has taken longer than two seconds; yields what to call with each advance.

    Args:
        title: what the bar is called.
        total: what the advances sum up to.

    Raises:
        ValueError: if `total` or an advance is no number.
    """
    total = number("total", total)
    reached = 0.0
    with _bar(title, total) as bars:

        def count(advance: float) -> None:
            nonlocal reached
            reached += number("advance", advance)
            for progress, task in bars:
                progress.update(task, completed=reached)

        yield count


@contextmanager
def _bar(title: str, total: float) -> Iterator["list[tuple[Progress, TaskID]]"]:
    """The bar in a list, which stays empty until it is shown.

    A clock of its own shows it: the first item may be what takes so long.
    """
    bars: list[tuple[Progress, TaskID]] = []

    def show() -> None:
        # rich takes 50 ms to load, which what is quick need not pay
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

        columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
        progress = Progress(*columns, console=Console(stderr=True), transient=True)
        progress.start()
        bars.append((progress, progress.add_task(title, total=total or None)))

    clock = Timer(PATIENCE, show)
    clock.daemon = True
    if not sys.stderr.isatty():
        yield bars
        return
    clock.start()
    try:
        yield bars
    finally:
        clock.cancel()
        clock.join()  # it may be about to show the bar
        for progress, _ in bars:
            progress.stop()
