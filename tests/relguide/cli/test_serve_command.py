"""`relguide serve` says what it lets others do, and what a start would do."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from relguide.cli.serve_command import open_to_all

TOKENS = "control:" + 16 * "x"


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.7", "example.org"])
def test_a_service_that_is_open_to_all_is_said_to_be(host: str) -> None:
    assert open_to_all(host, "").startswith(f"Everyone that reaches {host} may")
    assert "RELGUIDE_TOKENS" in open_to_all(host, "")
    assert "delete records" not in open_to_all(host, "")
    assert "delete records" in open_to_all(host, "", "on")
    assert open_to_all(host, TOKENS) == ""


@pytest.mark.parametrize("host", ["127.0.0.1", "127.1.2.3", "::1", "localhost"])
def test_what_only_this_machine_reaches_is_not(host: str) -> None:
    assert open_to_all(host, "") == ""


def check(*options: str, **environment: str) -> tuple[int, str]:
    command = [sys.executable, "-m", "relguide", "serve", "--check", "--port", "18149", *options]
    done = subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **environment}
    )
    return done.returncode, done.stdout + done.stderr


def test_a_check_changes_nothing(tmp_path: Path) -> None:
    status, said = check("--data", str(tmp_path))
    assert (status, "is made at the start" in said) == (0, True), said
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "records.sqlite3").write_text("no database at all" * 100)
    status, said = check("--data", str(tmp_path))
    assert (status, "not a database" in said) == (1, True), said
    assert check("--records", "off") == (
        0,
        "It can start. Nothing is recorded, as RELGUIDE_RECORDS is off.\n",
    )
    assert check("--queue", "0")[0] == 2
    status, said = check("--records", "off", RELGUIDE_TOKENS="view:short")
    assert (status, "16 characters or more" in said) == (2, True), said
