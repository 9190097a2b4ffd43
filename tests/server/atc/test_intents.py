"""A sky as traffic that plans keep clear of: read back, it flies where the picture has it."""

import numpy as np
import pytest
from relguide_server.atc.intents import traffic_body

from relguide.atc.picture import Seen
from relguide.atc.track import Track
from relguide.atc.tracks import intent_track, path_track
from relguide.contract.other_bodies import others_from_body
from relguide.contract.places import UNANCHORED, Anchor
from relguide.planning.aircraft import Traffic
from relguide.planning.frames import LocalPlane
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG
from tests.server.atc.asking import CLEARANCES, ask, request
from tests.server.serving import TestClient, ideal_app

FLOWN = Traffic(
    ident="BAW12", x=3_000.0, y=-5_000.0, heading=80.0 * DEG, tas=220.0, altitude=9_449.0,
    min_separation=9_260.0,
    intent=(
        FlyStraight(duration=90.0),
        TurnTo(heading=170.0 * DEG, turn=RIGHT, bank=20.0 * DEG),
        FlyStraight(duration=60.0),
        TurnTo(heading=30.0 * DEG, turn=LEFT, bank=25.0 * DEG),
    ),
)  # fmt: skip


def read(body: dict[str, object], anchor: Anchor) -> Traffic:
    from pydantic import TypeAdapter

    from relguide.contract.other_bodies import TrafficList

    (other,) = others_from_body(
        TypeAdapter(TrafficList).validate_python([body]), [], anchor, 9_260.0
    )
    assert isinstance(other, Traffic)
    return other


@pytest.mark.parametrize("plane", [None, LocalPlane(50.0, 8.0)])
@pytest.mark.parametrize("now", [0.0, 40.0, 100.0, 150.0])
def test_an_intent_read_back_flies_where_it_did(plane: LocalPlane | None, now: float) -> None:
    path = intent_track(FLOWN, start=0.0, until=600.0)
    x, y = path.place(now)
    seen = Seen(ident="BAW12", t=now, x=x, y=y, track=0.0, ground_speed=220.0, path=path)
    body = traffic_body(seen, now, plane, 9_260.0)
    assert body is not None
    back = read(body, UNANCHORED if plane is None else plane)
    again = path_track(back.trajectory, start=now, until=600.0)
    off = [again.distance(path, t) for t in np.linspace(now, 600.0, 60).tolist()]
    assert max(off) < 60.0


def test_who_intends_nothing_flies_on_and_who_is_too_slow_is_left_out() -> None:
    seen = Seen(ident="A", t=0.0, x=0.0, y=0.0, track=90.0 * DEG, ground_speed=200.0)
    body = traffic_body(seen, 10.0, None, 9_260.0)
    assert body is not None
    assert (body["x_m"], body["intent"]) == (pytest.approx(2_000.0), [])
    assert "altitude_m" not in body
    slow = Seen(ident="A", t=0.0, x=0.0, y=0.0, track=0.0, ground_speed=10.0)
    assert traffic_body(slow, 10.0, None, 9_260.0) is None


def test_a_corner_of_a_filed_route_is_a_steep_turn() -> None:
    corner = Track(
        t=np.array([0.0, 100.0, 200.0]), x=np.array([0.0, 0.0, 2e4]), y=np.array([0.0, 2e4, 2e4]),
        low=np.zeros(3), high=np.zeros(3), error=0.0,
    )  # fmt: skip
    seen = Seen(ident="A", t=0.0, x=0.0, y=0.0, track=0.0, ground_speed=200.0, path=corner)
    body = traffic_body(seen, 30.0, None, 9_260.0)
    assert body is not None
    straight, turn = body["intent"]
    assert straight == {"straight_s": pytest.approx(70.0)}
    assert (turn["turn_to_heading_deg"], turn["direction"], turn["bank_deg"]) == (
        pytest.approx(90.0), "right", 60.0,
    )  # fmt: skip


def test_what_is_accepted_is_traffic_that_a_plan_takes() -> None:
    with TestClient(ideal_app()) as client:
        accepted = ask(client)
        assert accepted["state"] == "accepted"
        sky = client.get("/api/v1/atc/traffic").json()
        assert {one["ident"] for one in sky["traffic"]} == {"LDR 1", "RG 06"}
        body = request()["aircraft"]
        leader = {
            "lat_deg": 50.2, "lon_deg": body["lon_deg"], "heading_deg": 180.0, "tas_mps": 200.0,
        }  # fmt: skip
        pursuer = leader | {"lat_deg": 50.8, "max_bank_deg": 25.0, "altitude_m": 9_449.0}
        situation = {
            "pursuer": pursuer, "leader": leader | {"altitude_m": 9_449.0},
            "slot_distance_m": 12e3, "min_separation_m": 9_260.0, "traffic": sky["traffic"],
        }  # fmt: skip
        answer = client.post("/api/v1/plans", json=situation)
        assert answer.status_code == 200, answer.text
        assert client.get("/api/v1/atc/traffic?sky=none").status_code == 404
        client.post(f"{CLEARANCES}/{accepted['id']}/replies", json={"reply": "CANCEL"})
        left = client.get("/api/v1/atc/traffic").json()
        assert {one["ident"] for one in left["traffic"]} == {"LDR 1"}
