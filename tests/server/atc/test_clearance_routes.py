"""Clearances over REST: who may bring them where, trials, queues, and what is on record."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx2 as httpx
import pytest
from relguide_server.app import create_app
from relguide_server.atc.cases import Case
from relguide_server.atc.desk import Desk
from relguide_server.records.service import RecordsService, records_service
from relguide_server.settings import ServiceSettings

from relguide.atc import life
from relguide.atc.clearances import Actor, State, refusal
from relguide.atc.documents import Deviation
from relguide.contract.clearance_bodies import ClearanceModel
from tests.server.atc.asking import CLEARANCES, ask, report, request, validated
from tests.server.http.test_access import SETTING, TOKENS
from tests.server.serving import TestClient, ideal_app, ideal_catalogue
from tests.server.test_api import is_problem

STATES: tuple[State, ...] = (
    "validating", "standby", "accepted", "wilco", "flying", "deviated", "unable", "cancelled",
    "flown", "expired", "superseded", "terminated",
)  # fmt: skip
OFF = Deviation(subject="across", level="alert", amount=2e3, unit="m", since=0.0, message="Off.")
SAID: tuple[tuple[str, str, State, Actor], ...] = (
    # what is posted, what it says, where that leads, who says it
    ("answers", "accepted", "accepted", "controller"),
    ("answers", "unable", "unable", "controller"),
    ("answers", "standby", "standby", "controller"),
    ("answers", "cancelled", "cancelled", "controller"),
    ("answers", "terminated", "terminated", "controller"),
    ("replies", "WILCO", "wilco", "crew"),
    ("replies", "UNABLE", "cancelled", "crew"),
    ("replies", "CANCEL", "cancelled", "crew"),
)


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    """A service whose controller answers."""
    with TestClient(ideal_app(atc_auto_answer="off")) as client:
        yield client


def bearer(who: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {TOKENS[who]}"}


def desk_of(client: TestClient) -> Desk:
    desk: Desk = client.app.state.desk  # type: ignore[attr-defined]
    return desk


def bring(client: TestClient, clearance_id: str, state: State) -> None:
    """Bring a clearance that was validated where it would come in time."""
    desk = desk_of(client)
    case = desk.find(clearance_id)
    steps: dict[State, Callable[[Case, float, str], life.Clearance]] = {
        "standby": lambda c, t, at: life.answer(c.clearance, "standby", "controller", now=t, at=at),
        "accepted": lambda c, t, at: life.answer(
            c.clearance, "accepted", "controller", now=t, at=at
        ),
        "unable": lambda c, t, at: life.answer(c.clearance, "unable", "controller", now=t, at=at),
        "wilco": lambda c, t, at: life.reply(
            c.clearance, "WILCO", c.clearance.validation, now=t, at=at
        ),
        "flying": lambda c, t, at: life.begin(c.clearance, now=t, at=at),
        "deviated": lambda c, t, at: life.deviate(c.clearance, (OFF,), now=t, at=at),
        "terminated": lambda c, t, at: life.terminate(c.clearance, "service", now=t, at=at),
        "flown": lambda c, t, at: life.finish(c.clearance, now=t, at=at),
        "cancelled": lambda c, t, at: life.cancel(c.clearance, "crew", now=t, at=at),
        "superseded": lambda c, t, at: life.supersede(c.clearance, "another", now=t, at=at),
        "expired": lambda c, t, at: life.tick(c.clearance, c.clearance.due, at),
    }
    way: dict[State, tuple[State, ...]] = {
        "wilco": ("accepted", "wilco"),
        "flying": ("accepted", "wilco", "flying"),
        "deviated": ("accepted", "wilco", "flying", "deviated"),
        "terminated": ("accepted", "wilco", "flying", "deviated", "terminated"),
        "flown": ("accepted", "wilco", "flying", "flown"),
        "validating": (),
    }

    async def go() -> None:
        for step in way.get(state, (state,)):
            desk.take(case, steps[step](case, desk.now(case), desk.at()))

    client.portal.call(go)  # type: ignore[union-attr]
    assert case.state == state


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize(("where", "word", "to", "who"), SAID)
def test_each_state_and_each_word(
    client: TestClient, state: State, where: str, word: str, to: State, who: Actor
) -> None:
    """What the table of states allows is done, and all else is refused in its words."""
    asked = ask(client)
    bring(client, asked["id"], state)
    path = f"{CLEARANCES}/{asked['id']}"
    said = client.post(f"{path}/{where}", json={where.removesuffix("s").replace("ie", "y"): word})
    now = client.get(path).json()
    allowed = not refusal(state, to, who) and not (word == "UNABLE" and state != "accepted")
    if allowed:
        assert said.status_code == 200, said.text
        assert said.json() == now
        assert now["state"] == to
        assert (now["history"][-1]["by"], now["history"][-1]["state"]) == (who, to)
    else:
        is_problem(said, 409, f"{path}/{where}")
        assert now["state"] == state
    if now["state"] not in ("unable", "cancelled", "flown", "expired", "superseded", "terminated"):
        assert client.post(f"{path}/replies", json={"reply": "CANCEL"}).status_code == 200


@pytest.mark.parametrize(
    ("who", "ask_it", "answer_it", "reply_to_it"),
    [
        ("", 401, 401, 401),
        ("view", 403, 403, 403),
        ("fly", 201, 403, 200),
        ("other", 201, 403, 403),
        ("atc", 403, 200, 403),
        ("control", 201, 200, 200),
    ],
)
def test_each_role(who: str, ask_it: int, answer_it: int, reply_to_it: int) -> None:
    """Crews ask and reply to their own, controllers answer, all who may read watch."""
    with TestClient(ideal_app(tokens=SETTING)) as client:
        headers = bearer(who) if who else {}
        report(client, bearer("atc"))
        asked = client.post(CLEARANCES, json=request("RG 07", behind=40e3), headers=headers)
        assert asked.status_code == ask_it
        own = client.post(CLEARANCES, json=request(), headers=bearer("fly"))
        card = validated(client, own, bearer("fly"))
        assert card["state"] == "validating"  # a token of a controller's: it answers
        assert card["validation"][0]["verdict"] == "acceptable"
        path = f"{CLEARANCES}/{card['id']}"
        answered = client.post(f"{path}/answers", json={"answer": "accepted"}, headers=headers)
        assert answered.status_code == answer_it
        if answer_it != 200:
            client.post(f"{path}/answers", json={"answer": "accepted"}, headers=bearer("atc"))
        said = client.post(f"{path}/replies", json={"reply": "WILCO"}, headers=headers)
        assert said.status_code == reply_to_it
        assert client.get(path, headers=headers).status_code == (200 if who else 401)
        trial = client.post(f"{CLEARANCES}?dry_run=true", json=request(), headers=headers)
        assert trial.status_code == (200 if who else 401)


def test_a_trial_says_what_would_be_found_and_keeps_nothing(client: TestClient) -> None:
    report(client)
    before = client.get(CLEARANCES).json()
    tried = client.post(f"{CLEARANCES}?dry_run=true", json=request("RG 99")).json()
    assert tried["validation"]["verdict"] == "acceptable"
    assert tried["text"] == "REQUEST CAPTURE AND MAINTAIN 6.5 NM BEHIND LDR 1"
    assert len(tried["route"]["t_s"]) == len(tried["route"]["lat_deg"]) >= 2
    assert client.get(CLEARANCES).json() == before
    too_near = client.post(
        f"{CLEARANCES}?dry_run=true", json=request("RG 99", behind=8e3, minimum=8e3)
    ).json()
    assert too_near["validation"]["verdict"] == "acceptable"  # d_min is its own
    assert client.get(CLEARANCES).json() == before


def test_a_request_sent_again_with_its_key_is_the_same_one(client: TestClient) -> None:
    report(client)
    headers = {"Idempotency-Key": "once"}
    first, second = (client.post(CLEARANCES, json=request(), headers=headers) for _ in range(2))
    assert first.status_code == second.status_code == 201
    assert first.json()["id"] == second.json()["id"]
    client.post(f"{CLEARANCES}/{first.json()['id']}/replies", json={"reply": "CANCEL"})


def test_one_place_behind_a_leader_is_one_aircraft_s(client: TestClient) -> None:
    first = ask(client)
    second = ask(client, request("RG 07", behind=13e3))
    (found,) = second["validation"]
    assert found["verdict"] == "standby"
    assert found["findings"][0]["reason"] == "slot_taken"
    assert "RG 06 has the place 6.5 NM behind LDR 1" in found["findings"][0]["message"]
    assert "ask for 11.5 NM" in found["findings"][0]["message"]
    third = ask(client, request("RG 08", behind=32e3))
    assert third["validation"][0]["verdict"] == "acceptable"
    for clearance in (first, second, third):
        client.post(f"{CLEARANCES}/{clearance['id']}/replies", json={"reply": "CANCEL"})


def test_the_automation_answers_where_nobody_else_does() -> None:
    with TestClient(ideal_app()) as client:
        accepted = ask(client)
        assert (accepted["state"], accepted["auto_answer"]) == ("accepted", True)
        assert accepted["history"][-1]["by"] == "service"
        queued = ask(client, request("RG 07"))
        assert (queued["state"], queued["history"][-1]["reason"]) == ("standby", "slot_taken")
        path = f"{CLEARANCES}/{accepted['id']}/replies"
        client.post(path, json={"reply": "CANCEL"})
        desk, end = desk_of(client), time.monotonic() + 10.0
        case = desk.find(queued["id"])
        case.checked = 0.0  # the next second validates it again
        while case.state == "standby":
            assert time.monotonic() < end
            time.sleep(0.02)
        assert case.state == "accepted"


def test_a_new_request_of_an_aircraft_takes_the_place_of_its_last_one(client: TestClient) -> None:
    first, second = ask(client), ask(client)
    old = client.get(f"{CLEARANCES}/{first['id']}").json()
    assert old["state"] == "superseded"
    assert second["id"] in old["history"][-1]["message"]
    client.post(f"{CLEARANCES}/{second['id']}/replies", json={"reply": "CANCEL"})


def test_wilco_is_validated_on_the_present_picture(client: TestClient) -> None:
    """Another aircraft has come too near since it was accepted."""
    asked = ask(client)
    bring(client, asked["id"], "accepted")
    body = request("INTRUDER")["aircraft"]
    near = {
        "ident": "INTRUDER", "lat_deg": 50.01, "lon_deg": body["lon_deg"], "altitude_m": 9_449.0,
        "track_deg": 90.0, "ground_speed_mps": 200.0,
    }  # fmt: skip
    now = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    report(client)
    client.put("/api/v1/traffic?source=other", json={"as_of": now, "aircraft": [near]})
    desk_of(client).skies.forget_pictures()
    said = client.post(f"{CLEARANCES}/{asked['id']}/replies", json={"reply": "WILCO"}).json()
    client.delete("/api/v1/traffic?source=other")
    assert said["state"] == "unable"
    assert (said["history"][-1]["by"], said["history"][-1]["reason"]) == ("service", "separation")


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"traffic_id": "NOBODY"}, "NOBODY is not in the picture"),
        ({"sky": "3f2a9c0d71be"}, "sky: is that on the earth"),
        ({"min_separation_m": 13e3}, "assigned_spacing_goal.value_m: must be at least"),
    ],
)
def test_what_cannot_be_asked_is_refused(
    client: TestClient, wrong: dict[str, Any], said: str
) -> None:
    report(client)
    answer = client.post(CLEARANCES, json=request() | wrong)
    is_problem(answer, 422, CLEARANCES)
    assert said in answer.json()["detail"]


def test_a_query_of_no_ascii_is_refused_as_any_other(client: TestClient) -> None:
    is_problem(client.post(f"{CLEARANCES}?%C2%80=1", json=request()), 422, CLEARANCES)


def test_a_flight_that_is_proposed_nothing_has_nothing_to_ask_for(client: TestClient) -> None:
    unknown = client.post(CLEARANCES, json={"flight_id": "none"})
    is_problem(unknown, 404, CLEARANCES)
    flight = client.post("/api/v1/flights", json={"scenario": "ideal", "paused": True}).json()
    answer = client.post(CLEARANCES, json={"flight_id": flight["id"]})
    is_problem(answer, 409, CLEARANCES)
    nobody = client.post(CLEARANCES, json={"flight_id": flight["id"], "aircraft": "LDR 01"})
    assert "must be a pursuer of this flight: RG 06" in nobody.json()["detail"]


def test_a_client_has_so_many_at_most(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide_server.atc.cases.MOST_OF_ONE", 1)
    first = ask(client)
    full = client.post(CLEARANCES, json=request("RG 07", behind=50e3))
    is_problem(full, 429, CLEARANCES)
    assert "too-many-clearances" in full.json()["type"]
    client.post(f"{CLEARANCES}/{first['id']}/replies", json={"reply": "CANCEL"})


def records_in(folder: Path) -> RecordsService:
    return records_service(
        records="on", database_url="", data=str(folder), record_plans=0, keep_days=1.0, keep_mb=9.0
    )


def recording(folder: Path) -> TestClient:
    settings = ServiceSettings(workers=0, atc_auto_answer="off")
    return TestClient(create_app(settings, catalogue=ideal_catalogue(), records=records_in(folder)))


def opened(client: TestClient) -> None:
    """Wait until the records can be read."""
    end = time.monotonic() + 20.0
    while client.get("/api/v1/records/flights").status_code != 200:
        assert time.monotonic() < end
        time.sleep(0.05)


def test_a_service_that_stops_leaves_no_clearance_open(tmp_path: Path) -> None:
    """What was acknowledged is there after a new start, with a sentence of why it ended."""
    with recording(tmp_path) as client:
        opened(client)
        report(client)
        first = client.post(CLEARANCES, json=request())
        assert first.headers["relguide-recorded"] == "yes"
        card = validated(client, first)
        second = ask(client, request("RG 07", behind=40e3))
        bring(client, second["id"], "flying")
        done = ask(client, request("RG 08", behind=60e3))
        path = f"{CLEARANCES}/{done['id']}"
        answered = client.post(f"{path}/answers", json={"answer": "unable", "message": "NO."})
        assert answered.headers["relguide-recorded"] == "yes"
    with recording(tmp_path) as client:
        opened(client)
        found = {one["id"]: one for one in client.get(CLEARANCES).json()["clearances"]}
        assert {one["state"] for one in found.values()} == {"expired", "terminated", "unable"}
        assert found[card["id"]]["history"][-1]["message"].startswith("The service was stopped")
        assert found[second["id"]]["state"] == "terminated"
        assert client.get(path).json() == answered.json()
        for one in found.values():
            ClearanceModel.model_validate(one)
        only = client.get(CLEARANCES, params={"state": "expired"}).json()["clearances"]
        assert [one["id"] for one in only] == [card["id"]]
        is_problem(client.get(f"{CLEARANCES}/none"), 404, f"{CLEARANCES}/none")
        over = client.post(f"{path}/replies", json={"reply": "WILCO"})
        assert over.status_code == 404


def test_the_newest_of_those_that_live_come_first(client: TestClient) -> None:
    first = ask(client, request("RG 07", behind=40e3))
    second = ask(client)

    def listed(**query: str) -> list[str]:
        answer: httpx.Response = client.get(CLEARANCES, params=query)
        return [one["id"] for one in answer.json()["clearances"]]

    assert listed(limit="2") == [second["id"], first["id"]]
    client.post(f"{CLEARANCES}/{first['id']}/replies", json={"reply": "CANCEL"})
    assert listed(state="validating") == [second["id"]]
    assert first["id"] in listed(state="cancelled", limit="500")
    client.post(f"{CLEARANCES}/{second['id']}/replies", json={"reply": "CANCEL"})
