"""Viser's page at `/scene/{id}/` on our own port, its WebSocket relayed to the flight's scene.

The page connects to its own address, less one trailing slash, so the WebSocket is served at both.
Only messages that a viewer needs are passed on: any client of viser could otherwise ask it to open
a tunnel to the outside (`ShareUrlRequest`), whether or not its button is shown.
"""

import asyncio
import gzip
from contextlib import suppress
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from math import isfinite
from pathlib import Path

import msgspec
from fastapi import APIRouter, Request, WebSocket, WebSocketDisconnect
from starlette.responses import RedirectResponse, Response
from starlette.websockets import WebSocketState
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.typing import Subprotocol

from relguide_server.flights.frames import FrameAllowance
from relguide_server.flights.live_fleet import FleetOf
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.flights.watchers import TooManyWatch
from relguide_server.http.metrics import Metrics
from relguide_server.http.proxy import root_of
from relguide_server.scene.guarded_port import HEADER, SECRET

CAMERA = {
    "wxyz": 4, "position": 3, "fov": 0, "near": 0, "far": 0, "image_height": 0, "image_width": 0,
    "look_at": 3, "up_direction": 3,
}  # fmt: skip
"""What a browser tells the scene of its camera: numbers, and vectors of so many."""
SCENE_CSP = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self' data: blob:; worker-src 'self' blob:; frame-ancestors 'self'; "
    "base-uri 'self'; object-src 'none'; form-action 'self'"
)
"""What viser's page may load: it holds its scripts, a decoder and workers within itself, and it
evaluates text."""
WRITTEN_ON = b"""<script>
  // The cockpit's page writes on the picture: with each one it is given the camera's matrices.
  // three.js shows its renderers to whoever listens here.
  window.__THREE_DEVTOOLS__ = new EventTarget();
  window.__THREE_DEVTOOLS__.addEventListener("observe", ({ detail: renderer }) => {
    if (!renderer.isWebGLRenderer) return;
    queueMicrotask(() => {
      const render = renderer.render;
      renderer.render = (scene, camera) => {
        renderer.toneMapping = 0; // colours as they are: green is the display's green
        render.call(renderer, scene, camera);
        window.onpicture?.(camera.projectionMatrix.elements, camera.matrixWorldInverse.elements);
      };
    });
  });
</script>"""
"""Put before the scripts of viser's page."""
PRESSED = {"value": True}
"""All that a browser may change of a button: viser sets whatever else it is told to."""
NOT_PASSED_ON = (1008, "The scene takes camera and button messages only.")
MOST = 120
"""Messages a second: a camera that is dragged sends one a picture."""
TOO_FAST = (1008, f"The scene takes {MOST} messages a second: send less.")


router = APIRouter(include_in_schema=False)


@router.get("/scene/{flight_id}")
async def redirect_to_slash(flight_id: str, request: Request, fleet: FleetOf) -> Response:
    """The page lives under a trailing slash."""
    fleet.find(flight_id)
    return RedirectResponse(f"{root_of(request.scope)}/scene/{flight_id}/", 308)


@router.get("/scene/{flight_id}/")
async def page(flight_id: str, request: Request, fleet: FleetOf) -> Response:
    """Viser's own client: one self-contained page, the same for all flights."""
    fleet.find(flight_id)
    html, packed, tag = _client_page()
    headers = {
        "ETag": tag,
        "Cache-Control": "no-cache",
        "Vary": "Accept-Encoding",
        "Content-Security-Policy": SCENE_CSP,
    }
    if tag in request.headers.get("if-none-match", ""):
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        headers["Content-Encoding"] = "gzip"
        return Response(packed, media_type="text/html", headers=headers)
    return Response(html, media_type="text/html", headers=headers)


@router.websocket("/scene/{flight_id}")
@router.websocket("/scene/{flight_id}/")
async def relay(websocket: WebSocket, flight_id: str, fleet: FleetOf) -> None:
    """Between a browser and the scene's own server, until either side ends it."""
    if not fleet.knows(flight_id):
        await websocket.close()  # before it is accepted: the browser gets 403
        return
    flight = fleet.find(flight_id)
    try:
        with flight.viewers.joined_by(websocket):
            try:
                await _relay(websocket, flight)
            finally:
                await flight.leave_scene()
    except TooManyWatch:
        await websocket.close()


