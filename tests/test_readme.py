"""What the README shows is what happens."""

import io
import json
import re
import shlex
from contextlib import redirect_stdout
from math import degrees
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

from relguide import plan
from relguide.__main__ import main
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from tests.server.serving import serve

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.DOTALL | re.MULTILINE)


def test_twelve_lines_of_python() -> None:
    code, _, _ = blocks("python")
    shown = blocks("text")[0]
    assert len([line for line in code.splitlines() if line.strip()]) == 12
    printed = io.StringIO()
    with redirect_stdout(printed):
        exec(compile(code, "README.md", "exec"), {})
    assert printed.getvalue() == shown


def test_one_request() -> None:
    (curl,) = [block for block in blocks("sh") if block.startswith("curl")]
    body = json.loads(curl[curl.index("'{") + 1 : curl.rindex("}'") + 1])
    path = re.search(r":8000(\S+)", curl)
    assert path is not None
    with TestClient(create_app(), base_url="http://localhost") as client:
        answer = client.post(path[1], json=body)
    assert answer.status_code == 200
    assert answer.json()["status"] == "planned"
    assert json.loads((ROOT / "examples" / "situation.json").read_text()) == body


def run_with_service(code: str) -> list[str]:
    """The lines that a program of the README prints, with a service to ask."""
    printed = io.StringIO()
    with serve(create_app(ServiceSettings(workers=0))) as address, redirect_stdout(printed):
        exec(compile(code.replace("127.0.0.1:8000", address), "README.md", "exec"), {})
    return printed.getvalue().splitlines()


@pytest.mark.slow
def test_the_client() -> None:
    _, code, _ = blocks("python")
    word, *modes = run_with_service(code)
    assert word in ("LSL", "LSR", "RSL", "RSR")
    assert all(re.fullmatch(r"\d+ s: \w+", mode) for mode in modes)


@pytest.mark.slow
def test_the_client_that_does_not_wait() -> None:
    _, _, code = blocks("python")
    lines = run_with_service(code)
    assert len(lines) == 6
    assert all(re.fullmatch(r"[LR]S[LR] in \d+ s", line) for line in lines[:3])
    assert lines[3:] == ["planned"] * 3


def test_commands_are_there(capsys: pytest.CaptureFixture[str]) -> None:
    listed = re.findall(r"^relguide ([\w-]+)", "".join(blocks("sh")), re.MULTILINE)
    planning, learning = {"plan", "check"}, {"dataset", "area", "train", "audit"}
    assert set(listed) == {"fly", "replay", "serve", "warm-up"} | planning | learning
    for command in set(listed):
        with pytest.raises(SystemExit) as end:
            main([command, "--help"])
        assert end.value.code == 0
        assert f"relguide {command}" in capsys.readouterr().out


def shown_commands() -> list[list[str]]:
    """What the README tells `relguide` to do, as its arguments; comments left out."""
    lines = "".join(blocks("sh")).splitlines()
    return [shlex.split(line, comments=True)[1:] for line in lines if line.startswith("relguide ")]


def test_files_that_commands_read_are_there() -> None:
    """Or made by a command before."""
    made = set[str]()
    for arguments in shown_commands():
        for name in arguments:
            if re.search(r"\.[a-z]+$", name) and name not in made:
                before = arguments[arguments.index(name) - 1]
                if before in ("--out", "--figure", "--record") or arguments[0] == "train":
                    made.add(name)
                else:
                    assert (ROOT / name).is_file(), name


@pytest.mark.slow
def test_commands_with_examples_succeed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    run = [asked for asked in shown_commands() if any("examples/" in name for name in asked)]
    assert {arguments[0] for arguments in run} == {"plan", "check", "fly"}
    for arguments in run:
        assert main(arguments) == 0, arguments
        assert capsys.readouterr().out or "--out" in arguments


@pytest.mark.slow
def test_figures_6a_and_6b() -> None:
    told = re.findall(r"`(fig_6[ab])`[^`]*?after (\d+) s and[a-z ]*? (\d+)°", README)
    assert [name for name, _, _ in told] == ["fig_6a", "fig_6b"]
    for name, seconds, degrees_turned in told:
        *_, ended = fly(scenario(name), plan)
        assert isinstance(ended, FlightEnded)
        (result,) = ended.results
        # a percent: what the reader learns stays true when a gain is tuned
        assert result.join_time == pytest.approx(float(seconds), rel=0.01)
        assert degrees(result.heading_swing) == pytest.approx(
            float(degrees_turned), rel=0.01, abs=1
        )


@pytest.mark.slow
def test_the_figures_of_the_tree(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(tmp_path / "tree.npz")
    assert main(["dataset", "--method", "reverse-dp", "--out", file, "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    millions, cells = re.findall(r"([\d.]+) million regular.*? ([\d,]+) cells", README, re.DOTALL)[
        0
    ]
    assert f"{made['trajectories'] / 1e6:.1f}" == millions
    assert f"{made['states']:,}" == cells
    order, optimal, nearly = re.findall(r"order (\d), (\d+) % .*?(\d+) % within 1 %", README)[0]
    assert made["parameters"]["order"] == int(order)
    assert made["audit"]["share_within_0_percent"] == pytest.approx(int(optimal) / 100, abs=0.01)
    assert made["audit"]["share_within_1_percent"] == pytest.approx(int(nearly) / 100, abs=0.01)


def test_make_targets_are_there() -> None:
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"(?:^|`)make (\w+)", README, re.MULTILINE):
        assert f"\n{target}:" in makefile, f"make {target}"


def test_map_and_links_lead_somewhere() -> None:
    (tree,) = [block for block in blocks("text") if block.startswith("relguide/")]
    folders = [ROOT]  # and those a line is in, outermost first
    for line in tree.splitlines():
        names = re.match(r"( *)((?:[\w.]+/?(?:, )?)+)", line)
        assert names is not None, line
        del folders[1 + len(names[1]) // 2 :]
        for name in names[2].strip().split(", "):
            assert (folders[-1] / name).exists(), name
        if names[2].strip().endswith("/"):
            folders.append(folders[-1] / names[2].strip())
    for link, heading in re.findall(r"\]\((?!http|#)([^)#]+)(?:#([^)]*))?\)", README):
        assert (ROOT / link).exists(), link
        titles = re.findall(r"^#+ (.*)", (ROOT / link).read_text(), re.MULTILINE) if heading else []
        assert not heading or heading in {title.lower().replace(" ", "-") for title in titles}


def test_errata_name_tests_that_exist() -> None:
    for file, name in re.findall(r"`(\w+\.py)::(\w+)`", README):
        found = list((ROOT / "tests").rglob(file))
        assert found, file
        assert any(f"def {name}(" in path.read_text() for path in found), f"{file}::{name}"
