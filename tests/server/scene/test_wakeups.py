"""A scene is drawn from a thread of its own, at whatever moment viser's loop begins to wait."""

import asyncio
from collections import deque

from relguide_server.scene.wakeups import wake_safely
from viser import ViserServer


class Changing(deque[asyncio.Future[bool]]):
    """As who waits changes in the middle of being told."""

    def __iter__(self):  # type: ignore[no-untyped-def]
        raise RuntimeError("deque mutated during iteration")


def test_what_is_drawn_while_the_loop_begins_to_wait_is_drawn() -> None:
    server = ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        buffer = server._websock_server.get_message_buffer()
        wake_safely(buffer)
        buffer.message_event._waiters = Changing()
        before = buffer.message_counter
        server.scene.add_frame("/one")
        assert buffer.message_counter > before
        assert buffer.message_event.is_set()
    finally:
        buffer.message_event._waiters = deque()
        server.stop()
