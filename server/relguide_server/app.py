"""The service as an ASGI app: `relguide serve` serves it, or `uvicorn --factory`, `app_of`."""

import asyncio
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from functools import partial
from importlib.metadata import version
from typing import Literal

from fastapi import APIRouter, FastAPI, Request
from fastapi.telemetry import TelemetryConfig
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from pydantic import BaseModel, Field
from starlette.responses import PlainTextResponse, Response
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from relguide.learn.planners import make_planner
from relguide.planning.acceptance import takes_deadline, with_deadline
from relguide.planning.outcome import Planner
from relguide_server.atc import export_routes, traffic_routes
from relguide_server.atc import routes as clearance_routes
from relguide_server.atc.desk import Desk
from relguide_server.atc.feeds.feeds import Feeds
from relguide_server.atc.reported_leaders import ReportedLeaders
from relguide_server.atc.reports import Reports
from relguide_server.atc.skies import Skies
from relguide_server.atc.watching import Watching
from relguide_server.feed_settings import feeds_of
from relguide_server.flights import (
    flight_file_routes,
    record_routes,
    routes,
    scene_relay,
    stream_docs,
)
from relguide_server.flights.catalogue import FlightCatalogue, library_catalogue
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.flights.peers import Peers
from relguide_server.http import guide, logs, pages, problem_docs
from relguide_server.http.access import Access, read_tokens
from relguide_server.http.bodies import Bodies, json_answer
from relguide_server.http.body_limit import BodyLimit
from relguide_server.http.errors import install_handlers
from relguide_server.http.head_requests import HeadAsGet
from relguide_server.http.idempotency import Idempotency
from relguide_server.http.metrics import Metrics
from relguide_server.http.openapi import describe, name_of, response, schema_of
from relguide_server.http.pages import Page
from relguide_server.http.proxy import ProxyPath
from relguide_server.http.request_log import RequestLog
from relguide_server.jobs.admission import Admission
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.planning import areas, flown_scenarios, plans, simulations
from relguide_server.planning.drift import DriftCheck
from relguide_server.planning.flown_scenarios import KeptRecordings
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.tasks import load
from relguide_server.readiness import (
    Preparation,
    PreparationOf,
    Readiness,
    needed_for,
    steps_for,
)
from relguide_server.records.clock import Clock
from relguide_server.records.service import RecordsOf, RecordsService, records_service
from relguide_server.settings import ServiceSettings, settings_from

DESCRIPTION = """Minimum-time relative guidance: plans with a proof, and flights that fly them.

Every field names its unit. Headings count clockwise from true north. Errors are problem documents
(RFC 9457). A flight is watched by WebSocket at `/api/v1/flights/{id}/stream` (see `/docs/stream`),
and in 3D at `/scene/{id}/`. The guide to all of relguide is at [`/guide/`](guide/)."""

NO_TELEMETRY: TelemetryConfig = {"tracing": False, "metrics": False, "logs": False}
"""The framework's own, which looks for exporters at each request: `Metrics` counts here."""
IN_FLIGHT = 2.0
"""How long a flight may plan at a time [s]: it waits meanwhile, and the service cannot stop it."""
router = APIRouter(tags=["service"])


TEXTS = ("text/plain", "application/openmetrics-text")


class Alive(BaseModel):
    """The service answers."""

    status: Literal["ok"] = Field(description="Nothing else is ever said.")


