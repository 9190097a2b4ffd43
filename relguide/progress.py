"""A progress bar on standard error, for what takes longer than two seconds."""

from collections.abc import Callable, Iterable, Iterator
from time import monotonic
from typing import TypeVar

PATIENCE = 2.0
"""How long nothing is shown [s]."""
REFRESH = 0.1
"""Between two updates [s]."""

T = TypeVar("T")


def watched(
    items: Iterable[T], *, title: str, total: float, done: Callable[[T], float]
) -> Iterator[T]:
    """Pass items through, with a bar once they have taken longer than two seconds.

    Args:
        items: what is waited for.
        title: what the bar is called.
        total: what `done` reaches at the end; 0 if that is not known.
        done: how far an item has brought us.
    """
    started = monotonic()
    source = iter(items)
    for item in source:
        yield item
        if monotonic() - started > PATIENCE:
            break
    else:
        return
    # rich takes 50 ms to load, which what is quick need not pay
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    shown = 0.0
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as progress:
        task = progress.add_task(title, total=total or None)
        for item in source:
            yield item
            if monotonic() - shown > REFRESH:
                shown = monotonic()
                progress.update(task, completed=done(item))
