"""The thread that draws a flight in 3D, as long as it has viewers."""

import asyncio
import threading
import time
from collections.abc import Sequence

import rich

from relguide.flying.documents import Document
from relguide.planning.frames import LocalPlane
from relguide_server.http.errors import run_logged
from relguide_server.scene.extrapolation import Glide
from relguide_server.scene.guarded_port import guard_viser
from relguide_server.scene.inbox import Inbox

LOOPBACK = "127.0.0.1"


class SceneStage:
    """One viser server and its thread. Made, fed and closed on the event loop."""

    def __init__(
        self, name: str, past: Sequence[Document], plane: LocalPlane | None = None
    ) -> None:
        self._name = name
        self._plane = plane
        self._loop = asyncio.get_running_loop()
        self._address: asyncio.Future[str] = self._loop.create_future()
        self._inbox = Inbox()
        self._past = list(past)
        self._thread = threading.Thread(target=self._run, name=f"scene {name}", daemon=True)
        self._thread.start()

    def offer(self, documents: Sequence[Document]) -> None:
        """Draw these soon; a sample overtaken by a newer one is left out."""
        for document in documents:
            self._inbox.put(document)

    async def address(self) -> str:
        """Where its viser server is, once the first picture is drawn; empty if it failed."""
        return await asyncio.shield(self._address)

    async def close(self) -> None:
        """Close the scene; the connections of its viewers are closed."""
        self._inbox.close()
        await asyncio.to_thread(self._thread.join, 1.0)
        if not self._address.done():
            self._address.set_result("")

    def _run(self) -> None:
        if not run_logged(f"The 3D scene of flight {self._name}", self._draw_all):
            self._answer("")

    def _draw_all(self) -> None:
        # Imported here because it takes a third of a second, and the page must not wait for it.
        from viser import ViserServer

        from relguide_server.scene.flight_scene import FlightScene
        from relguide_server.scene.wakeups import wake_safely

        rich.get_console().quiet = True  # viser says goodbye there each time a scene closes
        guard_viser()
        server = ViserServer(host=LOOPBACK, port=0, verbose=False)
        wake_safely(server._websock_server.get_message_buffer())
        server.on_client_connect(
            lambda client: wake_safely(client._websock_connection.get_message_buffer())
        )
        try:
            scene = FlightScene(server, self._plane)
            scene.draw(self._past)
            self._answer(f"{LOOPBACK}:{server.get_port()}")
            glide = Glide()
            while not self._inbox.closed:
                if documents := self._inbox.wait(glide.patience(time.monotonic())):
                    scene.draw(documents)
                    glide.note(documents, time.monotonic())
                else:
                    scene.glide(glide.ahead(time.monotonic()))
        finally:
            server.stop()

    def _answer(self, address: str) -> None:
        def settle() -> None:
            if not self._address.done():
                self._address.set_result(address)

        self._loop.call_soon_threadsafe(settle)
