"""Clearances that wait to be saved, and those that live; and what becomes of a killed run's."""

from dataclasses import asdict
from typing import Any

import orjson

from relguide_server.records.entries import ClearanceNoted
from relguide_server.records.recording import Row

HELD = 10_000
"""Most clearances that wait to be saved."""
KILLED = "The service was killed: nobody watches this any more. Ask for another clearance."
STOPPED = "The service was stopped: nobody watches this any more. Ask for another clearance."
FLOWN = ("flying", "deviated")
"""States in which an aircraft flies what it is cleared to."""


class NotedClearances:
    """The newest of each clearance. Lives on the writer's thread."""

    def __init__(self, run: str) -> None:
        """Make an empty one.

        Args:
            run: of the service, that rows belong to.
        """
        self._run = run
        self._known: dict[str, Row] = {}
        self._unsaved: set[str] = set()

    @property
    def live(self) -> bool:
        """Whether there is one that is not over."""
        return any(not row["over"] for row in self._known.values())

    def add(self, noted: ClearanceNoted) -> bool:
        """Keep what is new of one; `False` if too many wait."""
        if noted.id not in self._known and len(self._unsaved) >= HELD:
            return False
        self._known[noted.id] = {"run": self._run, **asdict(noted)}
        self._unsaved.add(noted.id)
        return True

    def rows(self) -> list[Row]:
        """What is to be saved now."""
        return [self._known[one] for one in self._unsaved]

    def note_saved(self) -> None:
        """All that `rows` gave is saved; those that are over need nothing more."""
        self._unsaved.clear()
        self._known = {one: row for one, row in self._known.items() if not row["over"]}

    def note_replaced(self) -> None:
        """The database may be another one: all that is known is to be saved again."""
        self._unsaved = set(self._known)


def ended(card: str, *, at: str, message: str) -> tuple[str, str]:
    """A clearance that nobody watches any more.

    Args:
        card: all of it, JSON.
        at: when it ended, UTC, ISO 8601.
        message: why, in a sentence.

    Returns:
        its state, terminated if it was being flown, else expired; and its card.
    """
    content: dict[str, Any] = orjson.loads(card)
    state = "terminated" if content["state"] in FLOWN else "expired"
    steps: list[dict[str, Any]] = content["history"]
    last = {"state": state, "t_s": steps[-1]["t_s"], "at": at, "by": "service", "message": message}
    content |= {"state": state, "due_s": 0.0, "deviations": [], "history": [*steps, last]}
    return state, orjson.dumps(content).decode()
