"""`shared_tables`: what holds for the tables of every audit."""

import pytest

from relguide.cli.shared_tables import WIDTH, print_latency
from relguide.learn.audits.latency import Latency


def test_latencies_fit_the_width_however_slow_the_machine(
    capsys: pytest.CaptureFixture[str],
) -> None:
    slow = Latency(median=1.0e7, mean=1.0e8, late=1.0e9)
    print_latency({"network": slow, "together": slow, "search": slow})
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= WIDTH
    (row,) = (line for line in lines if "together" in line)
    assert row.split() == ["together", "10,000,000.0", "100,000,000.0", "1,000,000,000.0"]
