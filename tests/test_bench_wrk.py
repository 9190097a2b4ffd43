"""What wrk prints is read as numbers, and what it complains of is not passed over."""

import pytest

from benchmarks.service.speed import say_ticks
from benchmarks.service.wrk import main, read

PRINTED = """Running 4s test @ http://127.0.0.1:8000/healthz
  1 threads and 16 connections
  Thread Stats   Avg      Stdev     Max   +/- Stdev
    Latency     3.10ms  801.00us  14.03ms   90.00%
    Req/Sec     4.01k   301.00     4.40k    80.00%
  Latency Distribution
     50%  950.00us
     75%    3.90ms
     90%    5.10ms
     99%    1.02s
  15824 requests in 4.00s, 12.01MB read
{wrong}Requests/sec:   3956.25
Transfer/sec:      3.00MB
"""


def test_rates_and_latencies_are_read_whatever_their_units() -> None:
    found = read(PRINTED.format(wrong=""))
    assert found.rate == 3956.25
    assert found.p50 == pytest.approx(0.95)
    assert found.p99 == pytest.approx(1020.0)
    assert found.wrong == ""


@pytest.mark.parametrize(
    "wrong",
    [
        "Non-2xx or 3xx responses: 15824",
        "Socket errors: connect 0, read 3, write 0, timeout 1",
    ],
)
def test_answers_that_were_no_answers_are_told(wrong: str) -> None:
    assert read(PRINTED.format(wrong=f"  {wrong}\n")).wrong == wrong


def test_what_wrk_does_not_print_is_refused() -> None:
    with pytest.raises(ValueError, match="not what wrk prints"):
        read("unable to connect")


def test_without_wrk_it_says_what_does_the_same(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    with pytest.raises(SystemExit, match="2"):
        main([])
    assert "run python -m benchmarks.service.speed" in capsys.readouterr().err


def test_ticks_are_said_for_each_watcher() -> None:
    said = say_ticks(10, [40, 41], 81, 2.0)
    assert said == "10 flights, 2 watchers: 20.2 ticks a second each"
