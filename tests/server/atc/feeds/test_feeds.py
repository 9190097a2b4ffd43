"""Feeds while the service runs: what they bring is in the picture, what is wrong is counted."""

import asyncio
import json
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from time import monotonic, sleep, time
from typing import Any

import pytest
from relguide_server.atc.feeds.feed_state import SILENT_AFTER, FeedState
from relguide_server.atc.feeds.readsb_feed import aircraft_in
from relguide_server.atc.feeds.replay_feed import play
from relguide_server.atc.reports import Reports
from relguide_server.feed_settings import AsterixFeed, ReadsbFeed, ReplayFeed, feeds_of

from relguide.atc.reported import Reported
from relguide.contract.recorder import record
from relguide.planning.frames import LocalPlane
from relguide.units import FT, KT
from tests.server.atc.feeds.asterix_bytes import block, track_062
from tests.server.flown import ideal_flight
from tests.server.serving import TestClient, ideal_app
from tests.written_flights import rows, write_csv


def aircraft(**more: Any) -> Reported:
    said = {"ident": "A", "t": 100.0, "lat_deg": 50.0, "lon_deg": 8.0, "track": 0.0,
            "ground_speed": 200.0, **more}  # fmt: skip
    return Reported(**said)


def wait_for(there: Callable[[], Any]) -> Any:
    end = monotonic() + 30.0
    while not (found := there()):
        assert monotonic() < end
        sleep(0.05)
    return found


def traffic(client: TestClient) -> dict[str, Any]:
    return {one["ident"]: one for one in client.get("/api/v1/traffic").json()["aircraft"]}


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@pytest.mark.slow
def test_asterix_is_heard_and_noise_ends_nothing() -> None:
    address = f"asterix://127.0.0.1:{free_port()}"
    port = int(address.rpartition(":")[2])
    with (
        TestClient(ideal_app(feed=address)) as client,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):

        def standing() -> dict[str, Any]:
            (feed,) = client.get("/readyz").json()["feeds"]
            return dict(feed)

        assert (standing()["feed"], standing()["state"]) == (address, "silent")
        assert "Nothing usable has come of it yet." in standing()["message"]

        def send() -> bool:
            track = track_062(tod=time() % 86_400.0, lat=50.0, lon=8.0, east=200.0, north=0.0)
            for message in (b"", b"noise", block(62, b"\xff\xff"), block(62, track)):
                sender.sendto(message, ("127.0.0.1", port))
            return "BAW12" in traffic(client)

        wait_for(send)
        assert traffic(client)["BAW12"]["source"] == address
        assert standing()["state"] == "hears"
        assert standing()["malformed"] >= 2
        numbers = client.get("/metrics").text
        assert f'relguide_feed_heard{{feed="{address}"}} 1.0' in numbers
        assert f'relguide_feed_malformed_total{{feed="{address}"}}' in numbers
        ended = track_062(tod=0.0, lat=0.0, lon=0.0, east=0.0, north=0.0, ended=True)
        wait_for(
            lambda: sender.sendto(block(62, ended), ("127.0.0.1", port)) and not traffic(client)
        )


READSB = {
    "now": 1_700_000_000.5,
    "aircraft": [
        {"hex": "4ca1fe", "flight": "EIN5LJ  ", "lat": 51.5, "lon": -1.25, "seen_pos": 0.5,
         "alt_baro": 37_000, "gs": 450.0, "track": 90.0, "baro_rate": -640},
        {"hex": "400001", "lat": 51.0, "lon": -1.0, "seen_pos": 2.0, "alt_geom": 9_000, "gs": 120.0,
         "track": 1.0},
        {"hex": "400002", "lat": 51.0, "lon": -1.0, "seen_pos": 2.0, "alt_baro": "ground",
         "gs": 5.0, "track": 1.0},
        {"hex": "400003", "alt_baro": 30_000, "gs": 400.0},
        {"hex": "400004", "lat": True, "lon": "8", "seen_pos": 1, "gs": 1, "track": 1},
        "noise",
    ],
}  # fmt: skip


def test_what_readsb_says() -> None:
    (first, second), unusable = aircraft_in(READSB)
    assert (first.ident, first.t) == ("EIN5LJ", 1_700_000_000.0)
    assert first.altitude == pytest.approx(37_000 * FT)
    assert first.ground_speed == pytest.approx(450.0 * KT)
    assert first.climb == pytest.approx(-640 * FT / 60.0)
    assert (second.ident, second.altitude, second.climb) == ("400001", None, 0.0)
    assert unusable == 3


@contextmanager
def answering(body: Callable[[], bytes]) -> Iterator[str]:
    class Answer(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.end_headers()
            self.wfile.write(body())

        def log_message(self, *_: object) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Answer) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}/data/aircraft.json"
        server.shutdown()
        thread.join()


@pytest.mark.slow
def test_readsb_is_polled_over_http_and_as_a_file(tmp_path: Path) -> None:
    file = tmp_path / "aircraft.json"
    file.write_text("[]")
    answers = iter([b"{", b"[]"])

    def body() -> bytes:
        return next(answers, json.dumps({**READSB, "now": time()}).encode())

    with answering(body) as url:
        feeds = f"readsb:{url}, readsb:{file}, readsb:{tmp_path}/none"
        with TestClient(ideal_app(feed=feeds)) as client:
            wait_for(lambda: "EIN5LJ" in traffic(client))
            by_http, by_file, missing = client.get("/readyz").json()["feeds"]
            assert (by_http["state"], by_http["malformed"]) == ("hears", 2)
            assert (by_file["state"], missing["state"]) == ("silent", "silent")
            assert "no list of aircraft" in by_file["message"]
            assert "cannot be read" in missing["message"]


