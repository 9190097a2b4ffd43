"""What commands print goes to the right stream at once, and files tell who has made them."""

import sys
from argparse import ArgumentParser
from datetime import UTC, datetime, timedelta
from io import BytesIO, TextIOWrapper

import numpy as np
import pytest

from relguide import __version__
from relguide.cli.output import add_form, for_people, provenance, say, write, write_json
from relguide.planning import extras
from relguide.planning.extras import MissingExtra
from tests.command_line import Run


@pytest.mark.parametrize(
    ("stream", "printed", "expected"),
    [
        ("stdout", lambda: write("α\n"), "α\n"),
        ("stdout", lambda: write_json({"name": "ψ", "of": [1]}),
         '{\n  "name": "ψ",\n  "of": [\n    1\n  ]\n}\n'),
        ("stderr", lambda: say("It is done."), "relguide: It is done.\n"),
    ],
)  # fmt: skip
def test_it_arrives_at_once(
    monkeypatch: pytest.MonkeyPatch, stream: str, printed: object, expected: str
) -> None:
    """A pipe holds text back until it is flushed: then a reader of lines would wait."""
    pipe = BytesIO()
    monkeypatch.setattr(sys, stream, TextIOWrapper(pipe, "utf-8"))
    assert callable(printed)
    printed()
    assert pipe.getvalue().decode() == expected


@pytest.mark.parametrize(
    ("options", "terminal", "expected"),
    [
        ([], True, True),
        ([], False, False),
        (["--json"], True, False),
        (["--json"], False, False),
        (["--table"], True, True),
        (["--table"], False, True),
    ],
)
def test_people_read_terminals_and_programs_the_rest_but_as_asked(
    monkeypatch: pytest.MonkeyPatch, options: list[str], terminal: bool, expected: bool
) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal, raising=False)
    parser = ArgumentParser()
    add_form(parser)
    chosen = parser.parse_args(options)
    assert for_people(chosen, "rich") is expected
    monkeypatch.setitem(sys.modules, "rich", None)
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    if chosen.table:
        with pytest.raises(MissingExtra, match="rich"):
            for_people(chosen, "rich")
    else:
        assert not for_people(chosen, "rich")
    assert for_people(chosen) is expected


@pytest.mark.parametrize(
    "command", ["plan", "check", "fly", "replay", "dataset", "train", "audit", "area"]
)
def test_each_command_that_prints_a_result_has_both_forms(run: Run, command: str) -> None:
    _, out, _ = run(command, "--help")
    assert {"--json", "--table"} <= set(out.split())


def test_a_file_tells_who_has_made_it() -> None:
    about = provenance("exact", command="relguide dataset")
    made = datetime.fromisoformat(about.pop("made"))
    assert abs(datetime.now(UTC) - made) < timedelta(minutes=5)
    assert about == {
        "program": f"relguide {__version__}",
        "method": "exact",
        "command": "relguide dataset",
        "numpy": np.__version__,
    }
