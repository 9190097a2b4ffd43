"""A process that does jobs: `python -m relguide_server.worker NICE`, for `hands.ProcessHand`.

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

from relguide_server.outcomes import outcome_of

LENGTH = 8
"""Bytes of a length, most significant first."""


def main() -> None:
    """Do jobs until there are no more."""
    # Ctrl-C goes to all processes of a terminal; the service ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(int(sys.argv[1]))
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


def _read(jobs: IO[bytes]) -> bytes | None:
    length = jobs.read(LENGTH)
    if len(length) < LENGTH:
        return None
    size = int.from_bytes(length, "big")
    text = jobs.read(size)
    return text if len(text) == size else None


if __name__ == "__main__":
    main()