def test_one_of_our_own_flights_is_played_where_it_is_said_to_lie(tmp_path: Path) -> None:
    file, plane = tmp_path / "flight.jsonl", LocalPlane(50.0, 8.0)
    documents = list(record(ideal_flight(), file))
    first = next(document for document in documents if document.kind == "sample")
    reports = Reports()
    state = FeedState(address="replay", reports=reports)

    async def listen() -> None:
        await asyncio.wait_for(play(str(file), plane, state), 1.5)

    begun = time()
    with pytest.raises(TimeoutError):
        asyncio.run(listen())
    heard = reports.heard(time())
    assert set(heard) == {one.ident for one in first.aircraft}
    own = first.aircraft[0]
    report = heard[own.ident].report
    assert report.t == pytest.approx(begun + 1.0, abs=0.5)
    x, y = plane.to_local(report.lat_deg, report.lon_deg)
    assert abs(complex(x - own.x, y - own.y)) == pytest.approx(own.ground_speed, rel=0.05)


def test_a_recording_with_places_is_played_to_its_end(tmp_path: Path) -> None:
    file = tmp_path / "trace.json"
    points = [[k * 0.2, 50.0 + k * 1e-3, 8.0, 30_000, 450.0, 0.0, 0] for k in range(6)]
    points[3][3] = "ground"
    trace = {"icao": "4ca1fe", "timestamp": 1_700_000_000.0, "trace": points}
    file.write_text(json.dumps(trace))
    state = FeedState(address="replay", reports=Reports())
    asyncio.run(play(str(file), None, state))
    assert (state.taken, state.stands(time()), state.message(time())) == (
        5, "over", "It was played to its end.",
    )  # fmt: skip
    lost = FeedState(address="replay", reports=Reports())
    asyncio.run(play(str(tmp_path / "none.json"), None, lost))
    assert "cannot be played" in lost.message(time())


def test_a_recording_with_exchanged_places_is_not_played(tmp_path: Path) -> None:
    exchanged = [
        row | {"latitude": row["longitude"], "longitude": row["latitude"]} for row in rows()
    ]
    file = write_csv(tmp_path / "track.csv", exchanged)
    state = FeedState(address="replay", reports=Reports())
    asyncio.run(asyncio.wait_for(play(str(file), None, state), 10.0))
    assert state.taken == 0
    assert "TEST12 of" in state.message(time())
    assert "latitude and longitude are exchanged" in state.message(time())


@pytest.mark.parametrize(
    "wrong",
    [
        {"lat_deg": 91.0}, {"lon_deg": float("nan")}, {"ground_speed": 700.0}, {"ident": "\x07"},
        {"ident": ""}, {"altitude": 50_000.0}, {"climb": float("inf")}, {"track": float("nan")},
    ],
)  # fmt: skip
def test_what_cannot_be_is_counted(wrong: dict[str, Any]) -> None:
    state = FeedState(address="feed", reports=Reports())
    state.take([aircraft(**wrong)], 101.0)
    assert (state.unusable, state.taken) == (1, 0)


@pytest.mark.parametrize(("seconds", "said"), [(10.0, "10 s from now"), (-70.0, "70 s ago")])
def test_a_clock_that_differs_is_said(seconds: float, said: str) -> None:
    state = FeedState(address="feed", reports=Reports())
    state.take([aircraft(t=100.0 + seconds)], 100.0)
    assert (state.untimely, state.taken) == (1, 0)
    assert said in state.message(100.0)


def test_a_feed_falls_silent() -> None:
    state = FeedState(address="feed", reports=Reports())
    state.take([aircraft()], 101.0)
    assert state.stands(101.0 + SILENT_AFTER) == "hears"
    assert state.stands(102.0 + SILENT_AFTER) == "silent"
    assert "for 11 s" in state.message(102.0 + SILENT_AFTER)


def test_how_feeds_are_named() -> None:
    text = "asterix://[ff02::1]:8600, readsb:http://h/a.json?x=1,2,replay:a,b.csv,replay:f@-50,8.5"
    asterix, readsb, recording, flight = feeds_of(text)
    assert isinstance(asterix, AsterixFeed)
    assert (asterix.host, asterix.port) == ("ff02::1", 8600)
    assert isinstance(readsb, ReadsbFeed)
    assert readsb.where == "http://h/a.json?x=1,2"
    assert isinstance(recording, ReplayFeed)
    assert (recording.file, recording.place) == ("a,b.csv", None)
    assert isinstance(flight, ReplayFeed)
    assert (flight.file, flight.place) == ("f", (-50.0, 8.5))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("asterix:0.0.0.0:8600", "feeds with commas"),
        ("asterix://radar:8600", "asterix://ADDRESS:PORT"),
        ("asterix://0.0.0.0:0", "asterix://ADDRESS:PORT"),
        ("replay:f@100,8", "by degrees"),
        ("replay:f@1.2.3,8", "by degrees"),
        ("readsb:", "feeds with commas"),
        ("readsb:a,readsb:a", "once"),
    ],
)
def test_a_feed_that_is_none_is_refused(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        feeds_of(text)