async def _relay(websocket: WebSocket, flight: LiveFlight) -> None:
    address = await flight.enter_scene()
    offered = [Subprotocol(name) for name in websocket.scope["subprotocols"]]
    try:
        scene = await connect(
            f"ws://{address}",
            additional_headers={HEADER: SECRET},
            subprotocols=offered or None,
            compression=None,
            max_size=None,
            ping_interval=None,
            close_timeout=1.0,
            proxy=None,
        )
    except (OSError, WebSocketException):
        await websocket.close()
        return
    try:
        await websocket.accept(scene.subprotocol)
        downward = asyncio.create_task(_to_browser(scene, websocket))
        upward = asyncio.create_task(_to_scene(websocket, scene))
        try:
            done, _ = await asyncio.wait((downward, upward), return_when=asyncio.FIRST_COMPLETED)
        finally:
            downward.cancel()
            upward.cancel()
        for task in done:
            refused = task.result()  # a mistake of ours in there is raised here
            if refused is not None and websocket.application_state is WebSocketState.CONNECTED:
                metrics: Metrics = websocket.app.state.metrics
                why = "too_fast" if refused is TOO_FAST else "not_passed_on"
                metrics.frames_refused.labels(why).inc()
                with suppress(WebSocketDisconnect):
                    await websocket.close(*refused)
    finally:
        await scene.close()


async def _to_browser(scene: ClientConnection, websocket: WebSocket) -> None:
    try:
        async for message in scene:
            if isinstance(message, bytes):
                await websocket.send_bytes(message)
            else:
                await websocket.send_text(message)
    except WebSocketDisconnect:
        return
    except ConnectionClosed:
        pass
    if websocket.application_state is WebSocketState.CONNECTED:
        code = scene.close_code if scene.close_code in (1000, 1001, 1002) else 1001
        with suppress(WebSocketDisconnect):
            await websocket.close(code, scene.close_reason or "")


async def _to_scene(websocket: WebSocket, scene: ClientConnection) -> tuple[int, str] | None:
    """Pass on what a browser sends, until it is gone: `None`, or why its socket is to be closed."""
    allowance = FrameAllowance(MOST)
    try:
        while True:
            event = await websocket.receive()
            if event["type"] == "websocket.disconnect":
                return None
            if not allowance.admits_one():
                return TOO_FAST
            message = event.get("bytes") or b""
            if not may_pass(message):
                return NOT_PASSED_ON
            await scene.send(message)
    except ConnectionClosed:
        return None


def may_pass(message: bytes) -> bool:
    """Whether a browser's message is passed on, judged by viser's own decoder."""
    try:
        content = msgspec.msgpack.decode(message)
    except msgspec.DecodeError:
        return False
    match content:
        case {"type": "ViewerCameraMessage", **camera}:
            if camera.keys() != CAMERA.keys():
                return False
            return all(_is_of(camera[name], count) for name, count in CAMERA.items())
        case {"type": "GuiUpdateMessage", "uuid": str(), "updates": updates, **rest}:
            return updates == PRESSED and not rest
    return False


def _is_of(value: object, count: int) -> bool:
    """Whether something is a finite number, or a vector of so many."""
    if count:
        return isinstance(value, list) and len(value) == count and all(_is_of(v, 0) for v in value)
    return isinstance(value, int | float) and isfinite(value)


@cache
def _client_page() -> tuple[bytes, bytes, str]:
    # Found without importing viser, which takes time: the cockpit's page must not wait for it.
    viser = find_spec("viser")
    assert viser is not None
    assert viser.origin is not None
    built = (Path(viser.origin).parent / "client" / "build" / "index.html").read_bytes()
    html = built.replace(b"<head>", b"<head>" + WRITTEN_ON, 1)
    return html, gzip.compress(html, 9), f'"{sha256(html).hexdigest()[:20]}"'
