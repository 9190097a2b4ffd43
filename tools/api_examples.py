"""Examples of answers for the OpenAPI document, as the service sends them.

    python -m tools.api_examples

writes them to `server/relguide_server/http/api_examples.json`; what differs from run to run is
written the same each time.
"""

import re
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import orjson
from relguide_server.app import create_app
from relguide_server.atc.traffic_routes import TRAFFIC_EXAMPLE
from relguide_server.http import openapi
from relguide_server.planning.plans import AMID, EXAMPLE
from relguide_server.records.service import records_service
from relguide_server.settings import ServiceSettings

from relguide.contract.moments import moment
from tests.server.serving import TestClient

FILE = Path(openapi.__file__).with_name(openapi.EXAMPLES)
COMMAND = "python -m tools.api_examples"
ID = "3f2a9c0d71be"
"""What every flight is called in the examples."""
WHEN = "2026-11-22T09:30:00.000+00:00"
VARYING = {"compute_ms": 0.09, "wall_s": 0.8, "bytes": 1800, "processes": 2, "age_s": 0.4}
"""What no two runs have alike."""
SHOWN = 6
"""Numbers of a column, at most."""
GRID = {"columns": 4, "rows": 4, "width_m": 60e3, "height_m": 60e3}
STRAIGHT = {**EXAMPLE, "leader": {**EXAMPLE["leader"], "intent": []}}


def ask(client: TestClient) -> dict[str, Any]:
    """Each operation that answers in JSON, and what it answers."""
    area = {"situation": STRAIGHT, "levels_s": [600.0], **GRID}
    text = orjson.dumps(STRAIGHT).decode()
    found = {
        "show_health": client.get("/healthz").json(),
        "show_readiness": _wait_for(client, "/readyz", lambda got: got["status"] == "ready"),
        "make_plan": client.post("/api/v1/plans", json=EXAMPLE).json(),
        "make_plans": client.post("/api/v1/plans/batch", json=[EXAMPLE | {"id": "a"}, AMID]).json(),
        "compare_planners": client.post("/api/v1/plans/compare", json=STRAIGHT).json(),
        "draw_area_of_body": client.post("/api/v1/areas", json=area).json(),
        "show_area": client.get(
            "/api/v1/areas", params={"situation": text, "level_s": 600.0, **GRID}
        ).json(),
        "list_scenarios": client.get("/api/v1/scenarios").json(),
        "simulate_flights": client.post(
            "/api/v1/simulations", json=[{"scenario": "fig_6b"}]
        ).json(),
    }
    traffic = {**TRAFFIC_EXAMPLE, "as_of": moment(time.time())}
    found |= {
        "put_traffic": client.put("/api/v1/traffic", json=traffic).json(),
        "show_traffic": client.get("/api/v1/traffic").json(),
    }
    started = client.post("/api/v1/flights", json={"scenario": "fig_6b", "paused": True}).json()
    flight = f"/api/v1/flights/{started['id']}"
    recorded = f"/api/v1/records/flights/{started['id']}"
    found |= {
        "start_flight": started,
        "show_flight": client.get(flight).json(),
        "list_flights": client.get("/api/v1/flights").json(),
        "command_flight": client.post(
            f"{flight}/commands", json={"command": "leader_heading", "heading_deg": 135.0}
        ).json(),
    }
    asked = client.post("/api/v1/clearances", json={"flight_id": started["id"]}).json()
    clearance = f"/api/v1/clearances/{asked['id']}"
    found |= {
        "ask_clearance": asked,
        "show_sky": client.get("/api/v1/atc/traffic", params={"sky": started["id"]}).json(),
        "show_clearance": _wait_for(client, clearance, lambda got: got["state"] == "accepted"),
        "list_clearances": client.get("/api/v1/clearances").json(),
        "reply_clearance": client.post(f"{clearance}/replies", json={"reply": "WILCO"}).json(),
        "answer_clearance": client.post(
            f"{clearance}/answers", json={"answer": "cancelled"}
        ).json(),
    }
    client.delete(flight)
    found |= {
        "show_recorded": _wait_for(client, recorded, lambda got: got["outcome"] == "removed"),
        "list_recorded": client.get("/api/v1/records/flights").json(),
        "list_plans": client.get("/api/v1/records/plans").json(),
        "list_documents": client.get(f"{recorded}/documents?limit=1").json(),
        "replay_flight": client.post(f"{recorded}/replay", json={"paused": True}).json(),
    }
    return {name: _settle(answer) for name, answer in found.items()}


def answers() -> dict[str, Any]:
    """What a service of its own answers."""
    with TemporaryDirectory() as data:
        records = records_service(
            records="on", database_url="", data=data, record_plans=10, keep_days=1.0, keep_mb=10.0
        )
        with TestClient(create_app(ServiceSettings(workers=1), records=records)) as client:
            return ask(client)


def _wait_for(client: TestClient, path: str, there: Any) -> Any:
    end = time.monotonic() + 60.0
    while not there(got := client.get(path).json()):
        assert time.monotonic() < end, got
        time.sleep(0.1)
    return got


def _settle(said: Any) -> Any:
    """The same, without what differs from run to run."""
    match said:
        case dict():
            return {name: _settle(VARYING.get(name, part)) for name, part in said.items()}
        case [float(), float(), *_]:
            return [_settle(part) for part in said[:SHOWN]]
        case list():
            return [_settle(part) for part in said]
        case str():
            said = re.sub(r"\b[0-9a-f]{12}\b", ID, said)
            return WHEN if re.match(r"\d{4}-\d\d-\d\dT", said) else said
        case float():
            return float(f"{said:.9g}")
        case _:
            return said


def names_in(said: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """The path of each value, and its type."""
    match said:
        case dict():
            for name, part in said.items():
                yield from names_in(part, f"{path}.{name}")
        case list():
            for part in said[:1]:
                yield from names_in(part, f"{path}[]")
        case bool() | str() | None:
            yield path, type(said).__name__
        case _:
            yield path, "number"


if __name__ == "__main__":
    FILE.write_bytes(orjson.dumps(answers(), option=orjson.OPT_INDENT_2) + b"\n")
    sys.stdout.write(f"{FILE}\n")
