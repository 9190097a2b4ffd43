"""What the pages show is what happens, and what they name is there."""

import ast
import io
import json
import re
import shlex
import xml.etree.ElementTree as ET
from contextlib import redirect_stdout
from dataclasses import replace
from datetime import UTC, datetime
from importlib import import_module
from math import degrees
from pathlib import Path

import pytest
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

import relguide
from relguide import Plan, plan
from relguide.__main__ import _parse as understood
from relguide.__main__ import main
from relguide.contract.answers import answer
from relguide.contract.bodies import situation_from_json
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from tests.pages import ROOT, blocks, fenced, pages
from tests.server.serving import TestClient, serve

DOCS = ROOT / "docs"
SERVICE, COMMANDS, FLIGHT, NETWORK, PAPER, MAP = (
    (DOCS / f"{name}.md").read_text()
    for name in ("service", "commands", "flight", "network", "paper", "architecture")
)


def run_with_service(code: str) -> list[str]:
    """The lines that a program of a page prints, with a service to ask."""
    printed = io.StringIO()
    with serve(create_app(ServiceSettings(workers=0))) as address, redirect_stdout(printed):
        exec(compile(code.replace("127.0.0.1:8000", address), "service.md", "exec"), {})
    return printed.getvalue().splitlines()


@pytest.mark.slow
def test_the_client() -> None:
    code, _ = blocks(SERVICE, "python")
    word, *modes = run_with_service(code)
    assert word in ("LSL", "LSR", "RSL", "RSR")
    assert all(re.fullmatch(r"\d+ s: \w+", mode) for mode in modes)
    assert [mode.split()[-1] for mode in modes] == ["converge", "capture", "follow"]


@pytest.mark.slow
def test_the_client_that_does_not_wait() -> None:
    _, code = blocks(SERVICE, "python")
    lines = run_with_service(code)
    assert len(lines) == 6
    assert all(re.fullmatch(r"[LR]S[LR] in \d+ s", line) for line in lines[:3])
    assert lines[3:] == ["planned"] * 3


def test_the_requests_of_the_controllers_page() -> None:
    (asked,) = [
        block for block in blocks((DOCS / "atc.md").read_text(), "sh") if "/traffic" in block
    ]
    bodies = re.findall(
        r"curl -X PUT '?localhost:8000(\S+?)'? -H 'Content-Type: (\S+)' -d (.*?)(?=\ncurl|\Z)",
        asked,
        re.DOTALL,
    )
    assert len(bodies) == 2
    with TestClient(create_app(ServiceSettings(workers=0))) as client:
        for path, kind, given in bodies:
            if given.startswith("@"):
                body = (ROOT / given[1:].strip()).read_text()
            else:
                now = datetime.now(UTC).strftime("%FT%TZ")
                body = given.strip().strip("'").replace("'$(date -u +%FT%TZ)'", now)
            answered = client.put(path, content=body, headers={"Content-Type": kind})
            assert answered.status_code == 200, answered.text


def test_the_answer_amid_others() -> None:
    """To what the page leaves of its digits."""
    (shown,) = (json.loads(block) for block in blocks(SERVICE, "json"))
    situation, anchor = situation_from_json((ROOT / "examples" / "amid.json").read_bytes())
    reply = answer(situation, anchor, plan)
    alone = plan(replace(situation, others=()))
    assert isinstance(alone, Plan)
    later = reply["time_to_converge_s"] - alone.time_to_converge
    assert re.search(r"growing storm, (\d+) s later", SERVICE)[1] == f"{later:.0f}"  # type: ignore[index]
    for name, value in shown.items():
        if name != "separation":
            assert _rounded(reply[name]) == value
    others = reply["separation"].pop("others")
    assert [_rounded(other) for other in others] == shown["separation"].pop("others")
    assert _rounded(reply["separation"]) == shown["separation"]


def _rounded(said: object) -> object:
    match said:
        case float():
            return round(said, 3)
        case dict():
            return {name: _rounded(part) for name, part in said.items()}
        case _:
            return said


