"""What commands print goes to the right stream at once, and files tell who has made them."""

import sys
from datetime import UTC, datetime, timedelta
from io import BytesIO, TextIOWrapper

import numpy as np
import pytest

from relguide import __version__
from relguide.cli.output import provenance, say, write, write_json


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
