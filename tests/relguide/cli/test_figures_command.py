"""`relguide figures`: what it draws, lists and refuses."""

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from relguide.figures.catalogue import FIGURES
from tests.command_line import Run


def test_they_are_listed_with_what_they_take(run: Run) -> None:
    code, out, err = run("figures", "--list")
    assert (code, err) == (0, "")
    listed = json.loads(out)["figures"]
    assert [one["name"] for one in listed] == list(FIGURES)
    assert all(one["cpu_s"] > 0.0 for one in listed)
    code, out, _ = run("figures", "--list", "--table", "fig_1", "fig_4")
    assert [line.split()[0] for line in out.splitlines()] == ["fig_1", "fig_4", "all"]


def test_those_asked_for_are_drawn_in_both_forms(run: Run) -> None:
    code, out, err = run("figures", "fig_1", "intent", "--out", "a/b", "--format", "both")
    assert (code, err) == (0, "relguide: 2 figures are in a/b/.\n")
    told = json.loads(out)["figures"]
    assert [one["name"] for one in told] == ["fig_1", "intent"]
    assert told[0]["command"] == "relguide figures fig_1"
    assert "d = 29.5 km" in told[0]["caption"]
    svg, png = (Path(file) for file in told[1]["files"])
    assert ElementTree.parse(svg).getroot().tag.endswith("svg")
    assert png.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("fig_9",), "There is no figure 'fig_9'"),
        (("fig_1", "--gallery", "page.md"), "A gallery shows all figures"),
        (("--gallery", "page.md", "--format", "png"), "A gallery is of SVG"),
        (("--list", "--gallery", "page.md"), "not allowed with argument"),
        (("fig_1", "--format", "gif"), "invalid choice: 'gif'"),
    ],
)
def test_what_cannot_be_meant_is_refused(run: Run, arguments: tuple[str, ...], said: str) -> None:
    code, out, err = run("figures", *arguments)
    assert (code, out) == (2, "")
    assert said in err


def test_what_is_not_installed_is_said_before_anything_is_drawn(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("relguide.planning.extras.is_installed", lambda name: name != "quickjs")
    code, out, err = run("figures", "fig_1", "fig_7", "--out", "drawn")
    assert (code, out) == (2, "")
    assert "pip install 'relguide[pictures]' brings it." in err
    assert not Path("drawn").exists()
