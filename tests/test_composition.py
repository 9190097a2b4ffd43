"""The proxy of the composition: which process is asked for what, by nginx where it is installed."""

import json
import os
import shutil
import socket
import ssl
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import httpx2 as httpx
import pytest

from tests.server.test_service_life import wait_until
from tools.container.composition import composition
from tools.container.names import answer

CONFIGS = composition()["configs"]
HOSTS = """\
127.0.0.2 flights-a
127.0.0.3 flights-b
127.0.0.4 planner
127.0.0.5 planner
"""
NAMES = {line.split()[0]: line.split()[1] for line in HOSTS.splitlines()}
PLANNER = b"\x12\x34\x01\x00\x00\x01\x00\x00\x00\x00\x00\x00\x07planner\x00\x00\x01\x00\x01"
"""Where is planner?, as a name server is asked (RFC 1035)."""
NGINX = shutil.which("nginx", path=f"{os.environ['PATH']}:/usr/sbin") or ""
pytestmark = pytest.mark.skipif(
    not NGINX or sys.platform != "linux", reason="needs nginx, on Linux: apt-get install nginx"
)


class Service(ThreadingHTTPServer):
    """One that answers for a service."""

    status = 200


class Echo(BaseHTTPRequestHandler):
    """Answers with the name of the service that it stands for, and what it was sent."""

    server: Service

    def do_GET(self) -> None:
        sent = self.rfile.read(int(self.headers.get("Content-Length") or 0)).decode()
        name = NAMES[str(self.server.server_address[0])]
        said = {"name": name, "method": self.command, "path": self.path, "body": sent}
        body = json.dumps(said | {"headers": dict(self.headers.items())}).encode()
        self.send_response(self.server.status)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_POST = do_PUT = do_DELETE = do_GET

    def log_message(self, *_: Any) -> None:
        pass


@dataclass(frozen=True, slots=True)
class Proxy:
    """nginx, as the composition has it."""

    http: int
    https: int
    services: dict[str, Service]
    names: Path

    def ask(self, path: str, method: str = "GET", **options: Any) -> dict[str, Any]:
        answered: dict[str, Any] = self.send(path, method, **options).json()
        return answered

    def send(self, path: str, method: str = "GET", **options: Any) -> httpx.Response:
        return httpx.request(method, f"http://127.0.0.1:{self.http}{path}", **options)


def free_port(kind: socket.SocketKind = socket.SOCK_STREAM) -> int:
    with socket.socket(socket.AF_INET, kind) as free:
        free.bind(("127.0.0.1", 0))
        port: int = free.getsockname()[1]
        return port


def begin(
    stack: ExitStack, folder: Path, *, tls: bool = False, rate: int = 100, burst: int = 200
) -> Proxy:
    """Start it with a service of ours for each name."""
    http, https, served = free_port(), free_port(), free_port()
    resolving = free_port(socket.SOCK_DGRAM)
    services = {}
    for address in NAMES:
        services[address] = Service((address, served), Echo)
        threading.Thread(target=services[address].serve_forever, daemon=True).start()
        stack.callback(services[address].server_close)
        stack.callback(services[address].shutdown)
    names = folder / "hosts"
    names.write_text(HOSTS)
    (folder / "tls.d").mkdir()
    site, secure = CONFIGS["proxy"]["content"], CONFIGS["tls"]["content"]
    for old, new in (
        ("127.0.0.11 valid=5s", f"127.0.0.1:{resolving} valid=1s"),
        ("listen 80;", f"listen 127.0.0.1:{http};"),
        ("rate=100r/s", f"rate={rate}r/s"),
        ("burst=200", f"burst={burst}"),
        (":8000", f":{served}"),
        ("/etc/nginx", str(folder)),
    ):
        assert old in site
        site = site.replace(old, new)
    if tls:
        for old, new in (
            ("listen 443", f"listen 127.0.0.1:{https}"),
            ("/tls/", f"{folder}/"),
            ("8443", str(https)),
        ):
            assert old in secure
            secure = secure.replace(old, new)
        (folder / "tls.d/tls.conf").write_text(secure)
    kinds = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    written = "".join(f"{kind}_temp_path {folder}/{kind};\n" for kind in kinds)
    (folder / "nginx.conf").write_text(
        f"pid {folder}/pid;\nerror_log stderr;\ndaemon off;\nevents {{}}\n"
        f"http {{\naccess_log off;\n{written}{site}\n}}\n"
    )
    for command in (
        [sys.executable, "-m", "tools.container.names", str(names), "127.0.0.1", str(resolving)],
        [NGINX, "-p", str(folder), "-e", "stderr", "-c", f"{folder}/nginx.conf"],
    ):
        process = stack.enter_context(subprocess.Popen(command))
        stack.callback(process.terminate)
    wait_until(lambda: resolves(resolving) and connects(http))
    return Proxy(http, https, services, names)


