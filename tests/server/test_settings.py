"""What an operator may set."""

import re
import subprocess
import sys

import pytest
from relguide_server.serving import uvicorn_options
from relguide_server.settings import ServiceSettings, options, settings_from

from tests.pages import ROOT, pages


def test_the_environment_overrides_and_an_option_overrides_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("RELGUIDE_MAX_FLIGHTS", "4")
    monkeypatch.setenv("RELGUIDE_KEEP_UNSEEN", "1.5")
    monkeypatch.setenv("RELGUIDE_SERVICE_PORT_HTTP", "80")  # as Kubernetes does
    monkeypatch.setenv("RELGUIDE_PORT", "tcp://10.0.0.1:80")
    assert settings_from() == ServiceSettings(max_flights=4, keep_unseen=1.5)
    assert settings_from(max_flights="5") == ServiceSettings(max_flights=5, keep_unseen=1.5)


@pytest.mark.parametrize(
    ("variable", "value", "sentence"),
    [
        ("MAX_FLIGHTS", "many", "RELGUIDE_MAX_FLIGHTS must be a whole number, not 'many'."),
        ("KEEP_UNSEEN", "long", "RELGUIDE_KEEP_UNSEEN must be a number, not 'long'."),
        ("KEEP_UNSEEN", "nan", "RELGUIDE_KEEP_UNSEEN must be a positive number, not 'nan'."),
        ("MAX_BODY", "0", "RELGUIDE_MAX_BODY must be 1 or more, not '0'."),
        ("PLANNER", "best", "RELGUIDE_PLANNER must be exact or network, not 'best'."),
        ("DRIFT_CHECK", "-1", "RELGUIDE_DRIFT_CHECK must be 0 or more, not '-1'."),
        ("LOG_FORMAT", "xml", "RELGUIDE_LOG_FORMAT must be text or json, not 'xml'."),
        ("ROOT_PATH", "//evil", "RELGUIDE_ROOT_PATH must be a path such as /relguide, not"),
        ("ROOT_PATH", "/api", "RELGUIDE_ROOT_PATH must not begin as a path of the service"),
        ("PROXIES", "proxy", "RELGUIDE_PROXIES must be addresses such as 127.0.0.1,10.0.0.0/8"),
        ("DATABASE_URL", "mysql://me:pw@x/y", "RELGUIDE_DATABASE_URL must begin with sqlite:///"),
        ("MAX_FLIHGTS", "4", "RELGUIDE_MAX_FLIHGTS is no setting: is RELGUIDE_MAX_FLIGHTS meant?"),
        ("HOST", "x", "RELGUIDE_HOST is no setting: is RELGUIDE_HOSTS meant?"),
        ("ZZZ", "x", "RELGUIDE_ZZZ is no setting: relguide serve --help lists all."),
    ],
)  # fmt: skip
def test_nonsense_is_refused_with_a_sentence(
    monkeypatch: pytest.MonkeyPatch, variable: str, value: str, sentence: str
) -> None:
    monkeypatch.setenv(f"RELGUIDE_{variable}", value)
    with pytest.raises(ValueError, match=re.escape(sentence)) as refused:
        settings_from()
    assert "pw@" not in str(refused.value)


def test_an_option_is_refused_by_its_name() -> None:
    with pytest.raises(ValueError, match="--keep-unseen must be a number, not 'long'"):
        settings_from(keep_unseen="long")


def test_help_lists_every_setting_with_its_default_and_unit() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "relguide", "serve", "--help"], capture_output=True, text=True
    )
    said = " ".join(done.stdout.split())
    for option in options():
        default = ServiceSettings.model_fields[option.name].get_default(
            call_default_factory=True, validated_data={}
        )
        shown = f"{default:g}" if isinstance(default, float) else str(default)
        assert f"{option.flag or option.variable} {option.unit}" in said
        rest = "" if option.name in ("tokens", "database_url") else f"; {option.variable}"
        assert f"(default: {shown or 'none'}{rest})" in said
    assert "--tokens" not in said


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("serve", "--max-flihgts", "4"), "does not know --max-flihgts: is --max-flights meant?"),
        (("fly", "fig_6b", "--sede=3"), "does not know --sede=3: is --seed meant?"),
        (("serve", "--queue", "0"), "--queue must be 1 or more, not '0'."),
    ],
)
def test_a_wrong_option_is_refused_with_a_sentence(
    arguments: tuple[str, ...], sentence: str
) -> None:
    done = subprocess.run([sys.executable, "-m", "relguide", *arguments], capture_output=True)
    assert done.returncode == 2
    assert sentence in done.stderr.decode()


def test_the_stream_is_not_compressed() -> None:
    options = uvicorn_options(host="127.0.0.1", port=8000, most=1, proxies="")
    assert options["ws_per_message_deflate"] is False


def test_settings_that_pages_name_are_there() -> None:
    """Or they are variables of compose.yaml."""
    composed = set(re.findall(r"\$\{(RELGUIDE_[A-Z_]+)", (ROOT / "compose.yaml").read_text()))
    known = composed | {option.variable for option in options()}
    named = {name for page in pages() for name in re.findall(r"RELGUIDE_[A-Z_]+", page.read_text())}
    assert named <= known, named - known


def test_options_that_the_page_names_are_there_with_these_defaults() -> None:
    text = (ROOT / "docs" / "service.md").read_text()
    fields = {option.flag: ServiceSettings.model_fields[option.name] for option in options()}
    assert set(re.findall(r"`(--[a-z-]+)`", text)) <= set(fields)
    told = re.findall(r"`(--[a-z-]+)` \((\d+)\)", text)
    assert len(told) == 4
    for flag, default in told:
        assert str(fields[flag].default) == default, flag
