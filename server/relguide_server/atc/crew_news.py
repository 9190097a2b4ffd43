"""What the crew of a flight is told of its clearance: a document of the flight, on its record."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from relguide.atc.clearances import State
from relguide.atc.life import Clearance
from relguide.flying.documents import ClearanceNews, ClearanceStatus
from relguide.units import Second

Level = Literal["none", "advisory", "caution", "warning"]

TOLD: Mapping[State, ClearanceStatus] = {
    "requested": "sent",
    "validating": "sent",
    "standby": "standby",
    "accepted": "validated",
    "unable": "unable",
    "wilco": "wilco",
    "flying": "flying",
    "deviated": "deviating",
    "flown": "over",
    "cancelled": "over",
    "expired": "over",
    "terminated": "over",
}
"""By state; of one that is superseded nothing is told: another one stands in its place."""


def crew_news(clearance: Clearance, ident: str, t: Second) -> ClearanceNews | None:
    """What a crew is told of its clearance now; `None` if that is nothing.

    Args:
        clearance: it.
        ident: the pursuer's in its flight.
        t: flight time [s].
    """
    told = TOLD.get(clearance.state)
    if told is None:
        return None
    last, deviations = clearance.history[-1], clearance.deviations
    reason, message = last.reason, last.message
    if deviations and not clearance.over:
        reason = deviations[0].subject
        message = " ".join(one.message for one in deviations)
    return ClearanceNews(
        t=t,
        ident=ident,
        clearance_id=clearance.id,
        clearance=told,
        level=_level(clearance),
        reason=reason,
        message=message,
        automated=clearance.auto_answer and last.by == "service" and told in _ANSWERS,
    )


def is_news(now: ClearanceNews, before: ClearanceNews | None) -> bool:
    """Whether a crew has not been told so yet."""
    return before is None or replace(now, t=before.t) != before


_ANSWERS: tuple[ClearanceStatus, ...] = ("standby", "validated", "unable")


def _level(clearance: Clearance) -> Level:
    """How urgent it is to the crew."""
    if clearance.state == "terminated" or any(
        one.level == "alert" for one in clearance.deviations if not clearance.over
    ):
        return "warning"
    was_cleared = any(step.state == "accepted" for step in clearance.history)
    if clearance.deviations or (was_cleared and clearance.state in ("unable", "deviated")):
        return "none" if clearance.over and clearance.state != "unable" else "caution"
    return "advisory" if clearance.state in ("unable", "expired") else "none"