def connects(port: int) -> bool:
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


def resolves(port: int) -> bool:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tried:
        tried.settimeout(0.2)
        tried.connect(("127.0.0.1", port))
        try:
            tried.send(PLANNER)
            return bool(tried.recv(512))
        except OSError:
            return False


@pytest.fixture(scope="module")
def proxy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxy]:
    with ExitStack() as stack:
        yield begin(stack, tmp_path_factory.mktemp("nginx"))


@pytest.mark.parametrize(
    ("method", "path", "name"),
    [
        ("GET", "/api/v1/flights/a-3f2a9c0d71be", "flights-a"),
        ("GET", "/api/v1/flights/b-3f2a9c0d71be", "flights-b"),
        ("POST", "/api/v1/flights/b-3f2a9c0d71be/commands", "flights-b"),
        ("DELETE", "/api/v1/flights/a-3f2a9c0d71be", "flights-a"),
        ("GET", "/api/v1/flights/b-3f2a9c0d71be/stream", "flights-b"),
        ("GET", "/scene/a-3f2a9c0d71be/", "flights-a"),
        ("GET", "/scene/b-3f2a9c0d71be", "flights-b"),
        ("POST", "/api/v1/plans", "planner"),
        ("POST", "/api/v1/plans/batch?max_ms=50", "planner"),
        ("POST", "/api/v1/simulations", "planner"),
        ("POST", "/api/v1/areas", "planner"),
        ("GET", "/api/v1/areas?flight=a-3f2a9c0d71be&rows=9", "flights-a"),
        ("GET", "/api/v1/areas?flight=b-3f2a9c0d71be", "flights-b"),
        ("GET", "/api/v1/areas?situation={}", "planner"),
        ("PUT", "/api/v1/traffic", "flights-a"),
        ("PUT", "/api/v1/airspaces", "flights-a"),
        ("POST", "/api/v1/clearances/x/answers", "flights-a"),
        ("GET", "/api/v1/atc/stream", "flights-a"),
    ],
)
def test_each_is_asked_for_what_it_does(proxy: Proxy, method: str, path: str, name: str) -> None:
    for _ in range(4):
        found = proxy.ask(path, method, content=b"{}" if method != "GET" else None)
        assert (found["name"], found["method"], found["path"]) == (name, method, path)


@pytest.mark.parametrize("path", ["/", "/api/v1/flights", "/api/v1/records/flights", "/scene/z-1/"])
def test_both_processes_are_asked_for_what_either_does(proxy: Proxy, path: str) -> None:
    assert {proxy.ask(path)["name"] for _ in range(40)} == {"flights-a", "flights-b"}


def test_who_asks_chooses_a_process_by_name_or_by_asking_again(proxy: Proxy) -> None:
    for letter in "ab":
        for _ in range(8):
            named = proxy.ask("/api/v1/flights", "POST", headers={"Relguide-Process": letter})
            assert named["name"] == f"flights-{letter}"
    for key in ("one", "two", "three"):
        sent = [proxy.ask("/api/v1/flights", "POST", headers={"Idempotency-Key": key})
                for _ in range(8)]  # fmt: skip
        assert len({found["name"] for found in sent}) == 1


