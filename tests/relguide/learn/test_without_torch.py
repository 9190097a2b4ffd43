"""Networks and the tree plan, fly and serve without torch, scipy and safetensors."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.situations import GOLDEN

BLOCKED = """
import sys

class Blocker:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] in ("torch", "scipy", "safetensors"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Blocker)
"""
COMMAND = BLOCKED + "from relguide.__main__ import main\nraise SystemExit(main())\n"
SERVED = (
    BLOCKED
    + """
import json
from starlette.testclient import TestClient
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

body = json.load(open(sys.argv[1]))
app = create_app(ServiceSettings(planner="network", workers=0))
with TestClient(app, base_url="http://localhost") as client:
    print(client.post("/api/v1/plans", json=body).json()["planner"])
    small = {"columns": "32", "rows": "24", "planner": "network", "situation": json.dumps(body)}
    print(client.get("/api/v1/areas", params=small).status_code)
"""
)


@pytest.fixture
def situations(tmp_path: Path) -> Path:
    """Some in which the limit binds, and some in which it does not."""
    lines = (GOLDEN / "reference.situations.jsonl").read_text().splitlines()
    file = tmp_path / "situations.jsonl"
    file.write_text("\n".join(lines[:30]))
    return file


def run(program: str, *arguments: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("planner", ["network", "regular_dp"])
def test_plans(situations: Path, planner: str) -> None:
    done = run(COMMAND, "plan", "--batch", str(situations), "--planner", planner)
    assert done.stderr == ""
    plans = [json.loads(line) for line in done.stdout.splitlines()]
    own = [plan for plan in plans if plan.get("planner") == planner and not plan.get("fell_back")]
    assert len(own) > 10


@pytest.mark.slow
def test_a_flight() -> None:
    done = run(COMMAND, "fly", "fig_6b", "--planner", "network", "--json")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_the_service(situations: Path, tmp_path: Path) -> None:
    one = tmp_path / "one.json"
    body = json.loads(situations.read_text().splitlines()[0])
    del body["id"]
    one.write_text(json.dumps(body))
    done = run(SERVED, str(one))
    assert done.stdout.splitlines() == ["network", "200"], done.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ("train", "labels.npz", "weights.safetensors"),
        ("train", "labels.npz", "weights.safetensors", "--method", "templates"),
        ("train", "tree.npz", "weights.safetensors", "--method", "paper"),
    ],
)
def test_training_says_what_brings_torch(arguments: tuple[str, ...]) -> None:
    done = run(COMMAND, *arguments)
    assert done.returncode == 2
    assert "pip install 'relguide[learn]'" in done.stderr
    assert len(done.stderr.splitlines()) == 1
