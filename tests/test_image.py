"""The container without an engine: what it installs, and its steps in an empty directory.

`make container` takes all of its steps, which is minutes; here those that download or compile are
left out.
"""

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import sysconfig
import time
import tomllib
from pathlib import Path
from urllib.request import urlopen

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from relguide_server.app import create_app
from relguide_server.http import health
from relguide_server.jobs.worker_pool import PULSE
from relguide_server.records.database import connect, url_of
from relguide_server.records.entries import Unavailable
from relguide_server.settings import ServiceSettings, read_peers

from tests.server.records.places import HAS_POSTGRES, NO_POSTGRES, postgres
from tests.server.serving import ideal_app, ideal_catalogue, serve
from tests.server.test_service_life import wait_until
from tools.container.composition import PASSWORD, composition
from tools.container.dockerfile import ROOT, copied, steps

LOCK = (ROOT / "requirements.lock").read_text()
COMPOSE = composition()
SERVED = ("flights-a", "flights-b", "planner")
TOKEN = "v" * 16


def test_the_lock_is_what_the_service_needs_by_hash_and_without_torch() -> None:
    pinned = dict(re.findall(r"^([\w.-]+)==(\S+)", LOCK, re.MULTILINE))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    for line in [*project["dependencies"], *extras["serve"], *extras["postgres"], *extras["atc"]]:
        wanted = Requirement(line)
        name = canonicalize_name(wanted.name)
        assert name in pinned, f"make lock: {name} is missing"
        assert wanted.specifier.contains(pinned[name]), f"make lock: {name}=={pinned[name]}"
    assert "torch" not in pinned
    parts = re.split(r"^(?=[\w.-]+==)", LOCK, flags=re.MULTILINE)[1:]
    assert all("--hash=sha256:" in part for part in parts)
    assert "://" not in LOCK


@pytest.mark.slow
def test_its_steps_work_in_an_empty_directory(tmp_path: Path) -> None:
    """Those of the Dockerfile, with the packages and kernels of this machine, and started so."""
    places = {name: f"{tmp_path}{name}" for name in ("/opt/relguide", "/src", "/data")}
    environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "RELGUIDE_SKIP_WEB": "1"}
    here = tmp_path / "src"
    here.mkdir()
    seen: dict[str, str] = {}
    for name, given in steps():
        for path, place in places.items():
            given = re.sub(rf"(?<=[\s=]){path}\b", place, f" {given}").strip()
        match name:
            case "RUN" if "zensical" in given:
                extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
                assert all(need in given for need in extras["optional-dependencies"]["docs"])
                build = [sys.executable, "-m", "zensical", "build", "--strict"]
                subprocess.run(build, check=True, cwd=here)
            case "RUN" if given.startswith("python -m venv"):
                subprocess.run([sys.executable, *given.split()[1:]], check=True)
                (site,) = Path(places["/opt/relguide"]).glob("lib/python*/site-packages")
                # in place of what the lock names: what is installed here
                (site / "here.pth").write_text(sysconfig.get_path("purelib"))
            case "COPY" if given == ". .":
                for file in copied():
                    (here / file).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(ROOT / file, here / file)
            case "COPY" if given.startswith("requirements.lock"):
                assert Path("requirements.lock") in copied()
            case "RUN" if "requirements.lock" in given or given.startswith("useradd"):
                pass  # downloads what the lock's test has judged; makes a user
            case "RUN" if given.endswith("pip install --no-deps ."):
                offline = given.replace("install", "install --no-build-isolation --quiet")
                subprocess.run(offline, shell=True, check=True, cwd=here, env=environment)
                installed = site / "relguide" / "kernels" / "__pycache__"
                shutil.copytree(
                    ROOT / "relguide/kernels/__pycache__", installed, dirs_exist_ok=True
                )
            case "RUN" if given.startswith("relguide warm-up"):
                pass  # minutes: the kernels of this machine were copied
            case "ENV":
                pairs = re.findall(r"(\w+)=(\S+)", given)
                known = {k: v.replace("$PATH", environment["PATH"]) for k, v in pairs}
                known.pop("NUMBA_CPU_NAME", None)  # these kernels are for this CPU
                environment |= known
            case "RUN":
                pytest.fail(f"This test does not know the step {given}.")
            case _:
                seen[name] = given
    assert seen["STOPSIGNAL"] == "SIGTERM"
    assert seen["USER"] == "10001"
    assert seen["FROM"].startswith("${BASE}")
    run_as_in_the_container(tmp_path, environment, seen)


def run_as_in_the_container(
    folder: Path, environment: dict[str, str], seen: dict[str, str]
) -> None:
    (folder / "data").mkdir()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [*yaml.safe_load(seen["ENTRYPOINT"]), *yaml.safe_load(seen["CMD"])]
    command[-1] = str(port)
    program = folder / "opt/relguide/bin" / command[0]
    before = sorted(folder.rglob("*"))
    check = yaml.safe_load(seen["HEALTHCHECK"].partition("CMD ")[2])
    python = str(folder / "opt/relguide/bin/python")
    with subprocess.Popen([program, *command[1:]], cwd=folder, env=environment) as service:
        try:
            end = time.monotonic() + 90.0
            healthy = [python, *check[1:], f"http://127.0.0.1:{port}"]
            while subprocess.run(healthy, env=environment, capture_output=True).returncode:
                assert service.poll() is None, "The service has ended."
                assert time.monotonic() < end
                time.sleep(0.3)
            with urlopen(f"http://127.0.0.1:{port}/guide/tutorial/1-plan/") as page:
                assert b"<h1" in page.read()
            stopping = time.monotonic()
            service.send_signal(getattr(signal, seen["STOPSIGNAL"]))
            service.wait(10.0)
            assert time.monotonic() - stopping < 3.0
        finally:
            service.kill()
    written = {path for path in folder.rglob("*") if path not in set(before)}
    assert {path.relative_to(folder).parts[0] for path in written} <= {"data"}
    assert (folder / "data/records.sqlite3").is_file()


