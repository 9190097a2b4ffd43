"""The service on a real port for tests: real HTTP, real WebSocket frames."""

import asyncio
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import starlette.testclient
import uvicorn
from fastapi import FastAPI
from relguide_server.app import create_app
from relguide_server.flights.catalogue import FlightCatalogue, RequestedFlight
from relguide_server.serving import Server, uvicorn_options
from relguide_server.settings import ServiceSettings
from starlette.testclient import WebSocketTestSession
from starlette.types import ASGIApp

from relguide.contract.messages import (
    FlightRequest,
    ScenarioFlightRequest,
    ScenarioInfo,
    ScenarioList,
)
from relguide.contract.refusal import ContractError
from relguide.flying.documents import Document
from relguide.planning.plan import plan
from tests.server.flown import SITUATION, ideal_flight


class TestClient(starlette.testclient.TestClient):
    """A client on this machine: the service does not answer for other names."""

    def __init__(self, app: ASGIApp, **options: Any) -> None:
        given = {"base_url": "http://localhost", "client": ("127.0.0.1", 50000)} | options
        super().__init__(app, **given)

    def websocket_connect(self, url: str, *arguments: Any, **options: Any) -> WebSocketTestSession:
        return super().websocket_connect(f"ws://localhost{url}", *arguments, **options)


def ideal_catalogue(
    source: Callable[..., Iterator[Document]] = ideal_flight, *, broken: bool = False
) -> FlightCatalogue:
    """One scenario, "ideal", flown by a source that the test gives."""

    def find(wanted: FlightRequest) -> RequestedFlight:
        if isinstance(wanted, ScenarioFlightRequest) and wanted.scenario != "ideal":
            raise ContractError([("scenario", 'must be "ideal".')])
        return RequestedFlight(scenario="ideal", title="Exact trajectories", source=source)

    info = ScenarioInfo(
        name="ideal", title="Exact trajectories", description="", available=True, message=""
    )
    return FlightCatalogue(
        scenarios=lambda: ScenarioList(scenarios=[info]),
        find=find,
        rehearse=lambda: plan(SITUATION) and None,
    )


def ideal_app(
    source: Callable[..., Iterator[Document]] = ideal_flight,
    *,
    exposed: bool = False,
    **settings: float | str,
) -> FastAPI:
    """The service with ideal flights."""
    limits = ServiceSettings(**{"workers": 0, **settings})  # type: ignore[arg-type]
    return create_app(limits, catalogue=ideal_catalogue(source), exposed=exposed)


@contextmanager
def serve(app: FastAPI, *, most: int = 512, proxies: str = "") -> Iterator[str]:
    """Serve an app on a free port of this machine; gives `127.0.0.1:port`."""
    options = uvicorn_options(host="127.0.0.1", port=0, most=most, proxies=proxies)
    config = uvicorn.Config(app, **options)
    server = Server(config)

    def run() -> None:
        # the loop that `relguide serve` takes, uvloop where there is one
        with asyncio.Runner(loop_factory=config.get_loop_factory()) as runner:
            runner.run(server.serve())

    thread = threading.Thread(target=run, name="service")
    thread.start()
    try:
        while not server.started:
            assert thread.is_alive(), "The service did not start."
            thread.join(0.01)
        port = server.servers[0].sockets[0].getsockname()[1]
        yield f"127.0.0.1:{port}"
    finally:
        server.should_exit = True
        thread.join(15.0)
        assert not thread.is_alive(), "The service did not stop."