def test_commands_are_there(capsys: pytest.CaptureFixture[str]) -> None:
    listed = {arguments[0] for arguments in shown_commands()}
    planning, drawing = {"plan", "check", "claims"}, {"area", "figures", "picture"}
    learning = {"dataset", "train", "audit"}
    assert (
        listed == {"fly", "replay", "campaign", "serve", "warm-up"} | planning | drawing | learning
    )
    for command in listed:
        with pytest.raises(SystemExit) as end:
            main([command, "--help"])
        assert end.value.code == 0
        assert f"relguide {command}" in capsys.readouterr().out


def shown_commands() -> list[list[str]]:
    """What docs/commands.md tells `relguide` to do, as its arguments; comments left out."""
    lines = "".join(blocks(COMMANDS, "sh")).splitlines()
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
    assert {arguments[0] for arguments in run} == {"plan", "check", "fly", "campaign"}
    for arguments in run:
        assert main(arguments) == 0, arguments
        assert capsys.readouterr().out or "--out" in arguments


@pytest.mark.slow
def test_figures_6a_and_6b() -> None:
    told = re.findall(r"`(fig_6[ab])`[^`]*?after (\d+) s and[a-z ]*? (\d+)°", FLIGHT)
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
    millions, cells = re.findall(r"([\d.]+) million regular.*? ([\d,]+) cells", NETWORK, re.DOTALL)[
        0
    ]
    assert f"{made['trajectories'] / 1e6:.1f}" == millions
    assert f"{made['states']:,}" == cells
    order, optimal, nearly = re.findall(r"order (\d), (\d+) % .*?(\d+) % within 1 %", NETWORK)[0]
    assert made["parameters"]["order"] == int(order)
    assert made["audit"]["share_within_0_percent"] == pytest.approx(int(optimal) / 100, abs=0.01)
    assert made["audit"]["share_within_1_percent"] == pytest.approx(int(nearly) / 100, abs=0.01)


def test_make_targets_are_there() -> None:
    makefile = (ROOT / "Makefile").read_text()
    for page in pages():
        text = page.read_text()
        commands = re.findall(r"`make ([\w-]+)", text)
        commands += re.findall(r"^make ([\w-]+)", "".join(blocks(text, "sh")), re.MULTILINE)
        for target in commands:
            assert f"\n{target}:" in makefile, f"{page.name}: make {target}"


def test_the_map_leads_somewhere() -> None:
    (tree,) = blocks(MAP, "text")
    folders = [ROOT]  # and those a line is in, outermost first
    for line in tree.splitlines():
        names = re.match(r"( *)((?:[\w.]+/?(?:, )?)+)", line)
        assert names is not None, line
        del folders[1 + len(names[1]) // 2 :]
        for name in names[2].strip().split(", "):
            assert (folders[-1] / name).exists(), name
        if names[2].strip().endswith("/"):
            folders.append(folders[-1] / names[2].strip())


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for link, heading in re.findall(r"\]\((?!http)([^)#]*)(?:#([^)]*))?\)", page.read_text()):
        to = page.parent / link if link else page
        assert to.exists(), link
        titles = re.findall(r"^#+ (.*)", to.read_text(), re.MULTILINE) if heading else []
        anchors = {re.sub(r"[^\w -]", "", title).lower().replace(" ", "-") for title in titles}
        assert not heading or heading in anchors, heading


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_files_that_are_named_are_there(page: Path) -> None:
    # an address of the service begins with a stroke, what is made meanwhile lies in .make
    names = re.findall(rf"`(?![/.])(?:[a-z][\w./-]*/)?([\w-]+\.(?:{SUFFIXES}))`", page.read_text())
    known = {file.name for folder in FOLDERS for file in (ROOT / folder).rglob("*.*")}
    known |= {file.name for file in ROOT.iterdir()} | {file.name for file in TESTED.rglob("*.*")}
    for name in names:
        assert name in known or "FILE" in name, name


SUFFIXES = "py|tsx?|toml|csv|svg|json|jsonl|yaml|lock"
FOLDERS = ("benchmarks", "docs", "examples", "relguide", "server", "tests", "tools", "web/src")
"""Where files are that pages name, beside the root itself, and …"""
TESTED = ROOT / "web" / "test"
"""… without what npm installs."""


PAPER_ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAPER.splitlines()
    if line.startswith(("| (", "| Fig", "| after", "| section", "| ε"))
]