def test_what_is_passed_on(proxy: Proxy) -> None:
    found = proxy.ask(
        "/api/v1/flights", "POST", content=b'{"x": 1}', headers={"X-Forwarded-For": "192.0.2.9"}
    )
    headers = {name.lower(): value for name, value in found["headers"].items()}
    assert found["body"] == '{"x": 1}'
    assert headers["host"] == f"127.0.0.1:{proxy.http}"
    assert headers["x-forwarded-for"] == "127.0.0.1"
    assert headers["x-forwarded-proto"] == "http"
    assert headers["x-request-id"]


def test_who_asks_too_often_is_refused(tmp_path: Path) -> None:
    with ExitStack() as stack:
        proxy = begin(stack, tmp_path, rate=1, burst=4)
        statuses = [proxy.send("/healthz").status_code for _ in range(20)]
    assert statuses[:5] == [200] * 5
    assert 503 in statuses


def test_a_process_that_is_gone_is_not_missed(tmp_path: Path) -> None:
    with ExitStack() as stack:
        proxy = begin(stack, tmp_path)
        for address in ("127.0.0.2", "127.0.0.4"):
            proxy.services[address].shutdown()
            proxy.services[address].server_close()
        for _ in range(10):
            started = proxy.ask("/api/v1/flights", "POST", content=b"{}")
            assert (started["name"], started["method"], started["body"]) == (
                "flights-b", "POST", "{}"
            )  # fmt: skip
            assert proxy.ask("/api/v1/flights/a-1")["name"] == "flights-b"
            assert proxy.ask("/api/v1/plans", "POST", content=b"{}")["name"] == "planner"


def test_what_one_is_too_full_for_the_other_does_unless_it_was_asked_for(tmp_path: Path) -> None:
    with ExitStack() as stack:
        proxy = begin(stack, tmp_path)
        proxy.services["127.0.0.2"].status = 429
        for _ in range(10):
            started = proxy.send("/api/v1/flights", "POST", content=b"{}")
            assert (started.status_code, started.json()["name"]) == (200, "flights-b")
        asked = {"Relguide-Process": "a"}
        assert proxy.send("/api/v1/flights", "POST", headers=asked).status_code == 429
        assert proxy.send("/api/v1/flights/a-1/commands", "POST").status_code == 429


def test_a_name_that_moves_is_found_again(tmp_path: Path) -> None:
    with ExitStack() as stack:
        proxy = begin(stack, tmp_path)
        assert proxy.ask("/api/v1/flights/a-1")["name"] == "flights-a"
        proxy.names.write_text(HOSTS.replace("127.0.0.2", "127.0.0.5"))
        wait_until(lambda: proxy.ask("/api/v1/flights/a-1")["name"] == "planner")


def test_a_certificate_in_the_volume_makes_it_https(tmp_path: Path) -> None:
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=localhost",
         "-keyout", tmp_path / "key.pem", "-out", tmp_path / "certificate.pem"],
        check=True, capture_output=True,
    )  # fmt: skip
    with ExitStack() as stack:
        proxy = begin(stack, tmp_path, tls=True)
        trusted = ssl.create_default_context(cafile=str(tmp_path / "certificate.pem"))
        secure = f"https://localhost:{proxy.https}"
        answered = httpx.get(f"{secure}/scene/b-1/?x=1", verify=trusted).json()
        assert (answered["name"], answered["path"]) == ("flights-b", "/scene/b-1/?x=1")
        assert answered["headers"]["X-Forwarded-Proto"] == "https"
        sent = proxy.send("/docs?y=2", headers={"Host": f"localhost:{proxy.http}"})
        assert (sent.status_code, sent.headers["location"]) == (308, f"{secure}/docs?y=2")


def test_a_name_has_all_its_addresses() -> None:
    said = answer(PLANNER, HOSTS)
    assert said[:2] == PLANNER[:2]
    assert said.count(socket.inet_aton("127.0.0.4")) == 1
    assert said.endswith(socket.inet_aton("127.0.0.5"))
    assert answer(PLANNER.replace(b"planner", b"unknown"), HOSTS)[3] & 0xF == 3
