"""What an operator may set."""

import re
from pathlib import Path

import pytest
from relguide_server.serving import uvicorn_options
from relguide_server.settings import Settings, settings_from


def test_the_environment_overrides() -> None:
    environment = {"RELGUIDE_MAX_FLIGHTS": "4", "RELGUIDE_KEEP_UNSEEN": "1.5", "HOME": "/"}
    assert settings_from(environment) == Settings(max_flights=4, keep_unseen=1.5)


@pytest.mark.parametrize(
    ("environment", "sentence"),
    [
        ({"RELGUIDE_MAX_FLIGHTS": "many"}, "RELGUIDE_MAX_FLIGHTS must be a whole number"),
        ({"RELGUIDE_KEEP_UNSEEN": "long"}, "RELGUIDE_KEEP_UNSEEN must be a number"),
        ({"RELGUIDE_KEEP_UNSEEN": "nan"}, "keep_unseen must be a positive number"),
        ({"RELGUIDE_MAX_BODY": "0"}, "max_body must be 1 or more"),
        ({"RELGUIDE_PLANNER": "regular_dp"}, "planner must be exact or network, not regular_dp"),
        ({"RELGUIDE_DRIFT_CHECK": "-1"}, "drift_check must be 0 or more, not -1"),
    ],
)
def test_nonsense_is_refused_with_a_sentence(environment: dict[str, str], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        settings_from(environment)


def test_the_stream_is_not_compressed() -> None:
    assert uvicorn_options(host="127.0.0.1", port=8000)["ws_per_message_deflate"] is False


def test_every_setting_is_in_the_docs() -> None:
    docs = Path(__file__).parents[2] / "docs"
    text = (docs / "service.md").read_text() + (docs / "records.md").read_text()
    named = set(re.findall(r"^\| `RELGUIDE_([A-Z_]+)`", text, flags=re.MULTILINE))
    assert named == {name.upper() for name in Settings.__dataclass_fields__}