def test_every_equation_and_figure_of_the_paper_has_a_row() -> None:
    named = [name for row in PAPER_ROWS for name in row[0].split(", ")]
    due = [f"({number})" for number in range(1, 25)]
    due += [f"Fig. {number}" for number in ("1", "2", "3", "4", "5", "6a", "6b", "7")]
    assert {name for name in named if name[0] in "(F"} == set(due)
    assert len(named) == len(set(named))


@pytest.mark.parametrize("row", PAPER_ROWS, ids=lambda row: row[0])
def test_a_row_of_the_paper_names_code_and_tests_that_exist(row: list[str]) -> None:
    what, code, corrected, test = row
    assert corrected
    file, name = re.fullmatch(r"`(relguide/[\w/]+\.py)::(\w+)`", code).groups()  # type: ignore[union-attr]
    source = (ROOT / file).read_text()
    assert re.search(rf"^(?:def|class) {name}\b", source, re.MULTILINE)
    said = {int(number) for number in re.findall(r"\((\d{1,2})\)", source)}
    for first, last in re.findall(r"\((\d+)\)–\((\d+)\)", source):
        said.update(range(int(first), int(last)))
    assert not what.startswith("(") or {int(n) for n in re.findall(r"\d+", what)} <= said
    file, name = re.fullmatch(r"`(test_\w+\.py)::(test_\w+)`", test).groups()  # type: ignore[union-attr]
    assert any(f"def {name}(" in found.read_text() for found in (ROOT / "tests").rglob(file))


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_commands_of_all_pages_are_understood(page: Path) -> None:
    blocks = [code for name, code in fenced(page.read_text()) if name in ("sh", "")]
    for line in "".join(blocks).replace("\\\n", "").splitlines():
        for command in re.split(r"&&|\|", line):
            words = shlex.split(command, comments=True) if "relguide" in command else []
            if words and words[0] in ("relguide", ".venv/bin/relguide"):
                assert understood(words[1:]).command == words[1]
    for module in re.findall(r"python -m ([\w.]+)", page.read_text()):
        path = ROOT / module.replace(".", "/")
        found = path.with_suffix(".py").exists() or (path / "__main__.py").exists()
        assert found or module in ("pip", "pytest", "venv"), module


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_python_of_all_pages_uses_names_that_exist(page: Path) -> None:
    """Whether or not another test runs it."""
    for code in blocks(page.read_text(), "python"):
        tree = ast.parse(code)
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                module = import_module(str(node.module))
                assert all(hasattr(module, name.name) for name in node.names), code
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                assert node.value.id != "rg" or hasattr(relguide, node.attr), node.attr


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_pictures_are_pictures(page: Path) -> None:
    for name in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", page.read_text()):
        begins = (page.parent / name).read_bytes()[:256]
        match Path(name).suffix:
            case ".svg":
                assert b"<svg" in begins, name
            case ".png":
                assert begins.startswith(b"\x89PNG"), name
            case kind:
                assert kind == ".webp", name
                assert begins.startswith(b"RIFF"), name


@pytest.mark.parametrize("figure", sorted(DOCS.rglob("*.svg")), ids=lambda figure: figure.name)
def test_figures_are_xml_and_shown(figure: Path) -> None:
    ET.parse(figure)
    assert any(figure.name in page.read_text() for page in pages())


def test_decisions_are_listed_and_short() -> None:
    folder = DOCS / "decisions"
    listed = re.findall(r"\]\((\d{3}-[\w-]+\.md)\)", (folder / "README.md").read_text())
    assert listed == sorted(file.name for file in folder.glob("[0-9]*.md"))
    for name in listed:
        assert len((folder / name).read_text().split()) <= 90, name
