"""Requests for clearances on the earth, without any flight: an aircraft behind reported traffic."""

import time
from typing import Any

import httpx2 as httpx

from tests.server.serving import TestClient

CLEARANCES = "/api/v1/clearances"
METRES_A_DEGREE = 71_700.0
"""Of longitude at 50° N."""
LEADER = "LDR 1"


def report(client: TestClient, headers: dict[str, str] | None = None) -> None:
    """Say that a leader flies east at 200 m/s, now."""
    now = time.time()
    stamp = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(now)) + f".{int(now % 1 * 1e3):03d}Z"
    leader = {
        "ident": LEADER, "lat_deg": 50.0, "lon_deg": 8.0, "altitude_m": 9_449.0, "track_deg": 90.0,
        "ground_speed_mps": 200.0,
    }  # fmt: skip
    body = {"as_of": stamp, "aircraft": [leader]}
    answer = client.put("/api/v1/traffic", json=body, headers=headers)
    assert answer.status_code == 200, answer.text


def request(
    ident: str = "RG 06", *, behind: float = 12_000.0, minimum: float = 9_260.0
) -> dict[str, Any]:
    """Who is in its place already, and asks to stay there.

    Args:
        ident: of who asks.
        behind: how far behind the leader it is, and asks to be [m].
        minimum: d_min [m].
    """
    return {
        "aircraft": {
            "ident": ident, "lat_deg": 50.0, "lon_deg": 8.0 - behind / METRES_A_DEGREE,
            "heading_deg": 90.0, "tas_mps": 200.0, "max_bank_deg": 25.0, "altitude_m": 9_449.0,
        },
        "intent": [{"straight_s": 30.0}],
        "traffic_id": LEADER,
        "assigned_spacing_goal": {"type": "distance", "value_m": behind},
        "min_separation_m": minimum,
    }  # fmt: skip


def ask(
    client: TestClient, body: dict[str, Any] | None = None, headers: dict[str, str] | None = None
) -> dict[str, Any]:
    """Ask, and wait until it is validated."""
    report(client, headers)
    asked = client.post(CLEARANCES, json=body or request(), headers=headers)
    assert asked.status_code == 201, asked.text
    return validated(client, asked, headers)


def validated(
    client: TestClient, asked: httpx.Response, headers: dict[str, str] | None = None
) -> dict[str, Any]:
    """The clearance that was asked for, once automation has said what it finds."""
    end = time.monotonic() + 10.0
    while True:
        found: dict[str, Any] = client.get(asked.headers["location"], headers=headers).json()
        if found["validation"]:
            return found
        assert time.monotonic() < end
        time.sleep(0.01)
