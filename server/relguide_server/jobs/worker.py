"""A process that does jobs for `ProcessExecutor`: `python -m relguide_server.jobs.worker [--idle]`.

Jobs come on standard input and outcomes go to standard output, each as its length and its pickle;
both ends are this program. What else is written there goes to standard error. It ends with its
input: when the service stops, or is killed.
"""

import gc
import os
import pickle
import signal
import sys
from typing import IO

from relguide_server.jobs.outcomes import outcome_of

LENGTH = 8
"""Bytes of a length, most significant first."""


def main() -> None:
    """Do jobs until there are no more."""
    # Ctrl-C goes to all processes of a terminal; the service ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if "--idle" in sys.argv:
        give_way()
    outcomes = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    gc.freeze()
    jobs = sys.stdin.buffer
    while (job := _read(jobs)) is not None:
        text = pickle.dumps(outcome_of(*pickle.loads(job)), pickle.HIGHEST_PROTOCOL)
        try:
            outcomes.write(len(text).to_bytes(LENGTH, "big"))
            outcomes.write(text)
            outcomes.flush()
        except BrokenPipeError:  # the service was killed
            os._exit(1)


def give_way() -> None:
    """Run only where a processor would be idle without it, as far as the system knows of that.

    A process that is merely nice ends its turn of some milliseconds when another one wakes up, and
    Linux does not wake that one on its processor rather than on one with other work.
    """
    if hasattr(os, "nice"):
        os.nice(19)
    if hasattr(os, "SCHED_IDLE"):
        os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))


def _read(jobs: IO[bytes]) -> bytes | None:
    length = jobs.read(LENGTH)
    if len(length) < LENGTH:
        return None
    size = int.from_bytes(length, "big")
    text = jobs.read(size)
    return text if len(text) == size else None


if __name__ == "__main__":
    main()
