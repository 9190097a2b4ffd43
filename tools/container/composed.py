"""The services of `compose.yaml`, and the image alone, started and looked at.

Run by `python -m tools.container`, in a network of its own.
"""

import asyncio
import json
import re
import signal
import sys
import time
import urllib.error
import urllib.request
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from relguide_server.planning.plans import EXAMPLE
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tools.container import composition
from tools.container.composition import NUMBERS, Container
from tools.container.debian import run_in
from tools.container.dockerfile import ROOT
from tools.container.image import Stage, read_stage
from tools.container.network import NETWORK, add_host, lay_bridge, write_names

PROXY = f"http://{NETWORK}.{NUMBERS['proxy'][0]}"
BELOW = f"{PROXY}:8080/relguide"
"""The same service below a path, as docs/service.md says it."""


def install_services(root: Path) -> None:
    """PostgreSQL and nginx, by what `make test` installs them with."""
    (root / "servers").write_text((ROOT / ".ci/servers").read_text())
    run_in(root, "sh /servers")
    run_in(root, "sh /servers")  # which now finds them


def main() -> int:
    """Start and look; an assertion says what is not as it should be."""
    folder = Path(sys.argv[1])
    stage = read_stage(folder)
    lay_bridge()
    look_at_image(stage, folder)
    look_at_composition(stage, folder)
    say("All as it should be.")
    return 0


def look_at_image(stage: Stage, folder: Path) -> None:
    """`docker run --read-only -v relguide:/data relguide`."""
    data = _data(folder, "alone")
    with composition.container(
        stage, add_host("alone", 9), given={}, writable={"/data": data}, log=folder / "alone.log"
    ) as alone:
        began = time.monotonic()
        alone.wait_until_healthy(stage.list_of("HEALTHCHECK"))
        say(f"The image plans {time.monotonic() - began:.1f} s after its start.")
        plan = ask(f"http://{NETWORK}.9:8000/api/v1/plans", EXAMPLE)
        assert plan["status"] == "planned", plan
        status = Path(f"/proc/{alone.pid}/status").read_text()
        assert re.search(r"^Uid:\t10001\t10001\t10001\t10001$", status, re.MULTILINE), status
        assert re.search(r"^CapBnd:\t0+$", status, re.MULTILINE), status
        assert re.search(r"^NoNewPrivs:\t1$", status, re.MULTILINE), status
        written = alone.run(["/bin/sh", "-c", "touch /opt/relguide/x /home/relguide/x /x"])
        assert written.stderr.count("Read-only file system") == 3, written.stderr
        missing = alone.run(["/opt/relguide/bin/python", "-c", "import torch"])
        assert "No module named 'torch'" in missing.stderr, missing.stderr
        took = alone.stop(getattr(signal, stage.said["STOPSIGNAL"]))
        assert took < 3.0, took
        say(f"It ends {took:.2f} s after {stage.said['STOPSIGNAL']}.")
    assert [file.name for file in data.iterdir()] == ["records.sqlite3"], list(data.iterdir())


def look_at_composition(stage: Stage, folder: Path) -> None:
    """`docker compose up`, and what its users do."""
    read = composition.composition()
    said, config = read["services"], read["configs"]["proxy"]["content"]
    names = folder / "hosts"
    write_names(names, NUMBERS)
    services = folder / "services" / "root"
    with ExitStack() as running:
        running.enter_context(
            composition.database(
                services, add_host("database", NUMBERS["database"][0]), said["database"]
            )
        )
        containers: dict[str, list[Container]] = {"flights-a": [], "flights-b": [], "planner": []}
        for name, made in containers.items():
            assert len(NUMBERS[name]) == said[name].get("deploy", {"replicas": 1})["replicas"]
            for number in NUMBERS[name]:
                begin = composition.container(
                    stage,
                    add_host(f"{name}{number}", number),
                    given=said[name]["environment"],
                    writable={"/etc/hosts": names, "/data": _data(folder, f"{name}{number}")},
                    log=folder / f"{name}{number}.log",
                )
                made.append(running.enter_context(begin))
        for made in containers.values():
            for one in made:
                one.wait_until_healthy(stage.list_of("HEALTHCHECK"))
        running.enter_context(
            composition.proxy(
                services, add_host("proxy", NUMBERS["proxy"][0]), config + below(), names
            )
        )
        _wait_for(f"{PROXY}/healthz")
        say("All services of the composition are healthy.")
        look_through_proxy(PROXY, "")
        look_through_proxy(BELOW, "/relguide")
        look_at_planners(containers["planner"])
        look_at_flights(*containers["flights-a"], *containers["flights-b"])
        look_at_records(containers["flights-b"][0], said["flights-b"])


def look_through_proxy(base: str, root: str) -> None:
    """Page, plans, a flight with its stream and scene, and who may not."""
    assert b"<html" in _open(f"{base}/").lower()
    flight = ask(f"{base}/api/v1/flights", {"scenario": "fig_6b"})
    assert flight["stream_url"].startswith(f"{root}/api/v1/flights/"), flight
    ticks = asyncio.run(_watch(base.removesuffix(root) + flight["stream_url"], 40))
    assert ticks == 40
    assert b"<html" in _open(base.removesuffix(root) + flight["scene_url"])
    ask(f"{base}/api/v1/flights/{flight['id']}/commands", {"command": "pause"})
    page = base.removesuffix(root)
    assert ask(f"{base}/api/v1/plans", EXAMPLE, origin=page)["status"] == "planned"
    for headers, status in (
        ({"Origin": "http://evil.example"}, 403),
        ({"Host": "evil.example"}, 421),
    ):
        assert _status(f"{base}/api/v1/flights", headers) == status
    say(f"Page, plans, stream and scene work at {base}/, and foreign pages are refused.")


