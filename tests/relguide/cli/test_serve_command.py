"""`relguide serve` says what it lets others do."""

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
