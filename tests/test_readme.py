"""What the README shows is what happens."""

import io
import json
import re
from contextlib import redirect_stdout
from pathlib import Path

from fastapi.testclient import TestClient
from relguide_server.app import create_app

from tests.pages import blocks

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()


def test_twelve_lines_of_python() -> None:
    (code,) = blocks(README, "python")
    (shown,) = blocks(README, "text")
    assert len([line for line in code.splitlines() if line.strip()]) == 12
    printed = io.StringIO()
    with redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    assert printed.getvalue() == shown


def test_one_request() -> None:
    (curl,) = [block for block in blocks(README, "sh") if block.startswith("curl")]
    body = json.loads(curl[curl.index("'{") + 1 : curl.rindex("}'") + 1])
    path = re.search(r":8000(\S+)", curl)
    assert path is not None
    with TestClient(create_app(), base_url="http://localhost") as client:
        answer = client.post(path[1], json=body)
    assert answer.status_code == 200
    assert answer.json()["status"] == "planned"
    assert json.loads((ROOT / "examples" / "situation.json").read_text()) == body


def test_its_commands_run_without_an_activated_environment() -> None:
    commands = re.findall(r"\S*relguide (?:plan|fly|serve|figures|claims|campaign)\b", README)
    assert len(commands) == 3
    assert all(command.strip("`").startswith(".venv/bin/relguide ") for command in commands)


def test_it_is_read_in_five_minutes() -> None:
    assert len(README.split()) <= 1000


def test_its_picture_moves_and_is_light() -> None:
    (name,) = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", README)
    picture = (ROOT / name).read_bytes()
    assert b"ANIM" in picture[:64]  # a chunk of WebP
    assert len(picture) <= 1_500_000