def create_app(
    settings: ServiceSettings | None = None,
    *,
    planner: Planner | None = None,
    catalogue: FlightCatalogue | None = None,
    preparation: Preparation | None = None,
    records: RecordsService | None = None,
    exposed: bool = False,
) -> FastAPI:
    """The whole service.

    Args:
        settings: limits; from the environment if left out.
        planner: who plans, for REST and for flights; the settings' if left out.
        catalogue: what can be flown; the library's scenarios if left out.
        preparation: compiles ahead what is not compiled yet; if left out, nothing does.
        records: keeps flights, commands and plans; if left out, nothing does.
        exposed: whether it listens to other machines.
    """
    settings = settings or settings_from()
    metrics = Metrics()
    drift = DriftCheck(metrics, every=settings.drift_check)
    preparation = preparation or Preparation()
    records = records or RecordsService(clock=Clock())
    # other processes cannot be given a planner that has no name: then threads do the work
    name = "" if planner else settings.planner
    workers = WorkerPool(
        settings.workers if name else 0, queue=settings.queue, note_wait=metrics.note_wait
    )
    planner = planner or make_planner(settings.planner)
    quick = takes_deadline(planner)
    if name != "exact":
        planner = drift.watch(planner)
    patient = preparation.guard(planner, name, waiting=True)
    if quick:
        patient = with_deadline(patient, IN_FLIGHT)
    catalogue = catalogue or library_catalogue(patient, name or None)
    fleet = LiveFleet(settings, metrics)
    metrics.watch(partial(_measure, fleet, workers))
    metrics.watch(records.measure)
    reports = Reports()
    feeds = Feeds(feeds_of(settings.feed), reports)
    metrics.watch(feeds.measure)
    skies = Skies(fleet, reports)
    leaders = ReportedLeaders(fleet, reports, skies)
    desk = Desk(skies, settings, records, metrics)
    watching = Watching(desk, reports, leaders)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        preparation.start(catalogue.rehearse)
        records.start()
        drift.start()
        fleet.start()
        feeds.start()
        watching.start()
        workers.start(partial(preparation.can_plan_by, name), partial(load, name))
        yield
        preparation.dismiss()
        await app.state.idempotency.stop()
        await feeds.stop()
        await workers.stop()
        await watching.stop()
        await desk.stop()
        await fleet.stop()
        await asyncio.to_thread(records.stop)
        await asyncio.to_thread(drift.stop)
        await asyncio.to_thread(preparation.stop)

    app = FastAPI(
        title="relguide",
        version=version("relguide"),
        summary="Minimum-time relative guidance of aircraft",
        description=DESCRIPTION,
        lifespan=lifespan,
        generate_unique_id_function=name_of,
        openapi_url=None,  # `describe` shows it
        docs_url=None,
        redoc_url=None,
        telemetry=NO_TELEMETRY,
    )
    app.state.workers, app.state.bodies = workers, Bodies()
    app.state.idempotency = Idempotency()
    app.state.plan_service = PlanService(
        name, planner, quick=quick, preparation=preparation, workers=workers, metrics=metrics
    )
    app.state.settings, app.state.catalogue = settings, catalogue
    app.state.records, app.state.recordings = records, KeptRecordings()
    app.state.reports, app.state.feeds, app.state.desk = reports, feeds, desk
    app.state.reported_place = leaders.place
    app.state.peers = Peers(settings.peers, process=settings.process)
    app.state.fleet, app.state.metrics, app.state.preparation = fleet, metrics, preparation
    app.router.routes[:0] = plans.router.routes  # most requests are for these
    for part in (
        router,
        areas.router,
        routes.router,
        simulations.router,
        flown_scenarios.router,
        record_routes.router,
        flight_file_routes.router,
        scene_relay.router,
        clearance_routes.router,
        export_routes.router,
        traffic_routes.router,
        stream_docs.router,
        problem_docs.router,
        guide.router,
        pages.router,
    ):
        app.include_router(part)
    install_handlers(app)
    describe(app)
    # The last one added is the first one passed.
    app.add_middleware(Page)
    app.add_middleware(BodyLimit, max_body=settings.max_body)
    hosts = [name.strip() for name in settings.hosts.split(",") if name.strip()]
    app.add_middleware(
        Access,
        hosts=hosts,
        tokens=read_tokens(settings.tokens),
        open_control=settings.open_control == "on",
        exposed=exposed,
    )
    app.add_middleware(RequestLog, metrics=metrics)
    app.add_middleware(HeadAsGet)
    app.add_middleware(Admission)
    app.add_middleware(ProxyHeadersMiddleware, trusted_hosts=settings.proxies)
    app.add_middleware(ProxyPath, root_path=settings.root_path, proxies=settings.proxies)
    return app


