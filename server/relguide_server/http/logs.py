"""The service's log: a line for each event, as text or JSON, with the id of its request."""

import logging
import sys
import traceback
from collections.abc import Callable
from contextvars import ContextVar
from datetime import UTC, datetime
from math import inf
from time import monotonic
from typing import Any, Literal

import orjson

LOG = "relguide"
"""The logger that all of ours are below."""
A_MINUTE = 60.0
"""How often a line is written that many can cause [s]."""
request_id: ContextVar[str] = ContextVar("request_id", default="")
"""Of the request that is being answered; empty outside of requests."""


class JsonLines(logging.Formatter):
    """A JSON object a line: `time`, `level`, `logger`, `message`, and what else is known."""

    def format(self, record: logging.LogRecord) -> str:
        """One line."""
        line = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
            **_more(record),
        }
        if record.exc_info:
            line["exception"] = "".join(traceback.format_exception(*record.exc_info))
        return orjson.dumps(line, default=str).decode()


class TextLines(logging.Formatter):
    """The same for people; a traceback follows on lines of its own."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(levelname)-7s %(message)s")

    def formatMessage(self, record: logging.LogRecord) -> str:
        """One line."""
        more = " ".join(f"{name}={value}" for name, value in _more(record).items())
        return super().formatMessage(record) + (f"  [{more}]" if more else "")


class SeldomLine:
    """A line that many can cause: it is written once a minute, with how many more there were."""

    def __init__(self, now: Callable[[], float] = monotonic) -> None:
        self._now, self._written_at, self._more = now, -inf, 0

    def write(self, message: str, *arguments: object) -> None:
        """Write it, or count it."""
        now = self._now()
        if now - self._written_at < A_MINUTE:
            self._more += 1
            return
        more = f" ({self._more} more such since the last line)" if self._more else ""
        logging.getLogger(f"{LOG}.server").info(message + more, *arguments)
        self._written_at, self._more = now, 0


def configure(form: Literal["text", "json"], level: Literal["debug", "info", "warning"]) -> None:
    """Write the log of this process to its standard error.

    Args:
        form: how each line is written.
        level: what of ours is written at least; of other libraries, warnings and errors are.
    """
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonLines() if form == "json" else TextLines())
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(logging.WARNING)
    logging.getLogger(LOG).setLevel(level.upper())


def _more(record: logging.LogRecord) -> dict[str, Any]:
    """What is known beside the message: the request's id, and the fields that were given."""
    fields: dict[str, Any] = getattr(record, "fields", {})
    current = request_id.get()
    return {"request_id": current, **fields} if current else fields
