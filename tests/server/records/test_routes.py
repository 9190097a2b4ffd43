"""Records over REST: find, read, replay, export and remove."""

import asyncio
import csv
import io
import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from datetime import datetime
from pathlib import Path

import pyarrow.parquet as pq
import pytest
import sqlalchemy as sa
from relguide_server.app import create_app
from relguide_server.flights.flight_file_routes import _origin, _parts
from relguide_server.planning.plans import EXAMPLE
from relguide_server.records.exports import gives_level
from relguide_server.records.recording import Rows
from relguide_server.records.schema import flights
from relguide_server.records.service import records_service
from relguide_server.records.store import Store
from relguide_server.settings import ServiceSettings

from relguide.contract.flight_summary import summarize
from relguide.contract.protocol import PROTOCOL
from relguide.contract.recorder import VERSION, replay
from relguide.contract.wire import dumps
from relguide.flying.documents import FlightEnded, Sample
from tests.server.flown import ideal_flight
from tests.server.serving import TestClient, ideal_catalogue


def make_client(url: str, folder: Path, source: Callable = ideal_flight) -> TestClient:
    records = records_service(
        records="on", database_url=url, data=str(folder), record_plans=5, keep_days=30.0,
        keep_mb=100.0,
    )  # fmt: skip
    app = create_app(ServiceSettings(workers=0), catalogue=ideal_catalogue(source), records=records)
    return TestClient(app)