@router.get(
    "/healthz",
    summary="Is it alive?",
    responses=response(200, "It is.", schema_of(Alive)),
)
async def show_health() -> Response:
    """It answers, so it is."""
    return json_answer({"status": "ok"})


@router.get(
    "/readyz",
    summary="Is it ready?",
    responses={
        **response(200, "It flies and plans.", schema_of(Readiness)),
        **response(
            503, "The first start is not done yet, or no worker answers.", schema_of(Readiness)
        ),
    },
)
async def show_readiness(
    request: Request, preparation: PreparationOf, records: RecordsOf
) -> Response:
    """Ready once it can fly and plan: that is compiled, a flight rehearsed, and workers answer.

    Records do not count: a service whose database is gone plans and flies as ever.
    """
    workers: WorkerPool = request.app.state.workers
    answers = await workers.answers()
    report = preparation.report() | {
        "planning": {
            "answers": answers,
            "processes": len(workers.processes),
            "waiting": workers.waiting,
        },
        "records": records.report().model_dump(),
    }
    feeds: Feeds = request.app.state.feeds
    if heard := feeds.report():
        report["feeds"] = heard
    if preparation.ready and answers:
        return json_answer(report)
    report["status"] = "preparing"
    again = {"Retry-After": str(preparation.seconds_left())}
    return json_answer(report, 503, headers=again)


@router.get(
    "/metrics",
    summary="Numbers for Prometheus",
    response_class=PlainTextResponse,
    responses={
        200: {
            "description": "As text, or as OpenMetrics where that is accepted.",
            "content": {media: {"schema": {"type": "string"}} for media in TEXTS},
        }
    },
)
async def show_metrics(request: Request) -> Response:
    """What the service counts of itself, and what it measures now."""
    metrics: Metrics = request.app.state.metrics
    page, media_type = metrics.page(request.headers.get("accept", ""))
    return Response(page, media_type=media_type)


def app_of(settings: ServiceSettings | None = None, *, exposed: bool = False) -> FastAPI:
    """The service as an operator starts it: prepared ahead, recording, its log written.

    Args:
        settings: from the environment if left out.
        exposed: whether it listens to other machines.
    """
    settings = settings or settings_from()
    logs.configure(settings.log_format, settings.log_level)
    app = create_app(
        settings,
        preparation=Preparation(steps_for(settings), needed=needed_for(settings)),
        records=records_service(
            records=settings.records,
            database_url=settings.database_url,
            data=settings.data,
            record_plans=settings.record_plans,
            keep_days=settings.keep_days,
            keep_mb=settings.keep_mb,
        ),
        exposed=exposed,
    )
    app.state.metrics.serve_process()
    return app


def _measure(fleet: LiveFleet, workers: WorkerPool) -> Iterator[Metric]:
    """What changes without being counted."""
    for name, text, value in (
        ("flights_running", "Flights in the air.", sum(not flight.over for flight in fleet)),
        ("stream_clients", "Browsers on a stream.", sum(len(flight.clients) for flight in fleet)),
        ("scene_clients", "Browsers on a 3D scene.", sum(f.scene_viewers for f in fleet)),
        ("worker_processes", "Processes that plan.", len(workers.processes)),
    ):
        yield GaugeMetricFamily(f"relguide_{name}", text, value=value)
    waiting = GaugeMetricFamily("relguide_jobs_waiting", "Jobs that wait.", labels=["kind"])
    done = CounterMetricFamily("relguide_jobs_done", "Jobs done.", labels=["kind"])
    full = CounterMetricFamily(
        "relguide_jobs_refused", "Jobs refused as too many waited.", labels=["kind"]
    )
    for family, numbers in (
        (waiting, workers.waiting), (done, workers.done), (full, workers.full)
    ):  # fmt: skip
        for kind, number in numbers.items():
            family.add_metric([kind], number)
        yield family
    yield CounterMetricFamily(
        "relguide_worker_cpu_seconds", "Processor time of workers.", value=workers.processor_time
    )
    yield CounterMetricFamily(
        "relguide_workers_killed", "Workers ended and replaced.", value=workers.killed
    )
