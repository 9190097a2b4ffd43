"""Flight time against the wall clock: a rate, a pause, and no drift."""

import threading
import time
from collections.abc import Callable

GRAIN = 0.004
"""Waits shorter than this [s] are not worth a system call: at ×60 a step lasts 0.8 ms."""
BEHIND = 0.25
"""A flight later than this [s] continues from where it is and does not rush to catch up."""


class Pace:
    """When each instant of a flight is due. One thread waits; any thread may change the rate.

        due(t) = anchor on the wall + (t − anchor in flight) / rate

    so the errors of single waits do not add up.
    """

    def __init__(
        self, *, rate: float, paused: bool, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._changed = threading.Condition()
        self._clock = clock
        self._rate = rate
        self._paused = paused
        self._stopped = False
        self._t = 0.0
        self._anchor = (clock(), 0.0)

    @property
    def rate(self) -> float:
        """Simulated seconds per second of the wall clock."""
        return self._rate

    @property
    def paused(self) -> bool:
        """Whether the flight is paused."""
        return self._paused

    def wait_until(self, t: float) -> bool:
        """Wait until flight time t [s] is due.

        Returns:
            False if the flight has been stopped.
        """
        with self._changed:
            while not self._stopped:
                if t <= self._t:  # so that a paused flight shows its beginning
                    return True
                if self._paused:
                    self._changed.wait()
                    continue
                wall, flight = self._anchor
                now = self._clock()
                early = wall + (t - flight) / self._rate - now
                if early < -BEHIND:
                    self._anchor = (now, t)
                if early <= GRAIN:
                    self._t = t
                    return True
                self._changed.wait(early)
            return False

    def set_rate(self, rate: float) -> None:
        """Fly faster or slower from now on."""
        with self._changed:
            self._restart()
            self._rate = rate

    def pause(self) -> None:
        """Pause the flight."""
        with self._changed:
            self._paused = True
            self._changed.notify_all()

    def play(self) -> None:
        """Continue the flight."""
        with self._changed:
            if self._paused:
                self._paused = False
                self._restart()

    def stop(self) -> None:
        """Let `wait_until` return False from now on."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def _restart(self) -> None:
        self._anchor = (self._clock(), self._t)
        self._changed.notify_all()
