"""The service as an ASGI app: `uvicorn relguide_server.app:app`, or `relguide serve`."""

import asyncio
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from importlib.metadata import version

from fastapi import APIRouter, FastAPI, Request
from starlette.responses import PlainTextResponse, Response

from relguide.learn.planners import make_planner
from relguide.planning.acceptance import takes_deadline, with_deadline
from relguide.planning.plan import Planner
from relguide_server import areas, flights, pages, plans, record_routes, scene_relay
from relguide_server.access import Access, read_tokens
from relguide_server.departures import Departures, library_departures
from relguide_server.drift import DriftCheck
from relguide_server.errors import install_handlers
from relguide_server.guards import BodyLimit, HeadAsGet, StrictHeaders
from relguide_server.jobs import load
from relguide_server.live_fleet import Fleet
from relguide_server.metrics import Metrics
from relguide_server.openapi import describe, json_answer, response, schema_of
from relguide_server.pages import Page
from relguide_server.plan_desk import PlanDesk
from relguide_server.preparation import Preparation, PreparationOf, Readiness, steps_for
from relguide_server.records.clock import Clock
from relguide_server.records.keeper import Keeper, KeeperOf, keep
from relguide_server.settings import Settings, settings_from
from relguide_server.workers import Workers

DESCRIPTION = """Minimum-time relative guidance: plans with a proof, and flights that fly them.

Every field names its unit. Headings count clockwise from true north. Errors are problem documents
(RFC 9457). A flight is watched by WebSocket at `/api/v1/flights/{id}/stream`, and in 3D at
`/scene/{id}/`."""

IN_FLIGHT = 2.0
"""How long a flight may plan at a time [s]: it waits meanwhile, and the service cannot stop it."""
router = APIRouter(tags=["service"])


def create_app(
    settings: Settings | None = None,
    *,
    planner: Planner | None = None,
    departures: Departures | None = None,
    preparation: Preparation | None = None,
    keeper: Keeper | None = None,
) -> FastAPI:
    """The whole service.

    Args:
        settings: limits; from the environment if left out.
        planner: who plans, for REST and for flights; the settings' if left out.
        departures: what can be flown; the library's scenarios if left out.
        preparation: compiles ahead what is not compiled yet; if left out, nothing does.
        keeper: records flights, commands and plans; if left out, nothing does.
    """
    settings = settings or settings_from(os.environ)
    metrics = Metrics()
    drift = DriftCheck(metrics, every=settings.drift_check)
    preparation = preparation or Preparation()
    keeper = keeper or Keeper(clock=Clock())
    # other processes cannot be given a planner that has no name: then threads do the work
    name = "" if planner else settings.planner
    workers = Workers(settings.workers if name else 0, queue=settings.queue)
    planner = planner or make_planner(settings.planner)
    quick = takes_deadline(planner)
    if name != "exact":
        planner = drift.watch(planner)
    patient = preparation.guard(planner, name, waiting=True)
    if quick:
        patient = with_deadline(patient, IN_FLIGHT)
    departures = departures or library_departures(patient)
    fleet = Fleet(settings, metrics)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        preparation.start(departures.rehearse)
        keeper.start()
        drift.start()
        fleet.start()
        workers.start(partial(preparation.can_plan_by, name), partial(load, name))
        yield
        await workers.stop()
        await fleet.stop()
        await asyncio.to_thread(keeper.stop)
        await asyncio.to_thread(drift.stop)
        await asyncio.to_thread(preparation.stop)

    app = FastAPI(
        title="relguide",
        version=version("relguide"),
        summary="Minimum-time relative guidance of aircraft",
        description=DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.workers = workers
    app.state.desk = PlanDesk(
        name, planner, quick=quick, preparation=preparation, workers=workers, metrics=metrics
    )
    app.state.settings, app.state.departures = settings, departures
    app.state.keeper = keeper
    app.state.fleet, app.state.metrics, app.state.preparation = fleet, metrics, preparation
    for part in (
        router,
        plans.router,
        areas.router,
        flights.router,
        record_routes.router,
        scene_relay.router,
        pages.router,
    ):
        app.include_router(part)
    install_handlers(app)
    describe(app, (Readiness, *plans.MODELS, *areas.MODELS, *flights.MODELS, *record_routes.MODELS))
    # The last one added is the first one passed.
    app.add_middleware(Page)
    app.add_middleware(BodyLimit, max_body=settings.max_body)
    hosts = [name.strip() for name in settings.hosts.split(",") if name.strip()]
    app.add_middleware(Access, hosts=hosts, tokens=read_tokens(settings.tokens))
    app.add_middleware(StrictHeaders)
    app.add_middleware(HeadAsGet)
    return app


@router.get("/healthz", summary="Is it alive?")
async def healthz() -> Response:
    """It answers, so it is."""
    return json_answer({"status": "ok"})


@router.get(
    "/readyz",
    summary="Is it ready?",
    responses={
        **response(200, "All that it serves is compiled.", schema_of(Readiness)),
        **response(
            503, "The first start is not done yet, or no worker answers.", schema_of(Readiness)
        ),
    },
)
async def readyz(request: Request, preparation: PreparationOf, keeper: KeeperOf) -> Response:
    """Ready once all that it serves is compiled, a flight has been rehearsed and workers answer.

    Records do not count: a service whose database is gone plans and flies as ever.
    """
    workers: Workers = request.app.state.workers
    report = preparation.report() | {
        "planning": {
            "answers": workers.ready,
            "processes": len(workers.processes),
            "waiting": workers.waiting,
        },
        "records": keeper.report().model_dump(),
    }
    if preparation.ready and workers.ready:
        return json_answer(report)
    report["status"] = "preparing"
    again = {"Retry-After": str(preparation.seconds_left())}
    return json_answer(report, 503, headers=again)


@router.get("/metrics", summary="Numbers for Prometheus", response_class=PlainTextResponse)
async def metrics_page(request: Request, keeper: KeeperOf) -> Response:
    """What the service counts of itself."""
    fleet: Fleet = request.app.state.fleet
    text: str = request.app.state.metrics.text(
        flights_running=sum(not flight.over for flight in fleet),
        stream_clients=sum(len(flight.clients) for flight in fleet),
        scene_clients=sum(flight.scene_viewers for flight in fleet),
    )
    text += keeper.figures_text()
    return Response(text, media_type="text/plain; version=0.0.4; charset=utf-8")


_settings = settings_from(os.environ)
app = create_app(
    _settings,
    preparation=Preparation(steps_for(_settings)),
    keeper=keep(
        records=_settings.records,
        database_url=_settings.database_url,
        data=_settings.data,
        record_plans=_settings.record_plans,
        keep_days=_settings.keep_days,
        keep_mb=_settings.keep_mb,
    ),
)