@pytest.mark.parametrize("tokens", ["", f"view:{TOKEN}"])
def test_healthy_is_who_plans(tokens: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RELGUIDE_TOKENS", tokens)
    with serve(ideal_app(tokens=tokens)) as address:
        assert health.main([f"http://{address}"]) == 0
        monkeypatch.setenv("RELGUIDE_TOKENS", "view:another")
        assert health.main([f"http://{address}"]) == bool(tokens)
    assert health.main([f"http://{address}"]) == 1


def test_who_finds_no_plan_is_not_healthy(monkeypatch: pytest.MonkeyPatch) -> None:
    faster = {**health.SITUATION["leader"], "tas_mps": 300}
    with serve(ideal_app()) as address:
        assert health.main([f"http://{address}"]) == 0
        monkeypatch.setattr(health, "SITUATION", {**health.SITUATION, "leader": faster})
        assert health.main([f"http://{address}"]) == 1


def test_who_cannot_plan_is_not_healthy() -> None:
    def broken(situation: object) -> None:
        raise RuntimeError("on purpose")

    with serve(create_app(ServiceSettings(workers=0), planner=broken)) as address:
        assert health.main([f"http://{address}"]) == 1


def test_whose_workers_are_frozen_is_not_healthy() -> None:
    app = create_app(ServiceSettings(workers=2), catalogue=ideal_catalogue())
    with serve(app) as address:
        wait_until(lambda: len(app.state.workers.processes) == 2)
        wait_until(lambda: health.main([f"http://{address}"]) == 0)
        for process in app.state.workers.processes:
            os.kill(process, signal.SIGSTOP)
        time.sleep(PULSE)
        began = time.monotonic()
        assert health.main([f"http://{address}"]) == 1
        assert time.monotonic() - began < health.PATIENCE
        wait_until(lambda: health.main([f"http://{address}"]) == 0)  # they are replaced


DIGEST = "sha256:" + "0a" * 32


@pytest.mark.parametrize(
    ("base", "pinned"),
    [
        ("", True),
        (f"python:3.12-slim@{DIGEST}", True),
        (f"registry.example:5000/base/python@{DIGEST}", True),
        ("python:3.12-slim", False),
        (f"python:3.12-slim@{DIGEST}0", False),
        (f"python:3.12-slim@{DIGEST.upper()}", False),
        (DIGEST, False),
        (f"python 3@{DIGEST}", False),
    ],
)
def test_a_base_is_named_by_its_digest(base: str, pinned: bool, tmp_path: Path) -> None:
    (tmp_path / "docker").write_text('#!/bin/sh\necho "$@"\n')
    (tmp_path / "docker").chmod(0o755)
    made = subprocess.run(
        ["make", "--silent", "image", f"BASE={base}"],
        cwd=ROOT,
        env={**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (made.returncode == 0) == pinned, made.stderr
    if pinned:
        assert (f"--build-arg BASE={base}" in made.stdout) == bool(base)
    else:
        assert "BASE must be an image with its digest" in made.stdout


def test_the_base_may_be_given_to_every_stage() -> None:
    given = list(steps())
    default = given[0][1].removeprefix("BASE=")
    assert given[0] == ("ARG", f"BASE={default}")
    assert all(what.startswith("${BASE}") for name, what in given if name == "FROM")
    for name in SERVED:
        assert COMPOSE["services"][name]["build"]["args"]["BASE"] == default


@pytest.mark.skipif(not HAS_POSTGRES, reason=NO_POSTGRES)
def test_any_password_opens_the_database(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What compose hands over, to a PostgreSQL that asks for it."""
    given = COMPOSE["services"]["planner"]["environment"]
    asked = COMPOSE["services"]["database"]["environment"]
    assert given["PGPASSWORD"] == asked["POSTGRES_PASSWORD"] == PASSWORD
    with postgres() as server:
        server.ask_for_password(PASSWORD)
        address = given["RELGUIDE_DATABASE_URL"].replace(
            "@database/relguide", f"@127.0.0.1:{server.port}/postgres"
        )
        url = url_of(address, Path("unused"))
        monkeypatch.delenv("PGPASSWORD", raising=False)
        with pytest.raises(Unavailable, match="password"):
            connect(url)
        monkeypatch.setenv("PGPASSWORD", given["PGPASSWORD"])
        connect(url).dispose()


def test_compose_names_settings_that_exist_and_writes_nowhere() -> None:
    services = COMPOSE["services"]
    assert set(services) == {"database", *SERVED, "proxy"}
    assert services["planner"]["deploy"]["replicas"] == 2
    known = {f"RELGUIDE_{name.upper()}" for name in ServiceSettings.model_fields}
    for name in SERVED:
        assert services[name]["read_only"] is True
        assert set(services[name]["environment"]) <= known | {"PGPASSWORD"}
    for service in services.values():
        assert service["mem_limit"]
        assert float(service["cpus"]) > 0
    for letter in "ab":
        given = services[f"flights-{letter}"]["environment"]
        assert given["RELGUIDE_PROCESS"] == letter
        assert read_peers(given["RELGUIDE_PEERS"])[letter] == f"http://flights-{letter}:8000"
    proxy = COMPOSE["configs"]["proxy"]["content"]
    assert "proxy_set_header Host $http_host;" in proxy
