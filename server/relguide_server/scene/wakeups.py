"""Lets viser be told from the thread that draws: `wake_safely(buffer)`.

Viser sets an `asyncio.Event` from the thread that adds to a scene, to have its value changed at
once, and then again on its own loop, to wake what waits. If the loop begins to wait at the very
moment of X
"""

import contextlib

from viser.infra._async_message_buffer import AsyncMessageBuffer


def wake_safely(buffer: AsyncMessageBuffer) -> None:
    """Have a buffer's event set from any thread."""
    event = buffer.message_event
    set_at_once = event.set

    def set_from_any_thread() -> None:
        # "deque mutated during iteration": the value is set by then
        with contextlib.suppress(RuntimeError):
            set_at_once()

    event.set = set_from_any_thread  # type: ignore[method-assign]
