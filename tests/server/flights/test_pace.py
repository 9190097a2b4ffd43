"""Flight time against the wall clock, with a clock that the test turns."""

import threading
import time

import pytest
from relguide_server.flights.pace import Pace


class Clock:
    """Stands still until it is moved."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def due_at_once(pace: Pace, t: float) -> bool:
    """Whether `hold` returns without waiting."""
    done = threading.Event()
    thread = threading.Thread(target=lambda: (pace.wait_until(t), done.set()), daemon=True)
    thread.start()
    at_once = done.wait(0.1)
    if not at_once:
        pace.stop()
        thread.join(1.0)
    return at_once


@pytest.mark.parametrize("rate", [1.0, 10.0, 60.0])
def test_an_instant_is_due_at_its_share_of_wall_time(rate: float) -> None:
    clock = Clock()
    pace = Pace(rate=rate, paused=False, clock=clock)
    clock.now += 5.0
    assert due_at_once(pace, 4.99 * rate)
    assert not due_at_once(pace, 5.2 * rate)


def test_errors_of_waits_do_not_add() -> None:
    clock = Clock()
    pace = Pace(rate=10.0, paused=False, clock=clock)
    for k in range(1, 1001):
        clock.now = 100.0 + 0.005 * k + 0.02  # every wait is 20 ms late
        assert pace.wait_until(0.05 * k)
    clock.now = 105.0
    assert due_at_once(pace, 50.0)
    assert not due_at_once(pace, 51.0)


def test_a_flight_that_is_far_behind_does_not_rush() -> None:
    clock = Clock()
    pace = Pace(rate=1.0, paused=False, clock=clock)
    clock.now += 3600.0  # the machine slept
    assert pace.wait_until(1.0)
    assert not due_at_once(pace, 1.5)


def test_a_paused_flight_shows_its_beginning_and_stands() -> None:
    clock = Clock()
    pace = Pace(rate=1.0, paused=True, clock=clock)
    clock.now += 10.0
    assert pace.wait_until(0.0)
    assert not due_at_once(pace, 0.05)


def test_play_goes_on_from_where_it_stood() -> None:
    clock = Clock()
    pace = Pace(rate=1.0, paused=True, clock=clock)
    clock.now += 10.0
    pace.play()
    clock.now += 0.1
    assert pace.wait_until(0.1)
    assert not due_at_once(pace, 0.3)


def test_a_new_rate_counts_from_now() -> None:
    clock = Clock()
    pace = Pace(rate=1.0, paused=False, clock=clock)
    clock.now += 2.0
    assert pace.wait_until(2.0)
    pace.set_rate(60.0)
    assert pace.rate == 60.0
    clock.now += 1.0
    assert pace.wait_until(61.0)
    assert not due_at_once(pace, 65.0)


def test_stop_lets_go() -> None:
    pace = Pace(rate=1.0, paused=True)
    held: list[bool] = []
    thread = threading.Thread(target=lambda: held.append(pace.wait_until(1.0)))
    thread.start()
    time.sleep(0.05)
    pace.stop()
    thread.join(1.0)
    assert held == [False]
