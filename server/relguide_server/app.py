"""The service as an ASGI app: `uvicorn relguide_server.app:app`, or `relguide serve`."""

import asyncio
import os
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import APIRouter, FastAPI, Request
from starlette.responses import PlainTextResponse, Response

from relguide import __version__
from relguide.planning.plan import Planner, plan
from relguide_server import areas, flights, pages, plans, scene_relay
from relguide_server.departures import Departures, library_departures
from relguide_server.drift import DriftCheck
from relguide_server.errors import Refusal, install_handlers, run_logged
from relguide_server.fleet import Fleet
from relguide_server.guards import BodyLimit, StrictHeaders
from relguide_server.metrics import Metrics
from relguide_server.openapi import describe, json_answer, problem_responses
from relguide_server.pages import Page
from relguide_server.settings import Settings, settings_from

DESCRIPTION = """Minimum-time relative guidance: plans with a proof, and flights that fly them.

Every field names its unit. Headings count clockwise from true north. Errors are problem documents
(RFC 9457). A flight is watched by WebSocket at `/api/v1/flights/{id}/stream`, and in 3D at
`/scene/{id}/`."""

router = APIRouter(tags=["service"])


def create_app(
    settings: Settings | None = None,
    *,
    planner: Planner | None = None,
    departures: Departures | None = None,
) -> FastAPI:
    """The whole service.

    Args:
        settings: limits; from the environment if left out.
        planner: who plans, for REST and for flights; the settings' if left out.
        departures: what can be flown; the library's scenarios if left out.
    """
    settings = settings or settings_from(os.environ)
    metrics = Metrics()
    drift = DriftCheck(metrics, every=settings.drift_check)
    planner = drift.watch(planner or _planner(settings.planner))
    departures = departures or library_departures(planner)
    fleet = Fleet(settings, metrics)
    warm = threading.Event()

    def warm_up() -> None:
        if run_logged("Warming up", departures.rehearse):
            warm.set()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        # Compiling the kernels takes seconds the first time ever: the page need not wait for it.
        threading.Thread(target=warm_up, name="warm up", daemon=True).start()
        drift.start()
        fleet.start()
        yield
        await fleet.stop()
        await asyncio.to_thread(drift.stop)

    app = FastAPI(
        title="relguide",
        version=__version__,
        summary="Minimum-time relative guidance of aircraft",
        description=DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.planner, app.state.departures = planner, departures
    app.state.fleet, app.state.metrics, app.state.warm = fleet, metrics, warm
    for part in (
        router,
        plans.router,
        areas.router,
        flights.router,
        scene_relay.router,
        pages.router,
    ):
        app.include_router(part)
    install_handlers(app)
    describe(app, (*plans.MODELS, *areas.MODELS, *flights.MODELS))
    # The last one added is the first one passed.
    app.add_middleware(Page)
    app.add_middleware(BodyLimit, max_body=settings.max_body)
    app.add_middleware(StrictHeaders)
    return app


def _planner(name: str) -> Planner:
    """A planner by its name in the settings."""
    if name == "exact":
        return plan
    from relguide.learn.network_planner import network_planner
    from relguide.learn.words.branch_network import load_network

    return network_planner(load_network())


@router.get("/healthz", summary="Is it alive?")
async def healthz() -> Response:
    """It answers, so it is."""
    return json_answer({"status": "ok"})


@router.get("/readyz", summary="Is it ready?", responses=problem_responses(503))
async def readyz(request: Request) -> Response:
    """Ready once the kernels are compiled and a plan has been made; before that, plans are slow."""
    if not request.app.state.warm.is_set():
        raise Refusal(503, "The kernels are being compiled: plans are slow until then.")
    return json_answer({"status": "ready"})


@router.get("/metrics", summary="Numbers for Prometheus", response_class=PlainTextResponse)
async def metrics_page(request: Request) -> Response:
    """What the service counts of itself."""
    fleet: Fleet = request.app.state.fleet
    text = request.app.state.metrics.text(
        flights_running=sum(not flight.over for flight in fleet),
        stream_clients=sum(len(flight.clients) for flight in fleet),
        scene_clients=sum(flight.scene_viewers for flight in fleet),
    )
    return Response(text, media_type="text/plain; version=0.0.4; charset=utf-8")


app = create_app()
