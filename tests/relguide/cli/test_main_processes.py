"""`relguide` as a process: pipes, Ctrl-C, what `--help` loads, and a service that stops."""

import json
import signal
import socket
import subprocess
import sys
from pathlib import Path
from time import monotonic, sleep
from urllib.request import urlopen

import pytest

from tests.bodies import BODY
from tests.command_line import process


@pytest.mark.slow
def test_a_reader_that_has_seen_enough_is_no_error(tmp_path: Path) -> None:
    batch = tmp_path / "batch.jsonl"
    batch.write_text(f"{json.dumps(BODY)}\n" * 300)
    command = f"{sys.executable} -m relguide plan --batch {batch} | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=120)
    assert json.loads(done.stdout)["status"] == "planned"
    assert done.stderr == ""


@pytest.mark.slow
def test_ctrl_c_stops_it_with_a_word() -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "relguide", "plan", "--batch", "-"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        running.stdin.write(f"{json.dumps(BODY)}\n" * 20)
        running.stdin.flush()
        assert running.stdout.read(1) == "{"  # it is planning now
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=60)
        assert running.returncode == 130
        assert err.strip() == "relguide: stopped."


def test_help_loads_nothing_heavy() -> None:
    program = (
        "import sys, relguide\n"
        "before = set(sys.modules)\n"
        "import relguide.__main__ as m\n"
        "try: m.main(['plan', '--help'])\n"
        "except SystemExit: pass\n"
        "heavy = {'torch', 'fastapi', 'uvicorn', 'pydantic', 'rich', 'numba', 'pyproj'}\n"
        "print('HEAVY', *sorted(heavy & (set(sys.modules) - before)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "HEAVY"


@pytest.mark.slow
def test_serve_serves_and_stops(tmp_path: Path) -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with subprocess.Popen(
        [sys.executable, "-m", "relguide", "serve", "--port", str(port)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as running:
        try:
            assert running.stdout is not None
            said = running.stdout.readline()
            assert said == f"relguide is on http://127.0.0.1:{port} (Ctrl-C stops it)\n"
            assert answers(f"http://127.0.0.1:{port}/healthz", within=60.0)
            taken = process("serve", "--port", str(port))
            assert taken.returncode == 2
            assert f"127.0.0.1, port {port}: Address already in use." in taken.stderr
        finally:
            running.send_signal(signal.SIGINT)
            running.wait(timeout=30)
    assert running.returncode in (0, 130)


def answers(url: str, *, within: float) -> bool:
    end = monotonic() + within
    while monotonic() < end:
        try:
            with urlopen(url, timeout=5) as response:
                return bool(response.status == 200)
        except OSError:
            sleep(0.1)
    return False


def test_a_plan_loads_nothing_of_flights_and_learning() -> None:
    """What `relguide plan` must not load, since it starts a second sooner without."""
    program = (
        "import sys, relguide.__main__ as m\n"
        "m.main(['plan', '-'])\n"
        "heavy = ('torch', 'distributed', 'pyarrow', 'pyproj', 'rich', 'relguide.maps',\n"
        "    'relguide.flying.guidance', 'relguide.flying.world',\n"
        "    'relguide.contract.document_models', 'relguide.planning.alternatives',\n"
        "    'relguide.planning.optimality')\n"
        "print('HEAVY', *(name for name in heavy if name in sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], input=json.dumps(BODY), capture_output=True, text=True
    )
    assert (done.stdout.splitlines()[-1], done.stderr) == ("HEAVY", "")
