"""Processes and threads that work, fail, are killed, and end at once on Ctrl-C."""

import os
import signal
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from random import Random
from time import monotonic, sleep

import pytest

from relguide.parallel.pool import start_processes, start_threads

ROUNDS = 40
"""Ctrl-C at so many moments; a pool that shares a queue hung in one of ten."""
WORKING = """
import sys
from functools import partial
from relguide.__main__ import STOPPED
from relguide.parallel.pool import {start}

def work(number):
    found = sum(i * i for i in range(20_000 + 400_000 * {long}))
    return b"x" * 3_000_000

if __name__ == "__main__":
    try:
        with {start}(2) as pool:
            print("begun", flush=True)
            while True:
                for future in [pool.submit(work, n) for n in range(8)]:
                    future.result()
    except KeyboardInterrupt:
        sys.exit(STOPPED)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("start", "long"), [("start_processes", 0), ("start_threads", 0), ("start_threads", 100)]
)
def test_ctrl_c_ends_all_within_a_second(start: str, long: int) -> None:
    for moment in range(ROUNDS if long == 0 else 2):
        took, code, said = interrupted(start, long, Random(moment).uniform(0.0, 0.2))
        assert (code, said) == (130, "")
        assert took < 1.0


def interrupted(start: str, long: int, after: float) -> tuple[float, int, str]:
    """How long it takes to end after Ctrl-C [s], how it ends, and what it says."""
    with subprocess.Popen(
        [sys.executable, "-c", WORKING.format(start=start, long=long)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as running:
        assert running.stdout is not None
        assert running.stderr is not None
        running.stdout.readline()
        sleep(after)
        os.killpg(running.pid, signal.SIGINT)
        pressed = monotonic()
        try:
            running.wait(timeout=5.0)
        finally:
            took = monotonic() - pressed
            if running.poll() is None:
                os.killpg(running.pid, signal.SIGKILL)
        with pytest.raises(ProcessLookupError):
            os.killpg(running.pid, 0)  # no process of its group is left
        return took, running.returncode, running.stderr.read()


def fail(number: int) -> None:
    raise ZeroDivisionError(f"{number} by zero")


def die(number: int) -> None:
    os._exit(number)


def test_processes_do_what_is_asked_and_raise_what_is_raised() -> None:
    with start_processes(2) as pool:
        assert list(pool.map(abs, range(-5, 5))) == [5, 4, 3, 2, 1, 0, 1, 2, 3, 4]
        with pytest.raises(ZeroDivisionError, match="3 by zero") as failed:
            pool.submit(fail, 3).result()
        assert "in fail" in "".join(failed.value.__notes__)  # where it was, over there
        with pytest.raises(AttributeError, match="pickle"):
            pool.submit(lambda: 0).result()
        assert pool.submit(abs, -7).result() == 7


def test_a_process_that_is_lost_is_an_error_and_no_wait() -> None:
    with start_processes(2) as pool:
        lost = pool.submit(die, 3)
        with pytest.raises(BrokenProcessPool):
            lost.result(timeout=30.0)


def test_threads_work_beside_each_other() -> None:
    with start_threads(2) as pool:
        assert list(pool.map(abs, (-1, -2))) == [1, 2]