@pytest.fixture
def client(url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[TestClient]:
    # a busy machine may take longer than a second to save, and then the answer says "no"
    monkeypatch.setattr("relguide_server.records.service.SOON", 10.0)
    with make_client(url, tmp_path) as client:
        wait_for(lambda: client.get("/api/v1/records/flights").status_code == 200)
        yield client


def wait_for(condition: Callable[[], object], patience: float = 10.0) -> None:
    end = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def start(client: TestClient, **body: object) -> str:
    wanted = {"scenario": "ideal", "rate": 60.0, **body}
    wanted = {name: value for name, value in wanted.items() if value is not None}
    answer = client.post("/api/v1/flights", json=wanted)
    assert (answer.status_code, answer.headers["relguide-recorded"]) == (201, "yes")
    flight_id: str = answer.json()["id"]
    return flight_id


def record_of(client: TestClient, flight_id: str) -> dict:
    answer = client.get(f"/api/v1/records/flights/{flight_id}")
    assert answer.status_code == 200, answer.text
    return answer.json()


def fly_whole(client: TestClient) -> str:
    flight_id = start(client)
    wait_for(lambda: record_of(client, flight_id)["outcome"] == "joined")
    return flight_id


def test_a_flight_is_found_and_read(client: TestClient, tmp_path: Path) -> None:
    flight_id = fly_whole(client)
    found = record_of(client, flight_id)
    assert found["request"] == {"scenario": "ideal", "rate": 60.0}
    assert found["settings"]["planner"] == "exact"
    assert (found["seed"], found["lost"], found["requested_by"]) == (0, 0, "127.0.0.1")
    assert found["figures"]["simulated_s"] == 30.0
    assert found["figures"]["plans"] == 1
    base = "/api/v1/records/flights"
    ids = [flight["id"] for flight in client.get(base).json()["flights"]]
    assert ids == [flight_id]
    for search, count in (
        ("scenario=ideal&outcome=joined", 1), ("scenario=fig_6b", 0), ("outcome=flying", 0),
        (f"since={found['started_at']}", 1), (f"until={found['started_at']}", 0),
        ("limit=1", 1),
    ):  # fmt: skip
        assert len(client.get(f"{base}?{search}").json()["flights"]) == count, search
    whole = client.get(f"{base}/{flight_id}/documents").json()
    numbers = [numbered["number"] for numbered in whole["documents"]]
    assert numbers == list(range(found["documents"]))
    later = client.get(f"{base}/{flight_id}/documents?first=10&limit=5").json()
    assert later["documents"] == whole["documents"][10:15]
    assert later["next"] == 15


def test_a_record_is_whole_after_its_flight_is_ended_however_slow_the_disk(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide_server.records.service.SOON", 1.0)
    save = Store.save

    def save_slowly(store: Store, rows: Rows, *, now: float) -> None:
        time.sleep(1.5)
        save(store, rows, now=now)

    flight_id = start(client, rate=1.0)
    monkeypatch.setattr(Store, "save", save_slowly)
    bound = {"command": "leader_heading", "heading_deg": 135.0}
    client.post(f"/api/v1/flights/{flight_id}/commands", json=bound)
    ended = client.delete(f"/api/v1/flights/{flight_id}")
    assert (ended.status_code, ended.headers["relguide-recorded"]) == (204, "yes")
    found = record_of(client, flight_id)
    assert (found["outcome"], found["lost"]) == ("removed", 0)
    assert [one["command"]["command"] for one in found["commands"]] == [bound["command"]]
    monkeypatch.setattr("relguide_server.records.service.TO_THE_END", 0.1)
    again = start_unsaved(client)
    assert client.delete(f"/api/v1/flights/{again}").headers["relguide-recorded"] == "no"


def start_unsaved(client: TestClient) -> str:
    """A flight that is not on record yet."""
    answer = client.post("/api/v1/flights", json={"scenario": "ideal", "rate": 60.0})
    assert (answer.status_code, answer.headers["relguide-recorded"]) == (201, "no")
    flight_id: str = answer.json()["id"]
    return flight_id


def test_a_list_is_read_page_by_page_though_flights_begin_and_go_meanwhile(
    client: TestClient,
) -> None:
    base = "/api/v1/records/flights"
    flown = [start(client, paused=True) for _ in range(7)]
    whole = client.get(base).json()
    assert [one["id"] for one in whole["flights"]] == flown[::-1]
    assert (whole["total"], whole["next"]) == (7, None)
    first = client.get(f"{base}?limit=3&scenario=ideal").json()
    assert (len(first["flights"]), first["total"]) == (3, 7)
    newer = start(client, paused=True)
    for gone in (flown[4], flown[3]):  # the last one that was listed among them
        client.delete(f"/api/v1/flights/{gone}")
        assert client.delete(f"{base}/{gone}").status_code == 204
    second = client.get(f"{base}?limit=3&scenario=ideal&cursor={first['next']}").json()
    assert [one["id"] for one in first["flights"]] == flown[:3:-1]
    assert [one["id"] for one in second["flights"]] == flown[2::-1]
    assert (second["total"], second["next"]) == (6, None)
    assert client.get(f"{base}?limit=1").json()["flights"][0]["id"] == newer


def test_flights_that_began_at_once_are_each_listed_once(client: TestClient) -> None:
    store = client.app.state.records.reading()
    flown = {start(client, paused=True) for _ in range(5)}
    with store.engine.begin() as connection:
        connection.execute(sa.update(flights).values(started_at=1e9 + 0.1))
    seen, cursor = [], ""
    while cursor is not None:
        page = client.get(f"/api/v1/records/flights?limit=2{cursor and f'&cursor={cursor}'}").json()
        seen += [one["id"] for one in page["flights"]]
        cursor = page["next"]
    assert sorted(seen) == sorted(flown)


@pytest.mark.parametrize(
    "cursor",
    ["", "x", "e30", "WzFd", "WzEuMCwiYS8iLDBd", "WzEuMCwiXHUwMDAwIiwwXQ", "%C3%A9", "A" * 201],
)
def test_what_is_no_cursor_is_refused(client: TestClient, cursor: str) -> None:
    for name in ("flights", "plans"):
        answer = client.get(f"/api/v1/records/{name}?cursor={cursor}")
        assert answer.status_code == 422
        assert answer.json()["detail"].startswith("cursor: ")


def test_a_client_that_has_what_is_on_record_is_not_sent_it_again(client: TestClient) -> None:
    flight_id = fly_whole(client)
    one = f"/api/v1/records/flights/{flight_id}"
    forms = [f"{one}/export?format={form}" for form in ("jsonl", "csv", "parquet")]
    placed = [f"{one}/export?format={form}&lat_deg=1&lon_deg=2" for form in ("geojson", "czml")]
    lists = ["/api/v1/records/flights", "/api/v1/records/plans"]
    paths = [*lists, one, f"{one}/documents", *forms, *placed]
    tags = {}
    for path in paths:
        whole = client.get(path)
        tag = tags[path] = whole.headers["etag"]
        assert (whole.status_code, whole.headers["cache-control"]) == (200, "no-cache")
        for has in (tag, f'"other", W/{tag}', "*"):
            again = client.get(path, headers={"If-None-Match": has})
            assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
        assert client.get(path, headers={"If-None-Match": '"other"'}).content == whole.content
        assert client.head(path, headers={"If-None-Match": tag}).status_code == 304
    assert len(set(tags.values())) == len(paths)
    flying = start(client, paused=True)
    listed = client.get(lists[0], headers={"If-None-Match": tags[lists[0]]})
    assert listed.status_code == 200
    assert "etag" not in client.get(f"/api/v1/records/flights/{flying}/export").headers


@pytest.mark.parametrize(
    ("since", "said"),
    [
        ("yesterday", "must be a time, as 2026-11-23T06:30:00Z, not yesterday; + is written %2B."),
        ("2026", "must be a time, as 2026-11-23T06:30:00Z, not 2026."),
        ("2026-11-23", "must be a time with its zone, as 2026-11-23T06:30:00Z, not 2026-11-23."),
        (
            "2026-11-23T00:00:00+00:00",
            "must be a time, as 2026-11-23T06:30:00Z, not 2026-11-23T00:00:00 00:00; + is written "
            "%2B.",
        ),
    ],
)
def test_a_wrong_time_is_told_how_one_is_written(client: TestClient, since: str, said: str) -> None:
    answer = client.get(f"/api/v1/records/flights?since={since}")
    assert (answer.status_code, answer.json()["detail"]) == (422, f"since: {said}")


def test_commands_are_on_record_before_they_are_acknowledged(client: TestClient) -> None:
    flight_id = start(client, paused=True)
    order = {"command": "leader_heading", "heading_deg": 135.0, "direction": "left"}
    answer = client.post(f"/api/v1/flights/{flight_id}/commands", json=order)
    assert answer.headers["relguide-recorded"] == "yes"
    (kept,) = record_of(client, flight_id)["commands"]
    assert kept["command"] == order
    assert client.delete(f"/api/v1/records/flights/{flight_id}").status_code == 409
    assert client.delete(f"/api/v1/flights/{flight_id}").status_code == 204
    assert record_of(client, flight_id)["outcome"] == "removed"  # at once: nothing is read too soon
    assert client.delete(f"/api/v1/records/flights/{flight_id}").status_code == 204
    assert client.get(f"/api/v1/records/flights/{flight_id}").status_code == 404


def test_plans_asked_for_are_on_record_so_many_a_second(client: TestClient) -> None:
    for _ in range(20):
        client.post("/api/v1/plans", json=EXAMPLE)
    lost = "relguide_records_plans_lost_total"

    def found() -> list[dict]:
        return client.get("/api/v1/records/plans?status=planned").json()["plans"]

    # saved in several batches
    wait_for(lambda: f"{lost} {20 - len(found())}" in client.get("/metrics").text)
    assert found()[0]["situation"] == EXAMPLE
    assert 0 < len(found()) < 20


def test_a_recording_is_what_was_flown_and_flies_again(client: TestClient, tmp_path: Path) -> None:
    flight_id = fly_whole(client)
    file = tmp_path / "flight.jsonl"
    file.write_bytes(client.get(f"/api/v1/records/flights/{flight_id}/export").content)
    kept = list(replay(file))
    assert summarize(kept).broken == ""
    assert isinstance(kept[-1], FlightEnded)
    path = f"/api/v1/records/flights/{flight_id}"
    answer = client.post(f"{path}/replay", json={"rate": 60.0, "paused": True})
    assert answer.status_code == 201, answer.text
    again = answer.json()
    assert again["title"] == "Exact trajectories"
    commands = f"/api/v1/flights/{again['id']}/commands"
    order = {"command": "leader_heading", "heading_deg": 1.0}
    assert client.post(commands, json=order).status_code == 409
    streamed: list[dict] = []
    with client.websocket_connect(again["stream_url"], subprotocols=[PROTOCOL]) as socket:
        assert client.post(commands, json={"command": "play"}).status_code == 202
        while not (tick := socket.receive_json())["ended"]:
            streamed += tick["documents"]
        streamed += tick["documents"]
    # the stream gives of several samples the newest only; all else is there, as it was kept
    said = [json.loads(dumps(d)) for d in kept]
    assert [d for d in streamed if d["kind"] != "sample"] == [
        d for d in said if d["kind"] != "sample"
    ]
    assert all(d in said for d in streamed)
    assert len(client.get("/api/v1/records/flights").json()["flights"]) == 1


def test_exports_hold_every_sample(client: TestClient, tmp_path: Path) -> None:
    flight_id = fly_whole(client)
    path = f"/api/v1/records/flights/{flight_id}/export"
    file = tmp_path / "flight.jsonl"
    file.write_bytes(client.get(path).content)
    samples = [d for d in replay(file) if isinstance(d, Sample)]
    assert len(samples) == 31
    answer = client.get(f"{path}?format=csv")
    assert answer.headers["content-disposition"].endswith('.csv"')
    rows = list(csv.DictReader(io.StringIO(answer.text)))
    assert len(rows) == 2 * len(samples)
    assert float(rows[2]["x_m"]) == samples[1].aircraft[0].x
    assert (rows[0]["mode"], rows[1]["mode"]) == ("converge", "")
    table = pq.read_table(io.BytesIO(client.get(f"{path}?format=parquet").content)).to_pylist()
    assert [row["x_m"] for row in table] == [float(row["x_m"]) for row in rows]
    assert table[0]["joined"] is False
    about = record_of(client, flight_id)
    origin = {
        "flight_id": flight_id,
        "started_at": about["started_at"],
        "relguide_version": about["version"],
    }
    assert json.loads(file.read_text().splitlines()[0]).items() >= origin.items()
    for row in (rows[0], rows[-1], table[0], table[-1]):
        assert row.items() >= origin.items()
    refused = client.get(f"{path}?format=geojson")
    assert refused.status_code == 422
    assert "lat_deg" in refused.json()["detail"]
    tracks = client.get(f"{path}?format=geojson&lat_deg=48&lon_deg=2").json()
    assert tracks.items() >= origin.items()
    assert [len(f["geometry"]["coordinates"]) for f in tracks["features"]] == [31, 31]
    packets = client.get(f"{path}?format=czml&lat_deg=48&lon_deg=2").json()
    assert packets[0]["properties"] == origin
    assert [len(p["position"]["cartographicDegrees"]) for p in packets[1:]] == [124, 124]
    assert client.get(f"{path}?format=czml").status_code == 422
    leader = tracks["features"][1]["geometry"]["coordinates"][0]
    assert leader[:2] == pytest.approx([2.0, 48.0])
    cut = client.get(f"{path}?format=geojson&lat_deg=48&lon_deg=179.99").json()["features"][1]
    assert cut["geometry"]["type"] == "MultiLineString"
    before, after = cut["geometry"]["coordinates"]
    assert (before[-1][0], after[0][0]) == (180.0, -180.0)
    assert before[-1][1:] == after[0][1:]


def test_without_records_all_else_works_and_says_so() -> None:
    with TestClient(create_app(ServiceSettings(workers=0), catalogue=ideal_catalogue())) as client:
        assert client.get("/readyz").json()["records"]["status"] == "off"
        answer = client.post("/api/v1/flights", json={"scenario": "ideal"})
        assert (answer.status_code, answer.headers["relguide-recorded"]) == (201, "no")
        refused = client.get("/api/v1/records/flights")
        assert refused.status_code == 404
        assert "RELGUIDE_RECORDS" in refused.json()["detail"]


def test_a_folder_that_cannot_be_written_is_said_and_flights_fly(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    with make_client("", tmp_path / "file") as client:
        wait_for(lambda: client.get("/readyz").json()["records"]["status"] == "waiting")
        assert "exists" in client.get("/readyz").json()["records"]["message"]
        started = time.monotonic()
        answer = client.post("/api/v1/flights", json={"scenario": "ideal"})
        assert (answer.status_code, answer.headers["relguide-recorded"]) == (201, "no")
        assert time.monotonic() - started < 4.0
        assert client.get("/api/v1/records/flights").status_code == 503
        assert "relguide_records_up 0" in client.get("/metrics").text


def test_what_is_replayed_or_exported_is_whole_though_it_is_forgotten_meanwhile(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide_server.records.recording.CHUNK", 2000)  # of many chunks
    flight_id = fly_whole(client)
    kept = f"/api/v1/records/flights/{flight_id}"
    whole = client.get(f"{kept}/export").content
    again = client.post(f"{kept}/replay", json={"rate": 60.0, "paused": True}).json()
    parts = asyncio.run(exported(client, flight_id))
    assert parts == whole
    assert client.get(kept).status_code == 404
    path = f"/api/v1/flights/{again['id']}"
    assert client.post(f"{path}/commands", json={"command": "play"}).status_code == 202
    wait_for(lambda: client.get(path).json()["ended"])
    assert client.get(path).json()["t_s"] == 30.0
    assert client.get(f"{kept}/export").status_code == 404


async def exported(client: TestClient, flight_id: str) -> bytes:
    """A recording that is removed once its first part has been exported."""
    parts = _parts(
        client.app.state.records, _origin(record_of(client, flight_id)), VERSION, "jsonl"
    )
    first = await anext(parts)
    assert client.delete(f"/api/v1/records/flights/{flight_id}").status_code == 204
    return first + b"".join([part async for part in parts])


def test_a_flight_says_when_it_began_what_flies_it_and_why_it_ended(client: TestClient) -> None:
    flight_id = start(client, rate=5.0)
    path = f"/api/v1/flights/{flight_id}"
    flying, kept = client.get(path).json(), record_of(client, flight_id)
    assert (flying["outcome"], flying["started_at"]) == ("", kept["started_at"])
    assert abs(datetime.fromisoformat(flying["started_at"]).timestamp() - time.time()) < 60.0
    with client.websocket_connect(flying["stream_url"], subprotocols=[PROTOCOL]) as stream:
        first, *later = (stream.receive_json() for _ in range(4))
    origin = {"started_at": flying["started_at"], "version": flying["version"]}
    assert first.items() >= origin.items()
    assert first["documents"][0]["kind"] == "flight_started"
    assert not any(name in tick for tick in later for name in origin)
    client.post(f"{path}/commands", json={"command": "set_rate", "rate": 60.0})
    wait_for(lambda: client.get(path).json()["ended"])
    assert client.get(path).json()["outcome"] == "joined"
    time.sleep(0.01)  # a replay begins later
    again = client.post(f"/api/v1/records/flights/{flight_id}/replay", json={"rate": 60.0}).json()
    assert again["started_at"] == flying["started_at"]


def test_exports_leave_out_a_level_that_nobody_gave(client: TestClient) -> None:
    def exported(**changes: object) -> tuple[list[dict], list[dict], list[list[float]]]:
        flight_id = start(client, scenario=None, situation={**EXAMPLE, **changes})
        wait_for(lambda: record_of(client, flight_id)["outcome"] == "joined")
        path = f"/api/v1/records/flights/{flight_id}/export"
        rows = list(csv.DictReader(io.StringIO(client.get(f"{path}?format=csv").text)))
        table = pq.read_table(io.BytesIO(client.get(f"{path}?format=parquet").content))
        tracks = client.get(f"{path}?format=geojson&lat_deg=48&lon_deg=2").json()
        return rows, table.to_pylist(), tracks["features"][0]["geometry"]["coordinates"]

    rows, table, points = exported()
    assert {row["altitude_m"] for row in rows} == {""}
    assert {row["altitude_m"] for row in table} == {None}
    assert {len(point) for point in points} == {2}
    level = {"altitude_m": 9449.0}
    both = {name: {**EXAMPLE[name], **level} for name in ("pursuer", "leader")}
    rows, table, points = exported(**both)
    assert "" not in {row["altitude_m"] for row in rows}
    assert None not in {row["altitude_m"] for row in table}
    assert {len(point) for point in points} == {3}


def test_what_gives_a_level_is_told_from_what_describes_the_air() -> None:
    profile = {"profile": [{"altitude_m": 9449.0, "from_deg": 0, "speed_mps": 5}]}
    climb = {"level_change": {"to_altitude_m": 9449.0, "rate_mps": 8}}
    for said, gives in (
        ({"situation": {**EXAMPLE, "air": profile, "believed_air": profile}}, False),
        ({"situation": {**EXAMPLE, "traffic": [{"ident": "A", "altitude_m": None}]}}, False),
        ({"situation": {"leader": {"intent": [climb]}}}, True),
        ([{"command": "leader_level", "altitude_m": 9449.0}], True),
        ({"orders": [{"t_s": 1.0, "leader_level_m": 9449.0}]}, True),
    ):
        assert gives_level(said) is gives


def test_a_replay_ends_where_the_recording_does(client: TestClient) -> None:
    flight_id = start(client)
    kept = f"/api/v1/records/flights/{flight_id}"
    wait_for(lambda: record_of(client, flight_id)["figures"]["simulated_s"] > 3.0)
    client.delete(f"/api/v1/flights/{flight_id}")
    wait_for(lambda: record_of(client, flight_id)["outcome"] != "flying")
    again = client.post(f"{kept}/replay", json={"rate": 60.0}).json()
    status = f"/api/v1/flights/{again['id']}"
    wait_for(lambda: client.get(status).json()["ended"])
    last = record_of(client, flight_id)["figures"]["simulated_s"]
    assert client.get(status).json()["t_s"] == pytest.approx(last, abs=1.0)


def test_a_mistake_in_the_recording_ends_no_flight(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr("relguide_server.records.recording.Recording.add")
    answer = client.post("/api/v1/flights", json={"scenario": "ideal"})
    assert (answer.status_code, answer.headers["relguide-recorded"]) == (201, "no")
    assert answer.elapsed.total_seconds() < 5.0  # it does not wait for what has ended
    wait_for(lambda: client.get("/readyz").json()["records"]["status"] == "waiting")
    assert "mistake" in client.get("/readyz").json()["records"]["message"]
    assert client.get(answer.headers["location"]).json()["ended"] is False


def test_a_service_that_records_nothing_loads_no_database() -> None:
    program = "import sys, relguide_server.app; print('sqlalchemy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, text=True
    )  # fmt: skip
    assert done.stdout == "False\n"


@pytest.mark.parametrize("name", ["%00", "a%00b", "%ff", "x" * 300, "..%2f"])
def test_ids_that_none_can_be_are_not_found(client: TestClient, name: str) -> None:
    for path in (f"flights/{name}", f"flights/{name}/documents", f"flights/{name}/export"):
        answered = client.get(f"/api/v1/records/{path}").status_code
        assert answered in (404, 422), path
    assert client.delete(f"/api/v1/records/flights/{name}").status_code in (404, 422)
    listed = client.get(f"/api/v1/records/flights?scenario={name}&cursor={name}")
    assert listed.status_code < 500
