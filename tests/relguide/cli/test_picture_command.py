"""`relguide picture`: what it writes, and what it says."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.command_line import Run


@pytest.mark.slow
def test_a_scenario_is_flown_and_drawn(run: Run) -> None:
    code, out, err = run("picture", "fig_6b", "--at", "560", "--out", "nd.svg", "--light")
    assert (code, out, err) == (0, "", "relguide: nd.svg is written.\n")
    texts = [element.text for element in ElementTree.parse("nd.svg").iter()]
    assert "relguide picture fig_6b --at 560 --light --out nd.svg" in texts


@pytest.mark.slow
def test_a_recording_is_drawn_as_pixels(run: Run) -> None:
    run("fly", "fig_6b", "--record", "a flight.jsonl.gz", "--json")
    view = ("--mode", "ROSE", "--range", "80")
    code, _, err = run("picture", "a flight.jsonl.gz", "--at", "0.5", "--out", "nd.png", *view)
    assert (code, err) == (0, "relguide: nd.png is written.\n")
    assert Path("nd.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("fig_9", "--at", "1", "--out", "nd.svg"), "There is no scenario 'fig_9'"),
        (("fig_6b", "--at", "1", "--out", "nd.jpg"), "must end in .svg or .png, not be nd.jpg"),
        (("fig_6b", "--at", "x", "--out", "nd.svg"), "must be a number of seconds from 0 to 43200"),
        (("fig_6b", "--at", "1", "--range", "50", "--out", "nd.svg"), "invalid choice: 50"),
        (("none.jsonl", "--at", "1", "--out", "nd.svg"), "none.jsonl: No such file or directory."),
        (("track.csv", "--at", "1", "--out", "nd.svg"), "track.csv is no recording: its name"),
    ],
)
def test_what_cannot_be_drawn_is_refused(run: Run, arguments: tuple[str, ...], said: str) -> None:
    Path("track.csv").write_text("t,x\n")
    code, out, err = run("picture", *arguments)
    assert (code, out) == (2, "")
    assert said in err


@pytest.mark.slow
def test_an_instant_after_the_end_is_refused_with_the_span(run: Run) -> None:
    code, _, err = run("picture", "fig_6b", "--at", "2000", "--out", "nd.svg")
    assert code == 2
    assert "t = 2000 s is outside the flight, which goes from 0 s to 1036 s." in err
    assert not Path("nd.svg").exists()
