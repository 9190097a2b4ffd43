"""What became of a job, as a value that travels between processes."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from relguide_server.http.errors import ProblemError, Refusal, attempt, log

SORRY = "The server made a mistake: its log has the details. The request may be right."


@dataclass(frozen=True, slots=True)
class JobDone:
    """A job came to its end."""

    value: Any


@dataclass(frozen=True, slots=True)
class JobRefused:
    """A job refused what it was asked."""

    status: int
    detail: str
    errors: tuple[tuple[str, str], ...]
    """(path, sentence) of each thing wrong."""


@dataclass(frozen=True, slots=True)
class JobBroken:
    """A job broke off by a mistake of ours."""

    report: str
    """Its traceback."""


Outcome = JobDone | JobRefused | JobBroken


def outcome_of(job: Callable[..., Any], arguments: tuple[Any, ...]) -> Outcome:
    """Do a job; whatever it raises is a value."""
    try:
        value, report = attempt(job, arguments)
    except Refusal as error:
        errors = tuple((e.path, e.message) for e in error.errors)
        return JobRefused(error.status_code, error.detail, errors)
    return JobBroken(report) if report else JobDone(value)


def value_of(outcome: Outcome) -> Any:
    """What a job returned.

    Raises:
        Refusal: with the job's own sentence; or 500 for a mistake of ours, which goes to the log.
    """
    match outcome:
        case JobDone(value):
            return value
        case JobRefused(status, detail, errors):
            named = [ProblemError(path=path, message=message) for path, message in errors]
            raise Refusal(status, detail, errors=named)
        case JobBroken(report):
            log.error("A job stopped by a mistake of ours\n%s", report)
            raise Refusal(500, SORRY)