def look_at_planners(planners: list[Container]) -> None:
    """Both plan; and nobody notices that one is gone."""
    before = [_planned(number) for number in NUMBERS["planner"]]
    _plan_often()
    shares = [
        _planned(number) - old for number, old in zip(NUMBERS["planner"], before, strict=True)
    ]
    assert sum(shares) == 40, shares
    assert min(shares) > 10, shares
    planners[0].stop(signal.SIGKILL)
    _plan_often()
    say(f"Two planners shared 40 plans as {shares}; with one killed the other made all 40.")


def look_at_flights(a: Container, b: Container) -> None:
    """Both fly, one list has the flights of both, and each is found by its id."""
    started = [ask(f"{PROXY}/api/v1/flights", {"scenario": "fig_6b"})["id"] for _ in range(16)]
    assert {name[0] for name in started} == {"a", "b"}, started
    listed = [flight["id"] for flight in ask(f"{PROXY}/api/v1/flights")["flights"]]
    assert set(started) <= set(listed), listed
    for name in started:
        assert ask(f"{PROXY}/api/v1/flights/{name}")["id"] == name
    a.stop(signal.SIGKILL)
    for _ in range(4):
        assert ask(f"{PROXY}/api/v1/flights", {"scenario": "fig_6b"})["id"][0] == "b"
    for name in started:
        assert _status(f"{PROXY}/api/v1/flights/{name}", {}, None) == (
            404 if name[0] == "a" else 200
        )
    say("Two processes fly behind one address; with one killed the other flies on.")


def look_at_records(flights: Container, said: dict[str, Any]) -> None:
    """PostgreSQL has them, whoever wrote them."""
    assert said["environment"]["RELGUIDE_DATABASE_URL"].startswith("postgresql://")
    _wait_for(f"http://{NETWORK}.{NUMBERS['flights-b'][0]}:8000/readyz")  # its workers, too
    ready = ask(f"http://{NETWORK}.{NUMBERS['flights-b'][0]}:8000/readyz")
    assert ready["records"] == {"status": "on", "message": ""}, ready
    listed = ask(f"{PROXY}/api/v1/records/flights")["flights"]
    assert {one["scenario"] for one in listed} == {"fig_6b"}, listed
    assert ask(f"{PROXY}/api/v1/records/plans")["plans"]
    took = flights.stop(signal.SIGTERM)
    assert took < 3.0, took
    say(f"{len(listed)} flights are on record; the service of flights ends within {took:.2f} s.")


def below() -> str:
    """A proxy that serves below a path, from docs/service.md."""
    text = (ROOT / "docs/service.md").read_text()
    (location,) = re.findall(r"```\n(location /relguide/ \{.*?\n\})\n```", text, re.DOTALL)
    there = location.replace("http://127.0.0.1:8000/", "http://flights-a:8000/")
    assert there != location
    return f"server {{\nlisten 8080;\n{there}\n}}\n"


def ask(url: str, body: object = None, *, origin: str = "") -> Any:
    """What a service answers, as JSON."""
    headers = {"Content-Type": "application/json"} | ({"Origin": origin} if origin else {})
    data = None if body is None else json.dumps(body).encode()
    asked = urllib.request.Request(url, data, headers)
    try:
        with urllib.request.urlopen(asked, timeout=30.0) as answer:
            return json.load(answer)
    except urllib.error.HTTPError as refused:
        raise AssertionError(f"{url} answers {refused.read().decode()}") from None


def _open(url: str) -> bytes:
    with urllib.request.urlopen(url, timeout=30.0) as answer:
        content: bytes = answer.read()
        return content


def _status(url: str, headers: dict[str, str], body: bytes | None = b"{}") -> int:
    try:
        urllib.request.urlopen(urllib.request.Request(url, body, headers), timeout=30.0).close()
    except urllib.error.HTTPError as refused:
        return refused.code
    return 200


async def _watch(url: str, most: int) -> int:
    ticks = 0
    protocols = [Subprotocol(PROTOCOL)]
    async with connect(url.replace("http", "ws", 1), subprotocols=protocols, proxy=None) as stream:
        async for _ in stream:
            ticks += 1
            if ticks == most:
                break
    return ticks


def _planned(number: int) -> float:
    text = _open(f"http://{NETWORK}.{number}:8000/metrics").decode()
    found = re.findall(r'^relguide_plans_total\{status="planned"\} (\S+)$', text, re.MULTILINE)
    return float(found[0]) if found else 0.0


def _plan_often() -> None:
    for _ in range(40):
        assert ask(f"{PROXY}/api/v1/plans", EXAMPLE)["status"] == "planned"


def _wait_for(url: str) -> None:
    end = time.monotonic() + 20.0
    while True:
        try:
            _open(url)
            return
        except OSError:
            assert time.monotonic() < end, url
            time.sleep(0.2)


def _data(folder: Path, name: str) -> Path:
    place = folder / "data" / name
    place.mkdir(parents=True, exist_ok=True)
    for file in place.iterdir():
        file.unlink()
    place.chmod(0o777)
    return place


def say(sentence: str) -> None:
    """A line of the report."""
    sys.stdout.write(f"{sentence}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
