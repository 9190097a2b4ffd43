"""The clock that kernels read: steady, the system's own, and not read where there is no hurry."""

import time
from math import inf

import pytest

from relguide.kernels.base.clock import now, time_is_up


def test_it_is_the_systems_steady_clock_and_goes_on() -> None:
    before = now()
    theirs = time.monotonic()
    after = now()
    assert before < after
    # monotonic clocks of two interfaces may begin at different times, and run alike
    time.sleep(0.05)
    assert now() - after == pytest.approx(time.monotonic() - theirs, abs=0.02)


def test_time_is_up_once_it_has_come() -> None:
    assert not time_is_up(inf)
    assert not time_is_up(now() + 60.0)
    assert time_is_up(now())
    assert time_is_up(-inf)
